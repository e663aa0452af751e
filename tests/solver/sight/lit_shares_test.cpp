// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Shares of patches that see the sun: closed forms, and what a thousand rays tell of each.
#include "solver/sight/lit_shares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "geo/mesh/mesh_prepare.h"
#include "io/scene/file.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/first_light/direct_sun.h"
#include "tests/support/real_models.h"
#include "tests/support/scenes.h"
#include "tests/support/sights.h"

namespace sunload::test {
namespace {

constexpr double disk = 0.00465;  // the sun's half-angle

double random_number(std::uint32_t seed, std::uint64_t element) {
  const auto words = random_lanes({.seed = seed,
                                   .purpose = Purpose::direct_sun,
                                   .realization = 0,
                                   .element = element,
                                   .sun = 0});
  return static_cast<double>(uniform(words.word[0][0]));
}

/// Suns that stand close together, as those of one hour in many days do.
std::vector<IntervalLight> suns_in_a_row(double disk_half_angle = 0) {
  std::vector<Vec3> directions;
  for (int k = 0; k < 16; ++k) directions.push_back(sun_at(1 + 0.004 * k, 0.3 + 0.02 * k));
  return block_of(directions, disk_half_angle);
}

/// Houses, a mast of 10 cm, a roof on thin air, a hedge half sunk into the ground.
SceneBuilder quarter(double hedge_transmittance) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const int hedge =
      b.material({.name = "hedge", .diffuse = 0.1, .transmittance = hedge_transmittance});
  b.quad({-40, -40, 0}, {40, -40, 0}, {40, 40, 0}, {-40, 40, 0}, grey);
  b.box({-10, -8, 0}, {-2, 6, 9}, grey, SceneBuilder::Facing::outward);
  b.box({4, -9, 0}, {14, 5, 14}, grey, SceneBuilder::Facing::outward);
  b.box({0.5, 0.2, 0}, {0.6, 0.3, 12}, grey, SceneBuilder::Facing::outward);
  b.box({-12, 10, -1}, {12, 11, 2}, hedge, SceneBuilder::Facing::outward);
  b.sides(Sides::two).quad({-20, -20, 6}, {-14, -20, 6}, {-14, -12, 7}, {-20, -12, 7}, grey);
  return b;
}

/// Triangles that cut each other, none of them closed, with edges in common where they touch.
Scene soup(std::uint32_t number) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  b.sides(Sides::two);
  std::uint64_t drawn = 0;
  const auto next = [&] { return random_number(number, drawn++); };
  const auto point = [&](double size) {
    return Vec3{(next() - 0.5) * size, (next() - 0.5) * size, next() * size};
  };
  for (int fan = 0; fan < 25; ++fan) {
    const Vec3 at = point(30);
    std::vector<Vec3> strip{at, at + point(6), at + point(6)};
    for (int i = 0; i < 5; ++i) strip.push_back(strip.back() + point(5));
    for (std::size_t i = 2; i < strip.size(); ++i)
      b.triangle(strip[i - 2], strip[i - 1], strip[i], grey);
  }
  return b.scene();
}

Columns shares_of(const Scene& scene, const Hierarchy& mesh,
                  const std::vector<IntervalLight>& block) {
  return LitShares(scene, mesh, ray_offset_m(scene.mesh)).of(block);
}

/// The same by rays.
Columns shares_by_rays(const Scene& scene, const Hierarchy& mesh,
                       const std::vector<IntervalLight>& block, int rays) {
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  const SunSampler sampler(mesh, caster, {.samples = rays, .realizations = 1});
  Columns pooled = columns(mesh.patch_count()), sunlit = pooled;
  direct_sun(caster, sampler, block, {pooled, 1}, sunlit);
  return sunlit;
}

/// Slivers of a centimetre are as large as what single precision does to rays' origins.
constexpr double too_small_m2 = 1e-4;

struct Comparison {
  std::size_t facing = 0, by_rays = 0;  ///< pairs of patch and sun
  double worst = 0;
  double sum = 0, sum_by_rays = 0;  ///< of shares
  double squares = 0;               ///< of differences
};

