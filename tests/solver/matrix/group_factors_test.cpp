// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/matrix/group_factors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/threads.h"
#include "tests/support/known_truth.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

/// Howell, A catalog of radiation heat transfer configuration factors, C-11 and C-14: unit squares
/// opposite each other at distance 1, and at right angles with a common edge.
constexpr double of_opposite_squares = 0.19982489569838746;
constexpr double of_adjacent_squares = 0.20004377607540316;

/// Floor, ceiling and a wall, an object each, and another scene's corner far away behind them.
Scene squares() {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.5, 0, 0});
  builder.object("floor").quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, grey);
  builder.object("ceiling").quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, grey);
  builder.object("wall").quad({0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, grey);
  return builder.scene();
}

/// A room with a block in it that hides its walls from each other.
Scene room_with_block() {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.5, 0, 0});
  builder.object("room").box({0, 0, 0}, {3, 2, 1}, grey, Facing::inward);
  builder.object("block").box({1, 0.6, 0.2}, {1.7, 1.2, 0.8}, grey, Facing::outward);
  return builder.scene();
}

struct Made {
  GroupFactors factors;
  std::vector<std::int32_t> object;  ///< of patches
  std::size_t patches = 0;
  double operator()(std::size_t r, std::size_t g, std::size_t h) const {
    return factors.realizations[r][g * factors.groups + h];
  }
  std::vector<double> of(std::size_t g, std::size_t h) const {
    std::vector<double> values;
    for (std::size_t r = 0; r < factors.realizations.size(); ++r)
      values.push_back((*this)(r, g, h));
    return values;
  }
};

Made between_objects(const Scene& scene, double max_edge_m,
                     const FormFactorRules& rules = {.realizations = 16}) {
  Made made;
  const Hierarchy hierarchy(scene, {.max_edge_m = max_edge_m});
  const RayCaster caster(scene.mesh);
  PatchGrouping grouping;
  for (const Patch& patch : hierarchy.patches())
    grouping.group_of.push_back(
        scene.mesh.triangle_object[static_cast<std::size_t>(patch.triangle)].value - 1);
  grouping.groups = scene.mesh.object_names.size() - 1;  // the builder's first one has nothing
  Watch watch;
  made.patches = hierarchy.patch_count();
  made.object = grouping.group_of;
  made.factors = group_factors(scene.mesh, hierarchy, caster, grouping, rules, watch);
  return made;
}

/// Edges short enough for more patches than have a matrix of their own, and some lines of each.
constexpr double of_large = 0.05, of_large_room = 0.15, of_small = 0.5;
constexpr FormFactorRules some_lines{.realizations = 16, .lines_per_patch = 256};

TEST(GroupFactors, OfSquaresAreThoseOfTheCatalogue) {
  const Made made = between_objects(squares(), of_small);
  EXPECT_TRUE(made.factors.has_formulas);
  constexpr double of_floats = 1e-6;
  EXPECT_NEAR(made(0, 0, 1), of_opposite_squares, of_floats);
  EXPECT_NEAR(made(0, 0, 2), of_adjacent_squares, of_floats);
  EXPECT_NEAR(made(0, 2, 1), of_adjacent_squares, of_floats);
  EXPECT_EQ(made(0, 0, 0), 0) << "a plane does not see itself";
}

TEST(GroupFactors, OfManyPatchesAreTheSameByLines) {
  const Made made = between_objects(squares(), of_large, some_lines);
  ASSERT_GT(made.patches, most_matrix_patches);
  EXPECT_FALSE(made.factors.has_formulas);
  constexpr TruthCheck check{1.03, 3e-3};
  check("opposite squares", made.of(0, 1), of_opposite_squares, lift(1));
  check("squares with a common edge", made.of(0, 2), of_adjacent_squares, lift(1));
}

TEST(GroupFactors, AddUpToOneInAClosedRoom) {
  for (const double edge : {of_small, of_large_room}) {
    const Made made = between_objects(room_with_block(), edge, some_lines);
    EXPECT_EQ(made.factors.has_formulas, edge == of_small) << made.patches;
    for (std::size_t g = 0; g < made.factors.groups; ++g) {
      std::vector<double> sums;
      for (std::size_t r = 0; r < made.factors.realizations.size(); ++r)
        sums.push_back(made(r, g, 0) + made(r, g, 1));
      // Sums of formulas have no spread but that of floats.
      const Verdict verdict = expect_mean(sums, 1, 4e-6 + lift(3));
      EXPECT_TRUE(verdict) << verdict.text;
      EXPECT_FALSE(expect_mean(sums, 1.02, 4e-6 + lift(3))) << "a fault of 2 % is seen";
    }
    EXPECT_GT(made(0, 0, 0), 0.5) << "a room sees itself";
    EXPECT_EQ(made(0, 1, 1), 0) << "a convex block does not";
  }
}

TEST(GroupFactors, AreReciprocalWithinRounding) {
  for (const double edge : {of_small, of_large_room}) {
    const Made made =
        between_objects(room_with_block(), edge, {.realizations = 2, .lines_per_patch = 64});
    const auto& area = made.factors.area;
    EXPECT_NEAR(area[0], 22, 1e-9);
    for (std::size_t r = 0; r < 2; ++r)
      EXPECT_NEAR(area[0] * made(r, 0, 1), area[1] * made(r, 1, 0), 1e-14 * area[0]);
  }
}

TEST(GroupFactors, OfPatchesOfNoGroupAreLeftOut) {
  const Scene scene = squares();
  const Hierarchy hierarchy(scene, {.max_edge_m = of_small});
  const RayCaster caster(scene.mesh);
  PatchGrouping grouping{{}, 2};
  for (const Patch& patch : hierarchy.patches())
    grouping.group_of.push_back(
        scene.mesh.triangle_object[static_cast<std::size_t>(patch.triangle)].value == 3
            ? -1
            : scene.mesh.triangle_object[static_cast<std::size_t>(patch.triangle)].value - 1);
  Watch watch;
  const GroupFactors factors =
      group_factors(scene.mesh, hierarchy, caster, grouping, {.realizations = 2}, watch);
  EXPECT_NEAR(factors.area[0], 1, 1e-12);
  EXPECT_NEAR(factors.realizations[0][1], of_opposite_squares, 1e-6);
}

TEST(GroupFactors, AreTheSameBitsForAnyNumberOfThreads) {
  const FormFactorRules rules{.realizations = 2, .lines_per_patch = 64};
  const int threads = thread_count();
  set_thread_count(1);
  const Made alone = between_objects(room_with_block(), of_large_room, rules);
  set_thread_count(3);
  const Made together = between_objects(room_with_block(), of_large_room, rules);
  set_thread_count(threads);
  EXPECT_EQ(alone.factors.realizations, together.factors.realizations);
}

}  // namespace
}  // namespace sunload::test
