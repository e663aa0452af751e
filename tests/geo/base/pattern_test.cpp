// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/base/pattern.h"

#include <gtest/gtest.h>

namespace sunload {
namespace {

TEST(Pattern, TellsGroupsOfAWholeTextAndWhichOfThemTookPart) {
  const Pattern pattern(R"((\d+)-([a-z]*)(?:\+(\d))?)");
  const auto parts = pattern.whole("12-ab");
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 4);
  EXPECT_EQ((*parts)[0].text, "12-ab");
  EXPECT_EQ((*parts)[1].text, "12");
  EXPECT_EQ((*parts)[2].text, "ab");
  EXPECT_TRUE((*parts)[2].matched);
  EXPECT_FALSE((*parts)[3].matched);
  EXPECT_TRUE(pattern.whole("12-")->at(2).matched) << "nothing, yet a part of the match";
  EXPECT_FALSE(pattern.whole("12-ab "));
}

TEST(Pattern, FindsTheFirstPlaceOfAText) {
  const Pattern pattern(R"(<(\w)>)");
  const auto parts = pattern.first("a <b> <c>");
  ASSERT_TRUE(parts);
  EXPECT_EQ((*parts)[1].text, "b");
  EXPECT_FALSE(pattern.first("a b"));
}

TEST(Pattern, LettersMatchByCaseUnlessToldOtherwise) {
  EXPECT_FALSE(Pattern("epsg").whole("EPSG"));
  EXPECT_TRUE(Pattern("epsg", Pattern::Letters::of_any_case).whole("EPSG"));
}

}  // namespace
}  // namespace sunload
