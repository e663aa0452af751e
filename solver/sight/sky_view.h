// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What one patch sees of the cells of the sky in which suns stand: those that nothing reaches into
/// from any of its points, and those that one face covers before all of them.
///
/// Seen from the patch, a thing is the set of all differences of their points. Within a sector of
/// azimuth the tangent of elevation is, but for the cosine of half the sector's width, a fraction
/// of linear functions, whose extremes over a convex set are at its corners.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "solver/sight/sun_cells.h"
#include "solver/surface/convex_faces.h"
#include "solver/surface/occluders.h"

namespace sunload {

/// What may stand before the sun.
struct Blockers {
  Occluders triangles;
  std::vector<ConvexFace> faces;  ///< opaque, a little smaller than they are
  BoxTree faces_tree;
  double offset_m;  ///< of the ray caster
};
/// Smaller faces are left out: what they cover is seen from few patches.
Blockers blockers_of(const Mesh& mesh, std::span<const float> transmittance, double offset_m,
                     double least_face_m2);

class SkyView {
 public:
  SkyView(const SunCells& cells, const Blockers& blockers) : cells_(cells), blockers_(blockers) {}

  /// Looks at the sky from a patch; `normal` is that of its side.
  void look(const std::array<Vec3, 3>& corners, Vec3 normal);
  /// Of the cells that are wanted and before the patch: nothing stands there; a face covers it.
  SunCells::Bins open(std::size_t sector) const { return before_[sector] & ~reached_[sector]; }
  SunCells::Bins closed(std::size_t sector) const { return closed_[sector]; }

 private:
  using Sky = SunCells::Sky;
  static constexpr std::size_t most_corners = 8;
  struct Polygon {
    std::array<Vec3, most_corners> p;
    std::size_t size = 0;
    void add(Vec3 v) { p[size++] = v; }
  };
  /// Sectors from the first on, round the north if need be.
  struct Sectors {
    std::size_t first = 0, count = 0;
  };
  struct Extent {
    double low, high;
  };

  void place(const std::array<Vec3, 3>& corners, Vec3 normal);
  void leave_out_what_is_behind();
  bool may_matter(const Box& box) const;
  Sectors sectors_of(const Polygon& thing, double aside) const;
  void cover(const ConvexFace& face);
  Extent covered_at(const ConvexFace& face, std::size_t side) const;
  bool is_surely_met(const ConvexFace& face, std::size_t sector, Extent tangents) const;
  void block(std::size_t triangle);
  static double level_distance(const Polygon& thing);
  void block_in(std::size_t sector, const Polygon& thing);
  static Polygon cut(const Polygon& thing, Vec3 normal, double offset);

  const SunCells& cells_;
  const Blockers& blockers_;
  Vec3 centre_, normal_, half_;
  std::array<Vec3, 3> corner_;  ///< about the centre
  double margin_ = 0;           ///< lateral, for all that moves the rays [m]
  double radius_ = 0;           ///< level, about the centre
  std::array<Extent, SunCells::sectors> along_, across_;  ///< of the corners, per sector
  Sky before_{}, reached_{}, closed_{}, todo_{};
};

}  // namespace sunload
