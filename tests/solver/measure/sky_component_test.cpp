// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sky components of the overcast sky against integrals by quadrature.
#include "solver/measure/sky_component.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/units.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

// What the header promises.
constexpr double right_within = 0.004;

bool no_hills(Vec3 /*direction*/) { return true; }

/// Vertical sky component behind an endless parallel wall that hides profile angles up to that.
double behind_a_wall(double obstruction_deg) {
  constexpr int rows = 600, columns = 600;
  const double least = std::tan(radians(obstruction_deg));
  double vertical = 0, level = 0;
  for (int i = 0; i < rows; ++i) {
    const double elevation = (i + 0.5) / rows * pi / 2;
    const double ring = (1 + 2 * std::sin(elevation)) * std::cos(elevation);
    level += 2 * pi * ring * std::sin(elevation);
    for (int k = 0; k < columns; ++k) {
      const double azimuth = ((k + 0.5) / columns - 0.5) * pi;
      if (std::tan(elevation) > least * std::cos(azimuth))
        vertical += pi / columns * ring * std::cos(elevation) * std::cos(azimuth);
    }
  }
  return vertical / level;
}

double component(double obstruction_deg, Vec3 normal) {
  constexpr double distance = 20, half_length = 20000;
  SceneBuilder builder;
  const int wall = builder.material({"wall", 0.3, 0, 0});
  const double height = distance * std::tan(radians(obstruction_deg));
  builder.quad({half_length, distance, 0}, {-half_length, distance, 0},
               {-half_length, distance, height}, {half_length, distance, height}, wall);
  const Scene scene = builder.scene();
  const RayCaster caster(scene.mesh);
  const std::vector<MeasuredPoint> points{{{0, 0, 0}, normal}};
  return overcast_sky_components(points, caster, no_hills).front();
}

TEST(SkyComponent, OfAWallIsThatOfItsObstructionAngle) {
  EXPECT_NEAR(behind_a_wall(0), 9.0 / 42 + 4 / (7 * pi), 1e-4) << "0.396, BRE 209: almost 40 %";
  for (const double angle : {1.0, 10.0, 25.0, 40.0, 60.0})
    EXPECT_NEAR(component(angle, {0, 1, 0}), behind_a_wall(angle), right_within) << angle;
  // BRE 209: 25° leave 27 %.
  EXPECT_NEAR(behind_a_wall(25), 0.27, 0.005);
  // Planted fault: an obstruction of 3° more.
  EXPECT_GT(std::abs(component(28, {0, 1, 0}) - behind_a_wall(25)), 2 * right_within);
}

/// Of the middle of a court's ground: along each azimuth the sky above the eaves.
double in_a_court(double half_width, double half_length, double height) {
  constexpr int azimuths = 100000;
  double hidden = 0;
  for (int i = 0; i < azimuths; ++i) {
    const double azimuth = (i + 0.5) / azimuths * pi / 2;
    const double away = std::min(half_width / std::sin(azimuth), half_length / std::cos(azimuth));
    const double s = height / std::hypot(height, away);  // ∫ (1 + 2 sin) sin d sin up to there
    hidden += (s * s / 2 + 2 * s * s * s / 3) / azimuths;
  }
  return 1 - hidden / (1.0 / 2 + 2.0 / 3);
}

TEST(SkyComponent, OfACourtIsThatAboveItsEaves) {
  struct Court {
    double half_width, half_length, height;
  };
  for (const auto& [a, b, h] :
       {Court{10, 10, 14.55}, {10, 10, 5}, {5, 15, 10}, {6, 6, 12}, {20, 8, 16}})
    for (const double turned_deg : {0.0, 30.0}) {
      SceneBuilder builder;
      const int wall = builder.material({"wall", 0.3, 0, 0});
      const double c = std::cos(radians(turned_deg)), s = std::sin(radians(turned_deg));
      const auto at = [&](double x, double y, double z) {
        return Vec3{c * x - s * y, s * x + c * y, z};
      };
      const std::array<std::array<double, 2>, 5> round{
          {{a, b}, {-a, b}, {-a, -b}, {a, -b}, {a, b}}};
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [x0, y0] = round[k];
        const auto [x1, y1] = round[k + 1];
        builder.quad(at(x0, y0, 0), at(x1, y1, 0), at(x1, y1, h), at(x0, y0, h), wall);
      }
      const Scene scene = builder.scene();
      const RayCaster caster(scene.mesh);
      const std::vector<MeasuredPoint> points{{{0, 0, 0}, {0, 0, 1}}};
      EXPECT_NEAR(overcast_sky_components(points, caster, no_hills).front(), in_a_court(a, b, h),
                  right_within)
          << a << " " << b << " " << h << " " << turned_deg;
    }
}

TEST(SkyComponent, OfOpenLandIsOne) {
  EXPECT_NEAR(component(0.001, {0, 0, 1}), 1, right_within);
  // Half of the sky behind hills.
  SceneBuilder builder;
  builder.box({9, 9, 0}, {9.1, 9.1, 0.01}, builder.material({"a", 0, 0, 0}),
              SceneBuilder::Facing::outward);
  const Scene scene = builder.scene();
  const RayCaster caster(scene.mesh);
  const std::vector<MeasuredPoint> points{{{0, 0, 0}, {0, 0, 1}}};
  const auto in_the_north = [](Vec3 w) { return w.y > 0; };
  EXPECT_NEAR(overcast_sky_components(points, caster, in_the_north).front(), 0.5, right_within);
}

}  // namespace
}  // namespace sunload::test
