// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/covers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/base/check.h"
#include "geo/mesh/covered.h"
#include "geo/mesh/overlap.h"
#include "geo/mesh/plumb_line.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr double contact_ratio = 1e-4;
// Pairs of triangles compared: cities have some ten for each triangle.
constexpr std::size_t most_pairs = 500'000'000;

}  // namespace

Covers::Covers(const Mesh& mesh, const Bodies& bodies, const std::vector<std::uint8_t>& is_opaque,
               const std::vector<std::uint8_t>& seals, const std::vector<std::uint8_t>& emits)
    : mesh_(mesh),
      bodies_(bodies),
      is_opaque_(is_opaque),
      seals_(seals),
      emits_(emits),
      open_houses_(mesh, bodies, is_opaque) {
  const Box box = bounding_box(mesh.vertices);
  contact_ = std::min(contact_m, contact_ratio * norm(box.high - box.low));
  same_place_ = same_place_m(mesh);
  find_solids();
  find_land();
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    boxes.push_back(box_around({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}));
    const double length = norm(mesh.area_vector2(t));
    normal_.push_back(length > 0 ? mesh.area_vector2(t) / length : Vec3{});
  }
  tree_ = BoxTree(std::move(boxes));
}

/// From where on triangles are of no matter to each other.
double Covers::reach_m() const { return std::max(looked_at_m(), same_place_); }

void Covers::count_pair() const {
  if (++pairs_ <= most_pairs) return;
  throw InputError({}, "more triangles overlap than can be compared",
                   "what lies inside of bodies cannot be told from what does not",
                   "is geometry there many times over? scene.repair: none leaves it as it is");
}

bool Covers::are_of_one_body(std::size_t t, std::size_t u) const {
  const auto b = bodies_.triangle_body[t];
  return b >= 0 && b == bodies_.triangle_body[u];
}

bool Covers::is_taken(std::size_t t, std::size_t u) const {
  if (!is_opaque_[u] || !mesh_.bears_patches(u)) return false;
  const auto rank = [&](std::size_t x) { return std::pair(emits(x), faces_both(x)); };
  if (rank(t) == rank(u) ? u > t : rank(u) < rank(t)) return false;
  if (faces_both(t) && !faces_both(u)) return false;
  if (!faces_both(u) && dot(normal_[t], normal_[u]) <= 0) return false;
  return is_near_plane(t, u, same_place_) && is_near_plane(u, t, same_place_);
}

bool Covers::is_against(std::size_t t, std::size_t u) const {
  return is_opaque_[u] && mesh_.triangle_sides[t] == Sides::one &&
         dot(normal_[t], normal_[u]) < 0 &&
         (is_near_plane(t, u, contact_) || is_near_plane(u, t, contact_));
}

Covers::Meets Covers::ending(std::size_t t, std::size_t u) const {
  const bool may_end = is_in_solid(u) || (is_land_[u] && !is_land_[t]) ||
                       (is_land_[t] && seals(u)) || (is_relief(t) && open_houses_.is_wall(u));
  if (!may_end || !is_cut(u, t)) return Meets::not_at_all;
  if (is_cut(t, u)) return Meets::through;
  const auto is_before = [&](Vec3 corner) { return distance(t, corner) > looked_at_m(); };
  const auto before = std::ranges::count_if(corners(u), is_before);
  return before > 0 && before < 3 ? Meets::up_to : Meets::not_at_all;
}

