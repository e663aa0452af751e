// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Geometries of GML down to their polygons, and polygons into a model.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "geo/mesh/mesh.h"
#include "io/scene/citygml/appearance.h"
#include "io/scene/citygml/coordinates.h"
#include "io/scene/citygml/document.h"

namespace sunload {

/// Solid, MultiSurface … Polygon, which have surfaces.
bool has_surfaces(std::string_view geometry);
/// Solid, MultiSolid, CompositeSolid.
bool is_solid(std::string_view geometry);
/// Points and lines.
bool is_thin(std::string_view geometry);

/// A polygon where it stands in the file, which way round it is meant.
struct CityPolygon {
  XmlElement element;
  bool is_flipped = false;  ///< by an OrientableSurface
  MaterialId material = MaterialId::none();
};

/// Geometries that were met, each way round.
class MetGeometry {
 public:
  /// False where it was met before.
  bool add(XmlElement element, bool is_flipped) {
    return met_[is_flipped ? 1 : 0].insert(element.address()).second;
  }
  bool has(XmlElement element) const {
    return met_[0].contains(element.address()) || met_[1].contains(element.address());
  }
  void add_all_of(MetGeometry&& other);

 private:
  std::array<std::unordered_set<const void*>, 2> met_;
};

/// Appends the polygons of a geometry that were not met before, following links. Throws InputError
/// where geometries nest too deep.
void collect_polygons(XmlElement geometry, const CityDocument& document,
                      const CityAppearance& appearance, MetGeometry& met,
                      std::vector<CityPolygon>& polygons, NoteCounter& notes);

/// Polygons into a model: positions that an object repeats are one vertex.
class PolygonWriter {
 public:
  using SceneFromFile = std::function<Vec3(Vec3)>;

  PolygonWriter(const CityDocument& document, CityCoordinates& coordinates,
                SceneFromFile scene_from_file, PolygonModel& model, NoteCounter& notes);

  /// Vertices are shared from here on.
  void begin_object() { vertices_ = {}; }
  /// The outer ring's vertices whatever their order, to find a polygon that is written twice; 0:
  /// it was left out, having fewer than 3.
  std::uint64_t add(const CityPolygon& polygon, PolygonModel::Facts facts);
  /// Takes back what the last `add` appended, but for vertices.
  void take_back();

 private:
  /// Bits of the coordinates, so that equal means the same.
  struct PositionHash {
    std::size_t operator()(const std::array<std::uint64_t, 3>& key) const;
  };
  bool add_ring(XmlElement side, bool is_flipped);
  std::int32_t vertex(Vec3 in_file, XmlElement ring);

  const CityDocument& document_;
  CityCoordinates& coordinates_;
  SceneFromFile scene_from_file_;
  PolygonModel& model_;
  NoteCounter& notes_;
  std::unordered_map<std::array<std::uint64_t, 3>, std::int32_t, PositionHash> vertices_;
};

}  // namespace sunload
