// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light gathered from elements above the leaves: as bright as what they are made of.

#include "solver/gather/jacobi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "solver/transport/light_transport.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

constexpr double exitance = 100, reflectance = 0.7;
constexpr int bounces = 8;

/// A closed room that glows alike everywhere, in patches that are far smaller than its walls.
std::unique_ptr<const TracedScene> glowing_room(double link_threshold) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {4, 3, 2}, builder.material({"glow", reflectance, 0, exitance}),
              SceneBuilder::Facing::inward);
  SolverRules rules = test_rules();
  rules.realizations = 2;
  rules.lines_per_patch = 128;
  rules.bounces = bounces;
  rules.link_threshold = link_threshold;
  Watch watch;
  return trace_scene(builder.scene(), {.max_edge_m = 1}, rules, watch);
}

/// Of a hundred links, how many lead to elements that have halves.
double percent_above_leaves(const TracedScene& room) {
  const std::size_t patches = room.hierarchy().patch_count();
  double links = 0, above = 0;
  for (const auto& block : room.patches.lines.pooled.patches.blocks) {
    links += static_cast<double>(block.target.size());
    above += static_cast<double>(std::count_if(block.target.begin(), block.target.end(),
                                               [&](auto target) { return target >= patches; }));
  }
  return 100 * above / links;
}

// E = M (1 + rho + … + rho^n) on every patch: each of its lines ends on what is as bright.
TEST(Jacobi, ElementsAboveTheLeavesSendWhatTheirHalvesSend) {
  const double truth = exitance * (1 - std::pow(reflectance, bounces + 1)) / (1 - reflectance);
  for (const double link_threshold : {0.0, 16.0}) {
    const auto room = glowing_room(link_threshold);
    const double above = percent_above_leaves(*room);
    if (link_threshold == 0)
      EXPECT_EQ(above, 0);
    else
      EXPECT_GT(above, 50);
    Watch watch;
    const auto transport = transport_of(*room);
    const BatchTally tally = sunload::solve(*transport, std::array{night}, watch).bands.front();
    for (const double E : tally.exposure[static_cast<std::size_t>(Part::total)])
      EXPECT_NEAR(E, truth, 1e-5 * truth);  // roundings of eight sums in float
    for (const Ledger& ledger : tally.ledger) EXPECT_NEAR(ledger.residual(), 0, 1e-5 * ledger.in());
  }
}

}  // namespace
}  // namespace sunload::test
