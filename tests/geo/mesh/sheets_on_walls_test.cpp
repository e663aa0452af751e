// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Panes and panels that look into what they lie on.
#include "geo/mesh/sheets_on_walls.h"

#include <gtest/gtest.h>

#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double pane_rounding_m2 = 1e-9;

/// 4 x 3 m before the south wall of a house of 10 x 10 x 6 m, by so much.
std::vector<Vec3> pane(double before_m, double first_x = 3) {
  return {{first_x, -before_m, 1},
          {first_x + 4, -before_m, 1},
          {first_x + 4, -before_m, 4},
          {first_x, -before_m, 4}};
}

PrepareReport with_pane(const std::vector<Vec3>& ring, Sides sides = Sides::one,
                        const PrepareRules& rules = {}) {
  ModelBuilder model;
  model.object("house").box({0, 0, 0}, {10, 10, 6});
  model.object("pane").with(Surface::other, sides).ring(ring);
  return model.prepared(rules).report;
}

TEST(SheetsOnWalls, AreTurnedWhereTheyLookIntoTheWall) {
  for (const double before_m : {0.0, 1e-3, 3e-3, 0.015}) {
    const PrepareReport report = with_pane(reversed(pane(before_m)));
    EXPECT_EQ(report.turned.triangles, 2u) << before_m;
    EXPECT_NEAR(report.turned.area_m2, 12, pane_rounding_m2);
    EXPECT_EQ(report.turned.largest, "pane");
    EXPECT_NE(report.warnings.front().find("12 m2 of sheets looked into the wall"),
              std::string::npos)
        << report.warnings.front();
  }
}

TEST(SheetsOnWalls, AreTurnedOnRoofsToo) {
  const PrepareReport report =
      with_pane(reversed({{2, 2, 6.001}, {8, 2, 6.001}, {8, 8, 6.001}, {2, 8, 6.001}}));
  EXPECT_NEAR(report.turned.area_m2, 36, pane_rounding_m2);
}

TEST(SheetsOnWalls, StayAsTheyAreWhereTheyMayBeMeantSo) {
  EXPECT_EQ(with_pane(pane(1e-3)).turned.triangles, 0u);                        // right
  EXPECT_EQ(with_pane(reversed(pane(0.05))).turned.triangles, 0u);              // light gets in
  EXPECT_EQ(with_pane(reversed(pane(-0.05))).turned.triangles, 0u);             // within
  EXPECT_EQ(with_pane(reversed(pane(1e-3, 8.1))).turned.triangles, 0u);         // beyond the corner
  EXPECT_EQ(with_pane(reversed(pane(1e-3)), Sides::two).turned.triangles, 0u);  // both ways
  EXPECT_EQ(
      with_pane(reversed(pane(1e-3)), Sides::one, {.ground = {}, .orientation = Orientation::keep})
          .turned.triangles,
      0u);
}

}  // namespace
}  // namespace sunload::test
