// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The circumsolar part of a clear sky: exact, drawn as it should be, and worth its samples.

#include "solver/first_light/circumsolar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <memory>

#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/variant_plan.h"
#include "solver/gather/block_light.h"
#include "solver/gather/jacobi.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"
#include "tests/support/small_study.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

const SkyGrid grid;
const Vec3 low_sun = normalized({0.6, -0.75, 0.3});

/// A second of sky light without sun: 90 W/m2 on open ground.
IntervalLight sky_light(SkyModel model, double dni, Vec3 to_sun = low_sun) {
  IntervalLight light = one_second(to_sun, 0);
  light.dhi = 90;
  const double zenith_deg = std::acos(light.direction.z) / radians_per_degree;
  light.sky = grid.mean_radiance(Sky({.model = model,
                                      .dhi = light.dhi,
                                      .dni = dni,
                                      .sun_zenith_deg = zenith_deg,
                                      .sun_direction = light.direction}),
                                 light.dhi);
  return light;
}
IntervalLight clear_sky() { return sky_light(SkyModel::perez, 700); }

TEST(Circumsolar, IsTakenFromClearSkiesOnly) {
  for (const IntervalLight& light :
       {sky_light(SkyModel::uniform, 0), sky_light(SkyModel::cie_overcast, 0),
        sky_light(SkyModel::perez, 0)})
    EXPECT_FALSE(CircumsolarSky(grid, light).any());
  EXPECT_FALSE(CircumsolarSky(grid, one_second(low_sun, 0)).any());
  const IntervalLight clear = clear_sky();
  const CircumsolarSky sky(grid, clear);
  ASSERT_TRUE(sky.any());
  double sum = 0, all = 0;
  for (std::size_t c = 0; c < clear.sky.size(); ++c) {
    EXPECT_GE(sky.radiance(c), 0);
    EXPECT_LE(sky.radiance(c), clear.sky[c]);
    sum += sky.radiance(c) * grid.solid_angle();
    all += clear.sky[c] * grid.solid_angle();
  }
  EXPECT_NEAR(sky.strength(), sum, 1e-9 * all);
  std::cout << "share of the sky's radiance: " << sum / all << "\n";
  EXPECT_GT(sum, 0.05 * all);
}

/// Share of a cell in ∫ L_circ cosθ dω, of 256 points.
double cosine_share(Vec3 normal, int cell) {
  constexpr int n = 16;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += std::max(0.0, dot(normal, grid.direction(cell, (i + 0.5) / n, (j + 0.5) / n)));
  return sum / (n * n);
}

// By level ground and by a wall that has half of L_circ behind it.
class CircumsolarOnNormal : public ::testing::TestWithParam<Vec3> {};

