// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/explain/explanation.h"

namespace sunload {

namespace {

constexpr std::size_t objects_shown = 20;  // a screen; CSV and JSON have all

std::string cell(double value, int digits) {
  if (std::isnan(value)) return "";
  // What rounds to nothing has no sign.
  const double least = 0.5 * std::pow(10.0, -digits);
  return fmt::format("{:.{}f}", std::abs(value) < least ? 0.0 : value, digits);
}

/// Digits that show a hundred-thousandth of the largest row.
int digits_for(const Explanation& explanation) {
  double largest = 0;
  for (const auto& row : explanation.rows) largest = std::max(largest, std::abs(row.total));
  if (largest <= 0) return 3;
  return std::clamp(4 - static_cast<int>(std::floor(std::log10(largest))), 0, 9);
}

/// What two objects do.
ExplainedRow together(ExplainedRow sum, const ExplainedRow& row) {
  sum.total += row.total;
  sum.share_percent += row.share_percent;
  for (std::size_t c = 0; c < column_count; ++c) sum.columns[c] += row.columns[c];
  const bool has_pairs = sum.realizations.size() == row.realizations.size();
  for (std::size_t r = 0; r < row.realizations.size() && has_pairs; ++r)
    sum.realizations[r] += row.realizations[r];
  if (!has_pairs) sum.realizations.clear();
  sum.se = sum.realizations.empty() ? std::numeric_limits<double>::quiet_NaN()
                                    : sample_mean(sum.realizations).se;
  return sum;
}

std::string heading(const Explanation& e) {
  std::string text =
      fmt::format("{} of {}, variant {} ({})", e.place, e.study, e.variant, e.extent);
  if (!e.part.empty()) text += ", " + e.part;
  if (!e.base.empty()) text += fmt::format(": what differs from {}", e.base);
  return text + fmt::format(", light load in {}\n", display_units(e.units));
}

std::vector<std::string> keys_of(const Explanation& explanation) {
  std::vector<std::string> keys{"row", "name"};
  const auto with_unit = [&](const std::string& name) {
    keys.push_back(unit_names(name + "_kwh_m2", explanation.quantity));
  };
  for (const char* name : column_names) with_unit(name);
  with_unit("total");
  with_unit("se");
  keys.emplace_back("share_percent");
  return keys;
}

/// In the order of the keys, without row and name.
std::vector<double> numbers_of(const ExplainedRow& row) {
  std::vector<double> numbers(row.columns.begin(), row.columns.end());
  numbers.insert(numbers.end(), {row.total, row.se, row.share_percent});
  return numbers;
}

}  // namespace

std::string row_words(const ExplainedRow& row, const Explanation& of) {
  switch (row.kind) {
    case ExplainedRow::Kind::open:
      return "in the open";
    case ExplainedRow::Kind::object:
      return row.name;
    case ExplainedRow::Kind::sum:
      return "adds up to";
    case ExplainedRow::Kind::result:
      return of.base.empty() ? "the result" : "the results";
    case ExplainedRow::Kind::remainder:
      return "remainder";
  }
  return {};
}

std::vector<ExplainedRow> shown_rows(const Explanation& explanation, std::size_t objects) {
  std::vector<ExplainedRow> shown;
  std::optional<ExplainedRow> others;
  std::size_t met = 0;
  for (const auto& row : explanation.rows) {
    if (row.kind == ExplainedRow::Kind::sum && others) {
      others->name = fmt::format("{} others", met - objects);
      shown.push_back(*others);
    }
    if (row.kind != ExplainedRow::Kind::object || ++met <= objects)
      shown.push_back(row);
    else
      others = others ? together(*others, row) : row;
  }
  return shown;
}

std::string explanation_text(const Explanation& explanation) {
  const bool is_difference = !explanation.base.empty();
  const int digits = digits_for(explanation);
  const auto rows = shown_rows(explanation, objects_shown);
  std::size_t width = 11;
  for (const auto& row : rows) width = std::max(width, row_words(row, explanation).size());
  std::string text = heading(explanation);
  text += fmt::format("{:{}}", "", width);
  for (const char* name : column_names) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += fmt::format("  {:>10}", words);
  }
  text += fmt::format("  {:>10}  {:>9}", "total", "± se");
  text += is_difference ? fmt::format("  {:>8}\n", "share") : "\n";
  for (const auto& row : rows) {
    text += fmt::format("{:{}}", row_words(row, explanation), width);
    for (const double value : row.columns) text += fmt::format("  {:>10}", cell(value, digits));
    text += fmt::format("  {:>10}  {:>9}", cell(row.total, digits), cell(row.se, digits));
    if (is_difference && !std::isnan(row.share_percent))
      text += fmt::format("  {:>6.1f} %", row.share_percent);
    text += "\n";
  }
  for (const auto& note : explanation.notes) text += "note: " + note + "\n";
  return text;
}

std::string explanation_csv(const Explanation& explanation) {
  std::string text = fmt::format("{}\n", fmt::join(keys_of(explanation), ","));
  for (const auto& row : explanation.rows) {
    text += kind_name(row.kind) + "," + csv_text(row.name);
    for (const double value : numbers_of(row)) text += "," + csv_number(value);
    text += "\n";
  }
  return text;
}

std::string explanation_json(const Explanation& explanation) {
  const auto keys = keys_of(explanation);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : explanation.rows) {
    nlohmann::ordered_json entry{{"row", kind_name(row.kind)}, {"name", row.name}};
    const auto numbers = numbers_of(row);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      entry[keys[k + 2]] = std::isnan(numbers[k]) ? nlohmann::ordered_json(nullptr)
                                                  : nlohmann::ordered_json(numbers[k]);
    rows.push_back(std::move(entry));
  }
  const auto or_null = [](const auto& value, bool is_known) {
    return is_known ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  };
  const nlohmann::ordered_json document = {
      {"study", explanation.study},
      {"variant", explanation.variant},
      {"against", or_null(explanation.base, !explanation.base.empty())},
      {"place", explanation.place},
      {"part", or_null(explanation.part, !explanation.part.empty())},
      {"extent", explanation.extent},
      {"units", explanation.units},
      {"notes", explanation.notes},
      {"rows", rows}};
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace sunload
