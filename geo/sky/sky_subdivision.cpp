// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/sky_subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geo/base/check.h"

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

/// Rows of a subdivision below its cap.
struct Rows {
  explicit Rows(Subdivision subdivision)
      : n(division(subdivision)),
        count(n * static_cast<int>(tregenza_rows.size())),
        height_deg(90 / (count + 0.5)) {}
  int patches_of(int row) const { return n * tregenza_rows[static_cast<std::size_t>(row / n)]; }
  /// Number of the patch in a direction, in the order of `sky_patches`.
  std::size_t patch_at(Vec3 w) const;

  int n, count;
  double height_deg;  ///< the cap reaches half a row from the zenith
};

std::size_t Rows::patch_at(Vec3 w) const {
  const Horizontal h = horizontal(w);
  const int row = std::clamp(static_cast<int>(h.elevation_deg / height_deg), 0, count);
  int before = 0;
  for (int below = 0; below < row; ++below) before += patches_of(below);
  if (row == count) return static_cast<std::size_t>(before);
  const int in_row = patches_of(row);
  const int number =
      before + static_cast<int>(std::floor(h.azimuth_deg * in_row / 360 + 0.5)) % in_row;
  return static_cast<std::size_t>(number);
}

}  // namespace

std::vector<SkyPatch> sky_patches(Subdivision subdivision) {
  const Rows rows(subdivision);
  std::vector<SkyPatch> patches;
  for (int row = 0; row < rows.count; ++row) {
    const int count = rows.patches_of(row);
    const double width_deg = 360.0 / count;
    for (int i = 0; i < count; ++i) {
      patches.push_back(patch(row * rows.height_deg, (row + 1) * rows.height_deg,
                              (i - 0.5) * width_deg, (i + 0.5) * width_deg));
    }
  }
  patches.push_back(patch(rows.count * rows.height_deg, 90, 0, 360));
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

PatchSkies::PatchSkies(Subdivision subdivision, const SkyGrid& grid)
    : patches_(sky_patches(subdivision)), projected_(grid.projected()) {
  constexpr int n = 8;  // points each way: a share is known to some hundredths of a cell
  const Rows rows(subdivision);
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    std::map<std::size_t, int> points_in;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        ++points_in[rows.patch_at(grid.direction(cell, (i + 0.5) / n, (j + 0.5) / n))];
    for (const auto& [patch, points] : points_in)
      shares_.push_back({static_cast<std::uint32_t>(patch), static_cast<float>(points) / (n * n)});
    first_.push_back(static_cast<std::uint32_t>(shares_.size()));
  }
}

double PatchSkies::horizontal_irradiance(std::span<const double> of_patches) const {
  SUNLOAD_EXPECT(of_patches.size() == patches_.size(), "one radiance per patch of the sky");
  double sum = 0;
  for (std::size_t p = 0; p < patches_.size(); ++p) sum += of_patches[p] * patches_[p].projected;
  return sum;
}

std::vector<double> PatchSkies::on_grid(std::span<const double> of_patches) const {
  const double wanted = horizontal_irradiance(of_patches);
  std::vector<double> cells(projected_.size(), 0);
  double sum = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (std::uint32_t s = first_[cell]; s < first_[cell + 1]; ++s)
      cells[cell] += static_cast<double>(shares_[s].of_cell) * of_patches[shares_[s].patch];
    sum += cells[cell] * projected_[cell];
  }
  if (sum > 0)
    for (double& radiance : cells) radiance *= wanted / sum;
  return cells;
}

}  // namespace sunload
