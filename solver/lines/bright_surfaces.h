// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces that are worth sampling directly: diffuse emitters, and what their light makes bright.
/// solver/lines/bright_view.h tells how they are sampled.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/mesh/hierarchy.h"

namespace sunload {

/// Patches in an order in which neighbours follow each other: by their rank, then by the direction
/// that they face, then along a curve through their centroids (Morton 1966).
std::vector<std::uint32_t> in_neighbourhoods(const Hierarchy& hierarchy,
                                             std::vector<std::uint32_t> patches,
                                             const std::vector<std::uint32_t>& rank_of_patch);
/// Which of the six directions of the axes a normal is nearest to.
std::uint32_t facing(Vec3 normal);
/// Rank of every object: the place of its first triangle along that curve.
std::vector<std::uint32_t> ranks_of_objects(const Mesh& mesh);

/// A patch on which points are drawn.
struct BrightSource {
  Vec3 a, ab, ac, normal;
  double radiosity, area;  ///< estimate [W m-2], exitance included
  double exitance;         ///< known exactly [W m-2]
  std::uint32_t patch;
  std::size_t cluster = 0;
  double up_to = 0;  ///< share of the cluster's power, this source included
};

/// Neighbours that face alike.
struct BrightCluster {
  std::size_t begin, end;  ///< of sources
  Vec3 centre;
  double radius = 0, power = 0;
  Vec3 normal;           ///< of all its sources; 0 where they differ
  double thickness = 0;  ///< largest distance from the centre along the normal
  /// Largest of n·(y - centre) over its points y; n unit.
  double reach(Vec3 n) const;
};

/// Bright patches in clusters of neighbours that face alike; points on a cluster are drawn in
/// proportion to the power of its sources.
class BrightSurfaces {
 public:
  /// None: all light is left to the lines.
  BrightSurfaces() = default;
  /// `radiosity`: estimate per patch [W m-2], exitance included; no points are drawn where it is
  /// 0. About `clusters` clusters are told apart.
  BrightSurfaces(const Scene& scene, const Hierarchy& hierarchy, std::span<const double> radiosity,
                 std::size_t clusters);
  bool any() const { return !sources_.empty(); }
  const std::vector<BrightCluster>& clusters() const { return clusters_; }
  /// The first source of a cluster.
  const BrightSource& first_of(std::size_t cluster) const {
    return sources_[clusters_[cluster].begin];
  }
  /// Null where no points are drawn on a patch.
  const BrightSource* source_of(std::size_t patch) const {
    const auto s = source_of_patch_[patch];
    return s < 0 ? nullptr : &sources_[static_cast<std::size_t>(s)];
  }

  /// A point on a bright patch, with the unit normal of its side.
  struct Point {
    Vec3 position, normal;
    const BrightSource* source;
  };
  /// A point of a cluster, by power; u and v uniform.
  Point point(std::size_t cluster, double u, double v) const;

 private:
  void add_sources(const Scene& scene, const Hierarchy& hierarchy,
                   std::span<const double> radiosity);
  void cluster_sources(std::size_t clusters);
  void add_cluster(std::size_t begin, std::size_t end);

  std::vector<BrightSource> sources_;
  std::vector<BrightCluster> clusters_;
  std::vector<std::int32_t> source_of_patch_;  ///< -1: none
};

}  // namespace sunload
