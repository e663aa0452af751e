// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/epw.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/file_text.h"

namespace sunload {

namespace {

// Fields of a data line, counted from 0 (N1, N2, … of the dictionary).
enum Field : std::size_t {
  year,
  month,
  day,
  hour,
  minute,
  ghi = 13,
  dni = 14,
  dhi = 15,
  albedo = 32
};
constexpr std::size_t fewest_fields = 16;  // up to the diffuse irradiance
constexpr double missing_from = 9999;
constexpr int hours_per_day = 24, most_records_per_hour = 60;
constexpr std::size_t most_header_lines = 100;  // 8 as a rule

struct EpwHeader {
  WeatherPlace place;
  double offset_s = 0;
  int records_per_hour = 1;
  std::string_view first_day, last_day;  ///< of the only data period, as written
  std::size_t line = 0;                  ///< of DATA PERIODS
  /// Of PVGIS: values are of one moment, so long after the hour's end in UTC.
  std::optional<double> moment_s = {};
};

bool begins_with_word(std::string_view line, std::string_view word) {
  return lower_case(std::string(trimmed(line).substr(0, word.size()))) == word;
}

void read_location(const WeatherText& text, std::size_t line, EpwHeader& header) {
  const auto fields = fields_of(text.line(line), ',');
  constexpr std::size_t wanted = 10;
  if (fields.size() < wanted)
    text.fail(line, "LOCATION has too few fields", fmt::format("{} of {}", fields.size(), wanted));
  header.place.name = std::string(fields[1]);
  header.place.latitude_deg = text.number(fields[6], line, "latitude", -90, 90);
  header.place.longitude_deg = text.number(fields[7], line, "longitude", -180, 180);
  header.offset_s = text.number(fields[8], line, "time zone [h]", -12, 14) * seconds_per_hour;
  header.place.elevation_m = text.number(fields[9], line, "elevation [m]", -1000, 9999.9);
}

void read_data_periods(const WeatherText& text, std::size_t line, EpwHeader& header) {
  const auto fields = fields_of(text.line(line), ',');
  constexpr std::size_t wanted = 7;
  if (fields.size() < wanted)
    text.fail(line, "DATA PERIODS has too few fields",
              fmt::format("{} of {}", fields.size(), wanted));
  const int periods = text.integer(fields[1], line, "number of data periods", 1, 366);
  header.records_per_hour =
      text.integer(fields[2], line, "records per hour", 1, most_records_per_hour);
  if (most_records_per_hour % header.records_per_hour != 0)
    text.fail(line,
              fmt::format("{} records per hour are no whole minutes", header.records_per_hour));
  if (periods == 1) {
    header.first_day = fields[5];
    header.last_day = fields[6];
  }
  header.line = line;
}

/// PVGIS tells in a comment when its satellite looked. Its rows are those of its CSV, hours of UTC,
/// whatever zone LOCATION names (PVGIS 5.3).
void read_moment(const WeatherText& text, std::size_t line, EpwHeader& header) {
  static constexpr std::string_view key = "Irradiance Time Offset (h):";
  const std::string_view words = text.line(line);
  const auto found = words.find(key);
  if (found == words.npos) return;
  const auto written = fields_of(words.substr(found + key.size()), ',').front();
  header.moment_s =
      text.number(written, line, "irradiance time offset [h]", -1, 1) * seconds_per_hour;
}

EpwHeader read_header(const WeatherText& text) {
  EpwHeader header;
  read_location(text, 1, header);
  for (std::size_t line = 2; line <= std::min(text.line_count(), most_header_lines); ++line) {
    if (begins_with_word(text.line(line), "comments")) read_moment(text, line, header);
    if (!begins_with_word(text.line(line), "data periods")) continue;
    read_data_periods(text, line, header);
    return header;
  }
  text.fail(std::min(text.line_count(), most_header_lines), "DATA PERIODS is missing",
            "the header says how many records an hour has", "is the file cut off?");
}

/// Which record of its hour comes next, and whether hours follow each other.
class HourCounter {
 public:
  HourCounter(const WeatherText& text, int records_per_hour)
      : text_(text), per_hour_(records_per_hour) {}

  /// Number within the hour, from 0.
  int place(int month, int day, int hour, std::size_t line) {
    const double at = utc_from_calendar({leap_year, month, day, hour - 1, 0, 0});
    if (line_ == 0) {
      in_hour_ = 0;
    } else if (at == hour_ && in_hour_ + 1 < per_hour_) {
      ++in_hour_;
    } else {
      expect_next(at, line);
      in_hour_ = 0;
    }
    hour_ = at;
    line_ = line;
    return in_hour_;
  }
  bool is_hour_whole() const { return in_hour_ + 1 == per_hour_; }

 private:
  void expect_next(double at, std::size_t line) const {
    const double next = hour_ + seconds_per_hour;
    const CivilTime expected = calendar_from_utc(next);
    const bool leaps_over = expected.month == 2 && expected.day == 29 && expected.hour == 0 &&
                            at == next + seconds_per_day;
    const bool new_year = expected.year > leap_year && at == next - 366 * seconds_per_day;
    if (is_hour_whole() && (at == next || leaps_over || new_year)) return;
    text_.fail(line, "this is not the hour that follows the row before it",
               is_hour_whole() ? fmt::format("month {}, day {}, hour {} was expected",
                                             expected.month, expected.day, expected.hour + 1)
                               : fmt::format("an hour has {} records here", per_hour_),
               "are rows missing, or shuffled?");
  }

