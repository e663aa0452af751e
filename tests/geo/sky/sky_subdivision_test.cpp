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

}  // namespace
}  // namespace sunload
