// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Mirrors against the method of images: lamps seen in mirrors, the sun reflected to the
/// ground, chains cut at their depth. The sun by way of several mirrors: glints_test.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using nlohmann::json;

constexpr const char* mirrors = "05_radiosity/mirrors.json";

SolverRules rules_of(int lines_per_realization, int mirror_depth = 1000) {
  SolverRules rules = diffuse_rules(lines_per_realization, 0, 32);
  rules.direct_samples = 32 * 16;
  rules.mirror_depth = mirror_depth;
  return rules;
}

/// A wrong truth that is refused, at the precision that all cases have.
Demand refusing(double fault) { return {.fault = fault, .standard_error = 0.005}; }

/// A receiver at a point of the ground, cut into 32 triangles, and a lamp above it.
struct Seen {
  explicit Seen(const json& c) : receiver(point(c["point"])) {
    builder.object("receiver");
    // A hundredth of the lamp's distance (0.5 m at least): bias of the order of its square.
    const double step = edge / pieces;
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; j < pieces; ++j) {
        const Vec3 p = receiver + Vec3{i * step - edge / 2, j * step - edge / 2, 0};
        builder.quad(p, p + Vec3{step, 0, 0}, p + Vec3{step, step, 0}, p + Vec3{0, step, 0}, black);
      }
    const auto& e = c["emitter"];
    builder.object("lamp").quad(point(e[0]), point(e[1]), point(e[2]), point(e[3]), lamp);
    distance = std::abs(number(e[0][2]) - receiver.z);
    if (c.contains("mirror_reflectance"))
      mirror = builder.material({"mirror", 0, number(c["mirror_reflectance"]), 0});
  }

  /// Mirror in the plane x = constant, facing +x or -x.
  void mirror_x(double x, double facing, Vec3 low, Vec3 high) {
    const Vec3 a{x, low.y, low.z}, b{x, high.y, low.z}, c{x, high.y, high.z}, d{x, low.y, high.z};
    builder.object("mirror_x");
    facing > 0 ? builder.quad(a, b, c, d, mirror) : builder.quad(b, a, d, c, mirror);
  }
  void mirror_y(double y, Vec3 low, Vec3 high) {
    builder.object("mirror_y")
        .quad({high.x, y, low.z}, {low.x, y, low.z}, {low.x, y, high.z}, {high.x, y, high.z},
              mirror);
  }

  std::vector<double> irradiance(int lines, int depth = 1000) const {
    const auto solved = solve(builder.scene(), {night}, rules_of(lines, depth));
    return solved.means(
        [&](std::size_t i) { return solved.patches[i].triangle < 2 * pieces * pieces; });
  }
  double bias() const { return edge * edge / (distance * distance) + 1e-5; }

  static constexpr int pieces = 4;
  static constexpr double edge = 0.005;
  SceneBuilder builder;
  int black = builder.material({"black", 0, 0, 0});
  int lamp = builder.material({"lamp", 0, 0, 1});
  int mirror = black;
  Vec3 receiver;
  double distance = 0;
};

constexpr double enough = 20;  // [m] of mirror that holds every image in it

TEST(LampInMirrors, OneInfiniteMirrorAndTwoInACorner) {
  for (const char* kind : {"one_infinite_mirror", "corner_two_mirrors"})
    for (const auto& c : reference_cases(mirrors, kind)) {
      Seen seen(c);
      const bool corner = std::string(kind) == "corner_two_mirrors";
      seen.mirror_x(0, +1, {0, corner ? 0 : -enough, 0}, {0, enough, enough});
      if (corner) seen.mirror_y(0, {0, 0, 0}, {enough, 0, enough});
      expect_truth(c["id"], seen.irradiance(1024), number(c["H_total"]), seen.bias(),
                   refusing(number(c["H_direct"])));
    }
}

TEST(LampInMirrors, ParallelMirrorsAtAnyDepth) {
  const auto cases = reference_cases(mirrors, "parallel_mirrors");
  for (const auto& c : cases) {
    Seen seen(c);
    const double W = number(c["W"]);
    // Lines to the images stay between the receiver and the lamp in y and z.
    seen.mirror_x(0, +1, {0, -2, 0}, {0, 2, 3});
    seen.mirror_x(W, -1, {0, -2, 0}, {0, 2, 3});
    const auto& most = c["max_specular_bounces"];
    const int depth = most.is_null() ? 1000 : most.get<int>();
    // Planted fault: the other case's truth, 2 % away.
    const auto& other = &c == &cases[0] ? cases[1] : cases[0];
    expect_truth(c["id"], seen.irradiance(2048, depth), number(c["H_total"]), seen.bias(),
                 refusing(number(other["H_total"])));
  }
}

TEST(LampInMirrors, FiniteMirrorIsAWindow) {
  for (const auto& c : reference_cases(mirrors, "finite_mirror")) {
    Seen seen(c);
    seen.mirror_x(0, +1, {0, number(c["mirror_rect_y"][0]), number(c["mirror_rect_z"][0])},
                  {0, number(c["mirror_rect_y"][1]), number(c["mirror_rect_z"][1])});
    const double H = number(c["H_total"]);
    expect_truth(c["id"], seen.irradiance(1024), H, seen.bias(),
                 refusing(number(c["H_specular_once"]) > 0 ? number(c["H_direct"]) : 1.04 * H));
  }
}

