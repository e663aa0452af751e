// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/sky_colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"

namespace sunload {
namespace {

constexpr SkyColourModel models[]{SkyColourModel::first, SkyColourModel::second};

TEST(SkyColour, DayIsBlueAwayFromTheSunAndWhiteAtIt) {
  const Vec3 sun = enu_direction({180, 50});
  for (const auto model : models) {
    const Rgb away = sky_colour(model, enu_direction({0, 50}), sun);
    EXPECT_GT(away.blue, 1.1 * away.green);
    EXPECT_GT(away.green, 1.2 * away.red);
    const Rgb at_sun = sky_colour(model, sun, sun);
    EXPECT_NEAR(at_sun.red, 1, 1e-12);
    EXPECT_NEAR(at_sun.green, 1, 1e-12);
    EXPECT_NEAR(at_sun.blue, 1, 1e-12);
  }
}

TEST(SkyColour, LowSunIsRed) {
  const Vec3 sun = enu_direction({180, 1});
  for (const auto model : models) {
    const Rgb at_sun = sky_colour(model, sun, sun);
    EXPECT_GT(at_sun.red, at_sun.green);
    EXPECT_GT(at_sun.green, at_sun.blue);
  }
  EXPECT_EQ(sunlight_colour(0).blue, 0.5);
  EXPECT_EQ(sunlight_colour(40).blue, 1);
  EXPECT_GT(sunlight_colour(20).blue, sunlight_colour(10).blue);
}

// A point of the first model by hand: the zenith with the sun at 40° elevation or more.
TEST(SkyColour, FirstModelFollowsItsFormula) {
  const Vec3 sun = enu_direction({180, 45}), up{0, 0, 1};
  const auto kittler = [](double theta, double gamma) {
    return (0.91 + 10 * std::exp(-3 * gamma) + 0.45 * std::pow(std::cos(gamma), 2)) *
           (1 - std::exp(-0.32 / std::cos(theta)));
  };
  const double I = kittler(0, pi / 4) / kittler(pi / 4, 0);
  const double day = (0.150 + 0.1) * (1 - I) + I;
  EXPECT_NEAR(sky_colour(SkyColourModel::first, up, sun).red, day * (day + 1), 1e-12);
  EXPECT_NEAR(sky_colour(SkyColourModel::second, up, sun).red, 0.150 * (1 - I) + I, 1e-12);
}

TEST(SkyColour, TheDiscIsWhiteByDayAndStandsOutAtDusk) {
  constexpr double edge_deg = 3, beyond_deg = 15;
  for (const double elevation_deg : {40.0, 50.0}) {
    const Vec3 sun = enu_direction({180, elevation_deg});
    for (const double azimuth_deg : {0.0, 180.0}) {  // of the edge, seen from the disc's middle
      const double sign = azimuth_deg == 0 ? 1 : -1;
      const auto colour = [&](double away_deg) {
        return sky_colour(SkyColourModel::second,
                          enu_direction({180, elevation_deg + sign * away_deg}), sun, picture_gain);
      };
      EXPECT_GT(colour(edge_deg).red, 0.99);
      EXPECT_LT(colour(beyond_deg).red, 0.9);
    }
  }
  const Vec3 low = enu_direction({180, 5});
  const auto disc = sky_colour(SkyColourModel::second, low, low, picture_gain);
  const auto halo =
      sky_colour(SkyColourModel::second, enu_direction({184.1, 5}), low, picture_gain);
  EXPECT_GT(disc.green, 1.5 * halo.green);
}

TEST(SkyColour, StaysWithinItsRange) {
  for (const auto model : models) {
    for (const double sun_deg : {-10.0, 0.0, 5.0, 40.0, 90.0}) {
      for (int elevation = -5; elevation <= 90; elevation += 5) {
        for (int azimuth = 0; azimuth < 360; azimuth += 30) {
          const Rgb c = sky_colour(model, enu_direction({1.0 * azimuth, 1.0 * elevation}),
                                   enu_direction({0, sun_deg}), 3);
          for (const double x : {c.red, c.green, c.blue}) EXPECT_TRUE(x >= 0 && x <= 1);
        }
      }
    }
  }
}

}  // namespace
}  // namespace sunload
