// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Areas in plan of a study: corners, or a GeoJSON file.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "geo/mesh/ring_crossing.h"
#include "io/base/file_text.h"
#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

constexpr std::size_t fewest_corners = 3;

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

}  // namespace sunload::study_sections