TEST_P(CircumsolarOnNormal, IsDrawnByItsRadianceAndCosine) {
  const Vec3 normal = GetParam();
  const IntervalLight clear = clear_sky();
  const CircumsolarSky sky(grid, clear);
  CircumsolarView view;
  view.look(sky, normal);
  constexpr std::uint32_t packets = 40000;
  std::vector<double> counted(clear.sky.size(), 0), expected(counted), without_cosine(counted);
  CircumsolarView::Samples samples;
  double off = 0;
  for (std::uint32_t p = 0; p < packets; ++p) {
    ScrambledPoints points;
    for (std::size_t s = 0; s < packet_size; ++s) {
      const RandomWords words =
          random_words({.element = p, .block = static_cast<std::uint32_t>(s)});
      points.u[s] = words[0];
      points.v[s] = words[1];
    }
    view.sample(points, samples);
    for (std::size_t s = 0; s < packet_size; ++s) {
      const Vec3 w{static_cast<double>(samples.directions.x[s]),
                   static_cast<double>(samples.directions.y[s]),
                   static_cast<double>(samples.directions.z[s])};
      off = std::max(off, std::abs(norm(w) - 1));
      EXPECT_EQ(samples.weight[s] > 0, (samples.in_front >> s & 1u) != 0);
      EXPECT_GE(samples.weight[s], 0);
      EXPECT_LE(samples.weight[s], 2);
      // Weighted as light is: by cosθ / q.
      counted[static_cast<std::size_t>(grid.cell(w))] += static_cast<double>(samples.weight[s]);
    }
  }
  EXPECT_LT(off, 1e-6);
  constexpr double draws = double{packets} * packet_size;
  double facing = 0;
  for (std::size_t c = 0; c < expected.size(); ++c) {
    const double brightness = sky.radiance(c) * grid.solid_angle();
    const double share = brightness > 0 ? cosine_share(normal, static_cast<int>(c)) : 0;
    expected[c] = draws * brightness * share / view.irradiance();
    without_cosine[c] = share > 0 ? brightness : 0;
    facing += without_cosine[c];
  }
  for (double& count : without_cosine) count *= draws / facing;
  // A direction on a border may be rounded into the next cell, which may be empty.
  double strays = 0;
  for (std::size_t c = 0; c < expected.size(); ++c)
    if (expected[c] == 0) {
      strays += counted[c];
      counted[c] = 0;
    }
  EXPECT_LE(strays, 1e-4 * draws);
  const Verdict verdict = expect_counts(counted, expected);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_counts(counted, without_cosine));  // planted: the cosine forgotten
}

INSTANTIATE_TEST_SUITE_P(Circumsolar, CircumsolarOnNormal,
                         ::testing::Values(Vec3{0, 0, 1}, tangents(low_sun).bitangent));

/// ∫ L cosθ dω over the front of a normal, of cells with 1024 points each.
double unshaded(const std::vector<double>& radiance, Vec3 normal) {
  constexpr int n = 32;
  double sum = 0;
  for (int c = 0; c < grid.cell_count(); ++c) {
    if (radiance[static_cast<std::size_t>(c)] == 0) continue;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        sum += radiance[static_cast<std::size_t>(c)] *
               std::max(0.0, dot(normal, grid.direction(c, (i + 0.5) / n, (j + 0.5) / n)));
  }
  return sum * grid.solid_angle() / (n * n);
}

/// An open square of that normal, traced; so many samples for each of 64 realizations.
constexpr int plate_realizations = 64;
struct Plate {
  Plate(Vec3 normal, int samples) {
    const Tangents plane = tangents(normal);
    builder.quad({0, 0, 0}, plane.tangent, plane.tangent + plane.bitangent, plane.bitangent,
                 builder.material({"m", 0, 0, 0}));
    rules.realizations = plate_realizations;
    rules.lines_per_patch = plate_realizations * 16;
    rules.direct_samples = plate_realizations * samples;
    traced = trace_scene(builder.scene(), SplitRules{}, rules, watch);
  }
  SunSampler sampler() const {
    return {traced->hierarchy(), traced->caster, {rules.direct_samples, rules.realizations, 1}};
  }

  SceneBuilder builder;
  SolverRules rules = test_rules();
  Watch watch;
  std::unique_ptr<TracedScene> traced;
};

// Open plates of all tilts, towards the sun and away, with the sun in their plane: half of the
// circumsolar light is behind them then.
TEST(Circumsolar, OnOpenPlatesIsExact) {
  const IntervalLight light = clear_sky();
  const CircumsolarSky sky(grid, light);
  std::vector<double> circumsolar(light.sky.size());
  for (std::size_t c = 0; c < circumsolar.size(); ++c) circumsolar[c] = sky.radiance(c);
  const Tangents axes = tangents(low_sun);
  for (const Vec3 n :
       {Vec3{0, 0, 1}, low_sun, axes.tangent, normalized(axes.bitangent + 0.1 * low_sun),
        normalized(-0.2 * low_sun + axes.tangent), normalized({0.6, -0.75, 0})}) {
    const Plate plate(n, 256);
    const SunSampler sampler = plate.sampler();
    std::vector<std::vector<double>> exposure(64, std::vector<double>(2, 0));
    Columns direct = columns(2), circumsolar_sum = columns(2), sunlit = columns(2);
    const std::vector<IntervalLight> block{light};
    direct_sun(plate.traced->caster, sampler, block, {direct, 64}, sunlit);
    circumsolar_light(plate.traced->caster, sampler, block, {sky},
                      {circumsolar_sum, 64, {{&exposure, lengths_of(block)}}});
    std::vector<double> means;
    for (const auto& E : exposure) means.push_back((E[0] + E[1]) / 2);
    const double truth = unshaded(circumsolar, n);
    const Verdict verdict = expect_mean(means, truth, float_rounding * truth);
    std::cout << verdict.text << "\n";
    EXPECT_TRUE(verdict) << verdict.text;
    EXPECT_FALSE(expect_mean(means, truth * 1.1, float_rounding * truth));
  }
}

