// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light gathered from elements above the leaves: as bright as what they are made of.

#include "solver/gather/jacobi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "solver/traced/traced_scene.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

constexpr double reflectance = 0.7;

/// A closed room of one material, in patches that are far smaller than its walls.
std::unique_ptr<const TracedScene> closed_room(double link_threshold) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {4, 3, 2}, builder.material({"wall", reflectance, 0, 0}),
              SceneBuilder::Facing::inward);
  SolverRules rules = test_rules();
  rules.realizations = 2;
  rules.lines_per_patch = 128;
  rules.link_threshold = link_threshold;
  Watch watch;
  return trace_scene(builder.scene(), {.max_edge_m = 0.5}, rules, watch);
}

/// Of a hundred links, how many lead to elements that have halves.
double percent_above_leaves(const TracedScene& room) {
  const std::size_t patches = room.hierarchy().patch_count();
  double links = 0, above = 0;
  for (const auto& block : room.patches.lines.pooled.patches.blocks) {
    LinkTable::Reader read(block);
    for (std::size_t row = 0; row < block.rows(); ++row)
      for (std::size_t left = read.next_row(); left > 0; --left, ++links)
        above += read.next().target >= patches;
  }
  return 100 * above / links;
}

// Where 100 W/m2 arrive everywhere, 100 (rho + … + rho^n) follow: each line ends on what is as
// bright as all else.
TEST(Jacobi, ElementsAboveTheLeavesSendWhatTheirHalvesSend) {
  constexpr float first = 100;
  constexpr int bounces = 8;
  const double truth =
      first * reflectance * (1 - std::pow(reflectance, bounces)) / (1 - reflectance);
  const double within = 1e-5 * truth;  // roundings of eight sums in float
  for (const double link_threshold : {0.0, 16.0}) {
    const auto room = closed_room(link_threshold);
    const double above = percent_above_leaves(*room);
    if (link_threshold == 0)
      EXPECT_EQ(above, 0);
    else
      EXPECT_GT(above, 50);
    const std::size_t patches = room->hierarchy().patch_count();
    const auto of_suns = reflect(room->hierarchy(), room->patches.lines.pooled, room->optics,
                                 Columns(patches * block_width, first), columns(patches), bounces);
    for (const float E : of_suns.irradiance) EXPECT_NEAR(E, truth, within);
    const auto of_exposure =
        reflect(room->hierarchy(), room->patches.lines.pooled, room->optics,
                std::vector<double>(patches, first), std::vector<double>(patches, 0), bounces);
    for (const double E : of_exposure.irradiance) EXPECT_NEAR(E, truth, within);
  }
}

}  // namespace
}  // namespace sunload::test
