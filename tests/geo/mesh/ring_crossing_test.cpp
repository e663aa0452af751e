// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/ring_crossing.h"

#include <gtest/gtest.h>

namespace sunload {
namespace {

using Rings = std::vector<std::vector<Point2>>;

TEST(RingCrossing, ABowTieCrossesInItsMiddle) {
  const auto at = ring_crossing({{{-10, -10}, {10, 10}, {10, -10}, {-10, 10}}});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->u, 0);
  EXPECT_EQ(at->v, 0);
}

TEST(RingCrossing, RingsThatTouchDoNotCross) {
  const Rings court{{{0, 0}, {20, 0}, {20, 6}, {7, 6}, {7, 22}, {0, 22}}};
  EXPECT_FALSE(ring_crossing(court));
  const Rings hole{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{2, 2}, {8, 2}, {8, 8}, {2, 8}}};
  EXPECT_FALSE(ring_crossing(hole));
  const Rings hole_at_a_corner{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{0, 0}, {8, 2}, {2, 8}}};
  EXPECT_FALSE(ring_crossing(hole_at_a_corner));
  // An hourglass whose waist is a point of both.
  EXPECT_FALSE(ring_crossing({{{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}}}));
}

TEST(RingCrossing, AHoleThatReachesOutCrosses) {
  EXPECT_TRUE(ring_crossing({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{2, 2}, {12, 2}, {8, 8}}}));
}

}  // namespace
}  // namespace sunload