/// A room with mirror walls, its floor facing up, its ceiling down.
Scene mirror_room(const json& size, double reflectance, double rho, double M) {
  const double x = number(size[0]), y = number(size[1]), h = number(size[2]);
  SceneBuilder builder;
  const int floor = builder.material({"floor", rho, 0, M});
  const int ceiling = builder.material({"ceiling", rho, 0, 1 - M});
  const int mirror = builder.material({"mirror", 0, reflectance, 0});
  builder.quad({0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}, floor);
  builder.quad({0, 0, h}, {0, y, h}, {x, y, h}, {x, 0, h}, ceiling);
  const Vec3 up{0, 0, h}, corner[] = {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 a = corner[k], b = corner[(k + 1) % 4];
    builder.quad(b, a, a + up, b + up, mirror);
  }
  return builder.scene();
}

TEST(MirrorRoom, FloorSeesTheCeilingInItsWalls) {
  for (const auto& c : reference_cases(mirrors, "mirror_box")) {
    const double reflectance = number(c["wall_mirror_reflectance"]);
    const auto solved = solve(mirror_room(c["size"], reflectance, 0, 0), {night}, rules_of(2048));
    const double F = number(c["F_floor_to_ceiling_mean"]);
    expect_truth(c["id"],
                 solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; }), F, 0,
                 refusing(reflectance == 1 ? 0.99 : 1.02 * F));
  }
}

/// The mirror of a case of sun_on_mirror on black ground that catches its beam. Nothing
/// stands in the sun of the ground: the mirror's shadow falls beyond it.
struct Glint {
  explicit Glint(const json& c)
      : sun(enu_direction({number(c["sun_azimuth_deg"]), number(c["sun_elevation_deg"])})),
        dni(number(c["DNI"])) {
    for (const auto& p : c["parallelogram"]) corner.push_back({number(p[0]), number(p[1]), 0});
    double y0 = 0, y1 = 0;
    for (const Vec3 p : corner) {
      x1 = std::max(x1, p.x);
      y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
    }
    const int black = builder.material({"black", 0, 0, 0});
    const int mirror = builder.material({"mirror", 0, number(c["mirror_reflectance"]), 0});
    x1 += 0.5;
    builder.object("ground").quad({0, y0 - 0.5, 0}, {x1, y0 - 0.5, 0}, {x1, y1 + 0.5, 0},
                                  {0, y1 + 0.5, 0}, black);
    const double w = number(c["w"]), z0 = number(c["z0"]), z1 = z0 + number(c["h"]);
    builder.object("mirror").quad({0, 0, z0}, {0, w, z0}, {0, w, z1}, {0, 0, z1}, mirror);
  }
  /// Distance to the beam's outline, positive inside.
  double depth(Vec3 p) const {
    double least = 1e300;
    Vec3 twice_area;
    for (std::size_t k = 1; k + 1 < 4; ++k)
      twice_area += cross(corner[k] - corner[0], corner[k + 1] - corner[0]);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 e = corner[(k + 1) % 4] - corner[k];
      least =
          std::min(least, std::copysign(1.0, twice_area.z) * cross(e, p - corner[k]).z / norm(e));
    }
    return least;
  }
  SceneBuilder builder;
  Vec3 sun;
  double dni, x1 = 0;
  std::vector<Vec3> corner;
};

TEST(SunInAMirror, LandsWhereTheLawOfReflectionSays) {
  for (const auto& c : reference_cases(mirrors, "sun_on_mirror")) {
    const Glint glint(c);
    constexpr double edge = 0.2;
    Watch watch;
    const Scene scene = glint.builder.scene();
    const auto traced = trace_scene(scene, {.max_edge_m = edge}, rules_of(1), watch);
    const std::vector<IntervalLight> light{one_second(glint.sun, glint.dni)};
    const auto tally = sunload::solve(*transport_of(*traced), light, watch).bands.front();
    const auto& by_mirror = tally.irradiance[static_cast<std::size_t>(Part::mirror)];
    const double E = number(c["extra_horizontal_irradiance"]);
    int inside = 0, outside = 0;
    for (std::size_t i = 0; i < traced->hierarchy().patch_count(); ++i) {
      if (traced->hierarchy().patches()[i].triangle >= 2) continue;
      const double depth = glint.depth(traced->hierarchy().centroid(i));
      // A patch lies wholly on one side where its centroid is an edge away.
      if (depth > edge) {
        ++inside;
        EXPECT_NEAR(static_cast<double>(by_mirror[i]), E, float_rounding * E);
      } else if (depth < -edge) {
        ++outside;
        EXPECT_EQ(by_mirror[i], 0.0f);
      }
    }
    EXPECT_GT(inside, 10);
    EXPECT_GT(outside, 10);
  }
}

