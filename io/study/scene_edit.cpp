// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// List `edit` of section `scene` of a study, section `selections`, and areas in plan.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "geo/mesh/ring_crossing.h"
#include "io/base/file_text.h"
#include "io/base/key_names.h"
#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

constexpr Range sizes_m{0, 1e5, Range::Low::excluded};
constexpr Range distances_m{0, 1e6};
constexpr Range raises_m{-1e3, 1e3};
constexpr Range storey_heights_m{1, 20};
constexpr int most_storeys = 300;
constexpr Range tree_heights_m{0.1, 150};  // the tallest trees have 116
constexpr Range trunks_m{0, 150};
constexpr std::size_t fewest_corners = 3;

// --- areas --------------------------------------------------------------------------------

using Kind = YamlNode::Kind;

std::optional<double> number_of(const YamlTree& node) {
  if (!node || node->kind != Kind::text) return {};
  double value = 0;
  const char* const end = node->text.data() + node->text.size();
  const auto read = std::from_chars(node->text.data(), end, value);
  return read.ec == std::errc() && read.ptr == end && std::isfinite(value) ? std::optional(value)
                                                                           : std::nullopt;
}

/// Rings of [x, y]; further numbers of a corner (heights of GeoJSON) are not looked at.
class AreaReader {
 public:
  explicit AreaReader(YamlReading& reading, std::string subject)
      : reading_(reading), subject_(std::move(subject)) {}

  std::vector<Point2> ring(const YamlTree& list) {
    std::vector<Point2> corners;
    if (!expect_list(list)) return corners;
    for (const YamlTree& corner : list->items) {
      const bool is_pair = corner->kind == Kind::list && corner->items.size() >= 2;
      const auto x = is_pair ? number_of(corner->items[0]) : std::nullopt;
      const auto y = is_pair ? number_of(corner->items[1]) : std::nullopt;
      if (x && y)
        corners.push_back({*x, *y});
      else
        reading_.problem(corner->where, subject_ + ": a corner must be two numbers, [x, y]");
    }
    const auto is_last_again = [&] {
      return corners.size() > 1 && corners.front().u == corners.back().u &&
             corners.front().v == corners.back().v;
    };
    if (is_last_again()) corners.pop_back();
    if (corners.size() < fewest_corners)
      reading_.problem(list->where, subject_ + ": an area needs three corners or more");
    return corners;
  }

  PlanArea area(const YamlTree& rings) {
    PlanArea area;
    if (!expect_list(rings)) return area;
    for (const YamlTree& each : rings->items) area.push_back(ring(each));
    return area;
  }

  /// Polygons of any GeoJSON object.
  void geometry(const YamlTree& object, std::vector<PlanArea>& areas) {
    if (!object || object->kind != Kind::map) return;
    const auto value = [&](const char* key) {
      const YamlEntry* entry = object->find(key);
      return entry ? entry->value : nullptr;
    };
    const YamlTree type = value("type");
    const std::string kind = type ? type->text : "";
    if (kind == "Polygon" && value("coordinates")) areas.push_back(area(value("coordinates")));
    if (kind == "MultiPolygon" && value("coordinates") && expect_list(value("coordinates")))
      for (const YamlTree& each : value("coordinates")->items) areas.push_back(area(each));
    if (kind == "Feature") geometry(value("geometry"), areas);
    for (const char* list : {"features", "geometries"})
      if (const YamlTree items = value(list))
        for (const YamlTree& item : items->items) geometry(item, areas);
  }

 private:
  bool expect_list(const YamlTree& node) {
    if (node->kind == Kind::list) return true;
    reading_.problem(node->where, subject_ + ": must be a list of corners [x, y]");
    return false;
  }
  YamlReading& reading_;
  std::string subject_;
};

void refuse_crossing(YamlMap& map, const std::string& key, const std::vector<PlanArea>& areas) {
  for (const PlanArea& area : areas)
    if (const auto at = ring_crossing(area))
      map.problem(key, fmt::format("crosses itself near [{:.6g}, {:.6g}]", at->u, at->v),
                  "which side of it is inside cannot be told",
                  "are its corners in order around the area?");
}

AreasStudy areas_of_file(YamlMap& map, const std::string& key, const std::string& path) {
  AreasStudy found;
  try {
    const YamlTree tree = parse_yaml(path, read_whole_file(path), map.reading().parser_problems);
    AreaReader(map.reading(), map.path(key)).geometry(tree, found.areas);
    // RFC 7946 has degrees; the older member names the map's own system.
    found.in_degrees = tree->kind == Kind::map && !tree->find("crs");
    if (found.areas.empty())
      map.problem(key, "holds no polygon", path + " is sought for Polygon and MultiPolygon",
                  "write a GeoJSON file, or corners: [[0, 0], [10, 0], [10, 8]]");
  } catch (const InputError& error) {
    add_at(map, key, map.where(key), error);
  }
  return found;
}

// --- steps --------------------------------------------------------------------------------

std::optional<Point2> read_point(YamlMap& map, const std::string& key) {
  const auto at = read_numbers(map, key, 2, "two numbers, x and y");
  return at.empty() ? std::nullopt : std::optional(Point2{at[0], at[1]});
}

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

