// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/land_horizon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geo/base/check.h"

namespace sunload {

namespace {

constexpr double earth_radius_m = 6371e3;
constexpr double refraction_coefficient = 0.13;

class Land {
 public:
  Land(const Raster& raster, double unit_m) : raster_(raster), unit_m_(unit_m) {
    const auto& g = raster.file_from_cell;
    determinant_ = g[1] * g[5] - g[2] * g[4];
    half_cell_m_ = std::sqrt(std::abs(determinant_)) * unit_m / 2;
  }
  double half_cell_m() const { return half_cell_m_; }

  std::optional<double> height_m(double x_m, double y_m) const {
    return height_between_cells(raster_, unit_m_, x_m, y_m);
  }

  /// Distance along the direction to the rim of the raster, from inside.
  double to_rim_m(Vec3 place, double east, double north) const {
    const auto& g = raster_.file_from_cell;
    const double dx = place.x / unit_m_ - g[0], dy = place.y / unit_m_ - g[3];
    const double column = (dx * g[5] - dy * g[2]) / determinant_;
    const double row = (dy * g[1] - dx * g[4]) / determinant_;
    const double columns = (east * g[5] - north * g[2]) / determinant_ / unit_m_;  // of a metre
    const double rows = (north * g[1] - east * g[4]) / determinant_ / unit_m_;
    const auto until = [](double at, double speed, double size) {
      if (speed == 0) return 1e300;
      return ((speed > 0 ? size : 0) - at) / speed;
    };
    return std::min(until(column, columns, static_cast<double>(raster_.columns)),
                    until(row, rows, static_cast<double>(raster_.rows)));
  }

 private:
  const Raster& raster_;
  double unit_m_;
  double determinant_ = 1, half_cell_m_ = 1;
};

}  // namespace

LandHorizon land_horizon(const std::string& path, const Raster& raster, double unit_m,
                         const LandView& view) {
  const Land land(raster, unit_m);
  const auto height = land.height_m(view.place.x, view.place.y);
  if (!height)
    throw InputError({path},
                     fmt::format("the place x = {:.0f} m, y = {:.0f} m lies outside of the "
                                 "raster, or where it has no data",
                                 view.place.x, view.place.y),
                     "", "is it the land around the site?");
  LandHorizon horizon;
  horizon.land_m = *height;
  const double eye = *height + view.above_m;
  const auto steps = static_cast<std::size_t>(std::lround(360 / view.step_deg));
  for (std::size_t s = 0; s < steps; ++s) {
    const double azimuth_deg = 360.0 * static_cast<double>(s) / static_cast<double>(steps);
    const Vec3 way = enu_direction({azimuth_deg - view.grid_north_deg, 0});
    const double end = std::min(view.to_m, land.to_rim_m(view.place, way.x, way.y));
    double steepest = 0, at = 0;
    for (double d = std::max(view.from_m, land.half_cell_m()); d <= end; d += land.half_cell_m()) {
      const auto there = land.height_m(view.place.x + d * way.x, view.place.y + d * way.y);
      if (!there) continue;
      const double fall = (1 - refraction_coefficient) * d * d / (2 * earth_radius_m);
      if (const double slope = (*there - fall - eye) / d; slope > steepest) {
        steepest = slope;
        at = d;
      }
    }
    horizon.points.push_back({azimuth_deg, std::atan(steepest) / radians_per_degree});
    horizon.distance_m.push_back(at);
    horizon.looked_to_m.push_back(end);
  }
  return horizon;
}

}  // namespace sunload
