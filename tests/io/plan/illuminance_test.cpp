// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light as the eye sees it: sources by their own efficacies, names and units, what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "geo/sky/sky.h"
#include "io/plan/interval_lights.h"
#include "io/plan/light_series.h"
#include "io/plan/variant_plan.h"
#include "io/result/schema.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using test::write_text;

Study study(LightSource source, Quantity quantity) {
  Study study;
  study.site.timezone = "UTC";
  study.light.source = source;
  study.light.dni_w_m2 = 700;
  study.light.dhi_w_m2 = 120;
  study.light.quantity = quantity;
  study.period.kind = DaysPeriod{{{2026, 6, 21, 0, 0, 0}}, 0, seconds_per_day, 60};
  return study;
}

TEST(Illuminance, BeamAndSkyAreConvertedByTheirOwnEfficacies) {
  const Site site{.latitude_deg = 50, .longitude_deg = 14};
  const SkyGrid grid;
  for (const auto source : {LightSource::clear_sky, LightSource::fixed}) {
    const Study power = study(source, Quantity::irradiance),
                light = study(source, Quantity::illuminance);
    const LightSeries series = light_series(light, site);
    int lit = 0;
    for (std::uint32_t k = 0; k < series.intervals.size(); ++k) {
      const LitInterval& interval = series.intervals[k];
      const IntervalLight watts = IntervalLights(power, site, grid).of(interval, k);
      const IntervalLight lux = IntervalLights(light, site, grid).of(interval, k);
      EXPECT_EQ(lux.sunlit_s, watts.sunlit_s);
      if (watts.dni <= 0) {
        EXPECT_EQ(lux.dni, 0);
        continue;
      }
      ++lit;
      // Of the paper's model, from the sky that the interval has while the sun is up.
      const double zenith_deg = 90 - interval.when.sun.elevation_deg;
      const LuminousEfficacy lm_per_w = luminous_efficacy(
          sky_condition(interval.of_the_sky.dni, interval.of_the_sky.dhi, zenith_deg,
                        extraterrestrial(interval.when.sun.distance_au)),
          zenith_deg, 2);
      EXPECT_NEAR(lux.dni / watts.dni, lm_per_w.beam, 1e-9 * lm_per_w.beam);
      EXPECT_NEAR(lux.dhi / watts.dhi, lm_per_w.diffuse, 1e-9 * lm_per_w.diffuse);
      EXPECT_NE(lm_per_w.beam, lm_per_w.diffuse);
      for (std::size_t cell = 0; cell < watts.sky.size(); cell += 97)
        EXPECT_NEAR(lux.sky[cell] / watts.sky[cell], lm_per_w.diffuse, 1e-6 * lm_per_w.diffuse);
      const double beam = interval.mean.ghi - interval.mean.dhi;
      const double global = beam * lm_per_w.beam + interval.mean.dhi * lm_per_w.diffuse;
      EXPECT_NEAR(lux.ground_exitance, light.light.far_ground_albedo * global, 1e-9 * global);
    }
    EXPECT_GE(lit, 14);
  }
}

TEST(Illuminance, DatasetsHaveItsNamesAndUnits) {
  const auto units = [](const char* name) -> std::string {
    const ResultVariable* found = find_result_variable(name, Quantity::illuminance);
    return found ? std::string(found->units) : "missing";
  };
  EXPECT_EQ(units("illuminance"), "lx");
  EXPECT_EQ(units("illuminance_reflected"), "lx");
  EXPECT_EQ(units("facade_illuminance"), "lx");
  EXPECT_EQ(units("illuminance_max"), "lx");
  EXPECT_EQ(units("irradiance"), "missing");
  EXPECT_EQ(units("light_load"), "klx h");
  EXPECT_EQ(units("light_load_realization"), "klx h");
  EXPECT_EQ(units("power_absorbed"), "lm");
  EXPECT_EQ(units("power_absorbed_se"), "klm h");
  EXPECT_EQ(units("sun_hours"), "h");
  EXPECT_EQ(units("dni"), "W m-2");
  EXPECT_EQ(units("direct_normal_illuminance"), "lx");
  ASSERT_EQ(result_schema(Quantity::illuminance).size(), result_schema().size());
  for (const auto& variable : result_schema(Quantity::illuminance)) {
    if (variable.part == ResultPart::sun) continue;
    for (const auto text : {variable.name, variable.units, variable.long_name}) {
      EXPECT_EQ(text.find("irradiance"), text.npos) << text;
      EXPECT_EQ(text.find('W'), text.npos) << text;
    }
  }
}

std::string text_of(const std::string& quantity, const std::string& emission) {
  return "format: sunload-study-1\nname: w\n"
         "site: {latitude_deg: 50, longitude_deg: 14, timezone: UTC}\n"
         "period: {days: [2026-06-21]}\nlight: {source: clear_sky, quantity: " +
         quantity +
         "}\nscene: {files: [flat.obj], materials: {tile: {diffuse: 0.3, emission_w_m2: " +
         emission + "}}}\n";
}

