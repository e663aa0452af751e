// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sun that patches see in mirrors: closed forms, and what a thousand rays tell of each.
#include "solver/sight/mirrored_shares.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <iostream>

#include "solver/base/threads.h"
#include "solver/first_light/direct_sun.h"
#include "solver/first_light/mirror_sun.h"
#include "tests/support/scenes.h"
#include "tests/support/sights.h"

namespace sunload::test {
namespace {

constexpr double rho = 0.6;  // of mirrors

/// A wall along y = 0 that looks to -y, with panes in reveals of that depth; a ground, another
/// house of mirrors, and what stands between.
Scene street_of_glass(double depth, double hedge_transmittance) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const int pane = b.material({"pane", 0.05, rho, 0});
  const int hedge =
      b.material({.name = "hedge", .diffuse = 0.1, .transmittance = hedge_transmittance});
  b.quad({-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}, grey);
  b.object("house");
  constexpr int panes = 4;
  for (int i = 0; i < panes; ++i) {
    const double x = 3.0 * i - 6, x0 = x + 0.8, x1 = x + 2.3, x2 = x + 3;
    b.quad({x, 0, 0}, {x0, 0, 0}, {x0, 0, 5}, {x, 0, 5}, grey);
    b.quad({x0, 0, 0}, {x1, 0, 0}, {x1, 0, 1}, {x0, 0, 1}, grey);
    b.quad({x0, 0, 3}, {x1, 0, 3}, {x1, 0, 5}, {x0, 0, 5}, grey);
    b.quad({x1, 0, 0}, {x2, 0, 0}, {x2, 0, 5}, {x1, 0, 5}, grey);
    b.quad({x0, depth, 1}, {x1, depth, 1}, {x1, depth, 3}, {x0, depth, 3}, pane);
    if (depth <= 0) continue;
    b.quad({x0, 0, 1}, {x1, 0, 1}, {x1, depth, 1}, {x0, depth, 1}, grey);  // sill
    b.quad({x0, depth, 3}, {x1, depth, 3}, {x1, 0, 3}, {x0, 0, 3}, grey);
    b.quad({x0, 0, 3}, {x0, 0, 1}, {x0, depth, 1}, {x0, depth, 3}, grey);
    b.quad({x1, 0, 1}, {x1, 0, 3}, {x1, depth, 3}, {x1, depth, 1}, grey);
  }
  b.quad({-6, 0, 5}, {6, 0, 5}, {6, 6, 5}, {-6, 6, 5}, grey);
  b.object("tower").box({-9, -12, 0}, {-4, -9, 8}, pane, SceneBuilder::Facing::outward);
  b.object("shed").box({1, -7, 0}, {4, -5, 2.5}, grey, SceneBuilder::Facing::outward);
  b.object("hedge").box({-4, -5, -1}, {0, -4.5, 1.5}, hedge, SceneBuilder::Facing::outward);
  b.object("sail").sides(Sides::two).quad({5, -4, 3}, {8, -4, 3}, {8, -2, 4}, {5, -2, 4}, pane);
  return turned(b.scene());
}

std::vector<SunBeams> beams_once_reflected(const MirrorGroups& groups,
                                           const std::vector<IntervalLight>& block) {
  std::vector<SunBeams> beams;
  for (const IntervalLight& sun : block)
    beams.emplace_back(groups, sun, BeamRules{.mirror_depth = 1, .most_beams = 128});
  return beams;
}

Columns mirrored_of(const Scene& scene, const Hierarchy& mesh,
                    const std::vector<IntervalLight>& block) {
  const LitShares shares(scene, mesh, ray_offset_m(scene.mesh));
  const MirrorGroups groups(scene);
  const auto beams = beams_once_reflected(groups, block);
  return MirroredShares(shares, groups).of(block, once_reflected(beams));
}

/// The same by rays: from points of patches to the mirrors, and from there to the sun.
Columns mirrored_by_rays(const Scene& scene, const Hierarchy& mesh,
                         const std::vector<IntervalLight>& block, int rays) {
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  const SunSampler sampler(mesh, caster, {.samples = rays, .realizations = 1});
  const MirrorGroups groups(scene);
  const auto beams = beams_once_reflected(groups, block);
  Columns light = columns(mesh.patch_count());
  SunSampler::Seeds seeds;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    for (std::size_t k = 0; k < block.size(); ++k)
      for (std::size_t b = 0; b < beams[k].size(); ++b) {
        const SunBeam& beam = beams[k][b];
        const double cos_theta = dot(mesh.normal(i), beam.image);
        if (cos_theta <= 0) continue;
        sampler.seed(i, block[k].number, seeds);
        double seen = 0;
        for (std::size_t p = 0; p < sampler.packets(); ++p) {
          Packet points = sampler.origins(sampler.geometry(i), seeds, p);
          const auto hits = caster.first_hits(points, beam.image, sampler.active(p));
          std::uint32_t on_mirror = 0;
          for (auto bits = sampler.active(p); bits != 0; bits &= bits - 1) {
            const auto l = static_cast<std::size_t>(std::countr_zero(bits));
            const Hit hit = hits[l];
            if (hit.left_scene() ||
                groups.of_side(hit.triangle, hit.front) != static_cast<std::int32_t>(beam.group))
              continue;
            on_mirror |= 1u << l;
            put(points, l,
                lifted_point(scene.mesh, hit, groups[beam.group].normal, caster.offset_m()));
          }
          seen += std::popcount(caster.unoccluded(points, block[k].direction, on_mirror));
        }
        light[i * block_width + k] += static_cast<float>(rho * cos_theta * seen / rays);
      }
  return light;
}

/// As shares: of what a mirror brings that a patch sees in whole at right angles.
struct Difference {
  std::size_t lit = 0, by_rays = 0;  ///< pairs of patch and sun
  double worst = 0;
  double sum = 0, sum_by_rays = 0, squares = 0;
};

Difference difference(const Scene& scene, const Columns& known, const Hierarchy& mesh,
                      const std::vector<IntervalLight>& block, int rays) {
  // What slivers of a centimetre see is as large as what single precision does to rays' origins.
  constexpr double too_small_m2 = 1e-4;
  const Columns by_rays = mirrored_by_rays(scene, mesh, block, rays);
  Difference all;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (mesh.area()[i] < too_small_m2) continue;
      const auto told = static_cast<double>(known[i * block_width + k]) / rho;
      const auto seen = static_cast<double>(by_rays[i * block_width + k]) / rho;
      if (seen > 0) ++all.lit;
      if (told < 0) {
        ++all.by_rays;
        continue;
      }
      all.worst = std::max(all.worst, std::abs(told - seen));
      all.squares += (told - seen) * (told - seen);
      all.sum += told;
      all.sum_by_rays += seen;
    }
  std::cout << all.lit << " pairs lit, " << all.by_rays << " left to rays, differences at most "
            << all.worst << ", of sums " << all.sum / all.sum_by_rays - 1 << "\n";
  return all;
}

