// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/info.h"
#include "io/result/patches_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "geo/base/check.h"
#include "io/result/time.h"
#include "tests/support/small_result.h"

namespace sunload {
namespace {

using test::SmallResult;
using test::write_small_result;

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << "\nis missing in\n" << text;
}

TEST(Info, OneScreenSaysWhatWhenAndHowGood) {
  SmallResult small;
  small.load = [](const std::string&, Vec3 normal, std::size_t r) {
    return (2 + normal.z - normal.y) * (1 + (r % 2 ? 0.01 : -0.01));
  };
  const ResultReader result(write_small_result(small, "info"));
  const auto text = info_text(result);
  expect_in(text, "small, variant baseline");
  expect_in(text, "3 intervals, 3 h in all");
  expect_in(text, "2026-06-21T09:30:00Z");
  expect_in(text, "2026-06-21 11:30 +02:00");
  expect_in(text, "8 facades");
  // s/√8 of ± 1 % is 0.01·√(8/7)/√8 = 0.378 %
  expect_in(text, "0.38 % (median by area)");
  // least load 1 (north and the awning's back), largest 3, both × 300 in the brightest interval
  expect_in(text, "0.333");
  expect_in(text, "2026-06-21T10:30:00Z");
  expect_in(text, "house_1/south_1 3");
  expect_in(text, "house_1/north_1 1");
  expect_in(text, "in 15 = sun 15");
  expect_in(text, "out 14.97 = absorbed 14.97");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 24);  // a screen
}

TEST(Info, ASceneInTheDarkHasNoAccuracy) {
  SmallResult dark;
  dark.load = [](const std::string&, Vec3, std::size_t) { return 0; };
  const auto text = info_text(ResultReader(write_small_result(dark, "info_dark")));
  expect_in(text, "no patch receives light");
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(Info, IntervalOfATimeIsFoundInCivilTimeAndUtc) {
  const ResultReader result(write_small_result(SmallResult{}, "info_time"));
  EXPECT_EQ(brightest_interval(result), 1u);
  EXPECT_EQ(interval_at(result, "2026-06-21T11:00"), 0u);
  EXPECT_EQ(interval_at(result, "2026-06-21T11:59:59Z"), 2u);
  EXPECT_EQ(interval_at(result, "2026-06-21T12:30+02:00"), 1u);
  EXPECT_THROW(interval_at(result, "2026-06-21T10:59"), InputError);
}

TEST(Info, PatchListHasARowPerPatchAndQuotesNames) {
  const ResultReader result(write_small_result(SmallResult{}, "info_patches"));
  std::istringstream csv(patches_csv(result));
  std::string header, first;
  std::getline(csv, header);
  std::getline(csv, first);
  EXPECT_EQ(header.rfind("index,object,facade,surface,material,side,area_m2,centroid_x_m,", 0), 0u);
  expect_in(header, ",light_load_kwh_m2,light_load_se_kwh_m2,light_load_direct_kwh_m2,");
  EXPECT_EQ(first.rfind("0,ground,,ground,\"brick, old\",0,12.5,", 0), 0u) << first;
  // load 3, error 0, no parts, sun 3 h, no power load
  expect_in(first, ",0,0,1,3,0,,,,,,3,");
  std::size_t rows = 1;
  for (std::string line; std::getline(csv, line);) ++rows;
  EXPECT_EQ(rows, result.shape("patch_area").front());
}

}  // namespace
}  // namespace sunload
