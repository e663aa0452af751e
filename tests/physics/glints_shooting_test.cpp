// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sun by way of several mirrors: image directions and shooting are two estimates of the
/// same, in streets of glass and in curved glass.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "geo/mesh/mesh_prepare.h"
#include "io/scene/builtin.h"
#include "solver/base/threads.h"
#include "solver/surface/fresnel.h"
#include "tests/support/glints.h"

namespace sunload::test {
namespace {

TEST(Street, ImagesAndShootingAgree) {
  const TwoMirrorStreet street;
  const Scene scene = street.scene(0.85, 0.7);
  const auto power = [&](By by, int depth) {
    const auto solved = solve_sun(scene, street.sun, glint_rules(by, depth), 0.5);
    check_ledger(by == By::images ? "images" : "shooting", solved);
    return solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; });
  };
  for (const int depth : {1, 2, 3}) {
    const auto seen = power(By::images, depth), shot = power(By::shooting, depth);
    const double rounding = float_rounding * dni;
    std::vector<double> difference, faulty;
    for (std::size_t r = 0; r < seen.size(); ++r) {
      difference.push_back(seen[r] - shot[r]);
      // Planted fault: the shot light without 2 % of the glint.
      faulty.push_back(difference[r] + 0.02 * dni * 0.85 * 0.7 * street.sun.z * 3 / 200);
    }
    const Verdict same = expect_mean(difference, 0, rounding * 0.01);
    std::cout << "depth " << depth << ": " << same.text << "\n";
    EXPECT_TRUE(same) << depth << ": " << same.text;
    EXPECT_FALSE(expect_mean(faulty, 0, rounding * 0.01)) << depth;
  }
}

// All that the window sends meets the wall, and all that the wall sends the ground.
TEST(Street, PanesReflectWhatMirrorsSendAtItsAngle) {
  const TwoMirrorStreet street;
  constexpr double of_window = 0.85, index = 1.52;
  Scene scene = street.scene(of_window, 0);
  scene.materials.back().smooth = Panes{.refractive_index = index, .count = 1};  // the wall
  const auto shot = solve_sun(scene, street.sun, glint_rules(By::shooting, 3), 2);
  EXPECT_GT(shot.work[Work::mirror_shots], 0u);
  double power = 0;
  for (std::size_t i = 0; i < shot.area.size(); ++i)
    if (shot.patches[i].triangle < 2)
      power += shot.area[i] * static_cast<double>(by_mirrors(shot, i));
  const double window_m2 =
      (TwoMirrorStreet::y1 - TwoMirrorStreet::y0) * (TwoMirrorStreet::z1 - TwoMirrorStreet::z0);
  const double sent = dni * street.sun.x * window_m2 * of_window;
  const auto reflected = [&](double cosine) {
    return sent * pane_shares({index, 0, 1}, cosine).reflected;
  };
  const double truth = reflected(street.sun.x);
  EXPECT_NEAR(power, truth, float_rounding * sent);
  // Planted fault: as if from the normal.
  EXPECT_GT(std::abs(power - reflected(1)), 100 * float_rounding * sent);
}

/// The built-in street with its glass house, and all windows of the other houses of glass as well.
Scene shot_street() {
  Scene scene;
  scene.mesh = prepare(builtin_scene({"street", {{"house_3", "glazed"}}}), {}).mesh;
  for (const auto& m : scene.mesh.file_materials) {
    const bool glass = m.name == "glass" || m.name == "window";
    scene.materials.push_back({m.name, m.diffuse.value_or(0.2), glass ? 0.85 : 0, 0});
  }
  scene.material = scene.mesh.triangle_material;
  return scene;
}

