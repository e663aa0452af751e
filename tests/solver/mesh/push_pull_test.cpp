// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Radiosity up the trees, irradiance down: area means, and no power lost.

#include "solver/mesh/push_pull.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

/// A rectangle, and a sliver whose tree is uneven.
const Hierarchy& trees() {
  static const Hierarchy mesh = [] {
    SceneBuilder builder;
    const int m = builder.material({"m", 0.3, 0, 0});
    builder.object("a").quad({0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, m);
    builder.triangle({0, 0, 1}, {10, 0, 1}, {9, 0.4, 1}, m);
    return Hierarchy(builder.scene(), {.max_edge_m = 0.7});
  }();
  return mesh;
}

double value_of(std::size_t patch, std::size_t k) {
  return 1 + std::sin(static_cast<double>(3 * patch + k));
}

Columns columns_of_patches(std::size_t rows) {
  Columns light(rows * block_width, 0);
  for (std::size_t i = 0; i < trees().patch_count(); ++i)
    for (std::size_t k = 0; k < block_width; ++k)
      light[i * block_width + k] = static_cast<float>(value_of(i, k));
  return light;
}

/// Adds `of(patch)` of all patches of every element.
template <class OfPatch>
std::vector<double> sums_of_elements(const OfPatch& of) {
  std::vector<double> sums(trees().element_count(), 0);
  for (std::size_t i = 0; i < trees().patch_count(); ++i)
    for (auto e = static_cast<std::int64_t>(i); e >= 0;
         e = trees().parent(static_cast<std::size_t>(e)))
      sums[static_cast<std::size_t>(e)] += of(i);
  return sums;
}

TEST(PullUp, GivesEveryElementTheAreaMeanOfItsPatches) {
  const Hierarchy& mesh = trees();
  ASSERT_GT(mesh.element_count(), mesh.patch_count() + 20);
  Columns light = columns_of_patches(mesh.element_count());
  pull_up(mesh, light);
  std::vector<double> one(mesh.element_count(), 0);
  for (std::size_t i = 0; i < mesh.patch_count(); ++i) one[i] = value_of(i, 5);
  pull_up(mesh, one);
  const auto area = sums_of_elements([&](std::size_t i) { return mesh.area()[i]; });
  for (const std::size_t k : {std::size_t{0}, std::size_t{5}, block_width - 1}) {
    const auto power =
        sums_of_elements([&](std::size_t i) { return mesh.area()[i] * value_of(i, k); });
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
      const double mean = power[e] / area[e];
      EXPECT_NEAR(static_cast<double>(light[e * block_width + k]), mean, 1e-6 * mean);  // floats
      if (k == 5) {
        EXPECT_NEAR(one[e], mean, 1e-12 * mean);
      }
    }
  }
}

TEST(PullUp, LeavesPatchesAlone) {
  Columns light = columns_of_patches(trees().patch_count());
  const Columns before = light;
  pull_up(trees(), light);
  EXPECT_EQ(light, before);
}

TEST(PushDown, GivesPatchesWhatTheElementsAboveThemReceive) {
  const Hierarchy& mesh = trees();
  DoubleColumns received(mesh.element_count() * block_width, 0);
  for (std::size_t at = 0; at < received.size(); ++at)
    received[at] = 1 + std::cos(static_cast<double>(at));
  const DoubleColumns before = received;
  push_down(mesh, received);
  ASSERT_EQ(received.size(), mesh.patch_count() * block_width);
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    for (std::size_t k = 0; k < block_width; ++k) {
      double all = 0;
      for (auto e = static_cast<std::int64_t>(i); e >= 0;
           e = mesh.parent(static_cast<std::size_t>(e)))
        all += before[static_cast<std::size_t>(e) * block_width + k];
      EXPECT_NEAR(received[i * block_width + k], all, 1e-12 * all);
    }
}

}  // namespace
}  // namespace sunload::test
