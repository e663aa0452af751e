// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/horizon.h"

#include <algorithm>
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

std::vector<double> open_shares(const SkyGrid& grid, const Horizon& horizon,
                                const Rotation& scene_from_enu) {
  if (horizon.is_open()) return {};
  constexpr int points = 8;
  const Rotation enu_from_scene = scene_from_enu.inverse();
  std::vector<double> shares;
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    int open = 0;
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) {
        const Vec3 w = grid.direction(cell, (i + 0.5) / points, (j + 0.5) / points);
        if (horizon.is_above(horizontal(enu_from_scene(w)))) ++open;
      }
    shares.push_back(static_cast<double>(open) / (points * points));
  }
  return shares;
}

}  // namespace sunload
