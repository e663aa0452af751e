// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light in three bands: each of them is a broadband solution with its own light and reflectances.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/base/threads.h"
#include "tests/support/court.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr BandShares red_sun{1.4, 0.9, 0.7}, blue_sky{0.3, 0.8, 1.9};

/// A house of the given wall, a tower of panes, a crown in place of the screen, a sensor.
Scene coloured_court(const Material& wall_material, double exitance = 25) {
  Material pane{"pane"}, crown{"crown", 0.2};
  pane.smooth = Panes{1.52};
  crown.transmittance = 0.3;
  CourtMaterials of{.wall = wall_material, .tower = pane, .screen = crown};
  of.lamp.emission_w_m2 = exitance;
  Scene scene = court(of);
  scene.sensors.push_back({{0, -6, 1.5}, {0, 0, 1}, 7});
  return scene;
}

/// Clear skies, bright about the sun.
std::vector<IntervalLight> suns(BandShares sun_colour, BandShares sky_colour) {
  const SkyGrid grid;
  std::vector<IntervalLight> light;
  for (const Vec3 w : {Vec3{0.5, -0.7, 0.4}, Vec3{0, -0.6, 0.8}, Vec3{-0.8, -0.3, 0.3}}) {
    IntervalLight sun = one_second(w, 700);
    sun.number = static_cast<std::uint32_t>(light.size());
    sun.dhi = 90;
    sun.sky = grid.mean_radiance(Sky({.model = SkyModel::perez,
                                      .dhi = 90,
                                      .dni = 700,
                                      .extraterrestrial_normal = 1361,
                                      .sun_zenith_deg = degrees(std::acos(sun.direction.z)),
                                      .sun_direction = sun.direction}),
                                 90);
    sun.ground_exitance = 0.2 * (700 * sun.direction.z + 90);
    light.push_back(in_bands(sun, sun_colour, sky_colour));
  }
  return light;
}

SolverRules court_rules() {
  SolverRules rules = test_rules();
  rules.lines_per_patch = 16 * 8;
  rules.direct_samples = 16;
  return rules;
}
const SplitRules split{.max_edge_m = 1.5};
const Material grey_wall{"wall", 0.45, 0, 0};

Material coloured(const std::string& name, const BandShares& diffuse) {
  Material material{name, mean_of(diffuse), 0, 0};
  material.diffuse_in_band = diffuse;
  return material;
}

/// Largest difference of two rows of values, relative to the largest value.
template <class Values>
double largest_difference(const Values& a, const Values& b) {
  EXPECT_EQ(a.size(), b.size());
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    difference =
        std::max(difference, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    largest = std::max(largest, std::abs(static_cast<double>(a[i])));
  }
  return largest > 0 ? difference / largest : difference;
}

void expect_same_series(const ReceiverTally& band, const ReceiverTally& broadband) {
  for (std::size_t p = 0; p < part_count; ++p) {
    EXPECT_EQ(band.irradiance[p], broadband.irradiance[p]) << part_names[p];
    EXPECT_EQ(band.exposure[p], broadband.exposure[p]) << part_names[p];
  }
  EXPECT_EQ(band.irradiance_max, broadband.irradiance_max);
  EXPECT_EQ(band.irradiance_se, broadband.irradiance_se);
  EXPECT_EQ(band.sunlit_s, broadband.sunlit_s);
}

TEST(Bands, GreySurfacesUnderWhiteLightAreBroadband) {
  const Scene scene = coloured_court(grey_wall);
  const auto light = suns({1, 1, 1}, {1, 1, 1});
  for (const auto errors : {Errors::totals, Errors::instants}) {
    SolverRules rules = court_rules();
    rules.errors = errors;
    const auto broadband = solve(scene, light, rules, split);
    const auto bands = solve_bands(scene, light, rules, split);
    ASSERT_EQ(bands.size(), band_count);
    for (const auto& band : bands) {
      expect_same_series(band.tally, broadband.tally);
      expect_same_series(band.tally.sensors, broadband.tally.sensors);
      EXPECT_EQ(band.tally.outgoing, broadband.tally.outgoing);
      for (std::size_t k = 0; k < light.size(); ++k)
        EXPECT_EQ(band.tally.ledger[k].terms, broadband.tally.ledger[k].terms);
      // The sun's part of realizations is summed over time from floats here, from doubles there.
      for (std::size_t r = 0; r < broadband.tally.exposure_realization.size(); ++r)
        EXPECT_LT(largest_difference(band.tally.exposure_realization[r],
                                     broadband.tally.exposure_realization[r]),
                  2e-7);
    }
  }
}

