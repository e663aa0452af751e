// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Totals of parts of the period, solved beside the whole, are those of their intervals alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/court.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr std::size_t intervals = block_width + 5;  // more than are computed side by side

/// Suns all around, of different length, some dark.
std::vector<IntervalLight> turning_sun() {
  std::vector<IntervalLight> light;
  for (std::uint32_t k = 0; k < intervals; ++k) {
    const double turn = 2 * pi * k / intervals;
    IntervalLight sun = with_uniform_sky(
        one_second({std::sin(turn), std::cos(turn), 0.3 + 0.02 * k}, 500 + 10 * k), 60 + k);
    if (k % 6 == 2) sun = night;
    sun.number = k;
    sun.length_s = 100 * (1 + k % 3);
    if (sun.sunlit_s > 0) sun.sunlit_s = sun.length_s;
    sun.ground_exitance = 0.2 * sun.dhi;
    light.push_back(sun);
  }
  return light;
}

/// Mirrors, a sensor, and panes for angles.
Scene scene() {
  Scene scene = court({.wall = {"wall", 0.45}, .glass = {"glass", 0.1, 0.7}});
  scene.sensors.push_back(sensor_at({0, -6, 1.5}, {0, 0, 1}));
  return scene;
}

/// Equal to rounding or not: few lines do.
SolverRules quick_rules() {
  SolverRules rules = test_rules();
  rules.realizations = 4;
  rules.lines_per_patch = 4 * 8;
  rules.direct_samples = 4 * 2;
  rules.bounces = 2;
  return rules;
}

/// `first`: a part that crosses blocks and shares an interval with the other one.
std::vector<PartOfBatch> two_parts() {
  std::vector<PartOfBatch> parts(2);
  for (std::size_t k = 0; k < intervals; ++k) {
    const double first = k < 3 ? 0 : k == 3 ? 0.25 : k < intervals - 2 ? 1 : 0;
    parts[0].share.push_back(first);
    parts[1].share.push_back(1 - first);
  }
  return parts;
}

std::vector<BatchTally> tallies(const SolverRules& rules, const std::vector<IntervalLight>& light,
                                const std::vector<PartOfBatch>& parts = {}) {
  Watch watch;
  const Scene court = scene();
  const auto traced = trace_scene(court, SplitRules{.max_edge_m = 4}, rules, watch);
  return sunload::solve(*transport_of(*traced), light, watch, parts).bands;
}

/// Largest difference, as a share of the largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0, all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, std::abs(a[i] - b[i]));
    all = std::max(all, std::abs(b[i]));
  }
  return all > 0 ? most / all : 1;
}

/// Of what a part has, and of what a batch has in which its intervals alone shine so long.
double difference(const PartTally& part, const ReceiverTally& alone) {
  const auto whole = [&](Part of) { return alone.exposure[static_cast<std::size_t>(of)]; };
  double most = std::max({difference(part.total, whole(Part::total)),
                          difference(part.direct, whole(Part::direct)),
                          difference(part.sunlit_s, alone.sunlit_s)});
  for (std::size_t r = 0; r < alone.exposure_realization.size(); ++r)
    most = std::max(most, difference(part.exposure_realization[r], alone.exposure_realization[r]));
  return most;
}

struct Way {
  const char* name;
  Transport transport = Transport::gather;
  Errors errors = Errors::totals;
  Bands bands = Bands::broadband;
};

TEST(PartsOfPeriod, AreTheTotalsOfTheirIntervalsAlone) {
  for (const Way& way : {Way{"gather"}, Way{.name = "instants", .errors = Errors::instants},
                         Way{.name = "rgb", .bands = Bands::rgb},
                         Way{.name = "shoot", .transport = Transport::shoot}}) {
    SolverRules rules = quick_rules();
    rules.transport = way.transport;
    rules.errors = way.errors;
    rules.bands = way.bands;
    auto light = turning_sun();
    if (way.bands == Bands::rgb)
      for (auto& sun : light) sun = in_bands(sun, {1.2, 1, 0.8}, {0.7, 1, 1.3});
    const auto parts = two_parts();
    const auto solved = tallies(rules, light, parts);
    const auto whole = tallies(rules, light);
    for (std::size_t b = 0; b < whole.size(); ++b) {
      // What stands beside changes no bit of the whole.
      EXPECT_EQ(solved[b].exposure_realization, whole[b].exposure_realization) << way.name;
      EXPECT_EQ(solved[b].exposure, whole[b].exposure) << way.name;
      // Light is linear: both parts make up all of it.
      for (std::size_t r = 0; r < whole[b].exposure_realization.size(); ++r) {
        auto sum = solved[b].parts[0].exposure_realization[r];
        for (std::size_t i = 0; i < sum.size(); ++i)
          sum[i] += solved[b].parts[1].exposure_realization[r][i];
        EXPECT_LT(difference(sum, whole[b].exposure_realization[r]), float_rounding) << way.name;
      }
    }
    // The same suns with random numbers of their own for as long as the part has them. Shots follow
    // the light of all suns of a block.
    if (way.transport == Transport::shoot) continue;
    auto of_first = light;
    for (std::size_t k = 0; k < intervals; ++k) {
      of_first[k].length_s *= parts[0].share[k];
      of_first[k].sunlit_s *= parts[0].share[k];
    }
    const auto alone = tallies(rules, of_first);
    for (std::size_t b = 0; b < whole.size(); ++b) {
      EXPECT_LT(difference(solved[b].parts[0], alone[b]), float_rounding) << way.name;
      EXPECT_LT(difference(solved[b].sensors.parts[0], alone[b].sensors), float_rounding)
          << way.name << ", sensor";
      // Planted fault: the other part's.
      EXPECT_GT(difference(solved[b].parts[1], alone[b]), 100 * float_rounding) << way.name;
    }
  }
}

TEST(PartsOfPeriod, WithoutErrorsHaveNoRealizations) {
  const SolverRules rules = quick_rules();
  auto parts = two_parts();
  parts[1].with_errors = false;
  const auto solved = tallies(rules, turning_sun(), parts);
  EXPECT_EQ(solved[0].parts[0].exposure_realization.size(), 4U);
  EXPECT_TRUE(solved[0].parts[1].exposure_realization.empty());
  EXPECT_GT(*std::ranges::max_element(solved[0].parts[1].total), 0);
}

}  // namespace
}  // namespace sunload::test
