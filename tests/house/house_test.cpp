// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The house stands: dependencies run one way, and one file knows each foreign library.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace sunload {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// Included headers of every source file of the program, by its path.
std::map<std::string, std::vector<std::string>> all_includes() {
  std::map<std::string, std::vector<std::string>> includes;
  const std::regex include("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  const fs::path root(test::source_folder());
  for (const char* room : {"geo", "solver", "io"})
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".in") continue;
      auto& list = includes[fs::relative(entry.path(), root).string()];
      std::ifstream file(entry.path());
      std::smatch words;
      for (std::string line; std::getline(file, line);)
        if (std::regex_match(line, words, include)) list.push_back(words[1]);
    }
  return includes;
}

/// Files (without extension) that include a header that begins so.
Names users_of(const std::string& header) {
  Names users;
  for (const auto& [file, includes] : all_includes())
    for (const auto& included : includes)
      if (included.starts_with(header)) users.insert(fs::path(file).replace_extension().string());
  return users;
}

/// Files (without extension) whose text has what `words` looks for.
Names files_with(const std::regex& words) {
  const fs::path root(test::source_folder());
  Names files;
  for (const auto& [file, list] : all_includes()) {
    std::ifstream source(root / file);
    const std::string text{std::istreambuf_iterator<char>(source), {}};
    if (std::regex_search(text, words)) files.insert(fs::path(file).replace_extension().string());
  }
  return files;
}

/// A row of the table in geo, solver and io's CMakeLists.txt.
struct Room {
  std::string folder;
  Names uses;
};

/// All rooms, in the order in which they stand.
std::vector<Room> all_rooms() {
  std::vector<Room> rooms;
  const fs::path root(test::source_folder());
  for (const char* ring : {"geo", "solver", "io"}) {
    std::ifstream file(root / ring / "CMakeLists.txt");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::regex row("\nsunload_room\\(([^)]*)\\)");
    for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at) {
      std::istringstream words((*at)[1]);
      Room room;
      words >> room.folder;
      bool is_used = false;
      for (std::string word; words >> word;) {
        if (word == "USES" || word == "LIBRARIES" || word == "INCLUDES" || word == "SOURCES")
          is_used = word == "USES";
        else if (is_used)
          room.uses.insert(word);
      }
      rooms.push_back(room);
    }
  }
  return rooms;
}

/// The rooms that the files of each room include, other than itself.
std::map<std::string, Names> included_rooms() {
  std::map<std::string, Names> rooms;
  for (const auto& [file, list] : all_includes()) {
    const std::string room = fs::path(file).parent_path().string();
    if (file == "io/main.cpp") continue;  // the program, not a room
    Names& included_by_room = rooms[room];
    for (const auto& included : list) {
      const std::string other = fs::path(included).parent_path().string();
      const bool is_ours = other.starts_with("geo") || other.starts_with("solver") ||
                           other == "io" || other.starts_with("io/");
      if (is_ours && other != room) included_by_room.insert(other);
    }
  }
  return rooms;
}

/// Rooms whose files include another one than the table says, or less.
Names rooms_unlike(const std::vector<Room>& table, const std::map<std::string, Names>& included) {
  Names unlike;
  std::map<std::string, Names> uses;
  for (const auto& room : table) uses[room.folder] = room.uses;
  for (const auto& [room, others] : included)
    if (!uses.contains(room) || uses.at(room) != others) unlike.insert(room);
  for (const auto& [room, others] : uses)
    if (!included.contains(room)) unlike.insert(room);
  return unlike;
}

TEST(House, EveryRoomIncludesWhatItsRowInTheTableSays) {
  const auto included = included_rooms();
  EXPECT_GT(all_includes().size(), 400u);
  EXPECT_GT(included.size(), 30u);
  EXPECT_EQ(rooms_unlike(all_rooms(), included), Names{});
}

TEST(House, AStaleOrMissingPermissionWouldBeSeen) {
  const auto included = included_rooms();
  auto rooms = all_rooms();
  rooms.front().uses.insert("io/base");
  EXPECT_EQ(rooms_unlike(rooms, included), Names{rooms.front().folder});
  rooms = all_rooms();
  rooms.back().uses.erase(rooms.back().uses.begin());
  EXPECT_EQ(rooms_unlike(rooms, included), Names{rooms.back().folder});
}

TEST(House, DependenciesRunOneWay) {
  const std::vector<std::string> rings{"geo", "solver", "io"};
  const auto ring_of = [&](const std::string& room) {
    return std::find(rings.begin(), rings.end(), room.substr(0, room.find('/'))) - rings.begin();
  };
  Names above;
  for (const auto& room : all_rooms()) {
    for (const auto& used : room.uses) {
      EXPECT_LE(ring_of(used), ring_of(room.folder)) << room.folder << " uses " << used;
      EXPECT_TRUE(above.contains(used))
          << room.folder << " uses " << used << ", which stands below";
    }
    above.insert(room.folder);
  }
}

/// Files whose text defines each type at the level of a named namespace, by its full name.
std::map<std::string, Names> homes_of_types(const std::map<std::string, std::string>& texts) {
  const std::regex space("namespace ([\\w:]+) \\{.*"),
      type("(?:struct|class|union|enum class|enum) (\\w+)(?: final)?(?: :.*|\\W*\\{.*)?");
  std::map<std::string, Names> homes;
  for (const auto& [file, text] : texts) {
    std::istringstream lines(text);
    std::string within;
    std::smatch words;
    for (std::string line; std::getline(lines, line);)
      if (std::regex_match(line, words, space))
        within = words[1];
      else if (std::regex_match(line, words, type))
        homes[within + "::" + words[1].str()].insert(file);
  }
  return homes;
}