bool Covers::is_buried(std::size_t t, Vec3 at) const {
  const Vec3 p = at + looked_at_m() * normal_[t];
  const auto own = bodies_.triangle_body[t];
  // A cavity's fronts look into it: that is no part of the body around.
  int inside = own >= 0 && bodies_.bodies[static_cast<std::size_t>(own)].is_closed &&
                       bodies_.bodies[static_cast<std::size_t>(own)].volume < 0
                   ? -1
                   : 0;
  bool is_below_land = false;
  tree_.visit_meeting({p, {p.x, p.y, 1e300}}, [&](std::size_t u) {
    if (is_in_solid(u) && bodies_.triangle_body[u] != own) {
      const int side = plumb_crossing(corners(u), p.x, p.y);
      if (side != 0 && plane_height(u, p.x, p.y) > p.z) inside += side;
    }
    if (is_land_[u] && !is_land_[t] && !is_below_land) {
      const auto z = height_at(mesh_, u, p.x, p.y);
      is_below_land = z && *z > p.z + contact_;
    }
  });
  return inside > 0 || is_below_land || (is_land_[t] && is_sealed(p)) ||
         (is_relief(t) && open_houses_.hold(p));
}

/// Land just below `p` under a floor, in the pocket that it closes, or inside of what stands on it:
/// above a floor that lies deeper something else of its object must be. Over a cellar land is open.
bool Covers::is_sealed(Vec3 p) const {
  if (seals_.empty()) return false;
  const double land = p.z - 3 * contact_;
  std::vector<ObjectId> floors_below, above;
  bool is_under_floor = false;
  tree_.visit_column(p.x, p.y, [&](std::size_t u) {
    if (is_land_[u]) return;
    const auto z = height_at(mesh_, u, p.x, p.y);
    if (!z) return;
    const bool is_floor = seals(u) && slope_of(mesh_, u) == Slope::downward;
    if (is_floor && *z >= land) is_under_floor = true;
    if (is_floor || *z > land)
      (*z > land ? above : floors_below).push_back(mesh_.triangle_object[u]);
  });
  return is_under_floor || std::ranges::any_of(floors_below, [&](ObjectId object) {
           return std::ranges::find(above, object) != above.end();
         });
}

/// Land of a kind that says so: what a file or a scene of rooms calls ground may be their floor.
bool Covers::is_relief(std::size_t t) const {
  return is_land_[t] && is_land(mesh_.object_kinds[mesh_.triangle_object[t].index()]);
}

bool Covers::is_in_solid(std::size_t t) const {
  const auto b = bodies_.triangle_body[t];
  return b >= 0 && is_solid_[static_cast<std::size_t>(b)] != 0;
}

void Covers::find_solids() {
  for (const Body& body : bodies_.bodies)
    is_solid_.push_back(body.is_closed && !body.is_inside_out);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    const auto b = bodies_.triangle_body[t];
    if (b >= 0 && !is_opaque_[t]) is_solid_[static_cast<std::size_t>(b)] = 0;
  }
}

void Covers::find_land() {
  is_land_.assign(mesh_.triangle_count(), 0);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    if (mesh_.triangle_surface[t] != Surface::ground || is_in_closed(t)) continue;
    const auto& kind = mesh_.object_kinds[mesh_.triangle_object[t].index()];
    const bool may_be_bridge =
        kind == "Road" || kind == "Railway" || kind == "TransportSquare" || kind == "Waterway";
    is_land_[t] = !may_be_bridge && is_opaque_[t] && mesh_.area_vector2(t).z > 0;
  }
}

bool Covers::is_in_closed(std::size_t t) const {
  const auto b = bodies_.triangle_body[t];
  return b >= 0 && bodies_.bodies[static_cast<std::size_t>(b)].is_closed;
}

bool Covers::is_near_plane(std::size_t plane, std::size_t of, double within) const {
  for (int k = 0; k < 3; ++k)
    if (std::abs(distance(plane, mesh_.corner(of, k))) > within) return false;
  return true;
}

bool Covers::is_cut(std::size_t plane, std::size_t of) const {
  bool above = false, below = false;
  for (int k = 0; k < 3; ++k) {
    const double d = distance(plane, mesh_.corner(of, k));
    above |= d > contact_;
    below |= d < -contact_;
  }
  return above && below;
}

double Covers::plane_height(std::size_t t, double x, double y) const {
  const Vec3 a = mesh_.corner(t, 0), n = normal_[t];
  return n.z == 0 ? a.z : a.z - (n.x * (x - a.x) + n.y * (y - a.y)) / n.z;
}

}  // namespace sunload
