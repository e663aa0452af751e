// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Places along a row.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace sunload {

/// Shares of a way of that length at which its start and every further `every_m` lie.
inline std::vector<double> row_shares(double length_m, double every_m) {
  constexpr double rounding = 1e-9;
  const auto steps = static_cast<std::size_t>(length_m / every_m + rounding);
  std::vector<double> shares;
  for (std::size_t s = 0; s <= steps; ++s)
    shares.push_back(length_m > 0 ? static_cast<double>(s) * every_m / length_m : 0);
  return shares;
}

}  // namespace sunload
