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

/// What stands highest along a ray: tangent of its elevation, and its distance.
struct Crest {
  double slope = 0, distance_m = 0;
  void take(double slope_there, double distance_there_m) {
    if (!(slope_there > slope)) return;
    slope = slope_there;
    distance_m = distance_there_m;
  }
};

class Land {
 public:
  Land(const Raster& raster, double unit_m)
      : raster_(raster),
        unit_m_(unit_m),
        last_column_(static_cast<double>(raster.columns) - 1),
        last_row_(static_cast<double>(raster.rows) - 1) {
    const auto& g = raster.file_from_cell;
    determinant_ = g[1] * g[5] - g[2] * g[4];
    half_cell_m_ = std::sqrt(std::abs(determinant_)) * unit_m / 2;
  }
  double half_cell_m() const { return half_cell_m_; }

  std::optional<double> height_m(double x_m, double y_m) const {
    return height_between_cells(raster_, unit_m_, x_m, y_m);
  }

  /// Columns and rows from the middle of the first cell, at the place and for each metre on.
  struct Ray {
    double column, row, columns, rows;
  };
  Ray ray(Vec3 place, double east, double north) const {
    const auto& g = raster_.file_from_cell;
    const double dx = place.x / unit_m_ - g[0], dy = place.y / unit_m_ - g[3];
    return {(dx * g[5] - dy * g[2]) / determinant_ - 0.5,
            (dy * g[1] - dx * g[4]) / determinant_ - 0.5,
            (east * g[5] - north * g[2]) / determinant_ / unit_m_,
            (north * g[1] - east * g[4]) / determinant_ / unit_m_};
  }

  /// Distance to the rim of the raster, from inside.
  double to_rim_m(const Ray& ray) const {
    const auto until = [](double at, double speed, double last) {
      if (speed == 0) return 1e300;
      return ((speed > 0 ? last + 0.5 : -0.5) - at) / speed;
    };
    return std::min(until(ray.column, ray.columns, last_column_),
                    until(ray.row, ray.rows, last_row_));
  }

  /// From one line between middles of cells to the next.
  Crest crest(const Ray& ray, double eye_m, double begin_m, double end_m) const {
    Crest crest;
    for (double d = begin_m; d < end_m;) {
      const double next = std::min(
          {end_m, crossing_m(ray.column, ray.columns, d), crossing_m(ray.row, ray.rows, d)});
      look_at_piece(ray, eye_m, d, next, crest);
      d = next;
    }
    return crest;
  }

 private:
  /// Where the ray crosses the next line after the distance d.
  static double crossing_m(double at, double speed, double d) {
    if (speed == 0) return 1e300;
    const double toward = speed > 0 ? 1 : -1;
    double line = toward * (std::floor(toward * (at + d * speed)) + 1);
    double there = (line - at) / speed;
    for (; !(there > d); there = (line - at) / speed) line += toward;  // by rounding
    return there;
  }

  /// Between two lines the height is quadratic along the ray, h = h(0) + p d + q d², and with the
  /// fall f d² and the eye e the slope is (h(0) - e) / d + p + (q - f) d: it is largest at an end,
  /// or where both (h(0) - e) / d² and q - f are the same number below 0.
  void look_at_piece(const Ray& ray, double eye_m, double begin_m, double end_m,
                     Crest& crest) const {
    constexpr double fall = (1 - refraction_coefficient) / (2 * earth_radius_m);
    const double middle = (begin_m + end_m) / 2;
    const Place column = place(ray.column, ray.columns, begin_m, middle, last_column_);
    const Place row = place(ray.row, ray.rows, begin_m, middle, last_row_);
    const double h00 = raster_.at(column.first, row.first) * unit_m_,
                 h10 = raster_.at(column.second, row.first) * unit_m_,
                 h01 = raster_.at(column.first, row.second) * unit_m_,
                 h11 = raster_.at(column.second, row.second) * unit_m_;
    const double of_column = h10 - h00, of_row = h01 - h00, twist = h00 - h10 - h01 + h11;
    // At the beginning: height, and what it gains along the ray.
    const double h =
        h00 + of_column * column.share + of_row * row.share + twist * column.share * row.share;
    const double gain = column.speed * (of_column + twist * row.share) +
                        row.speed * (of_row + twist * column.share);
    const double q = twist * column.speed * row.speed;
    if (std::isnan(h + gain + q)) return;  // no data
    const auto look = [&](double d) {
      const double on = d - begin_m;
      crest.take((h + on * (gain + on * q) - fall * d * d - eye_m) / d, d);
    };
    look(begin_m);
    look(end_m);
    const double at_eye = h - begin_m * (gain - begin_m * q) - eye_m;
    if (at_eye >= 0 || q >= fall) return;
    const double d = std::sqrt(at_eye / (q - fall));
    if (d > begin_m && d < end_m) look(d);
  }

  /// Of a piece along one axis: the two middles between which it lies, the share of the second at
  /// its beginning, and what that gains for each metre. Half a cell at the rim has the height of
  /// its cell.
  struct Place {
    std::size_t first, second;
    double share, speed;
  };
  static Place place(double at, double speed, double begin_m, double middle_m, double last) {
    const double middle = at + middle_m * speed;
    if (!(middle > 0)) return {0, 0, 0, 0};
    if (middle >= last)
      return {static_cast<std::size_t>(last), static_cast<std::size_t>(last), 0, 0};
    const double first = std::floor(middle);
    const auto index = static_cast<std::size_t>(first);
    return {index, index + 1, std::clamp(at + begin_m * speed - first, 0.0, 1.0), speed};
  }

  const Raster& raster_;
  double unit_m_, last_column_, last_row_;
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
    const Land::Ray ray = land.ray(view.place, way.x, way.y);
    const double end = std::min(view.to_m, land.to_rim_m(ray));
    const Crest crest = land.crest(ray, eye, std::max(view.from_m, land.half_cell_m()), end);
    horizon.points.push_back({azimuth_deg, std::atan(crest.slope) / radians_per_degree});
    horizon.distance_m.push_back(crest.distance_m);
    horizon.looked_to_m.push_back(end);
  }
  return horizon;
}

}  // namespace sunload
