// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/cityjson/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/base/file_aside.h"

namespace sunload {
namespace {

constexpr double step_m = 1e-6;  // of the coordinates in the file

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// Type of semantic surface, null where CityJSON 2.0 has none that is read back as this kind.
const char* semantic_of(Surface surface) {
  switch (surface) {
    case Surface::wall:
      return "WallSurface";
    case Surface::roof:
      return "RoofSurface";
    case Surface::window:
      return "Window";
    case Surface::floor:
      return "GroundSurface";
    case Surface::ground:
      return "TrafficArea";
    case Surface::other:
      return nullptr;
  }
  return nullptr;
}

class CityText {
 public:
  CityText(const PolygonModel& model, double crs_unit_m)
      : model_(model),
        crs_unit_m_(crs_unit_m),
        tree_(model.object_names, model.object_kinds, model.families),
        polygons_(model.object_names.size()),
        members_(tree_.size()) {
    for (std::size_t p = 0; p < model.polygon_count(); ++p)
      polygons_[model.facts[p].object.index()].push_back(p);
    for (std::size_t object = 0; object < polygons_.size(); ++object)
      is_solid_.push_back(is_closed(polygons_[object]));
    type_.resize(tree_.size());
    for (const std::size_t place : tree_.owners_first()) type_[place] = type_of(place);
    const auto& order = tree_.owners_first();
    for (auto place = order.rbegin(); place != order.rend(); ++place)
      if (is_written(*place) && is_member(*place)) members_[*tree_.owner(*place)].push_back(*place);
    for (auto& members : members_) std::sort(members.begin(), members.end());
  }

