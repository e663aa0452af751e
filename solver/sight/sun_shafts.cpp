// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_shafts.h"

#include <algorithm>

#include "geo/base/check.h"
#include "solver/base/threads.h"
#include "solver/sight/shaft_walk.h"

namespace sunload {

namespace {

// A walk through the occluders costs as much as the rays of two or three patches.
constexpr std::uint32_t least_of_group = 4;
// Enough that the walk costs nothing beside what it finds, few enough for threads to share.
constexpr std::uint32_t most_of_group = 1024;
constexpr std::size_t groups_per_chunk = 8;

/// The triangle whose halves these are: two corners are common, one of them in the middle.
SunShafts::Corners whole_of(const Hierarchy& h, const SunShafts::Corners& a,
                            const SunShafts::Corners& b) {
  const auto in = [](const SunShafts::Corners& corners, std::int32_t vertex) {
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

SunShafts::SunShafts(const Scene& scene, const Hierarchy& hierarchy, double offset_m)
    : hierarchy_(hierarchy), offset_m_(offset_m) {
  measure_elements();
  for (std::size_t e = 0; e < hierarchy.element_count(); ++e)
    if (hierarchy.parent(e) < 0) choose_groups(static_cast<Element>(e));
  if (!groups_.empty()) occluders_.emplace(scene.mesh, screens(scene).transmittance);
}

void SunShafts::measure_elements() {
  const std::size_t patches = hierarchy_.patch_count();
  corners_.reserve(hierarchy_.element_count());
  patches_in_.assign(patches, 1);
  patches_in_.reserve(hierarchy_.element_count());
  for (const auto& patch : hierarchy_.patches()) corners_.push_back(patch.vertices);
  for (std::size_t e = patches; e < hierarchy_.element_count(); ++e) {
    const auto [a, b] = hierarchy_.halves_of(e - patches);
    corners_.push_back(whole_of(hierarchy_, corners_[a], corners_[b]));
    patches_in_.push_back(patches_in_[a] + patches_in_[b]);
  }
}

void SunShafts::choose_groups(Element element) {
  if (patches_in_[element] < least_of_group) return;
  if (patches_in_[element] <= most_of_group) {
    groups_.push_back(element);
    return;
  }
  for (const auto half : hierarchy_.halves_of(element - hierarchy_.patch_count()))
    choose_groups(half);
}

std::vector<SunSight> SunShafts::sights(std::span<const IntervalLight> block) const {
  std::vector<SunSight> sights(hierarchy_.patch_count() * block_width, SunSight::unknown);
  parallel_chunks(groups_.size(), groups_per_chunk, [&](std::size_t begin, std::size_t end) {
    ShaftWalk walk(*this, sights);
    for (std::size_t g = begin; g < end; ++g)
      for (std::size_t k = 0; k < block.size(); ++k) walk.run(groups_[g], block[k], k);
  });
  return sights;
}

}  // namespace sunload
