// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces that let a share of the light pass: crowns, screens.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "geo/edit/solids.h"
#include "solver/base/threads.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

Material crown(double T, double diffuse = 0, double mirror = 0) {
  Material m{"crown", diffuse, mirror};
  m.transmittance = T;
  return m;
}

/// A black receiver of 1 m² under k screens that are large beside their distance.
Scene under_layers(int layers, double T, Sides sides) {
  SceneBuilder builder;
  const int black = builder.material({"black"}), screen = builder.material(crown(T));
  builder.object("receiver").quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, black);
  builder.sides(sides);
  constexpr double half = 200;
  for (int k = 1; k <= layers; ++k) {
    const double z = 0.1 * k;
    builder.object("screen_" + std::to_string(k))
        .quad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}, screen);
  }
  return builder.scene();
}

Solved under(int layers, double T, Sides sides, const IntervalLight& light) {
  auto rules = test_rules();
  rules.direct_samples = rules.lines_per_patch = 16 * 4096;
  return solve(under_layers(layers, T, sides), {light}, rules, {.max_edge_m = 1e9});
}

bool of_receiver(const Solved& solved, std::size_t i) { return solved.patches[i].triangle < 2; }

TEST(Screens, SunThroughLayersIsAPower) {
  for (const Sides sides : {Sides::one, Sides::two})
    for (const int layers : {1, 2, 4}) {
      const Vec3 sun = normalized({0.2, 0.3, 0.9});
      const double T = 0.7, E = 900 * sun.z * std::pow(T, layers);
      const auto solved = under(layers, T, sides, one_second(sun, 900));
      const auto means = solved.means([&](std::size_t i) { return of_receiver(solved, i); });
      const Verdict verdict = expect_mean(means, E);
      EXPECT_TRUE(verdict) << layers << ": " << verdict.text;
      EXPECT_FALSE(expect_mean(means, 1.05 * E)) << layers;
    }
}

/// What every realization has of the sun, at the least samples that there can be.
std::vector<double> of_receiver_alone(int layers, double T, const IntervalLight& sun) {
  auto rules = test_rules();
  rules.direct_samples = rules.realizations;
  rules.lines_per_patch = rules.realizations;
  const auto solved = solve(under_layers(layers, T, Sides::two), {sun}, rules, {.max_edge_m = 1e9});
  return solved.means([&](std::size_t i) { return of_receiver(solved, i); });
}

// What passes is no chance: behind screens that cover all of a patch there is no error, by how few
// rays it may be known, and of a sun that is a disk as of one that is a point.
TEST(Screens, SunBehindScreensHasNoError) {
  constexpr double T = 0.173;
  for (const double disk : {0.0, 0.2666})
    for (const int layers : {1, 2, 3}) {
      IntervalLight sun = one_second(normalized({0.2, 0.3, 0.9}), 900);
      sun.disk_half_angle = radians(disk);
      const double open = 900 * sun.direction.z, E = open * std::pow(T, layers);
      for (const double of_realization : of_receiver_alone(layers, T, sun)) {
        EXPECT_NEAR(of_realization, E, float_rounding * E) << layers;
        // One surface too many, or too few, would be seen.
        EXPECT_GT(std::abs(of_realization - E / T), float_rounding * E);
      }
    }
}

// Of what five surfaces of leaves let pass chance decides: it is right on the mean.
TEST(Screens, FaintLightIsAPowerOnTheMean) {
  constexpr double T = 0.173;
  const Vec3 sun = normalized({0.2, 0.3, 0.9});
  for (const int layers : {6, 7}) {
    const double E = 900 * sun.z * std::pow(T, layers);
    const auto solved = under(layers, T, Sides::two, one_second(sun, 900));
    const auto means = solved.means([&](std::size_t i) { return of_receiver(solved, i); });
    const Verdict verdict = expect_mean(means, E);
    EXPECT_TRUE(verdict) << layers << ": " << verdict.text;
    EXPECT_FALSE(expect_mean(means, E / T)) << layers;
    EXPECT_FALSE(expect_mean(means, E * T)) << layers;
  }
}