// Transport is linear: where surfaces are grey, the mean of the bands is the broadband light.
TEST(Bands, MeanOfColouredLightOnGreySurfacesIsBroadband) {
  const Scene scene = coloured_court(grey_wall);
  const auto light = suns(red_sun, blue_sky);
  const auto broadband = solve(scene, light, court_rules(), split);
  const auto bands = solve_bands(scene, light, court_rules(), split);
  const auto mean = [&](auto&& values_of) {
    auto sum = values_of(bands[0].tally);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] = (sum[i] + values_of(bands[1].tally)[i] + values_of(bands[2].tally)[i]) / 3;
    return sum;
  };
  const auto compare = [&](const char* what, auto&& values_of) {
    EXPECT_LT(largest_difference(mean(values_of), values_of(broadband.tally)), float_rounding)
        << what;
  };
  for (std::size_t p = 0; p < part_count; ++p) {
    compare(part_names[p], [&](const BatchTally& t) { return t.irradiance[p]; });
    compare(part_names[p], [&](const BatchTally& t) { return t.sensors.exposure[p]; });
  }
  compare("outgoing", [](const BatchTally& t) { return t.outgoing; });
  for (const std::size_t r : {std::size_t{0}, std::size_t{7}})
    compare("realization", [&](const BatchTally& t) { return t.exposure_realization[r]; });
  compare("ledger", [](const BatchTally& t) {
    return std::vector<double>(t.energy.terms.begin(), t.energy.terms.end());
  });

  // The sun is redder than the sky, wherever both are straight.
  const auto part = [&](std::size_t band, Part p) {
    return bands[band].tally.exposure[static_cast<std::size_t>(p)][0];
  };
  EXPECT_NEAR(part(0, Part::direct) / part(2, Part::direct), red_sun[0] / red_sun[2], 1e-5);
  EXPECT_NEAR(part(0, Part::sky) / part(2, Part::sky), blue_sky[0] / blue_sky[2], 1e-5);
}

// A band is the broadband solution of its light on its reflectances, in every realization, and of
// what it has of light that is not followed. (Not to the bit where surfaces
// emit: points on bright surfaces are drawn by mean reflectances.)
TEST(Bands, EveryBandIsASolutionOfItsOwn) {
  const BandShares rho{0.7, 0.4, 0.1};
  const auto light = suns(red_sun, blue_sky);
  constexpr double dark = 0;
  SolverRules rules = court_rules();
  rules.bounces = 2;
  rules.unfollowed = Unfollowed::estimate;
  const auto bands = solve_bands(coloured_court(coloured("wall", rho), dark), light, rules, split);
  for (std::size_t b = 0; b < band_count; ++b) {
    auto of_band = light;
    for (auto& sun : of_band) {
      sun.dni = sun.bands[b].dni;
      sun.ground_exitance = sun.bands[b].ground_exitance;
      sun.sky = sun.bands[b].sky;
      sun.bands.clear();
    }
    const auto alone = solve(coloured_court({"wall", rho[b], 0, 0}, dark), of_band, rules, split);
    const auto total = static_cast<std::size_t>(Part::total);
    EXPECT_LT(largest_difference(bands[b].tally.irradiance[total], alone.tally.irradiance[total]),
              float_rounding);
    for (std::size_t r = 0; r < alone.tally.exposure_realization.size(); ++r)
      EXPECT_LT(largest_difference(bands[b].tally.exposure_realization[r],
                                   alone.tally.exposure_realization[r]),
                float_rounding);
    for (std::size_t t = 0; t < term_count; ++t)
      EXPECT_NEAR(bands[b].tally.energy.terms[t], alone.tally.energy.terms[t],
                  float_rounding * alone.tally.energy.in());
    EXPECT_GT(alone.tally.energy.estimated, 0);
    EXPECT_NEAR(bands[b].tally.energy.estimated, alone.tally.energy.estimated,
                float_rounding * alone.tally.energy.in());
    // Planted fault: the next band's reflectances.
    const auto& other = bands[(b + 1) % band_count];
    EXPECT_GT(largest_difference(other.tally.irradiance[total], alone.tally.irradiance[total]),
              100 * float_rounding);
  }
}

