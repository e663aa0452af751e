// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_cells.h"

namespace sunload {

namespace {

/// Half-angle of the sun's disk in January is 0.00474.
constexpr double largest_disk = 0.0048;
/// What the rounding of directions to single precision turns them by is a tenth of this.
constexpr double rounding = 1e-6;

/// The level direction where a sector begins.
Vec3 side(std::size_t sector) {
  const double angle = 4.0 * static_cast<double>(sector % SunCells::sectors) / SunCells::sectors;
  const double turn = angle < 1 ? angle : angle < 3 ? 2 - angle : angle - 4;
  const double x = (angle < 1 || angle > 3 ? 1 : -1) * (1 - std::abs(turn));
  return normalized({x, turn, 0});
}

}  // namespace

SunCells::SunCells(std::span<const Vec3> suns) {
  for (std::size_t s = 0; s < sectors; ++s) {
    const Vec3 a = side(s), b = side(s + 1), middle = normalized(a + b);
    const Vec3 left{-middle.y, middle.x, 0};
    sector_[s] = {a, middle, left, dot(b, left) / dot(b, middle), dot(b, middle)};
  }
  for (const Vec3 sun : suns)
    for (const Cell cell : reached_by(sun, largest_disk))
      wanted_[cell.sector] |= Bins{1} << cell.bin;
  for (std::size_t s = 0; s < sectors; ++s) {
    first_[s] = static_cast<std::int32_t>(count_);
    count_ += static_cast<std::size_t>(std::popcount(wanted_[s]));
  }
}

std::vector<SunCells::Cell> SunCells::reached_by(Vec3 sun, double half_angle) {
  const double reach = half_angle + rounding;
  const double level = std::hypot(sun.x, sun.y), elevation = std::atan2(sun.z, level);
  constexpr double highest = 1.5;  // above, a disk may reach round the zenith
  if (elevation <= reach || elevation >= highest) return {};
  const double azimuth = std::atan2(sun.y, sun.x), aside = std::asin(std::sin(reach) / level);
  const auto sector_at = [](double a) { return sector_of(std::cos(a), std::sin(a)); };
  const std::size_t last = sector_at(azimuth + aside);
  const std::size_t low = bin_of(std::tan(elevation - reach)),
                    high = bin_of(std::tan(elevation + reach));
  std::vector<Cell> cells;
  for (std::size_t s = sector_at(azimuth - aside);; s = (s + 1) % sectors) {
    for (std::size_t b = low; b <= high; ++b) cells.push_back({s, b});
    if (s == last) return cells;
  }
}

}  // namespace sunload
