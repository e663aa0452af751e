// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Suns behind clouds: the share of patches that would see them, by half the rays and no worse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/first_light/direct_sun.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

/// A square of ground of 2 m, over which a roof with a slanting edge casts its shade.
struct Shade {
  Scene scene;
  double truth;  ///< sunlit share of the square
};

/// The shade of the edge runs from (-1, west_y) to (1, east_y).
Shade shade(double west_y, double east_y, Vec3 sun) {
  constexpr double height = 10;
  SceneBuilder b;
  const int black = b.material({"black", 0, 0, 0});
  b.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, black);
  const Vec3 shift = sun * (height / sun.z);
  const double slope = (east_y - west_y) / 2, middle = (east_y + west_y) / 2;
  const auto corner = [&](double x, double y) { return Vec3{x, y, 0} + shift; };
  b.quad(corner(-20, middle - 20 * slope), corner(20, middle + 20 * slope), corner(20, 80),
         corner(-20, 80), black);
  return {b.scene(), (middle + 1) / 2};
}

struct Estimates {
  std::vector<double> share;  ///< of the square that sees the sun, by suns of other numbers
  std::uint64_t rays;
};

Estimates estimates(const Scene& scene, Vec3 sun, double dni, const DirectRules& rules) {
  constexpr std::size_t blocks = 64;
  const Hierarchy hierarchy(scene, {});
  const RayCaster caster(scene.mesh);
  const SunSampler sampler(hierarchy, caster, rules);
  Estimates all{{}, 0};
  for (std::size_t b = 0; b < blocks; ++b) {
    std::vector<IntervalLight> block(block_width, one_second(sun, dni));
    for (std::size_t k = 0; k < block_width; ++k)
      block[k].number = static_cast<std::uint32_t>(b * block_width + k);
    Columns pooled = columns(hierarchy.patch_count()), sunlit = pooled;
    all.rays += direct_sun(caster, sampler, block,
                           {pooled, static_cast<std::size_t>(rules.realizations)}, sunlit);
    for (std::size_t k = 0; k < block_width; ++k)
      all.share.push_back(static_cast<double>(sunlit[k] + sunlit[block_width + k]) /
                          2);  // two triangles
    EXPECT_EQ(std::all_of(pooled.begin(), pooled.end(), [](float E) { return E == 0; }), dni == 0);
  }
  return all;
}

double variance(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double v : values) sum += v, squares += v * v;
  const auto n = static_cast<double>(values.size());
  return (squares - sum * sum / n) / (n - 1);
}

const Vec3 sun = normalized({0.3, -0.8, 0.9});

TEST(CloudedSun, IsSeenByAsMuchOfAPatchAsOneThatShines) {
  for (const auto& [west_y, east_y] : {std::pair{-0.6, 0.1}, {0.3, 0.5}, {-0.2, 0.9}}) {
    const Shade s = shade(west_y, east_y, sun);
    for (const DirectRules rules : {DirectRules{.samples = 16, .realizations = 8},
                                    DirectRules{.samples = 48, .realizations = 2}}) {
      const auto seen = estimates(s.scene, sun, 0, rules);
      const Verdict verdict = expect_mean(seen.share, s.truth, 0);
      EXPECT_TRUE(verdict) << verdict.text;
      EXPECT_FALSE(expect_mean(seen.share, s.truth * 1.04, 0));  // planted
    }
  }
}

TEST(CloudedSun, TakesHalfTheRaysAndErrsNoMore) {
  double clouded = 0, shining = 0, of_few = 0;
  for (const auto& [west_y, east_y] :
       {std::pair{-0.6, 0.1}, {0.3, 0.5}, {-0.2, 0.9}, {-0.9, 0.7}, {0.6, -0.4}}) {
    const Shade s = shade(west_y, east_y, sun);
    const DirectRules rules{.samples = 16, .realizations = 8};
    const auto by_net = estimates(s.scene, sun, 0, rules);
    const auto by_realizations = estimates(s.scene, sun, 1000, rules);
    EXPECT_EQ(2 * by_net.rays, by_realizations.rays);
    clouded += variance(by_net.share);
    shining += variance(by_realizations.share);
    of_few += variance(estimates(s.scene, sun, 0, {.samples = 8, .realizations = 8}).share);
  }
  // 5 × 1024 estimates each: their variances are known to 3 %.
  EXPECT_LT(clouded, 1.1 * shining);
  EXPECT_GT(of_few, 1.1 * shining);  // planted: half of that net
}

TEST(CloudedSun, RealizationsThatAreOneNeedAllTheirSamples) {
  const Shade s = shade(-0.6, 0.1, sun);
  const DirectRules rules{.samples = 16, .realizations = 1};
  EXPECT_EQ(estimates(s.scene, sun, 0, rules).rays, estimates(s.scene, sun, 1000, rules).rays);
}

}  // namespace
}  // namespace sunload::test
