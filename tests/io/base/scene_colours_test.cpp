// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Colours of kinds and materials.
#include "io/base/scene_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace sunload {
namespace {

TEST(MaterialColours, AreOfTheNameWhereverItStands) {
  const auto one = material_colours({"brick", "glass", "grass"});
  const auto other = material_colours({"grass", "brick", "glass"});
  EXPECT_EQ(one, (std::vector{other[1], other[2], other[0]}));
  EXPECT_EQ(material_colours({"brick", "glass"}), (std::vector{one[0], one[1]}));
}

TEST(MaterialColours, AreAllDifferentWhileThereAreEnough) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < material_colour_count; ++i) names.push_back("m" + std::to_string(i));
  const auto of = material_colours(names);
  EXPECT_EQ(std::set<std::size_t>(of.begin(), of.end()).size(), material_colour_count);
  for (std::size_t i = 0; i < material_colour_count + 5; ++i)
    names.push_back("n" + std::to_string(i));
  for (const std::size_t number : material_colours(names)) EXPECT_LT(number, material_colour_count);
}

TEST(MaterialColours, EqualNamesAndNoneHaveOne) {
  EXPECT_TRUE(material_colours({}).empty());
  EXPECT_EQ(material_colours({"", ""}).size(), 2u);
}

}  // namespace
}  // namespace sunload
