// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What tests of the sun by way of several mirrors share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/support/known_truth.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {

inline constexpr double dni = 1000;
enum class By { images, shooting };

/// No light but the sun, nothing reflected diffusely, no chain cut but by its depth.
inline SolverRules glint_rules(By by, int mirror_depth = 1000) {
  SolverRules rules = test_rules();
  rules.realizations = 32;
  rules.lines_per_patch = 32;
  rules.direct_samples = 32 * 16;
  rules.bounces = 0;
  rules.mirror_depth = mirror_depth;
  rules.faint_glint = 0;
  if (by == By::shooting) rules.most_sun_beams = 0;
  return rules;
}

inline Solved solve_sun(const Scene& scene, Vec3 sun, const SolverRules& rules,
                        double max_edge_m = 1e9) {
  return solve(scene, {one_second(sun, dni)}, rules, {.max_edge_m = max_edge_m});
}

inline float by_mirrors(const Solved& solved, std::size_t patch) {
  return solved.tally.irradiance[static_cast<std::size_t>(Part::mirror)][patch];
}

inline void check_glint(const std::string& what, const std::vector<double>& values, double truth,
                        double fault, double bias = 0) {
  expect_truth(what, values, truth, float_rounding * std::abs(truth) + bias,
               {.fault = fault, .standard_error = {}});
}

inline void check_ledger(const std::string& what, const Solved& solved) {
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
  const Verdict closed = expect_mean(residual, 0, float_rounding * in);
  std::cout << what << ": in " << in << " W, residual " << closed.text << "\n";
  EXPECT_TRUE(closed) << what << ": " << closed.text;
  EXPECT_LE(closed.standard_error, 0.01 * in) << what;
}

/// A window in the plane x = 0, a mirror wall at x = width, black ground between.
struct TwoMirrorStreet {
  static constexpr double width = 10, y0 = 2, y1 = 4, z0 = 9, z1 = 10.5;
  Vec3 sun = normalized({0.55, -0.25, 0.4});

  Scene scene(double rho_window, double rho_wall) const {
    SceneBuilder b;
    const int black = b.material({"black", 0, 0, 0});
    const int window = b.material({"window", 0, rho_window, 0});
    const int wall = b.material({"wall", 0, rho_wall, 0});
    b.quad({0, 0, 0}, {width, 0, 0}, {width, 20, 0}, {0, 20, 0}, black);
    b.quad({0, y0, z0}, {0, y1, z0}, {0, y1, z1}, {0, y0, z1}, window);
    // Low enough that the sun passes over it to the window.
    b.quad({width, 0, 0}, {width, 0, 4}, {width, 20, 4}, {width, 20, 0}, wall);
    return b.scene();
  }
  /// Where light from the window's point falls on the ground: by the wall.
  Vec3 on_ground(double y, double z) const {
    const Vec3 away = -image(sun, {1, 0, 0});                     // from the window
    const Vec3 back = -image(image(sun, {1, 0, 0}), {-1, 0, 0});  // from the wall
    const Vec3 at_window{0, y, z}, at_wall = at_window + away * (width / away.x);
    return at_wall + back * (at_wall.z / -back.z);
  }
};

}  // namespace sunload::test
