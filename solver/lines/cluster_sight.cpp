// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/cluster_sight.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/base/keys.h"
#include "solver/base/rng.h"
#include "solver/base/sampling.h"
#include "solver/base/threads.h"
#include "solver/mesh/point_pairs.h"

namespace sunload {

namespace {

/// Pairs of points that tell how well a group of patches sees a cluster.
constexpr int fewest_pairs = packet_size, most_pairs = 16 * packet_size;
/// Groups and clusters before and after one along the curve that are around it.
constexpr std::size_t groups_around = 8, clusters_around = 4;

constexpr std::size_t groups_per_task = 8;

}  // namespace

struct ClusterSight::View {
  const Hierarchy& hierarchy;
  const RayCaster& caster;
  const BrightSurfaces& surfaces;
  std::uint64_t seed;
};

ClusterSight::ClusterSight(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                           const BrightSurfaces& surfaces, double rays, std::uint64_t seed)
    : clusters_(surfaces.clusters().size()) {
  if (!surfaces.any()) return;
  const View view{hierarchy, caster, surfaces, seed};
  group_patches(view, scene, rays);
  shares_.assign(groups_.size() * clusters_, {0, 0, 0});
  parallel_for(
      groups_.size(),
      [&](std::size_t g) {
        for (std::size_t c = 0; c < clusters_; ++c)
          if (may_face(view, g, c)) see(view, g, c, shares_[g * clusters_ + c]);
      },
      groups_per_task);
  look_around(view);
}

void ClusterSight::group_patches(const View& view, const Scene& scene, double rays) {
  const Hierarchy& hierarchy = view.hierarchy;
  std::vector<std::uint32_t> all(hierarchy.patch_count());
  std::iota(all.begin(), all.end(), 0u);
  const double pairs = rays / (static_cast<double>(clusters_) * static_cast<double>(all.size()));
  pairs_ = static_cast<int>(std::clamp(pairs, double{fewest_pairs}, double{most_pairs}));
  pairs_ -= pairs_ % static_cast<int>(packet_size);
  const auto each = static_cast<std::size_t>(std::ceil(std::max(1.0, fewest_pairs / pairs)));
  group_of_patch_.resize(all.size());
  const auto of_object = ranks_of_objects(scene.mesh);
  std::vector<std::uint32_t> rank;
  for (const auto& patch : hierarchy.patches())
    rank.push_back(
        of_object[scene.mesh.triangle_object[static_cast<std::size_t>(patch.triangle)].index()]);
  const auto order = in_neighbourhoods(hierarchy, std::move(all), rank);
  for (std::size_t k = 0; k < order.size(); ++k) {
    // Rather smaller groups than groups across edges, as long as they are not many more.
    const auto alike = [&](std::size_t one, std::size_t other) {
      return rank[order[one]] == rank[order[other]] &&
             facing(hierarchy.normal(order[one])) == facing(hierarchy.normal(order[other]));
    };
    const std::size_t size = k == 0 ? each : groups_.back().size();
    if (size >= each || (4 * size >= each && !alike(k, k - 1))) groups_.emplace_back();
    groups_.back().push_back(order[k]);
    group_of_patch_[order[k]] = static_cast<std::uint32_t>(groups_.size() - 1);
  }
}

/// Does a patch of a group have the cluster, or a part of it, in front?
bool ClusterSight::may_face(const View& view, std::size_t g, std::size_t c) const {
  const BrightCluster& cluster = view.surfaces.clusters()[c];
  return std::any_of(groups_[g].begin(), groups_[g].end(), [&](std::uint32_t patch) {
    const Vec3 n = view.hierarchy.normal(patch);
    return dot(n, cluster.centre - view.hierarchy.centroid(patch)) + cluster.reach(n) > 0;
  });
}

void ClusterSight::see(const View& view, std::size_t g, std::size_t c, Share& share) const {
  const auto& [hierarchy, caster, surfaces, seed] = view;
  const auto seeds = random_words({.seed = seed,
                                   .purpose = Purpose::bright_surfaces,
                                   .element = mixed(hierarchy.key()[groups_[g].front()],
                                                    hierarchy.key()[surfaces.first_of(c).patch])});
  const double offset = caster.offset_m();
  const auto count = static_cast<std::uint32_t>(pairs_);
  double seen = 0, facing = 0;
  for (std::uint32_t pair = 0; pair < count;) {
    PointPairs pairs(caster);
    double cosines[packet_size] = {};
    for (std::size_t l = 0; l < packet_size; ++l, ++pair) {
      const auto patch = groups_[g][pair % groups_[g].size()];
      const Vec3 n = hierarchy.normal(patch);
      const Barycentric at =
          sample_triangle(scrambled_sobol(pair, 0, seeds), scrambled_sobol(pair, 1, seeds));
      const Vec3 x = hierarchy.corner(patch, 0) * at.w0 + hierarchy.corner(patch, 1) * at.w1 +
                     hierarchy.corner(patch, 2) * at.w2 + n * offset;
      const auto y =
          surfaces.point(c, scrambled_sobol(pair, 2, seeds), scrambled_sobol(pair, 3, seeds));
      const auto in_front = pairs.take(l, {x, n}, {y.position, y.normal});
      if (!in_front) continue;
      cosines[l] = in_front->cosines_m2 / in_front->distance_2;
      facing += cosines[l];
    }
    pairs.for_each_seen([&](std::size_t l) { seen += cosines[l]; });
  }
  share.seen = static_cast<float>(seen / count);
  share.facing = static_cast<float>(facing / count);
}

/// What the groups and clusters around see of each other, of those that face alike.
void ClusterSight::look_around(const View& view) {
  const std::size_t clusters = clusters_;
  const auto group_faces = [&](std::size_t g) {
    return facing(view.hierarchy.normal(groups_[g].front()));
  };
  const auto cluster_faces = [&](std::size_t c) {
    return facing(view.surfaces.first_of(c).normal);
  };
  const auto around = [](std::size_t i, std::size_t count, std::size_t reach, auto&& faces,
                         auto&& visit) {
    const std::size_t last = std::min(i + reach, count - 1);
    for (std::size_t j = i - std::min(i, reach); j <= last; ++j)
      if (faces(j) == faces(i)) visit(j);
  };
  parallel_for(groups_.size(), [&](std::size_t g) {
    std::vector<float> of_groups(clusters, 0.0f);
    around(g, groups_.size(), groups_around, group_faces, [&](std::size_t h) {
      for (std::size_t c = 0; c < clusters; ++c) of_groups[c] += shares_[h * clusters + c].seen;
    });
    for (std::size_t c = 0; c < clusters; ++c)
      around(c, clusters, clusters_around, cluster_faces,
             [&](std::size_t d) { shares_[g * clusters + c].around += of_groups[d]; });
  });
}

}  // namespace sunload