/// Ground of small patches below a plane of transmittance T whose edges cross most of them askew.
Scene shaded_by_an_edge(double T) {
  SceneBuilder builder;
  builder.object("ground").quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0},
                                builder.material({"black"}));
  builder.sides(Sides::two)
      .object("screen")
      .quad({-0.3, -2.2, 1}, {1.1, -1.9, 1}, {0.6, 2.3, 1}, {-1.3, 1.8, 1},
            builder.material(crown(T)));
  return builder.scene();
}

// Behind the edge of a screen the share of the patch is by samples, and errors are what they say.
// The truth is geometry's, of an opaque plane.
TEST(Screens, ErrorsBehindEdgesAreHonest) {
  constexpr double T = 0.3;
  constexpr int seeds = 8;
  const IntervalLight sun = one_second(normalized({0.1, -0.2, 0.9}), 1000);
  const double open = 1000 * sun.direction.z;
  auto rules = test_rules();
  rules.direct_samples = rules.realizations * 4;
  rules.lines_per_patch = rules.realizations;
  const SplitRules split{.max_edge_m = 0.5};
  const Solved opaque = solve(shaded_by_an_edge(0), {sun}, rules, split);
  const auto is_ground = [&](std::size_t i) { return opaque.patches[i].triangle < 2; };
  const boost::math::students_t student(rules.realizations - 1);
  const double t_of_95_percent = quantile(complement(student, 0.05 / 2));
  double patches = 0, within = 0, within_half = 0;
  std::vector<double> means(static_cast<std::size_t>(rules.realizations), 0);
  for (int seed = 1; seed <= seeds; ++seed) {
    rules.seed = static_cast<std::uint64_t>(seed);
    const Solved solved = solve(shaded_by_an_edge(T), {sun}, rules, split);
    ASSERT_EQ(solved.patches.size(), opaque.patches.size());
    for (std::size_t i = 0; i < solved.patches.size(); ++i) {
      if (!is_ground(i)) continue;
      const double lit = mean_error(opaque.of_patch(i)).mean / open;
      const double truth = open * (lit + (1 - lit) * T);
      const auto found = mean_error(solved.of_patch(i));
      if (lit <= 0 || lit >= 1 - float_rounding) {
        EXPECT_NEAR(found.mean, truth, float_rounding * open);
        EXPECT_NEAR(found.standard_error, 0, float_rounding * open);
        continue;
      }
      // Of corners that few points meet, errors are not normal.
      if (std::min(lit, 1 - lit) < 0.2) continue;
      const double t = std::abs(found.mean - truth) / found.standard_error;
      patches += 1;
      within += t <= t_of_95_percent ? 1 : 0;
      within_half += t <= t_of_95_percent / 2 ? 1 : 0;
    }
    const auto of_seed = solved.means(is_ground);
    for (std::size_t r = 0; r < means.size(); ++r) means[r] += of_seed[r] / seeds;
  }
  ASSERT_GE(patches, 100);
  const CountInterval accepted = accepted_counts(patches, 0.95);
  EXPECT_TRUE(accepted.contains(within)) << within << " of " << patches;
  // Planted fault: errors half as large as they are.
  EXPECT_FALSE(accepted.contains(within_half)) << within_half << " of " << patches;
  const double lit = mean_error(opaque.means(is_ground)).mean / open;
  const double truth = open * (lit + (1 - lit) * T);
  const Verdict verdict = expect_mean(means, truth);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(means, 1.02 * truth));
}

