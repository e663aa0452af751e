// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The five Global Illumination Test Scenes after Smits & Jensen (2000), and
/// where the historic oracle fails on them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "solver/base/sampling.h"
#include "tests/support/statistics.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

constexpr double hour_s = 3600;

std::string solver_of(int lines, int realizations = 16, int bounces = 0) {
  return "solver: {lines_per_patch: " + std::to_string(lines) +
         ", direct_samples: " + std::to_string(realizations) +
         ", realizations: " + std::to_string(realizations) +
         ", bounces: " + std::to_string(bounces) + "}\n";
}

/// Irradiance at a point by all emitters without reflections, from `side`² points of every emitter
/// triangle.
double brute_force(const Scene& scene, const RayCaster& caster, Vec3 x, Vec3 n, int side) {
  double E = 0;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const double exitance = scene.materials[scene.material[t].index()].emission_w_m2;
    if (exitance <= 0) continue;
    const Vec3 area2 = scene.mesh.area_vector2(t), front = normalized(area2);
    const double share = norm(area2) / 2 / (side * side);
    for (int s = 0; s < side * side; ++s) {
      const Barycentric at = sample_triangle((s % side + 0.5) / side, (s / side + 0.5) / side);
      const Vec3 y = scene.mesh.corner(t, 0) * at.w0 + scene.mesh.corner(t, 1) * at.w1 +
                     scene.mesh.corner(t, 2) * at.w2;
      const Vec3 to = y - x;
      const double r2 = dot(to, to), kernel = dot(n, to) * -dot(front, to) / (pi * r2 * r2);
      if (dot(n, to) <= 0 || dot(front, to) >= 0) continue;
      const Hit hit = caster.first_hit(x + n * caster.offset_m(), to);
      if (hit.triangle == static_cast<std::int32_t>(t)) E += exitance * kernel * share;
    }
  }
  return E;
}

/// Irradiance at a point of a mesh of constant patches [W m-2].
struct SceneSeen {
  double value = -1, error = 0, area_m2 = 0;
};

/// What a mesh says at (x, y) of the horizontal plane `object`.
SceneSeen seen_at(const SolvedPlan& s, const std::string& object, double x, double y) {
  for (std::size_t i = 0; i < s.mesh().patch_count(); ++i) {
    if (s.object(i) != object || s.mesh().normal(i).z < 0.5) continue;
    const Vec3 a = s.mesh().corner(i, 0), b = s.mesh().corner(i, 1), c = s.mesh().corner(i, 2);
    const auto left_of = [&](Vec3 p, Vec3 q) {
      return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) >= 0;
    };
    if (!left_of(a, b) || !left_of(b, c) || !left_of(c, a)) continue;
    const MeanError m = mean_error(s.load(i));
    return {m.mean / hour_s, m.standard_error / hour_s, s.mesh().area()[i]};
  }
  return {};
}

TEST(LightScenes, EmissionIsSymmetricAndTilingChangesNothing) {
  // Pairs of points on the plane that are mirror images about x = 0; a mesh of bisected triangles
  // is not its own mirror image.
  constexpr double distance = 4;
  const std::vector<std::pair<double, double>> from_foot{{0, 0},     {0.9, 0.4},  {2.1, -1.2},
                                                         {0.3, 3.2}, {-2.5, 0.7}, {5, 4}};
  std::string points;
  for (const double side : {-1.0, 1.0})
    for (const auto& [x, y] : from_foot)
      points += (points.empty() ? "" : ", ") + std::string("{position_m: [") +
                std::to_string(side * (distance + x)) + ", " + std::to_string(y) +
                ", 0], normal: [0, 0, 1]}";
  const SolvedPlan s = solve_study(night_study(
      "emission", "mesh: {oracle: none}\nsensors: {points: [" + points + "]}\n" + solver_of(4096)));
  for (std::size_t p = 0; p < from_foot.size(); ++p) {
    std::vector<double> difference, shifted;
    for (const auto& load : s.tally.sensors.exposure_realization) {
      difference.push_back(load[p + from_foot.size()] - load[p]);
      shifted.push_back(1.05 * load[p + from_foot.size()] - load[p]);
    }
    EXPECT_TRUE(expect_mean(difference, 0)) << p << ": " << expect_mean(difference, 0).text;
    EXPECT_FALSE(expect_mean(shifted, 0)) << p << ": planted fault: one lamp sends 5 % more";
  }
}

