// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The two transports check each other; the ledger of shooting closes to rounding.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "geo/base/units.h"
#include "solver/base/threads.h"
#include "tests/support/court.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

/// The ledger of shooting closes to this share of what comes in (docs/developer/design.md, Result
/// and ledger).
constexpr double closes = 1e-6;

constexpr int realizations = 16;

SolverRules shooting_rules(Transport transport, int bounces = 5,
                           Jacobi jacobi = Jacobi::incremental) {
  SolverRules rules = test_rules();
  rules.realizations = realizations;
  rules.lines_per_patch = realizations * 16;
  rules.direct_samples = realizations * 4;
  rules.bounces = bounces;
  rules.transport = transport;
  rules.jacobi = jacobi;
  rules.seed = transport == Transport::shoot ? 2 : 1;  // no line in common
  return rules;
}

struct Case {
  const char* name;
  std::vector<IntervalLight> light;
  SplitRules split;
  int bounces;
  Scene (*scene)(Change);
};

/// Two rows of houses along a street.
Scene street(Change change) {
  SceneBuilder builder;
  const int road = builder.material({"road", change(0.3), 0, 0});
  const int wall = builder.material({"wall", change(0.7), 0, 0});
  builder.object("road").quad({-12, -4, 0}, {12, -4, 0}, {12, 4, 0}, {-12, 4, 0}, road);
  builder.object("north").box({-12, 4, 0.01}, {12, 8, 9}, wall, Facing::outward);
  builder.object("south").box({-12, -8, 0.01}, {12, -4, 6}, wall, Facing::outward);
  return builder.scene();
}

/// A closed room whose walls all glow, of unlike sizes.
Scene room(Change change) {
  SceneBuilder builder;
  builder.object("small").box({0, 0, 0}, {3, 2, 1}, builder.material({"wall", change(0.8), 0, 1}),
                              Facing::inward);
  builder.object("cube").box({1, 0.5, 0.2}, {1.4, 0.9, 0.6},
                             builder.material({"cube", change(0.5), 0, 20}), Facing::outward);
  return builder.scene();
}

/// A room lit by a lamp under its ceiling, half of it behind a screen.
/// Two facing mirrors with a lamp between them, open above and at the sides.
Scene facing_mirrors(Change change) {
  SceneBuilder builder;
  const int ground = builder.material({"ground", change(0.6), 0, 0});
  const int lamp = builder.material({"lamp", change(0.5), 0, 40});
  const int left = builder.material({"left", 0, 0.9, 0});
  const int right = builder.material({"right", change(0.15), 0.8, 0});
  builder.object("ground").quad({0, 0, 0}, {3, 0, 0}, {3, 6, 0}, {0, 6, 0}, ground);
  builder.object("left").quad({0, 0, 0}, {0, 6, 0}, {0, 6, 4}, {0, 0, 4}, left);
  builder.object("right").quad({3, 0, 0}, {3, 0, 4}, {3, 6, 4}, {3, 6, 0}, right);
  builder.object("lamp").quad({1, 2, 2}, {1, 3, 2}, {2, 3, 2}, {2, 2, 2}, lamp);
  return builder.scene();
}

/// The court in the light of a parallel source, which falls on ground, glass and screen.
Scene court_under_a_beam(Change change) {
  Scene scene = court_changed(change);
  add_parallel_source(scene, {-4, -7, 9}, {0, 6, -4}, {11, 0, 0}, 400);
  scene.sensors = {sensor_at({-1, 1, 0}, {0, 0, 1}), sensor_at({0, 0, 1.5}, {0, 1, 0}),
                   sensor_at({-2.99, -3.5, 4}, {1, 0, 0}), sensor_at({6.5, -7.9, 1}, {0, 1, 0.2})};
  return scene;
}

/// Sky and far ground only: each transport cuts the sun's chains in its own place.
std::vector<IntervalLight> overcast() {
  auto light = with_uniform_sky(night, 100);
  light.ground_exitance = 50;
  return {light};
}

