// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "geo/base/units.h"
#include "tests/support/reference.h"

namespace sunload {
namespace {

using test::number;

const std::string folder = "02_irradiance_models/";

void expect_relative(double value, double expected, double tolerance, const std::string& what) {
  test::expect_reference(what, value, expected, tolerance * std::abs(expected));
}

TEST(AirMass, KastenAndYoungMeetTheReference) {
  int rows = 0;
  for (const auto& row : test::read_csv(folder + "airmass.csv")) {
    if (row.at("model") != "kastenyoung1989") continue;
    EXPECT_NEAR(relative_air_mass(90 - number(row, "zenith_deg")), number(row, "relative_airmass"),
                number(row, "tol_abs"))
        << row.at("zenith_deg");
    ++rows;
  }
  EXPECT_EQ(rows, 11);
  // The two rows of the table on pressure: three decimals.
  EXPECT_NEAR(absolute_air_mass(40, 90000), 35.529, 0.001);
  EXPECT_NEAR(absolute_air_mass(2, 90000), 1.776, 0.001);
}

TEST(AirMass, StaysFiniteAtAndBelowTheHorizon) {
  EXPECT_TRUE(std::isfinite(relative_air_mass(0)));
  EXPECT_EQ(relative_air_mass(-90), relative_air_mass(0));
}

TEST(Pressure, MeetsTheReference) {
  for (const auto& row : test::read_csv(folder + "altitude_pressure.csv")) {
    test::expect_reference("pressure_Pa", standard_pressure(number(row, "altitude_m")),
                           number(row, "pressure_Pa"), 0.001);
  }
  EXPECT_EQ(standard_pressure(1e6), 0);
}

TEST(Extraterrestrial, FollowsTheDistance) {
  for (const auto& row : test::read_csv(folder + "extraterrestrial_by_distance.csv")) {
    const double distance = number(row, "distance_au");
    // The table's 7 decimals of the distance and 3 of the irradiance give 5e-7.
    const double tolerance = number(row, "tol_rel");
    expect_relative(extraterrestrial(distance, 1), number(row, "E0_over_gsc"), tolerance, "");
    expect_relative(extraterrestrial(distance, 1361.1), number(row, "E0_W_m2_gsc1361p1"), tolerance,
                    "");
    expect_relative(extraterrestrial(distance, 1366.1), number(row, "E0_W_m2_gsc1366p1"), tolerance,
                    "");
  }
}

Irradiance computed(const std::string& model, const nlohmann::json& in) {
  const auto value = [&in](const char* key) { return number(in.at(key)); };
  if (model == "ineichen_perez") {
    return ineichen(
        {90 - value("apparent_zenith_deg"), value("airmass_absolute"), value("linke_turbidity"),
         value("altitude_m"), value("dni_extra"),
         in.at("perez_enhancement").get<bool>() ? PerezEnhancement::on : PerezEnhancement::off});
  }
  if (model == "haurwitz") return {0, 0, haurwitz(value("apparent_elevation_deg"))};
  BirdInput air;
  air.elevation_deg = 90 - value("zenith_deg");
  air.relative_air_mass = value("airmass_relative_kasten1966");
  air.pressure_pa = value("pressure_Pa");
  air.broadband_aerosol_depth = broadband_aerosol_depth(value("aod380"), value("aod500"));
  air.precipitable_water_cm = value("precipitable_water_cm");
  air.ozone_atm_cm = value("ozone_atm_cm");
  air.asymmetry = value("asymmetry");
  air.ground_albedo = value("albedo");
  air.extraterrestrial_normal = value("dni_extra");
  return bird(air);
}

TEST(ClearSky, ModelsMeetTheReference) {
  int checked = 0;
  const auto table = test::read_json(folder + "clear_sky.json");
  for (const auto& entry : table.at("cases")) {
    const std::string model = entry.at("model");
    // Simplified Solis and the two ASHRAE models are not among ours.
    if (model != "ineichen_perez" && model != "haurwitz" && model != "bird_hulstrom") continue;
    const Irradiance sky = computed(model, entry.at("inputs"));
    const double tolerance = number(entry.at("tol_rel"));
    const auto& expected = entry.at("expected");
    const std::string id = entry.at("id");
    if (expected.contains("ghi")) expect_relative(sky.ghi, number(expected["ghi"]), tolerance, id);
    if (expected.contains("dni")) expect_relative(sky.dni, number(expected["dni"]), tolerance, id);
    if (expected.contains("dhi")) expect_relative(sky.dhi, number(expected["dhi"]), tolerance, id);
    ++checked;
  }
  EXPECT_EQ(checked, 28);
}

// Closure, sign and darkness below the horizon, for every model over its arguments.
TEST(ClearSky, IsSoundEverywhere) {
  for (const auto model : {ClearSkyModel::ineichen, ClearSkyModel::bird, ClearSkyModel::haurwitz}) {
    for (const double elevation_deg : {-90.0, -1.0, 0.0, 1e-9, 0.1, 1.0, 5.0, 30.0, 89.9, 90.0}) {
      for (const double turbidity : {1.0, 2.0, 3.0, 7.0, 15.0}) {
        for (const double elevation_m : {-400.0, 0.0, 1500.0, 8000.0}) {
          const Irradiance sky =
              clear_sky(model, {elevation_deg, elevation_m, turbidity, solar_constant});
          EXPECT_GE(sky.dni, 0);
          EXPECT_GE(sky.dhi, 0);
          EXPECT_LE(sky.dni, solar_constant);
          EXPECT_NEAR(sky.ghi, sky.dni * std::sin(radians(elevation_deg)) + sky.dhi, 1e-9);
          if (elevation_deg <= 0) {
            EXPECT_EQ(sky.ghi, 0);
            EXPECT_EQ(sky.dni, 0);
          }
        }
      }
    }
  }
}

TEST(ClearSky, TurbidAirTakesFromTheBeam) {
  for (const auto model : {ClearSkyModel::ineichen, ClearSkyModel::bird}) {
    const Irradiance clear = clear_sky(model, {40, 0, 2.5, solar_constant});
    const Irradiance turbid = clear_sky(model, {40, 0, 6, solar_constant});
    EXPECT_LT(turbid.dni, clear.dni);
    EXPECT_GT(turbid.dhi, clear.dhi);
    EXPECT_LT(turbid.ghi, clear.ghi);
  }
}

TEST(ClearSky, ModelsAgreeOnAClearNoon) {
  const auto ghi = [](ClearSkyModel model) {
    return clear_sky(model, {60, 200, 3, solar_constant}).ghi;
  };
  // Published comparisons find these models within 10 % of each other in clear air.
  EXPECT_NEAR(ghi(ClearSkyModel::bird) / ghi(ClearSkyModel::ineichen), 1, 0.1);
  EXPECT_NEAR(ghi(ClearSkyModel::haurwitz) / ghi(ClearSkyModel::ineichen), 1, 0.1);
}

TEST(ClearSky, RefusesWhatIsNotANumber) {
  EXPECT_THROW(clear_sky(ClearSkyModel::ineichen, {NAN, 0, 3, 1361}), std::logic_error);
  EXPECT_THROW(clear_sky(ClearSkyModel::ineichen, {30, 0, NAN, 1361}), std::logic_error);
}

TEST(Turbidity, IsLinearBetweenTheMiddlesOfMonths) {
  Turbidity turbidity;
  for (std::size_t m = 0; m < 12; ++m) turbidity.monthly[m] = static_cast<double>(m + 1);
  EXPECT_DOUBLE_EQ(turbidity.at({2025, 4, 16, 0, 0, 0}), 4);   // 30 days: its 15th midnight
  EXPECT_DOUBLE_EQ(turbidity.at({2025, 1, 16, 12, 0, 0}), 1);  // 31 days
  EXPECT_DOUBLE_EQ(turbidity.at({2024, 2, 15, 12, 0, 0}), 2);  // a leap year
  // 15 of the 30.5 days from mid-April to mid-May.
  EXPECT_NEAR(turbidity.at({2025, 5, 1, 0, 0, 0}), 4 + 15 / 30.5, 1e-12);
  // Over the turn of the year, without a jump.
  EXPECT_NEAR(turbidity.at({2025, 12, 31, 23, 59, 59.999}), turbidity.at({2026, 1, 1, 0, 0, 0}),
              1e-6);
  EXPECT_DOUBLE_EQ(turbidity.at({2026, 1, 1, 0, 0, 0}), 6.5);
}

TEST(Decomposition, CloseAndStayPositive) {
  for (double elevation_deg = -5; elevation_deg <= 90; elevation_deg += 0.5) {
    for (double ghi = 0; ghi <= 1300; ghi += 50) {
      for (const Irradiance& sky :
           {erbs(ghi, elevation_deg, 1361), disc(ghi, elevation_deg, 1370)}) {
        EXPECT_GE(sky.dni, 0);
        EXPECT_GE(sky.dhi, -1e-9);
        EXPECT_TRUE(std::isfinite(sky.dni));
        if (elevation_deg > 0) {
          EXPECT_NEAR(sky.ghi, sky.dni * std::sin(radians(elevation_deg)) + sky.dhi, 1e-9);
          EXPECT_EQ(sky.ghi, ghi);
        }
      }
    }
  }
}

TEST(Decomposition, ErbsFollowsItsThreeBranches) {
  const auto share = [](double kt) {  // of diffuse light, sun at the zenith
    const Irradiance sky = erbs(kt * 1361, 90, 1361);
    return sky.dhi / sky.ghi;
  };
  EXPECT_NEAR(share(0.1), 1 - 0.09 * 0.1, 1e-12);
  EXPECT_NEAR(share(0.5), 0.9511 - 0.0802 + 1.097 - 2.07975 + 0.771, 1e-12);
  EXPECT_NEAR(share(0.9), 0.165, 1e-12);
  // The published polynomial meets its neighbours within its four decimals.
  EXPECT_NEAR(share(0.22 - 1e-9), share(0.22 + 1e-9), 1e-3);
  EXPECT_NEAR(share(0.8 - 1e-9), share(0.8 + 1e-9), 1e-3);
}

TEST(Decomposition, DiscKeepsAnOvercastSkyDiffuseAndAClearOneDirect) {
  EXPECT_LT(disc(100, 60, 1370).dni, 5);
  const Irradiance clear = disc(900, 60, 1370);
  EXPECT_GT(clear.dni, 700);
  EXPECT_LT(clear.dni, 1000);
}

TEST(SkyCondition, MeetsTheReference) {
  const std::string name = "03_sky/perez_eps_delta.csv";
  for (const auto& row : test::read_csv(name)) {
    const double zenith_deg = number(row, "sun_zenith_deg");
    const SkyCondition sky =
        sky_condition(number(row, "dni"), number(row, "dhi"), zenith_deg, number(row, "E0"));
    expect_relative(sky.clearness, number(row, "eps"), 1e-8, "eps");
    expect_relative(relative_air_mass(90 - zenith_deg), number(row, "airmass_kasten_young"), 1e-7,
                    "air mass of 7 decimals");
    expect_relative(sky.brightness, number(row, "Delta_ky"), 1e-8, "Delta");
  }
}

TEST(SkyCondition, HasABinForEverything) {
  EXPECT_EQ(clearness_bin(1), 0u);
  EXPECT_EQ(clearness_bin(1.065), 1u);
  EXPECT_EQ(clearness_bin(6.2), 7u);
  EXPECT_EQ(sky_condition(0, 0, 30, 1361).bin, 0u);
  EXPECT_EQ(sky_condition(500, 0, 30, 1361).bin, 7u);
}

TEST(LuminousEfficacy, FollowsTheTables) {
  // Bin 5 (1.95 … 2.8), Delta = 0.2, water 2 cm, zenith 60°, by hand from the rows.
  const SkyCondition sky{2.2, 0.2, 4};
  const LuminousEfficacy lm_per_w = luminous_efficacy(sky, 60, 2);
  const double log_delta = std::log(0.2);
  EXPECT_NEAR(lm_per_w.global, 86.73 + 1.96 + 3.55 - 10.94 * log_delta, 1e-9);
  EXPECT_NEAR(lm_per_w.diffuse, 100.71 + 11.88 - 11.375 - 23.74 * log_delta, 1e-9);
  EXPECT_NEAR(lm_per_w.beam, 106.36 - 7.94 - 1.75 * std::exp(5.73 * pi / 3 - 5) - 1.232, 1e-9);
}

TEST(LuminousEfficacy, IsOfDaylightAndNeverNegative) {
  for (std::size_t bin = 0; bin < 8; ++bin) {
    for (const double zenith_deg : {0.0, 30.0, 60.0, 90.0}) {
      for (const double brightness : {0.0, 0.1, 0.3, 5.0}) {
        const LuminousEfficacy e = luminous_efficacy({1, brightness, bin}, zenith_deg, 1.5);
        // 60 … 250 lm/W is all that daylight through air can have.
        EXPECT_GT(e.global, 60);
        EXPECT_LT(e.global, 250);
        EXPECT_GT(e.diffuse, 60);
        EXPECT_LT(e.diffuse, 250);
        EXPECT_GE(e.beam, 0);
        EXPECT_LT(e.beam, 250);
      }
    }
  }
  EXPECT_NEAR(precipitable_water_cm(10), 1.868, 0.001);
}

}  // namespace
}  // namespace sunload