VariantPlan plan_of(const std::string& quantity, const std::string& emission) {
  write_text("flat.obj", "usemtl tile\nv 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
  return make_plan(read_study(write_text("w.yaml", text_of(quantity, emission))).variants.front());
}

TEST(Illuminance, IsAnotherContentAndKnowsNoLamps) {
  EXPECT_NE(plan_of("illuminance", "0").content_hash, plan_of("irradiance", "0").content_hash);
  EXPECT_NO_THROW(plan_of("irradiance", "100"));
  try {
    plan_of("illuminance", "100");
    FAIL() << "lamps in W/m2 were taken for light";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("emission_w_m2"), std::string::npos) << error.what();
  }
}

// Preetham, Shirley & Smits (1999): zenith luminance and the sky's illuminance, on an open plane.
/// The sun put 60 degrees from the zenith, without a date.
Study put_sun(SkyModel sky) {
  Study study;
  study.period.kind = PositionsPeriod{{{.azimuth_deg = 180, .elevation_deg = 30}}};
  study.light.source = LightSource::fixed;
  study.light.dni_w_m2 = 700;
  study.light.sky = sky;
  study.light.sky_scale = SkyScale::absolute;
  return study;
}

TEST(Illuminance, OfAbsoluteSkiesFollowsFromTheZenith) {
  const Site site{.latitude_deg = 50, .longitude_deg = 0};
  const auto lux_of = [&](Study study) {
    study.light.quantity = Quantity::illuminance;
    const LitInterval interval = light_series(study, site).intervals.front();
    EXPECT_NEAR(interval.mean.dhi * interval.lm_per_w->diffuse,
                source_means(interval, Quantity::illuminance).dhi, 1e-9 * interval.mean.dhi);
    // Skies send 90 to 200 lumens per watt (Perez et al. 1990, figure 3).
    EXPECT_GT(interval.lm_per_w->diffuse, 90);
    EXPECT_LT(interval.lm_per_w->diffuse, 200);
    EXPECT_NEAR(interval.mean.ghi, 700 * std::sin(radians(30.0)) + interval.mean.dhi, 1e-9);
    return source_means(interval, Quantity::illuminance).dhi;
  };
  // Uniform: pi L. Overcast: L (1 + 2 cos)/3 gives 7/9 pi L.
  Study given = put_sun(SkyModel::uniform);
  given.light.zenith_luminance_cd_m2 = 5000;
  EXPECT_NEAR(lux_of(given), pi * 5000, 1e-6 * pi * 5000);
  given.light.sky = SkyModel::cie_overcast;
  EXPECT_NEAR(lux_of(given), 7.0 / 9 * pi * 5000, 1e-6 * pi * 5000);
  // By hand, T = 3: chi = (4/9 - 3/120)(pi - 2 pi/3) = 0.4392412;
  // (4.0453*3 - 4.9710) tan chi - 0.2155*3 + 2.4192 = 7.1649*0.4698539 + 1.7727 = 5.139156 kcd/m2.
  const double kcd = 5.139156;
  for (const SkyModel model : {SkyModel::cie_clear, SkyModel::cie_general}) {
    Study by_turbidity = put_sun(model);
    by_turbidity.light.turbidity = 3;
    Study by_zenith = by_turbidity;
    by_zenith.light.zenith_luminance_cd_m2 = 1000 * kcd;
    const double lux = lux_of(by_turbidity);
    EXPECT_NEAR(lux, lux_of(by_zenith), 1e-5 * lux);
    by_zenith.light.zenith_luminance_cd_m2 = 2000 * kcd;
    EXPECT_NEAR(2 * lux, lux_of(by_zenith), 1e-5 * lux);
  }
}

TEST(Illuminance, OfTheAbsoluteSkyIsTheModelsOwn) {
  Study absolute;
  absolute.site.timezone = "UTC";
  absolute.period.kind = InstantsPeriod{{parse_time("2024-06-21T12:00Z")}, 10};
  absolute.light.sky = SkyModel::preetham;
  absolute.light.sky_scale = SkyScale::absolute;
  absolute.light.turbidity = 4;
  const Site site{.latitude_deg = 50, .longitude_deg = 0};
  const auto noon = [&](Quantity quantity) {
    absolute.light.quantity = quantity;
    const LitInterval interval = light_series(absolute, site).intervals.front();
    return std::pair(interval, source_means(interval, quantity));
  };
  const auto [interval, lux] = noon(Quantity::illuminance);
  const double klx = preetham_illuminance_klx(4, 90 - interval.when.sun.elevation_deg);
  EXPECT_GT(klx, 20);
  EXPECT_NEAR(lux.dhi, 1000 * klx, 1e-9 * lux.dhi);
  const Irradiance power = noon(Quantity::irradiance).second;
  EXPECT_NEAR(power.dhi * interval.lm_per_w->diffuse, lux.dhi, 1e-9 * lux.dhi);
  // The beam is that of the clear sky either way.
  absolute.light.sky_scale = SkyScale::diffuse;
  const Irradiance scaled = noon(Quantity::irradiance).second;
  EXPECT_EQ(scaled.dni, power.dni);
  EXPECT_NE(scaled.dhi, power.dhi);
  EXPECT_NEAR(scaled.ghi - scaled.dhi, power.ghi - power.dhi, 1e-9 * power.ghi);
}

}  // namespace
}  // namespace sunload
