// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/csv.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/file_text.h"

namespace sunload {

namespace {

struct Head {
  std::map<std::string, std::pair<std::string_view, std::size_t>> comments;  // with their lines
  std::size_t line = 0;  ///< of the column names; 0: there is none
  char separator = ',';
  std::map<std::string, std::size_t> columns;
  std::size_t column_count = 0;
};

std::string without_unit(std::string name) {
  const std::string_view unit = "_w_m2";
  if (name.ends_with(unit)) name.resize(name.size() - unit.size());
  return name;
}

Head read_head(const WeatherText& text) {
  Head head;
  std::size_t line = 1;
  for (; line <= text.line_count(); ++line) {
    auto words = trimmed(text.line(line));
    if (words.empty()) continue;
    if (words.front() != '#') break;
    words = trimmed(words.substr(1));
    const auto colon = words.find(':');
    if (colon == words.npos) continue;
    head.comments[lower_case(std::string(trimmed(words.substr(0, colon))))] = {
        trimmed(words.substr(colon + 1)), line};
  }
  if (line > text.line_count()) return head;
  head.line = line;
  for (const char separator : {',', ';', '\t'})
    if (text.line(line).find(separator) != std::string_view::npos) {
      head.separator = separator;
      break;
    }
  const auto names = fields_of(text.line(line), head.separator);
  head.column_count = names.size();
  for (std::size_t i = 0; i < names.size(); ++i)
    head.columns.try_emplace(without_unit(lower_case(std::string(names[i]))), i);
  return head;
}

/// Digits of a fixed width; moves on past them.
int digits(std::string_view& rest, std::size_t width) {
  if (rest.size() < width) return -1;
  int value = 0;
  for (std::size_t i = 0; i < width; ++i) {
    if (rest[i] < '0' || rest[i] > '9') return -1;
    value = 10 * value + (rest[i] - '0');
  }
  rest.remove_prefix(width);
  return value;
}

bool skip(std::string_view& rest, std::string_view any_of) {
  if (rest.empty() || any_of.find(rest.front()) == any_of.npos) return false;
  rest.remove_prefix(1);
  return true;
}

/// Seconds of `Z`, `+01:00`, `+0100`, `+01`; absent for anything else.
std::optional<double> parse_offset(std::string_view text) {
  if (text == "Z" || text == "z") return 0;
  const double sign = text.starts_with('-') ? -1 : 1;
  if (!skip(text, "+-")) return {};
  const int hours = digits(text, 2);
  skip(text, ":");
  const int minutes = text.empty() ? 0 : digits(text, 2);
  if (hours < 0 || hours > 14 || minutes < 0 || minutes > 59 || !text.empty()) return {};
  return sign * (hours * seconds_per_hour + minutes * seconds_per_minute);
}

struct ParsedStamp {
  RowStamp stamp;
  std::optional<double> offset_s;
};

/// `2026-06-21T12:00[:30[.5]][Z|+02:00]`. The regular expressions of `parse_time` would take
/// seconds for a year of minutes.
std::optional<ParsedStamp> parse_stamp(std::string_view text) {
  ParsedStamp parsed;
  RowStamp& at = parsed.stamp;
  at.year = digits(text, 4);
  if (!skip(text, "-")) return {};
  at.month = digits(text, 2);
  if (!skip(text, "-")) return {};
  at.day = digits(text, 2);
  if (!skip(text, "T ")) return {};
  const int hour = digits(text, 2);
  if (!skip(text, ":")) return {};
  const int minute = digits(text, 2);
  double second = 0;
  if (skip(text, ":")) {
    second = digits(text, 2);
    if (second < 0 || second >= seconds_per_minute) return {};
    if (skip(text, "."))
      for (double place = 0.1; !text.empty() && text.front() >= '0' && text.front() <= '9';
           place /= 10)
        second += place * digits(text, 1);
  }
  const bool is_right = at.year > 0 && at.month >= 1 && at.month <= 12 && at.day >= 1 &&
                        at.day <= 31 && hour >= 0 && hour <= 24 && minute >= 0 && minute <= 59;
  if (!is_right) return {};
  at.second = hour * seconds_per_hour + minute * seconds_per_minute + second;
  if (at.second > seconds_per_day) return {};
  text = trimmed(text);
  if (text.empty()) return parsed;
  parsed.offset_s = parse_offset(text);
  return parsed.offset_s ? std::optional(parsed) : std::nullopt;
}

std::optional<double> comment_number(const WeatherText& text, const Head& head,
                                     const std::string& key, double low, double high) {
  const auto found = head.comments.find(key);
  if (found == head.comments.end()) return {};
  return text.number(found->second.first, found->second.second, key, low, high);
}

std::optional<WeatherPlace> place_of(const WeatherText& text, const Head& head) {
  const auto latitude = comment_number(text, head, "latitude_deg", -90, 90);
  const auto longitude = comment_number(text, head, "longitude_deg", -180, 180);
  if (!latitude || !longitude) return {};
  WeatherPlace place;
  const auto name = head.comments.find("place");
  if (name != head.comments.end()) place.name = std::string(name->second.first);
  place.latitude_deg = *latitude;
  place.longitude_deg = *longitude;
  place.elevation_m = comment_number(text, head, "elevation_m", -1000, 9999).value_or(0);
  return place;
}

std::optional<double> zone_of(const WeatherText& text, const Head& head) {
  const auto found = head.comments.find("utc_offset");
  if (found == head.comments.end()) return {};
  const auto offset_s = parse_offset(found->second.first);
  if (!offset_s)
    text.fail(found->second.second, shown(found->second.first) + " is no offset from UTC",
              "utc_offset: +01:00");
  return offset_s;
}

/// Stamps of all rows, which have offsets or have none.
class StampReader {
 public:
  StampReader(const WeatherText& text, const Head& head) : text_(text) {
    for (const char* name : {"date", "time"}) {
      const auto column = head.columns.find(name);
      if (column != head.columns.end()) columns_.push_back(column->second);
    }
  }