std::vector<Case> cases() {
  return {{"court", numbered_suns(), {.max_edge_m = 3}, 3, court_changed},
          {"court under a beam", numbered_suns(), {.max_edge_m = 3}, 3, court_under_a_beam},
          {"street", numbered_suns(), {.max_edge_m = 3}, 4, street},
          {"room", {night}, {.max_edge_m = 1}, 20, room},
          {"lamp room", {night}, {.max_edge_m = 1}, 8, lamp_room},
          {"facing mirrors", overcast(), {.max_edge_m = 1}, 6, facing_mirrors}};
}

/// Irradiance of an object, from both.
struct Compared {
  double difference = 0, limit = 0, value = 0;
  bool agree() const { return std::abs(difference) <= limit; }
};

Compared compared(const Solved& gathered, const Solved& shot, const Scene& scene,
                  const std::string& object) {
  const auto chosen = [&](std::size_t i) {
    const auto t = static_cast<std::size_t>(gathered.patches[i].triangle);
    return scene.mesh.object_names[scene.mesh.triangle_object[t].index()] == object;
  };
  const MeanError g = mean_error(gathered.means(chosen)), s = mean_error(shot.means(chosen));
  double area = 0, pooled = 0;
  for (std::size_t i = 0; i < gathered.area.size(); ++i)
    if (chosen(i)) {
      area += gathered.area[i];
      pooled += gathered.area[i] * gathered.tally.exposure[0][i];
    }
  // Bias of gathering by reuse of lines, of which realizations have R times the pooled part.
  const auto R = static_cast<double>(gathered.tally.exposure_realization.size());
  const double reuse = std::abs(g.mean - pooled / area) * R / (R - 1);
  return {s.mean - g.mean,
          accepted_t(gathered.tally.exposure_realization.size()) *
                  std::hypot(g.standard_error, s.standard_error) +
              reuse + float_rounding * g.mean,
          g.mean};
}

TEST(Shooting, AgreesWithGathering) {
  for (const Case& c : cases()) {
    const Scene scene = c.scene(as_it_is);
    const Solved gathered =
        solve(scene, c.light, shooting_rules(Transport::gather, c.bounces), c.split);
    for (const Jacobi jacobi : {Jacobi::incremental, Jacobi::regular}) {
      const Solved shot =
          solve(scene, c.light, shooting_rules(Transport::shoot, c.bounces, jacobi), c.split);
      const Solved faulty = solve(c.scene(squared), c.light,
                                  shooting_rules(Transport::shoot, c.bounces, jacobi), c.split);
      int noticed = 0;
      for (const auto& object : scene.mesh.object_names) {
        if (object == "object") continue;  // empty
        const Compared both = compared(gathered, shot, scene, object);
        std::cout << c.name << ", " << object << (jacobi == Jacobi::regular ? " (regular)" : "")
                  << ": " << both.value << " W/m2, off by " << both.difference << ", limit "
                  << both.limit << "\n";
        EXPECT_TRUE(both.agree()) << c.name << ", " << object;
        noticed += !compared(gathered, faulty, scene, object).agree();
      }
      EXPECT_GT(noticed, 0) << c.name << ": planted fault: reflectance applied twice";
    }
  }
}

/// Irradiance of a sensor, from both.
Compared compared(const BatchTally& gathered, const BatchTally& shot, std::size_t sensor) {
  const MeanError g = mean_error(of_sensor(gathered, sensor)),
                  s = mean_error(of_sensor(shot, sensor));
  // Bias of gathering by reuse of lines.
  const double reuse = 2 * std::abs(g.mean - gathered.sensors.exposure[0][sensor]);
  return {s.mean - g.mean,
          accepted_t(realizations) * std::hypot(g.standard_error, s.standard_error) + reuse +
              float_rounding * g.mean,
          g.mean};
}

