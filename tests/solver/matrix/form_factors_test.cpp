// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/matrix/form_factors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/threads.h"
#include "solver/matrix/dense_solve.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

Scene room(double rho, double exitance) {
  SceneBuilder builder;
  builder.object("room").box({0, 0, 0}, {3, 2, 1}, builder.material({"wall", rho, 0, exitance}),
                             Facing::inward);
  return builder.scene();
}

/// A floor below a plate that a smaller one hides in part.
Scene plates() {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.5, 0, 0});
  builder.object("floor").quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, grey);
  builder.object("ceiling").quad({0, 0, 2}, {0, 2, 2}, {2, 2, 2}, {2, 0, 2}, grey);
  builder.sides(Sides::two)
      .object("screen")
      .quad({0.5, 0.5, 1}, {1.2, 0.5, 1}, {1.2, 1.2, 1}, {0.5, 1.2, 1}, grey);
  return builder.scene();
}

FormFactors factors_of(const Scene& scene, const SplitRules& split,
                       const FormFactorRules& rules = {}) {
  const Hierarchy hierarchy(scene, split);
  const RayCaster caster(scene.mesh);
  Watch watch;
  return form_factors(scene.mesh, hierarchy, caster, rules, watch);
}

double row_sum(const FormFactors& factors, std::size_t i) {
  double sum = 0;
  for (std::size_t j = 0; j < factors.patches; ++j)
    sum += static_cast<double>(factors.mean[i * factors.patches + j]);
  return sum;
}

TEST(FormFactors, OfAnEmptyRoomAreAllByFormulaAndAddUpToOne) {
  const FormFactors factors = factors_of(room(0.5, 0), {.max_edge_m = 1});
  EXPECT_EQ(factors.pairs_by_lines, 0u);
  constexpr double of_floats = 1e-6;  // as many roundings as patches, and the formula's own error
  for (std::size_t i = 0; i < factors.patches; ++i)
    EXPECT_NEAR(row_sum(factors, i), 1, 4 * of_floats) << i;
}

TEST(FormFactors, AreReciprocalWhereSurfacesAreHidden) {
  const Scene scene = plates();
  const Hierarchy hierarchy(scene, {.max_edge_m = 1});
  const FormFactors factors = factors_of(scene, {.max_edge_m = 1});
  EXPECT_GT(factors.pairs_by_formula, 0u);
  EXPECT_GT(factors.pairs_by_lines, 0u);
  const auto& area = hierarchy.area();
  const std::size_t n = factors.patches;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double there = area[i] * static_cast<double>(factors.mean[i * n + j]);
      const double back = area[j] * static_cast<double>(factors.mean[j * n + i]);
      EXPECT_NEAR(there, back, 1e-6 * area[i]) << i << " " << j;
    }
}

TEST(FormFactors, AreTheSameBitsForAnyNumberOfThreads) {
  const Scene scene = plates();
  const int threads = thread_count();
  set_thread_count(1);
  const FormFactors alone = factors_of(scene, {.max_edge_m = 1});
  set_thread_count(3);
  const FormFactors together = factors_of(scene, {.max_edge_m = 1});
  set_thread_count(threads);
  EXPECT_EQ(alone.mean, together.mean);
  EXPECT_EQ(alone.realizations, together.realizations);
}

TEST(FormFactors, SolveTheFurnaceExactly) {
  constexpr double rho = 0.8, exitance = 10;
  SolverRules rules = test_rules();
  rules.transport = Transport::matrix;
  rules.unfollowed = Unfollowed::estimate;
  const Solved solved = solve(room(rho, exitance), {night}, rules, {.max_edge_m = 1});
  const double truth = exitance / (1 - rho);
  constexpr double of_factors = 1e-5;  // 4e-6 of the row sums above, five reflections in the mean
  for (const double E : solved.tally.exposure[0]) EXPECT_NEAR(E, truth, 5 * of_factors * truth);
  const Ledger& ledger = solved.tally.ledger.front();
  EXPECT_EQ(ledger[Term::unshot], 0);
  EXPECT_NEAR(ledger[Term::absorbed], ledger[Term::emitted], 5 * of_factors * ledger.in());
  EXPECT_NEAR(ledger.residual(), 0, 5 * of_factors * ledger.in());
}

TEST(DenseSolve, FollowsAllReflections) {
  // Two plates that see nothing but each other by half: E_1 = E_0 + F rho E_2 and back.
  const std::vector<float> F{0, 0.5f, 0.5f, 0}, rho{0.4f, 0.8f};
  const auto R = all_reflections(F, rho);
  const double both = 0.5 * 0.5 * 0.4 * 0.8, rest = 1 - both;
  EXPECT_NEAR(R[0], 0.5 * 0.8 * 0.5 / rest, 1e-7);
  EXPECT_NEAR(R[1], 0.5 / rest, 1e-7);
  EXPECT_NEAR(R[2], 0.5 / rest, 1e-7);
  EXPECT_NEAR(R[3], 0.5 * 0.4 * 0.5 / rest, 1e-7);
  EXPECT_THROW(all_reflections({0, 1, 1, 0}, {1, 1}), InputError) << "light that never ends";
}

}  // namespace
}  // namespace sunload::test
