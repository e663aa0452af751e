// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/file_text.h"

namespace sunload {

namespace {

/// Codes of missing values: nines, and all from -999 down (-6999, -9900).
constexpr std::array nines_w_m2{-9., -9.9, -9.99, -99., -99.9, -99.99};
constexpr double highest_long_code_w_m2 = -999;
/// Above the sun outside of the atmosphere (1408 at perihelion) with a bright cloud beside it.
constexpr double most_measured_w_m2 = 2000;
constexpr std::size_t longest_shown = 40;
constexpr double shortest_step_s = 1;  // no file resolves less
/// Steps that are rounded in the file (decimal hours) differ by less than this.
constexpr double step_resolution_s = 1;

bool is_code_below_zero(double value) {
  return value <= highest_long_code_w_m2 ||
         std::find(nines_w_m2.begin(), nines_w_m2.end(), value) != nines_w_m2.end();
}

bool is_printable(char c) { return c >= ' ' && c <= '~'; }

}  // namespace

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') is_quoted = !is_quoted;
    if (i < line.size() && (line[i] != separator || is_quoted)) continue;
    auto field = trimmed(line.substr(begin, i - begin));
    if (field.size() > 1 && field.front() == '"' && field.back() == '"')
      field = trimmed(field.substr(1, field.size() - 2));
    fields.push_back(field);
    begin = i + 1;
  }
  return fields;
}

std::string shown(std::string_view field) {
  std::string text(field.substr(0, longest_shown));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return !is_printable(c); }, '?');
  return "'" + text + (field.size() > longest_shown ? "..." : "") + "'";
}

WeatherText::WeatherText(const std::string& path) : path_(path), text_(read_whole_file(path)) {
  const std::size_t zero = text_.find('\0');
  if (zero != text_.npos)
    throw InputError(place_in_text(path, text_, zero), "is no text file", "it has a zero byte");
  std::string_view rest = without_byte_order_mark(text_);
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    auto line = rest.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines_.push_back(line);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

std::string_view WeatherText::line(std::size_t number) const {
  return number >= 1 && number <= lines_.size() ? lines_[number - 1] : std::string_view();
}

void WeatherText::fail(std::size_t line, const std::string& what, const std::string& why,
                       const std::string& hint) const {
  throw InputError(where(line), what, why, hint);
}

double WeatherText::number(std::string_view field, std::size_t line, const std::string& what,
                           double low, double high) const {
  double value = 0;
  if (field.starts_with('+')) field.remove_prefix(1);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
    fail(line, fmt::format("{}: {} is no number", what, shown(field)));
  if (value < low || value > high)
    fail(line, fmt::format("{}: {} is out of range", what, value),
         fmt::format("{} to {}", low, high));
  return value;
}

int WeatherText::integer(std::string_view field, std::size_t line, const std::string& what, int low,
                         int high) const {
  const double value = number(field, line, what, low, high);
  if (value != std::floor(value)) fail(line, fmt::format("{}: {} is no whole number", what, value));
  return static_cast<int>(value);
}

std::optional<double> IrradianceReader::operator()(std::string_view field, std::size_t line,
                                                   const char* column) {
  if (field.empty()) return {};
  const std::string word = lower_case(std::string(field.substr(0, longest_shown)));
  if (word == "nan" || word == "na" || word == "null") return {};
  constexpr double beyond_all_codes = 1e12;
  const double value = text_.number(field, line, column, -beyond_all_codes, beyond_all_codes);
  if (value >= missing_from_ || is_code_below_zero(value)) return {};
  if (value > most_measured_w_m2)
    text_.fail(line, fmt::format("{}: {} W/m2 is not possible", column, value),
               fmt::format("at most {} W/m2", most_measured_w_m2));
  return value < 0 ? below_zero(value, line, column) : std::abs(value);
}

std::optional<double> IrradianceReader::below_zero(double value, std::size_t line,
                                                   const char* column) {
  const bool is_offset = value >= lowest_offset_w_m2;
  BelowZero& such = is_offset ? file_.offsets : file_.too_low;
  if (such.count++ == 0) {
    such.line = static_cast<int>(line);
    such.first = fmt::format("{}: {} W/m2", column, value);
  }
  such.lowest_w_m2 = std::min(such.lowest_w_m2, value);
  return is_offset ? std::optional(0.0) : std::nullopt;
}

std::optional<double> ground_albedo(std::string_view field) {
  double albedo = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), albedo);
  const bool is_number = error == std::errc() && end == field.data() + field.size();
  return is_number && albedo > 0 && albedo < 1 ? std::optional(albedo) : std::nullopt;
}

void check_day(const WeatherText& text, std::size_t line, const RowStamp& stamp) {
  const std::chrono::year_month_day date{
      std::chrono::year{stamp.year == 0 ? leap_year : stamp.year},
      std::chrono::month{static_cast<unsigned>(stamp.month)},
      std::chrono::day{static_cast<unsigned>(stamp.day)}};
  if (!date.ok())
    text.fail(line,
              stamp.year == 0
                  ? fmt::format("month {}, day {} is no date", stamp.month, stamp.day)
                  : fmt::format("{}-{:02}-{:02} is no date", stamp.year, stamp.month, stamp.day));
}

