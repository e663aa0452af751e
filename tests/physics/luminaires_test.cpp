// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Luminaires: points over floors, plates, mirrors and in a sphere, against solid angles.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geo/base/units.h"
#include "solver/base/spherical_triangle.h"
#include "tests/support/lamp_rules.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

constexpr double intensity = 900;
/// Even within a beam of that full angle.
void add_luminaire(Scene& scene, Vec3 at, double beam_deg = 360, Vec3 towards = {0, 0, -1}) {
  scene.luminaires.webs.push_back({{0}, {0, beam_deg / 2}, {1, 1}});
  Luminaire luminaire(at, normalized(towards), 0);
  luminaire.web = scene.luminaires.webs.size() - 1;
  luminaire.scale = intensity;
  luminaire.key = key_of_place(at, luminaire.axis);
  scene.luminaires.all.push_back(luminaire);
}

double solid_angle(Vec3 from, Vec3 a, Vec3 b, Vec3 c) {
  return SphericalTriangle(a - from, b - from, c - from).solid_angle();
}
/// Of a rectangle z = 0, [-x, x] × [-y, y].
double solid_angle_below(Vec3 from, double x, double y) {
  return solid_angle(from, {-x, -y, 0}, {x, -y, 0}, {x, y, 0}) +
         solid_angle(from, {-x, -y, 0}, {x, y, 0}, {-x, y, 0});
}

/// A floor of 10 m × 6 m; what hangs over it comes later.
SceneBuilder floor_of(const Material& material) {
  SceneBuilder builder;
  const int floor = builder.material(material);
  builder.object("floor").quad({-5, -3, 0}, {5, -3, 0}, {5, 3, 0}, {-5, 3, 0}, floor);
  return builder;
}

std::vector<double> powers(const Solved& solved, const std::function<bool(std::size_t)>& chosen) {
  std::vector<double> values = solved.means(chosen);
  double area = 0;
  for (std::size_t i = 0; i < solved.area.size(); ++i)
    if (chosen(i)) area += solved.area[i];
  for (auto& value : values) value *= area;
  return values;
}
auto is_floor(const Solved& solved) {
  return [&](std::size_t i) { return solved.patches[i].triangle < 2; };
}

// Directions are drawn within the patch: I Ω / A without noise, however near the lamp hangs.
TEST(Luminaires, EvenLightOnAnOpenFloorIsExact) {
  for (const double height : {0.01, 1.0, 4.0}) {
    Scene scene = floor_of({"black", 0, 0, 0}).scene();
    const Vec3 at{0.3, -0.4, height};
    add_luminaire(scene, at);
    const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 1.5});
    for (std::size_t i = 0; i < solved.area.size(); ++i) {
      const auto& [a, b, c] = solved.corners[i];
      const double omega = solid_angle(at, a, b, c);
      if (omega < 1e-3) continue;  // by points
      const double truth = intensity * omega / solved.area[i];
      ASSERT_NEAR(static_cast<double>(solved.tally.irradiance[lamps][i]), truth, 1e-5 * truth) << i;
      ASSERT_NEAR(solved.tally.exposure_realization[3][i], truth, 1e-5 * truth) << i;
    }
    const double truth = intensity * solid_angle_below(at, 5, 3);
    const Verdict verdict = expect_mean(powers(solved, is_floor(solved)), truth, 1e-5 * truth);
    EXPECT_TRUE(verdict) << verdict.text;
  }
}

TEST(Luminaires, ShineOnSensorsByTheSquareOfDistance) {
  Scene scene = floor_of({"black", 0, 0, 0}).scene();
  const Vec3 at{0, 0, 5};
  add_luminaire(scene, at, 100);
  scene.sensors = {sensor_at({0, 0, 1}, {0, 0, 1}), sensor_at({3, 0, 1}, {0, 0, 1}),
                   sensor_at({3, 0, 1}, {-4, 0, 3}), sensor_at({0, 0, 1}, {0, 0, -1}),
                   sensor_at({0, 6, 1}, {0, 0, 1})};
  const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 2});
  const std::array truth{intensity / 16, intensity / 25 * 0.8, intensity / 25 * 0.96, 0.0,
                         0.0};  // the last one stands beside the beam
  for (std::size_t s = 0; s < truth.size(); ++s)
    EXPECT_NEAR(static_cast<double>(solved.tally.sensors.irradiance[lamps][s]), truth[s],
                1e-4 * intensity / 16)
        << s;
}

