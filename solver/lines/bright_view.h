// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bright surfaces sampled directly (next event), so that no small one is missed.
///
/// Irradiance of patch i by surfaces of radiosity B (their exitance M included),
///
///     E_i = 1/A_i ∫∫ B g V dy dx,     g = cosθ_x cosθ_y / (π |y - x|²)  [m-2],
///
/// has two estimates from equally many samples: the patch's lines, which meet y with density
/// g V, and points drawn on bright surfaces with density q, seen by shadow rays. Together, by
/// the balance heuristic, both contribute
///
///     B g / (g + q)
///
/// for every point that is seen: unbiased for any q ≥ 0, and never above B however near the
/// surface is (Veach & Guibas 1995, Optimally combining sampling techniques, section 3.2).
/// Since g / (g + q) does not know B, it is the weight of a link like any other.
///
/// Points are drawn with q ∝ B' S / d², where B' is an estimate of the radiosity, d the distance of
/// the surface's cluster and S the share of pairs of points, one of a group of neighbouring patches
/// and one of the cluster, that see each other, times their cosines. No number of pairs proves that
/// a cluster is not seen: some points are drawn by the S of groups and clusters around, some by an
/// S as if nothing stood between. Surfaces that are seen by way of mirrors are left to the lines
/// alone.
///
/// In an evenly bright room lines alone are all but exact, and points are noise. So the lines
/// keep a share β of the estimate for themselves: they count β + (1 - β) g / (g + q), points
/// (1 - β) g / (g + q), with a β per patch (solver/gather/guide.h).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/base/rng.h"
#include "solver/lines/bright_surfaces.h"
#include "solver/lines/cluster_sight.h"

namespace sunload {

/// Where points are drawn, and by what: an estimate made before.
struct Guide {
  BrightSurfaces surfaces;
  ClusterSight sight;
  std::vector<float> lines_alone;  ///< β per patch; empty: 0
  bool any() const { return surfaces.any(); }
};

/// Chooses points on bright surfaces for one patch or sensor.
class BrightView {
 public:
  explicit BrightView(const Guide& guide);
  bool any() const { return surfaces_.any(); }

  void look_from(const Hierarchy& hierarchy, std::size_t patch);
  /// A point with a unit normal, as sensors are: sees what faces it.
  void look_from(Vec3 position, Vec3 normal);

  /// Weight of a line along the unit vector w that met a patch; 1 where no points are drawn.
  /// `cos_theta` is that at the line's start.
  double share_of_line(const Hierarchy& hierarchy, const Hit& hit, Vec3 w, double cos_theta) const;

  /// A point of a bright patch that is seen from a point of this one, and its weight.
  struct SeenPoint {
    std::uint32_t patch;
    Vec3 position;
    double distance_m, share, exitance;
  };
  /// Draws `count` points from points of the patch that is looked from and calls
  /// visit(SeenPoint) for those that are seen. `seeds` scramble the low-discrepancy points.
  /// Returns the rays cast.
  std::uint64_t see_points(const RayCaster& caster, const RandomWords& seeds, std::size_t count,
                           const std::function<void(const SeenPoint&)>& visit) const;

 private:
  void choose_clusters(const ClusterSight::Share* shares);
  double chance(const BrightCluster& cluster) const;
  BrightSurfaces::Point point(double u, double v) const;
  double density(const BrightSource& source) const;

  const BrightSurfaces& surfaces_;
  const ClusterSight& sight_;
  const std::vector<float>& lines_alone_;
  double alone_ = 0;  ///< β of what is looked from
  Vec3 a_, ab_, ac_, normal_, centroid_;
  double radius_ = 0;
  std::vector<double> chance_, up_to_;  ///< of clusters: probability, and sum up to each
};

}  // namespace sunload
