// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/solid_bodies.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/covers.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/open_below.h"
#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/plumb_line.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

/// The middle of an open lower edge of a wall, and the way into the house in plan.
struct FootPoint {
  Vec3 at, inward;
};

/// Houses without a floor, and what they stand on.
class OpenBelowHouses {
 public:
  OpenBelowHouses(const Mesh& mesh, const Bodies& bodies,
                  const std::vector<std::uint8_t>& is_opaque,
                  const std::vector<std::uint8_t>& are_opaque, std::vector<std::uint8_t>& is_solid,
                  double contact)
      : mesh_(mesh), bodies_(bodies), is_solid_(is_solid), contact_(contact) {
    const OpenBelow open_below(mesh, bodies);
    feet_.resize(bodies.bodies.size());
    is_house_.assign(bodies.bodies.size(), 0);
    for (std::size_t b = 0; b < is_house_.size(); ++b)
      is_house_[b] = are_opaque[b] && open_below.has(static_cast<std::int32_t>(b)) &&
                     !is_land(mesh.object_kinds[bodies.bodies[b].object.index()]);
    if (std::ranges::count(is_house_, 1) == 0) return;
    find_feet();
    find_land(is_opaque);
  }

  /// Some stand on others, so as often as one more is found.
  void find_solids() {
    if (!land_) return;
    std::vector<std::size_t> others;
    for (std::size_t b = 0; b < is_house_.size(); ++b) {
      if (!is_house_[b]) continue;
      is_solid_[b] = is_closed_by([&](const FootPoint& foot) { return is_on_land(foot); }, b);
      if (!is_solid_[b]) others.push_back(b);
    }
    if (others.empty()) return;
    find_triangles_of_solids();
    for (std::size_t before = others.size() + 1; others.size() < before;) {
      before = others.size();
      std::erase_if(others, [&](std::size_t b) {
        is_solid_[b] = is_closed_by(
            [&](const FootPoint& foot) { return is_on_land(foot) || is_on_solid(foot, b); }, b);
        return is_solid_[b] != 0;
      });
    }
  }

 private:
  template <class Closes>
  bool is_closed_by(const Closes& closes, std::size_t b) const {
    return !feet_[b].empty() && std::ranges::all_of(feet_[b], closes);
  }

  std::size_t body(std::size_t t) const {
    return static_cast<std::size_t>(bodies_.triangle_body[t]);
  }
  bool is_of_house(std::size_t t) const {
    return bodies_.triangle_body[t] >= 0 && is_house_[body(t)] != 0;
  }

  void find_feet() {
    std::vector<std::uint8_t> included(mesh_.triangle_count(), 0);
    for (std::size_t t = 0; t < included.size(); ++t) included[t] = is_of_house(t);
    for_each_edge(edge_uses(mesh_, included), [&](std::span<const EdgeUse> uses) {
      for (const EdgeUse& use : uses)
        if (is_alone(use, uses)) feet_[body(use.triangle())].push_back(foot_of(use));
    });
  }

  /// Of its body: houses that touch, or lie in one another, have feet in one place.
  bool is_alone(const EdgeUse& use, std::span<const EdgeUse> uses) const {
    return std::ranges::count_if(uses, [&](const EdgeUse& other) {
             return body(other.triangle()) == body(use.triangle());
           }) == 1;
  }
  FootPoint foot_of(const EdgeUse& use) const {
    const Vec3 outward = mesh_.area_vector2(use.triangle());
    const double length = norm(Vec3{outward.x, outward.y, 0});
    const Vec3 middle = (mesh_.vertices[static_cast<std::size_t>(use.low)] +
                         mesh_.vertices[static_cast<std::size_t>(use.high)]) /
                        2;
    return {middle, length > 0 ? Vec3{-outward.x, -outward.y, 0} / length : Vec3{}};
  }

  void find_land(const std::vector<std::uint8_t>& is_opaque) {
    std::vector<std::size_t> land = land_triangles(mesh_);
    std::erase_if(land, [&](std::size_t t) { return !is_opaque[t] || bodies_.is_closed(t); });
    land_.emplace(mesh_, std::move(land));
  }

  /// Just beside the wall, inside or outside: land may end at it.
  bool is_on_land(const FootPoint& foot) const {
    bool is_found = false;
    for (const double side : {1.0, -1.0}) {
      const Vec3 p = foot.at + side * beside() * foot.inward;
      land_->visit_heights(p.x, p.y, [&](std::size_t, double z) { is_found |= z >= p.z - gap(); });
    }
    return is_found;
  }

  bool is_on_solid(const FootPoint& foot, std::size_t house) const {
    const Vec3 p = foot.at + beside() * foot.inward - Vec3{0, 0, gap()};
    int inside = 0;
    tree_.visit_meeting({p, {p.x, p.y, std::numeric_limits<double>::infinity()}},
                        [&](std::size_t i) {
                          const std::size_t t = triangle_[i];
                          if (body(t) == house || !is_solid_[body(t)]) return;
                          const auto z = height_at(mesh_, t, p.x, p.y);
                          if (z && *z > p.z) inside += plumb_crossing(mesh_.corners(t), p.x, p.y);
                        });
    return inside > 0;
  }

  /// Of all that are solid, or may become so.
  void find_triangles_of_solids() {
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (bodies_.triangle_body[t] < 0 || !(is_solid_[body(t)] || is_house_[body(t)])) continue;
      triangle_.push_back(t);
      boxes.push_back(box_of(mesh_, t));
    }
    tree_ = BoxTree(std::move(boxes));
  }

  double beside() const { return 2 * contact_; }
  double gap() const { return 5 * contact_; }  // beside it on a slope of 45 degrees, and more

  const Mesh& mesh_;
  const Bodies& bodies_;
  std::vector<std::uint8_t>& is_solid_;
  double contact_;
  std::vector<std::uint8_t> is_house_;        ///< per body
  std::vector<std::vector<FootPoint>> feet_;  ///< per body
  std::optional<PlanTriangles> land_;         ///< where there are houses
  std::vector<std::size_t> triangle_;         ///< of the tree
  BoxTree tree_;
};

}  // namespace

std::vector<std::uint8_t> solid_bodies(const Mesh& mesh, const Bodies& bodies,
                                       const std::vector<std::uint8_t>& is_opaque, double contact) {
  const std::vector<std::uint8_t> are_opaque = opaque_bodies(bodies, is_opaque);
  std::vector<std::uint8_t> is_solid = are_opaque;
  for (std::size_t b = 0; b < is_solid.size(); ++b)
    if (!bodies.bodies[b].is_closed || bodies.bodies[b].is_inside_out) is_solid[b] = 0;
  OpenBelowHouses(mesh, bodies, is_opaque, are_opaque, is_solid, contact).find_solids();
  return is_solid;
}

}  // namespace sunload