/// Types of one name, told with their files: to the linker their members are the same.
std::vector<std::string> types_of_one_name(const std::map<std::string, std::string>& texts) {
  std::vector<std::string> told;
  for (const auto& [name, files] : homes_of_types(texts)) {
    if (files.size() < 2) continue;
    told.push_back(name + ":");
    for (const auto& file : files) told.back() += " " + file;
  }
  return told;
}

TEST(House, EveryTypeHasAHomeOfItsOwn) {
  const fs::path root(test::source_folder());
  std::map<std::string, std::string> headers;
  for (const auto& [file, list] : all_includes()) {
    if (!file.ends_with(".h")) continue;
    std::ifstream source(root / file);
    headers[file] = {std::istreambuf_iterator<char>(source), {}};
  }
  EXPECT_GT(homes_of_types(headers).size(), 400u) << "types are not found any more";
  EXPECT_EQ(types_of_one_name(headers), std::vector<std::string>());
  const std::string begin = "namespace sunload {\n";
  const std::vector<std::string> planted =
      types_of_one_name({{"a.h", begin + "struct Place {\n"},
                         {"b.h", begin + "class Place : Area {\n"},
                         {"c.h", begin + "struct Place;\n"}});
  EXPECT_EQ(planted, std::vector<std::string>{"sunload::Place: a.h b.h"});
}

TEST(House, EveryRoomTellsWhatLivesInIt) {
  constexpr int most_lines = 15;
  for (const auto& room : all_rooms()) {
    std::ifstream file(fs::path(test::source_folder()) / room.folder / "README.md");
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    EXPECT_GT(lines, 2) << room.folder;
    if (room.folder != "solver") {  // whose page is the method
      EXPECT_LE(lines, most_lines) << room.folder;
    }
  }
}

/// fmt and stdio throw or stop where the standard error cannot be written.
TEST(House, MessagesGoOutByOneFile) {
  const Names users =
      files_with(std::regex("\\b(stderr|std::cerr|std::clog|STDERR_FILENO|fmt::print)\\b"));
  // Signals can do no more than write(2); progress asks the terminal for its width.
  EXPECT_EQ(users, (Names{"io/base/standard_streams", "io/base/stop_signals", "io/run/progress"}));
}

/// Clang 14, which fuzzes and tidies, does not compile the views of GCC 12's library, nor what
/// returns one.
TEST(House, ClangReadsTheRangesInUse) {
  EXPECT_EQ(files_with(std::regex(
                "\\b(views::|ranges::(subrange|equal_range|search|search_n|find_end|unique|remove|"
                "remove_if|rotate|partition|stable_partition)\\b)")),
            Names{});
}

TEST(House, TheSolverOpensNoFileAndPrintsNothing) {
  for (const auto& [file, list] : all_includes()) {
    if (!file.starts_with("solver/")) continue;
    for (const char* header : {"fstream", "iostream", "cstdio", "filesystem", "fmt/"})
      for (const auto& included : list)
        EXPECT_FALSE(included.starts_with(header)) << file << " includes " << included;
  }
}

/// Each library has its files; one that no longer includes it leaves the list.
TEST(House, OneFileKnowsEachForeignLibrary) {
  const std::map<std::string, Names> owners{
      {"embree", {"solver/surface/ray_caster"}},
      {"Random123", {"solver/base/rng"}},
      {"mpi.h", {"io/run/mpi_world"}},
      {"pybind11", {"io/python/native"}},
      {"regex", {"geo/base/pattern"}},  // seconds of building in each source
      {"hdf5", {"io/result/h5"}},
      {"netcdf", {}},
      {"yaml-cpp", {"io/study/yaml_tree"}},
      {"erfa", {"geo/time/ephemeris"}},
      {"proj", {"geo/sun/proj_objects"}},
      {"date/", {"geo/time/time"}},
      {"cairo", {"io/picture/picture"}},
      {"openssl", {"io/base/base64", "io/base/hash"}},
      {"half.h", {"io/base/half_float"}},
      {"CLI/", {"io/command/command_line"}},
      {"gdal", {"io/base/gdal"}},
      {"ogr_", {"io/base/gdal"}},
      {"cpl_", {"io/base/gdal"}},
      {"boost", {"io/base/statistics"}},
      {"CGAL", {"geo/mesh/constrained_delaunay", "geo/mesh/intersections"}},
      {"GeographicLib", {"geo/sun/site", "geo/sun/site_text"}},
      {"libdeflate", {"io/base/deflate", "io/base/gzip", "io/batch/chunk"}},
      {"Inventor/", {"io/scene/vrml/faces", "io/scene/vrml/nodes", "io/scene/vrml/reader"}},
      {"pugixml", {"io/scene/citygml/xml"}},
      {"nlohmann",
       {"io/base/json_text",
        "io/batch/container",
        "io/batch/file",
        "io/command/check_study",
        "io/explain/explanation_text",
        "io/explain/painting_text",
        "io/export/cityjson",
        "io/export/cityjson_model",
        "io/export/glb",
        "io/report/compare_text",
        "io/report/info_table",
        "io/report/measures",
        "io/run/progress",
        "io/scene/cityjson/geometry",
        "io/scene/cityjson/select",
        "io/scene/cityjson/templates",
        "io/scene/cityjson/write",
        "io/scene/mesh_files/gltf_buffers",
        "io/study/canonical",
        "io/view/data"}}};
  for (const auto& [header, files] : owners) EXPECT_EQ(users_of(header), files) << header;
}

}  // namespace
}  // namespace sunload
