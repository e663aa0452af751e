// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/clear_days.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

namespace sunload {

namespace {

constexpr int days_of_a_year = 366;
constexpr std::size_t most_of_a_year = 300;  // days

struct Day {
  CivilTime date;
  std::size_t records = 0;
  double sun = 0;  ///< sum of direct light, or of all of it
  bool is_complete = true;
};

bool is_same_day(const CivilTime& a, const WeatherRecord& b) {
  return a.year == b.year && a.month == b.month && a.day == b.day;
}

std::vector<Day> days_of(const std::vector<WeatherRecord>& records, WeatherSource source) {
  std::vector<Day> days;
  for (const WeatherRecord& record : records) {
    if (days.empty() || !is_same_day(days.back().date, record))
      days.push_back({{.year = record.year, .month = record.month, .day = record.day}});
    Day& day = days.back();
    ++day.records;
    day.sun += record.values.dni.value_or(record.values.ghi.value_or(0));
    if (is_incomplete(record.values, source)) day.is_complete = false;
  }
  return days;
}

/// Days between the two in the circle of the year.
int apart(const CivilTime& a, const CivilTime& b) {
  constexpr int any_year = 2000;  // has 29 February
  const auto place = [](CivilTime date) {
    date.year = any_year;
    return day_of_year(date);
  };
  const int between = std::abs(place(a) - place(b));
  return std::min(between, days_of_a_year - between);
}

constexpr std::array<CivilTime, 3> targets{
    {{.month = 3, .day = 21}, {.month = 6, .day = 21}, {.month = 12, .day = 21}}};

/// Whether the day is one of those from which the choice for that target is made.
bool is_near_target(const std::vector<Day>& days, std::size_t d, std::size_t target) {
  constexpr int fortnight = 14;
  if (days.size() < most_of_a_year) return d * targets.size() / days.size() == target;
  return apart(days[d].date, targets[target]) <= fortnight;
}

/// How many records most of the days near a target have, or most of a few weeks; of two such
/// numbers the larger. Days of other seasons may have more (files that leave out the dark), as may
/// the last of February (stamps that end their stretch).
std::size_t usual_records(const std::vector<Day>& days, std::size_t target) {
  std::map<std::size_t, std::size_t> days_with;
  for (std::size_t d = 0; d < days.size(); ++d)
    if (days.size() < most_of_a_year || is_near_target(days, d, target))
      ++days_with[days[d].records];
  std::size_t usual = 0, most = 0;
  for (const auto& [records, count] : days_with)
    if (count >= most) {
      usual = records;
      most = count;
    }
  return usual;
}

/// Null: there is none.
const Day* clearest(const std::vector<Day>& days, std::size_t target) {
  const std::size_t whole_day = usual_records(days, target);
  const Day* found = nullptr;
  for (std::size_t d = 0; d < days.size(); ++d) {
    const Day& day = days[d];
    const bool is_leap_day = day.date.month == 2 && day.date.day == 29;
    if (!day.is_complete || day.records < whole_day || is_leap_day) continue;
    if (is_near_target(days, d, target) && (!found || day.sun > found->sun)) found = &day;
  }
  return found;
}

}  // namespace

std::vector<CivilTime> clear_days(const std::vector<WeatherRecord>& records, WeatherSource source) {
  std::vector<Day> days = days_of(records, source);
  const bool has_complete =
      std::any_of(days.begin(), days.end(), [](const Day& day) { return day.is_complete; });
  if (!has_complete)
    for (Day& day : days) day.is_complete = true;
  std::vector<CivilTime> chosen;
  for (std::size_t target = 0; target < targets.size(); ++target)
    if (const Day* day = clearest(days, target)) chosen.push_back(day->date);
  return chosen;
}

}  // namespace sunload
