// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What shafts and views tell of patches and suns is what all rays tell: the same bits, fewer rays.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <iostream>

#include "geo/mesh/mesh_prepare.h"
#include "io/scene/file.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/first_light/direct_sun.h"
#include "solver/sight/sun_shafts.h"
#include "solver/sight/sun_views.h"
#include "tests/support/real_models.h"
#include "tests/support/scenes.h"

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

/// A block of suns from all sides, some of them low, along axes and diagonals.
std::vector<IntervalLight> suns(std::size_t count, double disk_half_angle) {
  std::vector<IntervalLight> block;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double azimuth = k % 4 == 3 ? k * pi / 4 : 2.4 * k, height = 0.02 + 0.09 * k;
    block.push_back(one_second({std::cos(height) * std::cos(azimuth),
                                std::cos(height) * std::sin(azimuth), std::sin(height)},
                               1000));
    block.back().number = k;
    if (k % 5 == 1) block.back().dni = 0;  // behind clouds
    block.back().disk_half_angle = disk_half_angle;
  }
  return block;
}

struct Sunlight {
  Columns pooled, sunlit;
  std::vector<std::vector<double>> exposure;
  std::uint64_t rays;
  double seconds;
};

enum class Known { nothing, by_shafts, by_views };

std::vector<Vec3> directions(const std::vector<IntervalLight>& block) {
  std::vector<Vec3> all;
  for (const auto& sun : block) all.push_back(sun.direction);
  return all;
}

std::vector<SunSight> sights(Known known, const Scene& scene, const Hierarchy& mesh,
                             const std::vector<IntervalLight>& block) {
  const double offset = ray_offset_m(scene.mesh);
  if (known == Known::by_shafts) return SunShafts(scene, mesh, offset).sights(block);
  if (known == Known::by_views)
    return SunViews(scene, mesh, offset, directions(block)).sights(block);
  return {};
}

Sunlight sunlight(const Scene& scene, const SplitRules& split,
                  const std::vector<IntervalLight>& block, Known known) {
  const DirectRules rules;
  const Hierarchy mesh(scene, split);
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  const SunSampler sampler(mesh, caster, rules);
  const auto realizations = static_cast<std::size_t>(rules.realizations);
  const std::size_t n = mesh.patch_count();
  Sunlight light{columns(n), columns(n), {realizations, std::vector<double>(n, 0)}, 0, 0};
  const auto start = std::clock();
  light.rays =
      direct_sun(caster, sampler, block, {light.pooled, realizations, &light.exposure, nullptr},
                 light.sunlit, sights(known, scene, mesh, block));
  light.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return light;
}

/// Rays with what is known for one without, the more of both.
double expect_the_same(const Scene& scene, double max_edge_m, std::size_t count,
                       double disk_half_angle = 0) {
  const auto block = suns(count, disk_half_angle);
  const SplitRules split{.max_edge_m = max_edge_m};
  const Sunlight all = sunlight(scene, split, block, Known::nothing);
  double most = 0;
  for (const Known known : {Known::by_shafts, Known::by_views}) {
    const Sunlight few = sunlight(scene, split, block, known);
    EXPECT_EQ(few.pooled, all.pooled);
    EXPECT_EQ(few.sunlit, all.sunlit);
    EXPECT_EQ(few.exposure, all.exposure);
    const double rays = static_cast<double>(few.rays) / static_cast<double>(all.rays);
    std::cout << all.rays << " rays, share left " << rays << ", processor time "
              << few.seconds / all.seconds << " of " << all.seconds << " s\n";
    most = std::max(most, rays);
  }
  return most;
}

/// Houses, a mast of 10 cm, a roof on thin air, a hedge half sunk into the ground; turned so that
/// nothing is along an axis.
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

Scene turned(Scene scene) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  for (Vec3& p : scene.mesh.vertices) p = {c * p.x - s * p.y + 1.7, s * p.x + c * p.y - 0.9, p.z};
  return scene;
}

