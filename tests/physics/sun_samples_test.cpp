// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Several suns that stand for one interval: its light is the mean of what each of them brings,
/// straight, by mirrors and by gloss, on patches and sensors, by both transports.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/glints.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

const std::vector<Vec3> three_directions{normalized({0.6, -0.5, 0.6}), normalized({0.3, -0.6, 0.7}),
                                         normalized({-0.1, -0.65, 0.75})};

/// A second of the sun that the three of them stand for.
IntervalLight of_three() {
  IntervalLight light = one_second(three_directions[1], dni);
  for (const Vec3 w : three_directions) light.sun_samples.push_back({w, 1.0 / 3, 1.0 / 3});
  return light;
}

/// Suns of unlike strength and length from the first of them to the last, as intervals.
std::vector<IntervalLight> twelve_in_turn() {
  constexpr std::size_t count = 12;
  std::vector<IntervalLight> parts;
  double length_s = 0;
  for (std::size_t s = 0; s < count; ++s) {
    const double t = (static_cast<double>(s) + 0.5) / count;
    const Vec3 w = normalized(three_directions[0] * (1 - t) + three_directions[2] * t);
    IntervalLight& part = parts.emplace_back(one_second(w, dni * (s % 3 == 0 ? 0.2 : 1)));
    part.number = static_cast<std::uint32_t>(s + 1);
    part.length_s = part.sunlit_s = s % 2 == 0 ? 1 : 2;
    length_s += part.length_s;
  }
  for (IntervalLight& part : parts) part.length_s = part.sunlit_s = part.length_s / length_s;
  return parts;
}

/// The same as one; mirrors and gloss see those of `few`.
IntervalLight joined(const std::vector<IntervalLight>& parts, std::size_t few) {
  IntervalLight whole = one_second(parts[parts.size() / 2].direction, 0);
  for (const IntervalLight& part : parts) whole.dni += part.dni * part.length_s;
  const auto samples = [&](std::size_t each) {
    std::vector<SunSample> all;
    for (std::size_t first = 0; first < parts.size(); first += each) {
      SunSample sample{parts[first + each / 2].direction, 0, 0};
      for (std::size_t s = first; s < first + each; ++s) {
        sample.dni_share += parts[s].dni * parts[s].length_s / whole.dni;
        sample.time_share += parts[s].length_s;
      }
      all.push_back(sample);
    }
    return all;
  };
  whole.direct_suns = samples(1);
  whole.sun_samples = samples(parts.size() / few);
  return whole;
}

/// The same as three intervals, each with its sun.
std::vector<IntervalLight> one_after_the_other() {
  std::vector<IntervalLight> thirds;
  for (const Vec3 w : three_directions) {
    IntervalLight& light = thirds.emplace_back(one_second(w, dni));
    light.number = static_cast<std::uint32_t>(thirds.size());
    light.length_s = light.sunlit_s = 1.0 / 3;
  }
  return thirds;
}

struct Yard {
  SceneBuilder builder;
  Scene scene;

  /// A house throws its shadow on the ground, a wall behind it sends the sun back.
  explicit Yard(const Material& wall) {
    const int grey = builder.material({"grey", 0.3, 0, 0});
    const int behind = builder.material(wall);
    builder.object("ground").quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, grey);
    builder.object("house").box({-2, -2, 0}, {2, 2, 5}, grey, SceneBuilder::Facing::outward);
    builder.object("wall").quad({-10, 10, 0}, {10, 10, 0}, {10, 10, 6}, {-10, 10, 6}, behind);
    scene = builder.scene();
    scene.sensors = {sensor_at({0, 5, 1}, {0, -1, 1}), sensor_at({-4, 4, 0.5}, {0, 0, 1})};
  }
};

SolverRules sampled_rules(Transport transport) {
  SolverRules rules = test_rules();
  rules.transport = transport;
  rules.realizations = 32;
  rules.lines_per_patch = 32 * 16;
  rules.direct_samples = 32 * 4;
  rules.bounces = 2;
  return rules;
}

/// By realizations, which are independent: those of one solution less those of the other.
void expect_equal(const std::string& what, std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t r = 0; r < a.size(); ++r) a[r] -= b[r];
  const double scale = float_rounding * mean_error(b).mean;
  const Verdict same = expect_mean(a, 0, scale);
  EXPECT_TRUE(same) << what << ": " << same.text;
}

TEST(SunSamples, AnIntervalHasTheLightOfItsSunsOneAfterTheOther) {
  for (const Transport transport : {Transport::gather, Transport::shoot})
    for (const bool glossy : {false, true}) {
      SCOPED_TRACE(std::string(transport == Transport::gather ? "gather" : "shoot") +
                   (glossy ? ", gloss" : ", mirror"));
      Material wall{"wall", 0.1, glossy ? 0.0 : 0.8, 0};
      if (glossy) {
        wall.glossy = 0.8;
        wall.glossy_exponent = 30;
      }
      const Yard yard(wall);
      const SolverRules rules = sampled_rules(transport);
      const SplitRules split{.max_edge_m = 4};
      const Solved whole = solve(yard.scene, {of_three()}, rules, split);
      const Solved thirds = solve(yard.scene, one_after_the_other(), rules, split);
      const auto of_object = [&](std::size_t object) {
        return [&yard, &whole, object](std::size_t i) {
          return yard.scene.mesh
                     .triangle_object[static_cast<std::size_t>(whole.patches[i].triangle)]
                     .index() == object;
        };
      };
      for (const std::size_t object : {1u, 2u, 3u})
        expect_equal(yard.scene.mesh.object_names[object], whole.means(of_object(object)),
                     thirds.means(of_object(object)));
      for (const std::size_t sensor : {0u, 1u})
        expect_equal("sensor", of_sensor(whole.tally, sensor), of_sensor(thirds.tally, sensor));
      check_ledger("three suns", whole);
      // The sun of the middle alone is another light.
      const Solved middle = solve(yard.scene, {one_second(three_directions[1], dni)}, rules, split);
      auto off = middle.means(of_object(1));
      const auto ground = thirds.means(of_object(1));
      for (std::size_t r = 0; r < off.size(); ++r) off[r] -= ground[r];
      EXPECT_FALSE(expect_mean(off, 0, float_rounding * dni));
    }
}

