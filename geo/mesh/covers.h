// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What can cover triangles: solid bodies, opaque surfaces, land (geo/mesh/covered.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/open_houses.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// Hollows within closed bodies: rooms that a lamp may light, or filled for want of any.
enum class Cavities { lit, dark };

/// Surfaces this near to each other touch: contact_m, of small scenes less (geo/mesh/covered.h).
double contact_of(const Mesh& mesh);

/// Of each body 1 where all of its triangles are opaque, by a flag of each triangle.
std::vector<std::uint8_t> opaque_bodies(const Bodies& bodies,
                                        const std::vector<std::uint8_t>& is_opaque);

/// Answers questions about single triangles and pairs of them, by their numbers in the mesh. Const,
/// but counts the pairs that are visited.
class Covers {
 public:
  /// As of `cut_covered`; all must outlive it.
  Covers(const Mesh& mesh, const Bodies& bodies, const std::vector<std::uint8_t>& is_opaque,
         const std::vector<std::uint8_t>& seals, const std::vector<std::uint8_t>& emits,
         Cavities cavities);

  /// Surfaces this near to each other touch [m].
  double contact() const { return contact_; }
  Vec3 normal(std::size_t t) const { return normal_[t]; }
  std::array<Vec3, 3> corners(std::size_t t) const { return mesh_.corners(t); }

  /// Every other triangle that may touch `piece`, which is `t` or a part of it. Throws InputError
  /// where too many pairs have been visited.
  template <class Visit>
  void visit_near(std::size_t t, const std::array<Vec3, 3>& piece, const Visit& visit) const {
    const Box near = widened(box_around({piece[0], piece[1], piece[2]}), reach_m());
    tree_.visit_meeting(near, [&](std::size_t u) {
      if (u == t) return;
      if (!are_of_one_body(t, u)) count_pair();
      visit(u);
    });
  }
  /// Every edge where land ends above `piece` that may cover it, the end of a sheet of another
  /// body: its ends, straight below on the plane of `t`.
  template <class Visit>
  void visit_rims_above(std::size_t t, const std::array<Vec3, 3>& piece, const Visit& visit) const {
    if (rims_.empty() || !is_relief(t)) return;
    Box above = box_around({piece[0], piece[1], piece[2]});
    above.high.z = std::numeric_limits<double>::infinity();
    rim_tree_.visit_meeting(above, [&](std::size_t i) {
      const Rim& rim = rims_[i];
      if (!may_bury(t, rim.triangle)) return;
      count_pair();
      visit(below(t, rim.ends[0]), below(t, rim.ends[1]));
    });
  }
  std::int32_t body(std::size_t t) const { return bodies_.triangle_body[t]; }  ///< -1: of none
  bool are_of_one_body(std::size_t t, std::size_t u) const;

  /// Whether `u` is in the place of `t` where they overlap, and faces where `t` does. Of two that
  /// are alike the first is there; before others what emits, then windows (as near as the contact,
  /// and light may go through them), then what faces both ways; last bare terrain.
  bool is_taken(std::size_t t, std::size_t u) const;
  /// Whether `u` hides `t`, which faces the same way, from as near as `looked_at_m()` wherever they
  /// overlap: of two that go through each other there one only.
  bool is_behind(std::size_t t, std::size_t u) const;
  /// Whether `t`, which is behind `u`, comes before it somewhere, or so near that it may shade it.
  bool comes_before(std::size_t t, std::size_t u) const;
  /// Front against front, as near as the contact where they overlap; not back to back. Of one body
  /// what is in one place may be either.
  bool is_against(std::size_t t, std::size_t u) const;
  /// Whether the body of `t`, which is a solid, has its inside behind this point of it: of two of
  /// its faces in one place it tells solids that touch from the sides of a sheet.
  bool is_solid_behind(std::size_t t, Vec3 at) const;
  /// How far before a surface it is looked whether it is buried [m].
  double looked_at_m() const { return 2 * contact_; }
  /// How a face, where the inside of a solid or the land ends, meets `t`: it goes through the plane
  /// of t, or ends at it, as land does that has a hole for the house.
  enum class Meets { not_at_all, through, up_to };
  Meets ending(std::size_t t, std::size_t u) const;
  /// Whether the front of `t` at this point of it is inside of a body or below land.
  bool is_buried(std::size_t t, Vec3 at) const;

 private:
  double reach_m() const;
  void count_pair() const;
  bool emits(std::size_t t) const { return !emits_.empty() && emits_[t] != 0; }
  bool faces_both(std::size_t t) const { return mesh_.triangle_sides[t] == Sides::two; }
  bool seals(std::size_t t) const { return !seals_.empty() && seals_[t] != 0; }
  bool is_window(std::size_t t) const { return mesh_.triangle_surface[t] == Surface::window; }
  bool may_replace(std::size_t t, std::size_t u) const;
  int crossing_above(std::size_t u, Vec3 p) const;
  bool reaches_before(std::size_t t, std::int32_t body) const;
  bool may_bury(std::size_t t, std::size_t u) const;
  bool is_sealed(Vec3 p) const;
  bool is_in_house_on_land(Vec3 p) const;
  bool is_relief(std::size_t t) const;
  bool is_bare_terrain(std::size_t t) const;
  bool is_in_solid(std::size_t t) const;
  bool is_in_cavity(std::size_t t) const;
  void find_bodies();
  void find_land();
  void find_rims();
  Vec3 below(std::size_t t, Vec3 p) const { return {p.x, p.y, plane_height(t, p.x, p.y)}; }
  double distance(std::size_t plane, Vec3 p) const {
    return dot(p - mesh_.corner(plane, 0), normal_[plane]);
  }
  /// How far one surface is before another where they overlap [m], by the corners of that.
  struct Gap {
    double least = 0, most = 0, mean = 0;
    bool is_within(double distance_m) const { return most <= distance_m && least >= -distance_m; }
  };
  /// Of `u` before `t`, along the normal of t; of t before u the same but for the sign. Nothing
  /// where they have next to nothing in common, are far from parallel, or too far off to matter.
  std::optional<Gap> gap(std::size_t t, std::size_t u) const;
  bool is_one_place(std::size_t t, std::size_t u, const Gap& between) const;
  bool is_beyond_reach(std::size_t plane, std::size_t of) const;
  bool is_cut(std::size_t plane, std::size_t of) const;
  double plane_height(std::size_t t, double x, double y) const;

  const Mesh& mesh_;
  const Bodies& bodies_;
  const std::vector<std::uint8_t>& is_opaque_;
  const std::vector<std::uint8_t>& seals_;
  const std::vector<std::uint8_t>& emits_;
  Cavities cavities_;
  OpenHouses open_houses_;
  double contact_ = 0, same_place_ = 0;
  std::vector<std::uint8_t> is_solid_;             ///< per body
  std::vector<std::size_t> body_begin_, of_body_;  ///< triangles of bodies, body by body
  std::vector<std::uint8_t> is_land_, is_road_;    ///< per triangle: land but roads, roads
  /// An edge that one triangle of land has alone.
  struct Rim {
    std::array<Vec3, 2> ends;
    std::size_t triangle;
  };
  std::vector<Rim> rims_;  ///< where several bodies of land may lie above each other
  BoxTree rim_tree_;
  std::vector<Vec3> normal_;
  BoxTree tree_;
  mutable std::size_t pairs_ = 0;  ///< visited, of two bodies
};

}  // namespace sunload
