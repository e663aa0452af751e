// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/sun_samples.h"

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"

namespace sunload {

namespace {

/// The s-th sun of an interval.
IntervalLight sun_sample(const IntervalLight& interval, std::size_t s) {
  const std::size_t count = std::max<std::size_t>(interval.sun_samples.size(), 1);
  IntervalLight sun;
  sun.number = interval.number;
  sun.length_s = interval.length_s;
  if (s >= count) return sun;
  sun.number += static_cast<std::uint32_t>(s * most_intervals_of_samples);
  sun.direction = interval.sun_samples.empty() ? interval.direction : interval.sun_samples[s];
  sun.sun_share = 1 / static_cast<double>(count);
  sun.dni = interval.dni * sun.sun_share;
  sun.sunlit_s = interval.sunlit_s * sun.sun_share;
  sun.disk_half_angle = interval.disk_half_angle;
  return sun;
}

}  // namespace

std::vector<std::vector<IntervalLight>> suns_one_by_one(std::span<const IntervalLight> block) {
  std::size_t most = 1;
  for (const IntervalLight& interval : block) most = std::max(most, interval.sun_samples.size());
  SUNLOAD_EXPECT(most <= most_sun_samples, "suns of an interval");
  std::vector<std::vector<IntervalLight>> suns(most);
  for (std::size_t s = 0; s < most; ++s)
    for (const IntervalLight& interval : block) {
      SUNLOAD_EXPECT(most == 1 || interval.number < most_intervals_of_samples,
                     "addresses of random numbers");
      suns[s].push_back(sun_sample(interval, s));
    }
  return suns;
}

std::size_t net_size(int samples, int realizations) {
  constexpr double rounding = 1e-6;  // of the power
  return static_cast<std::size_t>(std::ceil(samples / std::cbrt(realizations) - rounding));
}

}  // namespace sunload