SelectionStudy read_objects(YamlMap& map, const std::string& folder) {
  SelectionStudy objects;
  objects.object = map.text("object", objects.object);
  objects.kind = map.text("type", objects.kind);
  objects.polygon = read_areas(map, "polygon", folder);
  map.section("near", [&](YamlMap& near) {
    if (map.has("near")) near.require("position_m", "nearness is nearness to a place");
    objects.near = read_point(near, "position_m");
    objects.within_m = near.number("within_m", distances_m);
  });
  return objects;
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

constexpr std::array additions{"box", "footprint", "tree", "file"};
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
  read("file", [&](YamlMap& file) { action = AddFileEdit{read_edit_file(file, folder)}; });
  if (map.has("material") && (map.has("tree") || map.has("file")))
    map.problem(
        "material", "belongs to box and footprint",
        map.has("tree") ? "a tree has leaves and trunk" : "a file has its own key material");
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

AreasStudy read_areas(YamlMap& map, const std::string& key, const std::string& folder) {
  AreasStudy found;
  if (map.kind(key) == Kind::text) {
    const std::string path = read_path(map, key, folder);
    if (!path.empty()) found = areas_of_file(map, key, path);
  } else if (const YamlTree corners = map.tree(key)) {
    found.areas.push_back(PlanArea{AreaReader(map.reading(), map.path(key)).ring(corners)});
  }
  refuse_crossing(map, key, found.areas);
  return found;
}

namespace {

/// Two numbers, the first below the second unless they lie on a circle.
enum class Ends { on_a_line, on_a_circle };
std::optional<std::array<double, 2>> read_ends(YamlMap& map, const std::string& key,
                                               const Range& range, Ends kind) {
  const auto ends = map.numbers(key, range);
  if (!map.has(key)) return {};
  if (ends.size() != 2 || ends[0] == ends[1] || (kind == Ends::on_a_line && ends[0] > ends[1])) {
    map.problem(key, "must be two numbers, from and to",
                kind == Ends::on_a_line ? "the first is the lower one"
                                        : "clockwise from the first to the second",
                kind == Ends::on_a_line ? "" : "[315, 45] is about north");
    return {};
  }
  return std::array{ends[0], ends[1]};
}

NamedSelection read_selection(const std::string& name, YamlMap& map, const std::string& folder) {
  NamedSelection selection{name, read_objects(map, folder), map.where()};
  SelectionStudy& of = selection.of;
  of.facade = map.text("facade", of.facade);
  of.surface = map.word("surface", {surface_names.begin(), surface_names.end()}, of.surface);
  of.azimuth_deg = read_ends(map, "azimuth_deg", turns_deg, Ends::on_a_circle);
  of.height_m = read_ends(map, "height_m", heights_m, Ends::on_a_line);
  if (!is_dataset_name(name) && map.is_usable() && name != "*")
    map.reading().problem(map.where(), "'" + name + "' cannot be the name of a selection",
                          "results have it", "letters A to Z, digits and _ make names");
  const bool has_ends = map.has("azimuth_deg") || map.has("height_m");  // right or wrong
  if (!of.chooses() && !has_ends && map.is_usable())
    map.reading().problem(map.where(), map.path("object") + ": the selection chooses nothing",
                          "it needs object, type, facade, surface, azimuth_deg, height_m, polygon "
                          "or near",
                          "object: \"*\" chooses all");
  return selection;
}

}  // namespace

std::vector<NamedSelection> read_selections(YamlMap& root, const std::string& folder) {
  std::vector<NamedSelection> selections;
  root.named("selections", [&](const std::string& name, YamlMap& map) {
    selections.push_back(read_selection(name, map, folder));
  });
  return selections;
}

std::optional<NamedSelection> read_selection_name(YamlMap& map) {
  const auto name = map.text("selection");
  return name ? std::optional(NamedSelection{*name, {}, map.where("selection")}) : std::nullopt;
}

bool is_dataset_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

void resolve_selections(YamlReading& reading, const std::vector<NamedSelection>& selections,
                        SceneStudy& scene, const std::vector<MeasureParameters>& measures) {
  std::vector<std::string> names;
  names.reserve(selections.size());
  for (const NamedSelection& selection : selections) names.push_back(selection.name);
  const auto find = [&](const std::string& name, const Where& where) -> const SelectionStudy* {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
      return &selections[static_cast<std::size_t>(found - names.begin())].of;
    reading.problem(where, "no selection is called '" + name + "'", "",
                    names.empty() ? "write it under selections" : key_hint(name, names));
    return nullptr;
  };
  for (AssignRule& rule : scene.assign)
    if (rule.selection)
      if (const auto* of = find(rule.selection->name, rule.selection->where))
        rule.selection->of = *of;
  for (NamedSelection& selection : scene.cut) {
    const auto* of = find(selection.name, selection.where);
    if (of && !of->height_m && of->polygon.areas.empty())
      reading.problem(selection.where,
                      "selection '" + selection.name + "' has no ends to cut faces along",
                      "these are the heights of height_m and the lines of polygon",
                      "give it one of them, or leave it out");
    if (of) selection.of = *of;
  }
  for (EditStep& step : scene.edit) {
    if (!step.selection) continue;
    const auto* of = find(step.selection->name, step.selection->where);
    if (of && of->is_of_parts())
      reading.problem(step.selection->where,
                      "selection '" + step.selection->name + "' chooses parts of objects",
                      "a step changes whole ones",
                      "name one without facade, surface, azimuth_deg and height_m");
    if (of) step.selection->of = *of;
  }
  for (const MeasureParameters& measure : measures)
    if (!measure.of.selection.empty()) find(measure.of.selection, measure.where);
}

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
