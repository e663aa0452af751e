// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Cases with a known answer: cavity, two surfaces, tilted plane, sun, canyon, furnace.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

/// Every statistical case: accepted, and precise enough to mean something.
void expect_accepted(const std::vector<double>& realizations, double truth, double bias = 0) {
  const Verdict verdict = expect_mean(realizations, truth, bias);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_LE(verdict.standard_error, 0.01 * std::abs(truth)) << "standard error below 1 %";
}

/// The planted fault must be found.
void expect_refused(const std::vector<double>& realizations, double wrong, double bias = 0) {
  const Verdict verdict = expect_mean(realizations, wrong, bias);
  EXPECT_FALSE(verdict) << "a planted fault went unnoticed: " << verdict.text;
}

// E after n bounces in a closed cavity of uniform M and rho: M Σ_{b=0..n} rho^b.
TEST(ClosedCavity, IrradianceIsTheTruncatedSeries) {
  constexpr double rho = 0.6, M = 100;
  SceneBuilder builder;
  builder.box({0, 0, 0}, {4, 3, 2}, builder.material({"wall", rho, 0, M}), Facing::inward);
  auto rules = test_rules();
  rules.bounces = 6;
  const auto solved = solve(builder.scene(), {one_second({0, 0, -1}, 0)}, rules, {.max_edge_m = 1});
  double truth = 0;
  for (int b = 0; b <= rules.bounces; ++b) truth += M * std::pow(rho, b);
  expect_accepted(solved.means(everywhere), truth);
  expect_refused(solved.means(everywhere), truth * (1 - std::pow(rho, rules.bounces)));
  EXPECT_NEAR(truth, M / (1 - rho), M * std::pow(rho, rules.bounces + 1) / (1 - rho) * 1.001);
}

// In a sphere F_ij = A_j / A from everywhere: E = (f1 M1 + f2 M2) / (1 - f1 rho1 - f2 rho2).
TEST(SphereOfTwoSurfaces, IrradianceIsUniformAndExact) {
  const Material lamp{"lamp", 0.2, 0, 50}, wall{"wall", 0.7, 0, 0};
  const auto lower = [](Vec3 p) { return p.z < -0.3 ? 0 : 1; };
  const auto mean_of = [&](int subdivisions, double& truth) {
    const Scene scene = inward_sphere(subdivisions, {lamp, wall}, lower);
    auto rules = test_rules();
    rules.bounces = 40;
    const auto solved = solve(scene, {one_second({0, 0, -1}, 0)}, rules);
    double area[2] = {0, 0};
    for (std::size_t i = 0; i < solved.area.size(); ++i)
      area[scene.material[static_cast<std::size_t>(solved.patches[i].triangle)].index()] +=
          solved.area[i];
    const double f1 = area[0] / (area[0] + area[1]), f2 = 1 - f1;
    truth = f1 * lamp.emission_w_m2 / (1 - f1 * lamp.diffuse - f2 * wall.diffuse);
    return solved.means(everywhere);
  };
  double coarse_truth = 0, truth = 0;
  const auto coarse = mean_of(2, coarse_truth);
  const auto fine = mean_of(3, truth);
  // Facets are chords: the bias falls with the square of their size, so that it
  // is at most what one halving changed.
  const double bias =
      std::abs(mean_error(coarse).mean / coarse_truth - mean_error(fine).mean / truth) * truth;
  expect_accepted(fine, truth, bias);
  expect_refused(fine, truth * 0.97, bias);
}

// E = pi L (1 + cos β) / 2 + rho_g GHI (1 - cos β) / 2 (Liu & Jordan 1963).
TEST(TiltedPlane, UniformSkyAndFarGround) {
  constexpr double dhi = 120, albedo = 0.3;
  for (const double tilt_deg : {0.0, 30.0, 60.0, 90.0, 135.0}) {
    const double b = radians(tilt_deg);
    SceneBuilder builder;
    const Vec3 up_slope{0, std::cos(b), std::sin(b)};
    builder.quad({0, 0, 0}, {1, 0, 0}, Vec3{1, 0, 0} + up_slope, up_slope,
                 builder.material({"black", 0, 0, 0}));
    auto light = with_uniform_sky(one_second({0, 0, -1}, 0), dhi);
    light.ground_exitance = albedo * dhi;
    const auto solved = solve(builder.scene(), {light}, test_rules());
    const double truth = dhi * (1 + std::cos(b)) / 2 + albedo * dhi * (1 - std::cos(b)) / 2;
    expect_accepted(solved.means(everywhere), truth);
    if (tilt_deg > 0) expect_refused(solved.means(everywhere), dhi * (1 + std::cos(b)) / 2 * 0.98);
  }
}

