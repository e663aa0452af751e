// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/lit_shares.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "solver/base/threads.h"
#include "solver/sight/group_shares.h"

namespace sunload {

namespace {

/// Faces are flat within this share of the offset before which nothing shades.
constexpr double flat_offsets = 0.25;
/// Patches that are looked at together, at most.
constexpr std::size_t most_of_group = 32;
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

using Corners = std::array<std::int32_t, 3>;

/// The triangle whose halves these are: two corners are common, one of them in the middle.
Corners whole_of(const Hierarchy& h, const Corners& a, const Corners& b) {
  const auto in = [](const Corners& corners, std::int32_t vertex) {
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  };
  const auto at = [&](std::int32_t vertex) {
    return h.vertices()[static_cast<std::size_t>(vertex)];
  };
  std::int32_t end_a = -1, end_b = -1;
  std::array<std::int32_t, 3> common{-1, -1, -1};
  std::size_t commons = 0;
  for (const auto vertex : a) in(b, vertex) ? common[commons++] = vertex : end_a = vertex;
  for (const auto vertex : b)
    if (!in(a, vertex)) end_b = vertex;
  SUNLOAD_EXPECT(commons == 2 && end_a >= 0 && end_b >= 0, "halves of a triangle share an edge");
  const Vec3 middle = (at(end_a) + at(end_b)) * 0.5;
  const bool first = norm(at(common[0]) - middle) <= norm(at(common[1]) - middle);
  return {end_a, end_b, common[first ? 1 : 0]};
}

}  // namespace

LitShares::LitShares(const Scene& scene, const Hierarchy& hierarchy, double offset_m)
    : hierarchy_(hierarchy),
      offset_m_(offset_m),
      faces_(scene, flat_offsets * offset_m),
      extent_(extent_of(hierarchy)) {
  choose_groups(scene);
}

/// The largest elements that have no more patches than a group may have.
void LitShares::choose_groups(const Scene& scene) {
  const std::size_t patches = hierarchy_.patch_count(), elements = hierarchy_.element_count();
  std::vector<std::size_t> patches_in(elements, 1);
  std::vector<std::int32_t> triangle_of(elements);
  std::vector<Corners> corners(elements);
  for (std::size_t e = 0; e < patches; ++e) {
    corners[e] = hierarchy_.patches()[e].vertices;
    triangle_of[e] = hierarchy_.patches()[e].triangle;
  }
  for (std::size_t e = patches; e < elements; ++e) {
    const auto [a, b] = hierarchy_.halves_of(e - patches);
    patches_in[e] = patches_in[a] + patches_in[b];
    triangle_of[e] = triangle_of[a];
    corners[e] = whole_of(hierarchy_, corners[a], corners[b]);
  }
  std::vector<std::uint32_t> below;
  for (std::size_t e = 0; e < elements; ++e) {
    const auto parent = hierarchy_.parent(e);
    const bool is_part =
        parent >= 0 && patches_in[static_cast<std::size_t>(parent)] <= most_of_group;
    if (patches_in[e] > most_of_group || is_part) continue;
    const std::size_t first = patch_.size();
    for (below.assign(1, static_cast<std::uint32_t>(e)); !below.empty();) {
      const auto element = below.back();
      below.pop_back();
      if (element < patches) {
        patch_.push_back(element);
        continue;
      }
      for (const auto half : hierarchy_.halves_of(element - patches)) below.push_back(half);
    }
    const Vec3 normal = hierarchy_.normal(patch_[first]);
    groups_.push_back({corners[e], first, patch_.size() - first,
                       sends_on(scene.material_of(triangle_of[e])), normal,
                       dot(normal, hierarchy_.corner(patch_[first], 0))});
  }
  // Neighbours stay together.
  std::sort(groups_.begin(), groups_.end(),
            [&](const Group& a, const Group& b) { return patch_[a.first] < patch_[b.first]; });
}

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
    parallel_chunks(groups_.size(), groups_per_chunk, [&](std::size_t begin, std::size_t end) {
      GroupShares work(*this, block, what_sends_on, shares);
      for (std::size_t v = 0; v < count; ++v)
        for (std::size_t g = begin; g < end; ++g) work.tell(groups_[g], *views[v]);
    });
  }
  return shares;
}

}  // namespace sunload
