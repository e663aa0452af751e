// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Shares between the points of a grid of suns, against those of the suns themselves.
#include "solver/sight/share_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "geo/mesh/mesh_prepare.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

/// Points know shares in steps of 1/250.
constexpr double step = 0.5 / 250 + 1e-6;

Vec3 sun_at_deg(double azimuth_deg, double elevation_deg) {
  const double a = radians(azimuth_deg), e = radians(elevation_deg);
  return {std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
}

/// A day's suns, some minutes apart.
std::vector<IntervalLight> suns_of_a_day(std::size_t count, double highest_deg = 50) {
  std::vector<IntervalLight> suns;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    suns.push_back(one_second(sun_at_deg(70 + 220 * t, highest_deg * std::sin(pi * t)), 1000));
  }
  return suns;
}

Scene yard(double hedge_transmittance = 0) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const int hedge =
      b.material({.name = "hedge", .diffuse = 0.1, .transmittance = hedge_transmittance});
  b.quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}, grey);
  b.box({-10, -8, 0}, {-2, 6, 9}, grey, SceneBuilder::Facing::outward);
  b.box({4, -9, 0}, {14, 5, 14}, grey, SceneBuilder::Facing::outward);
  b.box({0.5, 0.2, 0}, {0.6, 0.3, 12}, grey, SceneBuilder::Facing::outward);
  b.box({-12, 10, 0}, {12, 11, 2}, hedge, SceneBuilder::Facing::outward);
  return b.scene();
}

struct Sight {
  Scene scene;
  Hierarchy mesh;
  LitShares shares;
  explicit Sight(Scene of)
      : scene(std::move(of)),
        mesh(scene, SplitRules{.max_edge_m = 2}),
        shares(scene, mesh, ray_offset_m(scene.mesh)) {}
};

std::span<const IntervalLight> block_of(const std::vector<IntervalLight>& suns, std::size_t first) {
  return std::span(suns).subspan(first, std::min(block_width, suns.size() - first));
}

