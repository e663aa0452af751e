// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// List `edit` of section `scene` of a study.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/base/key_names.h"
#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

constexpr Range sizes_m{0, 1e5, Range::Low::excluded};
constexpr Range raises_m{-1e3, 1e3};
constexpr Range storey_heights_m{1, 20};
constexpr int most_storeys = 300;
constexpr Range tree_heights_m{0.1, 150};  // the tallest trees have 116
constexpr Range trunks_m{0, 150};

/// x and y, with or without a height.
struct Standing {
  Point2 at{0, 0};
  std::optional<double> base_m;
};
Standing read_standing(YamlMap& map) {
  map.require("position_m", "something that is added stands somewhere");
  const auto at = map.numbers("position_m", coordinates_m);
  if (at.size() == 3) return {{at[0], at[1]}, at[2]};
  if (at.size() == 2) return {{at[0], at[1]}, {}};
  if (map.has("position_m"))
    map.problem("position_m", "must be two or three numbers, x, y and z",
                "without z it stands on what is below");
  return {};
}

RaiseEdit read_raise(YamlMap& map) {
  RaiseEdit raise;
  const auto by = map.number("by_m", raises_m);
  const int storeys = map.integer("storeys", -most_storeys, most_storeys, 0);
  const auto storey = map.number("storey_m", storey_heights_m);
  raise.from_m = map.number("from_m", sizes_m);
  if (map.has("storeys") == by.has_value() && map.is_usable())
    map.reading().problem(map.where(), map.path("by_m") + ": write by_m, or storeys and storey_m",
                          by ? "they say the same" : "nothing says how far", "");
  if (map.has("storeys")) map.require("storey_m", "storeys have no height of their own");
  if (storey && by) map.warn("storey_m", "is not used", "it belongs to storeys");
  raise.by_m = by ? *by : storeys * storey.value_or(0);
  return raise;
}

SceneFileStudy read_edit_file(YamlMap& map, const std::string& folder) {
  SceneFileStudy file;
  file.where = map.where();
  map.require("file");
  file.path = read_path(map, "file", folder);
  file.up = map.choice<char>("up", {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}}, file.up);
  file.unit_m = map.number("unit_m", units_m);
  file.position = read_vector(map, "position_m");
  file.turn_deg = map.number("turn_deg", turns_deg, file.turn_deg);
  file.material = map.text("material", file.material);
  return file;
}

AddPrismEdit read_box(YamlMap& map) {
  AddPrismEdit box;
  const auto [at, base_m] = read_standing(map);
  box.base_m = base_m;
  map.require("size_m");
  const auto size = read_numbers(map, "size_m", 3, "three lengths along x, y and z");
  const double turn_deg = map.number("turn_deg", turns_deg, 0);
  if (size.empty()) return box;
  if (*std::min_element(size.begin(), size.end()) <= 0)
    map.problem("size_m", "has a length that is not above 0");
  box.areas.areas = {rectangle_in_plan(at, size[0], size[1], turn_deg)};
  box.height_m = size[2];
  return box;
}

AddPrismEdit read_footprint(YamlMap& map, const std::string& folder) {
  AddPrismEdit prism;
  map.require("polygon");
  prism.areas = read_areas(map, "polygon", folder);
  map.require("height_m");
  prism.height_m = map.number("height_m", sizes_m, 1);
  prism.base_m = map.number("base_m", heights_m);
  return prism;
}

AddTreesEdit read_tree(YamlMap& map) {
  AddTreesEdit trees;
  const auto [at, base_m] = read_standing(map);
  trees.at = at;
  trees.base_m = base_m;
  for (const char* key : {"height_m", "crown_m"}) map.require(key);
  trees.shape.height_m = map.number("height_m", tree_heights_m, 10);
  trees.shape.crown_m = map.number("crown_m", tree_heights_m, 1);
  trees.shape.trunk_m = map.number("trunk_m", trunks_m, 0);
  trees.shape.leaves = map.text("leaves", "crown");
  trees.shape.trunk = map.text("trunk", "wood");
  trees.to = read_point(map, "to_m");
  trees.every_m = map.number("every_m", sizes_m, 0);
  if (trees.shape.trunk_m >= trees.shape.height_m)
    map.problem("trunk_m", "is not below height_m", "the crown begins there");
  check_row(map, "trees");
  return trees;
}

AddTreePointsEdit read_tree_points(YamlMap& map, const std::string& folder) {
  AddTreePointsEdit trees;
  map.require("file");
  trees.path = read_path(map, "file", folder);
  trees.rules.layer = map.text("layer", trees.rules.layer);
  trees.rules.height = map.text("height", trees.rules.height);
  trees.rules.crown = map.text("crown", trees.rules.crown);
  trees.rules.name = map.text("name", trees.rules.name);
  trees.rules.default_height_m = map.number("default_height_m", tree_heights_m);
  trees.rules.default_crown_m = map.number("default_crown_m", tree_heights_m);
  trees.trunk_share = map.number("trunk_share", trunk_shares, trees.trunk_share);
  trees.leaves = map.text("leaves", "crown");
  trees.trunk = map.text("trunk", "wood");
  return trees;
}

