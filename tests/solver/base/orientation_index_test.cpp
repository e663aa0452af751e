// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Orientations that are nearly the same are found, as by looking at all of them.
#include "solver/base/orientation_index.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/rng.h"

namespace sunload::test {
namespace {

Vec3 random_direction(std::uint32_t number) {
  const RandomWords words = random_words({.seed = 5, .element = number});
  const double z = 2 * static_cast<double>(uniform(words[0])) - 1;
  const double a = 6.283185307179586 * static_cast<double>(uniform(words[1]));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

/// The first of `units` within the angle.
std::int32_t first_within(const std::vector<Vec3>& units, Vec3 n, double angle) {
  for (std::size_t i = 0; i < units.size(); ++i)
    if (dot(units[i], n) >= std::cos(angle)) return static_cast<std::int32_t>(i);
  return -1;
}

TEST(OrientationIndex, FindsTheFirstWithinTheAngle) {
  for (const double angle : {1e-3, 0.05, 0.5, 3.0}) {
    OrientationIndex index(angle);
    std::vector<Vec3> units;
    int found = 0;
    for (std::uint32_t i = 0; i < 3000; ++i) {
      Vec3 n = random_direction(i);
      if (i % 3 == 1) n = normalized(units[i / 2] + random_direction(i) * (0.8 * angle));
      const std::int32_t number = index.find(n);
      ASSERT_EQ(number, first_within(units, n, angle)) << angle << ", " << i;
      if (number >= 0) ++found;
      index.add(n, static_cast<std::int32_t>(units.size()));
      units.push_back(n);
    }
    EXPECT_GT(found, 500) << angle;
  }
}

TEST(OrientationIndex, KnowsTheAxesAndTheirNeighbours) {
  OrientationIndex index(1e-3);
  index.add({0, 0, 1}, 7);
  EXPECT_EQ(index.find({0, 0, 1}), 7);
  EXPECT_EQ(index.find(normalized({-0.0009, 0, 1})), 7);
  EXPECT_EQ(index.find(normalized({0.0009, 0, 1})), 7);
  EXPECT_EQ(index.find(normalized({0, 0.0011, 1})), -1);
  EXPECT_EQ(index.find({0, 0, -1}), -1);
}

}  // namespace
}  // namespace sunload::test
