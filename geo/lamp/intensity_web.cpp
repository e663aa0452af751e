// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/lamp/intensity_web.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {

namespace {

/// The given values on both sides of x, and the weight of the second one.
struct Between {
  std::size_t low, high;
  double weight;
};
Between between(const std::vector<double>& values, double x) {
  const auto above = std::upper_bound(values.begin(), values.end(), x);
  if (above == values.end()) return {values.size() - 1, values.size() - 1, 0};
  const auto high = static_cast<std::size_t>(above - values.begin());
  if (high == 0) return {0, 0, 0};
  return {high - 1, high, (x - values[high - 1]) / (values[high] - values[high - 1])};
}

/// ∫ I sin γ dγ of what is linear from (g0, i0) to (g1, i1).
double zonal(double g0, double i0, double g1, double i1) {
  if (g1 <= g0) return 0;
  const double slope = (i1 - i0) / (g1 - g0);
  return i0 * std::cos(g0) - i1 * std::cos(g1) + slope * (std::sin(g1) - std::sin(g0));
}

}  // namespace

double IntensityWeb::at(double plane_deg, double gamma_deg) const {
  if (gamma_deg < gammas_deg.front() || gamma_deg > gammas_deg.back()) return 0;
  const Between gamma = between(gammas_deg, gamma_deg), plane = between(planes_deg, plane_deg);
  const auto in_plane = [&](std::size_t p) {
    const double* row = intensities.data() + p * gammas_deg.size();
    return row[gamma.low] + (row[gamma.high] - row[gamma.low]) * gamma.weight;
  };
  const double low = in_plane(plane.low);
  return plane.weight == 0 ? low : low + (in_plane(plane.high) - low) * plane.weight;
}

double IntensityWeb::flux() const {
  std::vector<double> of_plane;  // per radian of C
  for (std::size_t p = 0; p < planes_deg.size(); ++p) {
    const double* row = intensities.data() + p * gammas_deg.size();
    double sum = 0;
    for (std::size_t g = 1; g < gammas_deg.size(); ++g)
      sum += zonal(gammas_deg[g - 1] * radians_per_degree, row[g - 1],
                   gammas_deg[g] * radians_per_degree, row[g]);
    of_plane.push_back(sum);
  }
  if (of_plane.size() == 1) return 2 * pi * of_plane.front();
  double flux = 0;
  for (std::size_t p = 1; p < of_plane.size(); ++p)
    flux += (planes_deg[p] - planes_deg[p - 1]) * radians_per_degree *
            (of_plane[p - 1] + of_plane[p]) / 2;
  return flux;
}

double IntensityWeb::largest() const {
  return *std::max_element(intensities.begin(), intensities.end());
}

void expect_valid(const IntensityWeb& web) {
  const auto ascend = [](const std::vector<double>& values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
  };
  SUNLOAD_EXPECT(!web.planes_deg.empty() && web.planes_deg.front() == 0 &&
                     (web.planes_deg.size() == 1 || web.planes_deg.back() == 360) &&
                     ascend(web.planes_deg),
                 "planes of an intensity web");
  SUNLOAD_EXPECT(web.gammas_deg.size() > 1 && web.gammas_deg.front() >= 0 &&
                     web.gammas_deg.back() <= 180 && ascend(web.gammas_deg),
                 "angles of an intensity web");
  SUNLOAD_EXPECT(web.intensities.size() == web.planes_deg.size() * web.gammas_deg.size() &&
                     *std::min_element(web.intensities.begin(), web.intensities.end()) >= 0,
                 "values of an intensity web");
}

}  // namespace sunload
