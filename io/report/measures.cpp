// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "io/base/text.h"

namespace sunload {

namespace {

constexpr std::size_t rows_shown = 24;  // of changes: a screen

std::string cell(double value, const char* format) {
  return std::isnan(value) ? std::string("-") : fmt::format(fmt::runtime(format), value);
}

std::string levels_text(const MeasureWords& words) {
  std::string text;
  for (std::size_t l = 0; l < words.levels.size(); ++l)
    text += fmt::format("{}{} {} {:g} {}", l > 0 ? ", " : "", words.levels[l],
                        words.more_is_better ? "from" : "up to", words.level_values[l],
                        display_units(words.units));
  return text;
}

using Json = nlohmann::ordered_json;

/// Of what a study can write; results of others may hold anything.
std::string value_text(const Json& value, int depth = 0) {
  constexpr int deepest = 4;
  if (depth > deepest) return "...";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return fmt::format("{:g}", value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, part] : value.items())
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", value.is_object() ? key + " " : "",
                        value_text(part, depth + 1));
  return text;
}

/// [year, month, day].
bool is_date(const Json& value) {
  return value.is_array() && value.size() == 3 &&
         std::all_of(value.begin(), value.end(),
                     [](const Json& part) { return part.is_number_integer(); });
}
std::string date_text(const Json& date) {
  return fmt::format("{:04}-{:02}-{:02}", date[0].get<int>(), date[1].get<int>(),
                     date[2].get<int>());
}

/// As a study writes them, but for what stands in the heading already.
std::string parameters_text(const MeasureWords& words) {
  Json parameters = Json::parse(words.parameters, nullptr, false);
  if (!parameters.is_object()) return words.parameters;
  if (Json& date = parameters["date"]; is_date(date))
    date = date_text(date);
  else
    parameters.erase("date");
  parameters.erase("name");
  parameters.erase("rule");
  return value_text(parameters);
}

std::string heading(const MeasureWords& words) {
  std::string text = fmt::format("\n{}: {}\n  {}\n  {}\n", words.name, words.definition,
                                 words.source, parameters_text(words));
  if (!words.levels.empty())
    text += fmt::format("  {}, on {:g} % of the area\n", levels_text(words), words.area_percent);
  return text;
}

Json json_number(double value) { return std::isnan(value) ? Json(nullptr) : Json(value); }

/// Whether it is what rules are about: a facade, a selection, a sensor.
bool is_judged(const MeasureRow& row) {
  return !row.level.empty() &&
         (row.kind == "facade" || row.kind == "selection" || row.kind == "sensor");
}

using Key = std::tuple<std::string, std::string, std::string>;
Key key_of(const MeasureRow& row) { return {row.measure, row.kind, row.name}; }

}  // namespace

std::string measure_table_text(const ResultReader& result, const std::vector<MeasureRow>& rows) {
  std::size_t width = 4;
  for (const MeasureRow& row : rows) width = std::max(width, row.name.size());
  std::string text = fmt::format("{}, variant {}\n", result.text_attribute("study"),
                                 result.text_attribute("variant"));
  std::string measure;
  for (const MeasureRow& row : rows) {
    if (row.measure != measure) {
      measure = row.measure;
      const MeasureWords words = measure_words(result, measure);
      text += heading(words);
      text += fmt::format("  {:<8}{:<{}}{:>10}{:>9}{:>9}{:>9}{:>9}  {}\n", "group", "name", width,
                          "area, m²", "mean", "reached", "margin", "passing", "level");
    }
    auto line = fmt::format("  {:<8}{:<{}}{:>9}{:>9}{:>9}{:>9}{:>9}  {}", row.kind, row.name, width,
                            cell(row.area_m2, "{:.1f}"), cell(row.mean, "{:.2f}"),
                            cell(row.reached, "{:.2f}"), cell(row.margin, "{:+.2f}"),
                            cell(row.passing_percent, "{:.0f} %"), row.level);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
    if (!row.spans.empty()) text += "          spans " + row.spans + "\n";
  }
  return text;
}

