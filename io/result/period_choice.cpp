// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/period_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/result/own_seasons.h"

namespace sunload {

namespace {

/// A whole number and nothing else.
std::optional<int> number(const std::string& text) {
  constexpr std::size_t most_digits = 6;
  const bool is_number =
      !text.empty() && text.size() <= most_digits &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  return is_number ? std::optional(std::stoi(text)) : std::nullopt;
}

[[noreturn]] void refuse(const char* option, const std::string& text, const std::string& hint) {
  throw InputError({}, fmt::format("--{} {}", option, text), "not understood", "write " + hint);
}

struct Instant {
  UnixTime utc = 0;
  CivilTime civil;
};
using Holds = std::function<bool(const Instant&)>;

Holds month_holds(const std::string& text) {
  const auto dash = text.find('-');
  const auto month = number(dash == std::string::npos ? text : text.substr(dash + 1));
  const auto year = dash == std::string::npos ? std::nullopt : number(text.substr(0, dash));
  constexpr int months = 12;
  if (!month || *month < 1 || *month > months || (dash != std::string::npos && !year))
    refuse("month", text, "1 to 12, or year and month as 2026-06");
  return [=](const Instant& at) {
    return at.civil.month == *month && (!year || at.civil.year == *year);
  };
}

Holds season_holds(const std::string& text, double latitude_deg, const OwnSeasons& own) {
  if (own.has(text)) return [&own, text](const Instant& at) { return own.holds(text, at.utc); };
  const auto name = std::find(season_names.begin(), season_names.end(), text);
  if (name == season_names.end()) {
    std::vector<std::string> known = own.names;
    for (const char* calendar : season_names)
      if (!own.has(calendar)) known.emplace_back(calendar);
    // Steps of a series that lie in several seasons leave the result without the study's own.
    refuse("season", text,
           fmt::format("{}{}", fmt::join(known, ", "),
                       own.names.empty() ? "; or one of the study's own seasons, where it has such "
                                           "and no step of its series lies in two of them"
                                         : ""));
  }
  const auto season = static_cast<std::size_t>(name - season_names.begin());
  return [=](const Instant& at) { return season_of(at.civil.month, latitude_deg) == season; };
}

ParsedTime parsed(const char* option, const std::string& text, const std::string& hint) {
  try {
    return parse_time(text);
  } catch (const InputError&) {
    refuse(option, text, hint);
  }
}

Holds day_holds(const std::string& text) {
  const std::string hint = "a date as 2026-06-21";
  const ParsedTime day = parsed("day", text, hint);
  if (day.has_time || day.has_offset) refuse("day", text, hint);
  return [=](const Instant& at) {
    return at.civil.year == day.civil.year && at.civil.month == day.civil.month &&
           at.civil.day == day.civil.day;
  };
}

Holds hours_hold(const std::string& text) {
  constexpr int last = 24;
  const auto dash = text.find('-');
  const auto from = number(text.substr(0, dash));
  const auto to = dash == std::string::npos ? std::nullopt : number(text.substr(dash + 1));
  if (!from || !to || *from >= last || *to > last || *from == *to)
    refuse("hours", text, "whole hours of the clock as 8-12, for 8:00 to 12:00");
  return [=](const Instant& at) {
    const int hour = at.civil.hour;
    return *from < *to ? hour >= *from && hour < *to : hour >= *from || hour < *to;
  };
}

UnixTime instant(const char* option, const std::string& text, const TimeZone& zone) {
  const ParsedTime time = parsed(option, text, "a date or time as 2026-06-21 or 2026-06-21T12:00");
  return time.has_offset ? utc_from_calendar(time.civil) - time.offset_s
                         : zone.utc_from_civil(time.civil).utc;
}

/// What is chosen by the clock and the calendar.
std::vector<Holds> conditions(const PeriodChoice& choice, double latitude_deg,
                              const OwnSeasons& own) {
  std::vector<Holds> all;
  if (!choice.month.empty()) all.push_back(month_holds(choice.month));
  if (!choice.season.empty()) all.push_back(season_holds(choice.season, latitude_deg, own));
  if (!choice.day.empty()) all.push_back(day_holds(choice.day));
  if (!choice.hours.empty()) all.push_back(hours_hold(choice.hours));
  return all;
}

}  // namespace

bool PeriodChoice::any() const { return !words().empty(); }

std::string PeriodChoice::words() const {
  std::string all;
  for (const auto& [name, value] : {std::pair{"month", &month},
                                    {"season", &season},
                                    {"day", &day},
                                    {"hours", &hours},
                                    {"from", &from},
                                    {"to", &to}})
    if (!value->empty()) all += fmt::format("{}{} {}", all.empty() ? "" : ", ", name, *value);
  return all;
}

std::vector<double> chosen_shares(const PeriodChoice& choice,
                                  const std::vector<TimeSpan>& intervals, const TimeZone& zone,
                                  double latitude_deg, const OwnSeasons& own) {
  constexpr double always = std::numeric_limits<double>::infinity();
  const double from = choice.from.empty() ? -always : instant("from", choice.from, zone);
  const double to = choice.to.empty() ? always : instant("to", choice.to, zone);
  const auto all = conditions(choice, latitude_deg, own);
  std::vector<double> shares(intervals.size(), 0);
  bool is_any = false;
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    double chosen_s = 0;
    for (const auto& [begin, end] : clock_hours(intervals[k], zone)) {
      const double begin_in = std::max(begin, from), end_in = std::min(end, to);
      if (!(begin_in < end_in)) continue;
      const UnixTime middle = (begin + end) / 2;
      const Instant at{middle, zone.civil_from_utc(middle)};
      if (std::all_of(all.begin(), all.end(), [&](const Holds& holds) { return holds(at); }))
        chosen_s += end_in - begin_in;
    }
    const double length_s = intervals[k][1] - intervals[k][0];
    // Sums of parts of hours: a rounding less than all of it is all of it.
    constexpr double rounding = 1e-12;
    shares[k] = chosen_s >= (1 - rounding) * length_s ? 1 : chosen_s / length_s;
    is_any = is_any || shares[k] > 0;
  }
  if (!is_any)
    throw InputError({}, choice.words() + ": the period has no such time",
                     "it is " + days_in_words(intervals, zone), "choose a part of it");
  return shares;
}

std::string days_in_words(const std::vector<TimeSpan>& intervals, const TimeZone& zone) {
  if (intervals.empty()) return "no intervals";
  const auto days = divided(PartKind::day, intervals, zone, 0).parts;
  struct Run {
    std::string first, last;
    UnixTime end = 0;
  };
  std::vector<Run> runs;
  for (const auto& day : days) {
    if (runs.empty() || day.bounds[0] > runs.back().end + seconds_per_hour)
      runs.push_back({day.label, day.label, day.bounds[1]});
    else
      runs.back() = {runs.back().first, day.label, day.bounds[1]};
  }
  constexpr std::size_t most_runs = 4;
  if (runs.size() > most_runs)
    return fmt::format("{} days of {} … {}", days.size(), days.front().label, days.back().label);
  std::string words;
  for (const auto& run : runs)
    words += (words.empty() ? "" : ", ") +
             (run.first == run.last ? run.first : run.first + " … " + run.last);
  return words;
}

}  // namespace sunload
