// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The ground's albedo day by day: weights, gaps, civil days.
#include "geo/sun/day_albedo.h"

#include <gtest/gtest.h>

namespace sunload {
namespace {

constexpr double hour = seconds_per_hour;
const UnixTime new_year = utc_from_calendar({2026, 1, 1, 0, 0, 0});

/// A sun in the zenith.
double overhead(UnixTime /*at*/) { return 1; }

DatedWeather record(double hours, double ghi, std::optional<double> albedo) {
  return {new_year + hours * hour, new_year + (hours + 1) * hour, {{}, {}, ghi, albedo}, 0};
}

/// An hour, with sun.
SunInterval interval(double hours) {
  SunInterval i;
  i.begin = new_year + hours * hour;
  i.end = i.begin + hour;
  i.up_s = hour;
  return i;
}

const TimeZone utc_zone("UTC");

TEST(DayAlbedo, IsTheMeanOfTheLightThatFalls) {
  const std::vector<DatedWeather> weather{record(9, 100, 0.8), record(12, 300, 0.4),
                                          record(13, 500, {}), record(22, 0, 0.9)};
  const auto albedos =
      day_albedos(weather, {interval(8), interval(15), interval(23)}, utc_zone, overhead);
  EXPECT_EQ(albedos.of_interval, std::vector<double>(3, (100 * 0.8 + 300 * 0.4) / 400));
  EXPECT_EQ(albedos.days, 1u);
  EXPECT_EQ(albedos.filled, 0u);
}

TEST(DayAlbedo, GoesByDiffuseLightWhereThatIsAll) {
  std::vector<DatedWeather> weather{record(9, 0, 0.2), record(12, 0, 0.5)};
  weather[0].values.ghi.reset();
  weather[0].values.dhi = 50;
  const auto albedos = day_albedos(weather, {interval(8)}, utc_zone, overhead);
  EXPECT_EQ(albedos.of_interval, std::vector<double>{0.2});
}

TEST(DayAlbedo, OfADayWithoutIsThatOfTheNearest) {
  const std::vector<DatedWeather> weather{record(24 + 12, 1, 0.2), record(4 * 24 + 12, 1, 0.7)};
  SunPath path;
  for (int day = 0; day < 6; ++day) path.push_back(interval(24 * day + 12));
  path[5].up_s = 0;  // polar night lacks nothing
  const auto albedos = day_albedos(weather, path, utc_zone, overhead);
  EXPECT_EQ(albedos.of_interval, (std::vector<double>{0.2, 0.2, 0.2, 0.7, 0.7, 0.7}));
  EXPECT_EQ(albedos.days, 5u);
  EXPECT_EQ(albedos.filled, 3u);
}

TEST(DayAlbedo, DaysAreThoseOfTheClock) {
  const std::vector<DatedWeather> weather{record(12, 1, 0.2), record(36, 1, 0.6)};
  const SunPath late{interval(22)};  // the morning of the next day in Tokyo
  EXPECT_EQ(day_albedos(weather, late, utc_zone, overhead).of_interval.front(), 0.2);
  EXPECT_EQ(day_albedos(weather, late, TimeZone("Asia/Tokyo"), overhead).of_interval.front(), 0.6);
}

TEST(DayAlbedo, IsUnknownWithoutAny) {
  const auto albedos = day_albedos({record(12, 100, {})}, {interval(12)}, utc_zone, overhead);
  EXPECT_TRUE(albedos.of_interval.empty());
}

// Where a file has DNI and DHI alone, light on the ground is of both.
TEST(DayAlbedo, WithoutGlobalIrradianceTheBeamCountsByTheSunsHeight) {
  auto clear = record(12, 0, 0.8), cloudy = record(15, 0, 0.2);
  clear.values.ghi = cloudy.values.ghi = std::nullopt;
  clear.values.dni = 800;
  clear.values.dhi = cloudy.values.dhi = 100;
  const auto half_high = [](UnixTime /*at*/) { return 0.5; };
  const auto albedos = day_albedos({clear, cloudy}, {interval(12)}, utc_zone, half_high);
  EXPECT_NEAR(albedos.of_interval.front(), (500 * 0.8 + 100 * 0.2) / 600, 1e-12);
}

}  // namespace
}  // namespace sunload
