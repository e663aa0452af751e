// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/overview.h"

#include <cmath>

namespace sunload {

namespace {

// From where the overview looks, beside the side that light comes from.
constexpr double overview_aside_deg = 45;
// Facades whose normals cancel out to less of their area look all ways.
constexpr double one_sided_share = 0.2;

/// Azimuth from which light comes on the whole, by the sun's and GHI; of what has no sun the side
/// of noon.
double light_azimuth_deg(const ResultReader& result) {
  constexpr double north_deg_of_compass = 0, south_deg_of_compass = 180;
  if (!result.has("sun_azimuth"))
    return result.number_attribute("latitude_deg") < 0 ? north_deg_of_compass
                                                       : south_deg_of_compass;
  const auto azimuth = result.doubles("sun_azimuth"), ghi = result.doubles("ghi");
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < azimuth.size(); ++i) sum += ghi[i] * enu_direction({azimuth[i], 0});
  return norm(sum) > 0 ? horizontal(sum).azimuth_deg : south_deg_of_compass;
}

}  // namespace

double scene_north_deg(const ResultReader& result) {
  if (!result.has("sun_direction")) {
    const double north = result.number_attribute("north_deg");
    return std::isnan(north) ? 0 : north;
  }
  const auto direction = result.doubles("sun_direction"), azimuth = result.doubles("sun_azimuth");
  std::size_t lowest = 0;
  for (std::size_t i = 0; i < azimuth.size(); ++i)
    if (std::abs(direction[3 * i + 2]) < std::abs(direction[3 * lowest + 2])) lowest = i;
  const Vec3 sun{direction.at(3 * lowest), direction.at(3 * lowest + 1), 0};
  return norm(sun) == 0 ? 0 : azimuth[lowest] - horizontal(sun).azimuth_deg;
}

Vec3 scene_direction(Horizontal compass, double north_deg) {
  return enu_direction({compass.azimuth_deg - north_deg, compass.elevation_deg});
}

Vec3 overview_direction(const ResultReader& result, double north_deg) {
  constexpr double quarter_deg = 90, south_deg_of_compass = 180;
  const double light_deg = light_azimuth_deg(result);
  const double side_deg = std::round(light_deg / quarter_deg) * quarter_deg;
  const bool is_noon = std::abs(std::cos(radians(side_deg))) > std::sqrt(0.5);
  const bool is_clockwise = is_noon ? side_deg == south_deg_of_compass : light_deg >= side_deg;
  const double aside_deg = is_clockwise ? overview_aside_deg : -overview_aside_deg;
  return scene_direction({side_deg + aside_deg, overview_elevation_deg}, north_deg);
}

std::optional<Vec3> side_of(Vec3 normal_sum, double area) {
  if (!(std::hypot(normal_sum.x, normal_sum.y) >= one_sided_share * area)) return {};
  return normal_sum;
}

std::optional<Vec3> side_of_mapped_place(const ResultReader& result) {
  const auto weight = result.doubles("place_weight"), area = result.doubles("patch_area"),
             normal = result.doubles("patch_normal");
  Vec3 sum{0, 0, 0};
  double all = 0;
  for (std::size_t p = 0; p < weight.size(); ++p)
    if (weight[p] > 0) {
      sum += area[p] * Vec3{normal[3 * p], normal[3 * p + 1], normal[3 * p + 2]};
      all += area[p];
    }
  return side_of(sum, all);
}

}  // namespace sunload