constexpr int rays_of_patch = 256;

/// A scrambled net of n points in the square errs where a line cuts it by no more than a few
/// n^-3/4 (He & Wang 2015), and no pair by more than where all of a row of n^1/2 points is on the
/// wrong side of several edges.
void expect_what_rays_tell(const Scene& scene, double max_edge_m, double most_left) {
  const auto block = suns_all_about(16);
  const Hierarchy mesh(scene, {.max_edge_m = max_edge_m});
  const Difference found =
      difference(scene, mirrored_of(scene, mesh, block), mesh, block, rays_of_patch);
  EXPECT_GT(found.lit, 500u);
  EXPECT_LE(static_cast<double>(found.by_rays), most_left * static_cast<double>(found.lit));
  EXPECT_LT(found.worst, 3 * std::pow(rays_of_patch, -0.5));
  EXPECT_LT(std::sqrt(found.squares / static_cast<double>(found.lit)),
            2 * std::pow(rays_of_patch, -0.75));
  // Of all pairs together errors average out: 5 standard errors.
  EXPECT_LT(std::abs(found.sum - found.sum_by_rays), 5 * std::sqrt(found.squares));
}

/// A pane of 2 m x 1 m, upright, sends its own area on to the ground, stretched by the sun's
/// height.
TEST(MirroredShares, OfAPaneOnTheGroundAreExact) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const int mirror = b.material({"mirror", 0, rho, 0});
  b.quad({-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}, grey);
  b.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, 2}, {-1, 0, 2}, mirror);
  const Scene scene = b.scene();
  const Hierarchy mesh(scene, {.max_edge_m = 0.7});
  const auto block = block_of({sun_at(-0.5 * pi, 0.5), sun_at(-1.1, 0.9), sun_at(-2.2, 0.3)});
  const Columns light = mirrored_of(scene, mesh, block);
  for (std::size_t k = 0; k < block.size(); ++k) {
    double power = 0;
    for (std::size_t i = 0; i < mesh.patch_count(); ++i)
      power += mesh.area()[i] * static_cast<double>(light[i * block_width + k]);
    const double onto_pane = 2 * -block[k].direction.y;
    EXPECT_NEAR(power, rho * onto_pane, 1e-6) << k;
  }
}

