// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/vrml/shapes.h"

#include <cmath>
#include <numbers>

#include "geo/base/check.h"

namespace sunload {

namespace {

/// Points of a circle in the plane y, counter-clockwise seen from above (+y).
/// Returns the index of the first.
std::int32_t add_circle(ShapeFaces& shape, double radius, double y) {
  const auto first = static_cast<std::int32_t>(shape.points.size());
  for (int k = 0; k < turn_segments; ++k) {
    const double angle = 2 * std::numbers::pi * k / turn_segments;
    shape.points.push_back({radius * std::cos(angle), y, -radius * std::sin(angle)});
  }
  return first;
}

std::int32_t add_point(ShapeFaces& shape, Vec3 point) {
  shape.points.push_back(point);
  return static_cast<std::int32_t>(shape.points.size()) - 1;
}

enum class Facing { up, down };

void add_disk(ShapeFaces& shape, std::int32_t circle, Facing facing) {
  auto& face = shape.faces.emplace_back();
  for (std::int32_t k = 0; k < turn_segments; ++k) {
    face.push_back(circle + (facing == Facing::up ? k : turn_segments - 1 - k));
  }
}

/// Side between a lower and an upper circle, seen from outside.
void add_band(ShapeFaces& shape, std::int32_t lower, std::int32_t upper) {
  for (std::int32_t k = 0; k < turn_segments; ++k) {
    const auto next = (k + 1) % turn_segments;
    shape.faces.push_back({lower + k, lower + next, upper + next, upper + k});
  }
}

void add_tip(ShapeFaces& shape, std::int32_t circle, std::int32_t tip, Facing facing) {
  for (std::int32_t k = 0; k < turn_segments; ++k) {
    const auto next = (k + 1) % turn_segments;
    if (facing == Facing::up)
      shape.faces.push_back({circle + k, circle + next, tip});
    else
      shape.faces.push_back({circle + next, circle + k, tip});
  }
}

}  // namespace

ShapeFaces vrml_box(Vec3 size) {
  ShapeFaces box;
  for (int corner = 0; corner < 8; ++corner) {
    const auto half = [&](double length, int bit) {
      return (corner & bit) != 0 ? length / 2 : -length / 2;
    };
    box.points.push_back({half(size.x, 1), half(size.y, 2), half(size.z, 4)});
  }
  box.faces = {{4, 5, 7, 6}, {1, 0, 2, 3}, {0, 4, 6, 2}, {5, 1, 3, 7}, {6, 7, 3, 2}, {0, 1, 5, 4}};
  return box;
}

ShapeFaces vrml_sphere(double radius) {
  constexpr int rings = turn_segments / 2;
  ShapeFaces sphere;
  const auto bottom = add_point(sphere, {0, -radius, 0});
  std::int32_t below = 0;
  for (int ring = 1; ring < rings; ++ring) {
    const double latitude = std::numbers::pi * ring / rings - std::numbers::pi / 2;
    const auto circle =
        add_circle(sphere, radius * std::cos(latitude), radius * std::sin(latitude));
    if (ring == 1)
      add_tip(sphere, circle, bottom, Facing::down);
    else
      add_band(sphere, below, circle);
    below = circle;
  }
  add_tip(sphere, below, add_point(sphere, {0, radius, 0}), Facing::up);
  return sphere;
}

ShapeFaces vrml_cone(double bottom_radius, double height, ConeParts parts) {
  ShapeFaces cone;
  const auto base = add_circle(cone, bottom_radius, -height / 2);
  if (parts.side) add_tip(cone, base, add_point(cone, {0, height / 2, 0}), Facing::up);
  if (parts.bottom) add_disk(cone, base, Facing::down);
  return cone;
}

ShapeFaces vrml_cylinder(double radius, double height, CylinderParts parts) {
  ShapeFaces cylinder;
  const auto lower = add_circle(cylinder, radius, -height / 2);
  const auto upper = add_circle(cylinder, radius, height / 2);
  if (parts.side) add_band(cylinder, lower, upper);
  if (parts.bottom) add_disk(cylinder, lower, Facing::down);
  if (parts.top) add_disk(cylinder, upper, Facing::up);
  return cylinder;
}

ShapeFaces vrml_elevation_grid(const std::vector<double>& heights, ElevationRules rules) {
  const auto [x_count, z_count, x_spacing, z_spacing] = rules;
  SUNLOAD_EXPECT(
      heights.size() == static_cast<std::size_t>(x_count) * static_cast<std::size_t>(z_count),
      "heights of an elevation grid");
  ShapeFaces grid;
  for (std::int32_t j = 0; j < z_count; ++j) {
    for (std::int32_t i = 0; i < x_count; ++i) {
      const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(x_count) +
                      static_cast<std::size_t>(i);
      grid.points.push_back({i * x_spacing, heights[at], j * z_spacing});
    }
  }
  for (std::int32_t j = 0; j + 1 < z_count; ++j) {
    for (std::int32_t i = 0; i + 1 < x_count; ++i) {
      const std::int32_t a = j * x_count + i, b = a + x_count;
      grid.faces.push_back({a, b, b + 1});
      grid.faces.push_back({a, b + 1, a + 1});
    }
  }
  return grid;
}

}  // namespace sunload
