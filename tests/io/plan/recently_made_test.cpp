// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/recently_made.h"

#include <gtest/gtest.h>

namespace sunload {
namespace {

TEST(RecentlyMade, TheOldestGoWhereAllAreTooHeavy) {
  RecentlyMade<int> made(10);
  EXPECT_EQ(made.of("a"), nullptr);
  made.keep("a", 1, 4);
  made.keep("b", 2, 4);
  ASSERT_NE(made.of("a"), nullptr);
  EXPECT_EQ(*made.of("a"), 1);
  made.keep("c", 3, 4);
  EXPECT_EQ(made.of("a"), nullptr);
  EXPECT_EQ(*made.of("b"), 2);
  EXPECT_EQ(*made.of("c"), 3);
  EXPECT_EQ(made.keep("giant", 4, 100), 4);
  EXPECT_EQ(made.of("b"), nullptr);
  ASSERT_NE(made.of("giant"), nullptr);
  made.keep("d", 5, 1);
  EXPECT_EQ(made.of("giant"), nullptr);
  EXPECT_EQ(*made.of("d"), 5);
}

}  // namespace
}  // namespace sunload