/// Paving about a tree of `scene.edit`.
Scene tree_on_paving() {
  PolygonModel tree;
  add_tree(tree, {0, 0, 0}, {8, 5, 2.5, "leaves", "bark"},
           {"tree", "SolitaryVegetationObject", {}});
  SceneBuilder builder;
  const int paving = builder.material({"paving", 0.2}), leaves = builder.material(crown(0.173));
  builder.object("paving").quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, paving);
  builder.sides(Sides::two).object("crown");
  for (std::size_t face = 0; face < tree.facts.size(); ++face) {
    if (tree.facts[face].sides != Sides::two) continue;  // the trunk
    const auto ring = static_cast<std::size_t>(tree.polygon_ring[face]);
    const auto corner = [&](std::int64_t c) {
      const auto vertex = tree.ring_vertex[static_cast<std::size_t>(c)];
      return tree.vertices[static_cast<std::size_t>(vertex)];
    };
    const auto first = tree.ring_begin[ring];
    for (auto c = first + 2; c < tree.ring_begin[ring + 1]; ++c)
      builder.triangle(corner(first), corner(c - 1), corner(c), leaves);
  }
  return builder.scene();
}

// Sixteen rays of a patch to the sun bring what 4096 do.
TEST(Screens, FewRaysThroughATreeAreRightOnTheMean) {
  const Scene scene = tree_on_paving();
  const IntervalLight sun = one_second(normalized({0.4, 0.2, 0.8}), 900);
  auto rules = test_rules();
  rules.lines_per_patch = rules.realizations;
  const auto paving = [&](int samples_each) {
    rules.direct_samples = rules.realizations * samples_each;
    rules.seed = static_cast<std::uint64_t>(samples_each);
    const Solved solved = solve(scene, {sun}, rules, {.max_edge_m = 1});
    return solved.means([&](std::size_t i) { return of_receiver(solved, i); });
  };
  const double truth = mean_error(paving(256)).mean;
  const auto few = paving(1);
  const Verdict verdict = expect_mean(few, truth);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(few, 1.01 * truth));
  EXPECT_LT(mean_error(few).standard_error, 1e-3 * truth);
}

TEST(Screens, SkyThroughLayersIsAPower) {
  for (const int layers : {1, 3}) {
    const double T = 0.6, E = 100 * std::pow(T, layers);
    const auto solved =
        under(layers, T, Sides::two, with_uniform_sky(one_second({0, 0, -1}, 0), 100));
    const auto means = solved.means([&](std::size_t i) { return of_receiver(solved, i); });
    // Past the edges of the screens, 200 m away and at most 0.3 m above: (0.3/200)² of the sky.
    const Verdict verdict = expect_mean(means, E, 100 * std::pow(0.1 * layers / 199, 2));
    EXPECT_TRUE(verdict) << layers << ": " << verdict.text;
    EXPECT_FALSE(expect_mean(means, 1.05 * E)) << layers;
  }
}

/// A court with two crowns, a mirror that lets pass, a one-sided awning and a lamp.
Scene shaded_court() {
  SceneBuilder builder;
  const int ground = builder.material({"ground", 0.25}), wall = builder.material({"wall", 0.45}),
            glass = builder.material({"glass", 0.1, 0.7}),
            lamp = builder.material({"lamp", 0.3, 0, 25}),
            leaves = builder.material(crown(0.4, 0.25)),
            veil = builder.material(crown(0.5, 0.1, 0.3)),
            awning = builder.material(crown(0.2, 0.5));
  builder.object("ground").quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, ground);
  builder.object("house").box({-6, 3, 0.01}, {6, 6, 5}, wall, Facing::outward);
  builder.object("glass").quad({-5, 2.99, 0.5}, {5, 2.99, 0.5}, {5, 2.99, 4.5}, {-5, 2.99, 4.5},
                               glass);
  builder.object("lamp").quad({3, -4, 3}, {3, -3, 3}, {4, -3, 3}, {4, -4, 3}, lamp);
  builder.object("awning").quad({-5, 1, 3}, {5, 1, 3}, {5, 2.9, 3.2}, {-5, 2.9, 3.2}, awning);
  builder.sides(Sides::two);
  builder.object("crown").box({-2, -3, 1}, {1, 0, 4}, leaves, Facing::outward);
  builder.object("veil").quad({3, -2, 0.5}, {6, -1, 0.5}, {6, -1, 4}, {3, -2, 4}, veil);
  return builder.scene();
}