/// Largest error of a mesh at points of the plane, as share of the largest irradiance there.
double worst_error(const SolvedPlan& s, const std::vector<Vec3>& points, int side) {
  const Scene& scene = s.plan.built.scene;
  const RayCaster caster(scene.mesh);
  double worst = 0, largest = 0;
  for (const auto& p : points) {
    const double truth = brute_force(scene, caster, p, {0, 0, 1}, side);
    largest = std::max(largest, truth);
    const SceneSeen seen = seen_at(s, "plane", p.x, p.y);
    // Constant light on leaves is a model error of its own: what lies about the point counts.
    worst = std::max(worst, std::abs(seen.value - truth) - 4 * seen.error);
  }
  return worst / largest;
}

std::vector<Vec3> across_the_bars() {
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i)
    for (const double x : {-5.03, 0.04, 5.02}) points.push_back({x, -6.5 + 13.0 * i / 39, 0});
  return points;
}

TEST(LightScenes, ShadowsAreRightAtChangingDistance) {
  const std::string common = solver_of(256);
  const SolvedPlan s = solve_study(
      night_study("shadow", "mesh: {light_tolerance: 0.03, min_area_m2: 0.004}\n" + common));
  const double error = worst_error(s, across_the_bars(), 24);
  const SolvedPlan historic =
      solve_study(night_study("shadow", "mesh: {oracle: historic}\n" + common));
  const double historic_error = worst_error(historic, across_the_bars(), 24);
  std::cout << "shadow: " << s.made.report.patches_before << " -> " << s.mesh().patch_count()
            << " patches, worst error " << error << "; historic oracle "
            << historic.mesh().patch_count() << " patches, " << historic_error << "\n";
  // A leaf across a penumbra has the mean of it: worst at the foot of the bars, where it is narrow.
  EXPECT_LE(error, 0.25);
  EXPECT_GT(historic_error, 0.5) << "the historic oracle loses the shadows";
}

TEST(LightScenes, LargeExtentHasACleanShadowBorder) {
  // The large emitter (side 20 at 60 m) is hidden by its shield (30 m) within |x|, |y| < 10; so is
  // the small pair's light within 1 m.
  const std::string mesh = "mesh: {max_edge_m: 4, min_area_m2: 0.5, light_tolerance: 0.02}\n";
  const SolvedPlan s = solve_study(night_study("large_extent", mesh + solver_of(256)));
  const SolvedPlan coarse =
      solve_study(night_study("large_extent", "mesh: {oracle: historic}\n" + solver_of(256)));
  const Scene& scene = s.plan.built.scene;
  const RayCaster caster(scene.mesh);
  const double leaf = 2 * std::sqrt(0.5);  // longest edge of a leaf of the least area
  // In the large emitter's umbra only the small one shines; within a leaf its light varies.
  const auto most_by_small = [&](double x, double y) {
    double most = 0;
    for (const double dx : {-leaf, 0.0, leaf})
      for (const double dy : {-leaf, 0.0, leaf})
        most = std::max(most, brute_force(scene, caster, {x + dx, y + dy, 0}, {0, 0, 1}, 8));
    return most;
  };
  double worst_leak = 0, historic_leak = 0;
  for (double x = 0; x < 10 - 2 * leaf; x += 1.1)
    for (double y = 0; y < 10 - 2 * leaf; y += 1.1) {
      const double limit = most_by_small(x, y);
      const SceneSeen fine = seen_at(s, "plane", x + 0.01, y + 0.013);
      worst_leak = std::max(worst_leak, fine.value - 4 * fine.error - limit);
      historic_leak =
          std::max(historic_leak, seen_at(coarse, "plane", x + 0.01, y + 0.013).value - limit);
    }
  std::cout << "large extent: " << s.mesh().patch_count() << " patches, light beyond the small "
            << "emitter's in the umbra " << worst_leak << " W/m2; historic oracle "
            << coarse.mesh().patch_count() << " patches, " << historic_leak << " W/m2\n";
  EXPECT_LE(worst_leak, 0);
  EXPECT_GT(historic_leak, 0.01) << "light leaks into the historic system's shadow";
}