Comparison compared(const Scene& scene, const Hierarchy& mesh,
                    const std::vector<IntervalLight>& block, int rays) {
  const Columns shares = shares_of(scene, mesh, block);
  const Columns by_rays = shares_by_rays(scene, mesh, block, rays);
  Comparison all;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (mesh.area()[i] < too_small_m2 || dot(mesh.normal(i), block[k].direction) <= 0) continue;
      ++all.facing;
      const auto share = static_cast<double>(shares[i * block_width + k]);
      if (share < 0) {
        ++all.by_rays;
        continue;
      }
      const auto seen = static_cast<double>(by_rays[i * block_width + k]);
      all.worst = std::max(all.worst, std::abs(share - seen));
      all.squares += (share - seen) * (share - seen);
      all.sum += share;
      all.sum_by_rays += seen;
    }
  std::cout << all.facing << " pairs, " << all.by_rays << " left to rays, differences at most "
            << all.worst << ", of sums " << all.sum / all.sum_by_rays - 1 << "\n";
  return all;
}

/// A scrambled net of n points in the square errs where a line cuts it by no more than a few
/// n^-3/4 (He & Wang 2015), and no pair by more than where all of a row of n^1/2 points is on the
/// wrong side of several edges.
void expect_the_same(const Scene& scene, double max_edge_m, const std::vector<IntervalLight>& block,
                     double most_left) {
  constexpr int rays = 1024;
  const Hierarchy mesh(scene, {.max_edge_m = max_edge_m});
  const Comparison found = compared(scene, mesh, block, rays);
  const auto known = static_cast<double>(found.facing - found.by_rays);
  EXPECT_LE(static_cast<double>(found.by_rays), most_left * static_cast<double>(found.facing));
  EXPECT_LT(found.worst, 3 * std::pow(rays, -0.5));
  EXPECT_LT(std::sqrt(found.squares / known), 2 * std::pow(rays, -0.75));
  // Of all pairs together errors average out: 5 standard errors.
  EXPECT_LT(std::abs(found.sum - found.sum_by_rays), 5 * std::sqrt(found.squares));
}

/// The shadow of a plate on the ground is a plate: patches together lack its area.
TEST(LitShares, OfAPlatesShadowAreExact) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  b.quad({-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}, grey);
  b.sides(Sides::two).quad({-1, -2, 4}, {2, -2, 4}, {2, 3, 4}, {-1, 3, 4}, grey);
  const Scene scene = b.scene();
  const Hierarchy mesh(scene, {.max_edge_m = 0.7});
  const auto block = block_of({sun_at(0.3, 1.5), sun_at(2, 0.9), sun_at(-2.2, 0.5)}, 0);
  const Columns shares = shares_of(scene, mesh, block);
  for (std::size_t k = 0; k < block.size(); ++k) {
    double lit = 0, ground = 0;
    for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
      if (mesh.patches()[i].triangle > 1) continue;
      ground += mesh.area()[i];
      lit += mesh.area()[i] * static_cast<double>(shares[i * block_width + k]);
    }
    // Shares are floats, of 1600 m² in patches of a quarter of a square metre.
    EXPECT_NEAR(ground - lit, 15, 1e-5) << k;
  }
}

TEST(LitShares, AreWhatRaysTellOfHouses) {
  for (const auto& block : {suns_all_about(16), suns_in_a_row()}) {
    expect_the_same(quarter(0).scene(), 2, block, 0);
    expect_the_same(turned(quarter(0).scene()), 2, block, 0);
  }
}

TEST(LitShares, AreWhatRaysTellOfSoups) {
  for (std::uint32_t number = 0; number < 4; ++number)
    expect_the_same(soup(number), 0.8, number % 2 == 0 ? suns_all_about(8) : suns_in_a_row(), 0.1);
}

TEST(LitShares, AreWhatRaysTellOfARealQuarter) {
  SUNLOAD_NEEDS_MODEL("data/city/rotterdam_subset_v20.city.json");
  Scene scene;
  scene.mesh =
      prepare(read_scene_file(shared_path("data/city/rotterdam_subset_v20.city.json"), {}), {})
          .mesh;
  scene.materials = {{"grey", 0.3, 0, 0}};
  scene.material.assign(scene.mesh.triangle_count(), MaterialId{0});
  expect_the_same(scene, 2.5, suns_all_about(8), 0.02);
}

