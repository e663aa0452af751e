// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/radiance.h"

#include <gtest/gtest.h>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/result/shown_quantity.h"
#include "tests/support/refusal_of.h"
#include "tests/support/small_result.h"

namespace sunload {
namespace {

using test::SmallResult;
using test::write_small_result;

constexpr double rounding = 1e-6;

/// Three hours of 100, 300 and 200 W m-2 for each kWh m-2 of light load, which is 2 everywhere.
SmallResult evenly_lit() {
  SmallResult small;
  small.load = [](const std::string&, Vec3, std::size_t) { return 2; };
  return small;
}

void expect_all(const std::vector<double>& values, double expected) {
  ASSERT_FALSE(values.empty());
  for (const double value : values) ASSERT_NEAR(value, expected, rounding * expected);
}

TEST(Radiance, IsWhatIsReflectedAndEmittedOverPi) {
  SmallResult small = evenly_lit();
  small.diffuse_reflectance = 0.25;
  small.emitted_exitance = 40;
  const ResultReader result(write_small_result(small, "radiance"));
  const auto at = shown_quantity(result, "radiance", "2026-06-21T10:30Z");
  EXPECT_TRUE(at.is_series);
  EXPECT_EQ(at.interval, 1u);
  EXPECT_EQ(at.units, "W/(m² sr)");
  expect_all(at.values, (0.25 * 600 + 40) / pi);
  // No sum of what patches send is stored: of 2 kWh m-2 in three hours.
  const auto mean = shown_quantity(result, "radiance", "");
  EXPECT_FALSE(mean.is_series);
  EXPECT_EQ(mean.when.rfind("mean of ", 0), 0u) << mean.when;
  expect_all(mean.values, (0.25 * 2000 / 3 + 40) / pi);
}

// A black lamp sends its exitance into every direction alike: M = π L.
TEST(Radiance, OfALampIsItsExitanceOverPi) {
  SmallResult small = evenly_lit();
  small.diffuse_reflectance = 0;
  small.emitted_exitance = 200;
  const ResultReader result(write_small_result(small, "radiance_lamp"));
  expect_all(radiance_at(result, 0), 200 / pi);
  expect_all(mean_radiance(result), 200 / pi);
}

TEST(Radiance, OfAPartIsTheMeanOfItsTime) {
  SmallResult small = evenly_lit();
  small.diffuse_reflectance = 0.5;
  small.emitted_exitance = 40;
  ResultReader result(write_small_result(small, "radiance_part"));
  PeriodChoice choice;
  choice.hours = "12-14";
  result.choose(choice);
  // The second and the third hour: 600 and 400 W m-2.
  expect_all(mean_radiance(result), (0.5 * 500 + 40) / pi);
}

TEST(Radiance, IsRefusedWhereReflectancesAreUnknown) {
  const ResultReader result(write_small_result(evenly_lit(), "radiance_unknown"));
  const auto refusal =
      test::refusal_of([&] { shown_quantity(result, "radiance", "2026-06-21T10:30Z"); });
  EXPECT_NE(refusal.find("does not say what its surfaces reflect"), std::string::npos) << refusal;
  // Of energy, not of what the eye sees.
  const auto wrong = test::refusal_of([&] { shown_quantity(result, "luminance", ""); });
  EXPECT_NE(wrong.find("no quantity luminance"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find(", radiance"), std::string::npos) << wrong;
}

}  // namespace
}  // namespace sunload