  /// A row of that time, in UTC where offsets are written.
  StampedRow operator()(const std::vector<std::string_view>& fields, std::size_t line) {
    std::string written;
    for (const auto column : columns_)
      written += (written.empty() ? "" : "T") + std::string(fields[column]);
    const auto parsed = parse_stamp(written);
    if (!parsed)
      text_.fail(line, shown(written) + " is no time",
                 "2026-06-21T12:00, with or without Z or +02:00");
    const Offsets now = parsed->offset_s ? Offsets::written : Offsets::absent;
    if (offsets_ != Offsets::unknown && offsets_ != now)
      text_.fail(line, "some rows have an offset from UTC and some have none", "",
                 "write it in all rows or in none");
    offsets_ = now;
    check_day(text_, line, parsed->stamp);
    StampedRow row{parsed->stamp, {}, static_cast<int>(line), parsed->offset_s.value_or(0)};
    row.stamp.second -= row.clock_s;
    return row;
  }
  bool are_utc() const { return offsets_ == Offsets::written; }

 private:
  enum class Offsets { unknown, written, absent };
  const WeatherText& text_;
  std::vector<std::size_t> columns_;
  Offsets offsets_ = Offsets::unknown;
};

}  // namespace

bool is_weather_csv(const WeatherText& text) {
  const Head head = read_head(text);
  return head.line > 0 && head.columns.contains("time") &&
         (head.columns.contains("dni") || head.columns.contains("dhi") ||
          head.columns.contains("ghi"));
}

WeatherFile read_weather_csv(const WeatherText& text, std::optional<Stamp> stamp) {
  const Head head = read_head(text);
  if (!stamp)
    text.fail(head.line, "nothing says what the times name",
              "the beginning, the middle or the end of each row's stretch",
              "write light.stamp: start, middle or end");
  WeatherFile file{text.path(), "CSV", place_of(text, head), zone_of(text, head), {}, {}};
  IrradianceReader irradiance(text, no_code, file);
  StampReader stamps(text, head);
  std::vector<StampedRow> rows;
  for (std::size_t line = head.line + 1; line <= text.line_count(); ++line) {
    if (trimmed(text.line(line)).empty() || trimmed(text.line(line)).front() == '#') continue;
    const auto fields = fields_of(text.line(line), head.separator);
    if (fields.size() != head.column_count)
      text.fail(line, fmt::format("has {} fields", fields.size()),
                fmt::format("there are {} columns", head.column_count), "is the file cut off?");
    const auto value = [&](const char* name) {
      const auto column = head.columns.find(name);
      return column == head.columns.end() ? std::nullopt
                                          : irradiance(fields[column->second], line, name);
    };
    const auto albedo = head.columns.find("albedo");
    rows.push_back(stamps(fields, line));
    rows.back().values = {
        value("dni"), value("dhi"), value("ghi"),
        albedo == head.columns.end() ? std::nullopt : ground_albedo(fields[albedo->second])};
  }
  file.stamp = *stamp;
  file.records = records_of(text, rows, file.stamp);
  if (stamps.are_utc()) file.offset_s = 0;
  return file;
}

}  // namespace sunload
