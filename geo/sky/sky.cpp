// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients of the sky models. Notation of the papers: a … e, theta, gamma, epsilon,
// Delta, T (turbidity).
#include "geo/sky/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geo/base/check.h"
#include "geo/sky/kittler.h"

namespace sunload {

namespace {

struct CieRow {
  double a, b, c, d, e;
};
// ISO 15469:2004 / CIE S 011, standard parameters of the types 1 … 15.
constexpr std::array<CieRow, 15> cie_rows{{{4, -0.7, 0, -1, 0},
                                           {4, -0.7, 2, -1.5, 0.15},
                                           {1.1, -0.8, 0, -1, 0},
                                           {1.1, -0.8, 2, -1.5, 0.15},
                                           {0, -1, 0, -1, 0},
                                           {0, -1, 2, -1.5, 0.15},
                                           {0, -1, 5, -2.5, 0.3},
                                           {0, -1, 10, -3, 0.45},
                                           {-1, -0.55, 2, -1.5, 0.15},
                                           {-1, -0.55, 5, -2.5, 0.3},
                                           {-1, -0.55, 10, -3, 0.45},
                                           {-1, -0.32, 10, -3, 0.45},
                                           {-1, -0.32, 16, -3, 0.3},
                                           {-1, -0.15, 16, -3, 0.3},
                                           {-1, -0.15, 24, -2.8, 0.15}}};

struct PerezRow {
  std::array<double, 4> a, b, c, d, e;
};
// Perez, Seals & Michalsky (1993), table 1, one row per clearness bin.
constexpr std::array<PerezRow, 8> perez_rows{{
    {{1.3525, -0.2576, -0.2690, -1.4366},
     {-0.7670, 0.0007, 1.2734, -0.1233},
     {2.8000, 0.6004, 1.2375, 1.0000},
     {1.8734, 0.6297, 0.9738, 0.2809},
     {0.0356, -0.1246, -0.5718, 0.9938}},
    {{-1.2219, -0.7730, 1.4148, 1.1016},
     {-0.2054, 0.0367, -3.9128, 0.9156},
     {6.9750, 0.1774, 6.4477, -0.1239},
     {-1.5798, -0.5081, -1.7812, 0.1080},
     {0.2624, 0.0672, -0.2190, -0.4285}},
    {{-1.1000, -0.2515, 0.8952, 0.0156},
     {0.2782, -0.1812, -4.5000, 1.1766},
     {24.7219, -13.0812, -37.7000, 34.8438},
     {-5.0000, 1.5218, 3.9229, -2.6204},
     {-0.0156, 0.1597, 0.4199, -0.5562}},
    {{-0.5484, -0.6654, -0.2672, 0.7117},
     {0.7234, -0.6219, -5.6812, 2.6297},
     {33.3389, -18.3000, -62.2500, 52.0781},
     {-3.5000, 0.0016, 1.1477, 0.1062},
     {0.4659, -0.3296, -0.0876, -0.0329}},
    {{-0.6000, -0.3566, -2.5000, 2.3250},
     {0.2937, 0.0496, -5.6812, 1.8415},
     {21.0000, -4.7656, -21.5906, 7.2492},
     {-3.5000, -0.1554, 1.4062, 0.3988},
     {0.0032, 0.0766, -0.0656, -0.1294}},
    {{-1.0156, -0.3670, 1.0078, 1.4051},
     {0.2875, -0.5328, -3.8500, 3.3750},
     {14.0000, -0.9999, -7.1406, 7.5469},
     {-3.4000, -0.1078, -1.0750, 1.5702},
     {-0.0672, 0.4016, 0.3017, -0.4844}},
    {{-1.0000, 0.0211, 0.5025, -0.5119},
     {-0.3000, 0.1922, 0.7023, -1.6317},
     {19.0000, -5.0000, 1.2438, -1.9094},
     {-4.0000, 0.0250, 0.3844, 0.2656},
     {1.0468, -0.3788, -2.4517, 1.4656}},
    {{-1.0500, 0.0289, 0.4260, 0.3590},
     {-0.3250, 0.1156, 0.7781, 0.0025},
     {31.0625, -14.5000, -46.1148, 55.3750},
     {-7.2312, 0.4050, 13.3500, 0.6234},
     {1.5000, -0.6426, 1.8564, 0.5636}},
}};

// (1 + a·exp(b/cosθ))·(1 + c·exp(dγ) + e·cos²γ), kept from turning negative outside of the
// conditions that the fits were made for:
// - brighter towards the horizon without bound (a > 0, b > 0): b = 0;
// - a < 0: the least gradation is at the zenith for b < 0, hence a ≥ -exp(-b); with b → 0
//   it tends to 1/cosθ - 1, what a thin atmosphere shows, which the bound on b keeps;
// - a darker ring about the sun (c < 0) and e < -1 do not occur in nature.
// 1/cosθ is limited to 100, as Radiance's perezlum.cal has it.
SkyShape bounded(const PerezCoefficients& raw) {
  constexpr double thin_atmosphere = -0.01;
  constexpr double cos_floor = 0.01;
  SkyShape shape;
  shape.b = std::min(raw.b, raw.a < 0 ? thin_atmosphere : 0.0);
  shape.v = std::max(raw.a, -std::exp(-shape.b));
  shape.c = std::max(raw.c, 0.0);
  shape.d = raw.d;
  shape.e = std::max(raw.e, -1.0);
  shape.cos_floor = cos_floor;
  return shape;
}

SkyShape cie_general(int type) {
  SUNLOAD_EXPECT(type >= 1 && type <= 15, "types of the CIE general sky are 1 … 15");
  const CieRow& row = cie_rows[static_cast<std::size_t>(type - 1)];
  SkyShape shape;
  shape.v = row.a;
  shape.b = row.b;
  shape.f = 1 - row.c * std::exp(row.d * pi / 2);
  shape.c = row.c;
  shape.d = row.d;
  shape.e = row.e;
  return shape;
}

// Moon & Spencer (1942).
SkyShape cie_overcast() {
  SkyShape shape;
  shape.u = 1.0 / 3;
  shape.s = 2.0 / 3;
  return shape;
}

// Luminance distribution, Preetham, Shirley & Smits (1999), appendix A.2.
SkyShape preetham(double turbidity) {
  // Beyond, the linear coefficients mean nothing, and exp(dγ) has no bound.
  SUNLOAD_EXPECT(turbidity >= 1 && turbidity <= 20, "turbidity of a Preetham sky is 1 … 20");
  const double T = turbidity;
  return bounded({0.1787 * T - 1.4630, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251,
                  0.1206 * T - 2.5771, -0.0670 * T + 0.3703});
}

SkyShape shape_of(const SkyInput& input) {
  switch (input.model) {
    case SkyModel::uniform:
      return {};
    case SkyModel::cie_overcast:
      return cie_overcast();
    case SkyModel::cie_clear:
      return kittler_clear_sky();
    case SkyModel::cie_general:
      return cie_general(input.cie_type);
    case SkyModel::perez: {
      const SkyCondition sky =
          sky_condition(input.dni, input.dhi, input.sun_zenith_deg, input.extraterrestrial_normal);
      return bounded(perez_coefficients(sky, input.sun_zenith_deg));
    }
    case SkyModel::preetham:
      return preetham(input.turbidity);
  }
  SUNLOAD_EXPECT(false, "unknown sky model");
}

// The sun itself, or the point of the horizon above it (north for one at the nadir).
Vec3 raised_to_horizon(Vec3 sun) {
  if (sun.z >= 0) return normalized(sun);
  const double length = std::hypot(sun.x, sun.y);
  return length > 0 ? Vec3{sun.x / length, sun.y / length, 0} : Vec3{0, 1, 0};
}

void expect_sound(const SkyInput& input) {
  const auto at_least_zero = [](double x) { return std::isfinite(x) && x >= 0; };
  SUNLOAD_EXPECT(at_least_zero(input.dhi) && at_least_zero(input.dni) &&
                     at_least_zero(input.extraterrestrial_normal),
                 "irradiances of a sky are finite and not negative");
  SUNLOAD_EXPECT(at_least_zero(input.sun_zenith_deg) && input.sun_zenith_deg <= 90,
                 "the zenith angle of a sky's sun is within [0, 90]");
  // Loose enough for directions that went through single precision.
  constexpr double unit_tolerance = 1e-5;
  SUNLOAD_EXPECT(std::abs(norm(input.sun_direction) - 1) < unit_tolerance,
                 "the direction to the sun has unit length");
}

}  // namespace

PerezCoefficients perez_coefficients(const SkyCondition& sky, double sun_zenith_deg) {
  const double Z = radians(sun_zenith_deg);
  double Delta = std::clamp(sky.brightness, 0.01, 0.6);
  if (sky.clearness > 1.065 && sky.clearness < 2.8) Delta = std::max(Delta, 0.2);

  const PerezRow& row = perez_rows[sky.bin];
  const auto linear = [&](const std::array<double, 4>& x) {
    return x[0] + x[1] * Z + Delta * (x[2] + x[3] * Z);
  };
  PerezCoefficients result{linear(row.a), linear(row.b), linear(row.c), linear(row.d),
                           linear(row.e)};
  if (sky.bin == 0) {
    result.c = std::exp(std::pow(Delta * (row.c[0] + row.c[1] * Z), row.c[2])) - row.c[3];
    result.d = -std::exp(Delta * (row.d[0] + row.d[1] * Z)) + row.d[2] + Delta * row.d[3];
  }
  return result;
}

double preetham_zenith_luminance_kcd(double turbidity, double sun_zenith_deg) {
  const double T = turbidity;
  const double chi = (4.0 / 9 - T / 120) * (pi - 2 * radians(sun_zenith_deg));
  return std::max(0.0, (4.0453 * T - 4.9710) * std::tan(chi) - 0.2155 * T + 2.4192);
}

double illuminance_klx(const SkyInput& sky, double zenith_luminance_kcd) {
  const SkyShape shape = shape_of(sky);
  const Vec3 chord = Vec3{0, 0, 1} - enu_direction({0, 90 - sky.sun_zenith_deg});
  const double at_zenith = shape.gradation(1) * shape.indicatrix(dot(chord, chord));
  return zenith_luminance_kcd / at_zenith *
         horizontal_integral(shape, std::cos(radians(sky.sun_zenith_deg)));
}

double preetham_illuminance_klx(double turbidity, double sun_zenith_deg) {
  return illuminance_klx(
      {.model = SkyModel::preetham, .sun_zenith_deg = sun_zenith_deg, .turbidity = turbidity},
      preetham_zenith_luminance_kcd(turbidity, sun_zenith_deg));
}

RelativeSky relative_sky(const SkyInput& input) {
  expect_sound(input);
  RelativeSky sky{{}, raised_to_horizon(input.sun_direction)};
  if (input.dhi > 0) sky.shape = shape_of(input);
  return sky;
}

Sky::Sky(const SkyInput& input) {
  const RelativeSky sky = relative_sky(input);
  shape_ = sky.shape;
  sun_ = sky.sun;
  if (input.dhi <= 0) return;  // dark
  scale_ = input.dhi / horizontal_integral(shape_, sun_.z);
  SUNLOAD_EXPECT(std::isfinite(scale_), "a sky without any light cannot meet its irradiance");
}

}  // namespace sunload