std::vector<CircumsolarSky> skies_of(const std::vector<IntervalLight>& block) {
  std::vector<CircumsolarSky> skies;
  for (const IntervalLight& light : block) skies.emplace_back(grid, light);
  return skies;
}

Vec3 sun_at_deg(double azimuth_deg, double elevation_deg) {
  const double a = radians(azimuth_deg), e = radians(elevation_deg);
  return {std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
}

// As many suns as one like it, where they stand together; each by itself where they are far apart.
TEST(Circumsolar, NeighboursShareSamples) {
  const auto needed = [](const std::vector<Vec3>& suns) {
    std::vector<IntervalLight> block;
    for (const Vec3 sun : suns) block.push_back(sky_light(SkyModel::perez, 700, sun));
    double sum = 0;
    for (const auto& mixture : circumsolar_mixtures(skies_of(block)))
      sum += mixture.samples_needed();
    return sum;
  };
  EXPECT_NEAR(needed({low_sun}), 1, 1e-6);
  EXPECT_NEAR(needed({low_sun, low_sun, low_sun}), 1, 1e-6);
  EXPECT_NEAR(needed(std::vector<Vec3>(16, low_sun)), 4, 1e-6);  // a quarter
  EXPECT_NEAR(needed({sun_at_deg(90, 20), sun_at_deg(270, 20)}), 2, 1e-6);
  const double near = needed({sun_at_deg(90, 20), sun_at_deg(93, 22), sun_at_deg(95, 23)});
  EXPECT_GT(near, 1.02);
  EXPECT_LT(near, 2);
  // An overcast sky between them has none, and is in nobody's way.
  const auto mixtures = circumsolar_mixtures(
      skies_of({clear_sky(), sky_light(SkyModel::cie_overcast, 0), clear_sky()}));
  ASSERT_EQ(mixtures.size(), 1u);
  EXPECT_EQ(mixtures[0].count(), 3u);
  EXPECT_NEAR(mixtures[0].samples_needed(), 1, 1e-6);
  EXPECT_TRUE(circumsolar_mixtures({}).empty());
}

// Suns of a block, near and far, strong and weak: each has its own light, from whichever samples,
// also where half of the sky is behind the surface.
TEST(Circumsolar, OfEachSunOfABlockIsExact) {
  const std::vector<IntervalLight> block{sky_light(SkyModel::perez, 700, sun_at_deg(120, 18)),
                                         sky_light(SkyModel::perez, 150, sun_at_deg(126, 21)),
                                         sky_light(SkyModel::cie_overcast, 0, sun_at_deg(128, 22)),
                                         sky_light(SkyModel::perez, 800, sun_at_deg(131, 24)),
                                         sky_light(SkyModel::perez, 600, sun_at_deg(250, 9))};
  const auto skies = skies_of(block);
  ASSERT_FALSE(skies[2].any());
  const std::size_t mixtures = circumsolar_mixtures(skies).size();
  EXPECT_GT(mixtures, 1u);
  EXPECT_LT(mixtures, 4u);
  for (const Vec3 n : {Vec3{0, 0, 1}, normalized({0.6, -0.75, 0}), normalized({-0.5, -0.5, 0.3})}) {
    const Plate plate(n, 64);
    const SunSampler sampler = plate.sampler();
    std::vector<Columns> realizations(64, columns(2));
    Columns pooled = columns(2);
    circumsolar_light(plate.traced->caster, sampler, block, skies, {pooled, 64, {}, &realizations});
    for (std::size_t k = 0; k < block.size(); ++k) {
      std::vector<double> radiance(block[k].sky.size());
      for (std::size_t c = 0; c < radiance.size(); ++c) radiance[c] = skies[k].radiance(c);
      const double truth = unshaded(radiance, n);
      std::vector<double> means;
      for (const Columns& E : realizations)
        means.push_back(static_cast<double>(E[k] + E[block_width + k]) / 2);
      if (truth <= 0) {
        EXPECT_EQ(mean_error(means).mean, 0) << k;
        continue;
      }
      const Verdict verdict = expect_mean(means, truth, float_rounding * truth);
      std::cout << k << " " << verdict.text << "\n";
      EXPECT_TRUE(verdict) << k << " " << verdict.text;
      EXPECT_FALSE(expect_mean(means, truth * 1.1, float_rounding * truth));
    }
  }
}

/// Blocks in front of each other, with a mirror, under a clear sky.
TEST(Circumsolar, ClosesTheLedger) {
  SceneBuilder builder;
  const int wall = builder.material({"wall", 0.5, 0, 0});
  builder.object("ground").quad({-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}, wall);
  builder.object("north").box({-6, 3, 0.01}, {6, 6, 5}, wall, Facing::outward);
  builder.object("south").box({-6, -6, 0.01}, {2, -3, 4}, wall, Facing::outward);
  builder.object("glass").quad({-5, 2.99, 0.5}, {5, 2.99, 0.5}, {5, 2.99, 4.5}, {-5, 2.99, 4.5},
                               builder.material({"glass", 0.1, 0.8, 0}));
  const auto solved = solve(builder.scene(), {clear_sky()}, test_rules(), {.max_edge_m = 2});
  const auto in = solved.ledger([](const Ledger& l) { return l.in(); });
  const double power = mean_error(in).mean;
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const Verdict verdict = expect_mean(residual, 0, float_rounding * power);
  std::cout << verdict.text << " of " << power << " W\n";
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_LE(verdict.standard_error, 0.005 * power);
  // Planted: the circumsolar part, a fifth of the sky, left to the lines as well.
  const auto faulty =
      solved.ledger([](const Ledger& l) { return l.residual() + 0.2 * l[Term::sky]; });
  EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * power));
}

