// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/lit_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geo/base/units.h"
#include "solver/base/rng.h"

namespace sunload::test {
namespace {

/// Of sums and products of coordinates of some metres.
constexpr double rounding = 1e-12;

ViewPolygon polygon(const std::vector<ViewCorner>& corners) {
  ViewPolygon p;
  for (const auto& corner : corners) p.add(corner);
  return p;
}
ViewPolygon rectangle(double x0, double y0, double x1, double y1) {
  return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
ViewPolygon regular(double x, double y, double radius, std::size_t corners, double turn) {
  ViewPolygon p;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = turn + 2 * pi * static_cast<double>(k) / static_cast<double>(corners);
    p.add({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return p;
}

std::optional<double> share(const ViewPolygon& p, const std::vector<ViewPolygon>& shades) {
  std::vector<const ViewPolygon*> all;
  for (const auto& shade : shades) all.push_back(&shade);
  return LitArea().share(p, all);
}

TEST(LitArea, WithoutShadesIsAll) { EXPECT_EQ(share(rectangle(0, 0, 2, 1), {}), 1.0); }

TEST(LitArea, ShadesApartTakeNothingAndThoseOverAllTakeAll) {
  const auto square = rectangle(0, 0, 1, 1);
  EXPECT_EQ(share(square, {rectangle(1, 0, 2, 1), rectangle(-3, -3, -1, 9)}), 1.0);
  EXPECT_EQ(share(square, {rectangle(-1, -1, 2, 2)}), 0.0);
  EXPECT_EQ(share(square, {rectangle(0, 0, 0.5, 1), rectangle(0.5, 0, 1, 1)}), 0.0);
}

TEST(LitArea, CountsWhatSeveralShadesCoverOnce) {
  const auto square = rectangle(0, 0, 1, 1);
  const auto left = rectangle(-1, -1, 0.5, 2), low = rectangle(-1, -1, 2, 0.25);
  EXPECT_NEAR(*share(square, {left}), 0.5, rounding);
  EXPECT_NEAR(*share(square, {left, low}), 0.375, rounding);
  EXPECT_NEAR(*share(square, {left, low, left, low}), 0.375, rounding);
}

TEST(LitArea, LeavesTheRimAboutAHole) {
  EXPECT_NEAR(*share(rectangle(0, 0, 4, 4), {rectangle(1, 1, 2, 3)}), 14.0 / 16, rounding);
  EXPECT_NEAR(*share(rectangle(-2, -2, 2, 2), {regular(0, 0, 1, 12, 0.1)}), 1 - 3.0 / 16, rounding);
}

/// Triangles anywhere, in any order, against points counted on a grid of n × n: a line through it
/// splits at most 2n of its n² cells.
TEST(LitArea, AgreesWithCountedPointsInAnyOrder) {
  constexpr int n = 400;
  std::uint64_t drawn = 0;
  const auto next = [&] {
    const auto words = random_lanes({.seed = 5,
                                     .purpose = Purpose::direct_sun,
                                     .realization = 0,
                                     .element = drawn++,
                                     .sun = 0});
    return static_cast<double>(uniform(words.word[0][0]));
  };
  const auto square = rectangle(0, 0, 1, 1);
  for (int scene = 0; scene < 20; ++scene) {
    std::vector<ViewPolygon> shades;
    const int count = 1 + scene % 6;
    for (int s = 0; s < count; ++s)
      shades.push_back(
          regular(next(), next(), 0.1 + 0.4 * next(), 3 + static_cast<std::size_t>(s % 4), next()));
    int lit = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const ViewCorner p{(i + 0.5) / n, (j + 0.5) / n};
        const auto covers = [&](const ViewPolygon& shade) {
          for (std::size_t k = 0; k < shade.size(); ++k)
            if (line_through(shade[k], shade[(k + 1) % shade.size()]).beyond(p) > 0) return false;
          return true;
        };
        lit += std::none_of(shades.begin(), shades.end(), covers);
      }
    const auto found = share(square, shades);
    ASSERT_TRUE(found.has_value());
    const double edges = 6.0 * count;
    EXPECT_NEAR(*found, lit / static_cast<double>(n * n), 2 * edges / n / 8);
    std::reverse(shades.begin(), shades.end());
    EXPECT_NEAR(*share(square, shades), *found, rounding);
  }
}

/// Slits that cross, so many each way, of that width.
std::vector<ViewPolygon> crossing_slits(int count, double width) {
  std::vector<ViewPolygon> shades;
  for (int i = 0; i < count; ++i) {
    const double at = (i + 0.25) / count;
    shades.push_back(rectangle(at, -1, at + width, 2));
    shades.push_back(rectangle(-1, at, 2, at + width));
  }
  return shades;
}

// In one go they leave some 200 pieces; halves have few enough.
TEST(LitArea, HalvesWhatManyThinShadesCut) {
  EXPECT_NEAR(*share(rectangle(0, 0, 1, 1), crossing_slits(14, 0.002)), std::pow(1 - 14 * 0.002, 2),
              rounding);
  // Shadows of poles on a wide ground, more of them than are looked at at once.
  std::vector<ViewPolygon> poles;
  for (int i = 0; i < 120; ++i) poles.push_back(rectangle(i, 3, i + 0.03, 9));
  EXPECT_NEAR(*share(rectangle(-10, 0, 150, 40), poles), 1 - 120 * 0.03 * 6 / (160.0 * 40),
              rounding);
}

/// A heap of houses in a corner of a wide ground: none of a few samples need fall there.
TEST(LitArea, HalvesTowardsWhatLiesInACorner) {
  std::vector<ViewPolygon> heap;
  for (int i = 0; i < 40; ++i) heap.push_back(rectangle(1 + 0.1 * i, 1, 1.2 + 0.1 * i, 3));
  EXPECT_NEAR(*share(rectangle(0, 0, 100, 80), heap), 1 - (3.9 + 0.2) * 2 / (100.0 * 80), rounding);
}

/// More pieces than anybody counts.
TEST(LitArea, GivesUpOnTooManyPieces) {
  EXPECT_FALSE(share(rectangle(0, 0, 1, 1), crossing_slits(14, 0.02)).has_value());  // not thin
  EXPECT_FALSE(share(rectangle(0, 0, 1, 1), crossing_slits(80, 0.002)).has_value());
}

}  // namespace
}  // namespace sunload::test