  std::string text() {
    text_ = R"({"type":"CityJSON","version":"2.0")";
    // In the unit of the map that is named.
    add(R"(,"transform":{{"scale":[{0},{0},{0}],"translate":[0,0,0]}})", step_m / crs_unit_m_);
    if (!model_.crs.empty()) add(R"(,"metadata":{{"referenceSystem":{}}})", quoted(model_.crs));
    add_materials();
    text_ += ",\n\"CityObjects\":{";
    const char* between = "\n";
    for (std::size_t object = 0; object < polygons_.size(); ++object) {
      text_ += std::exchange(between, ",\n");
      add_object(object);
    }
    for (std::size_t bare = polygons_.size(); bare < tree_.size(); ++bare) {
      if (!is_written(bare)) continue;
      text_ += std::exchange(between, ",\n");
      add_head(bare);
      text_ += '}';
    }
    text_ += "},\n\"vertices\":[";
    between = "";
    for (const Vec3 p : model_.vertices) {
      add("{}[{},{},{}]", std::exchange(between, ","), steps(p.x), steps(p.y), steps(p.z));
    }
    text_ += "]}\n";
    return std::move(text_);
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  static long long steps(double metres) { return std::llround(metres / step_m); }

  void add_materials() {
    if (model_.materials.empty()) return;
    text_ += R"(,"appearance":{"materials":[)";
    const char* between = "";
    for (const auto& material : model_.materials) {
      add(R"({}{{"name":{})", std::exchange(between, ","), quoted(material.name));
      if (material.diffuse) add(R"(,"diffuseColor":[{0},{0},{0}])", *material.diffuse);
      text_ += '}';
    }
    text_ += "]}";
  }

  /// Corners of ring r.
  std::pair<std::size_t, std::size_t> corners(std::int64_t r) const {
    const auto ring = static_cast<std::size_t>(r);
    return {static_cast<std::size_t>(model_.ring_begin[ring]),
            static_cast<std::size_t>(model_.ring_begin[ring + 1])};
  }

  /// Every edge is walked once each way.
  bool is_closed(const std::vector<std::size_t>& polygons) {
    edges_.clear();
    for (const auto p : polygons) {
      for (auto r = model_.polygon_ring[p]; r < model_.polygon_ring[p + 1]; ++r) {
        const auto [begin, end] = corners(r);
        for (auto i = begin; i < end; ++i) {
          const auto a = model_.ring_vertex[i], b = model_.ring_vertex[i + 1 < end ? i + 1 : begin];
          edges_.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
      }
    }
    std::sort(edges_.begin(), edges_.end());
    if (edges_.size() % 2 != 0) return false;
    for (std::size_t i = 0; i < edges_.size(); i += 2) {
      const auto &first = edges_[i], &second = edges_[i + 1];
      const bool is_pair = first[0] == second[0] && first[1] == second[1] && first[2] != second[2];
      const bool is_last =
          i + 2 == edges_.size() || edges_[i + 2][0] != first[0] || edges_[i + 2][1] != first[1];
      if (!is_pair || !is_last) return false;
    }
    return !polygons.empty();
  }

  /// Objects, and what of bare ones they belong to.
  bool is_written(std::size_t place) const {
    return place < polygons_.size() || !members_[place].empty();
  }

  /// Whether it is written as a member of what it belongs to.
  bool is_member(std::size_t place) const {
    const auto owner = tree_.owner(place);
    if (!owner) return false;
    constexpr std::array bodies{"Building", "Bridge", "Tunnel"};
    constexpr std::array rest{"Part", "Installation", "ConstructiveElement"};
    const std::string& own = tree_.kind(place);
    for (const std::string body : bodies)
      for (const std::string end : rest)
        if (own == body + end && (type_[*owner] == body || type_[*owner] == body + "Part"))
          return true;
    return false;
  }

  /// The model's own type where it is one that stands alone, or beside what it belongs to, and may
  /// have this geometry.
  std::string type_of(std::size_t place) const {
    constexpr std::array bodies{
        "Bridge", "Building", "CityFurniture", "OtherConstruction", "SolitaryVegetationObject",
        "Tunnel"};
    constexpr std::array lands{"LandUse",         "Railway",   "Road",
                               "TransportSquare", "WaterBody", "Waterway"};
    const std::string& own = tree_.kind(place);
    const auto is_one_of = [&](const auto& types) {
      return std::find(types.begin(), types.end(), own) != types.end();
    };
    const bool is_solid = place < is_solid_.size() && is_solid_[place];
    if (is_one_of(bodies) || (!is_solid && is_one_of(lands)) || is_member(place)) return own;
    return is_solid ? "Building" : "GenericCityObject";
  }

  /// Name, type and family, with the brace left open.
  void add_head(std::size_t place) {
    add(R"({}:{{"type":"{}")", quoted(tree_.name(place)), type_[place]);
    if (is_member(place)) add(R"(,"parents":[{}])", quoted(tree_.name(*tree_.owner(place))));
    if (members_[place].empty()) return;
    const char* between = ",\"children\":[";
    for (const std::size_t member : members_[place])
      add("{}{}", std::exchange(between, ","), quoted(tree_.name(member)));
    text_ += ']';
  }

  void add_object(std::size_t object) {
    const auto& polygons = polygons_[object];
    const bool is_solid = is_solid_[object];
    add_head(object);
    add(R"(,"geometry":[{{"type":"{}","lod":"2","boundaries":{})",
        is_solid ? "Solid" : "MultiSurface", is_solid ? "[[" : "[");
    const char* between = "";
    for (const auto p : polygons) {
      text_ += std::exchange(between, ",");
      add_polygon(p);
    }
    const std::string open = is_solid ? "[[" : "[", close = is_solid ? "]]" : "]";
    text_ += close;
    add_semantics(polygons, open, close);
    text_ += ",\"material\":{\"grey\":{\"values\":" + open;
    between = "";
    for (const auto p : polygons) {
      const auto material = model_.facts[p].material;
      text_ += std::exchange(between, ",");
      text_ += material.exists() ? std::to_string(material.index()) : "null";
    }
    text_ += close + "}}}]}";
  }

  void add_polygon(std::size_t p) {
    const char* between = "[";
    for (auto r = model_.polygon_ring[p]; r < model_.polygon_ring[p + 1]; ++r) {
      text_ += std::exchange(between, ",");
      const auto [begin, end] = corners(r);
      for (auto i = begin; i < end; ++i) add("{}{}", i == begin ? '[' : ',', model_.ring_vertex[i]);
      text_ += ']';
    }
    text_ += ']';
  }

  void add_semantics(const std::vector<std::size_t>& polygons, const std::string& open,
                     const std::string& close) {
    std::array<int, surface_names.size()> place;
    place.fill(-1);
    int count = 0;
    text_ += ",\"semantics\":{\"surfaces\":[";
    for (const auto p : polygons) {
      const auto surface = model_.facts[p].surface;
      const char* type = semantic_of(surface);
      auto& at = place[static_cast<std::size_t>(surface)];
      if (type == nullptr || at >= 0) continue;
      add(R"({}{{"type":"{}"}})", count == 0 ? "" : ",", type);
      at = count++;
    }
    text_ += "],\"values\":" + open;
    const char* between = "";
    for (const auto p : polygons) {
      const int at = place[static_cast<std::size_t>(model_.facts[p].surface)];
      text_ += std::exchange(between, ",");
      text_ += at < 0 ? "null" : std::to_string(at);
    }
    text_ += close + "}";
  }

  const PolygonModel& model_;
  double crs_unit_m_;
  FamilyTree tree_;
  std::vector<std::vector<std::size_t>> polygons_;  ///< of each object
  std::vector<bool> is_solid_;                      ///< the same
  std::vector<std::vector<std::size_t>> members_;   ///< objects, by place in the tree
  std::vector<std::string> type_;                   ///< as written, by place in the tree
  std::vector<std::array<std::int32_t, 3>> edges_;
  std::string text_;
};

}  // namespace

void write_cityjson(const PolygonModel& model, const std::string& path, double crs_unit_m) {
  write_file(path, CityText(model, crs_unit_m).text());
}

}  // namespace sunload
