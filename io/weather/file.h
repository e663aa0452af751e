// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Weather files: EPW, TMY3, WEA and CSV, told apart by what they begin with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/base/check.h"
#include "geo/sun/weather.h"

namespace sunload {

/// Where the station stands, from the file's header.
struct WeatherPlace {
  std::string name;                            ///< UTF-8 on one line (io/base/names.h)
  double latitude_deg = 0, longitude_deg = 0;  ///< longitude east positive, whatever the format
  double elevation_m = 0;
};

/// Pyranometers lose heat to the sky: the zero offset of those of class B (ISO 9060:2018) [W m-2].
inline constexpr double lowest_offset_w_m2 = -15;

/// Irradiances below zero.
struct BelowZero {
  std::size_t count = 0;
  double lowest_w_m2 = 0;
  int line = 0;       ///< of the first
  std::string first;  ///< "dni: -2.5 W/m2"
};

/// A weather file as read, before it is dated and filled.
struct WeatherFile {
  std::string path;
  std::string format;  ///< EPW, TMY3, WEA, CSV
  std::optional<WeatherPlace> place;
  /// Local standard time minus UTC [s]; absent where the file does not say: the study's zone.
  std::optional<double> offset_s;
  std::vector<WeatherRecord> records;  ///< at least one, in order
  std::vector<std::string> notes;
  Stamp stamp = Stamp::end;  ///< as it was taken: the format's own, or what the study says
  BelowZero offsets{};       ///< values from `lowest_offset_w_m2` on, which are 0 in the records
  BelowZero too_low{};  ///< lower ones that are no codes of missing values; absent in the records
};

/// `stamp`: absent is the format's own (EPW, TMY3 end; WEA middle); CSV needs one.
/// Throws InputError with file and line for what cannot be read.
WeatherFile read_weather_file(const std::string& path, std::optional<Stamp> stamp);

}  // namespace sunload
