// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/geo/sky/sky_quadrature.h"
#include "tests/support/reference.h"

namespace sunload {
namespace {

using test::direction_deg;
using test::number;
using test::plane_irradiance;

constexpr Vec3 zenith{0, 0, 1};
constexpr double dhi = 100;

SkyInput input_with(SkyModel model, double sun_zenith_deg) {
  SkyInput input;
  input.model = model;
  input.dhi = dhi;
  input.sun_zenith_deg = sun_zenith_deg;
  input.sun_direction = enu_direction({0, 90 - sun_zenith_deg});
  return input;
}

Sky cie_sky(int type, double sun_zenith_deg) {
  SkyInput input = input_with(SkyModel::cie_general, sun_zenith_deg);
  input.cie_type = type;
  return Sky(input);
}

Sky preetham_sky(double turbidity, double sun_zenith_deg) {
  SkyInput input = input_with(SkyModel::preetham, sun_zenith_deg);
  input.turbidity = turbidity;
  return Sky(input);
}

// The irradiances that have these parameters of Perez et al.
SkyInput perez_input(double sun_zenith_deg, double clearness, double brightness) {
  SkyInput input = input_with(SkyModel::perez, sun_zenith_deg);
  const double z = radians(sun_zenith_deg);
  input.dhi = brightness * input.extraterrestrial_normal / relative_air_mass(90 - sun_zenith_deg);
  // A clearness on the border of a bin belongs to the upper one, also after rounding.
  input.dni = input.dhi * (clearness * (1 + 1e-12) - 1) * (1 + 1.041 * z * z * z);
  return input;
}

void expect_near_relative(double value, double expected, double tolerance,
                          const std::string& what) {
  test::expect_reference(what, value, expected, tolerance * std::abs(expected));
}

TEST(CieGeneral, RelativeLuminanceMeetsTheReference) {
  const std::string name = "03_sky/cie_general_relative_luminance.csv";
  for (const auto& row : test::read_csv(name)) {
    const Sky sky = cie_sky(std::stoi(row.at("type")), number(row, "sun_zenith_deg"));
    const Vec3 w = direction_deg(number(row, "zenith_deg"), number(row, "azimuth_from_sun_deg"));
    expect_near_relative(sky.radiance(w) / sky.radiance(zenith), number(row, "L_over_Lz"), 1e-8,
                         "type " + row.at("type"));
  }
}

TEST(CieGeneral, IntegralsMeetTheReference) {
  const std::string name = "03_sky/cie_general_integrals.csv";
  for (const auto& row : test::read_csv(name)) {
    const double sun_zenith_deg = number(row, "sun_zenith_deg");
    const Sky sky = cie_sky(std::stoi(row.at("type")), sun_zenith_deg);
    const double at_zenith = sky.radiance(zenith), sun_zenith = radians(sun_zenith_deg);
    const std::string type = "type " + row.at("type");
    // Eight digits are given, hence 1e-7 rather than the 1e-5 that is asked for.
    expect_near_relative(dhi / at_zenith, number(row, "Eh_over_Lz"), 1e-7, type);
    const auto vertical = [&](double facing) {
      return plane_irradiance(sky, sun_zenith, pi / 2, facing) / at_zenith;
    };
    expect_near_relative(vertical(0), number(row, "Ev_facing_sun_over_Lz"), 1e-6, type);
    expect_near_relative(vertical(pi / 2), number(row, "Ev_90_from_sun_over_Lz"), 1e-6, type);
    expect_near_relative(vertical(pi), number(row, "Ev_opposite_over_Lz"), 1e-6, type);
  }
}

TEST(CieGeneral, CoefficientsAreThoseOfTheStandard) {
  const std::string name = "03_sky/cie_general_coefficients.csv";
  for (const auto& row : test::read_csv(name)) {
    const SkyShape shape = cie_sky(std::stoi(row.at("type")), 40).shape();
    EXPECT_EQ(shape.v, number(row, "a"));
    EXPECT_EQ(shape.b, number(row, "b"));
    EXPECT_EQ(shape.c, number(row, "c"));
    EXPECT_EQ(shape.d, number(row, "d"));
    EXPECT_EQ(shape.e, number(row, "e"));
  }
}

TEST(Perez, CoefficientsAreThoseOfThePaper) {
  const std::string name = "03_sky/perez1993_coefficients.csv";
  for (const auto& row : test::read_csv(name)) {
    const auto bin = static_cast<std::size_t>(std::stoi(row.at("bin")) - 1);
    EXPECT_EQ(clearness_bin(number(row, "eps_low")), bin);
    for (const double sun_zenith_deg : {0.0, 50.0, 90.0}) {
      const double z = radians(sun_zenith_deg), delta = 0.3;
      const PerezCoefficients ours =
          perez_coefficients({number(row, "eps_low"), delta, bin}, sun_zenith_deg);
      const auto x = [&row](const char* letter, int i) {
        return number(row, letter + std::to_string(i));
      };
      const auto linear = [&](const char* l) {
        return x(l, 1) + x(l, 2) * z + delta * (x(l, 3) + x(l, 4) * z);
      };
      EXPECT_NEAR(ours.a, linear("a"), 1e-12);
      EXPECT_NEAR(ours.b, linear("b"), 1e-12);
      EXPECT_NEAR(ours.e, linear("e"), 1e-12);
      const bool first = bin == 0;
      const double c =
          first ? std::exp(std::pow(delta * (x("c", 1) + x("c", 2) * z), x("c", 3))) - x("c", 4)
                : linear("c");
      const double d =
          first ? -std::exp(delta * (x("d", 1) + x("d", 2) * z)) + x("d", 3) + delta * x("d", 4)
                : linear("d");
      EXPECT_NEAR(ours.c, c, 1e-12);
      EXPECT_NEAR(ours.d, d, 1e-12);
    }
  }
}

TEST(Perez, SkiesMeetTheReference) {
  const std::string name = "03_sky/perez1993_evaluated.csv";
  for (const auto& row : test::read_csv(name)) {
    const double sun_zenith_deg = number(row, "sun_zenith_deg"), eps = number(row, "eps");
    const double delta = number(row, "Delta");
    const SkyCondition condition{eps, delta, clearness_bin(eps)};
    EXPECT_EQ(condition.bin + 1, static_cast<std::size_t>(std::stoi(row.at("bin"))));
    const PerezCoefficients x = perez_coefficients(condition, sun_zenith_deg);
    // Seven decimals are given.
    test::expect_reference("a", x.a, number(row, "a"), 1e-7);
    test::expect_reference("b", x.b, number(row, "b"), 1e-7);
    test::expect_reference("c", x.c, number(row, "c"), 1e-7);
    test::expect_reference("d", x.d, number(row, "d"), 1e-7);
    test::expect_reference("e", x.e, number(row, "e"), 1e-7);

    const Sky sky(perez_input(sun_zenith_deg, eps, delta));
    const SkyShape& shape = sky.shape();
    const double irradiance = horizontal_integral(shape, sky.sun_direction().z);
    expect_near_relative(irradiance, number(row, "lv_horizontal_integral"), 1e-6, "integral");
    const Vec3 chord = zenith - sky.sun_direction();
    const double lv_zenith = shape.gradation(1) * shape.indicatrix(dot(chord, chord));
    expect_near_relative(lv_zenith, number(row, "lv_zenith"), 1e-6, "zenith");
    const double per_lv = lv_zenith / sky.radiance(zenith);
    expect_near_relative(sky.radiance(direction_deg(40, 60)) * per_lv,
                         number(row, "lv_zeta40_az60"), 1e-6, "point");
    const double horizontal = irradiance / per_lv, sun_zenith = radians(sun_zenith_deg);
    expect_near_relative(sky.radiance(zenith) / horizontal, number(row, "Lz_over_Eh"), 1e-6,
                         "zenith");
    expect_near_relative(plane_irradiance(sky, sun_zenith, pi / 2, 0) / horizontal,
                         number(row, "Ev_facing_over_Eh"), 2e-6, "six decimals");
    expect_near_relative(plane_irradiance(sky, sun_zenith, pi / 2, pi) / horizontal,
                         number(row, "Ev_opposite_over_Eh"), 2e-6, "six decimals");
  }
}

// Between the bounds of bins 2 to 5 a darker sky counts as one of brightness 0.2.
TEST(Perez, RaisesLowBrightnessInIntermediateSkies) {
  for (const double eps : {1.066, 1.3, 1.7, 2.79}) {
    const std::size_t bin = clearness_bin(eps);
    EXPECT_EQ(perez_coefficients({eps, 0.05, bin}, 50).b,
              perez_coefficients({eps, 0.2, bin}, 50).b);
  }
  for (const double eps : {1.0, 1.065, 2.8, 7.0}) {
    const std::size_t bin = clearness_bin(eps);
    EXPECT_NE(perez_coefficients({eps, 0.05, bin}, 50).b,
              perez_coefficients({eps, 0.2, bin}, 50).b);
  }
}

TEST(Preetham, MeetsTheReference) {
  for (const auto& row : test::read_csv("03_sky/preetham_relative.csv")) {
    const Sky sky = preetham_sky(number(row, "turbidity"), number(row, "sun_zenith_deg"));
    const Vec3 w = direction_deg(number(row, "zenith_deg"), number(row, "azimuth_from_sun_deg"));
    expect_near_relative(sky.radiance(w) / sky.radiance(zenith), number(row, "Y_over_Yz"), 1e-8,
                         "Y");
  }
  for (const auto& row : test::read_csv("03_sky/preetham_zenith.csv")) {
    expect_near_relative(
        preetham_zenith_luminance_kcd(number(row, "turbidity"), number(row, "sun_zenith_deg")),
        number(row, "Yz_kcd_m2"), 1e-8, "zenith");
  }
  for (const auto& row : test::read_csv("03_sky/preetham_integrals.csv")) {
    const double turbidity = number(row, "turbidity");
    const double sun_zenith_deg = number(row, "sun_zenith_deg");
    const Sky sky = preetham_sky(turbidity, sun_zenith_deg);
    const double integral = dhi / sky.radiance(zenith);
    expect_near_relative(integral, number(row, "Eh_over_Yz"), 1e-6, "integral");
    expect_near_relative(integral * preetham_zenith_luminance_kcd(turbidity, sun_zenith_deg),
                         number(row, "Eh_klx"), 1e-6, "illuminance");
    expect_near_relative(preetham_illuminance_klx(turbidity, sun_zenith_deg), number(row, "Eh_klx"),
                         1e-6, "illuminance");
  }
}

TEST(TraditionalSkies, MeetTheReference) {
  const auto table = test::read_json("03_sky/traditional_skies.json");
  const Sky overcast(input_with(SkyModel::cie_overcast, 50));
  // The table's formula has the rounded 0.274 where L/Lz needs 1 - exp(-0.32).
  const double rounding = (1 - std::exp(-0.32)) / 0.274;
  int checked = 0;
  for (const auto& entry : table.at("cases")) {
    const auto& in = entry.at("inputs");
    const auto& expected = entry.at("expected");
    const std::string kind = in.at("sky"), id = entry.at("id");
    const double tolerance = number(entry.at("tol_rel"));
    if (kind == "moon_spencer" && in.contains("tilt_deg")) {
      const double ratio = plane_irradiance(overcast, 1, radians(number(in["tilt_deg"])), 0) / dhi;
      // Below 1e-12 the reference is rounding.
      EXPECT_NEAR(ratio, number(expected["ratio_to_horizontal"]), tolerance) << id;
    } else if (kind == "moon_spencer") {
      expect_near_relative(dhi / overcast.radiance(zenith), number(expected["Eh_over_Lz"]),
                           tolerance, id);
    } else if (kind == "uniform") {
      const Sky uniform(input_with(SkyModel::uniform, 50));
      expect_near_relative(dhi / uniform.radiance(zenith), pi, tolerance, id);
      for (const double tilt : {0.3, 1.0, pi / 2, 2.5}) {
        EXPECT_NEAR(plane_irradiance(uniform, 1, tilt, 0) / dhi, (1 + std::cos(tilt)) / 2, 1e-10);
      }
    } else {
      const double sun_zenith_deg = number(in["sun_zenith_deg"]);
      const Sky sky(input_with(SkyModel::cie_clear, sun_zenith_deg));
      const double at_zenith = sky.radiance(zenith) / rounding;
      if (expected.contains("L_over_Lz")) {
        const Vec3 w = direction_deg(number(in["zenith_deg"]), number(in["azimuth_from_sun_deg"]));
        expect_near_relative(sky.radiance(w) / at_zenith, number(expected["L_over_Lz"]), tolerance,
                             id);
      } else {
        const double sun_zenith = radians(sun_zenith_deg);
        expect_near_relative(dhi / at_zenith, number(expected["Eh_over_Lz"]), tolerance, id);
        expect_near_relative(plane_irradiance(sky, sun_zenith, pi / 2, 0) / at_zenith,
                             number(expected["Ev_facing_over_Lz"]), tolerance, id);
        expect_near_relative(plane_irradiance(sky, sun_zenith, pi / 2, pi / 2) / at_zenith,
                             number(expected["Ev_side_over_Lz"]), tolerance, id);
        expect_near_relative(plane_irradiance(sky, sun_zenith, pi / 2, pi) / at_zenith,
                             number(expected["Ev_opposite_over_Lz"]), tolerance, id);
      }
    }
    ++checked;
  }
  EXPECT_EQ(checked, 21);
}

// Every model with parameters up to the edges of its range, and beyond what occurs.
std::vector<SkyInput> all_kinds_of_sky(double sun_zenith_deg) {
  std::vector<SkyInput> inputs;
  const auto base = [&](SkyModel model) { return input_with(model, sun_zenith_deg); };
  for (const auto model : {SkyModel::uniform, SkyModel::cie_overcast, SkyModel::cie_clear}) {
    inputs.push_back(base(model));
  }
  for (int type = 1; type <= 15; ++type) {
    inputs.push_back(base(SkyModel::cie_general));
    inputs.back().cie_type = type;
  }
  for (const double turbidity : {1.0, 1.2, 2.0, 5.0, 10.0, 20.0}) {
    inputs.push_back(base(SkyModel::preetham));
    inputs.back().turbidity = turbidity;
  }
  for (const double diffuse : {1e-300, 1e-3, 5.0, 40.0, 120.0, 400.0, 900.0}) {
    for (const double direct : {0.0, 1e-6, 10.0, 80.0, 300.0, 700.0, 1400.0}) {
      inputs.push_back(base(SkyModel::perez));
      inputs.back().dhi = diffuse;
      inputs.back().dni = direct;
    }
  }
  inputs.push_back(base(SkyModel::perez));
  inputs.back().extraterrestrial_normal = 0;
  return inputs;
}

TEST(Sky, IsFiniteAndNotNegativeAboveTheHorizonAndDarkBelow) {
  for (const double sun_zenith_deg : {0.0, 1e-6, 20.0, 60.0, 89.0, 89.9999, 90.0}) {
    for (const SkyInput& input : all_kinds_of_sky(sun_zenith_deg)) {
      const Sky sky(input);
      for (int zenith_deg = 0; zenith_deg <= 90; zenith_deg += 3) {
        for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
          Vec3 w = direction_deg(zenith_deg, azimuth_deg);
          if (zenith_deg == 90) w.z = 0;
          const double radiance = sky.radiance(w);
          ASSERT_TRUE(std::isfinite(radiance) && radiance >= 0)
              << static_cast<int>(input.model) << " sun " << sun_zenith_deg;
          if (w.z > 0) {
            ASSERT_EQ(sky.radiance(-w), 0);
          }
        }
      }
      ASSERT_GE(sky.radiance(sky.sun_direction()), 0);
      ASSERT_GE(sky.radiance({0, 0, 1}), 0);
      ASSERT_GE(sky.radiance({1, 0, 1e-300}), 0);
    }
  }
}

TEST(Sky, MeetsItsHorizontalIrradiance) {
  double worst = 0;
  for (const double sun_zenith_deg : {0.0, 0.01, 5.0, 30.0, 60.0, 85.0, 89.5, 90.0}) {
    for (const SkyInput& input : all_kinds_of_sky(sun_zenith_deg)) {
      const Sky sky(input);
      const double found = test::horizontal_irradiance(sky);
      worst = std::max(worst, std::abs(found / input.dhi - 1));
    }
  }
  RecordProperty("worst_relative_error", std::to_string(worst * 1e9) + "e-9");
  EXPECT_LT(worst, 1e-6);  // the contract of Sky
  EXPECT_LT(worst, 2e-7);  // what horizontal_integral states
}

// The test above would see a quadrature that is wrong by a hundredth of the sky's cusp.
TEST(Sky, QuadratureTestSeesAPlantedFault) {
  SkyInput input = input_with(SkyModel::cie_general, 60);
  input.dhi *= 1 + 1e-6;
  const double found = test::horizontal_irradiance(Sky(input));
  EXPECT_GT(std::abs(found / dhi - 1), 2e-7);
}

TEST(Sky, WithoutDiffuseLightIsDark) {
  for (SkyInput input : all_kinds_of_sky(40)) {
    input.dhi = 0;
    const Sky sky(input);
    EXPECT_EQ(sky.radiance(zenith), 0);
    EXPECT_EQ(sky.radiance(input.sun_direction), 0);
  }
}

TEST(Sky, TurnsWithTheSun) {
  SkyInput input = input_with(SkyModel::perez, 55);
  input.dni = 400;
  const Sky north(input);
  input.sun_direction = enu_direction({123, 35});
  const Sky turned(input);
  for (const double azimuth_deg : {0.0, 10.0, 100.0, 250.0}) {
    const double a = north.radiance(enu_direction({azimuth_deg, 20}));
    expect_near_relative(turned.radiance(enu_direction({azimuth_deg + 123, 20})), a, 1e-13, "");
  }
}

TEST(Sky, SunBelowTheHorizonActsFromTheHorizon) {
  SkyInput input = input_with(SkyModel::perez, 90);
  input.sun_direction = enu_direction({70, 0});
  const Sky level(input);
  input.sun_direction = enu_direction({70, -10});
  const Sky twilight(input);
  const Vec3 w = enu_direction({50, 25});
  expect_near_relative(twilight.radiance(w), level.radiance(w), 1e-12, "");
  input.sun_direction = {0, 0, -1};
  EXPECT_TRUE(std::isfinite(Sky(input).radiance(w)));
}

TEST(Sky, RefusesWhatHasNoMeaning) {
  const auto with = [](auto change) {
    SkyInput input = input_with(SkyModel::perez, 30);
    change(input);
    return input;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<SkyInput> wrong{
      with([nan](SkyInput& i) { i.dhi = nan; }),
      with([](SkyInput& i) { i.dhi = -1; }),
      with([nan](SkyInput& i) { i.dni = nan; }),
      with([](SkyInput& i) { i.dni = std::numeric_limits<double>::infinity(); }),
      with([](SkyInput& i) { i.sun_zenith_deg = 91; }),
      with([nan](SkyInput& i) { i.sun_direction.x = nan; }),
      with([](SkyInput& i) {
        i.sun_direction = {0, 0, 2};
      }),
      with([](SkyInput& i) { i.model = SkyModel::cie_general, i.cie_type = 0; }),
      with([](SkyInput& i) { i.model = SkyModel::cie_general, i.cie_type = 16; }),
      with([nan](SkyInput& i) { i.model = SkyModel::preetham, i.turbidity = nan; }),
      with([](SkyInput& i) { i.model = SkyModel::preetham, i.turbidity = 21; })};
  for (const SkyInput& input : wrong) EXPECT_THROW(Sky{input}, std::logic_error);
}

}  // namespace
}  // namespace sunload
