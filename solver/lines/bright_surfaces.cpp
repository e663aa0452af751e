// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/bright_surfaces.h"

#include <algorithm>
#include <cmath>

#include "solver/base/sampling.h"

namespace sunload {

namespace {

/// Place along a curve that keeps neighbours together (Morton 1966), 10 bits an axis.
std::uint32_t morton(Vec3 p, const Box& box) {
  const auto spread = [](double x, double low, double high) {
    constexpr double steps = 1023;
    auto bits = static_cast<std::uint32_t>(high > low ? steps * (x - low) / (high - low) : 0);
    bits = (bits | bits << 16) & 0x030000ffu;
    bits = (bits | bits << 8) & 0x0300f00fu;
    bits = (bits | bits << 4) & 0x030c30c3u;
    return (bits | bits << 2) & 0x09249249u;
  };
  return spread(p.x, box.low.x, box.high.x) | spread(p.y, box.low.y, box.high.y) << 1 |
         spread(p.z, box.low.z, box.high.z) << 2;
}

}  // namespace

std::uint32_t facing(Vec3 n) {
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  if (z >= x && z >= y) return n.z > 0 ? 0 : 1;
  if (x >= y) return n.x > 0 ? 2 : 3;
  return n.y > 0 ? 4 : 5;
}

std::vector<std::uint32_t> in_neighbourhoods(const Hierarchy& hierarchy,
                                             std::vector<std::uint32_t> patches,
                                             const std::vector<std::uint32_t>& rank_of_patch) {
  std::vector<Vec3> centroids;
  for (const auto i : patches) centroids.push_back(hierarchy.centroid(i));
  const Box box = bounding_box(centroids);
  struct Placed {
    std::uint32_t rank, facing, place, patch;
    auto operator<=>(const Placed&) const = default;
  };
  std::vector<Placed> placed;
  for (std::size_t k = 0; k < patches.size(); ++k)
    placed.push_back({rank_of_patch[patches[k]], facing(hierarchy.normal(patches[k])),
                      morton(centroids[k], box), patches[k]});
  std::sort(placed.begin(), placed.end());
  for (std::size_t k = 0; k < patches.size(); ++k) patches[k] = placed[k].patch;
  return patches;
}

std::vector<std::uint32_t> ranks_of_objects(const Mesh& mesh) {
  const Box box = bounding_box(mesh.vertices);
  std::vector<std::uint32_t> rank(mesh.object_names.size(), 0);
  for (std::size_t t = mesh.triangle_count(); t-- > 0;)
    rank[mesh.triangle_object[t].index()] = morton(mesh.corner(t, 0), box);
  return rank;
}

BrightSurfaces::BrightSurfaces(const Scene& scene, const Hierarchy& hierarchy,
                               std::span<const double> radiosity, std::size_t clusters) {
  add_sources(scene, hierarchy, radiosity);
  if (any()) cluster_sources(clusters);
}

void BrightSurfaces::add_sources(const Scene& scene, const Hierarchy& hierarchy,
                                 std::span<const double> radiosity) {
  std::vector<std::uint32_t> bright;
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i)
    if (radiosity[i] > 0) bright.push_back(static_cast<std::uint32_t>(i));
  source_of_patch_.assign(hierarchy.patch_count(), -1);
  const std::vector<std::uint32_t> equal(hierarchy.patch_count(), 0);
  for (const auto i : in_neighbourhoods(hierarchy, std::move(bright), equal)) {
    source_of_patch_[i] = static_cast<std::int32_t>(sources_.size());
    const Vec3 a = hierarchy.corner(i, 0);
    const auto t = static_cast<std::size_t>(hierarchy.patches()[i].triangle);
    sources_.push_back({a, hierarchy.corner(i, 1) - a, hierarchy.corner(i, 2) - a,
                        hierarchy.normal(i), radiosity[i], hierarchy.area()[i],
                        scene.material_of(t).emission_w_m2, i});
  }
}

void BrightSurfaces::cluster_sources(std::size_t clusters) {
  double power = 0;
  for (const auto& s : sources_) power += s.radiosity * s.area;
  // No cluster has more than this of the sources, nor of their power.
  const std::size_t most = (sources_.size() + clusters - 1) / clusters;
  const double largest = power / static_cast<double>(clusters);
  double of_cluster = 0;
  std::size_t begin = 0;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    of_cluster += sources_[s].radiosity * sources_[s].area;
    const bool is_last = s + 1 == sources_.size();
    if (!is_last && s + 1 - begin < most && of_cluster < largest &&
        facing(sources_[s + 1].normal) == facing(sources_[s].normal))
      continue;
    add_cluster(begin, s + 1);
    begin = s + 1;
    of_cluster = 0;
  }
}

void BrightSurfaces::add_cluster(std::size_t begin, std::size_t end) {
  BrightCluster cluster{begin, end, {}, 0, 0, sources_[begin].normal, 0};
  for (std::size_t s = begin; s < end; ++s) {
    const BrightSource& source = sources_[s];
    const double power = source.radiosity * source.area;
    cluster.centre += power * (source.a + (source.ab + source.ac) / 3);
    cluster.power += power;
    if (!(source.normal == cluster.normal)) cluster.normal = {0, 0, 0};
  }
  cluster.centre = cluster.centre / cluster.power;
  double power = 0;
  for (std::size_t s = begin; s < end; ++s) {
    BrightSource& source = sources_[s];
    for (const Vec3 p : {source.a, source.a + source.ab, source.a + source.ac}) {
      cluster.radius = std::max(cluster.radius, norm(p - cluster.centre));
      cluster.thickness =
          std::max(cluster.thickness, std::abs(dot(cluster.normal, p - cluster.centre)));
    }
    power += source.radiosity * source.area;
    source.cluster = clusters_.size();
    source.up_to = power / cluster.power;
  }
  clusters_.push_back(cluster);
}

/// A disc about the normal, of some thickness; a sphere where there is no common normal.
double BrightCluster::reach(Vec3 n) const {
  const double cosine = std::abs(dot(n, normal));
  return radius * std::sqrt(std::max(0.0, 1 - cosine * cosine)) + thickness * cosine;
}

BrightSurfaces::Point BrightSurfaces::point(std::size_t c, double u, double v) const {
  const BrightCluster& cluster = clusters_[c];
  const auto begin = sources_.begin() + static_cast<std::ptrdiff_t>(cluster.begin);
  const auto last = sources_.begin() + static_cast<std::ptrdiff_t>(cluster.end) - 1;
  const auto chosen = std::upper_bound(
      begin, last, u, [](double share, const BrightSource& s) { return share < s.up_to; });
  // What is left of u after a choice is uniform again.
  constexpr double below_one = 1 - 0x1p-53;
  const double low = chosen == begin ? 0 : (chosen - 1)->up_to;
  const double rest = std::clamp((u - low) / (chosen->up_to - low), 0.0, below_one);
  const Barycentric at = sample_triangle(rest, v);
  return {chosen->a + at.w1 * chosen->ab + at.w2 * chosen->ac, chosen->normal, &*chosen};
}

}  // namespace sunload