TEST(Sights, TellWhatRaysTellOfHouses) {
  for (const double half_angle : {0.0, disk}) {
    EXPECT_LT(expect_the_same(quarter(0).scene(), 2, 16, half_angle), 0.5);
    EXPECT_LT(expect_the_same(turned(quarter(0).scene()), 2, 16, half_angle), 0.5);
  }
}

TEST(Sights, LeaveToRaysWhatLightPasses) {
  EXPECT_LT(expect_the_same(turned(quarter(0.4).scene()), 1.5, 16), 0.6);
}

/// Triangles that cut each other, none of them closed, with edges in common where they touch.
TEST(Sights, TellWhatRaysTellOfSoups) {
  for (std::uint32_t soup = 0; soup < 6; ++soup) {
    SceneBuilder b;
    const int grey = b.material({"grey", 0.3, 0, 0});
    b.sides(Sides::two);
    std::uint64_t drawn = 0;
    const auto next = [&] { return random_number(soup, drawn++); };
    const auto point = [&](double size) {
      return Vec3{(next() - 0.5) * size, (next() - 0.5) * size, next() * size};
    };
    for (int fan = 0; fan < 25; ++fan) {
      // A strip that bends: some of its edges are silhouettes, some are not.
      const Vec3 at = point(30);
      std::vector<Vec3> strip{at, at + point(6), at + point(6)};
      for (int i = 0; i < 5; ++i) strip.push_back(strip.back() + point(5));
      for (std::size_t i = 2; i < strip.size(); ++i)
        b.triangle(strip[i - 2], strip[i - 1], strip[i], grey);
    }
    expect_the_same(b.scene(), 0.8, 8, soup % 2 == 0 ? 0 : disk);
  }
}

TEST(Sights, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = turned(quarter(0).scene());
  const Hierarchy mesh(scene, {.max_edge_m = 1.5});
  for (const Known known : {Known::by_shafts, Known::by_views}) {
    const int before = thread_count();
    set_thread_count(1);
    const auto one = sights(known, scene, mesh, suns(16, 0));
    set_thread_count(3);
    EXPECT_EQ(sights(known, scene, mesh, suns(16, 0)), one);
    set_thread_count(before);
  }
}

/// A planted fault: what has lost a house tells something else.
TEST(Sights, ComparisonSeesAMissingHouse) {
  const Scene scene = quarter(0).scene();
  Scene without = scene;
  for (std::size_t t = 2; t < 14; ++t) without.mesh.triangles[t] = {0, 0, 0};
  const Hierarchy mesh(scene, {.max_edge_m = 1.5});
  for (const Known known : {Known::by_shafts, Known::by_views})
    EXPECT_NE(sights(known, without, mesh, suns(16, 0)), sights(known, scene, mesh, suns(16, 0)));
}

/// Suns that nobody expected are left to rays.
TEST(SunViews, KnowNothingOfOtherSuns) {
  const Scene scene = quarter(0).scene();
  const Hierarchy mesh(scene, {.max_edge_m = 3});
  const auto expected = suns(4, 0);
  std::vector<IntervalLight> others = suns(16, 0);
  others.erase(others.begin(), others.begin() + 4);
  const SunViews views(scene, mesh, ray_offset_m(scene.mesh), directions(expected));
  EXPECT_EQ(views.sights(others),
            std::vector<SunSight>(mesh.patch_count() * block_width, SunSight::unknown));
}

TEST(Sights, TellWhatRaysTellOfARealQuarter) {
  SUNLOAD_NEEDS_MODEL("data/city/rotterdam_subset_v20.city.json");
  Scene scene;
  scene.mesh =
      prepare(read_scene_file(shared_path("data/city/rotterdam_subset_v20.city.json"), {}), {})
          .mesh;
  scene.materials = {{"grey", 0.3, 0, 0}};
  scene.material.assign(scene.mesh.triangle_count(), MaterialId{0});
  expect_the_same(scene, 1.5, 8);
}

}  // namespace
}  // namespace sunload::test
