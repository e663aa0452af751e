// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/wea.h"

#include <fmt/format.h>

#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/file_text.h"

namespace sunload {

namespace {

/// Hours have three decimals; nearer than this to a whole minute they mean it.
constexpr double hour_rounding_s = 2;
enum class Units { direct_normal = 1, direct_horizontal = 2, illuminance = 3 };

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (const auto word : fields_of(line, ' '))
    for (const auto part : fields_of(word, '\t'))
      if (!part.empty()) words.push_back(part);
  return words;
}

/// The lines of the header in their fixed order.
class HeaderReader {
 public:
  explicit HeaderReader(const WeatherText& text) : text_(text) {}

  /// What follows `key` on the next line.
  std::string_view rest(std::string_view key) {
    const auto line = trimmed(text_.line(++line_));
    const bool fits =
        line.starts_with(key) &&
        (line.size() == key.size() || line[key.size()] == ' ' || line[key.size()] == '\t');
    if (!fits)
      text_.fail(line_, fmt::format("'{}' was expected", key), "the header has a fixed order");
    return trimmed(line.substr(key.size()));
  }
  double number(std::string_view key, double low, double high) {
    const auto value = rest(key);
    return text_.number(value, line_, std::string(key), low, high);
  }
  std::size_t line() const { return line_; }

 private:
  const WeatherText& text_;
  std::size_t line_ = 0;
};

/// The middles of steps of 5 and of 1 minute are half minutes.
double second_of(double hours) {
  constexpr double half_minute = seconds_per_minute / 2;
  const double second = hours * seconds_per_hour;
  const double whole = std::round(second / half_minute) * half_minute;
  return std::abs(second - whole) < hour_rounding_s ? whole : second;
}

}  // namespace

bool is_wea(const WeatherText& text) {
  return !words_of(text.line(1)).empty() && words_of(text.line(1)).front() == "place";
}

WeatherFile read_wea(const WeatherText& text, std::optional<Stamp> stamp) {
  HeaderReader header(text);
  WeatherPlace place;
  place.name = std::string(header.rest("place"));
  place.latitude_deg = header.number("latitude", -90, 90);
  place.longitude_deg = -header.number("longitude", -180, 180);
  const double offset_s =
      -header.number("time_zone", -210, 180) / degrees_of_sun_per_hour * seconds_per_hour;
  place.elevation_m = header.number("site_elevation", -1000, 9999);
  const auto units =
      static_cast<Units>(static_cast<int>(header.number("weather_data_file_units", 1, 3)));
  if (units == Units::illuminance)
    text.fail(header.line(), "weather_data_file_units 3 is illuminance", "irradiance is needed",
              "write the file with units 1");
  WeatherFile file{text.path(), "WEA", place, offset_s, {}, {}};
  IrradianceReader irradiance(text, no_code, file);
  std::vector<StampedRow> rows;
  for (std::size_t line = header.line() + 1; line <= text.line_count(); ++line) {
    const auto words = words_of(text.line(line));
    if (words.empty()) continue;
    if (words.size() != 5)
      text.fail(line, fmt::format("has {} numbers", words.size()),
                "month, day, hour, direct, diffuse are needed");
    RowStamp at;
    at.month = text.integer(words[0], line, "month", 1, 12);
    at.day = text.integer(words[1], line, "day", 1, 31);
    at.second = second_of(text.number(words[2], line, "hour", 0, 24));
    check_day(text, line, at);
    StampedRow row{at, {{}, irradiance(words[4], line, "diffuse"), {}}, static_cast<int>(line)};
    const auto direct = irradiance(words[3], line, "direct");
    if (units == Units::direct_normal) {
      row.values.dni = direct;
    } else if (direct && row.values.dhi) {
      row.values.ghi = *direct + *row.values.dhi;
    }
    rows.push_back(row);
  }
  file.stamp = stamp.value_or(Stamp::middle);
  file.records = records_of(text, rows, file.stamp);
  return file;
}

}  // namespace sunload
