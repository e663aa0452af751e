// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/sunk_walls.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

/// Less far below nobody is sunk: terrains are drawn to decimetres.
constexpr double sunk_m = 0.3;
/// From the wall outward, where the sheet is asked for its height.
constexpr double aside_m = 0.01;
/// Of the way from the foot of a triangle to its middle, to be beside its edges.
constexpr double inward = 0.01;

bool holds_in_plan(const Box& outer, const Box& inner) {
  return outer.low.x < inner.low.x && inner.high.x < outer.high.x && outer.low.y < inner.low.y &&
         inner.high.y < outer.high.y;
}

/// Open sheets that look up.
class Sheets {
 public:
  Sheets(const Mesh& mesh, const Bodies& bodies)
      : mesh_(mesh), bodies_(bodies), upward_(mesh, upward_sheets()) {
    has_walls_.assign(bodies.bodies.size(), 0);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (const auto b = bodies.triangle_body[t]; b >= 0 && slope_of(mesh, t) == Slope::upright)
        has_walls_[static_cast<std::size_t>(b)] = 1;
  }
  bool any() const { return !upward_.empty(); }

  struct Above {
    ObjectId object = ObjectId::none();
    double z = 0;
  };
  /// The lowest one that `p` of a body lies below, and that the body stands out of.
  Above above(Vec3 p, const Body& body) {
    Above lowest{ObjectId::none(), body.box.high.z - sunk_m};
    upward_.visit_heights(p.x, p.y, [&](std::size_t t, double z) {
      if (z < p.z + sunk_m || z > lowest.z) return;
      const auto of = static_cast<std::size_t>(bodies_.triangle_body[t]);
      if (holds_in_plan(bodies_.bodies[of].box, body.box) && !is_roof(of))
        lowest = {mesh_.triangle_object[t], z};
    });
    return lowest;
  }

 private:
  /// Whether it has walls of its own, or a body stands below it, as far as boxes tell.
  bool is_roof(std::size_t sheet) {
    const auto [known, is_new] = is_roof_.try_emplace(sheet, false);
    if (is_new) known->second = has_walls_[sheet] != 0 || covers_a_body(sheet);
    return known->second;
  }
  bool covers_a_body(std::size_t sheet) const {
    const Box& roof = bodies_.bodies[sheet].box;
    return std::ranges::any_of(bodies_.bodies, [&](const Body& body) {
      return holds_in_plan(roof, body.box) && body.box.high.z < roof.high.z &&
             body.box.high.z - body.box.low.z > sunk_m &&
             body.box.high.z <= height_over(sheet, body);
    });
  }
  /// Of a sheet over the middle of a body.
  double height_over(std::size_t sheet, const Body& body) const {
    const Vec3 middle = centre_of(body.box);
    double height = body.box.low.z;
    upward_.visit_heights(middle.x, middle.y, [&](std::size_t t, double z) {
      if (static_cast<std::size_t>(bodies_.triangle_body[t]) == sheet) height = std::max(height, z);
    });
    return height;
  }
  std::vector<std::size_t> upward_sheets() const {
    std::vector<std::size_t> upward;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
      if (is_sheet(t)) upward.push_back(t);
    return upward;
  }
  bool is_sheet(std::size_t t) const {
    return bodies_.triangle_body[t] >= 0 && !bodies_.is_closed(t) && !bodies_.is_inner(t) &&
           mesh_.object_kinds[mesh_.triangle_object[t].index()].empty() &&
           mesh_.triangle_surface[t] != Surface::ground &&
           mesh_.triangle_surface[t] != Surface::roof && slope_of(mesh_, t) == Slope::upward;
  }

  const Mesh& mesh_;
  const Bodies& bodies_;
  PlanTriangles upward_;
  std::vector<std::uint8_t> has_walls_;  ///< per body
  std::map<std::size_t, bool> is_roof_;  ///< of sheets that were asked for
};

/// The area of what of a triangle lies below a height.
double area_below(std::array<Vec3, 3> corners, double z) {
  std::ranges::sort(corners, {}, &Vec3::z);
  const auto& [a, b, c] = corners;
  const double all = norm(cross(b - a, c - a)) / 2;
  if (z >= c.z) return all;
  if (z <= a.z) return 0;
  if (z <= b.z) return all * (z - a.z) * (z - a.z) / ((b.z - a.z) * (c.z - a.z));
  return all * (1 - (c.z - z) * (c.z - z) / ((c.z - a.z) * (c.z - b.z)));
}

std::string largest(const std::map<std::size_t, double>& areas, const Mesh& mesh) {
  const auto most = std::max_element(
      areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == areas.end() ? std::string() : mesh.object_names[most->first];
}

}  // namespace

SunkWalls find_sunk_walls(const Mesh& mesh, const Bodies& bodies) {
  SunkWalls sunk;
  Sheets sheets(mesh, bodies);
  if (!sheets.any()) return sunk;
  std::map<std::size_t, double> of_sheets, of_walls;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto b = bodies.triangle_body[t];
    if (b < 0 || slope_of(mesh, t) != Slope::upright) continue;
    const std::array corners = mesh.corners(t);
    const Vec3 normal = mesh.area_vector2(t), middle = (corners[0] + corners[1] + corners[2]) / 3;
    const Vec3 foot = *std::ranges::min_element(corners, {}, &Vec3::z);
    const auto sheet =
        sheets.above(foot + inward * (middle - foot) + normal * (aside_m / norm(normal)),
                     bodies.bodies[static_cast<std::size_t>(b)]);
    if (!sheet.object.exists()) continue;
    const double area = area_below(corners, sheet.z);
    sunk.area_m2 += area;
    of_sheets[sheet.object.index()] += area;
    of_walls[mesh.triangle_object[t].index()] += area;
  }
  sunk.sheet = largest(of_sheets, mesh);
  sunk.wall = largest(of_walls, mesh);
  return sunk;
}

}  // namespace sunload
