// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/lit_shares.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "solver/base/threads.h"
#include "solver/sight/group_shares.h"

namespace sunload {

namespace {

/// Faces are flat within this share of the offset before which nothing shades.
constexpr double flat_offsets = 0.25;
constexpr std::size_t groups_per_chunk = 16;

/// Width of cells in those of a patch, unless there were more than so many of them for each patch.
constexpr double cell_of_patch = 4, most_cells_for_patch = 4;
constexpr double fewest_cells = 256, most_cells = 1 << 22;
/// Radius of a cluster of suns.
constexpr double widest_cluster = 2 * radians_per_degree;

SunView::Extent extent_of(const Hierarchy& hierarchy) {
  if (hierarchy.patch_count() == 0) return {{0, 0, 0}, 1, 1};
  Box box;
  for (const Vec3& p : hierarchy.vertices()) include(box, p);
  std::vector<double> area = hierarchy.area();
  const auto median = area.begin() + static_cast<std::ptrdiff_t>(area.size() / 2);
  std::nth_element(area.begin(), median, area.end());
  const double radius = norm(box.high - box.low) / 2;
  const double cells =
      std::clamp(most_cells_for_patch * static_cast<double>(area.size()), fewest_cells, most_cells);
  return {centre_of(box), radius,
          std::max(cell_of_patch * std::sqrt(*median), 2 * radius / std::sqrt(cells))};
}

}  // namespace

LitShares::LitShares(const Scene& scene, const Hierarchy& hierarchy, double offset_m)
    : hierarchy_(hierarchy),
      offset_m_(offset_m),
      faces_(scene, flat_offsets * offset_m),
      groups_(scene, hierarchy, faces_),
      extent_(extent_of(hierarchy)) {}

Columns LitShares::of(std::span<const IntervalLight> block, SendsOn what_sends_on) const {
  Columns shares = large_filled(hierarchy_.patch_count() * block_width, by_rays);
  const auto clusters = sun_clusters(block, widest_cluster);
  // Views take memory: no more of them at a time than are made at a time.
  const auto at_once = static_cast<std::size_t>(thread_count());
  std::vector<std::optional<SunView>> views(at_once);
  for (std::size_t first = 0; first < clusters.size(); first += at_once) {
    const std::size_t count = std::min(at_once, clusters.size() - first);
    parallel_for(count,
                 [&](std::size_t v) { views[v].emplace(faces_, extent_, clusters[first + v]); });
    parallel_chunks(groups_.all().size(), groups_per_chunk,
                    [&](std::size_t begin, std::size_t end) {
                      GroupShares work(*this, block, what_sends_on, shares);
                      for (std::size_t v = 0; v < count; ++v)
                        for (std::size_t g = begin; g < end; ++g)
                          work.tell(groups_.all()[g], *views[v]);
                    });
  }
  return shares;
}

}  // namespace sunload