TEST(Shooting, LightsSensorsAsGatheringDoes) {
  const Scene scene = court_under_a_beam(as_it_is);
  constexpr int bounces = 3;
  const auto tally_of = [&](const Scene& lit, const SolverRules& rules) {
    return solve(lit, numbered_suns(), rules, {.max_edge_m = 3}).tally;
  };
  const BatchTally gathered = tally_of(scene, shooting_rules(Transport::gather, bounces));
  for (const Jacobi jacobi : {Jacobi::incremental, Jacobi::regular}) {
    SolverRules rules = shooting_rules(Transport::shoot, bounces, jacobi);
    rules.errors = Errors::instants;
    const BatchTally shot = tally_of(scene, rules),
                     faulty = tally_of(court_under_a_beam(squared), rules);
    int noticed = 0;
    for (std::size_t s = 0; s < scene.sensors.size(); ++s) {
      const Compared both = compared(gathered, shot, s);
      std::cout << "sensor " << s << ": " << both.value << " W/m2, off by " << both.difference
                << ", limit " << both.limit << "\n";
      EXPECT_TRUE(both.agree()) << s;
      noticed += !compared(gathered, faulty, s).agree();
      double parts = 0, se = 0;
      for (std::size_t p = 1; p < part_count; ++p) parts += shot.sensors.exposure[p][s];
      EXPECT_NEAR(parts, shot.sensors.exposure[0][s], float_rounding * parts);
      EXPECT_NEAR(parts, mean_error(of_sensor(shot, s)).mean, float_rounding * parts);
      for (std::size_t k = 0; k < 3; ++k)
        se += static_cast<double>(shot.sensors.irradiance_se[k * scene.sensors.size() + s]);
      EXPECT_LE(mean_error(of_sensor(shot, s)).standard_error, se * (1 + float_rounding));
    }
    EXPECT_GT(noticed, 0) << "planted fault: reflectance applied twice";
  }
}

// A deposit on j must be divided by the area of j.
TEST(Shooting, AgreesPatchByPatch) {
  const Scene scene = room(as_it_is);
  const Solved gathered = solve(scene, {night}, shooting_rules(Transport::gather, 30));
  const Solved shot = solve(scene, {night}, shooting_rules(Transport::shoot, 30));
  double mean_area = 0;
  for (const double area : shot.area) mean_area += area / static_cast<double>(shot.area.size());
  int noticed = 0;
  for (std::size_t i = 0; i < shot.area.size(); ++i) {
    const MeanError g = mean_error(gathered.of_patch(i)), s = mean_error(shot.of_patch(i));
    const double limit = accepted_t(realizations) * std::hypot(g.standard_error, s.standard_error) +
                         2 * std::abs(g.mean - gathered.tally.exposure[0][i]) +
                         float_rounding * g.mean;
    EXPECT_LE(std::abs(s.mean - g.mean), limit) << i;
    noticed += std::abs(s.mean * shot.area[i] / mean_area - g.mean) > limit;
  }
  EXPECT_GT(noticed, static_cast<int>(shot.area.size()) / 2) << "planted fault: wrong area";
}

double largest_residual(const Solved& solved) {
  double largest = 0;
  for (const auto* ledgers : {&solved.tally.ledger, &solved.tally.ledger_realization})
    for (const Ledger& l : *ledgers) largest = std::max(largest, std::abs(l.residual()) / l.in());
  return largest;
}

TEST(Shooting, LedgerClosesForEverySunAndRealization) {
  for (const Case& c : cases())
    for (const Jacobi jacobi : {Jacobi::incremental, Jacobi::regular}) {
      const Solved solved =
          solve(c.scene(as_it_is), c.light, shooting_rules(Transport::shoot, 3, jacobi), c.split);
      const double residual = largest_residual(solved);
      std::cout << c.name << ": residual " << residual << " of in\n";
      EXPECT_LE(residual, closes) << c.name;
      for (const Ledger& l : solved.tally.ledger) {
        EXPECT_GT(l[Term::unshot], 0);
        // Planted fault: what was not followed is forgotten.
        EXPECT_GT(std::abs(l.residual() + l[Term::unshot]) / l.in(), closes);
      }
    }
}

/// Mean square of the patches' standard errors, by area.
double variance_of_patches(const Solved& solved) {
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < solved.area.size(); ++i) {
    const double se = mean_error(solved.of_patch(i)).standard_error;
    sum += solved.area[i] * se * se;
    area += solved.area[i];
  }
  return sum / area;
}

