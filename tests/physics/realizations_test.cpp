// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Two ways to one number: the series rest on the lines and samples of all realizations together,
/// standard errors on each of them for itself.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/court.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

/// Intervals of different length under clear skies, bright about the sun; the sun rises in one of
/// them, another one is twilight.
std::vector<IntervalLight> morning() {
  const SkyGrid grid;
  std::vector<IntervalLight> light;
  for (const double z : {-0.1, 0.1, 0.3, 0.5, 0.7}) {
    IntervalLight sun = one_second({0.6, -0.75, z}, z > 0 ? 700 : 0);
    sun.number = static_cast<std::uint32_t>(light.size());
    sun.length_s = 600 * (1 + static_cast<double>(light.size()));
    sun.sunlit_s = z > 0 ? (z < 0.2 ? 0.4 : 1) * sun.length_s : 0;
    sun.dhi = 90;
    const Vec3 of_sky = z > 0 ? sun.direction : normalized({0.6, -0.75, 0});
    sun.sky = grid.mean_radiance(Sky({.model = SkyModel::perez,
                                      .dhi = sun.dhi,
                                      .dni = sun.dni,
                                      .sun_zenith_deg = degrees(std::acos(of_sky.z)),
                                      .sun_direction = of_sky}),
                                 sun.dhi);
    sun.ground_exitance = 0.2 * (sun.dni * std::max(0.0, sun.direction.z) + sun.dhi);
    light.push_back(sun);
  }
  return light;
}

/// Parts that are linear in lines and samples; what is reflected is not.
constexpr Part linear_parts[] = {Part::direct, Part::sky, Part::mirror, Part::lamps};

/// Largest difference of a part's exposure from the mean of its realizations, as a share of the
/// largest exposure in all.
double difference(const ReceiverTally& tally, Part part) {
  const auto p = static_cast<std::size_t>(part);
  double most = 0, all = 0;
  for (std::size_t i = 0; i < tally.exposure[p].size(); ++i) {
    std::vector<double> of;
    for (const auto& exposure : tally.part_realization[p]) of.push_back(exposure[i]);
    most = std::max(most, std::abs(tally.exposure[p][i] - mean_error(of).mean));
    all = std::max(all, tally.exposure[static_cast<std::size_t>(Part::total)][i]);
  }
  return most / all;
}

/// The court in a material that all of its walls have, with a sensor in it.
Scene court_of(const Material& wall, const Material& glass) {
  Scene scene = court({.wall = wall, .glass = glass});
  scene.sensors.push_back(sensor_at({0, -6, 1.5}, {0, 0, 1}));
  return scene;
}

TEST(Realizations, AreTheSeriesInTheMeanPartByPart) {
  Material satin{"satin", 0.2}, pane{"pane"};
  satin.glossy = 0.5;
  satin.glossy_exponent = 20;
  pane.smooth = Panes{1.52};
  const auto light = morning();
  // Each has estimators of its own: mirrors and errors in all, gloss and panes and errors of
  // instants.
  struct Case {
    Material wall, glass;
    Errors errors;
  };
  for (const Case& c : {Case{{"wall", 0.45}, {"glass", 0.1, 0.7}, Errors::totals},
                        Case{satin, pane, Errors::instants}}) {
    SolverRules rules = test_rules();
    rules.lines_per_patch = 16 * 8;
    rules.bounces = 2;
    rules.errors = c.errors;
    const Solved solved = solve(court_of(c.wall, c.glass), light, rules, {.max_edge_m = 4});
    for (const Part part : linear_parts) {
      const auto p = static_cast<std::size_t>(part);
      EXPECT_LT(difference(solved.tally, part), float_rounding) << c.wall.name << part_names[p];
      EXPECT_LT(difference(solved.tally.sensors, part), float_rounding)
          << c.wall.name << ", sensor, " << part_names[p];
      // Every part is there, or nothing would be compared.
      EXPECT_GT(*std::ranges::max_element(solved.tally.exposure[p]), 0) << part_names[p];
    }
    // Planted fault: a realization that is lost.
    BatchTally faulty = solved.tally;
    for (auto& of_part : faulty.part_realization)
      if (!of_part.empty()) std::ranges::fill(of_part[3], 0.0);
    for (const Part part : {Part::direct, Part::sky, Part::mirror})
      EXPECT_GT(difference(faulty, part), 10 * float_rounding);
  }
}

// More suns than are computed side by side, some of them dark: none is left out, none gets the
// light of another one.
TEST(Realizations, SunsOfABatchAreThoseOfEveryOneForItself) {
  std::vector<IntervalLight> light;
  for (std::uint32_t k = 0; k < 2 * block_width + 5; ++k) {
    const double turn = 2 * pi * k / (2 * block_width + 5);
    const bool is_dark = k % 7 == 3 && k > block_width;
    light.push_back(
        is_dark
            ? night
            : with_uniform_sky(one_second({std::cos(turn), std::sin(turn), 0.5}, 500.0 + k), 90));
    light.back().number = k;
  }
  Material unlit{"lamp", 0.3};
  SolverRules rules = test_rules();
  rules.lines_per_patch = 16 * 4;
  rules.bounces = 1;
  const Scene scene = court({.lamp = unlit});
  const SplitRules coarse{.max_edge_m = 5};
  const Solved batch = solve(scene, light, rules, coarse);
  const auto total = static_cast<std::size_t>(Part::total);
  const std::size_t patches = batch.area.size();
  for (std::size_t k = 0; k < light.size(); ++k) {
    const Solved alone = solve(scene, {light[k]}, rules, coarse);
    const auto begin =
        batch.tally.irradiance[total].begin() + static_cast<std::ptrdiff_t>(k * patches);
    EXPECT_TRUE(std::equal(alone.tally.irradiance[total].begin(),
                           alone.tally.irradiance[total].end(), begin))
        << k;
    EXPECT_EQ(alone.tally.ledger[0].terms, batch.tally.ledger[k].terms) << k;
  }
}

}  // namespace
}  // namespace sunload::test
