// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/geometry.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "geo/base/keys.h"
#include "io/scene/base/from_file.h"
#include "io/scene/base/words.h"

namespace sunload {

namespace {

using Names = std::unordered_set<std::string_view>;

constexpr int deepest_geometry = 60;  // geometries inside of geometries

bool is_polygon(std::string_view geometry) {
  return geometry == "Polygon" || geometry == "PolygonPatch" || geometry == "Triangle" ||
         geometry == "Rectangle";
}

/// Geometries made of others.
bool is_aggregate(std::string_view geometry) {
  static const Names names{"Solid",
                           "MultiSolid",
                           "CompositeSolid",
                           "Shell",
                           "MultiSurface",
                           "CompositeSurface",
                           "Surface",
                           "Tin",
                           "OrientableSurface",
                           "TexturedSurface",
                           "PolyhedralSurface",
                           "TriangulatedSurface",
                           "MultiGeometry",
                           "GeometricComplex",
                           "MultiPolygon"};
  return names.contains(geometry);
}

/// Properties of geometries that hold other geometries.
bool is_member(std::string_view property) {
  static const Names names{"exterior",        "interior",     "surfaceMember",  "surfaceMembers",
                           "solidMember",     "solidMembers", "geometryMember", "geometryMembers",
                           "polygonMember",   "baseSurface",  "patches",        "polygonPatches",
                           "trianglePatches", "element"};
  return names.contains(property);
}

class Collector {
 public:
  Collector(const CityDocument& document, const CityAppearance& appearance, MetGeometry& met,
            std::vector<CityPolygon>& polygons, NoteCounter& notes)
      : document_(document),
        appearance_(appearance),
        met_(met),
        polygons_(polygons),
        notes_(notes) {}

  void collect(XmlElement geometry, bool is_flipped, MaterialId material, int depth) {
    if (depth > deepest_geometry)
      document_.file().fail(geometry, "geometries nest too deep", "do its links form a circle?");
    document_.spend(geometry, 1);
    const auto name = geometry.name();
    if (!is_polygon(name) && !is_aggregate(name)) return count_other(name);
    if (!met_.add(geometry, is_flipped)) return;
    material = appearance_.of(geometry, material);
    if (is_polygon(name)) return polygons_.push_back({geometry, is_flipped, material});
    // The second is of CityGML 1, and one of the first.
    const bool turns = (name == "OrientableSurface" || name == "TexturedSurface") &&
                       geometry.attribute("orientation") == "-";
    for (const auto property : geometry.children()) {
      if (!is_member(property.name())) continue;
      for (const auto part : document_.values(property))
        collect(part, is_flipped != turns, material, depth + 1);
    }
  }

 private:
  void count_other(std::string_view name) {
    if (is_thin(name)) return notes_.count("geometries of points or lines ignored");
    notes_.warn("geometries of unknown type '" + shortened(name) + "' ignored", 1);
  }

