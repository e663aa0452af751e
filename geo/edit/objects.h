// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whole objects of a model: their corners, and the model without them or with them elsewhere.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geo/mesh/delaunay.h"
#include "geo/mesh/mesh.h"

namespace sunload {

/// One flag per object of a model: 1 is chosen.
using ChosenObjects = std::vector<std::uint8_t>;

/// A polygon by its corners, outer ring first.
struct LooseFace {
  std::vector<std::vector<Vec3>> rings;
  PolygonModel::Facts facts;
};
/// A copy of a polygon of the model.
LooseFace face_of(const PolygonModel& model, std::size_t polygon);
/// Copies of all polygons of an object, in the order of the model.
std::vector<LooseFace> faces_of(const PolygonModel& model, ObjectId object);

/// Twice the area vector of the outer ring.
Vec3 area_vector2(const LooseFace& face);

/// Whether rings hold a place in plan, holes left out: the parity of edges to its east.
/// `plan(corner)` is the corner's Point2.
template <class Rings, class Plan>
bool holds_in_plan(const Rings& rings, Point2 at, const Plan& plan) {
  bool inside = false;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 a = plan(ring[i]), b = plan(ring[(i + 1) % ring.size()]);
      if ((a.v > at.v) != (b.v > at.v) && at.u < a.u + (at.v - a.v) / (b.v - a.v) * (b.u - a.u))
        inside = !inside;
    }
  return inside;
}
inline Point2 plan_point(Vec3 p) { return {p.x, p.y}; }

/// An object's bounding box; of one without polygons `low` is above `high`.
struct ObjectExtent {
  Box box;
  bool is_empty() const { return box.low.x > box.high.x; }
  Vec3 middle() const { return (box.low + box.high) * 0.5; }
};
/// From a place to the box in plan; 0 above it.
double distance_in_plan(const ObjectExtent& extent, Point2 place);
/// One per object; of a mesh in the metres of its files, its origin added.
std::vector<ObjectExtent> extents_of(const PolygonModel& model);
std::vector<ObjectExtent> extents_of(const Mesh& mesh);
/// Of all of them together; empty where all are.
ObjectExtent extent_of_all(const std::vector<ObjectExtent>& extents);

/// The model without the chosen objects, their names and polygons. The others keep their order and
/// every bit of their corners; what belonged to a chosen one belongs to nothing.
PolygonModel without_objects(const PolygonModel& model, const ChosenObjects& chosen);

/// Puts every corner of the chosen objects where `place` says; corners that they share with others
/// are parted.
void displace_objects(PolygonModel& model, const ChosenObjects& chosen,
                      const std::function<Vec3(Vec3)>& place);

}  // namespace sunload
