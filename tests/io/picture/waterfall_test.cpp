// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/waterfall.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "io/picture/picture.h"
#include "tests/support/png.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

using test::folder_of_test;
using test::Png;
using Kind = ExplainedRow::Kind;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
// As the picture has them.
constexpr Colour sun{0.93, 0.62, 0.10}, taken_sun{0.965, 0.81, 0.55}, sky{0.38, 0.63, 0.86},
    reflects{0.36, 0.65, 0.40}, result_bar{0.42, 0.42, 0.46};

ExplainedRow row(Kind kind, const std::string& name, std::array<double, column_count> columns,
                 double total, double se = 0.01) {
  return {kind, name, columns, total, se, not_known, {}};
}

/// 2 in the open; a house takes 1 of the sun and gives 0.25.
Explanation simple(const std::string& house = "house") {
  std::array<double, column_count> none{};
  none.fill(not_known);
  Explanation e;
  e.study = "street";
  e.variant = "baseline";
  e.place = "pavement";
  e.extent = "20 m²";
  e.units = "kWh m-2";
  e.rows = {row(Kind::open, "", {1.5, 0.5, 0, 0, 0, 0}, 2),
            row(Kind::object, house, {-1, 0, 0, 0.25, 0, 0}, -0.75),
            row(Kind::sum, "", {0.5, 0.5, 0, 0.25, 0, 0}, 1.25), row(Kind::result, "", none, 1.25),
            row(Kind::remainder, "", none, 0)};
  return e;
}

Png drawn(const Explanation& explanation) {
  const std::string path = folder_of_test() / "waterfall.png";
  draw_waterfall(explanation, path);
  return test::read_png(path);
}

struct Span {
  double begin = 0, end = 0;
  double length() const { return end - begin; }
};

/// The longest run of a colour in a picture's rows, below the legend, from row `from` on.
std::optional<Span> longest(const Png& picture, Colour colour, int from, int to) {
  std::optional<Span> best;
  for (int y = from; y < to; ++y) {
    int begin = -1;
    for (int x = 0; x <= picture.width; ++x) {
      const bool is_it =
          x < picture.width && test::difference(picture.at(x, y), colour) < 1.5 / 255;
      if (is_it && begin < 0) begin = x;
      if (is_it || begin < 0) continue;
      if (!best || x - begin > best->length())
        best = Span{static_cast<double>(begin), static_cast<double>(x)};
      begin = -1;
    }
  }
  return best;
}

/// Whole pixels, and lines over the ends of bars.
constexpr double of_pixels = 3;
/// Where the first three rows are.
constexpr int open_row = 92, object_row = 128, sum_row = 164, end_of_rows = 240;

TEST(Waterfall, HasBarsAsLongAsTheLightThatBeginWhereThoseBeforeEnd) {
  const Png picture = drawn(simple());
  const auto open = longest(picture, sun, open_row, object_row),
             open_sky = longest(picture, sky, open_row, object_row),
             taken = longest(picture, taken_sun, object_row, sum_row),
             given = longest(picture, reflects, object_row, sum_row),
             stored = longest(picture, result_bar, sum_row, end_of_rows);
  ASSERT_TRUE(open && open_sky && taken && given && stored);
  const double unit = open->length() / 1.5;
  EXPECT_GT(unit, 100);
  EXPECT_NEAR(open_sky->length(), 0.5 * unit, of_pixels);
  EXPECT_NEAR(taken->length(), unit, of_pixels);
  EXPECT_NEAR(taken->end, open_sky->end, of_pixels) << "begins where the open ends";
  EXPECT_NEAR(given->begin, taken->begin, of_pixels) << "gives from where it has taken to";
  EXPECT_NEAR(given->length(), 0.25 * unit, of_pixels);
  EXPECT_NEAR(stored->begin, open->begin, of_pixels);
  EXPECT_NEAR(stored->end, given->end, of_pixels) << "what adds up is the result";
  EXPECT_GT(std::abs(given->end - taken->end), 10 * of_pixels) << "a fault would be seen";
}

TEST(Waterfall, OfADifferenceBeginsAtNothingAndGoesToBothSides) {
  Explanation change = simple();
  change.base = "before";
  change.rows[0] = row(Kind::open, "", {}, 0);
  change.rows[2] = row(Kind::sum, "", {-1, 0, 0, 0.25, 0, 0}, -0.75);
  change.rows[3].total = -0.75;
  const Png picture = drawn(change);
  const auto taken = longest(picture, taken_sun, object_row, sum_row),
             stored = longest(picture, result_bar, sum_row, end_of_rows);
  ASSERT_TRUE(taken && stored);
  EXPECT_NEAR(stored->length(), 0.75 * taken->length(), of_pixels);
  EXPECT_NEAR(stored->end, taken->end, of_pixels) << "both end at 0";
}

TEST(Waterfall, PutsWhatDoesLittleIntoOneRow) {
  Explanation many = simple();
  const int before = drawn(many).height;
  for (int k = 0; k < 30; ++k)
    many.rows.insert(many.rows.end() - 3,
                     row(Kind::object, "tree_" + std::to_string(k), {0, 0, 0, 1e-5, 0, 0}, 1e-5));
  EXPECT_EQ(drawn(many).height - before, object_row - open_row) << "30 others";
  EXPECT_EQ(shown_rows(many, 1)[2].name, "30 others");
  EXPECT_NEAR(shown_rows(many, 1)[2].total, 30e-5, 1e-12);
}

TEST(Waterfall, StandsNamesOfAnyLengthAndLightOfNone) {
  std::string name;
  for (int k = 0; k < 100; ++k) name += "dům č. 2, ";
  const Png picture = drawn(simple(name));
  const auto taken = longest(picture, taken_sun, object_row, sum_row);
  ASSERT_TRUE(taken);
  EXPECT_GT(taken->length(), 100);
  Explanation dark = simple();
  for (auto& each : dark.rows) {
    each.columns.fill(0);
    each.total = each.se = 0;
  }
  EXPECT_GT(drawn(dark).height, 0);
}

TEST(Picture, NamesOfOtherFormatsAreRefused) {
  for (const char* path : {"why.txt", "a.png/b.JPG"})
    EXPECT_NE(test::refusal_of([&] { expect_picture_name(path); }).find(".png"), std::string::npos);
  for (const char* path : {"", "a.png", "a.PNG", "/dev/stdout"})
    EXPECT_NO_THROW(expect_picture_name(path)) << path;
}

}  // namespace
}  // namespace sunload
