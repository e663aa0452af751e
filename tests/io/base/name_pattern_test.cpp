// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/name_pattern.h"

#include <gtest/gtest.h>

#include "tests/support/refusal_of.h"

namespace sunload {
namespace {

using Names = std::vector<std::string>;
using Places = std::vector<std::size_t>;
const Names facades{"house_1/north_1", "house_1/south_1", "house_2/south_1", "odd*name"};

TEST(NamePattern, StarsAndQuestionMarks) {
  EXPECT_TRUE(matches("house_?/s*1", "house_2/south_1"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("a*b*c", "a-b-b-c"));
  EXPECT_FALSE(matches("a*b*c", "a-b-b"));
  EXPECT_FALSE(matches("house", "house_2"));
}

TEST(NamePattern, ChoosesInTheOrderOfTheNames) {
  EXPECT_EQ(matching_names({}, facades, "facade", "f"), (Places{0, 1, 2, 3}));
  EXPECT_EQ(matching_names({"*/south_1", "house_1/*"}, facades, "facade", "f"), (Places{0, 1, 2}));
  EXPECT_EQ(matching_names({"odd*name"}, facades, "facade", "f"), (Places{3}));
}

TEST(NamePattern, UnknownNamesAreToldNearOnes) {
  const auto refusal = [](const Names& patterns) {
    return test::refusal_of([&] { matching_names(patterns, facades, "facade", "r.h5"); });
  };
  EXPECT_EQ(refusal({"hause_2/south_1"}),
            "r.h5: no facade 'hause_2/south_1' (there are 4); did you mean 'house_2/south_1', "
            "'house_1/south_1', 'house_1/north_1'?");
  EXPECT_NE(refusal({"hause_2/*"}).find("no facade matches 'hause_2/*'"), std::string::npos);
  EXPECT_NE(refusal({"SOUTH"}).find("'house_1/south_1', 'house_2/south_1'?"), std::string::npos);
  EXPECT_NE(refusal({"xyz"}).find("write one of 'house_1/north_1'"), std::string::npos);
  EXPECT_NE(refusal({""}).find("no facade ''"), std::string::npos);
  // All of them at once.
  const auto two = refusal({"xyz", "uvw"});
  EXPECT_NE(two.find("'xyz'"), std::string::npos);
  EXPECT_NE(two.find("'uvw'"), std::string::npos);
}

TEST(NamePattern, OfHundredsOfNamesAFewAreTold) {
  Names many;
  for (int k = 0; k < 300; ++k) many.push_back("house_" + std::to_string(k));
  const auto text = test::refusal_of([&] { matching_names({"hause_1*"}, many, "object", "r"); });
  EXPECT_LT(text.size(), 200u) << text;
  EXPECT_NE(text.find("there are 300"), std::string::npos) << text;
}

}  // namespace
}  // namespace sunload
