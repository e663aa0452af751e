// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sections `site` and `period` of a study.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "geo/base/units.h"
#include "geo/sun/seasons.h"
#include "geo/sun/site.h"
#include "io/study/sections.h"
#include "io/weather/horizon_csv.h"

namespace sunload::study_sections {

namespace {

constexpr Range latitudes_deg{-90, 90, Range::Low::included, "are latitude and longitude swapped?"};
constexpr Range longitudes_deg{-180, 180};
constexpr Range elevations_m{-500, 9000};  // the shore of the Dead Sea, the top of Everest
constexpr Range azimuths_deg{0, 360}, sun_elevations_deg{-90, 90};
// Doubles tell instants to 1e-6 s: the shortest is known to 1e-4 of itself. Up to a leap year.
constexpr Range lengths_min{0.001, 527040};
constexpr int first_year = 1800, last_year = 2200;  // of the sun's theory with some margin
constexpr double most_intervals = 1e7;  // 20 years of minutes; each costs at least a row of patches
constexpr double whole_steps_tolerance = 1e-9;  // rounding of step lengths such as 1/3 min

std::optional<ParsedTime> read_time(YamlMap& map, const std::string& key, const PlacedText& text) {
  try {
    return parse_time(text.text);
  } catch (const InputError& error) {
    add_at(map, key, text.where, error);
    return {};
  }
}

/// Turns written times into instants; times without offset need a written zone.
class Clock {
 public:
  Clock(YamlMap& map, const SiteRead& site)
      : map_(map),
        written_(site.zone_written),
        site_where_(site.site.where),
        latitude_deg_(site.site.latitude_deg) {
    try {
      zone_ = TimeZone(site.site.timezone);
    } catch (const InputError&) {  // reported where the site was read
    }
  }

  UnixTime utc(const ParsedTime& time) {
    if (time.has_offset) return utc_from_calendar(time.civil) - time.offset_s;
    require_zone();
    return zone_.utc_from_civil(time.civil).utc;
  }

  /// The civil date of a day that is named, such as `june_solstice 2026`.
  std::optional<CivilTime> date(const std::string& key, const PlacedText& text) {
    try {
      const NamedDay day = parse_named_day(text.text);
      if (day.depends_on_hemisphere() && !latitude_deg_) {
        map_.reading().problem(text.where,
                               map_.path(key) + ": " + text.text + " depends on the hemisphere",
                               "the study does not give the latitude",
                               "name the month: june_solstice or december_solstice");
        return {};
      }
      return civil_date(day, zone_, latitude_deg_.value_or(0));
    } catch (const InputError& error) {
      add_at(map_, key, text.where, error);
      return {};
    }
  }

  void require_zone() {
    if (written_ == ZoneWritten::yes) return;
    map_.reading().problem(site_where_, "site.timezone is missing",
                           "times without offset are civil time of the site",
                           "write for example timezone: Europe/Prague, or timezone: UTC");
  }