// What is far away receives as a whole: less noise, the same light.
TEST(Shooting, SendsLightToElementsThatAreSmallAsSeenFromAPatch) {
  const Scene scene = street(as_it_is);
  constexpr int bounces = 2;
  const auto shot = [&](const Scene& lit, double link_threshold) {
    SolverRules rules = shooting_rules(Transport::shoot, bounces);
    rules.link_threshold = link_threshold;
    rules.seed = link_threshold > 0 ? 2 : 3;  // no sample in common
    // The sky would bring noise of its own.
    return solve(lit, {one_second({0, -0.6, 0.8}, 700)}, rules, {.max_edge_m = 1.5});
  };
  const Solved to_patches = shot(scene, 0), to_elements = shot(scene, 16),
               faulty = shot(street(squared), 16);
  int noticed = 0;
  for (const char* object : {"road", "north", "south"}) {
    const Compared both = compared(to_patches, to_elements, scene, object);
    std::cout << object << ": " << both.value << " W/m2, off by " << both.difference << ", limit "
              << both.limit << "\n";
    EXPECT_TRUE(both.agree()) << object;
    noticed += !compared(to_patches, faulty, scene, object).agree();
  }
  EXPECT_GT(noticed, 0) << "planted fault: reflectance applied twice";
  EXPECT_LE(largest_residual(to_elements), closes);
  const double gain = variance_of_patches(to_patches) / variance_of_patches(to_elements);
  std::cout << "variance to patches is " << gain << " times that to elements\n";
  EXPECT_GT(gain, 1.2);  // elements of a few patches each
}

// Sun, sky, ground and lamp by chains of mirrors of any depth, also of the sun.
TEST(Shooting, LedgerClosesAtEveryMirrorDepth) {
  auto light = with_uniform_sky(one_second({0.6, 0.1, 0.7}, 600), 100);
  light.ground_exitance = 50;
  auto disk = light;
  disk.disk_half_angle = 0.0047;
  disk.number = 1;
  double unshot_before = 1e300;
  for (const int depth : {0, 1, 2, 5, 40}) {
    SolverRules rules = shooting_rules(Transport::shoot, 30);
    rules.mirror_depth = depth;
    const Solved solved = solve(facing_mirrors(as_it_is), {light, disk}, rules, {.max_edge_m = 1});
    const double residual = largest_residual(solved), unshot = solved.tally.energy[Term::unshot];
    std::cout << "depth " << depth << ": in " << solved.tally.energy.in() << " J, unshot " << unshot
              << " J, residual " << residual << " of in\n";
    EXPECT_LE(residual, closes) << depth;
    EXPECT_LT(unshot, unshot_before);
    unshot_before = unshot;
  }
}

TEST(Shooting, SeriesAreTheMeanOfRealizations) {
  auto rules = shooting_rules(Transport::shoot);
  rules.errors = Errors::instants;
  const Solved solved = solve(court(), numbered_suns(), rules, {.max_edge_m = 3});
  const std::size_t patches = solved.area.size();
  for (std::size_t i = 0; i < patches; ++i) {
    std::vector<double> of;
    for (const auto& exposure : solved.tally.exposure_realization) of.push_back(exposure[i]);
    const MeanError mean = mean_error(of);
    EXPECT_NEAR(solved.tally.exposure[0][i], mean.mean, float_rounding * mean.mean);
    double parts = 0;
    for (std::size_t p = 1; p < part_count; ++p) parts += solved.tally.exposure[p][i];
    EXPECT_NEAR(parts, mean.mean, float_rounding * mean.mean);
    // Suns share samples and lamps: the error of a sum is between those of dependent and of
    // opposite terms.
    double se = 0;
    for (std::size_t k = 0; k < 3; ++k)
      se += static_cast<double>(solved.tally.irradiance_se[k * patches + i]);
    EXPECT_LE(mean.standard_error, se * (1 + float_rounding));
  }
}

TEST(Shooting, SameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  std::vector<BatchTally> tallies;
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    auto rules = shooting_rules(Transport::shoot);
    rules.errors = Errors::instants;
    tallies.push_back(solve(court(), numbered_suns(), rules, {.max_edge_m = 1}).tally);
  }
  set_thread_count(before);
  for (const auto& tally : {tallies[1], tallies[2]}) {
    for (std::size_t p = 0; p < part_count; ++p)
      EXPECT_EQ(tally.irradiance[p], tallies[0].irradiance[p]) << part_names[p];
    EXPECT_EQ(tally.exposure_realization, tallies[0].exposure_realization);
    EXPECT_EQ(tally.irradiance_se, tallies[0].irradiance_se);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(tally.ledger[k].terms, tallies[0].ledger[k].terms);
  }
}