TEST(MirroredShares, AreWhatRaysTellOfAWallWithPanes) {
  expect_what_rays_tell(street_of_glass(0, 0), 1.6, 0);
}

TEST(MirroredShares, AreWhatRaysTellOfPanesInReveals) {
  expect_what_rays_tell(street_of_glass(0.25, 0), 1.2, 0);
}

/// Facets that cut each other, mirrors among them, those of both sides, and none of them closed.
TEST(MirroredShares, AreWhatRaysTellOfFacets) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const int mirror = b.material({"mirror", 0, rho, 0});
  b.sides(Sides::two);
  std::uint64_t drawn = 0;
  const auto next = [&] {
    const auto words =
        random_words({.seed = 7, .purpose = Purpose::direct_sun, .element = drawn++});
    return static_cast<double>(uniform(words[0]));
  };
  const auto point = [&](double size) {
    return Vec3{(next() - 0.5) * size, (next() - 0.5) * size, next() * size};
  };
  for (int i = 0; i < 60; ++i) {
    const Vec3 at = point(16);
    b.triangle(at, at + point(6), at + point(6), i % 10 == 0 ? mirror : grey);
  }
  expect_what_rays_tell(b.scene(), 1.2, 0);
}

TEST(MirroredShares, LeaveToRaysWhatLightPassesByChance) {
  const Scene scene = street_of_glass(0.25, 0.4);
  const Hierarchy mesh(scene, {.max_edge_m = 1.6});
  const auto block = suns_all_about(16);
  const Difference found =
      difference(scene, mirrored_of(scene, mesh, block), mesh, block, rays_of_patch);
  EXPECT_GT(found.by_rays, found.lit / 100);
  EXPECT_LT(found.by_rays, found.lit / 2);
  EXPECT_LT(found.worst, 3 * std::pow(rays_of_patch, -0.5));
}

/// Two mirrors in one place send on what one does.
TEST(MirroredShares, OfAMirrorThatIsThereTwiceAreThoseOfOne) {
  Scene scene = street_of_glass(0.25, 0);
  const Hierarchy mesh(scene, {.max_edge_m = 1.6});
  const auto block = suns_all_about(16);
  const Columns once = mirrored_of(scene, mesh, block);
  Mesh& twice = scene.mesh;
  for (std::size_t t = 0, count = twice.triangle_count(); t < count; ++t) {
    twice.triangles.push_back(twice.triangles[t]);
    twice.triangle_sides.push_back(twice.triangle_sides[t]);
    scene.material.push_back(scene.material[t]);
  }
  const Columns of_both = mirrored_of(scene, mesh, block);
  ASSERT_EQ(of_both.size(), once.size());
  std::size_t by_rays = 0;
  for (std::size_t at = 0; at < once.size(); ++at) {
    if (of_both[at] < 0)
      ++by_rays;
    else
      ASSERT_NEAR(of_both[at], once[at], 1e-5) << at;
  }
  // Edges in one place cut slivers off of slivers: rays may be asked.
  EXPECT_LT(by_rays, mesh.patch_count() / 10);
}

TEST(MirroredShares, DependNeitherOnThreadsNorOnOtherSuns) {
  const Scene scene = street_of_glass(0.25, 0.4);
  const Hierarchy mesh(scene, {.max_edge_m = 1.6});
  const auto block = suns_all_about(16);
  const int before = thread_count();
  set_thread_count(1);
  const Columns together = mirrored_of(scene, mesh, block);
  set_thread_count(3);
  EXPECT_EQ(mirrored_of(scene, mesh, block), together);
  set_thread_count(before);
  for (const std::size_t k : {0u, 7u, 15u}) {
    const Columns alone = mirrored_of(scene, mesh, {block[k]});
    for (std::size_t i = 0; i < mesh.patch_count(); ++i)
      ASSERT_EQ(alone[i * block_width], together[i * block_width + k]) << i << " of sun " << k;
  }
}

/// A planted fault: what has lost a house does not tell what rays tell.
TEST(MirroredShares, ComparisonSeesAMissingHouse) {
  const Scene scene = street_of_glass(0, 0);
  Scene without = scene;
  for (std::size_t t = 0; t < without.mesh.triangle_count(); ++t)
    if (without.mesh.object_names[without.mesh.triangle_object[t].index()] == "shed")
      without.mesh.triangles[t] = {0, 0, 0};
  const Hierarchy mesh(scene, {.max_edge_m = 1.6});
  const auto block = suns_all_about(16);
  const Difference found =
      difference(scene, mirrored_of(without, mesh, block), mesh, block, rays_of_patch);
  EXPECT_GT(found.worst, 0.3);
}

}  // namespace
}  // namespace sunload::test
