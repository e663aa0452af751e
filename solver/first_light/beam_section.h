// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of mirrors that a beam can reach: its section by their planes.
#pragma once

#include <span>
#include <vector>

#include "solver/first_light/beam_raster.h"
#include "solver/sight/box_grid.h"
#include "solver/sight/flat_polygon.h"
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
  std::vector<ConvexPolygon> lit(const MirrorGroups& groups, std::size_t group) const;

 private:
  /// Of parts and mirrors along w.
  struct Depths {
    double nearest = 1e300, farthest = -1e300;
    void include(double depth);
  };
  Depths depths(std::span<const Vec3> polygon) const;
  ViewBox box(std::span<const Vec3> polygon) const;
  /// What of a mirror a part lights, whose light spreads by `beside` [m].
  FlatPolygon lit_by(const ConvexPolygon& part, FlatPolygon mirror, double beside) const;

  BeamSource source_;
  const std::vector<ConvexPolygon>& parts_;
  ViewFrame across_;
  std::vector<Depths> depths_;  ///< of each part
  Depths all_;
  BoxGrid grid_;  ///< of parts
};

}  // namespace sunload
