// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/slope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "geo/base/units.h"

namespace sunload {

namespace {

// CityJSON 2.0.1, section 2.2: objects that are land or water, and plants.
constexpr std::array<std::string_view, 8> land_kinds{"TINRelief", "LandUse",         "Road",
                                                     "Railway",   "TransportSquare", "WaterBody",
                                                     "Waterway",  "PlantCover"};
constexpr std::array<std::string_view, 2> plant_kinds{"SolitaryVegetationObject", "PlantCover"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

std::optional<Slope> slope_of(const Mesh& mesh, std::size_t t) {
  static const double steepest = std::cos(radians(upright_slope_deg));
  const Vec3 area_vector2 = mesh.area_vector2(t);
  const double length = norm(area_vector2);
  if (!(length > 0)) return {};
  const double z = area_vector2.z / length;
  return z > steepest ? Slope::upward : (z < -steepest ? Slope::downward : Slope::upright);
}

std::optional<double> height_at(Vec3 a, Vec3 b, Vec3 c, double x, double y) {
  const auto twice_area = [](double ux, double uy, double vx, double vy) {
    return ux * vy - uy * vx;
  };
  double whole = twice_area(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
  double wa = twice_area(b.x - x, b.y - y, c.x - x, c.y - y);
  double wb = twice_area(c.x - x, c.y - y, a.x - x, a.y - y);
  if (whole < 0) {
    whole = -whole;
    wa = -wa;
    wb = -wb;
  }
  const double wc = whole - wa - wb;
  if (!(whole > 0 && wa >= 0 && wb >= 0 && wc >= 0)) return {};
  return (wa * a.z + wb * b.z + wc * c.z) / whole;
}

std::optional<double> height_at(const Mesh& mesh, std::size_t t, double x, double y) {
  return height_at(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), x, y);
}

bool is_land(const std::string& object_kind) { return contains(land_kinds, object_kind); }
bool is_plant(const std::string& object_kind) { return contains(plant_kinds, object_kind); }

}  // namespace sunload
