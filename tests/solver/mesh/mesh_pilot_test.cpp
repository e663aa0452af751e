// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the refinement takes the light load for, where it is known.

#include "solver/mesh/mesh_pilot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

// An open plate between a sky and a ground that are alike sees H₀ from everywhere, and of every sun
// its exposure times the cosine, on the side that faces it.
TEST(MeshPilot, LoadOfAnOpenPlateIsThatOfItsSunsAndWhatIsAround) {
  constexpr double around = 30;
  const Vec3 normal = normalized({0.3, -0.5, 0.8});
  const Tangents plane = tangents(normal);
  SceneBuilder builder;
  builder.sides(Sides::two)
      .triangle({0, 0, 0}, plane.tangent * 3, plane.bitangent * 2,
                builder.material({"m", 0.3, 0, 0}));
  const Scene scene = builder.scene();
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh);
  PeriodLight light;
  light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), around);
  light.ground = around;
  // Two before the front, one of them all but grazing; one before the back.
  light.suns = {{normalized({0.1, -0.6, 0.4}), 100},
                {normalized({0.9, 0.5, 0.1}), 70},
                {normalized({-0.9, 0.3, 0.1}), 40}};
  const MeshPilot pilot(forest, scene, caster, light, 1);
  for (const std::uint8_t side : {std::uint8_t{0}, std::uint8_t{1}}) {
    const Vec3 n = side == 0 ? normal : -normal;
    double truth = around, without_cosine = around, largest_cosine = 0;
    for (const PeriodSun& sun : light.suns) {
      const double cos_theta = std::max(0.0, dot(n, sun.direction));
      truth += sun.exposure * cos_theta;
      without_cosine += cos_theta > 0 ? sun.exposure : 0;
      largest_cosine = std::max(largest_cosine, cos_theta);
    }
    const ElementLoad load = pilot.load(pilot.sight(0, side, 0.01));
    EXPECT_NEAR(load.mean, truth, float_rounding * truth);
    EXPECT_NEAR(load.variance, 0, float_rounding * truth * truth);
    EXPECT_TRUE(load.sees_sun);
    EXPECT_NEAR(load.largest_cosine, largest_cosine, float_rounding);
    EXPECT_GT(without_cosine, 1.1 * truth);  // it would be seen
  }
}

// Chance at screens would be the same for both halves of the light: it looked as if light varied,
// and meshes of crowns were divided down to the least area.
TEST(MeshPilot, ScreensLetTheirShareOfEveryRayPass) {
  constexpr double T = 0.3, height = 2, flux_time = 10;
  SceneBuilder builder;
  const int plain = builder.material({"m", 0.3, 0, 0});
  const int screen = builder.material({.name = "screen", .transmittance = T});
  builder.triangle({0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, plain)
      .sides(Sides::two)
      .quad({-50, -50, 1}, {50, -50, 1}, {50, 50, 1}, {-50, 50, 1}, screen);
  Scene scene = builder.scene();
  scene.luminaires.webs = {{{0}, {0, 180}, {1, 1}}};
  scene.luminaires.all = {Luminaire({0, 0, height}, {0, 0, -1}, 0)};
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  PeriodLight light;
  light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), 0);
  light.suns = {{normalized({0.1, -0.6, 0.4}), 100}, {normalized({-0.2, 0.1, 0.9}), 70}};
  light.lamp_time_s = flux_time;
  const MeshPilot pilot(forest, scene, caster, light, 1);
  double open = flux_time / (height * height);
  for (const PeriodSun& sun : light.suns) open += sun.exposure * sun.direction.z;
  const ElementLoad load = pilot.load(pilot.sight(0, 0, 0.01));
  EXPECT_NEAR(load.mean, T * open, 1e-4 * open);
  EXPECT_NEAR(load.variance, 0, 1e-4 * open * open);
  EXPECT_TRUE(load.sees_sun);
}

// The sun goes through the screen to the mirror and once more on its way back.
TEST(MeshPilot, ScreensBeforeMirrorsLetTheirSharePass) {
  constexpr double T = 0.4, reflectance = 0.8;
  SceneBuilder builder;
  const int plain = builder.material({"m", 0.3, 0, 0});
  const int mirror = builder.material({"mirror", 0, reflectance, 0});
  const int screen = builder.material({.name = "screen", .transmittance = T});
  builder.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, plain)
      .quad({5, -10, 0}, {5, -10, 20}, {5, 10, 20}, {5, 10, 0}, mirror)
      .sides(Sides::two)
      .quad({3, -10, 0}, {3, -10, 20}, {3, 10, 20}, {3, 10, 0}, screen);
  const Scene scene = builder.scene();
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  PeriodLight light;
  light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), 0);
  light.suns = {{normalized({-1, 0.1, 0.5}), 100}};
  const MeshPilot pilot(forest, scene, caster, light, 1);
  const double truth = T * T * reflectance * light.suns[0].exposure * light.suns[0].direction.z;
  const ElementLoad load = pilot.load(pilot.sight(0, 0, 0.01));
  EXPECT_NEAR(load.glint_mean, truth, float_rounding * truth);
  EXPECT_NEAR(load.glint_variance, 0, float_rounding * truth * truth);
}

