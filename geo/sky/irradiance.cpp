// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/irradiance.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {

namespace {

double sine_of_elevation(double elevation_deg) { return std::sin(radians(elevation_deg)); }

double days_in_month(int year, unsigned month) {
  const std::chrono::year_month_day_last last{
      std::chrono::year{year}, std::chrono::month_day_last{std::chrono::month{month}}};
  return static_cast<double>(static_cast<unsigned>(last.day()));
}

// Value of c0 + c1·x + c2·x² + …
template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double sum = 0;
  for (std::size_t i = N; i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

}  // namespace

double Turbidity::at(const CivilTime& date) const {
  const auto month = static_cast<unsigned>(date.month - 1);
  const auto length = [&](unsigned m) { return days_in_month(date.year, m % 12 + 1); };
  const double hours = date.hour + date.minute / 60.0 + date.second / seconds_per_hour;
  const double day = date.day - 1 + hours / 24;  // since the month began
  const double past_middle = day - length(month) / 2;
  const unsigned other = past_middle < 0 ? (month + 11) % 12 : (month + 1) % 12;
  const double between_middles = (length(month) + length(other)) / 2;
  return std::lerp(monthly[month], monthly[other], std::abs(past_middle) / between_middles);
}

double extraterrestrial(double distance_au, double constant) {
  return constant / (distance_au * distance_au);
}

double relative_air_mass(double elevation_deg) {
  // Kasten & Young (1989), Applied Optics 28, eq. 3 and table II.
  const double elevation = std::clamp(elevation_deg, 0.0, 90.0);
  return 1 / (sine_of_elevation(elevation) + 0.50572 * std::pow(elevation + 6.07995, -1.6364));
}

double absolute_air_mass(double relative, double pressure_pa) {
  return relative * pressure_pa / sea_level_pressure_pa;
}

double standard_pressure(double elevation_m) {
  const double base = std::max(0.0, (44331.514 - elevation_m) / 11880.516);
  return 100 * std::pow(base, 1 / 0.1902632);
}

Irradiance ineichen(const IneichenInput& input) {
  if (input.elevation_deg <= 0) return {};
  const double sine = sine_of_elevation(input.elevation_deg);
  const double m = input.absolute_air_mass;
  const double linke = input.linke_turbidity;
  // Altitude corrections f_h1, f_h2 of Kasten (1984) and c_g1, c_g2 of the paper.
  const double f_h1 = std::exp(-input.elevation_m / 8000);
  const double f_h2 = std::exp(-input.elevation_m / 1250);
  const double c_g1 = 5.09e-5 * input.elevation_m + 0.868;
  const double c_g2 = 3.92e-5 * input.elevation_m + 0.0387;

  Irradiance sky;
  const double enhancement =
      input.enhancement == PerezEnhancement::on ? std::exp(0.01 * std::pow(m, 1.8)) : 1;
  sky.ghi = c_g1 * input.extraterrestrial_normal * sine *
            std::exp(-c_g2 * m * (f_h1 + f_h2 * (linke - 1))) * enhancement;

  const double b = 0.664 + 0.163 / f_h1;
  const double beam = b * input.extraterrestrial_normal * std::exp(-0.09 * m * (linke - 1));
  // Direct light may not exceed what the global irradiance leaves for it, nor (in clean air
  // on high mountains, where the fit ends) what comes from the sun.
  const double largest_share = 1 - (0.1 - 0.2 * std::exp(-linke)) / (0.1 + 0.882 / f_h1);
  sky.dni = std::min(
      {beam, sky.ghi * std::max(0.0, largest_share) / sine, input.extraterrestrial_normal});
  sky.dhi = sky.ghi - sky.dni * sine;
  return sky;
}

Irradiance bird(const BirdInput& input) {
  if (input.elevation_deg <= 0) return {};
  const double sine = sine_of_elevation(input.elevation_deg);
  const double m = input.relative_air_mass;
  const double m_pressure = absolute_air_mass(m, input.pressure_pa);
  const double depth = input.broadband_aerosol_depth;

  // The fit's extinction is largest here and turns negative at 27: suns below 4° are taken
  // as this thick.
  constexpr double thickest_rayleigh = 14;
  const double m_r = std::min(m_pressure, thickest_rayleigh);
  const double t_rayleigh =
      std::exp(-0.0903 * std::pow(m_r, 0.84) * (1 + m_r - std::pow(m_r, 1.01)));
  const double ozone = input.ozone_atm_cm * m;
  const double t_ozone = 1 - 0.1611 * ozone * std::pow(1 + 139.48 * ozone, -0.3034) -
                         0.002715 * ozone / (1 + 0.044 * ozone + 0.0003 * ozone * ozone);
  const double t_gases = std::exp(-0.0127 * std::pow(m_pressure, 0.26));
  const double water = input.precipitable_water_cm * m;
  const double t_water =
      1 - 2.4959 * water / (std::pow(1 + 79.034 * water, 0.6828) + 6.385 * water);
  const double t_aerosol = std::exp(-std::pow(depth, 0.873) *
                                    (1 + depth - std::pow(depth, 0.7088)) * std::pow(m, 0.9108));
  // Absorption alone cannot take more than absorption and scattering: at the horizon in
  // thick air the fit would.
  const double t_absorbed =
      std::max(t_aerosol, 1 - 0.1 * (1 - m + std::pow(m, 1.06)) * (1 - t_aerosol));
  const double scattered = 1 - t_aerosol / t_absorbed;
  const double sky_albedo = 0.0685 + (1 - input.asymmetry) * scattered;

  Irradiance sky;
  sky.dni =
      0.9662 * input.extraterrestrial_normal * t_aerosol * t_water * t_gases * t_ozone * t_rayleigh;
  const double diffuse = input.extraterrestrial_normal * sine * 0.79 * t_ozone * t_gases * t_water *
                         t_absorbed * (0.5 * (1 - t_rayleigh) + input.asymmetry * scattered) /
                         (1 - m + std::pow(m, 1.02));
  sky.ghi = (sky.dni * sine + diffuse) / (1 - input.ground_albedo * sky_albedo);
  sky.dhi = sky.ghi - sky.dni * sine;
  return sky;
}

double broadband_aerosol_depth(double depth_380nm, double depth_500nm) {
  return 0.27583 * depth_380nm + 0.35 * depth_500nm;
}

double broadband_aerosol_depth_from_linke(double linke_turbidity, double precipitable_water_cm) {
  const double m = 2;  // the air mass that Linke turbidity is usually stated for
  const double clean_dry_air = -0.101 + 0.235 * std::pow(m, -0.16);
  const double water = 0.112 * std::pow(m, -0.55) * std::pow(precipitable_water_cm, 0.34);
  return std::max(0.0, linke_turbidity / (9.4 + 0.9 * m) - clean_dry_air - water);
}

double haurwitz(double elevation_deg) {
  if (elevation_deg <= 0) return 0;
  const double sine = sine_of_elevation(elevation_deg);
  return 1098 * sine * std::exp(-0.059 / sine);
}

Irradiance clear_sky(ClearSkyModel model, const ClearSkyInput& input) {
  SUNLOAD_EXPECT(std::isfinite(input.elevation_deg) && std::isfinite(input.elevation_m) &&
                     input.linke_turbidity > 0 && input.extraterrestrial_normal >= 0,
                 "clear sky needs finite elevations and positive turbidity");
  if (input.elevation_deg <= 0) return {};
  const double air_mass = relative_air_mass(input.elevation_deg);
  const double pressure = standard_pressure(input.elevation_m);
  switch (model) {
    case ClearSkyModel::ineichen:
      return ineichen({input.elevation_deg, absolute_air_mass(air_mass, pressure),
                       input.linke_turbidity, input.elevation_m, input.extraterrestrial_normal,
                       PerezEnhancement::off});
    case ClearSkyModel::bird: {
      BirdInput air;  // typical water and ozone; the aerosol from the turbidity
      air.elevation_deg = input.elevation_deg;
      air.relative_air_mass = air_mass;
      air.pressure_pa = pressure;
      air.extraterrestrial_normal = input.extraterrestrial_normal;
      air.broadband_aerosol_depth =
          broadband_aerosol_depth_from_linke(input.linke_turbidity, air.precipitable_water_cm);
      return bird(air);
    }
    case ClearSkyModel::haurwitz:
      return erbs(haurwitz(input.elevation_deg), input.elevation_deg,
                  input.extraterrestrial_normal);
  }
  SUNLOAD_EXPECT(false, "unknown clear-sky model");
}

namespace {

// Sines of lower suns count as this where irradiance is divided by them, and no direct
// light is derived below this elevation: both correlations fail at the horizon.
constexpr double smallest_sine = 0.065;
constexpr double lowest_elevation_deg = 3;

double clearness_index(double ghi, double elevation_deg, double extraterrestrial_normal) {
  const double sine = std::max(sine_of_elevation(elevation_deg), smallest_sine);
  return extraterrestrial_normal > 0 ? std::max(0.0, ghi) / (sine * extraterrestrial_normal) : 0;
}

// Closure: what is not diffuse is direct, within what comes from the sun.
Irradiance closed(double ghi, double dni, double elevation_deg) {
  if (elevation_deg < lowest_elevation_deg || dni < 0) dni = 0;
  const double sine = sine_of_elevation(elevation_deg);
  dni = std::min(dni, ghi / sine);
  return {dni, ghi - dni * sine, ghi};
}

}  // namespace

Irradiance erbs(double ghi, double elevation_deg, double extraterrestrial_normal) {
  if (elevation_deg <= 0 || ghi <= 0) return {};
  const double kt = clearness_index(ghi, elevation_deg, extraterrestrial_normal);
  double diffuse_share = 0.165;
  if (kt <= 0.22) {
    diffuse_share = 1 - 0.09 * kt;
  } else if (kt <= 0.8) {
    diffuse_share = polynomial<5>({0.9511, -0.1604, 4.388, -16.638, 12.336}, kt);
  }
  return closed(ghi, ghi * (1 - diffuse_share) / sine_of_elevation(elevation_deg), elevation_deg);
}

Irradiance disc(double ghi, double elevation_deg, double extraterrestrial_normal,
                double pressure_pa) {
  if (elevation_deg <= 0 || ghi <= 0) return {};
  const double kt = std::min(1.0, clearness_index(ghi, elevation_deg, extraterrestrial_normal));
  // Kasten (1966), as in the report; its limit of 12 as in the report's program.
  const double relative =
      1 / (sine_of_elevation(elevation_deg) + 0.15 * std::pow(elevation_deg + 3.885, -1.253));
  const double m = std::min(12.0, absolute_air_mass(relative, pressure_pa));
  const bool cloudy = kt <= 0.6;
  const double a = cloudy ? polynomial<4>({0.512, -1.56, 2.286, -2.222}, kt)
                          : polynomial<4>({-5.743, 21.77, -27.49, 11.56}, kt);
  const double b =
      cloudy ? polynomial<2>({0.37, 0.962}, kt) : polynomial<4>({41.4, -118.5, 66.05, 31.9}, kt);
  const double c = cloudy ? polynomial<3>({-0.28, 0.932, -2.048}, kt)
                          : polynomial<4>({-47.01, 184.2, -222.0, 73.81}, kt);
  const double clear = polynomial<5>({0.866, -0.122, 0.0121, -0.000653, 1.4e-5}, m);
  const double kn = clear - (a + b * std::exp(c * m));
  return closed(ghi, kn * extraterrestrial_normal, elevation_deg);
}

namespace {

constexpr std::array<double, 7> clearness_bounds{1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};

struct EfficacyRow {
  double a, b, c, d;
};
// Table 4 of Perez et al. (1990), one row per clearness bin.
constexpr std::array<EfficacyRow, 8> global_efficacy{{{96.63, -0.47, 11.50, -9.16},
                                                      {107.54, 0.79, 1.79, -1.19},
                                                      {98.73, 0.70, 4.40, -6.95},
                                                      {92.72, 0.56, 8.36, -8.31},
                                                      {86.73, 0.98, 7.10, -10.94},
                                                      {88.34, 1.39, 6.06, -7.60},
                                                      {78.63, 1.47, 4.93, -11.37},
                                                      {99.65, 1.86, -4.46, -3.15}}};
constexpr std::array<EfficacyRow, 8> diffuse_efficacy{{{97.24, -0.46, 12.00, -8.91},
                                                       {107.22, 1.15, 0.59, -3.95},
                                                       {104.97, 2.96, -5.53, -8.77},
                                                       {102.39, 5.59, -13.95, -13.90},
                                                       {100.71, 5.94, -22.75, -23.74},
                                                       {106.42, 3.83, -36.15, -28.83},
                                                       {141.88, 1.90, -53.24, -14.03},
                                                       {152.23, 0.35, -45.27, -7.98}}};
constexpr std::array<EfficacyRow, 8> beam_efficacy{{{57.20, -4.55, -2.98, 117.12},
                                                    {98.99, -3.46, -1.21, 12.38},
                                                    {109.83, -4.90, -1.71, -8.81},
                                                    {110.34, -5.84, -1.99, -4.56},
                                                    {106.36, -3.97, -1.75, -6.16},
                                                    {107.19, -1.25, -1.51, -26.73},
                                                    {105.75, 0.77, -1.26, -34.44},
                                                    {101.18, 1.58, -1.10, -8.29}}};

}  // namespace

std::size_t clearness_bin(double clearness) {
  const auto bound = std::upper_bound(clearness_bounds.begin(), clearness_bounds.end(), clearness);
  return static_cast<std::size_t>(bound - clearness_bounds.begin());
}

SkyCondition sky_condition(double dni, double dhi, double sun_zenith_deg,
                           double extraterrestrial_normal) {
  const double zenith = radians(sun_zenith_deg);
  const double k = 1.041 * zenith * zenith * zenith;  // removes the zenith dependence
  SkyCondition sky;
  // dni/dhi overflows to infinity without diffuse light, 0/0 counts as overcast.
  sky.clearness = dni > 0 ? (1 + dni / dhi + k) / (1 + k) : 1;
  sky.brightness = extraterrestrial_normal > 0
                       ? dhi * relative_air_mass(90 - sun_zenith_deg) / extraterrestrial_normal
                       : 0;
  sky.bin = clearness_bin(sky.clearness);
  return sky;
}

LuminousEfficacy luminous_efficacy(const SkyCondition& sky, double sun_zenith_deg,
                                   double precipitable_water_cm) {
  // Brightness of the paper's data, without which the logarithm has no bound.
  const double brightness = std::clamp(sky.brightness, 0.01, 0.6);
  const double zenith = radians(sun_zenith_deg), water = precipitable_water_cm;
  const auto horizontal = [&](const EfficacyRow& row) {
    return std::max(
        0.0, row.a + row.b * water + row.c * std::cos(zenith) + row.d * std::log(brightness));
  };
  const EfficacyRow& beam = beam_efficacy[sky.bin];
  return {horizontal(global_efficacy[sky.bin]),
          std::max(0.0, beam.a + beam.b * water + beam.c * std::exp(5.73 * zenith - 5) +
                            beam.d * brightness),
          horizontal(diffuse_efficacy[sky.bin])};
}

double precipitable_water_cm(double dew_point_c) { return std::exp(0.07 * dew_point_c - 0.075); }

}  // namespace sunload