namespace {

/// A row that is not later than the one before it, but would be if clocks had not gone back.
bool clocks_go_back(const std::vector<DatedWeather>& instants, std::size_t row) {
  if (row < 2) return false;
  const double before = instants[row - 1].begin - instants[row - 2].begin;
  return before - (instants[row].begin - instants[row - 1].begin) == seconds_per_hour;
}

/// The distance that most neighbours have.
double usual_step_s(const WeatherText& text, const std::vector<DatedWeather>& instants) {
  std::map<double, std::size_t> counts;
  for (std::size_t i = 1; i < instants.size(); ++i) {
    const double apart = instants[i].begin - instants[i - 1].begin;
    if (apart < shortest_step_s)
      text.fail(static_cast<std::size_t>(instants[i].line),
                "this row is not later than the row before it", "rows are in the order of time",
                clocks_go_back(instants, i)
                    ? "sort the rows, each time once; where these are civil times whose clocks go "
                      "back here, write local standard time, or offsets from UTC such as +02:00"
                    : "sort the rows, each time once");
    ++counts[std::round(apart / step_resolution_s) * step_resolution_s];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? seconds_per_hour : most->first;
}

void put_on_the_day_before(WeatherRecord& r) {
  const int year = r.year == 0 ? leap_year : r.year;
  const CivilTime before =
      calendar_from_utc(utc_from_calendar({year, r.month, r.day, 0, 0, 0}) - seconds_per_day);
  if (r.year != 0) r.year = before.year;
  r.month = before.month;
  r.day = before.day;
  r.begin_s += seconds_per_day;
  r.end_s += seconds_per_day;
}

/// What ends at midnight of its own clock is of the day before, and of its year; but for the first
/// row, with which a year may begin that is written from 00:00 to 23:00.
WeatherYears years_by_stamp(std::vector<WeatherRecord> instants,
                            const std::vector<StampedRow>& rows, Stamp stamp) {
  if (stamp == Stamp::end)
    for (std::size_t i = 1; i < instants.size(); ++i)
      if (rows[i].stamp.second + rows[i].clock_s == 0) put_on_the_day_before(instants[i]);
  return years_of(instants);
}

/// What ends with the 1st of a month is of the month before: a typical year ends with 31 December.
void begin_in_typical_months(std::vector<WeatherRecord>& records) {
  for (auto& r : records)
    if (r.day == 1 && r.month != 3 && r.end_s <= 0) put_on_the_day_before(r);
}

/// Records that by their own clock begin on the day before 1 March get its date: which one it is
/// depends on the year, and weather may be written as another. The 29th is it where rows of that
/// day come before. What ends with the 28th is of the 28th.
void begin_in_february(std::vector<WeatherRecord>& records, const std::vector<StampedRow>& rows) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    WeatherRecord& r = records[i];
    const double clock_s = rows[i].clock_s;
    if (r.month == 2 && r.day == 29 && r.end_s + clock_s <= 0) put_on_the_day_before(r);
    if (r.month != 3 || r.day != 1 || r.begin_s + clock_s >= 0) continue;
    const bool is_first_of_leap_year = i == 0 && r.year != 0 && std::chrono::year{r.year}.is_leap();
    const bool after_leap_day =
        i == 0 ? is_first_of_leap_year : records[i - 1].month == 2 && records[i - 1].day == 29;
    r.month = 2;
    r.day = after_leap_day ? 29 : 28;
    r.begin_s += seconds_per_day;
    r.end_s += seconds_per_day;
  }
}

}  // namespace

std::vector<WeatherRecord> records_of(const WeatherText& text, const std::vector<StampedRow>& rows,
                                      Stamp stamp) {
  if (rows.empty()) throw InputError({text.path()}, "has no rows of weather");
  std::vector<WeatherRecord> records;
  records.reserve(rows.size());
  for (const auto& row : rows)
    records.push_back({row.stamp.year, row.stamp.month, row.stamp.day, row.stamp.second,
                       row.stamp.second, row.values, row.line});
  // Rows of a typical year follow each other in a year that has all days.
  const bool is_typical = years_by_stamp(records, rows, stamp) == WeatherYears::typical;
  const std::optional<int> year = is_typical ? std::optional(leap_year) : std::nullopt;
  if (is_typical)
    for (auto& r : records) r.year = 0;
  const double step = usual_step_s(text, dated(records, year, 0));
  const double before = stamp == Stamp::start ? 0 : stamp == Stamp::middle ? step / 2 : step;
  for (auto& r : records) {
    r.begin_s -= before;
    r.end_s = r.begin_s + step;
  }
  begin_in_february(records, rows);
  if (is_typical) begin_in_typical_months(records);
  const auto placed = dated(records, year, 0);
  const auto wrong = first_out_of_order(placed);
  if (wrong < placed.size())
    text.fail(static_cast<std::size_t>(placed[wrong].line),
              "this row begins before the row before it ends",
              fmt::format("most rows are {} s apart", step), "bring all rows to one step");
  return records;
}

void forget_years_that_do_not_follow(std::vector<WeatherRecord>& records) {
  if (years_follow(records)) return;
  auto typical = records;
  for (auto& r : typical) r.year = 0;
  const auto placed = dated(typical, leap_year, 0);
  if (first_out_of_order(placed) == placed.size()) records = std::move(typical);
}

}  // namespace sunload
