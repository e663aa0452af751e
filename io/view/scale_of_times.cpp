// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/view/scale_of_times.h"

#include <cmath>
#include <utility>

#include "io/base/statistics.h"
#include "io/result/shown_quantity.h"

namespace sunload {

ScaleOfTimes::ScaleOfTimes(std::vector<double> area) : area_(std::move(area)) {}

void ScaleOfTimes::add(const std::vector<double>& values) {
  const double own = weighted_quantile(values, area_, scale_share);
  if (own > end_) end_ = own;
}

}  // namespace sunload
