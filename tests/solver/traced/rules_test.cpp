// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rules out of range are refused before anything is traced.
#include "solver/traced/rules.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "solver/solver.h"
#include "tests/support/refusal_of.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Scene plate() {
  SceneBuilder builder;
  builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, builder.material({"plate", 0.5}));
  return builder.scene();
}

template <class Change>
std::string refusal_after(const Change& change) {
  SolverRules rules;
  change(rules);
  return refusal_of<std::logic_error>([&] { expect_valid(rules); });
}

TEST(SolverRules, InTheirRangesAreTaken) {
  EXPECT_EQ(refusal_after([](SolverRules&) {}), "");
  EXPECT_EQ(refusal_after([](SolverRules& rules) {
              rules.bounces = rules.mirror_depth = 0;
              rules.realizations = rules.lines_per_patch = rules.direct_samples = 1;
              rules.unshot = rules.faint_glint = 0;
              rules.most_sun_beams = 0;
            }),
            "");
}

TEST(SolverRules, OutOfRangeAreRefused) {
  for (const int wrong : {0, -64, 100})
    EXPECT_NE(refusal_after([&](SolverRules& rules) { rules.lines_per_patch = wrong; }), "")
        << wrong;
  EXPECT_NE(refusal_after([](SolverRules& rules) { rules.lines_of_patch = {8, 0}; }), "");
  EXPECT_NE(refusal_after([](SolverRules& rules) { rules.direct_samples = 4; }), "");
  for (const int wrong : {-1, 1'000'000}) {
    EXPECT_NE(refusal_after([&](SolverRules& rules) { rules.bounces = wrong; }), "") << wrong;
    EXPECT_NE(refusal_after([&](SolverRules& rules) { rules.mirror_depth = wrong; }), "");
  }
  for (const int wrong : {0, -1})
    EXPECT_NE(refusal_after([&](SolverRules& rules) { rules.realizations = wrong; }), "") << wrong;
  for (const double wrong : {nan, -1.0}) {
    EXPECT_NE(refusal_after([&](SolverRules& rules) { rules.unshot = wrong; }), "") << wrong;
    EXPECT_NE(refusal_after([&](SolverRules& rules) { rules.power_per_sample_w = wrong; }), "");
  }
}

TEST(SolverRules, AreLookedAtBeforeAnythingIsTraced) {
  const Scene scene = plate();
  SolverRules rules;
  rules.bounces = -1;
  Watch watch;
  EXPECT_THROW(trace_scene(scene, SplitRules{}, rules, watch), std::logic_error);
}

TEST(SplitRules, ThatNeverEndAreRefused) {
  const Scene scene = plate();
  for (const double wrong : {0.0, -1.0, nan}) {
    EXPECT_THROW(Hierarchy(scene, SplitRules{.max_edge_m = wrong}), std::logic_error) << wrong;
    EXPECT_THROW(ElementForest(scene).split_long_edges({.max_edge_m = wrong}), std::logic_error);
  }
  EXPECT_THROW(Hierarchy(scene, SplitRules{.max_edge_m = 1, .min_area_m2 = nan}), std::logic_error);
  EXPECT_EQ(Hierarchy(scene, SplitRules{.max_edge_m = std::numeric_limits<double>::infinity()})
                .patch_count(),
            2u);
}

TEST(Solve, LooksAtLightOfDarkIntervalsToo) {
  const Scene scene = plate();
  Watch watch;
  SolverRules rules;
  rules.lines_per_patch = rules.direct_samples = rules.realizations;
  const auto traced = trace_scene(scene, SplitRules{}, rules, watch);
  const auto transport = transport_of(*traced);
  const auto solve_one = [&](const IntervalLight& light) {
    return sunload::solve(*transport, {&light, 1}, watch);
  };
  EXPECT_NO_THROW(solve_one(night));
  IntervalLight below = night;
  below.dhi = -5;
  EXPECT_THROW(solve_one(below), std::logic_error);
  IntervalLight longer = with_uniform_sky(one_second({0, 0, 1}, 500), 100);
  EXPECT_NO_THROW(solve_one(longer));
  longer.sky.resize(longer.sky.size() + 1000, 1);
  EXPECT_THROW(solve_one(longer), std::logic_error);
}

}  // namespace
}  // namespace sunload::test