std::string measure_table_json(const ResultReader& result, const std::vector<MeasureRow>& rows) {
  Json measures = Json::array(), list = Json::array();
  for (const auto& name : measure_names(result)) {
    const MeasureWords words = measure_words(result, name);
    Json levels = Json::array();
    for (std::size_t l = 0; l < words.levels.size(); ++l)
      levels.push_back({{"word", words.levels[l]}, {"value", words.level_values[l]}});
    measures.push_back({{"name", name},
                        {"rule", words.rule},
                        {"units", words.units},
                        {"definition", words.definition},
                        {"source", words.source},
                        {"parameters", Json::parse(words.parameters, nullptr, false)},
                        {"levels", levels}});
  }
  for (const MeasureRow& row : rows)
    list.push_back({{"measure", row.measure},
                    {"group", row.kind},
                    {"name", row.name},
                    {"area_m2", json_number(row.area_m2)},
                    {"mean", json_number(row.mean)},
                    {"reached", json_number(row.reached)},
                    {"level", row.level.empty() ? Json(nullptr) : Json(row.level)},
                    {"margin", json_number(row.margin)},
                    {"passing_percent", json_number(row.passing_percent)},
                    {"spans", row.spans}});
  const Json document = {{"study", result.text_attribute("study")},
                         {"variant", result.text_attribute("variant")},
                         {"measures", measures},
                         {"rows", list}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string measures_line(const ResultReader& result) {
  std::string text;
  if (measure_names(result).empty()) return text;
  const auto rows = measure_table(result, {});
  for (const auto& name : measure_names(result)) {
    const MeasureWords words = measure_words(result, name);
    std::map<std::string, std::map<std::string, int>> reached;  // kind, level
    std::string line = name + ":";
    for (const MeasureRow& row : rows) {
      if (row.measure != name) continue;
      if (row.kind == "whole")
        line += fmt::format(" mean {:.3g} {}", row.mean, display_units(words.units));
      if (is_judged(row)) ++reached[row.kind][row.level];
    }
    for (const auto& [kind, levels] : reached)
      for (const auto& [level, count] : levels)
        line += fmt::format(", {} {}{} {}", count, kind, count == 1 ? "" : "s", level);
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

std::string measure_changes_text(const ResultReader& base, const ResultReader& variant,
                                 const NamedParts& parts) {
  if (measure_names(base).empty() || measure_names(variant).empty()) return {};
  std::map<Key, MeasureRow> before;
  std::map<std::string, MeasureWords> words;
  for (const auto& name : measure_names(base)) words[name] = measure_words(base, name);
  for (const MeasureRow& row : measure_table(base, parts)) before.emplace(key_of(row), row);
  std::map<std::string, std::vector<std::string>> changes;
  std::map<std::string, std::array<int, 3>> passing;  // before, after, of all
  for (const MeasureRow& row : measure_table(variant, parts)) {
    const auto found = before.find(key_of(row));
    if (!is_judged(row) || found == before.end()) continue;
    // Measured by another rule, or other limits.
    if (measure_words(variant, row.measure).parameters != words[row.measure].parameters) continue;
    auto& [of_base, of_variant, all] = passing[row.measure];
    // Selections are made of what the others are.
    if (row.kind != "selection") {
      ++all;
      of_base += found->second.level == "fail" ? 0 : 1;
      of_variant += row.level == "fail" ? 0 : 1;
    }
    if (row.level != found->second.level)
      changes[row.measure].push_back(fmt::format(
          "  {} {}: {} → {} ({:.2f} → {:.2f} {})\n", row.kind, row.name, found->second.level,
          row.level, found->second.reached, row.reached, display_units(words[row.measure].units)));
  }
  std::string text;
  for (const auto& [measure, counts] : passing) {
    text += fmt::format("\n{}: of {} facades and sensors {} pass in the base, {} in the variant\n",
                        measure, counts[2], counts[0], counts[1]);
    const auto& lines = changes[measure];
    for (std::size_t i = 0; i < std::min(lines.size(), rows_shown); ++i) text += lines[i];
    if (lines.size() > rows_shown)
      text +=
          fmt::format("  … and {} more: see info --measures --csv\n", lines.size() - rows_shown);
  }
  return text;
}

}  // namespace sunload
