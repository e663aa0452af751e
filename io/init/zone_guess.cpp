// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/zone_guess.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "geo/base/check.h"
#include "geo/sun/site.h"
#include "geo/sun/weather.h"
#include "geo/time/time.h"

namespace sunload {

namespace {

// Of which standard offsets are asked for: rules of zones change, those of now are meant.
constexpr int year_of_offsets = 2026;

/// Degrees of `+DDMM`, `+DDMMSS`, `+DDDMM` or `+DDDMMSS`.
double degrees_of(const std::string& text, std::size_t digits_of_degrees) {
  const double sign = text.front() == '-' ? -1 : 1;
  const auto part = [&](std::size_t begin, std::size_t length) {
    return begin < text.size() ? std::atof(text.substr(begin, length).c_str()) : 0;
  };
  const std::size_t minutes = 1 + digits_of_degrees;
  return sign * (part(1, digits_of_degrees) + part(minutes, 2) / 60 + part(minutes + 2, 2) / 3600);
}

bool has_offset(const std::string& zone, double offset_s) {
  try {
    return TimeZone(zone).standard_offset_s(year_of_offsets) == offset_s;
  } catch (const InputError&) {  // of the table, and not in the database
    return false;
  }
}

/// Code of the country that an area of use is of (`Sweden - onshore and offshore.`); empty where it
/// is of several, or of none that iso3166.tab has by that name.
std::string country_of(const std::string& area) {
  const std::string name = area.substr(0, std::min(area.find(" - "), area.find('.')));
  std::ifstream table("/usr/share/zoneinfo/iso3166.tab");
  for (std::string line; std::getline(table, line);) {
    const std::size_t tab = line.find('\t');
    if (tab != std::string::npos && line.front() != '#' && line.substr(tab + 1) == name)
      return line.substr(0, tab);
  }
  return {};
}

}  // namespace

std::optional<ZoneGuess> guessed_zone(double latitude_deg, double longitude_deg,
                                      std::optional<double> standard_offset_s,
                                      const std::string& area) {
  const std::string country_meant = area.empty() ? std::string() : country_of(area);
  // From the least that is asked to the most: a map's country is certain, the station of a weather
  // file may be far away.
  enum Asked { nothing, of_offset, of_country, of_both, count };
  std::array<std::optional<ZoneGuess>, count> nearest;
  std::ifstream table("/usr/share/zoneinfo/zone.tab");
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    std::string country, place, zone;
    if (!(fields >> country >> place >> zone) || place.size() < 2) continue;
    const std::size_t second = place.find_first_of("+-", 1);
    if (second == std::string::npos) continue;
    const double away = distance_m({.latitude_deg = latitude_deg, .longitude_deg = longitude_deg},
                                   {.latitude_deg = degrees_of(place.substr(0, second), 2),
                                    .longitude_deg = degrees_of(place.substr(second), 3)});
    const auto is_nearer = [&](Asked asked) {
      return !nearest[asked] || away < nearest[asked]->away_m;
    };
    const auto keep = [&](Asked asked) {
      if (is_nearer(asked)) nearest[asked] = ZoneGuess{zone, away};
    };
    const bool is_named = country == country_meant;
    // Reading a zone takes time: only those that could be chosen.
    const bool may_have_offset =
        standard_offset_s && (is_nearer(of_offset) || (is_named && is_nearer(of_both)));
    keep(nothing);
    if (is_named) keep(of_country);
    if (!may_have_offset || !has_offset(zone, *standard_offset_s)) continue;
    keep(of_offset);
    if (is_named) keep(of_both);
  }
  const auto best = std::find_if(nearest.rbegin(), nearest.rend(),
                                 [](const auto& guess) { return guess.has_value(); });
  return best == nearest.rend() ? std::nullopt : *best;
}

}  // namespace sunload
