// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which colour of a palette stands for which value.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace sunload {

/// How colours follow values, evenly or by their logarithms.
enum class ColourScale { linear, logarithmic };

/// What a logarithmic scale spans below its last colour, as powers of ten.
inline constexpr int decades_of_scale = 3;

/// Value of the first colour of a logarithmic scale.
inline double least_of_decades(double largest) {
  return largest * std::pow(10.0, -decades_of_scale);
}

/// Place of a value between those of the first and last colour, in [0, 1]. `least` is above 0 on a
/// logarithmic scale; values may be 0 or below.
inline double colour_share(ColourScale scale, double value, double least, double largest) {
  if (scale == ColourScale::logarithmic && value <= least) return 0;
  const double share = scale == ColourScale::logarithmic
                           ? std::log(value / least) / std::log(largest / least)
                           : (value - least) / (largest - least);
  return std::clamp(share, 0.0, 1.0);
}

/// 1, 2 and 5 times powers of ten from `least` to `largest`, both above 0.
inline std::vector<double> logarithmic_ticks(double least, double largest) {
  constexpr double rounding = 1e-9;
  std::vector<double> ticks;
  const auto exponent = [](double value) {
    return static_cast<int>(std::floor(std::log10(value)));
  };
  for (int e = exponent(least); e <= exponent(largest * (1 + rounding)); ++e)
    for (const double digit : {1.0, 2.0, 5.0})
      if (const double tick = digit * std::pow(10.0, e);
          tick >= least * (1 - rounding) && tick <= largest * (1 + rounding))
        ticks.push_back(tick);
  return ticks;
}

}  // namespace sunload
