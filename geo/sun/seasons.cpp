// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/seasons.h"

#include <array>
#include <cctype>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/pattern.h"
#include "geo/base/units.h"
#include "geo/sun/sun.h"

namespace sunload {

namespace {

constexpr double quarter_turn_deg = 90, half_turn_deg = 180;

// Mean obliquity of the ecliptic in 2000 and its change, IAU 2006 (Capitaine et al. 2003). Where
// the longitude is a multiple of 90°, nutation and an error of it move the longitude only by their
// product with the sun's latitude (1″): nothing.
constexpr double obliquity_2000_deg = 84381.406 / 3600;
constexpr double obliquity_change_deg_per_day = -46.836769 / 3600 / 36525;
constexpr double j2000 = 2451545.0;

double longitude_deg(UnixTime utc) {
  const TimeScales when = time_scales(utc, Ut1::table);
  const ApparentPlace sun = apparent_place(when);
  const double days = (when.tt.day - j2000) + when.tt.fraction;
  const double obliquity = radians(obliquity_2000_deg + obliquity_change_deg_per_day * days);
  const double a = radians(sun.right_ascension_deg), d = radians(sun.declination_deg);
  return degrees(std::atan2(std::sin(a) * std::cos(obliquity) + std::tan(d) * std::sin(obliquity),
                            std::cos(a)));
}

// First guesses: dates of the beginning of the century; they wander by two days.
constexpr std::array<CivilTime, 4> about{
    {{0, 3, 20, 12, 0, 0}, {0, 6, 21, 12, 0, 0}, {0, 9, 22, 12, 0, 0}, {0, 12, 21, 12, 0, 0}}};

struct Known {
  const char* word;
  NamedDay::Name name;
};
constexpr std::array<Known, 6> names{{{"march_equinox", NamedDay::Name::march_equinox},
                                      {"june_solstice", NamedDay::Name::june_solstice},
                                      {"september_equinox", NamedDay::Name::september_equinox},
                                      {"december_solstice", NamedDay::Name::december_solstice},
                                      {"summer_solstice", NamedDay::Name::summer_solstice},
                                      {"winter_solstice", NamedDay::Name::winter_solstice}}};

Season season_of(NamedDay::Name name, double latitude_deg) {
  switch (name) {
    case NamedDay::Name::march_equinox:
      return Season::march_equinox;
    case NamedDay::Name::september_equinox:
      return Season::september_equinox;
    case NamedDay::Name::june_solstice:
      return Season::june_solstice;
    case NamedDay::Name::december_solstice:
      return Season::december_solstice;
    case NamedDay::Name::summer_solstice:
      return latitude_deg >= 0 ? Season::june_solstice : Season::december_solstice;
    case NamedDay::Name::winter_solstice:
      return latitude_deg >= 0 ? Season::december_solstice : Season::june_solstice;
  }
  contract_failed("a known day", __FILE__, __LINE__, "name of a day");
}

}  // namespace

UnixTime season_instant(Season season, int year) {
  // Mean motion in longitude; its error of 3 % makes each step leave a thirtieth.
  constexpr double motion_deg_per_s = 360 / (365.2422 * seconds_per_day);
  constexpr double good_enough_s = 1e-3;
  constexpr int most_steps = 50;
  const auto quarter = static_cast<std::size_t>(season);
  const double wanted_deg = quarter_turn_deg * static_cast<double>(quarter);
  CivilTime guess = about[quarter];
  guess.year = year;
  UnixTime t = utc_from_calendar(guess);
  for (int n = 0; n < most_steps; ++n) {
    const double missing_deg =
        wrapped_deg(wanted_deg - longitude_deg(t) + half_turn_deg) - half_turn_deg;
    const double step_s = missing_deg / motion_deg_per_s;
    t += step_s;
    if (std::abs(step_s) < good_enough_s) return t;
  }
  contract_failed("the search for a season ends", __FILE__, __LINE__, std::to_string(year));
}

CivilTime season_date(Season season, int year, const TimeZone& zone) {
  CivilTime date = zone.civil_from_utc(season_instant(season, year));
  date.hour = date.minute = 0;
  date.second = 0;
  return date;
}

bool is_day_name(const std::string& text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

NamedDay parse_named_day(const std::string& text) {
  static const Pattern pattern(R"(([a-z_]+)(?: +(\d{4}))?)");
  if (const auto found = pattern.whole(text)) {
    const auto& part = *found;
    for (const auto& known : names) {
      if (part[1].text != known.word) continue;
      if (!part[2].matched) {
        throw InputError({}, "'" + text + "' has no year", "the date differs between years",
                         "write for example " + text + " 2026");
      }
      return {known.name, std::stoi(part[2].text)};
    }
  }
  std::string words;
  for (const auto& known : names) words += (words.empty() ? "" : ", ") + std::string(known.word);
  throw InputError({}, "'" + text + "' is no day",
                   "a date YYYY-MM-DD, or a name with its year is read; names: " + words,
                   "write for example june_solstice 2026");
}

CivilTime civil_date(const NamedDay& day, const TimeZone& zone, double latitude_deg) {
  return season_date(season_of(day.name, latitude_deg), day.year, zone);
}

}  // namespace sunload
