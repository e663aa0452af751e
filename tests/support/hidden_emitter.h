// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Reference 08: light of a lamp behind a baffle, which reaches a point by one reflection.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {

/// Lines per realization of every patch and sensor, and the sensors at the point.
struct HiddenEmitterCounts {
  int lines;
  std::size_t sensors;
};

/// Two dimensions between perfect mirrors. The ceiling ends where little is left: at x it has
/// (6b - b²) / 4x² of the lamp's light, of which 9 / 2(x - 8)³ per metre reach the point.
inline void expect_hidden_emitter(Transport transport, const HiddenEmitterCounts& counts,
                                  double standard_error) {
  for (const auto& c : reference_cases("08_smits_jensen_style/cases.json", "hidden_emitter_2d")) {
    const double b = number(c["b"]), rho = number(c["rho"]), E = number(c["irradiance_one_bounce"]);
    constexpr double far = 24, wide = 16, h = 3;
    LampStage stage;
    auto& s = stage.builder;
    const int ceiling = s.material({"ceiling", rho, 0, 0});
    const int mirror = s.material({"mirror", 0, 1, 0});
    s.object("lamp").quad({0, 0, 0}, {0, wide, 0}, {0, wide, b}, {0, 0, b}, stage.lamp);
    s.object("ceiling").quad({0, 0, h}, {0, wide, h}, {far, wide, h}, {far, 0, h}, ceiling);
    s.object("mirrors").quad({0, 0, 0}, {0, 0, h}, {far, 0, h}, {far, 0, 0}, mirror);
    s.quad({0, wide, 0}, {far, wide, 0}, {far, wide, h}, {0, wide, h}, mirror);
    s.sides(Sides::two)
        .object("baffle")
        .quad({4, 0, 0}, {4, wide, 0}, {4, wide, 2}, {4, 0, 2}, stage.black);
    SolverRules rules = diffuse_rules(counts.lines, 1);
    rules.transport = transport;
    const auto with = [&](double edge) {
      return at_point(s.scene(), {8, wide / 2, 0}, {0, 0, 1}, counts.sensors, rules,
                      {.max_edge_m = edge});
    };
    const auto coarse = with(2), fine = with(1);
    const double beyond =
        rho * (6 * b - b * b) / 4 * 9 / 2 / (2 * far * far * (far - 8) * (far - 8));
    const double bias =
        std::abs(mean_error(coarse).mean - mean_error(fine).mean) + beyond + 2 * E * lift(far);
    expect_truth(c["id"], fine, E, bias, {.fault = 1.12 * E, .standard_error = standard_error});
  }
}

}  // namespace sunload::test
