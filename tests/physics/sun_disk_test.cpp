// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The finite sun: penumbra of a straight edge, by its visible fractions and its width, straight
/// and by way of glossy surfaces.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/sun/sun.h"
#include "solver/first_light/direct_sun.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

const double half_angle = disk_half_angle(SunDisk::finite, 1);

/// Horizontal roof whose northern edge lies at y = 0 in this height; the sun in the south.
struct Edge {
  double height_m = 50;
  double elevation = radians(30);

  Vec3 sun() const { return {0, -std::cos(elevation), std::sin(elevation)}; }
  /// Where on the ground the edge is seen in this distance from the centre of the disk, in radii,
  /// upward negative: more than half of the disk is visible where it is positive.
  double ground_y(double radii) const {
    const double seen_at = elevation - std::atan(radii * std::tan(half_angle));
    return height_m / std::tan(seen_at);
  }
};

/// Sunlit share of strips of the ground, per realization.
std::vector<std::vector<double>> sunlit(const Edge& edge, const std::vector<double>& middles_y,
                                        double width_m, double sun_half_angle,
                                        const DirectRules& rules) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  for (const double y : middles_y) {
    const double low = y - width_m / 2, high = y + width_m / 2;
    builder.quad({-0.5, low, 0}, {0.5, low, 0}, {0.5, high, 0}, {-0.5, high, 0}, black);
  }
  const double h = edge.height_m;
  builder.quad({-20, -50, h}, {20, -50, h}, {20, 0, h}, {-20, 0, h}, black);
  const Hierarchy hierarchy(builder.scene(), {});
  const RayCaster caster(builder.scene().mesh);
  const SunSampler sampler(hierarchy, caster, rules);
  const std::size_t patches = hierarchy.patch_count();
  const auto realizations = static_cast<std::size_t>(rules.realizations);
  IntervalLight light = one_second(edge.sun(), 1);
  light.disk_half_angle = sun_half_angle;
  std::vector<std::vector<double>> exposure(realizations, std::vector<double>(patches, 0));
  Columns pooled = columns(patches), sunlit = columns(patches);
  const std::vector<IntervalLight> block{light};
  direct_sun(caster, sampler, block, {pooled, realizations, {{&exposure, lengths_of(block)}}},
             sunlit);
  std::vector<std::vector<double>> share(middles_y.size(), std::vector<double>(realizations));
  for (std::size_t strip = 0; strip < middles_y.size(); ++strip)
    for (std::size_t r = 0; r < realizations; ++r)
      share[strip][r] = (exposure[r][2 * strip] + exposure[r][2 * strip + 1]) / 2 / edge.sun().z;
  return share;
}

TEST(SunDisk, HalfAngle) {
  EXPECT_EQ(disk_half_angle(SunDisk::point, 1), 0);
  EXPECT_NEAR(degrees(half_angle), 0.2666, 1e-12);
  EXPECT_NEAR(degrees(disk_half_angle(SunDisk::finite, 0.9833)), 0.2666 / 0.9833, 1e-5);
}

TEST(SunDisk, VisibleFractionsOfTheReference) {
  const Edge edge;
  // Of the penumbra's width one per cent: the fraction's curvature (at most 1 per radius squared)
  // changes the mean over a strip by its width squared / 24.
  const double radius_m = (edge.ground_y(1) - edge.ground_y(-1)) / 2;
  constexpr double strip_radii = 0.02;
  constexpr double bias = strip_radii * strip_radii / 24;
  int cases = 0;
  const auto reference = read_json("06_direct_sun/shadows.json");
  for (const auto& row : reference.at("cases")) {
    if (!row.contains("visible_fraction")) continue;
    ++cases;
    const double x = number(row.at("x")), truth = number(row.at("visible_fraction"));
    SCOPED_TRACE(row.at("id").get<std::string>());
    // Beyond the penumbra's own ends the answer is exact: a strip just outside is taken there.
    const double beside = std::abs(x) < 1 ? x : x + std::copysign(strip_radii, x);
    const auto at = [&](double disk) {
      return sunlit(edge, {edge.ground_y(beside)}, strip_radii * radius_m, disk,
                    {.samples = 32 * 512, .realizations = 32})
          .front();
    };
    const auto seen = at(half_angle);
    if (std::abs(x) >= 1) {
      for (const double share : seen) EXPECT_EQ(share, truth);
      continue;
    }
    const Verdict verdict = expect_mean(seen, truth, bias);
    EXPECT_TRUE(verdict) << verdict.text;
    if (x == 0) continue;  // half of the disk, whatever its size
    // Planted faults: a disk of the wrong size, and the point.
    EXPECT_FALSE(expect_mean(at(half_angle * 0.9), truth, bias));
    EXPECT_FALSE(expect_mean(at(0), truth, bias));
  }
  EXPECT_GE(cases, 5);
}

TEST(SunDisk, PenumbraIsTwiceDistanceTimesTangentWide) {
  // On the ground that width is divided by the sine of the elevation: 1.861 m for the reference.
  for (const double height_m : {10.0, 50.0}) {
    Edge edge;
    edge.height_m = height_m;
    const double distance_m = height_m / std::sin(edge.elevation);
    const double expected_m = 2 * distance_m * std::tan(half_angle) / std::sin(edge.elevation);
    const double middle_y = height_m / std::tan(edge.elevation);
    constexpr int strips = 120;
    constexpr double strips_per_width = 80;
    const double strip_m = expected_m / strips_per_width;
    std::vector<double> y;
    for (int n = 0; n < strips; ++n) y.push_back(middle_y + (n + 0.5 - strips / 2.0) * strip_m);
    const auto share =
        sunlit(edge, y, strip_m, half_angle, {.samples = 16 * 512, .realizations = 16});
    int partly = 0;
    for (const auto& strip : share) {
      double sum = 0;
      for (const double value : strip) sum += value / static_cast<double>(strip.size());
      if (sum > 0 && sum < 1) ++partly;
    }
    // Strips cut the width to one on each side; at its ends the disk's rim is a sliver that
    // samples may miss in one strip more.
    EXPECT_NEAR(partly * strip_m, expected_m, 3 * strip_m);
    if (height_m == 50) {
      const auto reference = read_json("06_direct_sun/shadows.json");
      for (const auto& row : reference.at("cases")) {
        if (row.at("id") != "penumbra_width_1") continue;
        // The reference takes both rims exactly, the formula is their linear part.
        EXPECT_NEAR(expected_m, number(row.at("width")), 1e-4 * expected_m);
      }
    }
  }
}