// In a sphere F_ij = A_j / A from everywhere: E = f1 M1 / (1 - f1 rho1 - f2 rho2), band by band.
TEST(Bands, SphereOfTwoSurfacesIsExactInEachOfThem) {
  const BandShares rho1{0.1, 0.2, 0.6}, rho2{0.8, 0.7, 0.3};
  const auto truth_and_means = [&](int subdivisions, BandShares& truth) {
    Material lamp = coloured("lamp", rho1);
    lamp.emission_w_m2 = 50;
    const Scene scene = inward_sphere(subdivisions, {lamp, coloured("wall", rho2)},
                                      [](Vec3 p) { return p.z < -0.3 ? 0 : 1; });
    auto rules = test_rules();
    rules.lines_per_patch = 16 * 16;
    rules.bounces = 40;
    const auto bands = solve_bands(scene, {in_bands(one_second({0, 0, -1}, 0))}, rules);
    double area[2] = {0, 0};
    for (std::size_t i = 0; i < bands[0].area.size(); ++i)
      area[scene.material[static_cast<std::size_t>(bands[0].patches[i].triangle)].index()] +=
          bands[0].area[i];
    const double f1 = area[0] / (area[0] + area[1]), f2 = 1 - f1;
    std::vector<std::vector<double>> means;
    for (std::size_t b = 0; b < band_count; ++b) {
      truth[b] = f1 * lamp.emission_w_m2 / (1 - f1 * rho1[b] - f2 * rho2[b]);
      means.push_back(bands[b].means(everywhere));
    }
    return means;
  };
  BandShares coarse_truth, truth;
  const auto coarse = truth_and_means(2, coarse_truth), fine = truth_and_means(3, truth);
  for (std::size_t b = 0; b < band_count; ++b) {
    // Facets are chords: the bias falls with the square of their size, so that it is at most what
    // one halving changed.
    const double bias = std::abs(mean_error(coarse[b]).mean / coarse_truth[b] -
                                 mean_error(fine[b]).mean / truth[b]) *
                        truth[b];
    const Verdict verdict = expect_mean(fine[b], truth[b], bias);
    EXPECT_TRUE(verdict) << band_names[b] << ": " << verdict.text;
    // Planted faults: a wrong factor, and the broadband reflectances in every band.
    EXPECT_FALSE(expect_mean(fine[b], truth[b] * 0.97, bias)) << verdict.text;
    EXPECT_FALSE(expect_mean(fine[b], mean_of(truth), bias)) << verdict.text;
  }
}

TEST(Bands, LedgerClosesInEachOfThem) {
  const auto bands = solve_bands(coloured_court(coloured("wall", {0.7, 0.4, 0.1})),
                                 suns(red_sun, blue_sky), court_rules(), split);
  for (const auto& band : bands) {
    const auto in = band.ledger([](const Ledger& l) { return l.in(); });
    const double power = mean_error(in).mean;
    const auto residual = band.ledger([](const Ledger& l) { return l.residual(); });
    const Verdict verdict = expect_mean(residual, 0, float_rounding * power);
    EXPECT_TRUE(verdict) << verdict.text;
    EXPECT_LE(verdict.standard_error, 0.01 * power);
    // Planted fault: another band's absorption.
    const double wrong =
        mean_error(bands[0].ledger([](const Ledger& l) { return l[Term::absorbed]; })).mean -
        mean_error(bands[2].ledger([](const Ledger& l) { return l[Term::absorbed]; })).mean;
    auto faulty = residual;
    for (auto& r : faulty) r += wrong;
    EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * power));
  }
}

TEST(Bands, SameBitsForAnyNumberOfThreads) {
  const Scene scene = coloured_court(coloured("wall", {0.7, 0.4, 0.1}));
  const auto light = suns(red_sun, blue_sky);
  const auto run = [&](int threads) {
    set_thread_count(threads);
    return solve_bands(scene, light, court_rules(), split);
  };
  const auto one = run(1), three = run(3);
  for (std::size_t b = 0; b < band_count; ++b) {
    expect_same_series(one[b].tally, three[b].tally);
    EXPECT_EQ(one[b].tally.exposure_realization, three[b].tally.exposure_realization);
  }
}

// Rays are geometry: they are cast once for all bands.
TEST(Bands, CostNoFurtherRays) {
  const Scene scene = coloured_court(grey_wall);
  const auto light = suns(red_sun, blue_sky);
  const auto broadband = solve(scene, light, court_rules(), split);
  const auto bands = solve_bands(scene, light, court_rules(), split);
  EXPECT_EQ(bands[0].work[Work::direct_rays], broadband.work[Work::direct_rays]);
  EXPECT_EQ(bands[0].work[Work::mirror_rays], broadband.work[Work::mirror_rays]);
  EXPECT_EQ(bands[0].work[Work::line_rays], broadband.work[Work::line_rays]);
}

}  // namespace
}  // namespace sunload::test