// The floor has what the plate leaves it.
TEST(Luminaires, CastShadows) {
  SceneBuilder builder = floor_of({"grey", 0.4, 0, 0});
  const int black = builder.material({"black", 0, 0, 0});
  builder.object("plate")
      .sides(Sides::two)
      .quad({-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0.5, 0.5, 2}, {-0.5, 0.5, 2}, black);
  Scene scene = builder.scene();
  const Vec3 at{0.2, 0.1, 4};
  add_luminaire(scene, at);
  const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 1});
  const double hidden = intensity * solid_angle_below(at - Vec3{0, 0, 2}, 0.5, 0.5);
  const double truth = intensity * solid_angle_below(at, 5, 3) - hidden;
  const auto floor = powers(solved, is_floor(solved));
  const Verdict verdict = expect_mean(floor, truth, 1e-4 * truth);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(floor, truth + 0.1 * hidden, 1e-4 * truth));
}

// All of a beam meets the floor: its flux.
TEST(Luminaires, ABeamBringsItsFlux) {
  Scene scene = floor_of({"black", 0, 0, 0}).scene();
  add_luminaire(scene, {0.3, 0.2, 3}, 60, {0.2, 0.1, -1});
  const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 1});
  const double truth = intensity * 2 * pi * (1 - std::cos(pi / 6));
  const auto floor = powers(solved, is_floor(solved));
  const Verdict verdict = expect_mean(floor, truth, 1e-5 * truth);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(floor, truth * 1.02, 1e-5 * truth));
  EXPECT_NEAR(scene.luminaires.flux(), truth, 1e-9 * truth);
}

// However narrow the beam, and whether one patch holds it or several share it.
TEST(Luminaires, NarrowBeamsBringTheirFlux) {
  for (const double beam_deg : {0.1, 2.0, 15.0})
    for (const double edge_m : {20.0, 0.5}) {
      Scene scene = floor_of({"black", 0, 0, 0}).scene();
      add_luminaire(scene, {0.3, 0.2, 3}, beam_deg, {0.2, 0.1, -1});
      const double truth = scene.luminaires.flux();
      SolverRules rules = lamp_rules(0);
      rules.direct_samples = 16;
      const auto solved = solve(scene, {night}, rules, {.max_edge_m = edge_m});
      const Verdict verdict = expect_mean(powers(solved, is_floor(solved)), truth, 1e-3 * truth);
      EXPECT_TRUE(verdict) << beam_deg << ' ' << edge_m << ' ' << verdict.text;
      EXPECT_LT(verdict.standard_error, 0.01 * truth) << beam_deg << ' ' << edge_m;
      EXPECT_FALSE(expect_mean(powers(solved, is_floor(solved)), 1.1 * truth, 1e-3 * truth));
    }
}

// Each patch has what its own share of the spot brings: a circle about the point below the lamp,
// whose middle is a corner of the patches.
TEST(Luminaires, PatchesShareASpot) {
  Scene scene = floor_of({"black", 0, 0, 0}).scene();
  add_luminaire(scene, {0, 0, 3}, 1);
  SolverRules rules = lamp_rules(0);
  rules.direct_samples = 16;
  const auto solved = solve(scene, {night}, rules, {.max_edge_m = 20});
  ASSERT_EQ(solved.area.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto power = powers(solved, [&](std::size_t patch) { return patch == i; });
    const double truth = scene.luminaires.flux() / 2;
    const Verdict verdict = expect_mean(power, truth, 1e-3 * truth);
    EXPECT_TRUE(verdict) << verdict.text;
  }
}