TEST(SunInAMirror, CarriesItsPower) {
  for (const auto& c : reference_cases(mirrors, "sun_on_mirror")) {
    const Glint glint(c);
    const auto solved = solve(glint.builder.scene(), {one_second(glint.sun, glint.dni)},
                              rules_of(1), {.max_edge_m = 0.2});
    std::vector<double> power;
    double ground = 0;
    for (std::size_t i = 0; i < solved.area.size(); ++i)
      if (solved.patches[i].triangle < 2) ground += solved.area[i];
    for (const double mean :
         solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; }))
      power.push_back((mean - glint.dni * glint.sun.z) * ground);
    const double truth = number(c["reflected_power_W"]);
    // Rounding of the ground's whole power, in which the glint's is contained.
    expect_truth(c["id"], power, truth, float_rounding * glint.dni * glint.sun.z * ground,
                 refusing(1.02 * truth));

    // Its ledger: the reflected power is absorbed by the ground as much as the rest.
    const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
    const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
    const Verdict closed = expect_mean(residual, 0, float_rounding * in);
    EXPECT_TRUE(closed) << closed.text;
    EXPECT_LE(closed.standard_error, 0.01 * in);
  }
}

// Of one reflection: what the first of two mirrors sends on is received by the second, and
// what the second would send on is cut: 0.9 · 0.8 of the beam, with the rest of it absorbed.
TEST(SunInAMirror, ReflectionBeyondTheDepthIsBookedAsUnshot) {
  SceneBuilder builder;
  const int first = builder.material({"first", 0, 0.9, 0}),
            second = builder.material({"second", 0, 0.8, 0});
  // A periscope: the beam of 1 m² comes down on the first, leaves along +x and meets the
  // second, whose back is turned to the sun.
  builder.quad({0, 0, 0}, {1, 0, -1}, {1, 1, -1}, {0, 1, 0}, first);
  builder.quad({3, -1, 1}, {3, 2, 1}, {5, 2, -1}, {5, -1, -1}, second);
  const auto solved =
      solve(builder.scene(), {one_second({0, 0, 1}, 1000)}, rules_of(1, 1), {.max_edge_m = 0.5});
  const Ledger& ledger = solved.tally.ledger[0];
  EXPECT_NEAR(ledger[Term::sun], 1000, 1000 * float_rounding);
  // What the second receives is known as well as the beam's outline on it is sampled.
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const Verdict closed = expect_mean(residual, 0, float_rounding * ledger.in());
  EXPECT_TRUE(closed) << closed.text;
  EXPECT_LE(closed.standard_error, 1e-3 * ledger.in());
  for (const auto& c : reference_cases(mirrors, "periscope"))
    EXPECT_NEAR(ledger[Term::unshot], number(c["H"]), number(c["H"]) * float_rounding);
}

/// Two facing mirrors with a lamp between them, open above and at the sides.
Scene facing_mirrors() {
  SceneBuilder builder;
  const int ground = builder.material({"ground", 0.3, 0, 0}),
            lamp = builder.material({"lamp", 0.2, 0, 40});
  const int left = builder.material({"left", 0, 0.9, 0}),
            right = builder.material({"right", 0.1, 0.8, 0});
  builder.object("ground").quad({0, 0, 0}, {3, 0, 0}, {3, 6, 0}, {0, 6, 0}, ground);
  builder.object("left").quad({0, 0, 0}, {0, 6, 0}, {0, 6, 4}, {0, 0, 4}, left);
  builder.object("right").quad({3, 0, 0}, {3, 0, 4}, {3, 6, 4}, {3, 6, 0}, right);
  builder.object("lamp").quad({1, 2, 2}, {1, 3, 2}, {2, 3, 2}, {2, 2, 2}, lamp);
  return builder.scene();
}

TEST(FacingMirrors, LedgerClosesAtEveryDepth) {
  auto light = with_uniform_sky(one_second({0.6, 0.1, 0.7}, 600), 100);
  light.ground_exitance = 50;
  double unshot_before = 1e300;
  for (const int depth : {0, 1, 2, 5, 40}) {
    auto rules = rules_of(64, depth);
    rules.bounces = 30;
    const auto solved = solve(facing_mirrors(), {light}, rules, {.max_edge_m = 1});
    const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
    const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
    const double unshot =
        mean_error(solved.ledger([](const Ledger& l) { return l[Term::unshot]; })).mean;
    const Verdict verdict = expect_mean(residual, 0, float_rounding * in);
    std::cout << "depth " << depth << ": in " << in << " W, unshot " << unshot << " W, residual "
              << verdict.text << "\n";
    EXPECT_TRUE(verdict) << depth << ": " << verdict.text;
    EXPECT_LE(verdict.standard_error, 0.01 * in);
    EXPECT_LT(unshot, unshot_before);
    unshot_before = unshot;
    if (depth > 2) continue;  // what is cut is less than its error
    // Planted fault: what is cut is not booked.
    const auto faulty =
        solved.ledger([](const Ledger& l) { return l.residual() + l[Term::unshot]; });
    EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * in)) << depth;
  }
}

}  // namespace
}  // namespace sunload::test
