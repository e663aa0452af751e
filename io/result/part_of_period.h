// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Totals of a part of the period: from stored ones, or else from the series.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/result/period_choice.h"

namespace sunload {

class ResultReader;

/// The names that a result gives to the parts of a division (`part_kind_names`) that it has.
std::vector<std::string> part_labels(const ResultReader& result, const std::string& kind);

/// Where stored parts make up what is chosen their sums are taken, with their errors; else sums of
/// stored series, whose errors nobody knows. Standard errors of several parts are those of the sums
/// of their realizations.
class PartOfPeriod {
 public:
  /// `result` must outlive it. Throws InputError where the choice says nothing, or where the result
  /// has neither the parts nor the series of it.
  PartOfPeriod(const ResultReader& result, const PeriodChoice& choice);

  /// Whether a dataset is a total of the period, which this object tells in place of the file.
  bool tells(const std::string& dataset) const;
  bool has(const std::string& dataset) const;
  /// Row-major, of the shape that the file's dataset has.
  std::vector<double> values(const std::string& dataset) const;

  /// Of every interval of the result.
  const std::vector<double>& shares() const { return shares_; }

 private:
  bool find_parts(PartKind kind, const std::vector<TimeSpan>& hours,
                  const std::vector<double>& shares_of_hours, const TimeZone& zone,
                  double latitude_deg);
  /// Dataset of the parts of a total; empty where no parts are used.
  std::string of_parts(const std::string& dataset) const;
  /// Series that a total is the sum of, or the largest value; empty: none.
  std::string of_series(const std::string& dataset) const;
  std::vector<double> sum_of_parts(const std::string& dataset) const;
  std::vector<double> from_series(const std::string& dataset) const;

  const ResultReader& result_;
  std::vector<double> shares_;
  std::vector<double> length_s_;  ///< of intervals
  bool is_whole_ = false;         ///< then the file's own totals are right
  std::string kind_;              ///< of the parts; empty: from series
  std::vector<std::size_t> rows_;
};

}  // namespace sunload
