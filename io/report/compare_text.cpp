// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "io/base/json_text.h"
#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/report/compare.h"
#include "io/report/compared.h"
#include "io/result/mesh_error.h"

namespace sunload {
namespace {

double or_nan(const std::optional<double>& value) { return value.value_or(not_known); }

bool is_paired(const Comparison& comparison, const ComparisonRow& row) {
  return comparison.errors == Comparison::Errors::paired && row.base_kwh_m2 && row.variant_kwh_m2;
}

std::string p_in_words(double p) {
  constexpr double least_shown = 0.001;
  return p < least_shown ? fmt::format("<{}", least_shown) : cell_text(p, "{:.3f}");
}

std::string errors_in_words(const Comparison& c) {
  switch (c.errors) {
    case Comparison::Errors::paired:
      return fmt::format(
          "standard errors of paired differences of the group means, {} realizations with common "
          "random numbers (Student t)",
          c.base_realizations);
    case Comparison::Errors::independent:
      return fmt::format(
          "standard errors of both results added, {} and {} independent realizations (Welch t)",
          c.base_realizations, c.variant_realizations);
    case Comparison::Errors::none:
      return "no standard errors: results keep no realizations of it";
    case Comparison::Errors::unknown:
      break;
  }
  return "no standard errors: a result has fewer than 2 realizations, or none of this part of the "
         "period, which output.totals would store";
}

bool shows_mesh_error(const Comparison& comparison) {
  return !comparison.have_same_mesh && has_mesh_error(comparison.dataset);
}

/// Standard error, beside it where meshes differ what these put off, and p-value; nothing where no
/// group has them.
std::string error_cells(const Comparison& comparison, const std::string& se,
                        const std::string& mesh, const std::string& p) {
  std::string of_mesh = shows_mesh_error(comparison) ? fmt::format(" {:>9}", mesh) : std::string();
  if (comparison.errors == Comparison::Errors::none) return of_mesh;
  return fmt::format(" {:>9}{} {:>7}", se, of_mesh, p);
}

std::string table_row(const Comparison& comparison, const ComparisonRow& row, std::size_t width) {
  const char* state = row.significant ? "*" : "";
  if (!row.base_kwh_m2) state = "only in the variant";
  if (!row.variant_kwh_m2) state = "only in the base";
  auto text = fmt::format(
      "  {:<{}} {:>10} {:>9} {:>9} {:>11} {:>9}{}  {}", row.name, width,
      cell_text(row.area_m2, "{:.1f}"), cell_text(or_nan(row.base_kwh_m2), "{:.4g}"),
      cell_text(or_nan(row.variant_kwh_m2), "{:.4g}"), cell_text(row.difference_kwh_m2, "{:+.4g}"),
      cell_text(row.difference_percent, "{:+.2f}%"),
      error_cells(comparison, cell_text(row.se_kwh_m2, "{:.2g}"),
                  cell_text(row.mesh_error_kwh_m2, "{:.2g}"), p_in_words(row.p_corrected)),
      state);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

std::string table_head(const Comparison& comparison, const std::string& kind, std::size_t width) {
  return fmt::format("{:<{}} {:>10} {:>9} {:>9} {:>11} {:>9}{}\n", kind, width + 2, "area/m²",
                     "base", "variant", "difference", "percent",
                     error_cells(comparison, "std.err.", "mesh", "p"));
}

/// Rows of one kind, largest difference first; groups of one side only at the end.
std::vector<ComparisonRow> rows_of_kind(const Comparison& comparison, const std::string& kind) {
  std::vector<ComparisonRow> rows;
  for (const auto& row : comparison.rows)
    if (row.kind == kind) rows.push_back(row);
  const auto size = [](const ComparisonRow& row) {
    return std::isnan(row.difference_kwh_m2) ? -1 : std::abs(row.difference_kwh_m2);
  };
  std::stable_sort(rows.begin(), rows.end(), [&](const ComparisonRow& a, const ComparisonRow& b) {
    return size(a) > size(b);
  });
  return rows;
}

/// In the order of their tables.
constexpr std::array kinds{"whole",     "surface",     "object", "facade",
                           "selection", "orientation", "storey", "sensor"};
constexpr std::span counted_kinds = std::span(kinds).subspan<1>();

/// Whether anything tells what gains and loses: errors, or without them a share that matters.
bool is_counted(const Comparison& comparison) {
  return comparison.has_errors() ||
         (comparison.errors == Comparison::Errors::none && comparison.least_percent > 0);
}

/// `facade: 3 gain, 12 lose, 40 others`, a line for each kind.
std::string counts_in_words(const Comparison& comparison) {
  if (!is_counted(comparison)) return {};
  std::string text = "\nSurely different:\n";
  if (comparison.least_percent > 0)
    text = fmt::format("\n{} than {:g} %:\n", comparison.has_errors() ? "Surely more" : "More",
                       comparison.least_percent);
  std::string lines;
  for (const char* kind : counted_kinds)
    if (const auto [gain, lose, others] = change_counts(comparison, kind); gain + lose + others > 0)
      lines += fmt::format("  {:<11} {} gain, {} lose, {} others\n", kind, gain, lose, others);
  return lines.empty() ? lines : text + lines;
}

// A screen holds about so many rows of a kind; machines read the CSV.
constexpr std::size_t rows_shown_of_a_kind = 16;

/// What is compared, in which unit, and how sure it is.
std::string heading(const Comparison& comparison) {
  const std::string units = display_units(comparison.units);
  std::string text =
      fmt::format("{} of {} (variant) against {} (base){}\n{}",
                  capitalized(spaced(comparison.dataset)), comparison.variant, comparison.base,
                  units.empty() ? "" : " [" + units + "]", errors_in_words(comparison));
  if (comparison.errors == Comparison::Errors::none) return text + "\n";
  return text + fmt::format(
                    ";\n* p{}, corrected for the number of groups of a kind (Holm), is below {}\n",
                    comparison.least_percent > 0 ? fmt::format(" of a difference of {:g} % at most",
                                                               comparison.least_percent)
                                                 : "",
                    significance_level);
}

/// Names of columns end in the unit of the light load; others say theirs apart.
std::string column_names(const Comparison& comparison, std::string names) {
  if (comparison.is_of_light_load()) return unit_names(std::move(names), comparison.quantity);
  constexpr std::string_view unit = "_kwh_m2";
  for (auto at = names.find(unit); at != std::string::npos; at = names.find(unit, at))
    names.erase(at, unit.size());
  return names;
}

nlohmann::ordered_json counts_json(const Comparison& comparison) {
  nlohmann::ordered_json counts;
  if (comparison.errors == Comparison::Errors::none && !is_counted(comparison)) return counts;
  for (const char* kind : counted_kinds) {
    const auto [gain, lose, others] = change_counts(comparison, kind);
    counts[kind] = {{"gain", gain}, {"lose", lose}, {"others", others}};
  }
  return counts;
}

nlohmann::ordered_json measures_json(const Comparison& comparison) {
  constexpr std::array changes{"same", "better", "worse", "only_in_base", "only_in_variant"};
  const auto level = [](const std::string& word) {
    return word.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(word);
  };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& change : comparison.measures)
    list.push_back({{"measure", change.measure},
                    {"group", change.kind},
                    {"name", change.name},
                    {"units", change.units},
                    {"base_reached", json_number(change.base_reached)},
                    {"variant_reached", json_number(change.variant_reached)},
                    {"base_level", level(change.base_level)},
                    {"variant_level", level(change.variant_level)},
                    {"change", changes[static_cast<std::size_t>(change.to)]}});
  return list;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  std::string text = heading(comparison);
  if (shows_mesh_error(comparison))
    text += fmt::format(
        "mesh: patches differ; {}one value of reflected light per patch "
        "puts differences off by so much at most on nine groups in ten ({:g} % of that light); "
        "none "
        "within it is called sure\n",
        comparison.errors == Comparison::Errors::none ? "" : "beside the standard errors, ",
        100 * mesh_error_of_reflected);
  for (const auto& note : comparison.notes) text += "note: " + note + "\n";
  std::size_t width = 0;
  for (const auto& row : comparison.rows) width = std::max(width, row.name.size());
  for (const char* kind : kinds) {
    const auto rows = rows_of_kind(comparison, kind);
    if (rows.empty()) continue;
    text += "\n" + table_head(comparison, kind, width);
    for (std::size_t i = 0; i < std::min(rows.size(), rows_shown_of_a_kind); ++i)
      text += table_row(comparison, rows[i], width);
    if (rows.size() > rows_shown_of_a_kind)
      text += fmt::format("  … and {} more: see --csv\n", rows.size() - rows_shown_of_a_kind);
  }
  text += counts_in_words(comparison);
  double common = 0, only_in_base = 0, only_in_variant = 0;
  for (const auto& row : comparison.rows)
    if (row.kind == "whole")
      (!row.variant_kwh_m2 ? only_in_base
       : !row.base_kwh_m2  ? only_in_variant
                           : common) += row.area_m2;
  if (only_in_base + only_in_variant > 0)
    text += fmt::format(
        "\nCompared is what both results have, {:.1f} m². {:.1f} m² of the base and {:.1f} m² of "
        "the variant have no counterpart in the other result: rows of their own\n",
        common, only_in_base, only_in_variant);
  return text;
}

std::string comparison_csv(const Comparison& comparison) {
  const std::string units = comparison.is_of_light_load() ? std::string() : "," + comparison.units;
  std::string text = column_names(
      comparison,
      "group,name,area_m2,base_kwh_m2,variant_kwh_m2,difference_kwh_m2,difference_percent,"
      "se_kwh_m2,paired,p_value,p_corrected,significant,unmatched_area_m2");
  text += units.empty() ? "\n" : ",units\n";
  for (const auto& row : comparison.rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}{}\n", row.kind, csv_text(row.name),
                        csv_number(row.area_m2), csv_number(or_nan(row.base_kwh_m2)),
                        csv_number(or_nan(row.variant_kwh_m2)), csv_number(row.difference_kwh_m2),
                        csv_number(row.difference_percent), csv_number(row.se_kwh_m2),
                        is_paired(comparison, row), csv_number(row.p_value),
                        csv_number(row.p_corrected), row.significant,
                        csv_number(row.unmatched_area_m2), units);
  return text;
}

std::string comparison_json(const Comparison& comparison) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const auto key = [&](const char* name) { return column_names(comparison, name); };
  for (const auto& row : comparison.rows)
    rows.push_back({{"group", row.kind},
                    {"name", row.name},
                    {"area_m2", json_number(row.area_m2)},
                    {key("base_kwh_m2"), json_number(or_nan(row.base_kwh_m2))},
                    {key("variant_kwh_m2"), json_number(or_nan(row.variant_kwh_m2))},
                    {key("difference_kwh_m2"), json_number(row.difference_kwh_m2)},
                    {"difference_percent", json_number(row.difference_percent)},
                    {key("se_kwh_m2"), json_number(row.se_kwh_m2)},
                    {"degrees_of_freedom", json_number(row.degrees_of_freedom)},
                    {"paired", is_paired(comparison, row)},
                    {"p_value", json_number(row.p_value)},
                    {"p_corrected", json_number(row.p_corrected)},
                    {"significant", row.significant},
                    {"unmatched_area_m2", json_number(row.unmatched_area_m2)},
                    {key("mesh_error_kwh_m2"), json_number(row.mesh_error_kwh_m2)}});
  nlohmann::ordered_json document = {{"base", comparison.base}, {"variant", comparison.variant}};
  if (!comparison.is_of_light_load()) document["quantity"] = comparison.dataset;
  document["units"] = comparison.units;
  document["least_percent"] = comparison.least_percent;
  document["notes"] = comparison.notes;
  document["counts"] = counts_json(comparison);
  document["rows"] = rows;
  if (!comparison.measures.empty()) document["measures"] = measures_json(comparison);
  // Paths may be anything.
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace sunload