struct Balance {
  std::vector<double> residual;  ///< per realization
  double in;
};

/// Of a solution whose ledger closes within its error, which is below 1 % of the light that comes
/// in.
Balance closed_ledger(const Solved& solved) {
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
  const Verdict verdict = expect_mean(residual, 0, float_rounding * in);
  std::cout << "in " << in << " W, residual " << verdict.text << "\n";
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_LE(verdict.standard_error, 0.01 * in);
  return {residual, in};
}

/// A crown that stands on a roof. Its underside is a floor, or is not there.
enum class Underside { floor, none };
Scene crown_on_a_roof(Underside underside) {
  SceneBuilder builder;
  const int roof = builder.material({"roof", 0.6}), leaves = builder.material(crown(0.173, 0.175));
  builder.object("roof").quad({-5, -5, 5}, {5, -5, 5}, {5, 5, 5}, {-5, 5, 5}, roof);
  builder.sides(Sides::two);
  constexpr double a = 2, low = 5, high = 8;
  builder.object("crown")
      .quad({-a, -a, high}, {a, -a, high}, {a, a, high}, {-a, a, high}, leaves)
      .quad({-a, -a, low}, {a, -a, low}, {a, -a, high}, {-a, -a, high}, leaves)
      .quad({a, -a, low}, {a, a, low}, {a, a, high}, {a, -a, high}, leaves)
      .quad({a, a, low}, {-a, a, low}, {-a, a, high}, {a, a, high}, leaves)
      .quad({-a, a, low}, {-a, -a, low}, {-a, -a, high}, {-a, a, high}, leaves);
  if (underside == Underside::none) return builder.scene();
  builder.object("under").quad({-a, a, low}, {a, a, low}, {a, -a, low}, {-a, -a, low}, leaves);
  Scene scene = builder.scene();
  for (std::size_t t = scene.mesh.triangle_count() - 2; t < scene.mesh.triangle_count(); ++t)
    scene.mesh.triangle_surface[t] = Surface::floor;
  return scene;
}

// Rays cannot tell the underside from the roof: what the roof sends on, of the sun and of the sky,
// is seen by the crown from within, however it comes to be known.
TEST(Screens, UndersideOfACrownOnARoofTakesNoLight) {
  const auto light = with_uniform_sky(one_second(normalized({0.3, 0.2, 0.9}), 800), 100);
  for (const Transport transport : {Transport::gather, Transport::shoot}) {
    auto rules = test_rules();
    rules.transport = transport;
    rules.lines_per_patch = 16 * 64;
    const SplitRules split{.max_edge_m = 1};
    const Solved touches = solve(crown_on_a_roof(Underside::floor), {light}, rules, split),
                 open = solve(crown_on_a_roof(Underside::none), {light}, rules, split);
    for (const bool of_roof : {true, false}) {
      const auto chosen = [&](const Solved& solved) {
        return solved.means(
            [&](std::size_t i) { return (solved.patches[i].triangle < 2) == of_roof; });
      };
      auto differences = chosen(touches);
      const auto truth = chosen(open);
      const double mean = mean_error(truth).mean;
      for (std::size_t r = 0; r < truth.size(); ++r) differences[r] -= truth[r];
      const Verdict verdict = expect_mean(differences, 0, float_rounding * mean);
      EXPECT_TRUE(verdict) << verdict.text;
      EXPECT_FALSE(expect_mean(differences, 0.01 * mean, float_rounding * mean));
    }
    closed_ledger(touches);
  }
}