constexpr std::array additions{"box", "footprint", "tree", "trees", "file"};
constexpr std::array actions{"remove", "raise", "move_m", "turn", "replace", "add"};

template <std::size_t N>
std::string list_of(const std::array<const char*, N>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Exactly one of the keys.
template <std::size_t N>
void expect_one(YamlMap& map, const std::array<const char*, N>& keys, const std::string& subject) {
  const auto count =
      std::count_if(keys.begin(), keys.end(), [&](const char* key) { return map.has(key); });
  if (count == 1 || !map.is_usable()) return;
  map.reading().problem(map.where(),
                        subject + (count == 0 ? " does nothing" : " does several things"),
                        "one of " + list_of(keys), count == 0 ? "" : "write two steps");
}

EditAction read_add(YamlMap& map, const std::string& folder) {
  expect_one(map, additions, "scene.edit: add");
  EditAction action;
  const auto name = map.text("name");
  const std::string material = map.text("material", "");
  const bool describe = map.reading().purpose == YamlReading::Purpose::describe;
  const auto read = [&](const char* key, const auto& take) {
    map.tree(key);
    if (map.has(key) || describe) map.section(key, take);
  };
  const auto with_names = [&](AddPrismEdit prism, const char* usual) {
    prism.name = name.value_or(usual);
    prism.material = material;
    action = std::move(prism);
  };
  read("box", [&](YamlMap& box) { with_names(read_box(box), "box"); });
  read("footprint", [&](YamlMap& area) { with_names(read_footprint(area, folder), "block"); });
  read("tree", [&](YamlMap& tree) {
    AddTreesEdit trees = read_tree(tree);
    trees.name = name.value_or("tree");
    action = std::move(trees);
  });
  read("trees", [&](YamlMap& points) {
    AddTreePointsEdit trees = read_tree_points(points, folder);
    trees.name = name.value_or("tree");
    action = std::move(trees);
  });
  read("file", [&](YamlMap& file) { action = AddFileEdit{read_edit_file(file, folder)}; });
  if (map.has("material") && (map.has("tree") || map.has("trees") || map.has("file")))
    map.problem(
        "material", "belongs to box and footprint",
        map.has("file") ? "a file has its own key material" : "a tree has leaves and trunk");
  if (map.has("name") && map.has("file"))
    map.problem("name", "belongs to what the study itself shapes", "objects of files have names");
  return action;
}

EditAction read_action(YamlMap& map, const std::string& folder) {
  expect_one(map, actions, "scene.edit: a step");
  EditAction action;
  const bool describe = map.reading().purpose == YamlReading::Purpose::describe;
  const auto read = [&](const char* key, const auto& take) {
    map.tree(key);
    if (map.has(key) || describe) map.section(key, take);
  };
  map.word("remove", {"true"}, "true");
  read("raise", [&](YamlMap& raise) { action = read_raise(raise); });
  if (const auto by = read_numbers(map, "move_m", 3, "three numbers along x, y and z"); !by.empty())
    action = MoveEdit{{by[0], by[1], by[2]}};
  read("turn", [&](YamlMap& turn) {
    turn.require("by_deg");
    const double by_deg = turn.number("by_deg", turns_deg, 0);
    action = TurnEdit{by_deg, read_point(turn, "about_m")};
  });
  read("replace", [&](YamlMap& file) { action = ReplaceEdit{read_edit_file(file, folder)}; });
  read("add", [&](YamlMap& add) { action = read_add(add, folder); });
  return action;
}

}  // namespace

std::vector<EditStep> read_scene_edit(YamlMap& scene, const std::string& folder) {
  std::vector<EditStep> steps;
  scene.each("edit", [&](YamlMap& map) {
    EditStep step;
    step.where = map.where();
    step.objects = read_objects(map, folder);
    step.selection = read_selection_name(map);
    step.action = read_action(map, folder);
    const bool chooses = step.objects.chooses() || step.selection;
    if (map.has("add") && chooses)
      map.problem("add", "stands beside a choice of objects", "it changes none of them",
                  "write it as a step of its own");
    if (!map.has("add") && !chooses && map.is_usable())
      map.reading().problem(map.where(), "scene.edit: a step chooses no objects",
                            "it needs object, type, polygon, near or selection",
                            "object: \"*\" chooses all of them");
    steps.push_back(std::move(step));
  });
  return steps;
}

}  // namespace sunload::study_sections
