// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/first_of_many.h"

#include <gtest/gtest.h>

namespace sunload::test {
namespace {

TEST(FirstOfMany, NamesAllOfFew) {
  FirstOfMany names(2);
  EXPECT_EQ(names.text(), "");
  names.add("a");
  names.add("b");
  EXPECT_EQ(names.count(), 2u);
  EXPECT_EQ(names.text(), "a, b");
}

TEST(FirstOfMany, TellsThatThereAreMore) {
  FirstOfMany names(2);
  for (const char* name : {"a", "b", "c"}) names.add(name);
  EXPECT_EQ(names.count(), 3u);
  EXPECT_EQ(names.text(), "a, b, …");
}

TEST(FirstOfMany, CountsWhatIsNotNamed) {
  FirstOfMany names;
  names.add("a");
  names.add_unnamed(0);
  EXPECT_EQ(names.text(), "a");
  names.add_unnamed(7);
  EXPECT_EQ(names.count(), 8u);
  EXPECT_EQ(names.text(), "a, …");
}

}  // namespace
}  // namespace sunload::test
