// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Section `selections` of a study, and what steps of `scene.edit` choose likewise.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/base/key_names.h"
#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {
constexpr Range distances_m{0, 1e6};
}  // namespace

std::optional<Point2> read_point(YamlMap& map, const std::string& key) {
  const auto at = read_numbers(map, key, 2, "two numbers, x and y");
  return at.empty() ? std::nullopt : std::optional(Point2{at[0], at[1]});
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
  for (auto& [other, where] : map.texts("except"))
    selection.except.push_back({std::move(other), {}, std::move(where)});
  if (!is_dataset_name(name) && map.is_usable() && name != "*")
    map.reading().problem(map.where(), "'" + name + "' cannot be the name of a selection",
                          "results have it", "letters A to Z, digits and _ make names");
  const bool has_ends = map.has("azimuth_deg") || map.has("height_m");  // right or wrong
  if (!of.chooses() && !has_ends && !map.has("except") && map.is_usable())
    map.reading().problem(map.where(), map.path("object") + ": the selection chooses nothing",
                          "it needs object, type, facade, surface, azimuth_deg, height_m, polygon, "
                          "near or except",
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

namespace {

/// Finds selections by name, and gives each what it leaves out; problems are told once.
class SelectionsByName {
 public:
  SelectionsByName(YamlReading& reading, const std::vector<NamedSelection>& written)
      : reading_(reading), written_(written) {
    names_.reserve(written.size());
    for (const NamedSelection& selection : written) names_.push_back(selection.name);
  }

  /// Nothing where there is none, which is reported.
  std::optional<NamedSelection> find(const std::string& name, const Where& where) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end())
      return whole(written_[static_cast<std::size_t>(found - names_.begin())]);
    reading_.problem(where, "no selection is called '" + name + "'", "",
                     names_.empty() ? "write it under selections" : key_hint(name, names_));
    return {};
  }

  /// With what it leaves out, and what that leaves out.
  NamedSelection whole(NamedSelection selection) {
    constexpr std::size_t most = 10'000;  // that are named, by way of others: each is a copy
    leaving_out_.push_back(selection.name);
    if (++named_ == most)
      reading_.problem(selection.where, "selections leave out too many others by way of others",
                       fmt::format("more than {} in all", most), "write what they are");
    if (named_ >= most) selection.except.clear();
    for (NamedSelection& other : selection.except) {
      const Where where = other.where;
      if (std::find(leaving_out_.begin(), leaving_out_.end(), other.name) != leaving_out_.end())
        reading_.problem(where, "selection '" + other.name + "' leaves out itself",
                         fmt::format("by way of {}", fmt::join(leaving_out_, ", ")),
                         "write what it is without except");
      else if (const auto found = find(other.name, where))
        other = *found;
    }
    leaving_out_.pop_back();
    return selection;
  }

 private:
  YamlReading& reading_;
  const std::vector<NamedSelection>& written_;
  std::vector<std::string> names_, leaving_out_;
  std::size_t named_ = 0;
};

}  // namespace

void resolve_selections(YamlReading& reading, std::vector<NamedSelection>& selections,
                        SceneStudy& scene, const std::vector<MeasureParameters>& measures) {
  const std::vector<NamedSelection> written = selections;
  SelectionsByName by_name(reading, written);
  for (NamedSelection& selection : selections) selection = by_name.whole(std::move(selection));
  const auto resolve = [&](NamedSelection& named) {
    const Where where = named.where;
    const auto found = by_name.find(named.name, where);
    if (found) named = *found;
    named.where = where;
    return found.has_value();
  };
  for (AssignRule& rule : scene.assign)
    if (rule.selection) resolve(*rule.selection);
  for (NamedSelection& selection : scene.cut)
    if (resolve(selection) && !selection.has_ends())
      reading.problem(selection.where,
                      "selection '" + selection.name + "' has no ends to cut faces along",
                      "these are the heights of height_m and the lines of polygon",
                      "give it one of them, or leave it out");
  for (EditStep& step : scene.edit)
    if (step.selection && resolve(*step.selection) && step.selection->is_of_parts())
      reading.problem(step.selection->where,
                      "selection '" + step.selection->name + "' chooses parts of objects",
                      "a step changes whole ones",
                      "name one without facade, surface, azimuth_deg and height_m");
  for (const MeasureParameters& measure : measures)
    if (!measure.of.selection.empty()) by_name.find(measure.of.selection, measure.where);
}

}  // namespace sunload::study_sections
