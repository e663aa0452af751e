// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Standard errors per instant against the spread of independent seeds.

#include <gtest/gtest.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <iostream>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr int seeds = 32;
constexpr int realizations = 16;

/// A wall over ground, black: patches are independent of each other.
Scene wall_over_ground() {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.object("ground").quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, black);
  builder.object("wall").box({-1, 4.1, 0}, {5, 5, 3}, black, SceneBuilder::Facing::outward);
  builder.object("post").box({1, -1.3, 0}, {1.6, -1, 4}, black, SceneBuilder::Facing::outward);
  return builder.scene();
}

/// Variance over seeds and mean squared standard error of every patch and instant.
struct Spread {
  std::vector<double> variance, squared_error;
};

Spread spread(const Scene& scene, const std::vector<IntervalLight>& light) {
  std::vector<std::vector<double>> values;
  Spread result;
  for (int s = 0; s < seeds; ++s) {
    SolverRules rules = test_rules();
    rules.realizations = realizations;
    rules.lines_per_patch = realizations * 32;
    rules.direct_samples = realizations * 16;
    rules.errors = Errors::instants;
    rules.seed = 500 + static_cast<std::uint64_t>(s);
    const auto solved = solve(scene, light, rules, {.max_edge_m = 2});
    const auto& total = solved.tally.irradiance[static_cast<std::size_t>(Part::total)];
    result.squared_error.resize(total.size(), 0);
    values.resize(total.size());
    for (std::size_t i = 0; i < total.size(); ++i) {
      values[i].push_back(static_cast<double>(total[i]));
      const auto se = static_cast<double>(solved.tally.irradiance_se[i]);
      result.squared_error[i] += se * se / seeds;
    }
  }
  for (const auto& v : values) {
    const double error = mean_error(v).standard_error;
    result.variance.push_back(error * error * seeds);
  }
  return result;
}

/// The ratio follows Fisher's F with (seeds - 1, seeds (realizations - 1)) degrees of
/// freedom; returns how many of the ratios with the errors times `fault` lie outside.
int outside(const Spread& s, double fault) {
  const boost::math::fisher_f fisher(seeds - 1, seeds * (realizations - 1));
  const auto count = static_cast<double>(s.variance.size());
  const double alpha = 1 - std::pow(1 - false_alarm_share(), 1 / count);
  const double low = quantile(fisher, alpha / 2), high = quantile(complement(fisher, alpha / 2));
  int found = 0;
  for (std::size_t i = 0; i < s.variance.size(); ++i) {
    if (s.squared_error[i] == 0) {
      // Rounding of the pooled sum is all that may differ.
      found += s.variance[i] > float_rounding;
      continue;
    }
    const double ratio = s.variance[i] / (s.squared_error[i] * fault * fault);
    found += ratio < low || ratio > high;
  }
  return found;
}

TEST(InstantErrors, AreTheSpreadOfIndependentSeeds) {
  auto sunny = with_uniform_sky(one_second({-0.2, -0.8, 0.6}, 700), 120);
  auto low = with_uniform_sky(one_second({0.1, -0.9, 0.3}, 400), 60);
  low.number = 1;
  const Spread s = spread(wall_over_ground(), {sunny, low});
  double variance = 0, squared = 0;
  for (std::size_t i = 0; i < s.variance.size(); ++i)
    variance += s.variance[i], squared += s.squared_error[i];
  std::cout << "spread over seeds / standard errors, mean square: " << std::sqrt(variance / squared)
            << " over " << s.variance.size() << " patches and instants\n";
  EXPECT_EQ(outside(s, 1), 0);
  // Planted fault: the standard deviation of one realization, and its variance.
  EXPECT_GT(outside(s, std::sqrt(realizations)), 0);
}

}  // namespace
}  // namespace sunload::test
