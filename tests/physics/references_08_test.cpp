// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Reference 08 where other tests do not have it: faint and far points of emitters, the balance
/// of what is emitted, scale, large extent, slivers, an emitter that is hidden.

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "tests/support/hidden_emitter.h"
#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

using nlohmann::json;

constexpr const char* cases_file = "08_smits_jensen_style/cases.json";

constexpr TruthCheck luminaire_check{.fault_factor = 1.03, .standard_error = 0.005};

struct ReferenceStage : LampStage {
  /// Square of side s at height h over the origin, facing down.
  void square_lamp(double s, double h) {
    const double a = s / 2;
    builder.quad({-a, -a, h}, {-a, a, h}, {a, a, h}, {a, -a, h}, lamp);
  }
};

/// Irradiance per realization at a point of horizontal ground.
std::vector<double> on_ground(const Scene& scene, Vec3 p, int lines, int bounces = 0,
                              double max_edge = 1e9) {
  constexpr int lines_of_each = 32;
  return at_point(scene, p, {0, 0, 1}, static_cast<std::size_t>(lines / lines_of_each),
                  diffuse_rules(lines_of_each, bounces), {.max_edge_m = max_edge});
}

constexpr int lines = 1 << 13;

TEST(Emission, SquareAtEveryPointHoweverFaint) {
  for (const auto& c : reference_cases(cases_file, "emission_square"))
    for (std::size_t k = 0; k < c["points"].size(); ++k) {
      const Vec3 p = point(c["points"][k]);
      const double h = number(c["h"]), E = number(c["irradiance"][k]);
      ReferenceStage stage;
      stage.square_lamp(number(c["s"]), h);
      // Lifting the point takes as much from both cosines, hence twice.
      const double bias = 2 * E * lift(std::hypot(p.x, p.y) + h + 1) / h;
      luminaire_check(c["id"].get<std::string>() + " " + std::to_string(k),
                      on_ground(stage.builder.scene(), p, lines), E, bias);
    }
}

TEST(Emission, WhatTheReceiverMissesLeavesTheScene) {
  for (const auto& c : reference_cases(cases_file, "emission_total")) {
    const double s = number(c["s"]), h = number(c["h"]), F = number(c["mean_irradiance"]),
                 a = s / 2;
    ReferenceStage stage;
    stage.builder.quad({-a, -a, 0}, {a, -a, 0}, {a, a, 0}, {-a, a, 0}, stage.black);
    stage.square_lamp(s, h);
    const Solved solved = solve(stage.builder.scene(), {night}, diffuse_rules(1 << 12));
    const double bias = F * lift(s + h) / h;
    luminaire_check(c["id"],
                    solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; }), F,
                    bias);
    luminaire_check(c["id"].get<std::string>() + " escaping",
                    solved.ledger([&](const Ledger& l) { return l[Term::escaped] / (s * s); }),
                    1 - F, bias);
  }
}

// Scenes are moved to a local origin before they are lit: the move is geo's to take away.
TEST(Scale, MakesNoDifference) {
  for (const auto& c : reference_cases(cases_file, "scale_")) {
    const double scale = number(c["scale"]), E = number(c["irradiance"]);
    ReferenceStage stage;
    stage.square_lamp(scale, scale);
    luminaire_check(c["id"], on_ground(stage.builder.scene(), {0.5 * scale, 0.5 * scale, 0}, lines),
                    E, 2 * E * lift(2));
  }
}

TEST(LargeExtent, TendsToAll) {
  for (const auto& c : reference_cases(cases_file, "large_extent")) {
    const double side = number(c["side"]), h = number(c["height"]);
    ReferenceStage stage;
    stage.square_lamp(side, h);
    luminaire_check(c["id"], on_ground(stage.builder.scene(), point(c["point"]), lines),
                    number(c["irradiance"]), lift(side) / h);
  }
}

TEST(Slivers, AreAsBrightAsTheirWhole) {
  for (const auto& c : reference_cases(cases_file, "sliver_fan")) {
    const Vec3 fan = point(c["fan_point"]);
    const Vec3 corner[] = {{-0.5, -0.5, 1}, {-0.5, 0.5, 1}, {0.5, 0.5, 1}, {0.5, -0.5, 1}};
    ReferenceStage stage;
    for (std::size_t k = 0; k < 4; ++k)
      stage.builder.triangle(fan, corner[k], corner[(k + 1) % 4], stage.lamp);
    const double E = number(c["irradiance"]);
    luminaire_check(c["id"], on_ground(stage.builder.scene(), point(c["point"]), lines), E,
                    2 * E * lift(2));
  }
}

// Samples of the lamp find the ceiling by way of mirrors; by gathering: hidden_emitter_slow_test.
TEST(HiddenEmitter, ArrivesByOneReflection) {
  expect_hidden_emitter(Transport::shoot, {32, 128}, 0.005);
}

}  // namespace
}  // namespace sunload::test
