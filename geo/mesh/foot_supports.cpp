// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/foot_supports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr double half = 0.5;
constexpr double inside_m = 0.05;      // behind a wall one asks what is below it
constexpr double well_inside_m = 0.5;  // … and what carries it: outlines overlap by less
constexpr std::array along_edges{0.1, 0.3, 0.5, 0.7, 0.9};  // shares of their length

/// Triangles that look up: roofs, and the model's land.
struct Upward {
  std::vector<std::size_t> roofs, land;
};

Upward upward_triangles(const Mesh& mesh) {
  Upward upward;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (slope_of(mesh, t) != Slope::upward) continue;
    const bool is_of_land = mesh.triangle_surface[t] == Surface::ground ||
                            is_land(mesh.object_kinds[mesh.triangle_object[t].index()]);
    (is_of_land ? upward.land : upward.roofs).push_back(t);
  }
  return upward;
}

/// What carries a foot in part.
struct CarryingBodies {
  std::vector<std::int32_t> bodies;  ///< in order
  double low = infinity;             ///< the lowest point of them, and of what carries them

  bool have(std::int32_t body) const { return std::ranges::binary_search(bodies, body); }
  bool share_one_with(const CarryingBodies& other) const {
    return std::ranges::any_of(bodies, [&](std::int32_t body) { return other.have(body); });
  }
};

class FootSupports {
 public:
  FootSupports(const Mesh& mesh, const Bodies& bodies, std::vector<Foot>& feet)
      : FootSupports(mesh, bodies, feet, upward_triangles(mesh)) {}

  void run() {
    find_stacked();
    carriers_.resize(feet_.size());
    find_carriers_at_edges();
    find_carriers_below_floors();
    find_lows();
    for (const std::size_t f : resting()) feet_[f].stance = Stance::body;
  }

 private:
  FootSupports(const Mesh& mesh, const Bodies& bodies, std::vector<Foot>& feet, Upward upward)
      : mesh_(mesh),
        bodies_(bodies),
        feet_(feet),
        roof_triangles_(upward.roofs),
        roofs_(mesh, std::move(upward.roofs)),
        land_(mesh, std::move(upward.land)) {}

  const Body& body(std::int32_t b) const { return bodies_.bodies[static_cast<std::size_t>(b)]; }

  static double length_of(const Foot& foot, std::size_t edge) {
    return norm(foot.edges[edge][1] - foot.edges[edge][0]);
  }

  /// The point of a lower edge, at a share of its length, behind the wall above.
  Vec3 behind_wall(const Foot& foot, std::size_t edge, double share, double distance_m) const {
    const auto& [a, b] = foot.edges[edge];
    return a + share * (b - a) - distance_m * normalized(mesh_.area_vector2(foot.walls[edge]));
  }

  /// Of another body, and no higher than at the foot.
  bool has_roof_below(const Foot& foot, Vec3 p) const {
    bool is_there = false;
    roofs_.visit_heights(p.x, p.y, [&](std::size_t t, double z) {
      is_there |= bodies_.triangle_body[t] != foot.body && z <= p.z + foot_tolerance(infinity);
    });
    return is_there;
  }

  void find_stacked() {
    for (Foot& foot : feet_) {
      double supported = 0, all = 0;
      for (std::size_t e = 0; e < foot.edges.size(); ++e) {
        all += length_of(foot, e);
        if (has_roof_below(foot, behind_wall(foot, e, half, inside_m)))
          supported += length_of(foot, e);
      }
      if (supported > half * all) foot.stance = Stance::body;
    }
  }

  bool may_carry(std::int32_t lower, const Foot& foot) const {
    return lower >= 0 && lower != foot.body &&
           body(lower).box.low.z < foot.box.low.z - foot_tolerance(infinity);
  }

  void add_carrier(std::size_t f, std::int32_t lower) {
    CarryingBodies& carriers = carriers_[f];
    if (carriers.have(lower)) return;
    carriers.bodies.insert(std::ranges::upper_bound(carriers.bodies, lower), lower);
  }

  /// Down to what carries all: a deck may be thin, and stand on columns.
  void find_lows() {
    std::vector<std::size_t> lowest_first(feet_.size());
    std::iota(lowest_first.begin(), lowest_first.end(), std::size_t{0});
    std::ranges::stable_sort(lowest_first, {},
                             [&](std::size_t f) { return body(feet_[f].body).box.low.z; });
    std::vector<double> low(bodies_.bodies.size());
    for (std::size_t b = 0; b < low.size(); ++b) low[b] = bodies_.bodies[b].box.low.z;
    for (const std::size_t f : lowest_first) {
      for (const auto lower : carriers_[f].bodies)
        carriers_[f].low = std::min(carriers_[f].low, low[static_cast<std::size_t>(lower)]);
      double& own = low[static_cast<std::size_t>(feet_[f].body)];
      own = std::min(own, carriers_[f].low);
    }
  }

