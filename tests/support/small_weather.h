// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Weather that never was: clear days whose light follows the sun of a place, in several formats.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "geo/base/units.h"

namespace sunload::test {

/// A station with hours of its zone's time.
struct SmallStation {
  double latitude_deg = 48.13, longitude_deg = 11.7, elevation_m = 529;
  int offset_h = 1;
};

struct SmallHour {
  int month = 1, day = 1, hour = 1;  ///< the hour that ends then, 1 … 24
  int dni = 0, dhi = 0, ghi = 0;
};

/// Light of the middle of an hour: Cooper's (1969) declination, no equation of time.
inline SmallHour small_hour(const SmallStation& at, int month, int day, int hour, int day_of_year) {
  const double declination = radians(23.45 * std::sin(2 * pi * (284 + day_of_year) / 365));
  const double solar_h = hour - 0.5 + at.longitude_deg / 15 - at.offset_h;
  const double height = std::sin(radians(at.latitude_deg)) * std::sin(declination) +
                        std::cos(radians(at.latitude_deg)) * std::cos(declination) *
                            std::cos(radians(15 * (solar_h - 12)));
  SmallHour light{month, day, hour};
  if (height <= 0) return light;
  light.dni = static_cast<int>(850 * std::pow(height, 0.3));
  light.dhi = static_cast<int>(120 * height);
  light.ghi = static_cast<int>(light.dni * height + light.dhi);
  return light;
}

/// `row` of every hour of a year of 365 days.
template <class Row>
void each_small_hour(const SmallStation& at, const Row& row) {
  constexpr std::array<int, 12> lengths{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  int day_of_year = 0;
  for (int month = 1; month <= 12; ++month)
    for (int day = 1; day <= lengths[static_cast<std::size_t>(month) - 1]; ++day) {
      ++day_of_year;
      for (int hour = 1; hour <= 24; ++hour) row(small_hour(at, month, day, hour, day_of_year));
    }
}

/// A typical year: every month is of another one.
inline std::string small_epw(const SmallStation& at = {}) {
  std::string text = fmt::format(
      "LOCATION,NOWHERE,-,-,Synthetic,0,{},{},{},{}\nDESIGN CONDITIONS,0\n"
      "TYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n"
      "COMMENTS 1,clear days that never were\nCOMMENTS 2,\n"
      "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n",
      at.latitude_deg, at.longitude_deg, at.offset_h, at.elevation_m);
  each_small_hour(at, [&](const SmallHour& h) {
    text += fmt::format("{},{},{},{},60,A7,10,5,70,95300,0,1415,300,{},{},{},0,0,0,0\n",
                        1980 + 3 * h.month % 12, h.month, h.day, h.hour, h.ghi, h.dni, h.dhi);
  });
  return text;
}

inline std::string small_wea(const SmallStation& at = {}) {
  std::string text = fmt::format(
      "place nowhere\nlatitude {}\nlongitude {}\ntime_zone {}\nsite_elevation {}\n"
      "weather_data_file_units 1\n",
      at.latitude_deg, -at.longitude_deg, -15 * at.offset_h, at.elevation_m);
  each_small_hour(at, [&](const SmallHour& h) {
    text += fmt::format("{} {} {}.5 {} {}\n", h.month, h.day, h.hour - 1, h.dni, h.dhi);
  });
  return text;
}

/// The year 2026.
inline std::string small_csv(const SmallStation& at = {}) {
  std::string text = "time,dni_w_m2,dhi_w_m2\n";
  each_small_hour(at, [&](const SmallHour& h) {
    text += fmt::format("2026-{:02}-{:02}T{:02}:00,{},{}\n", h.month, h.day, h.hour, h.dni, h.dhi);
  });
  return text;
}

/// Rows of a CSV: hours of UTC from the 10th of a month of 2026 on, but for the two about the first
/// midnight.
inline std::string hours_without_midnight(int month, int hours) {
  std::string rows;
  for (int hour = 0; hour < hours; ++hour)
    if (hour != 23 && hour != 24)
      rows += fmt::format("2026-{:02}-{:02}T{:02}:00,100,40\n", month, 10 + hour / 24, hour % 24);
  return rows;
}

}  // namespace sunload::test
