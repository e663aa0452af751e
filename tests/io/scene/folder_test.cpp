// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Real files: every one of the shared folders is read with the counts that its README
// states, or refused where it must be.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/real_models.h"
#include "tests/support/reference.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

/// What a README says about one file.
struct Facts {
  std::string text;

  std::size_t number(const std::string& pattern) const {
    std::smatch match;
    return std::regex_search(text, match, std::regex(pattern)) ? std::stoul(match[1]) : 0;
  }
  bool has(const std::string& part) const { return text.find(part) != std::string::npos; }
  /// Numbers of "bbox [a b c .. d e f]" as they are written; empty where there is none.
  std::vector<std::string> box() const {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(R"(bbox \[([^\]]*)\])"))) return {};
    std::istringstream words(match[1]);
    std::vector<std::string> numbers;
    for (std::string word; words >> word;) {
      if (word != "..") numbers.push_back(word);
    }
    return numbers;
  }
  /// Levels of detail that "LoD {'1': 98, …}" lists.
  std::vector<std::string> lods() const {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(R"(LoD \{([^}]*)\})"))) return {};
    std::vector<std::string> names;
    const std::string list = match[1];
    const std::regex name("'([0-9.]+)'");
    for (std::sregex_iterator it(list.begin(), list.end(), name), end; it != end; ++it) {
      names.push_back((*it)[1]);
    }
    return names;
  }
};

std::map<std::string, Facts> read_facts(const std::string& folder) {
  std::map<std::string, Facts> facts;
  std::ifstream readme(shared_path(folder + "/README.md"));
  const std::regex row(R"(^\| `([^`]+)` \|)");
  for (std::string line; std::getline(readme, line);) {
    std::smatch match;
    if (std::regex_search(line, match, row)) facts[match[1]] = {line};
  }
  return facts;
}

/// The README's boxes are rounded: equal to half of the last digit that is written.
void expect_box(const PolygonModel& model, const Facts& facts, const std::string& name) {
  const auto expected = facts.box();
  if (expected.size() != 6 || model.polygon_count() == 0) return;
  const auto box = bounding_box(model.vertices);
  const std::array<double, 6> found{box.low.x,  box.low.y,  box.low.z,
                                    box.high.x, box.high.y, box.high.z};
  double largest = 0;
  for (const double value : found) largest = std::max(largest, std::abs(value));
  // Of a few products.
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * largest;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double value = std::stod(expected[i]);
    // 5 significant digits are written for meshes, 2 decimals for cities.
    const double half_digit =
        facts.has("fmt ") ? 0.5 * std::pow(10, std::ceil(std::log10(std::abs(value) + 1e-9)) - 5)
                          : 0.005;
    EXPECT_NEAR(found[i], value, half_digit * (1 + 1e-6) + rounding) << name << " bbox " << i;
  }
}

std::size_t polygons_of_all_levels(const std::string& path, const Facts& facts) {
  std::size_t sum = 0;
  for (const auto& lod : facts.lods()) {
    sum += read_scene_file(path, {0, 1, lod}).polygon_count();
  }
  return sum;
}

/// Triangles of polygons with n corners and h holes: n + 2h − 2.
std::size_t triangle_count(const PolygonModel& model) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const auto first = model.ring_begin[static_cast<std::size_t>(model.polygon_ring[p])];
    const auto last = model.ring_begin[static_cast<std::size_t>(model.polygon_ring[p + 1])];
    count += static_cast<std::size_t>(last - first + 2 * (ring_count(model, p) - 1) - 2);
  }
  return count;
}

std::size_t polygons_with_holes(const PolygonModel& model) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) count += ring_count(model, p) > 1;
  return count;
}

/// Files whose README count holds something that must not be read, or holds too little.
const std::map<std::string, int>& stated_differences() {
  static const std::map<std::string, int> table{
      // + 3 of the tree's template, which the README does not count, − 1 of a group whose
      // member has a geometry
      {"corpus_cityjson_fake_complete.city.json", 3 - 1},
      // one building has only a footprint (LoD 0, no parts): the nearest level of the three others
      {"3dbag_tile_5870_v11.city.jsonl", 3},
      // 15 trees: 11 of the templates of 36 surfaces, 4 of the one of 274
      {"geometry_templates_v20.city.jsonl", 11 * 36 + 4 * 274},
  };
  return table;
}

