// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/beam_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace sunload::test {
namespace {

/// Squares on a grid seen along its normal, each at a depth of its own or absent.
class Squares {
 public:
  Squares(int size, std::mt19937& random) : size_(size), depth_(cells(), absent) {
    const Tangents axes = tangents(w);
    const auto point = [&](double x, double y, double z) {
      return x * axes.tangent + y * axes.bitangent + z * w;
    };
    const auto add = [&](double x0, double x1, double y0, double y1, double z) {
      section_.push_back({point(x0, y0, z), point(x1, y0, z), point(x1, y1, z), point(x0, y1, z)});
    };
    // Behind all that asks: extends the raster over the grid, and nothing more.
    add(0, size, 0, size, behind);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        if (random() % 4 != 0) continue;
        depth(x, y) = static_cast<double>(random() % 9);
        add(x + 0.3, x + 0.7, y + 0.3, y + 0.7, depth(x, y));
      }
  }

  BeamRaster raster(double spread = 0) const { return {section_, w, spread, size_}; }

  /// A rectangle over whole cells, both ends included.
  struct Rectangle {
    int x0, x1, y0, y1;
    double z;
  };
  std::vector<Vec3> corners(const Rectangle& r) const {
    const Tangents axes = tangents(w);
    std::vector<Vec3> points;
    for (const double x : {r.x0 + 0.4, r.x1 + 0.6})
      for (const double y : {r.y0 + 0.4, r.y1 + 0.6})
        points.push_back(x * axes.tangent + y * axes.bitangent + r.z * w);
    return points;
  }
  bool any_ahead(const Rectangle& r) const {
    for (int y = r.y0; y <= r.y1; ++y)
      for (int x = r.x0; x <= r.x1; ++x)
        if (depth_[static_cast<std::size_t>(y * size_ + x)] > r.z) return true;
    return false;
  }

 private:
  static constexpr double absent = -50, behind = -50;
  static constexpr Vec3 w{0, 0, 1};
  std::size_t cells() const { return static_cast<std::size_t>(size_ * size_); }
  double& depth(int x, int y) { return depth_[static_cast<std::size_t>(y * size_ + x)]; }

  int size_;
  std::vector<double> depth_;
  std::vector<ConvexPolygon> section_;
};

TEST(BeamRaster, AnswersAsEveryCellOfTheRangeDoes) {
  std::mt19937 random(1);
  for (const int size : {1, 2, 5, 16, 19}) {
    const Squares squares(size, random);
    const BeamRaster raster = squares.raster();
    int met = 0, missed = 0;
    for (int i = 0; i < 4000; ++i) {
      const auto ends = [&] {
        const auto cells = static_cast<unsigned>(size);
        return std::minmax(
            {static_cast<int>(random() % cells), static_cast<int>(random() % cells)});
      };
      const auto [x0, x1] = ends();
      const auto [y0, y1] = ends();
      const Squares::Rectangle r{x0, x1, y0, y1, static_cast<double>(random() % 10) - 0.5};
      ASSERT_EQ(raster.may_meet(squares.corners(r)), squares.any_ahead(r))
          << size << ": " << x0 << ' ' << x1 << ' ' << y0 << ' ' << y1 << ' ' << r.z;
      ++(squares.any_ahead(r) ? met : missed);
    }
    if (size > 2) {
      EXPECT_GT(met, 100);
    }
    EXPECT_GT(missed, 100);
  }
}

TEST(BeamRaster, NothingBesideItIsMet) {
  std::mt19937 random(2);
  const Squares squares(8, random);
  const BeamRaster raster = squares.raster();
  EXPECT_FALSE(raster.may_meet(squares.corners({9, 12, 0, 7, -10})));
  EXPECT_FALSE(raster.may_meet(squares.corners({0, 7, -9, -3, -10})));
  EXPECT_TRUE(raster.may_meet(squares.corners({-9, 12, -9, 12, -10})));
}

TEST(BeamRaster, TrianglesSideBySideAreToldAsEachByItself) {
  std::mt19937 random(3);
  const Squares squares(64, random);
  std::uniform_real_distribution<double> place(-8, 72), aside(-3, 3), depth(-60, 10);
  for (const double spread : {0.0, 0.02}) {
    const BeamRaster raster = squares.raster(spread);
    int met = 0, missed = 0;
    for (std::size_t count : {TriangleColumns::most, std::size_t{1}, std::size_t{17}}) {
      for (int i = 0; i < 100; ++i) {
        TriangleColumns triangles;
        std::uint64_t each = 0;
        const std::uint64_t asked = random() | std::uint64_t{random()} << 32;
        for (std::size_t l = 0; l < count; ++l) {
          const Vec3 at{place(random), place(random), depth(random)};
          const double wide = l % 8 == 0 ? 10 : 1;  // some over many cells
          const auto corner = [&] {
            return at + wide * Vec3{aside(random), aside(random), aside(random)};
          };
          const std::array<Vec3, 3> corners{corner(), corner(), corner()};
          triangles.add(corners);
          const bool is_met = raster.may_meet(corners);
          ++(is_met ? met : missed);
          each |= std::uint64_t{is_met} << l;
        }
        const std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
        ASSERT_EQ(raster.may_meet_each(triangles, asked & there), each & asked & there);
      }
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(missed, 1000);
  }
}

}  // namespace
}  // namespace sunload::test