  void find_carriers_at_edges() {
    constexpr double least_share = 0.1;
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      const Foot& foot = feet_[f];
      std::map<std::int32_t, double> touched;
      double all = 0;
      for (std::size_t e = 0; e < foot.edges.size(); ++e)
        for (const double share : along_edges) {
          all += length_of(foot, e);
          const Vec3 p = behind_wall(foot, e, share, well_inside_m);
          roofs_.visit_heights(p.x, p.y, [&](std::size_t t, double z) {
            const auto lower = bodies_.triangle_body[t];
            if (std::abs(z - p.z) <= foot_tolerance(infinity) && may_carry(lower, foot))
              touched[lower] += length_of(foot, e);
          });
        }
      for (const auto& [lower, length] : touched)
        if (length >= least_share * all) add_carrier(f, lower);
    }
  }

  /// Columns and cores, which touch no edge.
  void find_carriers_below_floors() {
    std::vector<std::size_t> floors;
    std::map<std::size_t, std::size_t> foot_of;
    for (std::size_t f = 0; f < feet_.size(); ++f)
      for (const std::size_t t : feet_[f].floors) {
        floors.push_back(t);
        foot_of[t] = f;
      }
    const PlanTriangles all_floors(mesh_, std::move(floors));
    for (const std::size_t t : roof_triangles_) {
      const auto lower = bodies_.triangle_body[t];
      const Vec3 p = (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3;
      all_floors.visit_heights(p.x, p.y, [&](std::size_t floor, double z) {
        const std::size_t f = foot_of.at(floor);
        if (std::abs(z - p.z) <= foot_tolerance(infinity) && may_carry(lower, feet_[f]) &&
            lies_below(body(lower).box, feet_[f].box))
          add_carrier(f, lower);
      });
    }
  }

  static bool lies_below(const Box& lower, const Box& foot) {
    const Box within = widened(foot, inside_m);
    return lower.low.x >= within.low.x && lower.high.x <= within.high.x &&
           lower.low.y >= within.low.y && lower.high.y <= within.high.y;
  }

  std::vector<std::size_t> resting() const {
    std::vector<Box> boxes;
    for (const Foot& foot : feet_) boxes.push_back(foot.box);
    const BoxTree tree(std::move(boxes));
    std::vector<std::size_t> found;
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      constexpr double least_rise_m = 0.5;
      const Foot& foot = feet_[f];
      if (foot.stance != Stance::ground || foot.box.low.z - carriers_[f].low < least_rise_m)
        continue;
      const auto is_above = is_above_land(foot);
      if (is_above ? *is_above : is_above_bodies_about(f, tree)) found.push_back(f);
    }
    return found;
  }

  /// Whether most of the free part of a foot is; nothing where the model has no land there.
  std::optional<bool> is_above_land(const Foot& foot) const {
    constexpr double on_land_m = 1;  // what land may be off, and a plinth
    double above = 0, on = 0;
    for (std::size_t e = 0; e < foot.edges.size(); ++e)
      for (const double share : along_edges) {
        const Vec3 p = behind_wall(foot, e, share, inside_m);
        if (has_roof_below(foot, p)) continue;
        double highest = -infinity;
        land_.visit_heights(p.x, p.y,
                            [&](std::size_t, double z) { highest = std::max(highest, z); });
        if (highest > -infinity) (highest < p.z - on_land_m ? above : on) += length_of(foot, e);
      }
    return above + on > 0 ? std::optional(above > on) : std::nullopt;
  }

  /// By where most of the bodies about stand; by statics where they are divided, or none is there.
  bool is_above_bodies_about(std::size_t f, const BoxTree& tree) const {
    const Foot& foot = feet_[f];
    double nearer_to_foot = 0, nearer_to_carriers = 0;
    tree.visit_meeting(upright(widened(foot.box, foot_reach_m)), [&](std::size_t g) {
      const Foot& other = feet_[g];
      if (g == f || other.stance != Stance::ground || carriers_[f].have(other.body) ||
          carriers_[f].share_one_with(carriers_[g]))
        return;
      const double z = other.box.low.z;
      const bool is_nearer = std::abs(z - foot.box.low.z) < std::abs(z - carriers_[f].low);
      (is_nearer ? nearer_to_foot : nearer_to_carriers) += other.plan_m2;
    });
    if (nearer_to_foot != nearer_to_carriers) return nearer_to_foot < nearer_to_carriers;
    return can_stand(f) && !has_cellar(f);
  }

  /// Part of the foot's box that the carriers lie below.
  Box contact(std::size_t f) const {
    Box all;
    for (const auto lower : carriers_[f].bodies) {
      const Box &of = body(lower).box, &foot = feet_[f].box;
      include(all, {std::max(of.low.x, foot.low.x), std::max(of.low.y, foot.low.y), 0});
      include(all, {std::min(of.high.x, foot.high.x), std::min(of.high.y, foot.high.y), 0});
    }
    return all;
  }

  /// Its middle lies above its carriers, or not far off: it would not fall.
  bool can_stand(std::size_t f) const {
    constexpr double built_in = 0.15;  // of its size: walls hold it
    const Box& foot = feet_[f].box;
    const Vec3 middle = (foot.low + foot.high) / 2, size = foot.high - foot.low;
    const Box by = contact(f);
    return middle.x >= by.low.x - built_in * size.x && middle.x <= by.high.x + built_in * size.x &&
           middle.y >= by.low.y - built_in * size.y && middle.y <= by.high.y + built_in * size.y;
  }

  /// All that carries it lies well within its outline, and is more than a core.
  bool has_cellar(std::size_t f) const {
    constexpr double least_share = 0.2;
    const Box by = contact(f), &foot = feet_[f].box;
    const bool is_within = by.low.x > foot.low.x + inside_m && by.high.x < foot.high.x - inside_m &&
                           by.low.y > foot.low.y + inside_m && by.high.y < foot.high.y - inside_m;
    const Vec3 size = by.high - by.low, whole = foot.high - foot.low;
    return is_within && carriers_[f].bodies.size() == 1 &&
           size.x * size.y > least_share * whole.x * whole.y;
  }

  const Mesh& mesh_;
  const Bodies& bodies_;
  std::vector<Foot>& feet_;
  std::vector<std::size_t> roof_triangles_;
  PlanTriangles roofs_, land_;
  std::vector<CarryingBodies> carriers_;  // per foot
};

}  // namespace

void find_supports(const Mesh& mesh, const Bodies& bodies, std::vector<Foot>& feet) {
  FootSupports(mesh, bodies, feet).run();
}

}  // namespace sunload
