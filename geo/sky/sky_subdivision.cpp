// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/sky_subdivision.h"

#include <array>
#include <cmath>

namespace sunload {

namespace {

// Patches in the rows of 12° from the horizon up (Tregenza 1987).
constexpr std::array<int, 7> tregenza_rows{30, 30, 24, 24, 18, 12, 6};

SkyPatch patch(double elevation_low_deg, double elevation_high_deg, double azimuth_low_deg,
               double azimuth_high_deg) {
  SkyPatch p{elevation_low_deg, elevation_high_deg, azimuth_low_deg, azimuth_high_deg, {}, 0, 0};
  const double low = std::sin(radians(elevation_low_deg));
  const double high = std::sin(radians(elevation_high_deg));
  const double width = radians(azimuth_high_deg - azimuth_low_deg);
  p.solid_angle = width * (high - low);
  p.projected = width * (high * high - low * low) / 2;
  const bool cap = elevation_high_deg >= 90;
  p.direction = cap ? Vec3{0, 0, 1}
                    : enu_direction({(azimuth_low_deg + azimuth_high_deg) / 2,
                                     (elevation_low_deg + elevation_high_deg) / 2});
  return p;
}

int division(Subdivision subdivision) {
  switch (subdivision) {
    case Subdivision::tregenza:
      return 1;
    case Subdivision::reinhart_mf2:
      return 2;
    case Subdivision::reinhart_mf4:
      return 4;
  }
  return 1;
}

}  // namespace

std::vector<SkyPatch> sky_patches(Subdivision subdivision) {
  const int n = division(subdivision);
  const int rows = n * static_cast<int>(tregenza_rows.size());
  // The cap reaches half a row from the zenith.
  const double height_deg = 90 / (rows + 0.5);
  std::vector<SkyPatch> patches;
  for (int row = 0; row < rows; ++row) {
    const int count = n * tregenza_rows[static_cast<std::size_t>(row / n)];
    const double width_deg = 360.0 / count;
    for (int i = 0; i < count; ++i) {
      patches.push_back(patch(row * height_deg, (row + 1) * height_deg, (i - 0.5) * width_deg,
                              (i + 0.5) * width_deg));
    }
  }
  patches.push_back(patch(rows * height_deg, 90, 0, 360));
  return patches;
}

std::vector<double> mean_radiance(const std::vector<SkyPatch>& patches, const Sky& sky) {
  // Midpoints of equal solid angle; the cap's ring of azimuths needs as many.
  constexpr int n = 16;
  std::vector<double> mean;
  mean.reserve(patches.size());
  for (const SkyPatch& p : patches) {
    const double low = std::sin(radians(p.elevation_low_deg));
    const double high = std::sin(radians(p.elevation_high_deg));
    const double begin = radians(p.azimuth_low_deg);
    const double width = radians(p.azimuth_high_deg) - begin;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double up = low + (high - low) * (i + 0.5) / n;
      const double out = std::sqrt((1 - up) * (1 + up));
      for (int j = 0; j < n; ++j) {
        const double azimuth = begin + width * (j + 0.5) / n;
        sum += sky.radiance({out * std::sin(azimuth), out * std::cos(azimuth), up});
      }
    }
    mean.push_back(sum / (n * n));
  }
  return mean;
}

}  // namespace sunload
