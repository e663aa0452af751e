// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Equinoxes and solstices against published instants, and dates in zones.
#include "geo/sun/seasons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {
namespace {

UnixTime utc(const std::string& text) { return utc_from_calendar(parse_time(text).civil); }

/// United States Naval Observatory, Earth's Seasons (UT, to the minute).
struct Published {
  int year;
  const char* instants[4];
};
const std::vector<Published> published{
    {2000, {"2000-03-20T07:35", "2000-06-21T01:48", "2000-09-22T17:28", "2000-12-21T13:37"}},
    {2012, {"2012-03-20T05:14", "2012-06-20T23:09", "2012-09-22T14:49", "2012-12-21T11:12"}},
    {2020, {"2020-03-20T03:50", "2020-06-20T21:44", "2020-09-22T13:31", "2020-12-21T10:02"}},
    {2021, {"2021-03-20T09:37", "2021-06-21T03:32", "2021-09-22T19:21", "2021-12-21T15:59"}},
    {2022, {"2022-03-20T15:33", "2022-06-21T09:14", "2022-09-23T01:04", "2022-12-21T21:48"}},
    {2023, {"2023-03-20T21:24", "2023-06-21T14:58", "2023-09-23T06:50", "2023-12-22T03:27"}},
    {2024, {"2024-03-20T03:06", "2024-06-20T20:51", "2024-09-22T12:44", "2024-12-21T09:20"}},
    {2025, {"2025-03-20T09:01", "2025-06-21T02:42", "2025-09-22T18:19", "2025-12-21T15:03"}}};

TEST(Seasons, AreThePublishedInstants) {
  // The table is rounded to the minute; editions differ in the last one.
  constexpr double rounding_s = 60;
  for (const auto& row : published) {
    for (int season = 0; season < 4; ++season) {
      const UnixTime found = season_instant(static_cast<Season>(season), row.year);
      EXPECT_LE(std::abs(found - utc(row.instants[season])), rounding_s)
          << row.instants[season] << " found " << iso_utc(found);
    }
  }
}

TEST(Seasons, AreFoundInEveryYear) {
  // Successive instants of one season are a tropical year apart, within the pull of the planets
  // (a quarter of an hour).
  constexpr double tropical_year_s = 365.2422 * seconds_per_day, planets_s = 30 * 60;
  for (int season = 0; season < 4; ++season) {
    UnixTime before = season_instant(static_cast<Season>(season), 1900);
    for (int year = 1901; year <= 2100; ++year) {
      const UnixTime now = season_instant(static_cast<Season>(season), year);
      EXPECT_NEAR(now - before, tropical_year_s, planets_s) << year;
      before = now;
    }
  }
}

TEST(Seasons, DatesAreThoseOfTheZone) {
  const auto date = [](Season season, int year, const char* zone) {
    const CivilTime d = season_date(season, year, TimeZone(zone));
    EXPECT_EQ(d.hour + d.minute + d.second, 0);
    return d.month * 100 + d.day;
  };
  EXPECT_EQ(date(Season::june_solstice, 2020, "UTC"), 620);
  EXPECT_EQ(date(Season::june_solstice, 2020, "Asia/Tokyo"), 621);
  EXPECT_EQ(date(Season::september_equinox, 2023, "Europe/Prague"), 923);
  EXPECT_EQ(date(Season::december_solstice, 2023, "Europe/Prague"), 1222);
  EXPECT_EQ(date(Season::december_solstice, 2023, "America/Los_Angeles"), 1221);
}

TEST(NamedDay, IsReadWithItsYear) {
  EXPECT_TRUE(is_day_name("june_solstice 2026"));
  EXPECT_FALSE(is_day_name("2026-06-21"));
  const NamedDay day = parse_named_day("summer_solstice 2026");
  EXPECT_EQ(day.year, 2026);
  EXPECT_TRUE(day.depends_on_hemisphere());
  EXPECT_EQ(civil_date(day, TimeZone("UTC"), 50).month, 6);
  EXPECT_EQ(civil_date(day, TimeZone("UTC"), -50).month, 12);
  EXPECT_FALSE(parse_named_day("march_equinox 2026").depends_on_hemisphere());
  for (const char* wrong : {"june_solstice", "solstice 2026", "june_solstice 26", "x", "June 2026",
                            "june_solstice 2026 x"}) {
    EXPECT_THROW(parse_named_day(wrong), InputError) << wrong;
  }
}

}  // namespace
}  // namespace sunload