/// Relative standard errors with the area they hold for.
struct AreaErrors {
  std::vector<std::pair<double, double>> values;
  double quantile(double share) {
    std::sort(values.begin(), values.end());
    double all = 0, sum = 0;
    for (const auto& [error, area] : values) all += area;
    for (const auto& [error, area] : values)
      if ((sum += area) >= share * all) return error;
    return 0;
  }
  double share_below(double limit) const {
    double all = 0, below = 0;
    for (const auto& [error, area] : values) {
      all += area;
      if (error <= limit) below += area;
    }
    return below / all;
  }
};

// Error of the sky's irradiance of single patches with 256 lines and 16 samples, in the street
// by the clear sky of an equinox morning. Patches that see less than a twentieth of the sky are
// left out: what they get of it is next to nothing.
TEST(Circumsolar, LowersTheErrorOfTheStreet) {
  const WorkFolder folder;
  std::string text = street_study();
  text.replace(text.find("max_edge_m: 4"), 13, "max_edge_m: 8");
  folder.write("street.yaml", text);
  const VariantPlan plan = make_plan(read_study(folder / "street.yaml").variants.front());
  // The defaults are 8 realizations; 16 of the same kind tell their error better.
  constexpr std::size_t realizations = 16, default_realizations = 8;
  SolverRules rules = solver_rules(plan);
  rules.realizations = realizations;
  rules.lines_per_patch = realizations * 32;
  rules.direct_samples = realizations * 2;
  Watch watch;
  const auto traced = trace_scene(plan.built.scene, split_rules(plan.study), rules, watch);
  const Hierarchy& h = traced->hierarchy();
  const std::size_t patches = h.patch_count();
  const SunSampler sampler(h, traced->caster, {rules.direct_samples, rules.realizations, 1});
  const auto sky_view = sky_view_factors(traced->patches.lines.pooled);

  for (const std::size_t hour : {1u, 3u, 6u}) {
    const auto block =
        IntervalLights(plan.study, plan.built.site, traced->grid).of(plan.light, hour, 1);
    BlockSources sources(block, static_cast<std::size_t>(grid.cell_count()));
    sources.split_sky(grid);
    std::vector<Columns> circumsolar(realizations, columns(patches));
    Columns pooled = columns(patches), sunlit = columns(patches);
    const auto start = std::clock();
    const auto direct_rays =
        direct_sun(traced->caster, sampler, block, {pooled, realizations}, sunlit);
    const auto middle = std::clock();
    const auto rays = circumsolar_light(traced->caster, sampler, block, sources.circumsolar,
                                        {pooled, realizations, {}, &circumsolar});
    const auto end = std::clock();
    std::cout << "processor time circumsolar / direct sun: "
              << static_cast<double>(end - middle) / static_cast<double>(middle - start)
              << ", rays " << static_cast<double>(rays) / static_cast<double>(direct_rays) << "\n";
    std::vector<std::vector<double>> before(patches), after(patches);
    std::vector<double> difference(realizations, 0), extra(realizations, 0);
    for (std::size_t r = 0; r < realizations; ++r) {
      Columns whole = columns(patches), rest = columns(patches);
      gather(traced->patches.lines.realizations[r].sky, sources.sky, whole, Into::replace);
      gather(traced->patches.lines.realizations[r].sky, sources.sky_of_lines, rest, Into::replace);
      for (std::size_t i = 0; i < patches; ++i) {
        const std::size_t at = i * block_width;
        before[i].push_back(static_cast<double>(whole[at]));
        after[i].push_back(static_cast<double>(rest[at] + circumsolar[r][at]));
        difference[r] += h.area()[i] * (after[i].back() - before[i].back());
        extra[r] += h.area()[i] * 0.02 * before[i].back();
      }
    }
    // The split moves no power; a fiftieth of it would be seen.
    const Verdict verdict = expect_mean(difference, 0);
    EXPECT_TRUE(verdict) << verdict.text;
    for (std::size_t r = 0; r < realizations; ++r) extra[r] += difference[r];
    EXPECT_FALSE(expect_mean(extra, 0));

    constexpr double least_sky_view = 0.05, wanted = 0.05;
    AreaErrors errors_before, errors_after;
    const double to_default = std::sqrt(double{realizations} / default_realizations);
    for (std::size_t i = 0; i < patches; ++i) {
      if (sky_view[i] < least_sky_view) continue;
      const double mean = mean_error(after[i]).mean;
      for (auto [values, errors] :
           {std::pair{&before[i], &errors_before}, {&after[i], &errors_after}})
        errors->values.push_back(
            {mean_error(*values).standard_error * to_default / mean, h.area()[i]});
    }
    std::cout << "sun at " << std::asin(block[0].direction.z) / radians_per_degree
              << " degrees: relative standard error median, 95 %, share of area within 5 %\n";
    for (auto* errors : {&errors_before, &errors_after})
      std::cout << "  " << errors->quantile(0.5) << " " << errors->quantile(0.95) << " "
                << errors->share_below(wanted) << "\n";
    EXPECT_LT(errors_after.quantile(0.5), errors_before.quantile(0.5));
    EXPECT_GT(errors_after.share_below(wanted), errors_before.share_below(wanted));
  }
}

}  // namespace
}  // namespace sunload::test
