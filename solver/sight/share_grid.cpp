// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/share_grid.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/cost.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

constexpr double spacing = 0.75 * radians_per_degree;
/// Points below the horizon, and those just above, stand for suns as high as this.
constexpr double lowest_elevation = 0.25 * radians_per_degree;
constexpr auto most_bytes = static_cast<std::size_t>(cost::most_bytes_of_share_grid);

/// Shares in steps of 1/250; then what has none.
constexpr std::uint8_t whole = 250, not_facing = 254, by_rays = 255;

/// Numbers of points: their places along x and y, in squares of 4 × 4 one after the other, so that
/// suns of neighbours are looked at side by side.
constexpr std::uint32_t origin = 512;  // more than the grid's half width, a multiple of 4
std::uint32_t number_of(std::uint32_t x, std::uint32_t y) {
  const std::uint32_t square = (x / 4) * (2 * origin / 4) + y / 4;
  return square * 16 + (x % 4) * 4 + y % 4;
}
using Place = EqualAreaPlace;
Place place_of(std::uint32_t number) {
  const std::uint32_t square = number / 16, squares = 2 * origin / 4;
  const std::uint32_t x = square / squares * 4 + number % 16 / 4,
                      y = square % squares * 4 + number % 4;
  return {(static_cast<double>(x) - origin) * spacing, (static_cast<double>(y) - origin) * spacing};
}

Vec3 sun_at(Place p) {
  const double square = p.x * p.x + p.y * p.y, z = 1 - square / 2;
  if (z >= std::sin(lowest_elevation)) {
    const double k = std::sqrt(1 - square / 4);
    return {k * p.x, k * p.y, z};
  }
  const double across = std::cos(lowest_elevation) / std::sqrt(square);
  return {across * p.x, across * p.y, std::sin(lowest_elevation)};
}

/// The four points about a sun. Weights are whole and add up to `all`, so that sums of codes are
/// exact in single precision, and what is wholly lit at all points is so between them.
constexpr int all = 1 << 16;
static_assert(all * whole < 1 << 24);
struct FourPoints {
  std::array<std::uint32_t, 4> numbers;
  std::array<int, 4> weights;
};
FourPoints points_about_sun(Vec3 sun) {
  const Place p = equal_area_place(sun);
  const double x = p.x / spacing + origin, y = p.y / spacing + origin;
  const auto x0 = static_cast<std::uint32_t>(x), y0 = static_cast<std::uint32_t>(y);
  const double fx = x - x0, fy = y - y0;
  const auto parts = [](double share) { return static_cast<int>(std::lround(share * all)); };
  const int b = parts(fx * (1 - fy)), c = parts((1 - fx) * fy), d = parts(fx * fy);
  return {
      {number_of(x0, y0), number_of(x0 + 1, y0), number_of(x0, y0 + 1), number_of(x0 + 1, y0 + 1)},
      {std::max(0, all - b - c - d), b, c, d}};
}

std::uint8_t code_of(float share, bool faces) {
  if (share < 0) return faces ? by_rays : not_facing;
  return static_cast<std::uint8_t>(std::lround(share * static_cast<float>(whole)));
}

/// The mean of what the four tell; below 0 where rays must.
SUNLOAD_VECTOR_CODE void mean_of_four(const std::uint8_t* __restrict a,
                                      const std::uint8_t* __restrict b,
                                      const std::uint8_t* __restrict c,
                                      const std::uint8_t* __restrict d,
                                      const std::array<int, 4>& weights, std::size_t count,
                                      float* __restrict out) {
  const int wa = weights[0], wb = weights[1], wc = weights[2], wd = weights[3];
  for (std::size_t i = 0; i < count; ++i) {
    const int ca = a[i], cb = b[i], cc = c[i], cd = d[i];
    const int na = ca <= whole ? wa : 0, nb = cb <= whole ? wb : 0, nc = cc <= whole ? wc : 0,
              nd = cd <= whole ? wd : 0;
    const int known = na + nb + nc + nd, sum = na * ca + nb * cb + nc * cc + nd * cd;
    const bool tells =
        (ca != by_rays) & (cb != by_rays) & (cc != by_rays) & (cd != by_rays) & (known > 0);
    const float mean = static_cast<float>(sum) / static_cast<float>((tells ? known : 1) * whole);
    out[i] = tells ? mean : LitShares::by_rays;
  }
}

}  // namespace

