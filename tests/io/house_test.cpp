/// The house stands: dependencies run one way, and one file knows each foreign library.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace sunload {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// Included headers of every source file of the program, by its path.
std::map<std::string, std::vector<std::string>> all_includes() {
  std::map<std::string, std::vector<std::string>> includes;
  const std::regex include("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  const fs::path root(SUNLOAD_SOURCE_DIR);
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

TEST(House, DependenciesRunOneWay) {
  const auto includes = all_includes();
  EXPECT_GT(includes.size(), 100u);
  const std::map<std::string, Names> forbidden{{"geo", {"solver/", "io/"}}, {"solver", {"io/"}}};
  for (const auto& [file, list] : includes) {
    const auto room = forbidden.find(file.substr(0, file.find('/')));
    if (room == forbidden.end()) continue;
    for (const auto& included : list)
      for (const auto& wrong : room->second)
        EXPECT_FALSE(included.starts_with(wrong)) << file << " includes " << included;
  }
}

TEST(House, TheSolverOpensNoFileAndPrintsNothing) {
  for (const auto& [file, list] : all_includes()) {
    if (!file.starts_with("solver/")) continue;
    for (const char* header : {"fstream", "iostream", "cstdio", "filesystem", "fmt/"})
      for (const auto& included : list)
        EXPECT_FALSE(included.starts_with(header)) << file << " includes " << included;
  }
}

TEST(House, OneFileKnowsEachForeignLibrary) {
  const std::map<std::string, Names> owner{{"embree", {"solver/ray_caster"}},
                                           {"omp.h", {"solver/parallel"}},
                                           {"Random123", {"solver/rng"}},
                                           {"mpi.h", {"io/mpi_world"}},
                                           {"hdf5", {"io/h5"}},
                                           {"netcdf", {}},
                                           {"yaml-cpp", {"io/yaml_tree"}},
                                           {"erfa", {"geo/ephemeris"}},
                                           {"proj", {"geo/site"}},
                                           {"date/", {"geo/time"}},
                                           {"cairo", {"io/picture"}},
                                           {"openssl", {"io/hash"}},
                                           {"CLI/", {"io/command_line"}},
                                           {"gdal", {"io/export_geopackage", "io/raster"}},
                                           {"boost", {"io/statistics"}}};
  for (const auto& [header, files] : owner) EXPECT_EQ(users_of(header), files) << header;
}

/// Libraries of a subject that several files share, each named here.
TEST(House, SharedLibrariesStayWhereTheyBelong) {
  const std::map<std::string, Names> owners{
      {"CGAL", {"geo/delaunay", "geo/intersections"}},
      {"GeographicLib", {"geo/site", "geo/site_text"}},
      {"libdeflate",
       {"io/checksum", "io/chunk", "io/batch_container", "io/gzip", "io/result_seal"}},
      {"Inventor/", {"io/scene_vrml", "io/vrml_faces", "io/vrml_nodes"}},
      {"nlohmann",
       {"io/batch_container", "io/batch_file", "io/check_study", "io/compare_text",
        "io/export_cityjson", "io/export_cityjson_model", "io/export_glb", "io/gltf_buffers",
        "io/json_text", "io/progress", "io/scene_cityjson_geometry", "io/scene_cityjson_lod",
        "io/scene_cityjson_select", "io/scene_cityjson_templates", "io/scene_cityjson_write",
        "io/study_canonical", "io/view_data"}}};
  for (const auto& [header, allowed] : owners)
    for (const auto& file : users_of(header))
      EXPECT_TRUE(allowed.contains(file)) << file << " includes " << header;
}

}  // namespace
}  // namespace sunload
