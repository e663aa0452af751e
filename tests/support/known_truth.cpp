// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/known_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/support/statistics.h"

namespace sunload::test {

SolverRules diffuse_rules(int lines_per_realization, int bounces, int realizations) {
  SolverRules rules = test_rules();
  rules.realizations = realizations;
  rules.lines_per_patch = rules.realizations * lines_per_realization;
  rules.direct_samples = rules.realizations;
  rules.bounces = bounces;
  rules.mirror_depth = 1000;
  return rules;
}

double lift(double coordinate) { return 16 * coordinate / (1 << 24); }

std::vector<double> at_point(Scene scene, Vec3 position, Vec3 normal, std::size_t sensors,
                             const SolverRules& rules, const SplitRules& split) {
  for (std::size_t k = 0; k < sensors; ++k) scene.sensors.push_back({position, normal, k});
  const Solved solved = solve(scene, {night}, rules, split);
  std::vector<double> means;
  for (const auto& row : solved.tally.sensors.exposure_realization) {
    double sum = 0;
    for (const double value : row) sum += value;
    means.push_back(sum / static_cast<double>(sensors));
  }
  return means;
}

void expect_truth(const std::string& id, const std::vector<double>& realizations, double truth,
                  double bias_bound, const Demand& demand) {
  const Verdict verdict = expect_mean(realizations, truth, bias_bound);
  std::cout << id << ": " << verdict.text << "\n";
  EXPECT_TRUE(verdict) << id << ": " << verdict.text;
  if (demand.standard_error) {
    EXPECT_LE(verdict.standard_error, *demand.standard_error * std::abs(truth))
        << id << ": " << verdict.text;
  }
  if (demand.fault) {
    EXPECT_FALSE(expect_mean(realizations, *demand.fault, bias_bound))
        << id << ": planted fault unnoticed: " << verdict.text;
  }
}

void TruthCheck::operator()(const std::string& id, const std::vector<double>& realizations,
                            double truth, double bias_bound,
                            std::optional<double> own_factor) const {
  expect_truth(
      id, realizations, truth, bias_bound,
      {.fault = own_factor.value_or(fault_factor) * truth, .standard_error = standard_error});
}

}  // namespace sunload::test