// Of a beam that falls between the points of a large element: a spot of even light on the rest.
TEST(MeshPilot, SeesTheSpotOfANarrowBeam) {
  SceneBuilder builder;
  builder.triangle({-10, -10, 0}, {30, -10, 0}, {-10, 30, 0}, builder.material({"m", 0.3, 0, 0}));
  Scene scene = builder.scene();
  constexpr double half_deg = 0.5, height = 3;
  scene.luminaires.webs = {{{0}, {0, half_deg}, {1, 1}}};
  scene.luminaires.all = {Luminaire({0.4, -0.7, height}, {0, 0, -1}, 0)};
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh);
  PeriodLight light;
  light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), 0);
  light.lamp_time_s = 10;
  const MeshPilot pilot(forest, scene, caster, light, 1);
  const ElementLoad load = pilot.load(pilot.sight(0, 0, 0.01));
  const double mean = light.lamp_time_s * scene.luminaires.flux() / forest.area(0);
  const double in_spot = light.lamp_time_s / (height * height);
  EXPECT_NEAR(load.mean, mean, 1e-3 * mean);
  EXPECT_NEAR(load.variance, mean * (in_spot - mean), 1e-3 * mean * in_spot);
}

/// Ground before a wall that has no end, below an even sky: E = H₀ (1 + cos β) / 2, where β is how
/// high the top of the wall stands.
struct GroundBeforeAWall {
  static constexpr double near_m = 0.5, far_m = 3.5, high_m = 3, open = 100;
  SceneBuilder builder;
  PeriodLight light;
  GroundBeforeAWall() {
    const int m = builder.material({"m", 0.3, 0, 0});
    builder.triangle({0, near_m, 0}, {3, near_m, 0}, {0, far_m, 0}, m);
    constexpr double end_m = 3000;
    builder.quad({-end_m, 0, 0}, {-end_m, 0, high_m}, {end_m, 0, high_m}, {end_m, 0, 0}, m);
    light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), open);
  }
  /// Mean and variance over the triangle, by many strips.
  static std::pair<double, double> truth() {
    constexpr int strips = 10'000;
    double sum = 0, squares = 0, area = 0;
    for (int s = 0; s < strips; ++s) {
      const double at = (s + 0.5) / strips, y = near_m + (far_m - near_m) * at;
      const double E = open * (1 + y / std::hypot(y, high_m)) / 2;
      sum += (1 - at) * E;
      squares += (1 - at) * E * E;
      area += 1 - at;
    }
    return {sum / area, squares / area - sum * sum / (area * area)};
  }
};

// What the surroundings send is seen from a point in each quarter, and has the variance it has at
// all points; the noise of the directions is not in it.
TEST(MeshPilot, SkyBesideAWallHasItsMeanAndVariance) {
  const GroundBeforeAWall ground;
  const Scene scene = ground.builder.scene();
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh);
  std::vector<double> means, variances;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const MeshPilot pilot(forest, scene, caster, ground.light, seed);
    const ElementLoad load = pilot.load(pilot.sight(0, 0, 1));
    means.push_back(load.mean);
    variances.push_back(load.variance);
  }
  const auto [mean, variance] = GroundBeforeAWall::truth();
  EXPECT_TRUE(expect_mean(means, mean, float_rounding * mean));
  // Of 16 points in even places the sum of squares is divided by 15.
  EXPECT_TRUE(expect_mean(variances, variance, variance / 15));
  // Points that were all in one quarter, or a sum over four that is divided by 15 - 12, would be
  // seen.
  EXPECT_FALSE(expect_mean(variances, variance / 2, variance / 15));
  EXPECT_FALSE(expect_mean(variances, variance * 5 / 4, variance / 15));
}

// Of each packet, whatever the seed, the first four points lie in the four quarters, and each of
// the others in that of the one that stands for it.
TEST(MeshPilot, APointInEachQuarterStandsForThoseThere) {
  const auto quarter = [](std::size_t index, const RandomWords& seeds) {
    const auto i = static_cast<std::uint32_t>(index);
    return std::pair{scrambled_sobol(i, 0, seeds) < 0.5, scrambled_sobol(i, 1, seeds) < 0.5};
  };
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RandomWords seeds = random_words({.seed = seed, .purpose = Purpose::mesh_pilot});
    for (std::size_t first = 0; first < 8 * packet_size; first += packet_size) {
      std::set<std::pair<bool, bool>> quarters;
      for (std::size_t q = 0; q < PilotSight::quarters; ++q)
        quarters.insert(quarter(first + q, seeds));
      EXPECT_EQ(quarters.size(), std::size_t{PilotSight::quarters});
      for (std::size_t r = 0; r < packet_size; ++r)
        EXPECT_EQ(quarter(first + r, seeds),
                  quarter(first + PilotSight::first_in_quarter_of(r), seeds));
    }
  }
}

}  // namespace
}  // namespace sunload::test
