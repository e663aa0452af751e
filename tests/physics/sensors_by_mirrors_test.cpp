// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors in the sun by curved mirrors, for which no beams stand, and by glossy surfaces:
/// against closed forms and against patches of the same place.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/units.h"
#include "geo/sun/sun.h"
#include "solver/base/threads.h"
#include "tests/support/glints.h"
#include "tests/support/quadrature.h"

namespace sunload::test {
namespace {

constexpr double rho = 0.8;

/// A trough along y: part of a circular cylinder of radius R about (0, y, R), open to the sky.
struct Trough {
  static constexpr double R = 10, y0 = -1, y1 = 14;
  static constexpr int facets = 400;
  static double edge() { return radians(20); }
  static double step() { return 2 * edge() / facets; }

  static void add_to(SceneBuilder& b, int material) {
    const auto at = [&](int f, double y) {
      const double a = -edge() + f * step();
      return Vec3{R * std::sin(a), y, R * (1 - std::cos(a))};
    };
    for (int f = 0; f < facets; ++f)
      b.quad(at(f, y0), at(f + 1, y0), at(f + 1, y1), at(f, y1), material);
  }
  /// Where light of a sun with x = 0, reflected at the angle a, is at height h: in the plane of
  /// the circle it is that of a sun in the zenith.
  static double x_of(double a, double h) {
    return R * std::sin(a) - std::tan(2 * a) * (h - R * (1 - std::cos(a)));
  }
};

IntervalLight disk_sun(Vec3 direction) {
  IntervalLight light = one_second(direction, dni);
  light.disk_half_angle = disk_half_angle(SunDisk::finite, 1);
  return light;
}

SolverRules rules_by(Transport transport) {
  SolverRules rules = glint_rules(By::images, 2);
  rules.most_sun_beams = 128;
  rules.transport = transport;
  return rules;
}

/// Mean over sensors, per realization.
std::vector<double> mean_of_sensors(const BatchTally& tally, std::size_t first, std::size_t count) {
  std::vector<double> mean(tally.sensors.exposure_realization.size(), 0);
  for (std::size_t s = first; s < first + count; ++s) {
    const auto E = of_sensor(tally, s);
    for (std::size_t r = 0; r < E.size(); ++r) mean[r] += E[r] / static_cast<double>(count);
  }
  return mean;
}

/// Sensors in a row along x that look down, in the middles of equal parts.
void add_row(Scene& scene, double x0, double x1, double y, double h, int count) {
  for (int s = 0; s < count; ++s)
    scene.sensors.push_back(sensor_at({x0 + (x1 - x0) * (s + 0.5) / count, y, h}, {0, 0, -1}));
}

// Before the focal line and behind it: what a part of the mirror catches lies between the rays
// from that part's edges.
TEST(SensorsByCurvedMirrors, CollectWhatATroughConcentrates) {
  const double a0 = radians(2), a1 = radians(16);
  constexpr double y = 6;
  constexpr int sensors = 512;
  for (const auto transport : {Transport::gather, Transport::shoot})
    for (const double h : {3.0, 8.0}) {
      SceneBuilder b;
      Trough::add_to(b, b.material({"glass", 0, rho, 0}));
      Scene scene = b.scene();
      const double x0 = Trough::x_of(a0, h), x1 = Trough::x_of(a1, h);
      add_row(scene, std::min(x0, x1), std::max(x0, x1), y, h, sensors);
      const auto solved = solve(scene, {disk_sun({0, 0, 1})}, rules_by(transport));
      EXPECT_EQ(solved.work[Work::mirror_beams], 0u);  // more orientations face the sun
      const double truth =
          rho * dni * Trough::R * (std::sin(a1) - std::sin(a0)) / std::abs(x1 - x0);
      // Facets at either end of the part belong to it by some share between 0 and 1.
      const double bias = truth * Trough::step() / (a1 - a0);
      std::cout << solved.work[Work::sensor_rays] << " rays for " << sensors << " sensors\n";
      check_glint("trough, " + std::to_string(h) + " m", mean_of_sensors(solved.tally, 0, sensors),
                  truth, 1.02 * truth, bias);
    }
}

// A patch collects the light that mirrors send it, a row of sensors on it looks for their images.
TEST(SensorsByCurvedMirrors, AgreeWithAPatchOfTheSamePlace) {
  SceneBuilder b;
  const int black = b.material({"black", 0, 0, 0});
  Trough::add_to(b, b.material({"glass", 0, rho, 0}));
  constexpr double h = 8, x0 = 0.2, x1 = 1.4, y0 = -0.5, y1 = 0.5;
  const auto receiver = static_cast<std::int32_t>(b.scene().mesh.triangle_count());
  b.quad({x0, y0, h}, {x0, y1, h}, {x1, y1, h}, {x1, y0, h}, black);
  Scene scene = b.scene();
  constexpr int coarse = 128, fine = 256;
  add_row(scene, x0, x1, 0.1, h, coarse);
  add_row(scene, x0, x1, 0.1, h, fine);
  SolverRules rules = rules_by(Transport::gather);
  rules.direct_samples *= 4;  // little of the light that mirrors send meets the patch
  const auto solved = solve(scene, {disk_sun({0, 0.6, 0.8})}, rules);
  EXPECT_EQ(solved.work[Work::mirror_beams], 0u);
  EXPECT_GT(solved.work[Work::mirror_shots], 0u);
  const auto patch =
      solved.means([&](std::size_t i) { return solved.patches[i].triangle >= receiver; });
  const auto rough = mean_of_sensors(solved.tally, 0, coarse);
  const auto sensors = mean_of_sensors(solved.tally, coarse, fine);
  std::vector<double> difference, faulty;
  for (std::size_t r = 0; r < patch.size(); ++r) {
    difference.push_back(sensors[r] - patch[r]);
    faulty.push_back(0.9 * sensors[r] - patch[r]);  // planted: a tenth of the light lost
  }
  const double E = mean_error(sensors).mean, bias = std::abs(mean_error(rough).mean - E);
  const Verdict same = expect_mean(difference, 0, bias);
  std::cout << "sensors " << E << " W/m2, by half as many off by " << bias
            << ", from the patch: " << same.text << "\n";
  EXPECT_TRUE(same) << same.text;
  EXPECT_FALSE(expect_mean(faulty, 0, bias));
  EXPECT_GT(E, 0.1 * dni);
}

Material satin(double share, double exponent) {
  Material m{"satin"};
  m.glossy = share;
  m.glossy_exponent = exponent;
  return m;
}

/// A trough, a plane mirror and a glossy wall, its lobes narrow and broad, in sight of sensors.
Scene corner_of_all() {
  SceneBuilder b;
  Trough::add_to(b, b.material({"glass", 0, rho, 0}));
  b.quad({4, -4, 0}, {-4, -4, 0}, {-4, -4, 6}, {4, -4, 6}, b.material({"mirror", 0.1, 0.7, 0}));
  b.quad({-5, 2, 0}, {-5, 8, 0}, {-5, 8, 3}, {-5, 2, 3}, b.material(satin(0.6, 20)));
  b.quad({-5, 2, 3}, {-5, 8, 3}, {-5, 8, 6}, {-5, 2, 6}, b.material(satin(0.6, 5)));
  Scene scene = b.scene();
  constexpr int sensors = 200;  // more than one thread takes at once
  for (int s = 0; s < sensors; ++s) {
    const double x = -1.4 + 0.4 * s / sensors;
    scene.sensors.push_back(sensor_at({x, 3, 4}, {-0.1, x, -0.8}));
  }
  return scene;
}

// Where beams stand nothing is added to them: reflections that are looked for without beams bring
// the bits that beams bring.
TEST(SensorsByCurvedMirrors, GetNothingTwice) {
  const Scene scene = corner_of_all();
  const auto light = disk_sun({0.2, 0.3, 0.8});
  SolverRules rules = rules_by(Transport::gather);
  rules.mirror_depth = 1;
  rules.most_sun_beams = 1000;
  const auto by_beams = solve(scene, {light}, rules);
  EXPECT_GT(by_beams.work[Work::mirror_beams], 128u);
  rules.most_sun_beams = 0;
  const auto without = solve(scene, {light}, rules);
  EXPECT_EQ(without.work[Work::mirror_beams], 0u);
  EXPECT_EQ(by_beams.tally.sensors.exposure_realization,
            without.tally.sensors.exposure_realization);
  EXPECT_EQ(by_beams.tally.sensors.irradiance, without.tally.sensors.irradiance);
  const auto mirrored = by_beams.tally.sensors.irradiance[static_cast<std::size_t>(Part::mirror)];
  for (const float E : mirrored) EXPECT_GT(E, 1.0f);
  // Planted: without any reflection followed, nothing comes.
  rules.mirror_depth = 0;
  EXPECT_NE(solve(scene, {light}, rules).tally.sensors.exposure_realization,
            without.tally.sensors.exposure_realization);
}

TEST(SensorsByCurvedMirrors, SameBitsForAnyNumberOfThreads) {
  const Scene scene = corner_of_all();
  const int before = thread_count();
  for (const auto transport : {Transport::gather, Transport::shoot}) {
    SolverRules rules = rules_by(transport);
    rules.errors = Errors::instants;
    std::vector<ReceiverTally> of;
    for (const int threads : {1, 2, 3}) {
      set_thread_count(threads);
      of.push_back(solve(scene, three_suns(), rules).tally.sensors);
    }
    for (const auto& one : of) {
      EXPECT_EQ(one.exposure_realization, of[0].exposure_realization);
      EXPECT_EQ(one.irradiance, of[0].irradiance);
      EXPECT_EQ(one.irradiance_se, of[0].irradiance_se);
    }
  }
  set_thread_count(before);
}

// ---- glossy surfaces -----------------------------------------------------------------------

// All that a wide plate sends up arrives at a sensor's level: dni·cosθ·ρ_g·albedo(θ).
TEST(SensorsByGloss, SunOnAPlate) {
  constexpr double half = 300;
  for (const auto transport : {Transport::gather, Transport::shoot})
    for (const double n : {1.0, 15.0})
      for (const Vec3 w : {Vec3{0.3, 0.1, 0.9}, Vec3{0.8, 0, 0.5}}) {
        SceneBuilder b;
        b.quad({-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0},
               b.material(satin(0.7, n)));
        Scene scene = b.scene();
        scene.sensors.push_back(sensor_at({0, 0, 1}, {0, 0, -1}));
        SolverRules rules = rules_by(transport);
        rules.lines_per_patch = rules.realizations * 2048;
        const auto light = one_second(w, 900);
        const auto solved = solve(scene, {light}, rules);
        const double cos_s = light.direction.z;
        const double truth = 900 * cos_s * 0.7 * lobe_albedo(cos_s, n);
        // Past the plate a share 1/half² of the hemisphere is seen.
        check_glint("plate, n = " + std::to_string(n), of_sensor(solved.tally, 0), truth,
                    1.05 * truth, truth * (n + 2) / (half * half));
      }
}

// A narrow lobe, with the counts of every day: one line in hundreds would meet it.
TEST(SensorsByGloss, NarrowLobesHaveLittleNoise) {
  constexpr double half = 3000, n = 2000;
  SceneBuilder b;
  b.quad({-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0},
         b.material(satin(0.7, n)));
  Scene scene = b.scene();
  scene.sensors.push_back(sensor_at({0, 0, 1}, {0, 0, -1}));
  SolverRules rules = rules_by(Transport::gather);
  rules.lines_per_patch = rules.realizations * 32;
  rules.direct_samples = rules.realizations * 2;
  const auto light = one_second({0.5, 0.1, 0.8}, 900);
  const double truth = 900 * light.direction.z * 0.7 * lobe_albedo(light.direction.z, n);
  expect_truth("narrow lobe", of_sensor(solve(scene, {light}, rules).tally, 0), truth,
               truth * (n + 2) / (half * half), {.fault = 1.02 * truth, .standard_error = 0.002});
}

// A panel and a mirror over a small receiver: by gloss, by mirror and gloss, and by a mirror.
TEST(SensorsByGloss, AgreeWithAPatchOfTheSamePlace) {
  constexpr double edge = 0.01;
  for (const double n : {8.0, 40.0, 400.0}) {
    SceneBuilder b;
    const int black = b.material({"black", 0, 0, 0}), mirror = b.material({"mirror", 0, 0.9, 0});
    b.quad({0, 0, 0}, {edge, 0, 0}, {edge, edge, 0}, {0, edge, 0}, black);
    b.quad({-4, 3, 0}, {4, 3, 0}, {4, 3, 6}, {-4, 3, 6}, b.material(satin(0.7, n)));
    b.quad({4, -3, 0}, {-4, -3, 0}, {-4, -3, 3}, {4, -3, 3}, mirror);
    Scene scene = b.scene();
    scene.sensors.push_back(sensor_at({edge / 2, edge / 2, 0}, {0, 0, 1}));
    SolverRules rules = rules_by(Transport::gather);
    rules.lines_per_patch = rules.realizations * 4096;
    rules.direct_samples = rules.realizations * 64;  // of all three the narrowest lobe has images
    // Sensors have lines of their own, whatever patches have.
    rules.lines_of_patch.assign(scene.mesh.triangle_count(), 2 * rules.lines_per_patch);
    const auto solved = solve(scene, {one_second({0.1, -0.7, 0.7}, dni)}, rules);
    const auto patch = solved.means([](std::size_t i) { return i < 2; });
    const auto sensor = of_sensor(solved.tally, 0);
    const auto index = static_cast<std::size_t>(Part::direct);
    const double direct = static_cast<double>(solved.tally.sensors.irradiance[index][0]);
    std::vector<double> difference, faulty;
    for (std::size_t r = 0; r < patch.size(); ++r) {
      difference.push_back(sensor[r] - patch[r]);
      faulty.push_back(sensor[r] - patch[r] - 0.1 * (sensor[r] - direct));  // planted: a tenth lost
    }
    // Half an edge is seen from the panel under the angle edge/6 at most: about the patch's middle
    // the lobe changes by the square of it, times its exponent.
    const double E = mean_error(sensor).mean - direct;
    const double bias = E * (n + 2) * (edge / 6) * (edge / 6);
    const Verdict same = expect_mean(difference, 0, bias);
    std::cout << "n " << n << ": " << E << " of " << E + direct << " W/m2, " << same.text << "\n";
    EXPECT_TRUE(same) << same.text;
    EXPECT_FALSE(expect_mean(faulty, 0, bias));
  }
}

}  // namespace
}  // namespace sunload::test