TEST(ShareGrid, OpenGroundIsWhollyLitFromWhereverTheSunStands) {
  SceneBuilder b;
  b.quad({0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, b.material({"grey", 0.3, 0, 0}));
  const Sight sight(b.scene());
  const ShareGrid grid(sight.shares);
  for (const double elevation : {0.01, 0.3, 7.0, 45.0, 89.9, 90.0}) {
    std::vector<IntervalLight> suns;
    for (std::size_t k = 0; k < block_width; ++k)
      suns.push_back(one_second(sun_at_deg(22.5 * static_cast<double>(k), elevation), 0));
    const Columns shares = grid.of(suns);
    for (const float share : shares) EXPECT_EQ(share, 1.0f) << elevation;
  }
}

TEST(ShareGrid, ANightHasNone) {
  const Sight sight(yard());
  const ShareGrid grid(sight.shares);
  for (const float share : grid.of(std::vector{night})) EXPECT_EQ(share, LitShares::by_rays);
}

/// Sums over patches and suns that shine upon them, by area.
struct Compared {
  double area = 0, exact = 0, between = 0, squares = 0;
};
Compared compared(const Sight& sight, const std::vector<IntervalLight>& suns, double turned_deg) {
  const ShareGrid grid(sight.shares);
  Compared sum;
  for (std::size_t first = 0; first < suns.size(); first += block_width) {
    const auto block = block_of(suns, first);
    std::vector<IntervalLight> asked(block.begin(), block.end());
    for (IntervalLight& sun : asked) {
      const double a = radians(turned_deg);
      const Vec3 w = sun.direction;
      sun.direction = {std::cos(a) * w.x - std::sin(a) * w.y, std::sin(a) * w.x + std::cos(a) * w.y,
                       w.z};
    }
    const Columns exact = sight.shares.of(block, SendsOn::as_others), between = grid.of(asked);
    for (std::size_t i = 0; i < sight.mesh.patch_count(); ++i)
      for (std::size_t k = 0; k < block.size(); ++k) {
        const std::size_t at = i * block_width + k;
        if (dot(sight.mesh.normal(i), block[k].direction) <= 0) continue;
        if (exact[at] < 0 || between[at] < 0) continue;
        const double area = sight.mesh.area()[i];
        const double off = static_cast<double>(between[at] - exact[at]);
        sum.area += area;
        sum.exact += area * static_cast<double>(exact[at]);
        sum.between += area * static_cast<double>(between[at]);
        sum.squares += area * off * off;
      }
  }
  return sum;
}

TEST(ShareGrid, BetweenItsPointsSharesAreThoseOfTheSunItself) {
  const Sight sight(yard());
  const auto suns = suns_of_a_day(160);
  const Compared right = compared(sight, suns, 0);
  ASSERT_GT(right.exact, 0.3 * right.area);
  ASSERT_LT(right.exact, 0.95 * right.area);
  // A shadow's edge crosses a tenth of the patches, and moves by a third of one between points.
  EXPECT_NEAR(right.between / right.exact, 1, 1e-3);
  EXPECT_LT(std::sqrt(right.squares / right.area), 0.04);
  // Suns that stand a degree and a half beside are told from these.
  const Compared wrong = compared(sight, suns, 1.5);
  EXPECT_GT(wrong.squares, 3 * right.squares);
}

TEST(ShareGrid, AtItsPointsSharesAreThoseOfTheSunToARounding) {
  // The zenith is a point of every such grid.
  const Sight sight(yard());
  const ShareGrid grid(sight.shares);
  const std::vector<IntervalLight> noon{one_second({0, 0, 1}, 0)};
  const Columns exact = sight.shares.of(noon, SendsOn::as_others), at_point = grid.of(noon);
  std::size_t told = 0;
  for (std::size_t i = 0; i < sight.mesh.patch_count(); ++i) {
    const float share = exact[i * block_width];
    if (share < 0) continue;
    ++told;
    EXPECT_NEAR(static_cast<double>(at_point[i * block_width]), static_cast<double>(share), step);
  }
  EXPECT_GT(told, 100u);
}

TEST(ShareGrid, WhatStandsBehindScreensIsLeftToRays) {
  const Sight sight(yard(0.5));
  const ShareGrid grid(sight.shares);
  const auto suns = suns_of_a_day(block_width);
  const Columns exact = sight.shares.of(suns, SendsOn::as_others), between = grid.of(suns);
  std::size_t by_rays = 0;
  for (std::size_t i = 0; i < sight.mesh.patch_count(); ++i)
    for (std::size_t k = 0; k < suns.size(); ++k)
      if (dot(sight.mesh.normal(i), suns[k].direction) > 0.05 &&
          between[i * block_width + k] == LitShares::by_rays)
        ++by_rays;
  EXPECT_GT(by_rays, 10u);
}

TEST(ShareGrid, WhatWasAskedBeforeAndTheThreadsChangeNothing) {
  const Sight sight(yard());
  const auto suns = suns_of_a_day(64), others = suns_of_a_day(48, 20);
  const ShareGrid first(sight.shares), second(sight.shares);
  first.prepare(suns);
  set_thread_count(3);
  for (std::size_t at = 0; at < others.size(); at += block_width) second.of(block_of(others, at));
  for (std::size_t at = suns.size(); at > 0; at -= block_width)
    EXPECT_EQ(first.of(block_of(suns, at - block_width)),
              second.of(block_of(suns, at - block_width)));
  set_thread_count(2);
}

TEST(ShareGrid, SaysHowManyPointsItNeeds) {
  const std::vector<Vec3> one{sun_at_deg(180, 40)};
  EXPECT_EQ(ShareGrid::points_about(one), 4u);
  const std::vector<Vec3> same(100, one.front());
  EXPECT_EQ(ShareGrid::points_about(same), 4u);
}

}  // namespace
}  // namespace sunload::test
