// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sky/sky_subdivision.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/geo/sky/sky_quadrature.h"

namespace sunload {
namespace {

TEST(SkySubdivision, HasTheCountsOfTheLiterature) {
  EXPECT_EQ(sky_patches(Subdivision::tregenza).size(), 145u);
  EXPECT_EQ(sky_patches(Subdivision::reinhart_mf2).size(), 577u);
  EXPECT_EQ(sky_patches(Subdivision::reinhart_mf4).size(), 2305u);
}

TEST(SkySubdivision, CoversTheDomeOnce) {
  for (const auto kind :
       {Subdivision::tregenza, Subdivision::reinhart_mf2, Subdivision::reinhart_mf4}) {
    double solid_angle = 0, projected = 0;
    for (const SkyPatch& patch : sky_patches(kind)) {
      solid_angle += patch.solid_angle;
      projected += patch.projected;
      EXPECT_NEAR(norm(patch.direction), 1, 1e-14);
    }
    EXPECT_NEAR(solid_angle, 2 * pi, 1e-12);
    EXPECT_NEAR(projected, pi, 1e-12);
  }
}

TEST(SkySubdivision, CapAndRowsAreThoseOfTregenza) {
  const auto patches = sky_patches(Subdivision::tregenza);
  EXPECT_NEAR(patches.back().elevation_low_deg, 84, 1e-12);
  EXPECT_EQ(patches.back().direction, (Vec3{0, 0, 1}));
  const Horizontal first = horizontal(patches.front().direction);
  EXPECT_NEAR(first.azimuth_deg, 0, 1e-9);
  EXPECT_NEAR(first.elevation_deg, 6, 1e-9);
  EXPECT_NEAR(horizontal(patches[1].direction).azimuth_deg, 12, 1e-9);  // clockwise
}

TEST(SkySubdivision, MeanRadianceKeepsTheIrradiance) {
  for (const auto model : {SkyModel::uniform, SkyModel::cie_overcast, SkyModel::cie_clear}) {
    double last = 1;
    for (const auto kind :
         {Subdivision::tregenza, Subdivision::reinhart_mf2, Subdivision::reinhart_mf4}) {
      const auto patches = sky_patches(kind);
      const auto mean = mean_radiance(patches, test::sky_with(model, 55));
      double sum = 0;
      for (std::size_t i = 0; i < mean.size(); ++i) sum += mean[i] * patches[i].projected;
      const double error = std::abs(sum / 100 - 1);
      EXPECT_LE(error, last + 1e-12);
      last = error;
      if (kind == Subdivision::tregenza) {
        // Radiance and cosine vary together in rows Δμ ≤ 0.21 high: for the overcast sky,
        // of slope 2/3, 2·pi·(2/3)·Δμ²/12 of 7·pi/9.
        EXPECT_LT(error, 2 * (2.0 / 3) * (0.21 * 0.21 / 12) / (7.0 / 9));
      }
    }
    EXPECT_LT(last, 1e-3);
  }
}

/// Radiances of which no two are alike.
std::vector<double> uneven(std::size_t count) {
  std::vector<double> radiance(count);
  for (std::size_t i = 0; i < count; ++i) radiance[i] = 20 + static_cast<double>(i * 37 % 101);
  return radiance;
}

TEST(PatchSkies, KeepTheIrradianceOfTheirPatches) {
  const SkyGrid grid;
  for (const auto kind :
       {Subdivision::tregenza, Subdivision::reinhart_mf2, Subdivision::reinhart_mf4}) {
    const PatchSkies skies(kind, grid);
    const auto radiance = uneven(skies.patch_count());
    const auto cells = skies.on_grid(radiance);
    double sum = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) sum += cells[c] * grid.projected()[c];
    EXPECT_NEAR(sum / skies.horizontal_irradiance(radiance), 1, 1e-12);
    for (const double cell : skies.on_grid(std::vector(skies.patch_count(), 3.0)))
      EXPECT_NEAR(cell, 3, 1e-6);  // shares are floats
  }
}

TEST(PatchSkies, LightTheCellsWherePatchesAre) {
  const SkyGrid grid;
  for (const auto kind : {Subdivision::tregenza, Subdivision::reinhart_mf4}) {
    const PatchSkies skies(kind, grid);
    const auto patches = sky_patches(kind);
    for (std::size_t p = 0; p < patches.size(); p += 13) {
      std::vector<double> radiance(patches.size(), 0);
      radiance[p] = 1;
      const auto cells = skies.on_grid(radiance);
      const Vec3 middle = patches[p].direction;
      EXPECT_GT(cells[static_cast<std::size_t>(grid.cell(middle))], 0) << p;
      const double reach =
          norm(patches[p].direction -
               enu_direction({patches[p].azimuth_low_deg, patches[p].elevation_low_deg}));
      constexpr double cell_width = 0.04;  // of 64 x 64, the diagonal
      for (std::size_t c = 0; c < cells.size(); ++c) {
        if (cells[c] > 0) {
          EXPECT_LT(norm(grid.direction(static_cast<int>(c), 0.5, 0.5) - middle),
                    1.2 * reach + cell_width)
              << p;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sunload
