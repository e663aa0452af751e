// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/shared_samples.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geo/base/units.h"
#include "io/plan/cost.h"
#include "solver/light/sun_block.h"

namespace sunload {

namespace {

/// Of one sun beside another: measured on days of 10 … 60 minutes and weeks of hours.
double drawn_beside(Vec3 sun, Vec3 other) {
  using namespace cost;
  const double angle = std::acos(std::clamp(dot(sun, other), -1.0, 1.0));
  const double apart = angle / (degrees_to_share_rays * radians_per_degree);
  return std::min(1.0, rays_in_one_place + (1 - rays_in_one_place) * apart);
}

}  // namespace

double share_of_samples_drawn(const VariantPlan& plan) {
  double drawn = 0, suns = 0;
  std::vector<Vec3> of_batch;
  for (std::size_t first = 0; first < plan.intervals(); first += plan.batch_suns()) {
    of_batch.clear();
    const std::size_t end = std::min(first + plan.batch_suns(), plan.intervals());
    for (std::size_t k = first; k < end; ++k)
      if (const auto& when = plan.light.intervals[k].when; when.sunlit_s > 0)
        of_batch.push_back(when.direction);
    std::ranges::stable_sort(of_batch, {}, place_in_batch);
    for (std::size_t k = 0; k < of_batch.size(); ++k)
      drawn += k % block_width == 0 ? 1 : drawn_beside(of_batch[k], of_batch[k - 1]);
    suns += static_cast<double>(of_batch.size());
  }
  return suns > 0 ? drawn / suns : 1;
}

}  // namespace sunload
