// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Hills in the light of a study: the beam goes, the sky's light stays, the low sky is ground.
#include <gtest/gtest.h>

#include <cmath>

#include "geo/sky/horizon.h"
#include "geo/sky/sky.h"
#include "io/plan/interval_lights.h"
#include "io/plan/light_series.h"

namespace sunload {
namespace {

Study study(LightSource source, double step_min) {
  Study study;
  study.site.timezone = "UTC";
  study.light.source = source;
  study.light.dni_w_m2 = 800;
  study.light.dhi_w_m2 = 100;
  study.period.kind = DaysPeriod{{{2026, 3, 21, 0, 0, 0}}, 0, seconds_per_day, step_min};
  return study;
}

Site prague(const Horizon& hills) {
  return {.latitude_deg = 50, .longitude_deg = 14, .horizon = hills};
}

TEST(HillsLight, BeamGoesDiffuseStays) {
  const Horizon hills({{0, 20}});
  for (const auto source : {LightSource::clear_sky, LightSource::fixed}) {
    for (const double step_min : {10.0, 60.0}) {
      const Study s = study(source, step_min);
      const auto open = light_series(s, prague({})), behind = light_series(s, prague(hills));
      ASSERT_EQ(open.intervals.size(), behind.intervals.size());
      int hidden = 0;
      for (std::size_t i = 0; i < open.intervals.size(); ++i) {
        const LitInterval &a = open.intervals[i], &b = behind.intervals[i];
        EXPECT_EQ(a.when.up_s, b.when.up_s);
        if (b.when.sunlit_s == b.when.up_s) {
          EXPECT_EQ(a.mean.dni, b.mean.dni);
          EXPECT_EQ(a.mean.ghi, b.mean.ghi);
          EXPECT_EQ(a.mean.dhi, b.mean.dhi);
        } else if (b.when.sunlit_s == 0) {
          ++hidden;
          EXPECT_EQ(b.mean.dni, 0);
          EXPECT_GT(b.mean.dhi, 0);
          EXPECT_EQ(b.mean.ghi, b.mean.dhi);
          EXPECT_GT(b.of_the_sky.dni, 0);  // the sky above is that of a clear day
          // Short clear-sky steps take the sun of the step's middle in both cases.
          if (source == LightSource::fixed) {
            EXPECT_EQ(a.mean.dhi, b.mean.dhi);
          }
        } else {
          EXPECT_GT(b.mean.dni, 0);
          EXPECT_LT(b.mean.dni, a.mean.dni);
          EXPECT_LT(b.mean.ghi, a.mean.ghi);
        }
      }
      EXPECT_GE(hidden, 2);
    }
  }
}

TEST(HillsLight, PartlyHiddenBeamIsThatOfTheSunlitPart) {
  // A whole day as one interval: the energy of the beam must be that of short steps.
  const Horizon hills({{0, 20}});
  const auto energy = [&](double step_min) {
    double sum = 0;
    for (const auto& i :
         light_series(study(LightSource::clear_sky, step_min), prague(hills)).intervals)
      sum += i.mean.dni * i.when.length_s();
    return sum;
  };
  const double fine = energy(1);
  // Gauss points on panels of an hour: what halving the steps to an hour changes is their error.
  EXPECT_NEAR(energy(1440), fine, 2e-3 * fine);
  EXPECT_NEAR(energy(60), fine, 1e-3 * fine);
}

TEST(HillsLight, PositionsAreHiddenToo) {
  Study s;
  s.light.source = LightSource::fixed;
  s.light.dni_w_m2 = 800;
  s.light.dhi_w_m2 = 100;
  s.period.kind = PositionsPeriod{{{90, 10, 60}, {90, 30, 60}}};
  const auto light = light_series(s, prague(Horizon({{0, 20}})));
  EXPECT_EQ(light.intervals[0].mean.dni, 0);
  EXPECT_EQ(light.intervals[0].mean.dhi, 100);
  EXPECT_EQ(light.intervals[1].mean.dni, 800);
}

TEST(HillsLight, LowSkyIsFarGround) {
  const SkyGrid grid;
  Study s = study(LightSource::fixed, 60);
  s.light.sky = SkyModel::uniform;
  s.light.far_ground_albedo = 0.5;
  const Horizon hills({{0, 30}});
  const Site site = prague(hills);
  const auto open = open_shares(grid, hills, scene_from_enu(site));
  const LitInterval noon = light_series(s, site).intervals[12];
  const IntervalLight light = IntervalLights(s, site, grid).of(noon, 12);
  ASSERT_EQ(light.sky.size(), static_cast<std::size_t>(grid.cell_count()));
  double sky = 0, ground = 0;
  for (std::size_t c = 0; c < open.size(); ++c) {
    if (open[c] == 1) {
      EXPECT_NEAR(light.sky[c], 100 / pi, 1e-9);
    }
    if (open[c] == 0) {
      EXPECT_DOUBLE_EQ(light.sky[c], 0.5 * noon.mean.ghi / pi);
    }
    sky += open[c] * grid.projected()[c];
    ground += (1 - open[c]) * grid.projected()[c];
  }
  // The cap above 30 degrees has a horizontal share of cos²(30°) = 3/4. Both parts of a cell on its
  // rim count with the cell's mean cosine z instead of their own: at most Δz²/4, and rings of the
  // square's r = sqrt(1 - z) are 1/32 wide.
  const double ring = 2 * std::sqrt(0.5) / 32;
  EXPECT_NEAR(sky / pi, 0.75, ring * ring / 4);
  EXPECT_NEAR(sky + ground, pi, 1e-9);
  // Without hills the same as ever.
  const IntervalLight before = IntervalLights(s, prague({}), grid).of(noon, 12);
  EXPECT_EQ(before.sky, grid.mean_radiance(sky_of(noon, s.light), noon.mean.dhi));
}

TEST(HillsLight, AzimuthsOfHillsAreTrue) {
  // A mountain in the east; the scene's +y axis points east: the mountain is ahead.
  const SkyGrid grid;
  const Horizon mountain({{60, 0}, {70, 45}, {110, 45}, {120, 0}});
  const auto open = open_shares(grid, mountain, scene_from_enu({.north_deg = 90}));
  const auto at = [&](Vec3 w) { return open[static_cast<std::size_t>(grid.cell(normalized(w)))]; };
  EXPECT_EQ(at({0, 1, 0.3}), 0);
  EXPECT_EQ(at({1, 0, 0.3}), 1);
  EXPECT_EQ(at({-1, 0, 0.3}), 1);
  EXPECT_EQ(at({0, -1, 0.3}), 1);
  EXPECT_EQ(at({0, 1, 2}), 1);
}

}  // namespace
}  // namespace sunload
