/// Diffuse emitters sampled directly (next event), so that no small lamp is missed.
///
/// Irradiance of patch i by emitters of exitance M,
///
///     E_i = 1/A_i ∫∫ M g V dy dx,     g = cosθ_x cosθ_y / (π |y - x|²)  [m-2],
///
/// has two estimates from equally many samples: the patch's lines, which meet y with density
/// g V, and points drawn on the emitters with density q, seen by shadow rays. Together, by the
/// balance heuristic, both contribute
///
///     M g / (g + q)
///
/// for every point that is seen: unbiased for any q ≥ 0, and never above M however near the
/// emitter is (Veach & Guibas 1995, Optimally combining sampling techniques, section 3.2).
/// What mirrors show of emitters is left to the lines alone.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/hierarchy.h"
#include "solver/ray_caster.h"
#include "solver/rng.h"

namespace sunload {

/// Sides of input triangles that emit, in clusters of neighbours.
class Lamps {
 public:
  Lamps(const Scene& scene, const Hierarchy& hierarchy);
  bool any() const { return !sources_.empty(); }

 private:
  friend class LampView;
  struct Source {
    Vec3 a, ab, ac, normal;
    double exitance, area;
    double stopped;            ///< share of rays that a screen stops, 1 for others
    std::int32_t side;         ///< 2·triangle + side
    std::size_t cluster = 0;
    double up_to = 0;          ///< share of the cluster's power, this source included
  };
  struct Cluster {
    std::size_t begin, end;    ///< of sources
    Vec3 centre;
    double radius, power;
  };
  void add_cluster(std::size_t begin, std::size_t end);

  std::vector<Source> sources_;
  std::vector<Cluster> clusters_;
  std::vector<std::int32_t> source_of_side_;  ///< [2·triangle + side], -1: emits nothing
};

/// What one patch chooses emitters by: power over squared distance.
class LampView {
 public:
  explicit LampView(const Lamps& lamps);

  void look_from(const Hierarchy& hierarchy, std::size_t patch);
  /// A point with a unit normal, as sensors are.
  void look_from(Vec3 position, Vec3 normal);

  /// M g / (g + q) of a line that met a front at a distance, along the unit vector w; 0 where
  /// nothing emits. `cos_theta` is that at the line's start.
  double seen_by_line(const Hit& hit, Vec3 w, double cos_theta) const;

  /// Σ M g V / (g + q) over `count` points drawn on the emitters, from points of the patch that
  /// is looked from. `seeds` scramble the low-discrepancy points.
  struct Seen {
    double sum = 0;
    std::uint64_t rays = 0;
  };
  Seen seen_by_points(const RayCaster& caster, const RandomWords& seeds, std::size_t count) const;

 private:
  void choose_clusters();
  struct Point {
    Vec3 position, normal;
    double exitance, density;
  };
  Point point(double u, double v) const;
  double chance(const Lamps::Cluster& cluster) const;
  double density(const Lamps::Source& source) const;

  const Lamps& lamps_;
  Vec3 a_, ab_, ac_, normal_, centroid_;
  double radius_ = 0;
  std::vector<double> chance_, up_to_;  ///< of clusters: probability, and sum up to each
};

}  // namespace sunload