// Beside the axis, with a bright middle on a faint rest, and up and down at once.
TEST(Luminaires, BrightLobesBringTheirFlux) {
  std::vector<double> planes, gammas, beside, both;
  for (int C = 0; C <= 360; C += 5) planes.push_back(C);
  for (int gamma = 0; gamma <= 180; ++gamma) gammas.push_back(gamma);
  const auto lobe = [](double degrees) { return 1e3 * std::exp(-degrees * degrees / 4) + 0.1; };
  for (const double C : planes)
    for (const double gamma : gammas) {
      const double g = gamma * radians_per_degree, c = (C - 40) * radians_per_degree;
      const double cosine = std::cos(g) * std::cos(0.5) + std::sin(g) * std::sin(0.5) * std::cos(c);
      beside.push_back(lobe(std::acos(std::min(1.0, cosine)) / radians_per_degree));
      both.push_back(lobe(gamma) + lobe(180 - gamma));
    }
  for (const auto& intensities : {beside, both}) {
    Scene scene = inward_sphere(1, {{"black", 0, 0, 0}}, [](Vec3 /*everywhere*/) { return 0; });
    add_luminaire(scene, {0.2, -0.1, 0.3});
    scene.luminaires.webs = {{planes, gammas, intensities}};
    const double truth = scene.luminaires.flux();
    SolverRules rules = lamp_rules(0);
    rules.direct_samples = 16 * 64;
    const auto solved = solve(scene, {night}, rules, {.max_edge_m = 10});
    const auto all = powers(solved, [](std::size_t) { return true; });
    const Verdict verdict = expect_mean(all, truth, 1e-3 * truth);
    EXPECT_TRUE(verdict) << verdict.text;
    EXPECT_FALSE(expect_mean(all, 1.3 * truth, 1e-3 * truth)) << verdict.text;
  }
}

// Plane C 0 along +x, C 90 along +y; turned with the luminaire, tilted with its axis.
TEST(Luminaires, SendWhereTheirPlanesLook) {
  const IntensityWeb web{{0, 90, 180, 270, 360}, {0, 180}, {1, 1, 2, 2, 3, 3, 4, 4, 1, 1}};
  const auto seen = [&](const Luminaire& luminaire, Vec3 direction) {
    const Luminaires all{{web}, {luminaire}};
    return all.intensity(luminaire, normalized(direction));
  };
  const Luminaire level({0, 0, 0}, {0, 0, -1}, 0);
  EXPECT_NEAR(seen(level, {1, 0, -1}), 1, 1e-12);
  EXPECT_NEAR(seen(level, {0, 1, -1}), 2, 1e-12);
  EXPECT_NEAR(seen(level, {-1, 0, 1}), 3, 1e-12);
  EXPECT_NEAR(seen(level, {0, -1, -1}), 4, 1e-12);
  EXPECT_NEAR(seen(level, {1, 1, 0}), 1.5, 1e-12);
  const Luminaire turned({0, 0, 0}, {0, 0, -1}, pi / 2);
  EXPECT_NEAR(seen(turned, {0, 1, -1}), 1, 1e-12);
  EXPECT_NEAR(seen(turned, {-1, 0, -1}), 2, 1e-12);
  // Looking along +x: what looked along +x looks up.
  const Luminaire tilted({0, 0, 0}, {1, 0, 0}, 0);
  EXPECT_NEAR(seen(tilted, {1, 0, 1}), 1, 1e-12);
  EXPECT_NEAR(seen(tilted, {1, 1, 0}), 2, 1e-12);
  const Luminaire up({0, 0, 0}, {0, 0, 1}, 0);
  EXPECT_NEAR(seen(up, {1, 0, 1}), 1, 1e-12);
  EXPECT_NEAR(seen(up, {0, -1, 1}), 2, 1e-12);
}

// A sphere of reflectance ρ receives 4π I / (1 - ρ) in all, by whatever transport.
TEST(Luminaires, FillASphere) {
  const double rho = 0.6;
  for (const Transport transport : {Transport::gather, Transport::shoot, Transport::matrix}) {
    Scene scene = inward_sphere(1, {{"wall", rho, 0, 0}}, [](Vec3 /*everywhere*/) { return 0; });
    add_luminaire(scene, {0.2, -0.1, 0.3});
    SolverRules rules = lamp_rules(60);
    rules.transport = transport;
    const auto solved = solve(scene, {night}, rules, {.max_edge_m = 10});
    const double truth = 4 * pi * intensity / (1 - rho);
    const auto all = powers(solved, [](std::size_t) { return true; });
    const Verdict verdict = expect_mean(all, truth, 2e-5 * truth);
    EXPECT_TRUE(verdict) << verdict.text;
    EXPECT_FALSE(expect_mean(all, truth * (1 - 0.01 * rho), 2e-5 * truth));
    const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
    EXPECT_TRUE(expect_mean(residual, 0, 2e-5 * truth));
  }
}