TEST(Shooting, NumberOfSamplesIsPowerByPowerPerSample) {
  const Scene scene = lamp_room(as_it_is);
  SolverRules rules = shooting_rules(Transport::shoot, 0);
  constexpr double lamp_w = 50, per_sample = 0.003;
  rules.power_per_sample_w = per_sample;
  // The two patches of the lamp shoot, in every realization.
  const Solved lamp_only = solve(scene, {night}, rules);
  EXPECT_NEAR(static_cast<double>(lamp_only.work[Work::samples]), lamp_w / per_sample,
              realizations);
  // A reflection more: what its patches have received, times their reflectance.
  rules.bounces = 1;
  const Solved one = solve(scene, {night}, rules);
  const double reflected_w = lamp_only.tally.ledger[0][Term::unshot];
  EXPECT_NEAR(static_cast<double>(one.work[Work::samples]), (lamp_w + reflected_w) / per_sample,
              realizations * (2.0 + static_cast<double>(one.area.size())));
  EXPECT_GT(one.work[Work::samples], lamp_only.work[Work::samples]);
  // One sample of each patch with power is the least.
  rules.bounces = 0;
  rules.power_per_sample_w = 1e9;
  EXPECT_EQ(solve(scene, {night}, rules).work[Work::samples], 2u * realizations);
  // auto: as many as there are lines.
  rules.power_per_sample_w = {};
  const Solved by_auto = solve(scene, {night}, rules);
  EXPECT_NEAR(static_cast<double>(by_auto.work[Work::samples]),
              static_cast<double>(by_auto.area.size()) * rules.lines_per_patch, realizations);
}

// One sample of every patch is enough for an unbiased result: only its error is large.
TEST(Shooting, IsUnbiasedForTheFewestSamples) {
  const auto c = reference_cases("05_radiosity/box_12_triangles.json", "box12_").front();
  SceneBuilder builder;
  double rho_most = 0;
  for (std::size_t t = 0; t < 12; ++t) {
    const double rho = number(c["reflectance"][t]);
    rho_most = std::max(rho_most, rho);
    const auto& v = c["triangles"][t];
    const auto at = [&](std::size_t k) {
      return Vec3{number(v[k][0]), number(v[k][1]), number(v[k][2])};
    };
    builder.triangle(at(0), at(1), at(2),
                     builder.material({"m" + std::to_string(t), rho, 0, number(c["emission"][t])}));
  }
  constexpr int bounces = 30;
  SolverRules rules = shooting_rules(Transport::shoot, bounces);
  rules.realizations = rules.lines_per_patch = rules.direct_samples = 2048;
  rules.power_per_sample_w = 1e9;
  const Solved solved = solve(builder.scene(), {night}, rules);
  const double left = std::pow(rho_most, bounces + 1) / (1 - rho_most);
  int noticed = 0, reflecting = 0;
  for (std::size_t t = 0; t < 12; ++t) {
    const double rho = number(c["reflectance"][t]), M = number(c["emission"][t]);
    const double B = number(c["radiosity"][t]);
    auto values = solved.of_patch(t);
    for (auto& H : values) H = M + rho * H;
    const Verdict verdict = expect_mean(values, B, left * B);
    std::cout << t << ": " << verdict.text << "\n";
    EXPECT_TRUE(verdict) << t << ": " << verdict.text;
    if (rho <= 0) continue;
    ++reflecting;
    noticed += !expect_mean(values, M + (B - M) * 1.3, left * B);
  }
  EXPECT_GT(noticed, reflecting / 2);
}