/// A disk is seen by all of a patch or by none of it; the rest is for rays.
TEST(LitShares, OfASunWithADiskAreWholeOrLeftToRays) {
  const Scene scene = turned(quarter(0).scene());
  const Hierarchy mesh(scene, {.max_edge_m = 2});
  for (const auto& block : {suns_all_about(16, disk), suns_in_a_row(disk)}) {
    const Comparison found = compared(scene, mesh, block, 256);
    EXPECT_EQ(found.worst, 0);
    EXPECT_LT(found.by_rays, found.facing / 4);
  }
}

/// Of a sun that sets, light of the lower part of the disk goes upward.
TEST(LitShares, OfASettingSunAreWholeOrLeftToRays) {
  const Scene scene = turned(quarter(0).scene());
  const Hierarchy mesh(scene, {.max_edge_m = 2});
  std::vector<Vec3> directions;
  for (int k = 0; k < 16; ++k) directions.push_back(sun_at(2.4 * k, disk * (k % 4 + 0.1) / 4));
  const Comparison found = compared(scene, mesh, block_of(directions, disk), 256);
  EXPECT_EQ(found.worst, 0);
  EXPECT_LT(found.by_rays, found.facing);
}

TEST(LitShares, LeaveToRaysWhatLightPassesByChance) {
  const Scene scene = turned(quarter(0.4).scene());
  const Hierarchy mesh(scene, {.max_edge_m = 1.5});
  const Comparison found = compared(scene, mesh, suns_all_about(16), 256);
  EXPECT_GT(found.by_rays, found.facing / 200);
  EXPECT_LT(found.by_rays, found.facing / 4);
  EXPECT_LT(found.worst, 3 * std::pow(256, -0.5));
}

/// A half plane of shade passes over mirrors and walls: of mirrors at its edge rays must tell.
TEST(LitShares, LeaveToRaysWhereAnEdgeCrossesWhatSendsLightOn) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const int mirror = b.material({"mirror", 0.1, 0.6, 0});
  b.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, grey);
  b.quad({8, 0, 0}, {12, 0, 0}, {12, 4, 0}, {8, 4, 0}, mirror);
  b.sides(Sides::two).quad({-50, 2.8, 3}, {50, 2.8, 3}, {50, 90, 3}, {-50, 90, 3}, grey);
  const Scene scene = b.scene();
  const Hierarchy mesh(scene, {.max_edge_m = 1});
  const auto shares = shares_of(scene, mesh, block_of({sun_at(0.5 * pi, 1.2)}, 0));
  std::array<std::size_t, 2> parts{}, wholes{};
  for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
    if (mesh.patches()[i].triangle > 3) continue;
    const bool is_mirror = mesh.patches()[i].triangle > 1;
    const float share = shares[i * block_width];
    EXPECT_TRUE(is_mirror || share >= 0) << i;
    ++(share == 0 || share == 1 ? wholes : parts)[is_mirror];
    EXPECT_TRUE(!is_mirror || share == 0 || share == 1 || share == LitShares::by_rays) << i;
  }
  EXPECT_GT(parts[0], 4u);
  EXPECT_GT(wholes[0], 4u);
  EXPECT_EQ(parts[0], parts[1]);
}

TEST(LitShares, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = turned(quarter(0).scene());
  const Hierarchy mesh(scene, {.max_edge_m = 1.5});
  const int before = thread_count();
  set_thread_count(1);
  const auto one = shares_of(scene, mesh, suns_all_about(16));
  set_thread_count(3);
  EXPECT_EQ(shares_of(scene, mesh, suns_all_about(16)), one);
  set_thread_count(before);
}