// One that hovers is crossed as any other surface: an awning of a model of a city, whose lowest
// faces count as floors.
TEST(Screens, UndersideOverNothingIsCrossed) {
  Scene scene = crown_on_a_roof(Underside::floor);
  for (Material& m : scene.materials) m.diffuse = 0;
  for (Vec3& v : scene.mesh.vertices)
    if (std::abs(v.x) < 5) v.z += 1;
  const auto light = one_second({0, 0, 1}, 800);
  auto rules = test_rules();
  rules.direct_samples = 16 * 64;
  const Solved hovers = solve(scene, {light}, rules, {.max_edge_m = 1});
  const auto under = hovers.means([&](std::size_t i) {
    const auto& corners = hovers.corners[i];
    return hovers.patches[i].triangle < 2 &&
           std::all_of(corners.begin(), corners.end(),
                       [](Vec3 p) { return std::abs(p.x) <= 2 && std::abs(p.y) <= 2; });
  });
  const double twice = 800 * 0.173 * 0.173;
  EXPECT_TRUE(expect_mean(under, twice)) << mean_error(under).mean;
  EXPECT_FALSE(expect_mean(under, 800 * 0.173));
}

// Of a crown that stands on another one both are crossed: its top, its underside, and what that
// lies on.
TEST(Screens, CrownsOnCrownsAreCrossedOneByOne) {
  SceneBuilder builder;
  constexpr double half = 20, T = 0.5;
  const int black = builder.material({"black"}), leaves = builder.material(crown(T));
  builder.object("receiver").quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, black);
  builder.sides(Sides::two);
  for (const double z : {8.0, 5.0})
    builder.object("top_" + std::to_string(z))
        .quad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}, leaves);
  builder.object("under").quad({-half, half, 5}, {half, half, 5}, {half, -half, 5},
                               {-half, -half, 5}, leaves);
  Scene scene = builder.scene();
  for (std::size_t t = scene.mesh.triangle_count() - 2; t < scene.mesh.triangle_count(); ++t)
    scene.mesh.triangle_surface[t] = Surface::floor;
  auto rules = test_rules();
  rules.direct_samples = 16 * 1024;
  const Solved solved = solve(scene, {one_second({0, 0, 1}, 800)}, rules, {.max_edge_m = 1e9});
  const auto means = solved.means([&](std::size_t i) { return of_receiver(solved, i); });
  EXPECT_TRUE(expect_mean(means, 800 * std::pow(T, 3))) << mean_error(means).mean;
  EXPECT_FALSE(expect_mean(means, 800 * std::pow(T, 2)));
}

// Mirrors behind crowns send on the share of each ray that they receive: what is shot balances
// sample by sample.
TEST(Screens, LedgerOfAShadedCourtClosesToRoundingWhenShooting) {
  auto rules = test_rules();
  rules.transport = Transport::shoot;
  rules.bounces = 20;
  const auto solved = solve(shaded_court(), three_suns(), rules, {.max_edge_m = 1.5});
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const auto in = solved.ledger([](const Ledger& l) { return l.in(); });
  for (std::size_t r = 0; r < residual.size(); ++r) EXPECT_NEAR(residual[r], 0, 1e-6 * in[r]);
}

TEST(Screens, LedgerOfAShadedCourtCloses) {
  auto rules = test_rules();
  rules.bounces = 20;
  const Scene scene = shaded_court();
  const auto solved = solve(scene, three_suns(), rules, {.max_edge_m = 1.5});
  const auto [residual, in] = closed_ledger(solved);
  // Planted fault: light that passes the crown is counted as met there, too.
  std::vector<double> met_by_crowns(residual.size(), 0);
  for (std::size_t r = 0; r < residual.size(); ++r) {
    met_by_crowns[r] = residual[r];
    for (std::size_t i = 0; i < solved.area.size(); ++i) {
      const auto t = static_cast<std::size_t>(solved.patches[i].triangle);
      const double T = scene.materials[scene.material[t].index()].transmittance;
      met_by_crowns[r] += 0.1 * T * solved.area[i] * solved.tally.exposure_realization[r][i];
    }
  }
  EXPECT_FALSE(expect_mean(met_by_crowns, 0, float_rounding * in));
}