 private:
  YamlMap& map_;
  ZoneWritten written_;
  Where site_where_;
  std::optional<double> latitude_deg_;
  TimeZone zone_{"UTC"};
};

/// A span must be a whole number of steps, and not too many of them.
void check_steps(YamlMap& map, double span_s, double step_min, double times,
                 const std::string& hint) {
  const double steps = span_s / (step_min * seconds_per_minute);
  if (std::abs(steps - std::round(steps)) > whole_steps_tolerance * steps ||
      std::round(steps) < 1) {
    map.problem("step_min",
                fmt::format("{} minutes are no whole number of steps of {} minutes",
                            span_s / seconds_per_minute, step_min),
                "the last step would be cut", hint);
  } else if (steps * times > most_intervals) {
    map.problem("step_min", fmt::format("{:.9g} intervals are too many", steps * times),
                fmt::format("at most {:.0f}", most_intervals), "make the steps longer");
  }
}

double read_time_of_day(YamlMap& map, const std::string& key, double absent) {
  const auto text = map.text(key);
  if (!text) return absent;
  try {
    return parse_time_of_day(*text);
  } catch (const InputError& error) {
    add_at(map, key, map.where(key), error);
    return absent;
  }
}

/// A date, or the date of a day that has a name.
std::optional<CivilTime> read_day(YamlMap& map, const PlacedText& text, Clock& clock) {
  if (is_day_name(text.text)) return clock.date("days", text);
  const auto day = read_time(map, "days", text);
  if (!day) return {};
  if (day->has_time) {
    map.reading().problem(text.where, "period.days: '" + text.text + "' has a time of day", "",
                          "write the date alone; `from` and `to` give the times");
  }
  return day->civil;
}

std::vector<CivilTime> read_days(YamlMap& map, Clock& clock) {
  std::vector<CivilTime> days;
  std::optional<UnixTime> before;
  for (const auto& text : map.texts("days")) {
    const auto day = read_day(map, text, clock);
    if (!day) continue;
    const UnixTime midnight = utc_from_calendar(*day);
    if (before && midnight <= *before) {
      map.reading().problem(text.where,
                            "period.days: " + text.text + " is not after the day before it",
                            "time must increase", "sort the days, each once");
    }
    before = midnight;
    days.push_back(*day);
  }
  return days;
}

DaysPeriod read_days_period(YamlMap& map, double step_min, Clock& clock) {
  DaysPeriod period;
  period.days = read_days(map, clock);
  period.step_min = step_min;
  period.from_s = read_time_of_day(map, "from", period.from_s);
  period.to_s = read_time_of_day(map, "to", period.to_s);
  clock.require_zone();
  if (period.to_s <= period.from_s) {
    map.problem("to", "is not after `from`", "an interval cannot pass midnight",
                "for nights use start and end");
  } else {
    check_steps(map, period.to_s - period.from_s, period.step_min,
                static_cast<double>(period.days.size()), "choose a step that divides the time");
  }
  return period;
}

RangePeriod read_range_period(YamlMap& map, double step_min, Clock& clock) {
  RangePeriod period;
  period.step_min = step_min;
  map.require("end");
  const auto read_bound = [&](const char* key, ParsedTime& bound) -> std::optional<UnixTime> {
    const auto text = map.text(key);
    const auto time = text ? read_time(map, key, {*text, map.where(key)}) : std::nullopt;
    if (!time) return {};
    bound = *time;
    return clock.utc(*time);
  };
  const auto start = read_bound("start", period.start), end = read_bound("end", period.end);
  if (!start || !end) return period;
  if (*end <= *start) {
    map.problem("end", "is not after `start`");
  } else {
    check_steps(map, *end - *start, period.step_min, 1,
                "change `end` or the step; where the clocks change in between, days have 23 or "
                "25 hours");
  }
  return period;
}

InstantsPeriod read_instants_period(YamlMap& map, double interval_min, Clock& clock) {
  InstantsPeriod period;
  period.interval_min = interval_min;
  std::optional<UnixTime> before;
  for (const auto& text : map.texts("instants")) {
    const auto time = read_time(map, "instants", text);
    if (!time) continue;
    const UnixTime utc = clock.utc(*time);
    if (before && utc <= *before) {
      map.reading().problem(text.where,
                            "period.instants: " + text.text + " is not after the one before it",
                            "time must increase", "sort the instants, each once");
    } else if (before && utc - *before < interval_min * seconds_per_minute) {
      map.reading().warn(map.where(), "period.instants: intervals overlap",
                         "what they share counts twice in light_load", "make interval_min shorter");
    }
    before = utc;
    period.instants.push_back(*time);
  }
  return period;
}

PositionsPeriod read_positions_period(YamlMap& map) {
  PositionsPeriod period;
  map.each("positions", [&](YamlMap& item) {
    SunAt sun;
    item.require("azimuth_deg");
    item.require("elevation_deg");
    sun.azimuth_deg = item.number("azimuth_deg", azimuths_deg, sun.azimuth_deg);
    sun.elevation_deg = item.number("elevation_deg", sun_elevations_deg, sun.elevation_deg);
    sun.interval_min = item.number("interval_min", lengths_min, sun.interval_min);
    period.positions.push_back(sun);
  });
  return period;
}

/// One interval per record of the weather file.
WeatherPeriod read_weather_period(YamlMap& map) {
  WeatherPeriod period;
  map.word("year_of", {"weather"}, "weather");
  if (map.has("as_year")) {
    period.as_year = map.integer("as_year", first_year, last_year, first_year);
  }
  map.tree("as_year");
  return period;
}

/// `position`: one text instead of latitude_deg and longitude_deg.
void read_position(YamlMap& map, SiteStudy& site) {
  const auto text = map.text("position");
  if (!text) return;
  if (map.has("latitude_deg") || map.has("longitude_deg")) {
    map.problem("position", "stands beside latitude_deg and longitude_deg",
                "the place would be said twice", "remove one of them");
    return;
  }
  try {
    const Site place = site_from_text(*text);
    site.latitude_deg = place.latitude_deg;
    site.longitude_deg = place.longitude_deg;
  } catch (const InputError& error) {
    add_at(map, "position", map.where("position"), error);
  }
}

/// `horizon`: a file beside the study.
void read_horizon(YamlMap& map, const std::string& folder, SiteStudy& site) {
  const auto name = map.text("horizon");
  if (!name) return;
  try {
    site.horizon = read_horizon_csv((std::filesystem::path(folder) / *name).string());
  } catch (const InputError& error) {
    add_at(map, "horizon", map.where("horizon"), error);
  }
}

/// Keys that go with another kind of period.
void refuse_strays(YamlMap& map, const std::string& kind, const std::vector<std::string>& fitting) {
  for (const std::string key : {"from", "to", "end", "step_min", "interval_min", "as_year"}) {
    const bool fits = std::find(fitting.begin(), fitting.end(), key) != fitting.end();
    if (map.has(key) && !fits) map.problem(key, "does not go with `" + kind + "`", "", "remove it");
  }
}

}  // namespace

void add_at(YamlMap& map, const std::string& key, const Where& where, const InputError& error) {
  for (const auto& text : error.problems()) {
    map.reading().problem(where, map.path(key) + ": " + text);
  }
}

SiteRead read_site(YamlMap& map, const std::string& folder) {
  SiteRead result;
  SiteStudy& site = result.site;
  site.where = map.where();
  site.latitude_deg = map.number("latitude_deg", latitudes_deg);
  site.longitude_deg = map.number("longitude_deg", longitudes_deg);
  if (map.has("latitude_deg")) map.require("longitude_deg");
  if (map.has("longitude_deg")) map.require("latitude_deg");
  read_position(map, site);
  site.crs = map.text("crs", site.crs);
  for (const char* key : {"latitude_deg", "longitude_deg", "position", "crs"}) {
    if (map.has(key)) result.place_written = PlaceWritten::yes;
  }
  site.elevation_m = map.number("elevation_m", elevations_m);
  site.north_deg = map.number("north_deg", turns_deg);
  read_horizon(map, folder, site);
  if (map.has("timezone")) result.zone_written = ZoneWritten::yes;
  site.timezone = map.text("timezone", site.timezone);
  try {
    TimeZone zone(site.timezone);
  } catch (const InputError& error) {
    add_at(map, "timezone", map.where("timezone"), error);
  }
  return result;
}

PeriodStudy read_period(YamlMap& map, const SiteRead& site) {
  PeriodStudy period;
  period.where = map.where();
  for (const char* key :
       {"days", "from", "to", "start", "end", "instants", "positions", "year_of", "as_year"}) {
    map.tree(key);  // known, whatever the kind: what does not fit is told as such
  }
  const double step_min = map.number("step_min", lengths_min, DaysPeriod{}.step_min);
  const double interval_min =
      map.number("interval_min", lengths_min, InstantsPeriod{}.interval_min);
  std::vector<std::string> kinds;
  for (const char* kind : {"days", "start", "instants", "positions", "year_of"}) {
    if (map.has(kind)) kinds.push_back(kind);
  }
  if (map.reading().purpose == YamlReading::Purpose::describe) kinds = {"positions"};
  if (!map.is_usable()) return period;
  if (kinds.size() != 1) {
    map.reading().problem(map.where(),
                          kinds.empty()
                              ? "period has no times"
                              : fmt::format("period has {} at once", fmt::join(kinds, " and ")),
                          "it needs one of days, start with end, instants, positions, year_of");
    return period;
  }
  Clock clock(map, site);
  const std::string& kind = kinds.front();
  if (kind == "days") {
    period.kind = read_days_period(map, step_min, clock);
    refuse_strays(map, kind, {"from", "to", "step_min"});
  } else if (kind == "start") {
    period.kind = read_range_period(map, step_min, clock);
    refuse_strays(map, kind, {"end", "step_min"});
  } else if (kind == "instants") {
    period.kind = read_instants_period(map, interval_min, clock);
    refuse_strays(map, kind, {"interval_min"});
  } else if (kind == "year_of") {
    period.kind = read_weather_period(map);
    refuse_strays(map, kind, {"as_year"});
  } else {
    period.kind = read_positions_period(map);
    refuse_strays(map, kind, {});
  }
  return period;
}

}  // namespace sunload::study_sections
