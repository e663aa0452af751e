// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Broadband sun and sky irradiance: air mass, clear-sky models, decomposition of
/// global irradiance, luminous efficacy.
///
/// Elevations of the sun are apparent and in degrees; where the sun is not above
/// the horizon every model gives zero. Arguments must be finite.
#pragma once

#include <array>
#include <cstddef>

#include "geo/time/time.h"

namespace sunload {

/// Sun and sky power per area [W m-2].
struct Irradiance {
  double dni = 0;  ///< direct normal
  double dhi = 0;  ///< diffuse horizontal
  double ghi = 0;  ///< global horizontal = dni·sin(elevation) + dhi
};

/// haurwitz gives global irradiance only; `clear_sky` divides it by Erbs.
enum class ClearSkyModel { ineichen, bird, haurwitz };

/// Linke turbidity: one value, or 12 mid-month values, linear between (and from
/// December to January).
struct Turbidity {
  std::array<double, 12> monthly{3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3};
  double at(const CivilTime& date) const;
};

inline constexpr double solar_constant = 1361.0;  ///< W m-2 at 1 au, TSIS-1 / Kopp & Lean (2011)

/// Extraterrestrial normal irradiance at a distance [W m-2]. Older data rest on other
/// values of the constant (1361.1, 1366.1, 1367): pass theirs.
double extraterrestrial(double distance_au, double constant = solar_constant);

/// Relative optical air mass, Kasten & Young (1989), of an apparent elevation
/// [degrees]; below the horizon the value at the horizon (38).
double relative_air_mass(double elevation_deg);

inline constexpr double sea_level_pressure_pa = 101325;

/// Air mass corrected for the pressure at the site.
double absolute_air_mass(double relative, double pressure_pa);

/// Standard-atmosphere pressure [Pa] at an elevation [m], U.S. Standard Atmosphere
/// (1976) in the form of the PV performance modelling collaborative.
double standard_pressure(double elevation_m);

/// Whether the factor exp(0.01 m^1.8) of Perez et al. (2002) raises global irradiance.
enum class PerezEnhancement { off, on };

/// Ineichen & Perez (2002), A new airmass independent formulation for the Linke
/// turbidity coefficient, with the limits on direct light that pvlib documents.
struct IneichenInput {
  double elevation_deg = 0;
  double absolute_air_mass = 1;
  double linke_turbidity = 3;
  double elevation_m = 0;
  double extraterrestrial_normal = solar_constant;
  PerezEnhancement enhancement = PerezEnhancement::off;
};
Irradiance ineichen(const IneichenInput& input);

/// Bird & Hulstrom (1981), SERI/TR-642-761, A simplified clear sky model.
struct BirdInput {
  double elevation_deg = 0;
  double relative_air_mass = 1;
  double pressure_pa = sea_level_pressure_pa;
  double broadband_aerosol_depth = 0.1;
  double precipitable_water_cm = 1.5;
  double ozone_atm_cm = 0.3;
  double asymmetry = 0.85;  ///< share of scattering that goes forward
  double ground_albedo = 0.2;
  double extraterrestrial_normal = solar_constant;
};
Irradiance bird(const BirdInput& input);

/// Broadband aerosol depth from the depths at 380 and 500 nm, Bird & Hulstrom (1980).
double broadband_aerosol_depth(double depth_380nm, double depth_500nm);

/// The same from Linke turbidity at air mass 2, Kasten (1996), eq. for the turbidity as
/// a sum of clean dry air, water and aerosol; 0 where water alone explains more.
double broadband_aerosol_depth_from_linke(double linke_turbidity, double precipitable_water_cm);

/// Global horizontal irradiance [W m-2], Haurwitz (1945), coefficients 1098 and 0.059.
double haurwitz(double elevation_deg);

/// Clear sky for one sun position; zero where the sun's apparent elevation is
/// not above 0. Pressure is that of the standard atmosphere.
struct ClearSkyInput {
  double elevation_deg = 0;  ///< apparent
  double elevation_m = 0;    ///< of the site
  double linke_turbidity = 3;
  double extraterrestrial_normal = solar_constant;
};
Irradiance clear_sky(ClearSkyModel model, const ClearSkyInput& input);

/// Divides global irradiance by the correlation of Erbs, Klein & Duffie (1982).
Irradiance erbs(double ghi, double elevation_deg, double extraterrestrial_normal);

/// Solar constant of the report that DISC was fitted in [W m-2]: extraterrestrial irradiance for it
/// rests on this one.
inline constexpr double disc_solar_constant = 1370;

/// The same by DISC, Maxwell (1987), SERI/TR-215-3087; `extraterrestrial_normal` by the report's
/// solar constant.
Irradiance disc(double ghi, double elevation_deg, double extraterrestrial_normal,
                double pressure_pa = sea_level_pressure_pa);

/// Parameters of the sky in the models of Perez et al. (1990, 1993).
struct SkyCondition {
  double clearness = 1;   ///< epsilon, from 1 (overcast); infinite without diffuse light
  double brightness = 0;  ///< Delta
  std::size_t bin = 0;    ///< 0 … 7, clearness bin of the papers' tables
};
/// Clearness bin of the tables, 0 … 7, [low, high).
std::size_t clearness_bin(double clearness);
/// Zenith angle within [0, 90].
SkyCondition sky_condition(double dni, double dhi, double sun_zenith_deg,
                           double extraterrestrial_normal);

/// Lumens per watt of daylight, Perez, Ineichen, Seals, Michalsky & Stewart (1990),
/// Solar Energy 44, eqs 6–8 and table 4. Never negative.
struct LuminousEfficacy {
  double global = 0, beam = 0, diffuse = 0;
};
LuminousEfficacy luminous_efficacy(const SkyCondition& sky, double sun_zenith_deg,
                                   double precipitable_water_cm);

/// Precipitable water [cm] from the dew point, eq. 3 of the same paper.
double precipitable_water_cm(double dew_point_c);

}  // namespace sunload