TEST(SunSamples, ManyForWhatIsStraightAndFewForMirrorsAreTheLightOfAll) {
  const Yard yard({"wall", 0.1, 0.8, 0});
  const SolverRules rules = sampled_rules(Transport::gather);
  const SplitRules split{.max_edge_m = 2};
  const auto parts = twelve_in_turn();
  const Solved each = solve(yard.scene, parts, rules, split);
  for (const std::size_t few : {2u, 4u}) {
    const Solved whole = solve(yard.scene, {joined(parts, few)}, rules, split);
    const auto direct = static_cast<std::size_t>(Part::direct);
    double by_each = 0, by_whole = 0, squares = 0, area = 0;
    for (std::size_t i = 0; i < whole.area.size(); ++i) {
      const double a = each.tally.exposure[direct][i], b = whole.tally.exposure[direct][i];
      by_each += whole.area[i] * a;
      by_whole += whole.area[i] * b;
      squares += whole.area[i] * (a - b) * (a - b);
      area += whole.area[i];
      EXPECT_NEAR(each.tally.sunlit_s[i], whole.tally.sunlit_s[i], 0.05) << i;
    }
    // Shares are interpolated between suns of a grid.
    EXPECT_NEAR(by_whole / by_each, 1, 2e-3);
    EXPECT_LT(std::sqrt(squares * area) / by_each, 0.02);
    // None is made or lost where fewer suns send light on.
    check_ledger("many suns and few", whole);
    const Verdict wall = expect_mean(
        whole.means([&](std::size_t i) {
          return yard.scene.mesh
                     .triangle_object[static_cast<std::size_t>(whole.patches[i].triangle)]
                     .index() == 1;
        }),
        mean_error(each.means([&](std::size_t i) {
          return yard.scene.mesh.triangle_object[static_cast<std::size_t>(each.patches[i].triangle)]
                     .index() == 1;
        })).mean,
        0.01 * dni);
    EXPECT_TRUE(wall) << wall.text;
  }
  // Light of suns that all stand where the middle one does is another.
  IntervalLight middle = joined(parts, 2);
  for (SunSample& sun : middle.direct_suns) sun.direction = middle.direction;
  const Solved wrong = solve(yard.scene, {middle}, rules, split);
  double off = 0;
  for (std::size_t i = 0; i < wrong.area.size(); ++i)
    off = std::max(off, std::abs(each.tally.sunlit_s[i] - wrong.tally.sunlit_s[i]));
  EXPECT_GT(off, 0.3);
}

TEST(SunSamples, OpenGroundHasTheirMeanCosineAndAllOfTheSunsTime) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, black);
  const Solved solved = solve(builder.scene(), {of_three()}, sampled_rules(Transport::gather));
  double cosine = 0;
  for (const Vec3 w : three_directions) cosine += w.z / 3;
  for (std::size_t i = 0; i < solved.area.size(); ++i) {
    const auto total = static_cast<double>(solved.tally.irradiance[0][i]);
    EXPECT_NEAR(total, dni * cosine, float_rounding * dni);
    EXPECT_NEAR(solved.tally.sunlit_s[i], 1, float_rounding);
  }
}

TEST(SunSamples, WhatASurfaceTurnsAwayFromIsNotItsSun) {
  // Two of the three stand east of a wall that looks west.
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.quad({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}, black);
  const Solved solved = solve(builder.scene(), {of_three()}, sampled_rules(Transport::gather));
  for (std::size_t i = 0; i < solved.area.size(); ++i) {
    const auto total = static_cast<double>(solved.tally.irradiance[0][i]);
    EXPECT_NEAR(total, dni * -three_directions[2].x / 3, float_rounding * dni);
    EXPECT_NEAR(solved.tally.sunlit_s[i], 1.0 / 3, float_rounding);
  }
}

TEST(SunSamples, IntervalsMayHaveUnlikeNumbersOfThem) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, black);
  IntervalLight one = one_second(three_directions[0], dni);
  one.number = 1;
  const Solved solved =
      solve(builder.scene(), {of_three(), one, night}, sampled_rules(Transport::gather));
  const std::size_t patches = solved.area.size();
  for (std::size_t i = 0; i < patches; ++i) {
    EXPECT_NEAR(static_cast<double>(solved.tally.irradiance[0][patches + i]),
                dni * three_directions[0].z, float_rounding * dni);
    EXPECT_EQ(solved.tally.irradiance[0][2 * patches + i], 0.0f);
    EXPECT_NEAR(solved.tally.sunlit_s[i], 2, 2 * float_rounding);
  }
}

}  // namespace
}  // namespace sunload::test
