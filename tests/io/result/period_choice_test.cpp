// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Words for parts of the period, and what they choose.
#include "io/result/period_choice.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/result/own_seasons.h"

namespace sunload {
namespace {

const TimeZone zone("Europe/Prague");

/// Hours of 21 June and 21 December 2026.
std::vector<TimeSpan> two_days() {
  std::vector<TimeSpan> hours;
  for (const int month : {6, 12}) {
    const UnixTime begin = zone.utc_from_civil({.year = 2026, .month = month, .day = 21}).utc;
    for (int h = 0; h < 24; ++h)
      hours.push_back({begin + h * seconds_per_hour, begin + (h + 1) * seconds_per_hour});
  }
  return hours;
}

std::vector<double> chosen(const PeriodChoice& choice, double latitude = 50) {
  return chosen_shares(choice, two_days(), zone, latitude, {});
}

double hours(const PeriodChoice& choice, double latitude = 50) {
  const auto shares = chosen(choice, latitude);
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

TEST(PeriodChoice, ChoosesWhatItsWordsSay) {
  EXPECT_EQ(hours({.month = "6"}), 24);
  EXPECT_EQ(hours({.month = "2026-12"}), 24);
  EXPECT_EQ(chosen({.month = "6"})[0], 1);
  EXPECT_EQ(chosen({.month = "6"})[24], 0);
  EXPECT_EQ(hours({.season = "winter"}), 24);
  EXPECT_EQ(chosen({.season = "winter"}, -50)[0], 1);
  EXPECT_EQ(hours({.day = "2026-12-21"}), 24);
  EXPECT_EQ(hours({.hours = "8-12"}), 8);
  EXPECT_EQ(chosen({.hours = "8-12"})[8], 1);
  EXPECT_EQ(chosen({.hours = "8-12"})[12], 0);
  EXPECT_EQ(hours({.hours = "22-4"}), 12);
  EXPECT_EQ(hours({.month = "6", .hours = "8-12"}), 4);
  EXPECT_EQ(hours({.from = "2026-07-01"}), 24);
  EXPECT_EQ(hours({.from = "2026-06-21T06:30", .to = "2026-06-21T08:00"}), 1.5);
  EXPECT_EQ(hours({.to = "2026-06-21T00:30Z"}), 2.5);  // summer time
  EXPECT_EQ(hours({.from = "2000-01-01"}), 48);
}

/// The first twelve hours of June, and all of December.
OwnSeasons two_seasons() {
  OwnSeasons own{{"my_days", "winter"}, {}, two_days()};
  for (std::size_t k = 0; k < own.intervals.size(); ++k)
    own.flags.push_back(k < 12 ? 1 : k < 24 ? 0 : 1 + 2);
  return own;
}

TEST(PeriodChoice, KnowsTheSeasonsOfTheStudyBeforeThoseOfTheCalendar) {
  const OwnSeasons own = two_seasons();
  const auto hours_of = [&](const PeriodChoice& choice, double latitude) {
    const auto shares = chosen_shares(choice, two_days(), zone, latitude, own);
    return std::accumulate(shares.begin(), shares.end(), 0.0);
  };
  EXPECT_EQ(hours_of({.season = "my_days"}, 50), 36);
  EXPECT_EQ(hours_of({.season = "my days"}, 50), 36);
  EXPECT_EQ(hours_of({.month = "6", .season = "my_days"}, 50), 12);
  EXPECT_EQ(hours_of({.season = "winter"}, -50), 24);  // December, in the south too
  EXPECT_EQ(hours_of({.season = "winter", .hours = "8-12"}, -50), 4);
  EXPECT_EQ(hours_of({.season = "summer"}, 50), 24);
  EXPECT_THROW(hours_of({.season = "snow"}, 50), InputError);
}

/// Where the study had seasons and the result has none, its steps are why.
TEST(PeriodChoice, TellsWhySeasonsOfTheStudyMayBeMissing) {
  const auto refusal = [](const OwnSeasons& own) {
    try {
      chosen_shares({.season = "snow"}, two_days(), zone, 50, own);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal({}).find("no step of its series lies in two of them"), std::string::npos);
  EXPECT_NE(refusal(two_seasons()).find("my_days"), std::string::npos);
  EXPECT_EQ(refusal(two_seasons()).find("step"), std::string::npos);
}

TEST(PeriodChoice, RefusesWhatSaysNothing) {
  for (const PeriodChoice& choice : {PeriodChoice{.month = "13"},
                                     {.month = "june"},
                                     {.month = "2026-00"},
                                     {.season = "rain"},
                                     {.day = "2026-06"},
                                     {.day = "2026-06-21T12:00"},
                                     {.hours = "8"},
                                     {.hours = "8:30-9"},
                                     {.hours = "25-26"},
                                     {.hours = "8-8"},
                                     {.from = "noon"},
                                     {.month = "5"},
                                     {.month = "6", .season = "winter"},
                                     {.from = "2027-01-01"}})
    EXPECT_THROW(chosen(choice), InputError) << choice.words();
}

TEST(PeriodChoice, DaysAreTold) {
  EXPECT_EQ(days_in_words(two_days(), zone), "2026-06-21, 2026-12-21");
  std::vector<TimeSpan> many;
  for (int month = 1; month <= 12; ++month) {
    const UnixTime noon =
        zone.utc_from_civil({.year = 2026, .month = month, .day = 21, .hour = 12}).utc;
    many.push_back({noon, noon + seconds_per_hour});
    many.push_back({noon + seconds_per_day, noon + seconds_per_day + seconds_per_hour});
  }
  EXPECT_EQ(days_in_words(many, zone), "24 days of 2026-01-21 … 2026-12-22");
  EXPECT_EQ(days_in_words({many.begin(), many.begin() + 4}, zone),
            "2026-01-21 … 2026-01-22, 2026-02-21 … 2026-02-22");
}

}  // namespace
}  // namespace sunload
