// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_views.h"

#include <algorithm>
#include <cmath>

#include "solver/base/threads.h"
#include "solver/sight/sky_view.h"

namespace sunload {

namespace {

constexpr std::size_t word_bits = 64, patches_per_chunk = 64;

/// A face covers something for a patch where it is several times as large.
constexpr double faces_of_patch = 4;

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The cells of one sun, by number; empty where one of them is none of the table's.
std::vector<std::size_t> numbers_of(const SunCells& cells, const IntervalLight& sun) {
  std::vector<std::size_t> numbers;
  if (!sun.has_sun()) return numbers;
  for (const auto cell : SunCells::reached_by(sun.direction, sun.disk_half_angle)) {
    const auto number = cells.number_of(cell);
    if (number < 0) return {};
    numbers.push_back(static_cast<std::size_t>(number));
  }
  return numbers;
}

}  // namespace

SunViews::SunViews(const Scene& scene, const Hierarchy& hierarchy, double offset_m,
                   std::span<const Vec3> suns)
    : cells_(suns),
      normal_(hierarchy.patch_count()),
      words_((cells_.count() + word_bits - 1) / word_bits),
      open_(hierarchy.patch_count() * words_, 0),
      closed_(open_) {
  const Blockers blockers = blockers_of(scene.mesh, screens(scene).transmittance, offset_m,
                                        faces_of_patch * median(hierarchy.area()));
  parallel_chunks(normal_.size(), patches_per_chunk, [&](std::size_t begin, std::size_t end) {
    SkyView view(cells_, blockers);
    for (std::size_t i = begin; i < end; ++i) {
      normal_[i] = hierarchy.normal(i);
      view.look({hierarchy.corner(i, 0), hierarchy.corner(i, 1), hierarchy.corner(i, 2)},
                normal_[i]);
      std::size_t number = 0;
      const auto keep = [&](std::vector<std::uint64_t>& table, bool is_so) {
        if (is_so) table[i * words_ + number / word_bits] |= std::uint64_t{1} << number % word_bits;
      };
      for (std::size_t s = 0; s < SunCells::sectors; ++s)
        for (auto left = cells_.wanted()[s]; left != 0; left &= left - 1, ++number) {
          const auto bit = left & (~left + 1);
          keep(open_, (view.open(s) & bit) != 0);
          keep(closed_, (view.closed(s) & bit) != 0);
        }
    }
  });
}

std::vector<SunSight> SunViews::sights(std::span<const IntervalLight> block) const {
  std::vector<SunSight> sights(normal_.size() * block_width, SunSight::unknown);
  std::vector<std::vector<std::size_t>> numbers;
  for (const auto& sun : block) numbers.push_back(numbers_of(cells_, sun));
  const auto all = [&](const std::vector<std::uint64_t>& table, std::size_t patch, std::size_t k) {
    for (const auto number : numbers[k])
      if ((table[patch * words_ + number / word_bits] >> number % word_bits & 1) == 0) return false;
    return true;
  };
  parallel_for(
      normal_.size(),
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block.size(); ++k) {
          if (numbers[k].empty()) continue;
          const double spread =
              block[k].disk_half_angle > 0 ? std::tan(block[k].disk_half_angle) : 0;
          if (dot(normal_[i], block[k].direction) <= spread + least_facing) continue;
          if (all(open_, i, k))
            sights[i * block_width + k] = SunSight::open;
          else if (all(closed_, i, k))
            sights[i * block_width + k] = SunSight::closed;
        }
      },
      patches_per_chunk);
  return sights;
}

}  // namespace sunload
