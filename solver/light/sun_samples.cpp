// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/sun_samples.h"

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"

namespace sunload {

namespace {

/// That stands for a part of an interval; `number`: among its suns, which tells its random numbers.
IntervalLight sun_of(const IntervalLight& interval, const SunSample& sample, std::size_t number) {
  IntervalLight sun;
  sun.number = interval.number + static_cast<std::uint32_t>(number * most_intervals_of_samples);
  sun.length_s = interval.length_s;
  sun.direction = sample.direction;
  sun.sun_share = sample.time_share;
  sun.dni = interval.dni * sample.dni_share;
  sun.sunlit_s = interval.sunlit_s * sample.time_share;
  sun.disk_half_angle = interval.disk_half_angle;
  return sun;
}

/// The s-th sun of an interval.
IntervalLight sun_sample(const IntervalLight& interval, std::size_t s) {
  if (s == 0 && interval.sun_samples.empty())
    return sun_of(interval, {interval.direction, 1, 1}, 0);
  if (s < interval.sun_samples.size()) return sun_of(interval, interval.sun_samples[s], s);
  IntervalLight none;
  none.number = interval.number;
  none.length_s = interval.length_s;
  return none;
}

void expect_addresses(const IntervalLight& interval, std::size_t suns) {
  SUNLOAD_EXPECT(suns <= most_sun_samples, "suns of an interval");
  SUNLOAD_EXPECT(suns <= 1 || interval.number < most_intervals_of_samples,
                 "addresses of random numbers");
}

}  // namespace

std::vector<std::vector<IntervalLight>> suns_one_by_one(std::span<const IntervalLight> block) {
  std::size_t most = 1;
  for (const IntervalLight& interval : block) most = std::max(most, interval.sun_samples.size());
  std::vector<std::vector<IntervalLight>> suns(most);
  for (const IntervalLight& interval : block) expect_addresses(interval, most);
  for (std::size_t s = 0; s < most; ++s)
    for (const IntervalLight& interval : block) suns[s].push_back(sun_sample(interval, s));
  return suns;
}

bool any_direct_suns(std::span<const IntervalLight> block) {
  return std::ranges::any_of(block, &IntervalLight::has_direct_suns);
}

std::vector<SunRow> direct_suns_in_rows(std::span<const IntervalLight> block) {
  std::vector<SunRow> rows;
  for (std::size_t k = 0; k < block.size(); ++k) {
    const IntervalLight& interval = block[k];
    if (!interval.has_direct_suns()) continue;
    SUNLOAD_EXPECT(interval.sun_samples.size() <= most_suns_beside_direct_ones,
                   "suns of an interval");
    expect_addresses(interval, most_suns_beside_direct_ones + interval.direct_suns.size());
    for (std::size_t s = 0; s < interval.direct_suns.size(); ++s) {
      if (s % block_width == 0) rows.push_back({k, {}});
      rows.back().suns.push_back(
          sun_of(interval, interval.direct_suns[s], most_suns_beside_direct_ones + s));
    }
  }
  return rows;
}

std::size_t net_size(int samples, int realizations) {
  constexpr double rounding = 1e-6;  // of the power
  return static_cast<std::size_t>(std::ceil(samples / std::cbrt(realizations) - rounding));
}

}  // namespace sunload