// Leaves that shine: part of the light passes, part goes on in a lobe, of which some is cut off by
// the leaf's own plane; what is left is absorbed.
TEST(Screens, LedgerOfGlossyLeavesCloses) {
  constexpr double T = 0.4;
  Material leaf = crown(T, 0.15);
  leaf.glossy = 0.3;
  leaf.glossy_exponent = 8;
  SceneBuilder builder;
  builder.object("ground").quad({-6, -6, 0}, {6, -6, 0}, {6, 6, 0}, {-6, 6, 0},
                                builder.material({"ground", 0.25}));
  builder.sides(Sides::two)
      .object("crown")
      .box({-2, -2, 1}, {2, 2, 4}, builder.material(leaf), Facing::outward);
  for (const Transport transport : {Transport::gather, Transport::shoot}) {
    auto rules = test_rules();
    rules.transport = transport;
    rules.bounces = 20;
    const auto solved = solve(builder.scene(), three_suns(), rules, {.max_edge_m = 2});
    const auto [residual, in] = closed_ledger(solved);
    // Planted fault: what passes is told to be absorbed, as 2 % of what the leaves receive.
    std::vector<double> passed = residual;
    for (std::size_t r = 0; r < passed.size(); ++r)
      for (std::size_t i = 0; i < solved.area.size(); ++i)
        if (solved.patches[i].triangle >= 2)
          passed[r] -= 0.02 * solved.area[i] * solved.tally.exposure_realization[r][i];
    EXPECT_FALSE(expect_mean(passed, 0, float_rounding * in));
  }
}

TEST(Screens, SameBitsForAnyNumberOfThreads) {
  auto rules = test_rules();
  rules.lines_per_patch = 16 * 8;
  const int before = thread_count();
  std::vector<LargeVector<float>> totals;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    totals.push_back(
        solve(shaded_court(), three_suns(), rules, {.max_edge_m = 1.5}).tally.irradiance[0]);
  }
  set_thread_count(before);
  EXPECT_EQ(totals[0], totals[1]);
}

TEST(Screens, SingleRaysAndPacketsDecideAlike) {
  const Scene scene = shaded_court();
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  const Vec3 direction = normalized({0.31, 0.7, 0.23});
  int hits_of_crowns = 0;
  for (int row = 0; row < 400; ++row) {
    Packet origins{};
    PacketDirections directions{};
    Vec3 origin[packet_size];
    for (std::size_t l = 0; l < packet_size; ++l) {
      // Coordinates that floats hold exactly.
      origin[l] = {-3 + static_cast<double>(l) / 4, -9 + row / 64.0, 0.5};
      origins.x[l] = static_cast<float>(origin[l].x);
      origins.y[l] = static_cast<float>(origin[l].y);
      origins.z[l] = static_cast<float>(origin[l].z);
      directions.x[l] = static_cast<float>(direction.x);
      directions.y[l] = static_cast<float>(direction.y);
      directions.z[l] = static_cast<float>(direction.z);
    }
    const auto packet = caster.first_hits(origins, directions, 0xffff);
    const auto seen = caster.unoccluded(origins, direction, 0xffff);
    for (std::size_t l = 0; l < packet_size; ++l) {
      const Hit alone = caster.first_hit(origin[l], direction);
      EXPECT_EQ(alone.triangle, packet.triangle[l]);
      EXPECT_EQ(alone.left_scene(), (seen >> l & 1u) != 0);
      if (!alone.left_scene())
        hits_of_crowns +=
            scene.materials[scene.material[static_cast<std::size_t>(alone.triangle)].index()]
                .transmittance > 0;
    }
  }
  EXPECT_GT(hits_of_crowns, 100);
}

}  // namespace
}  // namespace sunload::test
