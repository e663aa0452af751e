// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// List `files` of section `scene` of a study.
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "geo/base/pattern.h"
#include "geo/sun/site.h"
#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

namespace fs = std::filesystem;

constexpr Range base_heights_m{-1e4, 1e5};
constexpr Range least_heights_m{0, 1000};
constexpr Range storeys_m{0.1, 100};
constexpr Range building_heights_m{0.01, 2000};

void read_position(YamlMap& map, SceneFileStudy& file) {
  file.position = read_vector(map, "position_m");
  const double height_m = map.number("height_m", base_heights_m, 0);
  const auto text = map.text("position");
  if (map.has("height_m") && !text)
    map.warn("height_m", "is not used", "it belongs to position; position_m has a z of its own");
  if (!text) return;
  if (map.has("position_m"))
    map.problem("position", "stands beside position_m", "they say the same", "remove one of them");
  try {
    const Site place = site_from_text(*text);
    file.earth_position = {place.latitude_deg, place.longitude_deg, height_m};
  } catch (const InputError& error) {
    add_at(map, "position", map.where("position"), error);
  }
}

/// Rasters of heights that belong together: surface, bare ground and crowns.
void read_rasters(YamlMap& map, const std::string& folder, SceneFileStudy& file) {
  file.terrain = read_path(map, "terrain", folder);
  file.canopy = read_path(map, "canopy", folder);
  file.least_height_m = map.number("least_height_m", least_heights_m, file.least_height_m);
  file.trunk_share = map.number("trunk_share", trunk_shares, file.trunk_share);
  if (map.has("canopy") && !map.has("terrain"))
    map.problem("canopy", "stands without terrain", "heights of crowns are above the ground",
                "write terrain: a raster of the bare ground");
  if (map.has("least_height_m") && !map.has("terrain"))
    map.warn("least_height_m", "is not used", "it belongs to terrain");
  if (map.has("trunk_share") && !map.has("canopy"))
    map.warn("trunk_share", "is not used", "it belongs to canopy");
}

/// Columns of plan data.
FootprintRules read_footprints(YamlMap& map) {
  FootprintRules rules;
  rules.height = map.text("height", rules.height);
  rules.storeys = map.text("storeys", rules.storeys);
  rules.storey_m = map.number("storey_m", storeys_m, rules.storey_m);
  rules.base = map.text("base", rules.base);
  rules.name = map.text("name", rules.name);
  rules.layer = map.text("layer", rules.layer);
  rules.default_height_m = map.number("default_height_m", building_heights_m);
  return rules;
}

SceneFileStudy read_scene_file_entry(YamlMap& map, const std::string& folder) {
  SceneFileStudy file;
  file.where = map.where();
  map.require("file");
  const auto source = map.text("source");
  file.path = source ? read_path(map, "file", folder, *source) : read_path(map, "file", folder);
  file.up = map.choice<char>("up", {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}}, file.up);
  file.unit_m = map.number("unit_m", units_m);
  file.lod = map.text("lod", file.lod);
  if (!file.lod.empty()) check_lod(map, file.lod);
  read_position(map, file);
  file.turn_deg = map.number("turn_deg", turns_deg, file.turn_deg);
  file.material = map.text("material", file.material);
  read_rasters(map, folder, file);
  map.section("footprints", [&](YamlMap& columns) { file.footprints = read_footprints(columns); });
  return file;
}

bool is_same_place(const SceneFileStudy& a, const SceneFileStudy& b) {
  const auto earth = [](const SceneFileStudy& f) {
    const auto e = f.earth_position.value_or(SceneFileStudy::EarthPosition{});
    return Vec3{e.latitude_deg, e.longitude_deg, e.height_m};
  };
  return a.position.value_or(Vec3{}) == b.position.value_or(Vec3{}) && earth(a) == earth(b) &&
         a.turn_deg == b.turn_deg;
}

}  // namespace

std::string read_path(YamlMap& map, const std::string& key, const std::string& folder,
                      const std::string& source) {
  const auto text = map.text(key);
  if (!text) return {};
  const fs::path path = (fs::path(folder) / *text).lexically_normal();
  std::error_code error;
  // As a text of the list, and as the key of a map.
  const std::string subject = map.path(key).starts_with("scene.files") && key == "file"
                                  ? "scene.files: "
                                  : map.path(key) + ": ";
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    map.reading().problem(map.where(key), subject + "'" + *text + "' " + what,
                          "it is sought at " + path.string(), hint);
  };
  if (!fs::exists(path, error)) {
    refuse("is not there", source);
  } else if (!fs::is_regular_file(path, error)) {
    refuse("is no file", "");
  }
  return path.string();
}

std::vector<double> read_numbers(YamlMap& map, const std::string& key, std::size_t count,
                                 const std::string& in_words) {
  auto values = map.numbers(key, coordinates_m);
  if (values.size() == count || !map.has(key)) return values;
  // As many that are no numbers, or out of range, are told one by one.
  if (map.tree(key)->items.size() != count) map.problem(key, "must be " + in_words);
  return {};
}

std::optional<Vec3> read_vector(YamlMap& map, const std::string& key) {
  const auto at = read_numbers(map, key, 3, "three numbers, x, y and z");
  return at.empty() ? std::nullopt : std::optional(Vec3{at[0], at[1], at[2]});
}

void check_row(YamlMap& map, const std::string& things) {
  if (map.has("to_m") != map.has("every_m"))
    map.problem(map.has("to_m") ? "to_m" : "every_m", "stands alone",
                "a row of " + things + " has an end and a distance", "write to_m and every_m");
}

void check_lod(YamlMap& map, const std::string& lod) {
  static const Pattern level(R"(\d(\.\d)?)");
  if (lod == "highest" || level.whole(lod)) return;
  map.problem("lod", "'" + lod + "' is no level of detail", "highest, or a level such as 2 or 2.2");
}

std::vector<SceneFileStudy> read_scene_files(YamlMap& scene, const std::string& folder) {
  std::vector<SceneFileStudy> files;
  scene.each_or_text("files", "file", [&](YamlMap& map) {
    const auto file = read_scene_file_entry(map, folder);
    const bool is_twice = std::any_of(files.begin(), files.end(), [&](const SceneFileStudy& other) {
      return other.path == file.path && is_same_place(other, file);
    });
    if (is_twice && !file.path.empty())
      map.reading().problem(file.where,
                            "scene.files: '" + fs::path(file.path).filename().string() +
                                "' is written twice in the same place",
                            "its faces would lie upon each other",
                            "remove one of the two, or give one another position_m");
    files.push_back(file);
  });
  return files;
}

}  // namespace sunload::study_sections
