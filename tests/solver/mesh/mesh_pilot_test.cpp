// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the refinement takes the light load for, where it is known.

#include "solver/mesh/mesh_pilot.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

// An open plate between a sky and a ground that are alike sees H₀ from everywhere, and of every sun
// its exposure times the cosine, on the side that faces it.
TEST(MeshPilot, LoadOfAnOpenPlateIsThatOfItsSunsAndWhatIsAround) {
  constexpr double around = 30;
  const Vec3 normal = normalized({0.3, -0.5, 0.8});
  const Tangents plane = tangents(normal);
  SceneBuilder builder;
  builder.sides(Sides::two)
      .triangle({0, 0, 0}, plane.tangent * 3, plane.bitangent * 2,
                builder.material({"m", 0.3, 0, 0}));
  const Scene scene = builder.scene();
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh);
  PeriodLight light;
  light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), around);
  light.ground = around;
  // Two before the front, one of them all but grazing; one before the back.
  light.suns = {{normalized({0.1, -0.6, 0.4}), 100},
                {normalized({0.9, 0.5, 0.1}), 70},
                {normalized({-0.9, 0.3, 0.1}), 40}};
  const MeshPilot pilot(forest, scene, caster, light, 1);
  for (const std::uint8_t side : {std::uint8_t{0}, std::uint8_t{1}}) {
    const Vec3 n = side == 0 ? normal : -normal;
    double truth = around, without_cosine = around, largest_cosine = 0;
    for (const PeriodSun& sun : light.suns) {
      const double cos_theta = std::max(0.0, dot(n, sun.direction));
      truth += sun.exposure * cos_theta;
      without_cosine += cos_theta > 0 ? sun.exposure : 0;
      largest_cosine = std::max(largest_cosine, cos_theta);
    }
    const ElementLoad load = pilot.load(0, side, 0.01);
    EXPECT_NEAR(load.mean, truth, float_rounding * truth);
    EXPECT_NEAR(load.variance, 0, float_rounding * truth * truth);
    EXPECT_TRUE(load.sees_sun);
    EXPECT_NEAR(load.largest_cosine, largest_cosine, float_rounding);
    EXPECT_GT(without_cosine, 1.1 * truth);  // it would be seen
  }
}

}  // namespace
}  // namespace sunload::test