/// Objects of a type with geometry, where READMEs also count those without: wholes of which only
/// the parts have some, groups (their members have it), and instances of points.
const std::map<std::pair<std::string, std::string>, long>& stated_types() {
  static const std::map<std::pair<std::string, std::string>, long> table{
      {{"3dbag_tile_5870_v11.city.jsonl", "Building"}, 1},  // the one with a footprint only
      {{"corpus_cityjson_fake_complete.city.json", "+NoiseBuilding"}, 0},
      {{"corpus_cityjson_fake_complete.city.json", "CityObjectGroup"}, 0},
      {{"corpus_geometry_instance.city.json", "GenericCityObject"}, 0},
      {{"geometry_templates_v20.city.jsonl", "CityObjectGroup"}, 0},
      {{"several_lods_invalid_v11.city.json", "Building"}, 0},
      {{"zurich_subset_lod2_v11.city.json", "Building"}, 0}};
  return table;
}

/// Objects of every type of which the README counts some.
void check_types(const std::string& name, const PolygonModel& model, const Facts& facts) {
  std::smatch list;
  if (!std::regex_search(facts.text, list, std::regex(R"(\d+ objects \(([^)]*)\))"))) return;
  const std::string types = list[1];
  const std::regex entry(R"((\d+) (\+?\w+))");
  for (std::sregex_iterator it(types.begin(), types.end(), entry), end; it != end; ++it) {
    const std::string type = (*it)[2];
    const auto read = std::count(model.object_kinds.begin(), model.object_kinds.end(), type);
    const auto without = stated_types().find({name, type});
    EXPECT_EQ(read, without == stated_types().end() ? std::stol((*it)[1]) : without->second)
        << name << " " << type;
  }
}

/// Vertices that no face uses: READMEs count them, readers leave them out.
std::size_t unused_vertices(const std::string& name) {
  static const std::map<std::string, std::size_t> table{
      {"trimesh_bunny.ply", 25},
      {"euromast_v10.city.json", 1},
      {"rotterdam_citygml_converted_v10.city.json", 63}};
  const auto found = table.find(name);
  return found == table.end() ? 0 : found->second;
}

void check_city(const std::string& path, const std::string& name, const PolygonModel& model,
                const Facts& facts) {
  const auto stated = static_cast<std::ptrdiff_t>(facts.number(R"(; (\d+) polygons \()"));
  const auto lods = facts.lods();
  std::size_t read = model.polygon_count();
  if (lods.size() > 1 && !facts.has("'None'")) read = polygons_of_all_levels(path, facts);
  std::ptrdiff_t expected = stated;
  if (const auto found = stated_differences().find(name); found != stated_differences().end()) {
    expected += found->second;
  }
  EXPECT_EQ(static_cast<std::ptrdiff_t>(read), expected) << name;
  if (lods.size() == 1 && !facts.has("'None'")) {
    EXPECT_EQ(triangle_count(model), facts.number(R"(~(\d+) tri)")) << name;
    EXPECT_EQ(polygons_with_holes(model), facts.number(R"((\d+) with holes)")) << name;
    EXPECT_EQ(model.vertices.size() + unused_vertices(name), facts.number(R"(; (\d+) vertices;)"))
        << name;
    expect_box(model, facts, name);
  } else if (!facts.has("'None'")) {  // levels share vertices, and one of them is read
    EXPECT_LE(model.vertices.size(), facts.number(R"(; (\d+) vertices;)")) << name;
  }
  check_types(name, model, facts);
  std::smatch crs;
  std::regex_search(facts.text, crs, std::regex(R"(CityJSON [0-9.]+; CRS ([^;]+);)"));
  EXPECT_EQ(model.crs, crs[1] == "none" ? "" : crs[1].str()) << name;
}

