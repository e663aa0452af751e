// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the weather readers share: lines, fields, numbers and stamps, with their places.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/weather/file.h"

namespace sunload {

/// Stands for the year where a record has none.
inline constexpr int leap_year = 2000;
/// Where a format has no number for missing values: beyond any.
inline constexpr double no_code = 1e11;

/// The lines of a text file; throws InputError for a file that is no text.
class WeatherText {
 public:
  explicit WeatherText(const std::string& path);
  const std::string& path() const { return path_; }
  std::size_t line_count() const { return lines_.size(); }
  /// Without its line break; counted from 1, empty past the end.
  std::string_view line(std::size_t number) const;
  Where where(std::size_t line) const { return {path_, static_cast<int>(line), 0}; }
  [[noreturn]] void fail(std::size_t line, const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const;

  /// The number that a field holds, finite and within [low, high].
  double number(std::string_view field, std::size_t line, const std::string& what, double low,
                double high) const;
  int integer(std::string_view field, std::size_t line, const std::string& what, int low,
              int high) const;

 private:
  std::string path_, text_;
  std::vector<std::string_view> lines_;
};

/// Trimmed fields; quotes keep separators together and are taken off.
std::vector<std::string_view> fields_of(std::string_view line, char separator);
/// Printable and short, for messages.
std::string shown(std::string_view field);

/// Reads irradiances, and tells the file what is below zero.
class IrradianceReader {
 public:
  /// Values of `missing_from` and more are the format's code for missing ones.
  IrradianceReader(const WeatherText& text, double missing_from, WeatherFile& file)
      : text_(text), missing_from_(missing_from), file_(file) {}
  /// Absent for that code, nines below zero (-9, -9.9, -99 ...), -999 and lower, empty fields, and
  /// what no instrument's offset reaches; throws InputError for text and for more than any sky
  /// gives.
  std::optional<double> operator()(std::string_view field, std::size_t line, const char* column);

 private:
  std::optional<double> below_zero(double value, std::size_t line, const char* column);

  const WeatherText& text_;
  double missing_from_;
  WeatherFile& file_;
};

/// Albedo of the ground; absent for everything that no ground has: 0, which fills the column of
/// many files, codes of missing values, and text.
std::optional<double> ground_albedo(std::string_view field);

/// Date and time of day of a row; `second` may be that of 24:00.
struct RowStamp {
  int year = 0, month = 1, day = 1;
  double second = 0;
};
/// A row with its one stamp.
struct StampedRow {
  RowStamp stamp;
  WeatherValues values;
  int line = 0;
  double clock_s = 0;  ///< what its own clock is ahead of that of `stamp`
};

/// Throws InputError for a day that no year has.
void check_day(const WeatherText& text, std::size_t line, const RowStamp& stamp);

/// Rows as stretches of the step that most of them are apart; of typical years without a year.
/// Throws InputError for rows that do not follow one another.
std::vector<WeatherRecord> records_of(const WeatherText& text, const std::vector<StampedRow>& rows,
                                      Stamp stamp);

/// For formats of typical years, which may have a part of one: years that do not follow each other
/// become 0, unless dates come twice then.
void forget_years_that_do_not_follow(std::vector<WeatherRecord>& records);

}  // namespace sunload