  const CityDocument& document_;
  const CityAppearance& appearance_;
  MetGeometry& met_;
  std::vector<CityPolygon>& polygons_;
  NoteCounter& notes_;
};

}  // namespace

bool has_surfaces(std::string_view geometry) {
  return is_polygon(geometry) || is_aggregate(geometry);
}

bool is_solid(std::string_view geometry) {
  return geometry == "Solid" || geometry == "MultiSolid" || geometry == "CompositeSolid";
}

bool is_thin(std::string_view geometry) {
  static const Names names{"Point",           "MultiPoint", "MultiCurve",     "LineString",
                           "MultiLineString", "Curve",      "CompositeCurve", "OrientableCurve"};
  return names.contains(geometry);
}

void MetGeometry::add_all_of(MetGeometry&& other) {
  for (std::size_t k = 0; k < met_.size(); ++k) {
    if (met_[k].size() < other.met_[k].size()) std::swap(met_[k], other.met_[k]);
    met_[k].merge(other.met_[k]);
  }
}

void collect_polygons(XmlElement geometry, const CityDocument& document,
                      const CityAppearance& appearance, MetGeometry& met,
                      std::vector<CityPolygon>& polygons, NoteCounter& notes) {
  Collector(document, appearance, met, polygons, notes)
      .collect(geometry, false, MaterialId::none(), 0);
}

PolygonWriter::PolygonWriter(const CityDocument& document, CityCoordinates& coordinates,
                             SceneFromFile scene_from_file, PolygonModel& model, NoteCounter& notes)
    : document_(document),
      coordinates_(coordinates),
      scene_from_file_(std::move(scene_from_file)),
      model_(model),
      notes_(notes) {}

std::size_t PolygonWriter::PositionHash::operator()(const std::array<std::uint64_t, 3>& key) const {
  return static_cast<std::size_t>(mixed(key[0] ^ mixed(key[1] ^ mixed(key[2], 0), 0), 0));
}

std::int32_t PolygonWriter::vertex(Vec3 in_file, XmlElement ring) {
  const std::array<std::uint64_t, 3> key{std::bit_cast<std::uint64_t>(in_file.x),
                                         std::bit_cast<std::uint64_t>(in_file.y),
                                         std::bit_cast<std::uint64_t>(in_file.z)};
  const auto [entry, is_new] =
      vertices_.try_emplace(key, static_cast<std::int32_t>(model_.vertices.size()));
  if (!is_new) return entry->second;
  if (model_.vertices.size() >= std::numeric_limits<std::int32_t>::max())
    throw InputError({document_.file().path()}, "has too many vertices", "2³¹ can be counted");
  const Vec3 position = scene_from_file_(in_file);
  if (!is_usable(position))
    document_.file().fail(ring, "has a corner beyond all coordinates on Earth",
                          "no map projection reaches 1e9 m", "are srsName and unit_m right?");
  model_.vertices.push_back(position);
  return entry->second;
}

bool PolygonWriter::add_ring(XmlElement side, bool is_flipped) {
  const auto ring = document_.value(side);
  if (!ring) return false;
  const auto& corners = coordinates_.ring(ring);
  constexpr std::size_t smallest_ring = 3;
  if (corners.size() < smallest_ring) return false;
  const auto begin = model_.ring_vertex.size();
  for (const auto& corner : corners) model_.ring_vertex.push_back(vertex(corner, ring));
  if (is_flipped)
    std::reverse(model_.ring_vertex.begin() + static_cast<std::ptrdiff_t>(begin),
                 model_.ring_vertex.end());
  model_.ring_begin.push_back(static_cast<std::int64_t>(model_.ring_vertex.size()));
  return true;
}

std::uint64_t PolygonWriter::add(const CityPolygon& polygon, PolygonModel::Facts facts) {
  const auto begin = model_.ring_vertex.size();
  bool has_outer = false;
  for (const auto side : polygon.element.children()) {
    if (side.name() != "exterior" && side.name() != "outerBoundaryIs") continue;
    has_outer = add_ring(side, polygon.is_flipped);
    break;
  }
  if (!has_outer) {
    notes_.count("surfaces of fewer than 3 vertices left out");
    return 0;
  }
  std::uint64_t key = 1;
  for (auto k = begin; k < model_.ring_vertex.size(); ++k)
    key += mixed(static_cast<std::uint64_t>(model_.ring_vertex[k]), 0);
  for (const auto side : polygon.element.children()) {
    if (side.name() != "interior" && side.name() != "innerBoundaryIs") continue;
    if (!add_ring(side, polygon.is_flipped))
      notes_.count("inner rings of fewer than 3 vertices left out");
  }
  model_.polygon_ring.push_back(static_cast<std::int64_t>(model_.ring_begin.size()) - 1);
  facts.material = polygon.material;
  model_.facts.push_back(facts);
  return key == 0 ? 1 : key;
}

void PolygonWriter::take_back() {
  model_.facts.pop_back();
  model_.polygon_ring.pop_back();
  model_.ring_begin.resize(static_cast<std::size_t>(model_.polygon_ring.back()) + 1);
  model_.ring_vertex.resize(static_cast<std::size_t>(model_.ring_begin.back()));
}

}  // namespace sunload