TEST(LightScenes, ComplexPathsReachTheCubeWithLittleNoise) {
  // emitter → tray → wall → screen → cube: a share of 1e-7 of the light, seen by every leaf.
  const SolvedPlan s = solve_study(night_study(
      "complex_paths",
      "mesh: {oracle: none, max_edge_m: 1}\nsolver: {lines_per_patch: 16384, direct_samples: 16, "
      "realizations: 16, bounces: 8, unshot: 0}\n"));
  double worst_leaf = 0;
  std::vector<double> cube(s.tally.exposure_realization.size(), 0), edge = cube;
  for (std::size_t i = 0; i < s.mesh().patch_count(); ++i) {
    const Vec3 p = s.mesh().centroid(i);
    const bool on_cube = s.object(i) == "cube";
    const bool on_edge = s.object(i) == "plane" && s.mesh().normal(i).z > 0.5 &&
                         std::max(std::abs(p.x), std::abs(p.y)) > 4;
    if (!on_cube && !on_edge) continue;
    const auto load = s.load(i);
    const MeanError m = mean_error(load);
    if (m.mean > 0) worst_leaf = std::max(worst_leaf, m.standard_error / m.mean);
    for (std::size_t r = 0; r < load.size(); ++r)
      (on_cube ? cube : edge)[r] += s.mesh().area()[i] * load[r];
  }
  for (const auto& [name, energy] :
       {std::pair{"cube", mean_error(cube)}, {"edge", mean_error(edge)}}) {
    std::cout << "complex paths: " << name << " " << energy.mean << " J, relative standard error "
              << energy.standard_error / energy.mean << "\n";
    EXPECT_GT(energy.mean, 0) << "light arrives after three diffuse reflections";
    EXPECT_LE(energy.standard_error, 0.03 * energy.mean);
  }
  std::cout << "complex paths: worst leaf " << worst_leaf << "\n";
  EXPECT_GT(worst_leaf, 0);
  EXPECT_LE(worst_leaf, 0.03);
}

TEST(LightScenes, GeometricAccuracyLeaksNothing) {
  const SolvedPlan s = solve_study(
      night_study("geometric_accuracy",
                  "mesh: {light_tolerance: 0.05, min_area_m2: 0.002}\n" + solver_of(256)));
  const Scene& scene = s.plan.built.scene;
  const RayCaster caster(scene.mesh);
  // Under the sunk cube (side 2 about (-4, 0)) the plane is cut out.
  double shaded_wedge = 0;
  std::size_t base = 0, wedge = 0;
  for (std::size_t i = 0; i < s.mesh().patch_count(); ++i) {
    const auto corners_hold = [&](const auto& condition) {
      return condition(s.mesh().corner(i, 0)) && condition(s.mesh().corner(i, 1)) &&
             condition(s.mesh().corner(i, 2));
    };
    if (s.object(i) == "plane" &&
        corners_hold([](Vec3 p) { return std::abs(p.x + 4) <= 1 && std::abs(p.y) <= 1; }))
      ++base;
    // The emitter at (-4, -4, 9) is seen by all of the wedge's western side.
    if (s.object(i) == "wedge" && s.mesh().normal(i).x < -0.5) {
      ++wedge;
      const double open = brute_force(scene, caster, s.mesh().centroid(i), s.mesh().normal(i), 8);
      const MeanError m = mean_error(s.load(i));
      shaded_wedge = std::max(shaded_wedge, 1 - (m.mean + 4 * m.standard_error) / hour_s / open);
    }
  }
  std::cout << "geometric accuracy: " << s.mesh().patch_count() << " patches; largest shadow on "
            << wedge << " leaves of the wedge's lit side " << shaded_wedge << "\n";
  EXPECT_EQ(base, 0u);
  EXPECT_GT(wedge, 0u);
  EXPECT_LE(shaded_wedge, 0.02);  // the centroid stands for a leaf of up to a metre
}

}  // namespace
}  // namespace sunload::test
