// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene of millimetres has the light of the same scene in metres or kilometres.

#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

/// A court open above, as wide as `size` [m].
Solved court_of(double size) {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.5, 0, 0});
  const double a = size / 2;
  builder.quad({-a, -a, 0}, {a, -a, 0}, {a, a, 0}, {-a, a, 0}, grey);
  builder.quad({-a, -a, 0}, {-a, -a, a}, {a, -a, a}, {a, -a, 0}, grey);
  builder.quad({a, -a, 0}, {a, -a, a}, {a, a, a}, {a, a, 0}, grey);
  builder.quad({a, a, 0}, {a, a, a}, {-a, a, a}, {-a, a, 0}, grey);
  builder.quad({-a, a, 0}, {-a, a, a}, {-a, -a, a}, {-a, -a, 0}, grey);
  SolverRules rules = test_rules();
  rules.bounces = 4;
  const SplitRules split{.max_edge_m = size / 10, .min_area_m2 = size * size * 1e-6};
  return solve(builder.scene(), {with_uniform_sky(one_second({0.3, -0.5, 0.8}, 800), 100)}, rules,
               split);
}

TEST(Sizes, OfScenesChangeNothing) {
  const double mean = mean_error(court_of(2).means(everywhere)).mean;
  // The same random numbers: what is left are samples that a rounding moves over an edge.
  for (const double size : {2e-3, 2e3})
    EXPECT_NEAR(mean_error(court_of(size).means(everywhere)).mean, mean, float_rounding * mean)
        << size;
}

}  // namespace
}  // namespace sunload::test