/// What the READMEs count of meshes, here by rings of polygons after welding equal positions.
struct Connections {
  std::size_t open = 0;         ///< edges of one face
  std::size_t nonmanifold = 0;  ///< edges of more than two
  std::size_t flipped = 0;      ///< edges that both faces walk in the same direction
  std::size_t degenerate = 0;   ///< faces that come twice to a place; they count no further
  std::size_t duplicate = 0;    ///< faces on the same corners as an earlier one
  std::size_t welded = 0;       ///< vertices in the place of an earlier one
};

Connections connections(const PolygonModel& model) {
  Connections found;
  std::map<std::array<double, 3>, std::int32_t> places;
  std::vector<std::int32_t> welded;
  for (const Vec3 v : model.vertices) {
    const auto [entry, is_new] =
        places.try_emplace({v.x, v.y, v.z}, static_cast<std::int32_t>(places.size()));
    welded.push_back(entry->second);
    found.welded += !is_new;
  }
  struct Uses {
    std::size_t up = 0, down = 0;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Uses> edges;
  std::set<std::vector<std::int32_t>> faces;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::vector<std::int32_t> corners;
    std::vector<std::pair<std::int32_t, std::int32_t>> walked;
    for (std::int64_t r = 0; r < ring_count(model, p); ++r) {
      const auto ring = static_cast<std::size_t>(model.polygon_ring[p] + r);
      const auto begin = static_cast<std::size_t>(model.ring_begin[ring]);
      const auto end = static_cast<std::size_t>(model.ring_begin[ring + 1]);
      for (auto k = begin; k < end; ++k) {
        const auto a = welded[static_cast<std::size_t>(model.ring_vertex[k])];
        const auto next = k + 1 < end ? k + 1 : begin;
        const auto b = welded[static_cast<std::size_t>(model.ring_vertex[next])];
        corners.push_back(a);
        walked.emplace_back(a, b);
      }
    }
    std::sort(corners.begin(), corners.end());
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) {
      ++found.degenerate;
      continue;
    }
    found.duplicate += !faces.insert(corners).second;
    for (const auto& [a, b] : walked) {
      auto& uses = edges[std::minmax(a, b)];
      ++(a < b ? uses.up : uses.down);
    }
  }
  for (const auto& [edge, uses] : edges) {
    found.open += uses.up + uses.down == 1;
    found.nonmanifold += uses.up + uses.down > 2;
    found.flipped += (uses.up == 2 && uses.down == 0) || (uses.up == 0 && uses.down == 2);
  }
  return found;
}

void check_connections(const std::string& name, const PolygonModel& model, const Facts& facts) {
  EXPECT_EQ(triangle_count(model), facts.number(R"(tris (\d+))")) << name << " tris";
  if (facts.has("fmt GLB")) return;  // the README has no more of these
  const auto found = connections(model);
  EXPECT_EQ(found.open, facts.number(R"(open (\d+))")) << name << " open";
  EXPECT_EQ(found.nonmanifold, facts.number(R"(nonman (\d+))")) << name << " nonman";
  EXPECT_EQ(found.flipped, facts.number(R"(flip (\d+))")) << name << " flip";
  EXPECT_EQ(found.degenerate, facts.number(R"(degen (\d+))")) << name << " degen";
  EXPECT_EQ(found.duplicate, facts.number(R"(dup (\d+))")) << name << " dup";
  EXPECT_EQ(found.welded, facts.number(R"(weldverts (\d+))")) << name << " weldverts";
}

void check_mesh(const std::string& name, const PolygonModel& model, const Facts& facts) {
  if (!facts.has("fmt ")) return;  // "does not parse with a plain reader"
  EXPECT_EQ(model.polygon_count(), facts.number(R"(faces (\d+))")) << name;
  if (facts.has("verts ")) {
    EXPECT_EQ(model.vertices.size() + unused_vertices(name), facts.number(R"(verts (\d+))"))
        << name;
  }
  expect_box(model, facts, name);
  check_connections(name, model, facts);
}

