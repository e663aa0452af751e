// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/zone_guess.h"

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

}  // namespace

std::optional<ZoneGuess> guessed_zone(double latitude_deg, double longitude_deg,
                                      std::optional<double> standard_offset_s) {
  std::optional<ZoneGuess> nearest, nearest_of_offset;
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
    const auto keep = [&](std::optional<ZoneGuess>& best) {
      if (!best || away < best->away_m) best = ZoneGuess{zone, away};
    };
    const bool is_nearer = !nearest_of_offset || away < nearest_of_offset->away_m;
    if (standard_offset_s && is_nearer && has_offset(zone, *standard_offset_s))
      keep(nearest_of_offset);
    keep(nearest);
  }
  return nearest_of_offset ? nearest_of_offset : nearest;
}

}  // namespace sunload
