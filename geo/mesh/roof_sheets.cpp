// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/roof_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

/// Of the open edges of a sheet, along which walls hold it; and of its area, upright.
constexpr double least_held = 0.25, most_upright = 0.25;
/// Of its upward area.
constexpr double most_covered = 0.5;
/// Walls end so far below a roof, which has a thickness, or come through it.
constexpr double below_m = 0.5, through_m = 0.1;
/// From the middle of an edge to both sides, where the roof is asked for its height.
constexpr double aside_m = 0.01;
/// How near walls are looked for that a sheet ends at, and so far above and below.
constexpr double on_wall_m = 0.02, parapet_m = 0.1, wall_below_m = 1;

/// Upright triangles.
class WallTriangles {
 public:
  WallTriangles(const Mesh& mesh, const std::vector<std::uint8_t>& are_walls) : mesh_(mesh) {
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < are_walls.size(); ++t) {
      if (!are_walls[t]) continue;
      triangle_.push_back(t);
      boxes.push_back(box_of(mesh, t));
    }
    tree_ = BoxTree(std::move(boxes));
  }

  /// Whether the point lies on one of them that looks against `inward`.
  bool any_at(Vec3 p, Vec3 inward) const {
    bool is_found = false;
    tree_.visit_meeting(widened({p, p}, on_wall_m), [&](std::size_t i) {
      is_found = is_found || (dot(mesh_.area_vector2(triangle_[i]), inward) < 0 &&
                              is_on(mesh_.corners(triangle_[i]), p));
    });
    return is_found;
  }

 private:
  static bool is_on(const std::array<Vec3, 3>& corners, Vec3 p) {
    const Vec3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double size = norm(area);
    if (!(std::abs(dot(p - corners[0], area)) <= on_wall_m * size)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = corners[(k + 1) % 3] - corners[k];
      if (dot(cross(edge, p - corners[k]), area) < -on_wall_m * norm(edge) * size) return false;
    }
    return true;
  }

  const Mesh& mesh_;
  std::vector<std::size_t> triangle_;  ///< of the tree
  BoxTree tree_;
};

/// Areas and lengths in plan of bodies.
class Sheets {
 public:
  Sheets(const Mesh& mesh, const Bodies& bodies)
      : mesh_(mesh),
        bodies_(bodies),
        of_body_(bodies.bodies.size()),
        is_of_sheet_(mesh.triangle_count(), 0) {
    for (std::size_t t = 0; t < is_of_sheet_.size(); ++t) {
      const auto b = bodies.triangle_body[t];
      if (b < 0 || bodies.is_closed(t) || bodies.is_inner(t)) continue;
      is_of_sheet_[t] = 1;
      if (const auto slope = slope_of(mesh, t))
        (*slope == Slope::upward    ? of(t).upward_m2
         : *slope == Slope::upright ? of(t).upright_m2
                                    : of(t).downward_m2) += mesh.area_m2(t);
    }
    for_each_edge(edge_uses(mesh, is_of_sheet_), [&](std::span<const EdgeUse> uses) {
      if (uses.size() == 1) of(uses[0].triangle()).open_m += length_in_plan(uses[0]);
    });
  }

  /// Whether walls may hold the body as a roof.
  bool may_be_roof(std::size_t body) const {
    const Sheet& sheet = of_body_[body];
    return sheet.upward_m2 > sheet.downward_m2 &&
           sheet.upright_m2 <= most_upright * sheet.upward_m2 &&
           !is_land(mesh_.object_kinds[bodies_.bodies[body].object.index()]);
  }

  /// Adds the upper edges of walls that end at such sheets, and edges of these that end at walls
  /// which go on above, as parapets do.
  void add_walls() {
    const PlanTriangles roofs(mesh_, triangles_of_possible_roofs());
    if (roofs.empty()) return;
    const std::vector<std::uint8_t> walls = are_walls();
    for_each_edge(edge_uses(mesh_, walls), [&](std::span<const EdgeUse> uses) {
      // What goes on above it is no upper edge.
      if (uses.size() == 1 && is_top_of_wall(uses[0])) add_wall(uses[0], roofs);
    });
    const WallTriangles parapets(mesh_, walls);
    for_each_edge(edge_uses(mesh_, is_of_sheet_), [&](std::span<const EdgeUse> uses) {
      const auto b = static_cast<std::size_t>(bodies_.triangle_body[uses[0].triangle()]);
      if (uses.size() == 1 && may_be_roof(b)) of_body_[b].held_m += length_at(parapets, uses[0]);
    });
  }
  /// Whether walls hold the body, and most of it is open to the sky.
  bool is_roof(std::size_t body) const {
    return is_held(body) && of_body_[body].covered_m2 <= most_covered * of_body_[body].upward_m2;
  }
  /// Measures what of those that walls hold has something above it: triangles by their middles.
  void find_covered() {
    std::vector<std::size_t> asked, leaning;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const auto slope = slope_of(mesh_, t);
      if (!slope || *slope == Slope::upright) continue;
      leaning.push_back(t);
      const auto b = bodies_.triangle_body[t];
      if (*slope == Slope::upward && b >= 0 && is_held(static_cast<std::size_t>(b)))
        asked.push_back(t);
    }
    if (asked.empty()) return;
    const PlanTriangles others(mesh_, std::move(leaning));
    for (const auto t : asked) {
      const Vec3 middle = (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3;
      bool is_covered = false;
      others.visit_heights(middle.x, middle.y, [&](std::size_t, double z) {
        is_covered = is_covered || z > middle.z + below_m;
      });
      if (is_covered) of(t).covered_m2 += mesh_.area_m2(t);
    }
  }

