// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of mirrors that a beam can reach: its section by their planes.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/first_light/beam_raster.h"
#include "solver/surface/mirror_groups.h"

namespace sunload {

/// Light that leaves parts of mirrors of one normal; receivers see it along the
/// unit direction w.
struct BeamSource {
  Vec3 normal, w;
  double spread = 0;    ///< tangent of the angle by which light may leave w
  double margin_m = 0;  ///< by which its outline is known
};

/// Where that light can fall, seen from far away along w.
class BeamSection {
 public:
  /// `parts` must outlive it.
  BeamSection(const BeamSource& source, const std::vector<ConvexPolygon>& parts);
  /// For each mirror of the group that the light may meet, one polygon that holds all of its lit
  /// part; what stands between is left out of account.
  std::vector<ConvexPolygon> lit(const MirrorGroups& groups, std::size_t group);

 private:
  struct Box {
    double x0, x1, y0, y1, nearest, farthest;  ///< the last two along w
  };
  Box box(const ConvexPolygon& polygon) const;
  /// What of a mirror a part lights, whose light spreads by `beside` [m].
  ConvexPolygon lit_by(const ConvexPolygon& part, ConvexPolygon mirror, double beside) const;
  template <class Visit>
  void for_each_cell(const Box& box, Visit&& visit);

  BeamSource source_;
  const std::vector<ConvexPolygon>& parts_;
  Tangents axes_;
  std::vector<Box> boxes_;
  Box all_;
  int cells_ = 1;  ///< of a grid across w, along each axis
  std::vector<std::vector<std::uint32_t>> parts_of_cell_;
  std::vector<std::uint32_t> asked_;  ///< per part: for which mirror last
  std::uint32_t question_ = 0;
};

}  // namespace sunload
