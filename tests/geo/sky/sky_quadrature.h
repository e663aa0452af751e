// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Slow and sure integrals over the sky dome, independent of those of the library: zenith
/// angle and azimuth, panels graded towards the sun, the horizon and other given places.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geo/sky/sky.h"

namespace sunload::test {

/// Abscissae and weights of Gauss-Legendre with 8 points on [-1, 1] (Abramowitz & Stegun 25.4).
struct GaussPoint {
  double x, weight;
};
inline constexpr std::array<GaussPoint, 8> gauss_points{{{-0.9602898564975363, 0.1012285362903763},
                                                         {-0.7966664774136267, 0.2223810344533745},
                                                         {-0.5255324099163290, 0.3137066458778873},
                                                         {-0.1834346424956498, 0.3626837833783620},
                                                         {0.1834346424956498, 0.3626837833783620},
                                                         {0.5255324099163290, 0.3137066458778873},
                                                         {0.7966664774136267, 0.2223810344533745},
                                                         {0.9602898564975363, 0.1012285362903763}}};

/// Borders of panels on [low, high] that halve towards each of `places`.
inline std::vector<double> graded(double low, double high, const std::vector<double>& places,
                                  int halvings = 14) {
  std::vector<double> borders{low, high};
  for (const double place : places) {
    const auto add = [&](double x) {
      if (x > low && x < high) borders.push_back(x);
    };
    add(place);
    double step = high - low;
    for (int i = 0; i < halvings; ++i) {
      step /= 2;
      add(place - step);
      add(place + step);
    }
  }
  std::sort(borders.begin(), borders.end());
  return borders;
}

template <class Function>
double integral(const std::vector<double>& borders, const Function& f) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double half = (borders[i + 1] - borders[i]) / 2, middle = borders[i] + half;
    for (const GaussPoint& g : gauss_points) sum += half * g.weight * f(middle + half * g.x);
  }
  return sum;
}

/// ∫ L max(0, n·w) dω for a plane tilted by `tilt` towards the azimuth `facing` (both
/// radians, azimuth counted from the sun), sun at the zenith angle `sun_zenith`. Where the
/// plane cuts the dome is found for each zenith angle.
inline double plane_irradiance(const Sky& sky, double sun_zenith, double tilt, double facing) {
  const Vec3 sun = sky.sun_direction();
  const double length = std::hypot(sun.x, sun.y);
  const Vec3 forward = length > 1e-12 ? Vec3{sun.x / length, sun.y / length, 0} : Vec3{0, 1, 0};
  const Vec3 sideways{-forward.y, forward.x, 0};
  const double floor = std::acos(std::min(1.0, sky.shape().cos_floor));
  const auto zeniths = graded(0, pi / 2, {sun_zenith, pi / 2, floor, std::abs(pi / 2 - tilt)});
  return integral(zeniths, [&](double zenith) {
    const double up = std::cos(zenith), out = std::sin(zenith);
    // Half width in azimuth of what the plane sees, about `facing`.
    const double reach = std::sin(tilt) * out, height = -std::cos(tilt) * up;
    if (height >= reach) return 0.0;
    const double width = height <= -reach ? pi : std::acos(height / reach);
    const double low = facing - width, high = facing + width;
    return out * integral(graded(low, high, {0.0, pi, 2 * pi, -pi}), [&](double azimuth) {
             const Vec3 w = out * (std::cos(azimuth) * forward + std::sin(azimuth) * sideways) +
                            Vec3{0, 0, up};
             const double cosine =
                 std::cos(tilt) * up + std::sin(tilt) * out * std::cos(azimuth - facing);
             return sky.radiance(w) * cosine;
           });
  });
}

/// ∫ L cosθ dω, by half of the dome: the sky is symmetric about the sun's meridian.
inline double horizontal_irradiance(const Sky& sky) {
  constexpr int halvings = 10;  // what the smallest panel leaves of a cusp is below 1e-9
  const Vec3 sun = sky.sun_direction();
  const double across = std::hypot(sun.x, sun.y), sun_zenith = std::atan2(across, sun.z);
  const double floor = std::acos(std::min(1.0, sky.shape().cos_floor));
  const auto azimuths = graded(0, pi, {0, pi}, halvings);
  return integral(graded(0, pi / 2, {sun_zenith, pi / 2, floor}, halvings),
                  [&](double zenith) {
                    const double up = std::cos(zenith), out = std::sin(zenith);
                    const double ring = integral(azimuths, [&](double azimuth) {
                      const Vec3 from_sun{out * std::cos(azimuth) - across, out * std::sin(azimuth),
                                          up - sun.z};
                      return sky.shape().indicatrix(dot(from_sun, from_sun));
                    });
                    return 2 * ring * sky.shape().gradation(up) * up * out;
                  }) *
         sky.radiance(sun) / (sky.shape().gradation(sun.z) * sky.shape().indicatrix(0));
}

/// The same sky, sun at a zenith angle towards +y.
inline Sky sky_with(SkyModel model, double sun_zenith_deg, double dhi = 100) {
  SkyInput input;
  input.model = model;
  input.dhi = dhi;
  input.sun_zenith_deg = sun_zenith_deg;
  input.sun_direction = enu_direction({0, 90 - sun_zenith_deg});
  return Sky(input);
}

/// Direction by zenith angle and azimuth from that sun.
inline Vec3 direction_deg(double zenith_deg, double azimuth_from_sun_deg) {
  return enu_direction({azimuth_from_sun_deg, 90 - zenith_deg});
}

}  // namespace sunload::test
