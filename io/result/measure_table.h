// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures of a result by facade, object, surface and sensor, with their verdicts.
#pragma once

#include <string>
#include <vector>

#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// Names of the measures that a result has, in the order of the study.
std::vector<std::string> measure_names(const ResultReader& result);

/// Whether any patch or sensor has a value of it.
bool has_values(const ResultReader& result, const std::string& measure);

/// What a measure says of itself.
struct MeasureWords {
  std::string name, units;  ///< units as the file states them
  std::string rule, definition, source, parameters;
  std::vector<std::string> levels;   ///< from low to high; none: no verdict
  std::vector<double> level_values;  ///< thresholds
  bool more_is_better = true;
  double area_percent = 0;  ///< that must reach a level
};
MeasureWords measure_words(const ResultReader& result, const std::string& measure);

/// One group of patches, or a sensor.
struct MeasureRow {
  std::string measure, kind, name;  ///< kind: whole, surface, object, facade, sensor
  double area_m2 = 0;               ///< that is measured; NaN of sensors
  double mean = 0;                  ///< over the area
  double reached = 0;               ///< by `area_percent` of the area, without levels by half
  std::string level;                ///< reached; "fail" below the lowest; empty without levels
  double margin = 0;                ///< of `reached` to the lowest level: below 0 where it fails
  double passing_percent = 0;       ///< share of the area that reaches the lowest level
  std::string spans;                ///< of a sensor's sun, ISO 8601 in UTC, divided by blanks
};

/// Rows of every measure: of the groups that `parts` chooses (all where it chooses nothing) and
/// that are measured. Throws InputError where the result has no measures, or for unknown names.
std::vector<MeasureRow> measure_table(const ResultReader& result, const NamedParts& parts);

/// RFC 4180 with the header measure,group,name,area_m2,mean,reached,units,level,margin,
/// passing_percent,spans; what is not known is empty.
std::string measure_table_csv(const ResultReader& result, const std::vector<MeasureRow>& rows);

}  // namespace sunload
