// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The curved and simple shapes of VRML as polygons, in the shape's own frame (y up).
#pragma once

#include <cstdint>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// Polygons of one shape; each face lists its corners counter-clockwise seen from its front.
struct ShapeFaces {
  std::vector<Vec3> points;
  std::vector<std::vector<std::int32_t>> faces;
  std::vector<std::int32_t> face_material;  ///< index of a face's own material, or empty
  bool is_two_sided = false;
};

/// Segments of a full turn. Corners lie on the true surface, so that the area of a
/// cylinder's side is 0.16 % too small: 1 − sin(π/32)·32/π.
inline constexpr int turn_segments = 32;

/// Of those edge lengths, about the origin.
ShapeFaces vrml_box(Vec3 size);
/// About the origin.
ShapeFaces vrml_sphere(double radius);

/// Which parts of a cone there are.
struct ConeParts {
  bool side = true, bottom = true;
};
/// Apex at y = height/2, base circle at −height/2.
ShapeFaces vrml_cone(double bottom_radius, double height, ConeParts parts);

/// Which parts of a cylinder there are.
struct CylinderParts {
  bool side = true, bottom = true, top = true;
};
/// About the origin, its axis along y.
ShapeFaces vrml_cylinder(double radius, double height, CylinderParts parts);

/// Number of heights along x and z, and the distance of two of them.
struct ElevationRules {
  std::int32_t x_count = 0, z_count = 0;
  double x_spacing = 1, z_spacing = 1;
};
/// Two triangles per cell; `heights` are x_count × z_count, x fastest; the front is up (+y).
ShapeFaces vrml_elevation_grid(const std::vector<double>& heights, ElevationRules rules);

}  // namespace sunload
