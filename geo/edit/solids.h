// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Simple closed bodies that studies add: extruded footprints, crowns and trunks of trees.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/mesh/delaunay.h"
#include "geo/mesh/mesh.h"

namespace sunload {

/// An area in plan: x and y of its corners [m], outer ring first, then holes; any winding.
using PlanArea = std::vector<std::vector<Point2>>;

/// Whether the point lies in one of the areas.
bool lies_in(const std::vector<PlanArea>& areas, Point2 point);

/// The corners of a rectangle about its middle, turned clockwise seen from above.
PlanArea rectangle_in_plan(Point2 middle, double width_m, double depth_m, double turn_deg);

/// Name, CityJSON type and material of an object that is added.
struct SolidFacts {
  std::string name, kind;
  std::string material;  ///< empty: none of its own
};

/// Adds one closed object: the areas between two heights.
void add_prism(PolygonModel& model, const std::vector<PlanArea>& areas, double low_m, double high_m,
               const SolidFacts& facts);

/// A tree: a crown whose corners lie on an ellipsoid of revolution (upper end `height_m`, lower end
/// `trunk_m` above the foot, greatest width `crown_m`), and below it a trunk.
struct TreeShape {
  double height_m, crown_m, trunk_m;
  std::string leaves, trunk;  ///< materials; leaves are lit on both sides
};
/// Width of a trunk as share of the tree's height: 25 cm at 10 m.
inline constexpr double trunk_width_ratio = 1.0 / 40;
/// One object; the crown has 12 x 6 faces, whose shadow is some 7 % smaller than the ellipsoid's.
void add_tree(PolygonModel& model, Vec3 foot, const TreeShape& shape, const SolidFacts& facts);

/// Height that a thing put there stands on: that of the model's ground faces below the place, else
/// of what lies lowest there of objects of which nobody says what they are, else the foot of the
/// object nearest in plan (of land: its height there), of plants and of what hangs in the air only
/// where there is nothing else. Nothing in an empty model.
std::optional<double> standing_height(const PolygonModel& model, Point2 place);

/// How high above that a thing hangs whose lower face fills the box: nothing where it is no more
/// than a step of the land (geo/mesh/feet.h), or where anything but land, plants and what hangs
/// itself reaches up to the face and carries it, or stands beside.
std::optional<double> height_in_the_air(const PolygonModel& model, const Box& lower_face);

}  // namespace sunload