// A mirror shows the lamp behind it: the ceiling has the light of that image through the mirror.
TEST(Luminaires, AreSentOnByMirrors) {
  const double mirror = 0.7;
  SceneBuilder builder = floor_of({"mirror", 0, mirror, 0});
  const int black = builder.material({"black", 0, 0, 0});
  builder.object("ceiling").quad({-30, -30, 3}, {-30, 30, 3}, {30, 30, 3}, {30, -30, 3}, black);
  Scene scene = builder.scene();
  const Vec3 at{0, 0, 2};
  add_luminaire(scene, at, 160);
  const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 3});
  const auto ceiling =
      powers(solved, [&](std::size_t i) { return solved.patches[i].triangle > 1; });
  const double truth = mirror * intensity * solid_angle_below(at, 5, 3);
  const Verdict verdict = expect_mean(ceiling, truth, 1e-4 * truth);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(ceiling, 1.03 * truth, 1e-4 * truth));
}

// All rays of a sensor to a luminaire are one: it brings what a screen lets pass, not all or
// nothing.
TEST(Luminaires, ShineOnSensorsThroughAScreen) {
  SceneBuilder builder;
  Material veil{"veil"};
  veil.transmittance = 0.4;
  const int screen = builder.material(veil);
  builder.sides(Sides::two);
  builder.quad({-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}, screen);
  Scene scene = builder.scene();
  add_luminaire(scene, {0, 0, 4});
  scene.sensors = {sensor_at({0.2, 0.1, 1}, {0, 0, 1}), sensor_at({3, 0, 1}, {0, 0, 1}),
                   sensor_at({0.2, 0.1, 3}, {0, 0, 1})};
  const auto solved = solve(scene, {night}, lamp_rules(0));
  for (std::size_t s = 0; s < scene.sensors.size(); ++s) {
    const Vec3 way = Vec3{0, 0, 4} - scene.sensors[s].position;
    const double open = intensity * way.z / std::pow(norm(way), 3);
    const double truth = (s == 0 ? 0.4 : 1) * open;
    EXPECT_NEAR(static_cast<double>(solved.tally.sensors.irradiance[lamps][s]), truth, 1e-5 * open);
  }
}

// From the image behind a mirror wall, seen through its triangles' common edge, too; a plate
// before the mirror takes it, and so does one between mirror and lamp.
TEST(Luminaires, ShineOnSensorsByAMirror) {
  constexpr double rho = 0.7;
  const Vec3 lamp{3, 0, 2};
  for (const int hidden : {0, 1, 2}) {
    SceneBuilder builder;
    const int mirror = builder.material({"mirror", 0, rho, 0}), black = builder.material({"black"});
    builder.object("wall").quad({0, -2, 0}, {0, 2, 0}, {0, 2, 4}, {0, -2, 4}, mirror);
    builder.sides(Sides::two);
    if (hidden == 1)
      builder.object("plate").quad({2, -1, 1}, {2, 1, 1}, {2, 1, 1.3}, {2, -1, 1.3}, black);
    if (hidden == 2)
      builder.object("plate").quad({0.5, -1, 1}, {0.5, 1, 1}, {0.5, 1, 2.2}, {0.5, -1, 2.2}, black);
    Scene scene = builder.scene();
    add_luminaire(scene, lamp);
    scene.sensors = {sensor_at({3, 0, 1}, {-1, 0, 0}), sensor_at({1, 0, 2}, {-1, 0, 0}),
                     sensor_at({3, 9, 2}, {-1, 0, 0}), sensor_at({-1, 0, 2}, {1, 0, 0})};
    const auto solved = solve(scene, {night}, lamp_rules(0));
    for (std::size_t s = 0; s < scene.sensors.size(); ++s) {
      const Vec3 way = Vec3{-lamp.x, lamp.y, lamp.z} - scene.sensors[s].position;
      const double image = rho * intensity * -way.x / std::pow(norm(way), 3);
      const bool is_seen = s == 0 ? hidden == 0 : s == 1 && hidden != 2;
      const double truth = is_seen ? image : 0;
      EXPECT_NEAR(static_cast<double>(solved.tally.sensors.irradiance[lamps][s]), truth,
                  1e-5 * std::abs(image))
          << hidden << ' ' << s;
    }
  }
}

}  // namespace
}  // namespace sunload::test