TEST(UnshadedSun, IsTheCosine) {
  const Vec3 sun = normalized({0.3, -0.5, 0.4});
  SceneBuilder builder;
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, builder.material({"m", 0.3, 0, 0}));
  const auto solved = solve(builder.scene(), {one_second(sun, 800)}, test_rules());
  expect_accepted(solved.means(everywhere), 800 * sun.z);
  expect_refused(solved.means(everywhere), 800);
  EXPECT_DOUBLE_EQ(solved.tally.sunlit_s[0], 1);
}

// Hottel's crossed strings: floor to sky of an infinite canyon of height H and
// width W is sqrt(1 + (H/W)^2) - H/W; wall to sky half of what the floor leaves.
TEST(InfiniteCanyon, ViewFactorsOfFloorAndWalls) {
  constexpr double W = 1, H = 1.5, L = 400;
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.object("floor").quad({0, -L, 0}, {W, -L, 0}, {W, L, 0}, {0, L, 0}, black);
  builder.object("west").quad({0, -L, 0}, {0, L, 0}, {0, L, H}, {0, -L, H}, black);
  builder.object("east").quad({W, -L, 0}, {W, -L, H}, {W, L, H}, {W, L, 0}, black);
  // Only a short piece in the middle is looked at; the rest stands for infinity.
  constexpr double piece = 10;
  const int measured = builder.material({"measured", 0, 0, 0});
  builder.object("floor_piece")
      .quad({0, -piece, 1e-3}, {W, -piece, 1e-3}, {W, piece, 1e-3}, {0, piece, 1e-3}, measured);
  builder.object("wall_piece")
      .quad({1e-3, -piece, 0}, {1e-3, piece, 0}, {1e-3, piece, H}, {1e-3, -piece, H}, measured);
  const auto light = with_uniform_sky(one_second({0, 0, -1}, 0), pi);
  auto rules = test_rules();
  rules.lines_per_patch = 16 * 1024;  // few patches: a standard error far below 1 %
  const auto solved = solve(builder.scene(), {light}, rules);
  const auto of = [&](std::int32_t first_triangle) {
    return solved.means([&, first_triangle](std::size_t i) {
      const auto t = solved.patches[i].triangle;
      return t == first_triangle || t == first_triangle + 1;
    });
  };
  const double h = H / W, floor_sky = std::sqrt(1 + h * h) - h;
  const double wall_sky = (1 + h - std::sqrt(1 + h * h)) / (2 * h);
  // Beyond the ends lies open sky at elevations below H/(L - piece): the share of
  // the hemisphere is less than that angle. The pieces stand 1 mm off the faces.
  const double bias = (H / (L - piece) + 2e-3) * pi;
  expect_accepted(of(6), floor_sky * pi, bias);
  expect_accepted(of(8), wall_sky * pi, bias);
  expect_refused(of(6), (1 - h / 2) * pi, bias);
}

// In a uniformly bright world a white body changes nothing: E = pi L everywhere,
// less what is not followed after the last bounce.
TEST(WhiteFurnace, EverySurfaceReceivesTheSame) {
  SceneBuilder builder;
  const int white = builder.material({"white", 1, 0, 0});
  builder.box({0, 0, 0}, {4, 1, 1}, white, Facing::outward);
  builder.object("tower").box({0, 0, 1.5}, {1, 1, 4}, white, Facing::outward);
  auto light = with_uniform_sky(one_second({0, 0, -1}, 0), pi);
  light.ground_exitance = pi;
  auto rules = test_rules();
  rules.bounces = 30;
  const auto solved = solve(builder.scene(), {light}, rules, {.max_edge_m = 0.5});
  double area = 0;
  for (const double a : solved.area) area += a;
  const double unshot = std::abs(solved.tally.ledger[0][Term::unshot]) / area;
  expect_accepted(solved.means(everywhere), pi, unshot);
  expect_refused(solved.means(everywhere), pi * 0.98, unshot);
}

}  // namespace
}  // namespace sunload::test