TEST(Street, OfGlassOnBothSidesKeepsItsEnergy) {
  const Scene scene = shot_street();
  const Vec3 sun = normalized({0.25, -0.8, 0.35});
  auto rules = glint_rules(By::images, 8);
  rules.direct_samples = 32 * 2;
  rules.faint_glint = SolverRules{}.faint_glint;
  const auto seen = solve_sun(scene, sun, rules, 4);
  check_ledger("street", seen);
  std::cout << seen.work[Work::mirror_beams] << " beams, " << seen.work[Work::mirror_shots]
            << " arrivals\n";
  EXPECT_EQ(seen.work[Work::mirror_shots], 0u);
  rules.most_sun_beams = 0;
  const auto shot = solve_sun(scene, sun, rules, 4);
  check_ledger("street by shooting", shot);
  rules.mirror_depth = 1;
  const auto once = solve_sun(scene, sun, rules, 4);
  const auto anywhere = [](std::size_t) { return true; };
  const auto a = seen.means(anywhere), b = shot.means(anywhere), c = once.means(anywhere);
  std::vector<double> difference, faulty;
  for (std::size_t r = 0; r < a.size(); ++r) {
    difference.push_back(a[r] - b[r]);
    faulty.push_back(a[r] - c[r]);  // planted fault: one reflection only
  }
  const double rounding = float_rounding * mean_error(a).mean;
  const Verdict same = expect_mean(difference, 0, rounding);
  std::cout << same.text << "; more than one reflection " << expect_mean(faulty, 0).text << "\n";
  EXPECT_TRUE(same) << same.text;
  EXPECT_FALSE(expect_mean(faulty, 0, rounding));
}

/// Part of a mirror cylinder of many facets beside a floor, facing the sun.
Scene curved_glass(int facets, double rho) {
  SceneBuilder b;
  const int black = b.material({"black", 0, 0, 0}), glass = b.material({"glass", 0.1, rho, 0});
  b.quad({-6, 0.5, 0}, {6, 0.5, 0}, {6, 12, 0}, {-6, 12, 0}, black);
  // Concave: a half circle of radius 3 about (0, 3, z), opening to +y.
  const auto at = [&](int f, double z) {
    const double a = pi + pi * f / facets;
    return Vec3{3 * std::cos(a), 4 + 3 * std::sin(a), z};
  };
  for (int f = 0; f < facets; ++f) b.quad(at(f + 1, 1), at(f, 1), at(f, 3), at(f + 1, 3), glass);
  return b.scene();
}

TEST(CurvedGlass, IsShotAndAgreesWithItsImages) {
  const Scene scene = curved_glass(160, 0.8);
  const Vec3 sun = normalized({0.1, 0.7, 0.5});
  auto rules = glint_rules(By::images, 2);
  rules.most_sun_beams = 128;
  const auto shot = solve_sun(scene, sun, rules, 1);
  EXPECT_EQ(shot.work[Work::mirror_beams], 0u);  // more orientations face the sun
  EXPECT_GT(shot.work[Work::mirror_shots], 0u);
  rules.most_sun_beams = 100'000;
  const auto seen = solve_sun(scene, sun, rules, 1);
  EXPECT_EQ(seen.work[Work::mirror_shots], 0u);
  std::cout << seen.work[Work::mirror_beams] << " beams, " << shot.work[Work::mirror_shots]
            << " arrivals\n";
  check_ledger("images", seen);
  check_ledger("shooting", shot);
  const auto on_ground = [&](std::size_t i) { return seen.patches[i].triangle < 2; };
  const auto a = seen.means(on_ground), b = shot.means(on_ground);
  std::vector<double> difference, faulty;
  for (std::size_t r = 0; r < a.size(); ++r) {
    difference.push_back(a[r] - b[r]);
    faulty.push_back(a[r] - b[r] + 0.02 * (b[r] - dni * sun.z));  // planted: 2 % of the light lost
  }
  const Verdict same = expect_mean(difference, 0, float_rounding * a[0]);
  std::cout << same.text << "\n";
  EXPECT_TRUE(same) << same.text;
  EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * a[0]));
}

TEST(CurvedGlass, SameBitsForAnyNumberOfThreads) {
  const Scene scene = curved_glass(40, 0.8);
  const Vec3 sun = normalized({0.1, 0.7, 0.5});
  const int before = thread_count();
  for (const int beams : {0, 20, 128}) {
    std::vector<BatchTally> tallies;
    for (const int threads : {1, 2, 3}) {
      set_thread_count(threads);
      auto rules = glint_rules(By::images, 3);
      rules.most_sun_beams = beams;
      rules.direct_samples = 32 * 4;
      tallies.push_back(solve_sun(scene, sun, rules, 1).tally);
    }
    for (const auto& other : tallies) {
      EXPECT_EQ(other.irradiance, tallies[0].irradiance);
      EXPECT_EQ(other.exposure_realization, tallies[0].exposure_realization);
      for (std::size_t r = 0; r < other.ledger_realization.size(); ++r)
        EXPECT_EQ(other.ledger_realization[r].terms, tallies[0].ledger_realization[r].terms);
    }
  }
  set_thread_count(before);
}

}  // namespace
}  // namespace sunload::test
