// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/tmy3.h"

#include <fmt/format.h>

#include <array>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/file_text.h"

namespace sunload {

namespace {

constexpr std::size_t names_line = 2, first_row = 3;
constexpr std::string_view date_name = "date (mm/dd/yyyy)", time_name = "time (hh:mm)";

/// Numbers of the columns that are read; absent where the file has none of that name.
struct Columns {
  std::optional<std::size_t> date, time, ghi, dni, dhi, albedo;
  std::size_t count = 0;
};

Columns columns_of(const WeatherText& text) {
  Columns columns;
  const auto names = fields_of(text.line(names_line), ',');
  columns.count = names.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = lower_case(std::string(names[i]));
    if (name == date_name) columns.date = i;
    if (name == time_name) columns.time = i;
    if (name == "ghi (w/m^2)") columns.ghi = i;
    // SolarAnywhere writes one bracket more.
    if (name == "dni (w/m^2)" || name == "dni (w/m^2))") columns.dni = i;
    if (name == "dhi (w/m^2)") columns.dhi = i;
    if (name == "alb (unitless)") columns.albedo = i;
  }
  return columns;
}

RowStamp stamp_of(const WeatherText& text, std::size_t line, std::string_view date,
                  std::string_view time) {
  const auto days = fields_of(date, '/');
  const auto hours = fields_of(time, ':');
  if (days.size() != 3) text.fail(line, shown(date) + " is no date", "MM/DD/YYYY");
  if (hours.size() != 2) text.fail(line, shown(time) + " is no time of day", "HH:MM");
  RowStamp stamp;
  stamp.month = text.integer(days[0], line, "month", 1, 12);
  stamp.day = text.integer(days[1], line, "day", 1, 31);
  stamp.year = text.integer(days[2], line, "year", 1, 9999);
  stamp.second = text.integer(hours[0], line, "hour", 0, 24) * seconds_per_hour +
                 text.integer(hours[1], line, "minute", 0, 59) * seconds_per_minute;
  check_day(text, line, stamp);
  return stamp;
}

struct Station {
  WeatherPlace place;
  double offset_s = 0;
};

Station station_of(const WeatherText& text) {
  constexpr std::size_t wanted = 7;
  const auto fields = fields_of(text.line(1), ',');
  if (fields.size() < wanted)
    text.fail(1, fmt::format("the station has {} fields", fields.size()),
              "number, name, state, time zone, latitude, longitude, elevation");
  Station station;
  station.place.name = std::string(fields[1]);
  station.offset_s = text.number(fields[3], 1, "time zone [h]", -12, 14) * seconds_per_hour;
  station.place.latitude_deg = text.number(fields[4], 1, "latitude", -90, 90);
  station.place.longitude_deg = text.number(fields[5], 1, "longitude", -180, 180);
  station.place.elevation_m = text.number(fields[6], 1, "elevation [m]", -1000, 9999);
  return station;
}

}  // namespace

bool is_tmy3(const WeatherText& text) {
  return lower_case(std::string(text.line(names_line))).find(date_name) != std::string::npos;
}

WeatherFile read_tmy3(const WeatherText& text, std::optional<Stamp> stamp) {
  const Station station = station_of(text);
  WeatherFile file{text.path(), "TMY3", station.place, station.offset_s, {}, {}};
  const Columns columns = columns_of(text);
  if (!columns.date || !columns.time)
    text.fail(names_line, "a column is missing", "Date (MM/DD/YYYY) and Time (HH:MM) are needed");
  if (!columns.ghi && !columns.dni && !columns.dhi)
    text.fail(names_line, "no column of irradiance",
              "GHI (W/m^2), DNI (W/m^2), DHI (W/m^2) are sought");
  IrradianceReader irradiance(text, no_code, file);  // missing values are negative
  std::vector<StampedRow> rows;
  for (std::size_t line = first_row; line <= text.line_count(); ++line) {
    if (trimmed(text.line(line)).empty()) continue;
    const auto fields = fields_of(text.line(line), ',');
    if (fields.size() < columns.count)
      text.fail(line, fmt::format("has {} fields", fields.size()),
                fmt::format("there are {} columns", columns.count), "is the file cut off?");
    const auto value = [&](std::optional<std::size_t> column, const char* name) {
      return column ? irradiance(fields[*column], line, name) : std::nullopt;
    };
    rows.push_back(
        {stamp_of(text, line, fields[*columns.date], fields[*columns.time]),
         {value(columns.dni, "DNI"), value(columns.dhi, "DHI"), value(columns.ghi, "GHI"),
          columns.albedo ? ground_albedo(fields[*columns.albedo]) : std::nullopt},
         static_cast<int>(line)});
  }
  file.stamp = stamp.value_or(Stamp::end);
  file.records = records_of(text, rows, file.stamp);
  forget_years_that_do_not_follow(file.records);
  return file;
}

}  // namespace sunload