/// Faces where USE repeats what the README counts once, or where it counts indices of lines, too:
/// from the text by a script of its own that follows DEF and USE.
const std::map<std::string, std::size_t>& stated_vrml() {
  static const std::map<std::string, std::size_t> table{
      {"castle/bump_mapping/room_for_parallax.wrl", 1836},
      {"castle/castle/old/vrml_2/castle.wrl", 628},
      {"castle/lights_materials/cubes_mesh.wrl", 512 * 6},
      {"castle/shadow_maps/castle_with_trees/castle_with_trees.wrl", 4637},
      {"castle/vrml_engine_doc_simple_examples/reuse_coordinate.wrl", 256}};
  return table;
}

/// The README counts what stands in the text: what USE repeats, lines and shapes that are made of
/// numbers alone it does not tell. Where one face set is used once, its polygons are ours.
void check_vrml(const std::string& name, const PolygonModel& model, const Facts& facts) {
  const bool has_other_faces = facts.has("Sphere ") || facts.has("Cone ") || facts.has("Box ") ||
                               facts.has("Cylinder ") || facts.has("Extrusion ") ||
                               facts.has("Inline ");
  const auto stated = facts.number(R"(coordIndex polygons (\d+))");
  const auto found = stated_vrml().find(name);
  if (found != stated_vrml().end()) {
    EXPECT_EQ(model.polygon_count(), found->second) << name;
  } else if (!has_other_faces) {
    EXPECT_EQ(model.polygon_count(), stated) << name;
    EXPECT_EQ(triangle_count(model), facts.number(R"(~(\d+) tri)")) << name;
  } else {
    EXPECT_GE(model.polygon_count(), stated) << name;
  }
  EXPECT_GT(model.polygon_count(), 0u) << name;
}

/// Reads one file and says in one line what became of it.
std::string outcome(const std::string& path, const std::string& name, const Facts& facts) {
  try {
    const auto model = read_scene_file(path, {});
    EXPECT_EQ(broken_arrays(model), "") << name;
    EXPECT_FALSE(facts.has("must be refused") || facts.has("bad input")) << name;
    if (facts.has("#VRML")) {
      check_vrml(name, model, facts);
    } else if (model.is_city_format) {
      check_city(path, name, model, facts);
    } else {
      check_mesh(name, model, facts);
    }
    return fmt::format("{} polygons, {} vertices, {} objects, {} materials, {} notes",
                       model.polygon_count(), model.vertices.size(), model.object_names.size(),
                       model.materials.size(), model.notes.size());
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(facts.has("must be refused") || facts.has("bad input")) << message;
    return "refused: " + message;
  }
}

void walk(const std::string& folder) {
  const auto facts = read_facts(folder);
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_path(folder))) {
    if (entry.is_regular_file() && entry.path().filename() != "README.md")
      files.insert(entry.path());
  }
  EXPECT_EQ(files.size(), facts.size()) << "the README has one row for every file";
  for (const auto& file : files) {
    const auto name = file.lexically_relative(shared_path(folder)).string();
    ASSERT_TRUE(facts.contains(name)) << name;
    std::cout << name << ": " << outcome(file.string(), name, facts.at(name)) << std::endl;
  }
}

TEST(SceneFolder, City) {
  SUNLOAD_NEEDS_MODEL("data/city");
  walk("data/city");
}

TEST(SceneFolder, Meshes) {
  SUNLOAD_NEEDS_MODEL("data/meshes");
  walk("data/meshes");
}

TEST(SceneFolder, Vrml) {
  SUNLOAD_NEEDS_MODEL("data/vrml");
  walk("data/vrml");
}

TEST(SceneFolder, InstancesOfTreesAreRead) {
  SUNLOAD_NEEDS_MODEL("data/city");
  const auto model =
      read_scene_file(shared_path("data/city/geometry_templates_v20.city.jsonl"), {});
  // 15 trees, each one of the three templates, beside two objects of their own.
  const auto trees =
      std::count(model.object_kinds.begin(), model.object_kinds.end(), "SolitaryVegetationObject");
  EXPECT_EQ(trees, 15);
  EXPECT_EQ(model.object_names.size(), 17u);
}

}  // namespace
}  // namespace sunload
