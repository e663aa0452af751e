// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/sun_block.h"

#include <algorithm>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "solver/base/amount.h"

namespace sunload {

namespace {

bool is_unit(Vec3 direction) {
  constexpr double rounding = 1e-6;
  return std::abs(norm(direction) - 1) < rounding;
}

void expect_sky(const std::vector<double>& sky, std::size_t cells) {
  SUNLOAD_EXPECT(sky.empty() || sky.size() == cells, "a sky of all cells of the grid, or none");
  SUNLOAD_EXPECT(std::all_of(sky.begin(), sky.end(), is_amount),
                 "radiances that are numbers and not below 0");
}

void expect_samples(const std::vector<SunSample>& samples) {
  for (const SunSample& sample : samples) {
    SUNLOAD_EXPECT(is_unit(sample.direction), "directions of unit length");
    SUNLOAD_EXPECT(is_amount(sample.dni_share) && is_amount(sample.time_share),
                   "shares that are numbers and not below 0");
  }
}

void expect_sun(const IntervalLight& sun) {
  const Vec3 w = sun.direction;
  SUNLOAD_EXPECT(std::isfinite(w.x) && std::isfinite(w.y) && std::isfinite(w.z),
                 "a direction of numbers");
  SUNLOAD_EXPECT(!sun.has_sun() || is_unit(w), "a direction of unit length");
  SUNLOAD_EXPECT(is_amount(sun.disk_half_angle) && sun.disk_half_angle < pi / 2,
                 "a disk of the sun that is less than half of all directions");
  expect_samples(sun.sun_samples);
  expect_samples(sun.direct_suns);
}

}  // namespace

void expect_valid(std::span<const IntervalLight> suns, std::size_t sky_cells) {
  for (const IntervalLight& sun : suns) {
    for (const double value : {sun.dni, sun.dhi, sun.ground_exitance})
      SUNLOAD_EXPECT(is_amount(value), "irradiances that are numbers and not below 0");
    for (const double value : {sun.length_s, sun.sunlit_s, sun.sun_share})
      SUNLOAD_EXPECT(is_amount(value), "times that are numbers and not below 0");
    expect_sun(sun);
    expect_sky(sun.sky, sky_cells);
    for (const IntervalLight::Band& band : sun.bands) {
      SUNLOAD_EXPECT(is_amount(band.dni) && is_amount(band.ground_exitance),
                     "irradiances that are numbers and not below 0");
      expect_sky(band.sky, sky_cells);
    }
  }
}

}  // namespace sunload