 private:
  struct Sheet {
    double upward_m2 = 0, upright_m2 = 0, downward_m2 = 0;
    double open_m = 0;  ///< its open edges
    double held_m = 0;  ///< where walls end at it, or it at walls
    double covered_m2 = 0;
  };
  Sheet& of(std::size_t t) { return of_body_[static_cast<std::size_t>(bodies_.triangle_body[t])]; }

  std::vector<std::size_t> triangles_of_possible_roofs() const {
    std::vector<std::size_t> upward;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
      if (const auto b = bodies_.triangle_body[t];
          b >= 0 && slope_of(mesh_, t) == Slope::upward && may_be_roof(static_cast<std::size_t>(b)))
        upward.push_back(t);
    return upward;
  }
  /// One flag per triangle.
  std::vector<std::uint8_t> are_walls() const {
    std::vector<std::uint8_t> flags(mesh_.triangle_count(), 0);
    for (std::size_t t = 0; t < flags.size(); ++t)
      flags[t] = bodies_.triangle_body[t] >= 0 && slope_of(mesh_, t) == Slope::upright;
    return flags;
  }

  Vec3 low(const EdgeUse& use) const { return mesh_.vertices[static_cast<std::size_t>(use.low)]; }
  Vec3 high(const EdgeUse& use) const { return mesh_.vertices[static_cast<std::size_t>(use.high)]; }
  double length_in_plan(const EdgeUse& use) const {
    const Vec3 along = high(use) - low(use);
    return std::hypot(along.x, along.y);
  }
  /// The triangle hangs below the edge, which is not upright.
  bool is_top_of_wall(const EdgeUse& use) const {
    const Vec3 apex = apex_of(mesh_, use);
    const Vec3 along = high(use) - low(use);
    const double in_plan = length_in_plan(use);
    if (!(in_plan > std::abs(along.z) / 4)) return false;
    const double share =
        ((apex.x - low(use).x) * along.x + (apex.y - low(use).y) * along.y) / (in_plan * in_plan);
    return apex.z < low(use).z + share * along.z;
  }
  /// Length in plan of what of a sheet's edge ends at walls that go on above and below, and look
  /// away from the sheet. (Terrain ends at walls that look at it.)
  double length_at(const WallTriangles& walls, const EdgeUse& use) const {
    constexpr int pieces = 4;
    const Vec3 apex = apex_of(mesh_, use);
    const Vec3 along = high(use) - low(use), inward = apex - low(use) - along / 2;
    int at_walls = 0;
    for (int k = 0; k < pieces; ++k) {
      const Vec3 p = low(use) + along * ((k + 0.5) / pieces);
      at_walls += walls.any_at(p + Vec3{0, 0, parapet_m}, {inward.x, inward.y, 0}) &&
                  walls.any_at(p - Vec3{0, 0, wall_below_m}, {inward.x, inward.y, 0});
    }
    return length_in_plan(use) * at_walls / pieces;
  }
  bool is_held(std::size_t body) const {
    const Sheet& sheet = of_body_[body];
    return may_be_roof(body) && sheet.held_m > 0 && sheet.held_m >= least_held * sheet.open_m;
  }
  void add_wall(const EdgeUse& use, const PlanTriangles& roofs) {
    const Vec3 middle = (low(use) + high(use)) / 2, outward = mesh_.area_vector2(use.triangle());
    const double length = std::hypot(outward.x, outward.y);
    if (!(length > 0)) return;
    // The lowest that is no more above it, or below.
    std::optional<std::size_t> held;
    double height = middle.z + below_m;
    for (const double side : {aside_m, -aside_m})
      roofs.visit_heights(middle.x + side * outward.x / length,
                          middle.y + side * outward.y / length, [&](std::size_t t, double z) {
                            const auto b = bodies_.triangle_body[t];
                            if (b == bodies_.triangle_body[use.triangle()]) return;
                            if (z < middle.z - through_m || z > height) return;
                            height = z;
                            held = static_cast<std::size_t>(b);
                          });
    if (held) of_body_[*held].held_m += length_in_plan(use);
  }

  const Mesh& mesh_;
  const Bodies& bodies_;
  std::vector<Sheet> of_body_;
  std::vector<std::uint8_t> is_of_sheet_;  ///< per triangle: of an open body
};

}  // namespace

std::vector<std::uint8_t> roof_sheets(const Mesh& mesh, const Bodies& bodies) {
  Sheets sheets(mesh, bodies);
  sheets.add_walls();
  sheets.find_covered();
  std::vector<std::uint8_t> flags(bodies.bodies.size(), 0);
  for (std::size_t b = 0; b < flags.size(); ++b) flags[b] = sheets.is_roof(b);
  return flags;
}

}  // namespace sunload