  const WeatherText& text_;
  int per_hour_;
  double hour_ = 0;
  int in_hour_ = 0;
  std::size_t line_ = 0;
};

/// Month and day of `12/31`, `1/ 1`, `31-Dec`, `1/1/2016`; absent for anything else.
std::optional<RowStamp> parse_day(std::string_view text) {
  static constexpr std::array<std::string_view, 12> months{
      "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"};
  const auto whole = [](std::string_view part) {
    int value = 0;
    for (const char c : trimmed(part)) {
      if (c < '0' || c > '9' || value > 99) return 0;
      value = value * 10 + (c - '0');
    }
    return value;
  };
  RowStamp stamp;
  if (const auto parts = fields_of(text, '/'); parts.size() >= 2) {
    stamp.month = whole(parts[0]);
    stamp.day = whole(parts[1]);
  } else if (const auto named = fields_of(text, '-'); named.size() >= 2) {
    const auto name =
        std::find(months.begin(), months.end(), lower_case(std::string(named[1].substr(0, 3))));
    stamp.month = name == months.end() ? 0 : static_cast<int>(name - months.begin()) + 1;
    stamp.day = whole(named[0]);
  } else {
    return {};
  }
  if (stamp.month == 0 || stamp.day == 0) return {};
  return stamp;
}

void expect_day(const WeatherText& text, const WeatherRecord& record, std::string_view written,
                const char* which) {
  const auto day = parse_day(written);
  if (!day || (day->month == record.month && day->day == record.day)) return;
  text.fail(static_cast<std::size_t>(record.line),
            fmt::format("the {} row is of month {}, day {}", which, record.month, record.day),
            fmt::format("DATA PERIODS says {}", shown(written)), "is the file cut off?");
}

/// Hours about the moments of their values.
void put_about_moments(const EpwHeader& header, WeatherFile& file) {
  if (!header.moment_s) return;
  const double later_s = *header.moment_s + seconds_per_hour / 2;
  for (WeatherRecord& record : file.records) {
    record.begin_s += later_s;
    record.end_s += later_s;
  }
  file.offset_s = 0;
  file.notes.push_back(fmt::format(
      "of PVGIS: values are of moments {:.3g} min after the full hours of UTC (LOCATION "
      "says UTC{:+g}); each is taken for the hour about it",
      (seconds_per_hour + *header.moment_s) / seconds_per_minute,
      header.offset_s / seconds_per_hour));
}

}  // namespace

bool is_epw(const WeatherText& text) { return begins_with_word(text.line(1), "location,"); }

WeatherFile read_epw(const WeatherText& text) {
  const EpwHeader header = read_header(text);
  WeatherFile file{text.path(), "EPW", header.place, header.offset_s, {}, {}};
  IrradianceReader irradiance(text, missing_from, file);
  HourCounter hours(text, header.records_per_hour);
  const double length = seconds_per_hour / header.records_per_hour;
  std::size_t wanted = fewest_fields;
  for (std::size_t line = header.line + 1; line <= text.line_count(); ++line) {
    if (trimmed(text.line(line)).empty()) continue;
    const auto fields = fields_of(text.line(line), ',');
    // A row that is cut off could lose digits of its last number: all are as long as the first.
    if (fields.size() < wanted)
      text.fail(line, fmt::format("has {} fields", fields.size()),
                fmt::format("at least {} are needed", wanted), "is the file cut off?");
    if (file.records.empty()) wanted = fields.size();
    WeatherRecord r;
    r.year = text.integer(fields[Field::year], line, "year", 1, 9999);
    r.month = text.integer(fields[Field::month], line, "month", 1, 12);
    r.day = text.integer(fields[Field::day], line, "day", 1, 31);
    const int hour = text.integer(fields[Field::hour], line, "hour", 1, hours_per_day);
    check_day(text, line, {0, r.month, r.day, 0});
    r.begin_s = (hour - 1) * seconds_per_hour + hours.place(r.month, r.day, hour, line) * length;
    r.end_s = r.begin_s + length;
    r.values = {irradiance(fields[Field::dni], line, "direct normal radiation"),
                irradiance(fields[Field::dhi], line, "diffuse horizontal radiation"),
                irradiance(fields[Field::ghi], line, "global horizontal radiation")};
    if (fields.size() > Field::albedo) r.values.albedo = ground_albedo(fields[Field::albedo]);
    r.line = static_cast<int>(line);
    file.records.push_back(r);
  }
  if (file.records.empty()) text.fail(header.line, "has no rows of weather");
  expect_day(text, file.records.front(), header.first_day, "first");
  expect_day(text, file.records.back(), header.last_day, "last");
  if (!hours.is_hour_whole() || file.records.back().end_s < seconds_per_day)
    text.fail(text.line_count(), "the last day is not whole", "", "is the file cut off?");
  forget_years_that_do_not_follow(file.records);
  put_about_moments(header, file);
  return file;
}

}  // namespace sunload