/// A glossy strip where a fifth of the disk is seen above such an edge, and its centre is hidden.
struct GlossyStrip {
  static constexpr double radii = -0.5, width_radii = 0.04;
  /// Share of a disk beyond a chord at half of its radius.
  static inline const double visible = (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / pi;
  const Edge edge{};
  const double y = edge.ground_y(radii);
  const double width_m = width_radii * (edge.ground_y(1) - edge.ground_y(-1)) / 2;
  SceneBuilder builder;

  GlossyStrip() {
    Material satin{"satin"};
    satin.glossy = 0.7;
    satin.glossy_exponent = 20;
    const double low = y - width_m / 2, high = y + width_m / 2;
    builder.object("strip").quad({-0.5, low, 0}, {0.5, low, 0}, {0.5, high, 0}, {-0.5, high, 0},
                                 builder.material(satin));
  }
  /// Its patches face down, away from the sun.
  void add_edge() {
    const double h = edge.height_m;
    builder.object("roof").quad({-20, -50, h}, {-20, 0, h}, {20, 0, h}, {20, -50, h},
                                builder.material({"black"}));
  }
  /// Where the strip mirrors the sun to.
  Vec3 glint() const { return Vec3{0, y, 0} + 0.08 * Vec3{0, -edge.sun().y, edge.sun().z}; }
  Solved solve_with(double sun_half_angle, const std::vector<Sensor>& sensors = {}) const {
    IntervalLight light = one_second(edge.sun(), 900);
    light.disk_half_angle = sun_half_angle;
    auto rules = test_rules();
    rules.lines_per_patch = rules.realizations * 16384;
    rules.direct_samples = rules.realizations * 2048;  // so many that images stand for the lobe
    Scene scene = builder.scene();
    scene.sensors = sensors;
    return solve(scene, {light}, rules);
  }
};

// What the strip receives and what it sends on rest on the same rays.
TEST(SunDisk, GlossSendsOnWhatItReceivesInThePenumbra) {
  GlossyStrip strip;
  strip.add_edge();
  const Solved solved = strip.solve_with(half_angle);
  const auto in = solved.ledger([](const Ledger& l) { return l[Term::sun]; });
  const double truth = GlossyStrip::visible * 900 * strip.edge.sun().z * strip.width_m;
  const Verdict verdict = expect_mean(in, truth, 0.01 * truth);
  EXPECT_TRUE(verdict) << verdict.text;
  // No patch faces the sun but the strip's: the fate of every sample is booked.
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  for (std::size_t r = 0; r < in.size(); ++r) EXPECT_NEAR(residual[r], 0, float_rounding * in[r]);
  for (const double of_point : strip.solve_with(0).ledger([](const Ledger& l) { return l.in(); }))
    EXPECT_EQ(of_point, 0);
}

/// Irradiance of a sensor, or of a small patch, that looks down on the strip from its glint.
std::vector<double> over_strip(GlossyStrip strip, bool on_sensor) {
  const Vec3 at = strip.glint();
  constexpr double edge_m = 0.01;
  if (on_sensor)
    return of_sensor(strip.solve_with(half_angle, {sensor_at(at, {0, 0, -1})}).tally, 0);
  strip.builder.object("receiver")
      .quad(at, at + Vec3{0, edge_m, 0}, at + Vec3{edge_m, edge_m, 0}, at + Vec3{edge_m, 0, 0},
            strip.builder.material({"black"}));
  const Solved solved = strip.solve_with(half_angle);
  const auto end = static_cast<std::int32_t>(strip.builder.scene().mesh.triangle_count());
  return solved.means([&](std::size_t i) { return solved.patches[i].triangle >= end - 2; });
}

TEST(SunDisk, GlossIsSeenInThePenumbra) {
  const GlossyStrip lit;
  GlossyStrip below_edge;
  below_edge.add_edge();
  for (const bool on_sensor : {false, true}) {
    SCOPED_TRACE(on_sensor ? "sensor" : "patch");
    const double truth = GlossyStrip::visible * mean_error(over_strip(lit, on_sensor)).mean;
    // Of the strip's width, and of the noise of `truth`.
    const double bias = 0.02 * truth;
    const auto seen = over_strip(below_edge, on_sensor);
    const Verdict verdict = expect_mean(seen, truth, bias);
    std::cout << verdict.text << "\n";
    EXPECT_TRUE(verdict) << verdict.text;
    EXPECT_FALSE(expect_mean(seen, 0, bias));  // the centre alone is asked
    EXPECT_FALSE(expect_mean(seen, 1.2 * truth, bias));
  }
}

TEST(SunDisk, APointStaysAPoint) {
  const Edge edge;
  const double y = edge.height_m / std::tan(edge.elevation);
  const auto share =
      sunlit(edge, {y - 0.011, y + 0.011}, 0.02, 0, {.samples = 256, .realizations = 16});
  for (const double value : share[0]) EXPECT_EQ(value, 0);
  for (const double value : share[1]) EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace sunload::test