TEST(Shooting, VarianceFallsWithTheNumberOfSamples) {
  const Scene scene = lamp_room(as_it_is);
  constexpr int many_realizations = 64;
  const auto variance = [&](double per_sample, std::uint64_t seed) {
    SolverRules rules = shooting_rules(Transport::shoot, 4);
    rules.realizations = rules.direct_samples = rules.lines_per_patch = many_realizations;
    rules.power_per_sample_w = per_sample;
    rules.seed = seed;
    const Solved solved = solve(scene, {night}, rules, {.max_edge_m = 1});
    double sum = 0;
    for (std::size_t i = 0; i < solved.area.size(); ++i)
      sum += std::pow(solved.area[i] * mean_error(solved.of_patch(i)).standard_error, 2);
    return sum;
  };
  constexpr double more = 16;
  const double few = variance(1e-3, 1), many = variance(1e-3 / more, 1);
  const double slope = std::log(few / many) / std::log(more);
  // A sum of variances of n realizations is known to √(2/(n - 1)) at worst (patches that
  // vary together), so is the logarithm of their quotient to twice the square of that.
  const double error = 2 * std::sqrt(1.0 / (many_realizations - 1)) / std::log(more);
  std::cout << "variance falls with power " << slope << " +- " << error << " of samples\n";
  EXPECT_GE(slope + accepted_t(1000) * error, 1);
  // Planted fault: samples that do not differ are as good as one.
  const double same = std::log(few / variance(1e-3, 2)) / std::log(more);
  EXPECT_LT(same + accepted_t(1000) * error, slope);
  EXPECT_LT(same, 1 - error);
}

// Chains of mirrors: a floor sees the ceiling in the walls, by light sent forward.
TEST(Shooting, FloorSeesTheCeilingInMirrorWalls) {
  for (const auto& c : reference_cases("05_radiosity/mirrors.json", "mirror_box")) {
    const double reflectance = number(c["wall_mirror_reflectance"]);
    const double x = number(c["size"][0]), y = number(c["size"][1]), h = number(c["size"][2]);
    SceneBuilder builder;
    const int black = builder.material({"black", 0, 0, 0});
    const int bright = builder.material({"bright", 0, 0, 1});
    const int mirror = builder.material({"mirror", 0, reflectance, 0});
    builder.quad({0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}, black);
    builder.quad({0, 0, h}, {0, y, h}, {x, y, h}, {x, 0, h}, bright);
    const Vec3 up{0, 0, h}, corner[] = {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 a = corner[k], b = corner[(k + 1) % 4];
      builder.quad(b, a, a + up, b + up, mirror);
    }
    SolverRules rules = shooting_rules(Transport::shoot, 0);
    rules.mirror_depth = 1000;
    rules.lines_per_patch = realizations * 2048;
    const Solved solved = solve(builder.scene(), {night}, rules);
    const auto values = solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; });
    const double F = number(c["F_floor_to_ceiling_mean"]);
    const Verdict verdict = expect_mean(values, F);
    std::cout << c["id"] << ": " << verdict.text << "\n";
    EXPECT_TRUE(verdict) << verdict.text;
    EXPECT_FALSE(expect_mean(values, reflectance == 1 ? 0.99 : 1.02 * F));
    EXPECT_LE(largest_residual(solved), closes);
  }
}

// All of the beam reaches the ground.
TEST(Shooting, SunIsSentOnByMoreThanOneMirror) {
  SceneBuilder builder;
  const int first = builder.material({"first", 0, 0.9, 0}),
            second = builder.material({"second", 0, 0.8, 0}),
            wall = builder.material({"wall", 0, 0, 0});
  // A periscope: the beam of 1 m² comes down on the first, leaves along +x, meets the
  // second, whose back is turned to the sun, and goes down to a plate.
  builder.quad({0, 0, 0}, {1, 0, -1}, {1, 1, -1}, {0, 1, 0}, first);
  builder.quad({3, -1, 1}, {3, 2, 1}, {5, 2, -1}, {5, -1, -1}, second);
  builder.object("plate").quad({2, -2, -9}, {6, -2, -9}, {6, 3, -9}, {2, 3, -9}, wall);
  const Solved solved = solve(builder.scene(), {one_second({0, 0, 1}, 1000)},
                              shooting_rules(Transport::shoot), {.max_edge_m = 0.5});
  const auto mirrored = static_cast<std::size_t>(Part::mirror);
  double power = 0;
  for (std::size_t i = 0; i < solved.area.size(); ++i)
    if (solved.patches[i].triangle >= 4)
      power += solved.area[i] * solved.tally.exposure[mirrored][i];
  EXPECT_LE(largest_residual(solved), closes);
  std::cout << "the plate receives " << power << " W\n";
  EXPECT_NEAR(power, 1000 * 0.9 * 0.8, 720 * float_rounding);
}

}  // namespace
}  // namespace sunload::test
