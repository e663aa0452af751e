// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/horizon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "geo/base/check.h"
#include "geo/sky/sky.h"

namespace sunload {

namespace {

constexpr double zenith_deg = 90;
// Azimuths of a file are written with a digit or two.
constexpr double same_azimuth_deg = 1e-9;

[[noreturn]] void refuse(Horizontal point, const std::string& why) {
  throw InputError({},
                   "horizon: the point at azimuth " + std::to_string(point.azimuth_deg) +
                       ", elevation " + std::to_string(point.elevation_deg) + " cannot be used",
                   why, "elevations are degrees from 0 to below 90");
}

}  // namespace

Horizon::Horizon(std::vector<Horizontal> points) : points_(std::move(points)) {
  for (auto& point : points_) {
    if (!std::isfinite(point.azimuth_deg) || !std::isfinite(point.elevation_deg))
      refuse(point, "it is not finite");
    if (point.elevation_deg < 0 || point.elevation_deg >= zenith_deg)
      refuse(point, "it is below the horizon or at the zenith");
    point.azimuth_deg = wrapped_deg(point.azimuth_deg);
  }
  std::stable_sort(points_.begin(), points_.end(), [](const Horizontal& a, const Horizontal& b) {
    return a.azimuth_deg < b.azimuth_deg;
  });
  const auto same = [](const Horizontal& a, const Horizontal& b) {
    if (b.azimuth_deg - a.azimuth_deg > same_azimuth_deg) return false;
    if (a.elevation_deg != b.elevation_deg) refuse(b, "another elevation is given there");
    return true;
  };
  points_.erase(std::unique(points_.begin(), points_.end(), same), points_.end());
}

double Horizon::elevation_deg(double azimuth_deg) const {
  if (points_.empty()) return 0;
  const double azimuth = wrapped_deg(azimuth_deg);
  const auto after = std::upper_bound(
      points_.begin(), points_.end(), azimuth,
      [](double value, const Horizontal& point) { return value < point.azimuth_deg; });
  const Horizontal& high = after == points_.end() ? points_.front() : *after;
  const Horizontal& low = after == points_.begin() ? points_.back() : *(after - 1);
  const double span = wrapped_deg(high.azimuth_deg - low.azimuth_deg);
  if (span == 0) return low.elevation_deg;  // a single point
  const double share = wrapped_deg(azimuth - low.azimuth_deg) / span;
  return low.elevation_deg + share * (high.elevation_deg - low.elevation_deg);
}

namespace {

/// Share of a triangle in which the linear function with these values at its corners is above
/// zero.
double share_above_zero(std::array<double, 3> at) {
  std::sort(at.begin(), at.end());
  if (at[0] >= 0) return at[2] > 0 ? 1 : 0;
  if (at[2] <= 0) return 0;
  // The corner that is alone on its side of zero cuts off a triangle of its own shape's shares.
  if (at[1] <= 0) return at[2] / (at[2] - at[0]) * (at[2] / (at[2] - at[1]));
  return 1 - at[0] / (at[0] - at[1]) * (at[0] / (at[0] - at[2]));
}

}  // namespace

double open_share(const Horizon& horizon, const std::function<Horizontal(double, double)>& place) {
  constexpr int squares = 4;  // along a side, each of four triangles around its middle
  const auto height = [&](double u, double v) {
    const Horizontal at = place(u / squares, v / squares);
    // Sines: solid angle grows with them.
    return std::sin(radians(at.elevation_deg)) -
           std::sin(radians(horizon.elevation_deg(at.azimuth_deg)));
  };
  std::array<std::array<double, squares + 1>, squares + 1> corner;
  for (std::size_t i = 0; i <= squares; ++i)
    for (std::size_t j = 0; j <= squares; ++j)
      corner[i][j] = height(static_cast<double>(i), static_cast<double>(j));
  double share = 0;
  for (std::size_t i = 0; i < squares; ++i)
    for (std::size_t j = 0; j < squares; ++j) {
      const double middle = height(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5);
      const std::array around{corner[i][j], corner[i + 1][j], corner[i + 1][j + 1],
                              corner[i][j + 1]};
      for (std::size_t k = 0; k < around.size(); ++k)
        share += share_above_zero({middle, around[k], around[(k + 1) % around.size()]});
    }
  return share / (4 * squares * squares);
}

std::vector<double> open_shares(const SkyGrid& grid, const Horizon& horizon,
                                const Rotation& scene_from_enu) {
  if (horizon.is_open()) return {};
  const Rotation enu_from_scene = scene_from_enu.inverse();
  std::vector<double> shares;
  shares.reserve(static_cast<std::size_t>(grid.cell_count()));
  for (int cell = 0; cell < grid.cell_count(); ++cell)
    shares.push_back(open_share(horizon, [&](double u, double v) {
      return horizontal(enu_from_scene(grid.direction(cell, u, v)));
    }));
  return shares;
}

}  // namespace sunload