/// Bits, or that rays must tell: what a sun has does not depend on the suns that are asked for
/// beside it, as the batches of a run put them together.
void expect_independence(const Scene& scene, const std::vector<IntervalLight>& block) {
  const Hierarchy mesh(scene, {.max_edge_m = 1.5});
  const Columns together = shares_of(scene, mesh, block);
  for (std::size_t k = 0; k < block.size(); ++k) {
    const Columns alone = shares_of(scene, mesh, {block[k]});
    for (std::size_t i = 0; i < mesh.patch_count(); ++i)
      ASSERT_EQ(alone[i * block_width], together[i * block_width + k]) << i << " of sun " << k;
  }
}

TEST(LitShares, DoNotDependOnOtherSuns) {
  for (const double half_angle : {0.0, disk})
    for (const double hedge_transmittance : {0.0, 0.4}) {
      Scene scene = turned(quarter(hedge_transmittance).scene());
      expect_independence(scene, suns_in_a_row(half_angle));
      scene.materials.front().mirror = 0.6;
      expect_independence(scene, suns_in_a_row(half_angle));
    }
}

/// The middle of suns that stand close together sees the roof from behind, the last of them from
/// before it.
TEST(LitShares, DoNotDependOnOtherSunsWhereSomeGrazeARoof) {
  constexpr double slope = 40 * radians_per_degree;
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const double ridge = 10 + 4 * std::tan(slope), eaves = 10 - 4 * std::tan(slope);
  b.quad({-6, -4, ridge}, {6, -4, ridge}, {6, 4, eaves}, {-6, 4, eaves}, grey);
  b.box({-1.5, -2.5, 8}, {-0.5, -1.7, 13}, grey, SceneBuilder::Facing::outward);
  b.box({2.2, -1.1, 8}, {3.1, -0.4, 12}, grey, SceneBuilder::Facing::outward);
  std::vector<Vec3> directions;
  for (int k = 0; k < 16; ++k)
    directions.push_back(sun_at(-1.5 + 0.001 * k, (38.1 + 0.2 * k) * radians_per_degree));
  expect_independence(b.scene(), block_of(directions));
}

/// Direct sun by shares is the same in all realizations.
TEST(LitShares, MakeDirectSunWithoutNoise) {
  const Scene scene = turned(quarter(0).scene());
  const Hierarchy mesh(scene, {.max_edge_m = 2});
  const auto block = suns_all_about(16);
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  const SunSampler sampler(mesh, caster, {});
  const std::size_t n = mesh.patch_count();
  Columns pooled = columns(n), sunlit = pooled;
  std::vector<std::vector<double>> exposure(8, std::vector<double>(n, 0));
  std::vector<Columns> each(8, columns(n));
  const Columns shares = shares_of(scene, mesh, block);
  EXPECT_EQ(direct_sun(caster, sampler, block, {pooled, 8, {{&exposure, lengths_of(block)}}, &each},
                       sunlit, shares),
            0u);
  for (std::size_t r = 0; r < 8; ++r) {
    EXPECT_EQ(each[r], pooled);
    EXPECT_EQ(exposure[r], exposure[0]);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < block.size(); ++k) {
      const double cos_theta = dot(mesh.normal(i), block[k].direction);
      if (cos_theta <= 0) continue;
      const std::size_t at = i * block_width + k;
      EXPECT_EQ(sunlit[at], shares[at]);
      EXPECT_NEAR(pooled[at], 1000 * cos_theta * static_cast<double>(shares[at]), 1e-3);
    }
}

/// A planted fault: what has lost a house does not tell what rays tell.
TEST(LitShares, ComparisonSeesAMissingHouse) {
  const Scene scene = quarter(0).scene();
  Scene without = scene;
  for (std::size_t t = 2; t < 14; ++t) without.mesh.triangles[t] = {0, 0, 0};
  const Hierarchy mesh(scene, {.max_edge_m = 1.5});
  const auto block = suns_all_about(16);
  const Columns shares = shares_of(without, mesh, block);
  const Columns by_rays = shares_by_rays(scene, mesh, block, 64);
  float worst = 0;
  for (std::size_t i = 0; i < by_rays.size(); ++i)
    if (shares[i] >= 0) worst = std::max(worst, std::abs(shares[i] - by_rays[i]));
  EXPECT_EQ(worst, 1);
}

}  // namespace
}  // namespace sunload::test