EqualAreaPlace equal_area_place(Vec3 direction) {
  const double k = std::sqrt(2 / (1 + direction.z));
  return {k * direction.x, k * direction.y};
}

std::size_t ShareGrid::points_about(std::span<const Vec3> suns) {
  std::set<std::uint32_t> numbers;
  for (const Vec3 sun : suns)
    for (const auto number : points_about_sun(sun).numbers) numbers.insert(number);
  return numbers.size();
}

void ShareGrid::prepare(std::span<const IntervalLight> suns) const {
  const std::lock_guard lock(mutex_);
  tell_points_about(suns);
}

Columns ShareGrid::of(std::span<const IntervalLight> block) const {
  const std::lock_guard lock(mutex_);
  tell_points_about(block);
  return interpolated(block);
}

void ShareGrid::tell_points_about(std::span<const IntervalLight> suns) const {
  ++question_;
  std::set<std::uint32_t> wanted;
  for (const IntervalLight& sun : suns) {
    SUNLOAD_EXPECT(sun.disk_half_angle <= 0, "suns without a disk");
    if (!sun.has_sun()) continue;
    for (const auto number : points_about_sun(sun.direction).numbers) wanted.insert(number);
  }
  std::vector<std::uint32_t> missing;
  for (const auto number : wanted) {
    const auto known = points_.find(number);
    if (known == points_.end())
      missing.push_back(number);
    else
      known->second.asked = question_;
  }
  forget_old(missing.size());
  tell_points(missing);
}

/// Those that nobody has asked for longest, and not now.
void ShareGrid::forget_old(std::size_t to_come) const {
  const std::size_t patches = std::max<std::size_t>(shares_.hierarchy().patch_count(), 1);
  const std::size_t room = most_bytes / patches;
  while (points_.size() + to_come > room) {
    const auto oldest = std::ranges::min_element(
        points_, {}, [](const auto& numbered) { return numbered.second.asked; });
    if (oldest == points_.end() || oldest->second.asked == question_) return;
    points_.erase(oldest);
  }
}

void ShareGrid::tell_points(const std::vector<std::uint32_t>& numbers) const {
  const Hierarchy& mesh = shares_.hierarchy();
  for (std::size_t first = 0; first < numbers.size(); first += block_width) {
    const std::size_t count = std::min(block_width, numbers.size() - first);
    std::vector<IntervalLight> suns(count);
    std::vector<Codes*> codes;
    for (std::size_t k = 0; k < count; ++k) {
      suns[k].direction = sun_at(place_of(numbers[first + k]));
      suns[k].dni = suns[k].length_s = suns[k].sunlit_s = 1;
      Point& point = points_[numbers[first + k]];
      point.asked = question_;
      point.codes.resize(mesh.patch_count());
      codes.push_back(&point.codes);
    }
    const Columns shares = shares_.of(suns, SendsOn::as_others);
    parallel_for(
        mesh.patch_count(),
        [&](std::size_t i) {
          const Vec3 normal = mesh.normal(i);
          for (std::size_t k = 0; k < count; ++k)
            (*codes[k])[i] =
                code_of(shares[i * block_width + k], dot(normal, suns[k].direction) > 0);
        },
        receivers_per_chunk);
  }
}

Columns ShareGrid::interpolated(std::span<const IntervalLight> block) const {
  struct Sun {
    std::size_t k;
    std::array<const std::uint8_t*, 4> codes;
    std::array<int, 4> weights;
  };
  std::vector<Sun> suns;
  for (std::size_t k = 0; k < block.size(); ++k) {
    if (!block[k].has_sun()) continue;
    const FourPoints about = points_about_sun(block[k].direction);
    Sun one{k, {}, about.weights};
    for (std::size_t c = 0; c < 4; ++c) one.codes[c] = points_.at(about.numbers[c]).codes.data();
    suns.push_back(one);
  }
  const std::size_t patches = shares_.hierarchy().patch_count();
  Columns shares = large_filled(patches * block_width, LitShares::by_rays);
  parallel_chunks(patches, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    std::array<float, receivers_per_chunk> of_sun;
    for (const auto& [k, codes, weights] : suns) {
      mean_of_four(codes[0] + begin, codes[1] + begin, codes[2] + begin, codes[3] + begin, weights,
                   end - begin, of_sun.data());
      for (std::size_t i = begin; i < end; ++i) shares[i * block_width + k] = of_sun[i - begin];
    }
  });
  return shares;
}

}  // namespace sunload
