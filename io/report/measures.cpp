// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "io/base/json_text.h"
#include "io/base/text.h"

namespace sunload {

namespace {

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

}  // namespace

std::string parameters_in_words(const MeasureWords& words) {
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

MeasureLikeness likeness_of(const MeasureWords& base, const MeasureWords& variant) {
  if (base.parameters == variant.parameters) return MeasureLikeness::same;
  const Json before = Json::parse(base.parameters, nullptr, false);
  Json after = Json::parse(variant.parameters, nullptr, false);
  const auto is_dated = [](const Json& of) {
    return of.is_object() && of.contains("date") && is_date(of["date"]);
  };
  if (!is_dated(before) || !is_dated(after)) return MeasureLikeness::different;
  after["date"][0] = before["date"][0];
  return before == after ? MeasureLikeness::of_other_years : MeasureLikeness::different;
}

namespace {

std::string heading(const MeasureWords& words) {
  std::string text = fmt::format("\n{}: {}\n  {}\n  {}\n", words.name, words.definition,
                                 words.source, parameters_in_words(words));
  if (!words.levels.empty())
    text += fmt::format("  {}, on {:g} % of the area\n", levels_text(words), words.area_percent);
  return text;
}

std::string row_text(const MeasureRow& row, std::size_t width) {
  auto line = fmt::format("  {:<10}{:<{}}{:>9}{:>9}{:>9}{:>9}{:>9}  {}", row.kind, row.name, width,
                          cell_text(row.area_m2, "{:.1f}"), cell_text(row.mean, "{:.2f}"),
                          cell_text(row.reached, "{:.2f}"), cell_text(row.margin, "{:+.2f}"),
                          cell_text(row.passing_percent, "{:.0f} %"), row.level);
  line.erase(line.find_last_not_of(' ') + 1);
  line += "\n";
  if (!row.spans.empty()) line += "            spans " + row.spans + "\n";
  return line;
}

/// Whether it is what rules are about: a facade, a selection, a sensor.
bool is_judged(const MeasureRow& row) {
  return !row.level.empty() &&
         (row.kind == "facade" || row.kind == "selection" || row.kind == "sensor");
}

}  // namespace

std::string measure_table_text(const ResultReader& result, const std::vector<MeasureRow>& rows) {
  std::size_t width = 4;
  for (const MeasureRow& row : rows) width = std::max(width, row.name.size());
  std::string text = fmt::format("{}, variant {}\n", result.text_attribute("study"),
                                 result.text_attribute("variant"));
  for (const std::string& measure : measure_names(result)) {
    std::string lines;
    for (const MeasureRow& row : rows)
      if (row.measure == measure) lines += row_text(row, width);
    if (!lines.empty())
      text += heading(measure_words(result, measure)) +
              fmt::format("  {:<10}{:<{}}{:>10}{:>9}{:>9}{:>9}{:>9}  {}\n", "group", "name", width,
                          "area, m²", "mean", "reached", "margin", "passing", "level") +
              lines;
    else if (!has_values(result, measure))
      text += heading(measure_words(result, measure)) + "  no value\n";
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
    std::string line;
    for (const MeasureRow& row : rows) {
      if (row.measure != name) continue;
      if (row.kind == "whole")
        line += ", mean " + number_text(row.mean, 3) + " " + display_units(words.units);
      if (is_judged(row)) ++reached[row.kind][row.level];
    }
    if (!has_values(result, name)) line += ", no value";
    for (const auto& [kind, levels] : reached)
      for (const auto& [level, count] : levels)
        line += fmt::format(", {} {}{} {}", count, kind, count == 1 ? "" : "s", level);
    text += (text.empty() ? "" : "\n") + name + ":" + (line.empty() ? line : line.substr(1));
  }
  return text;
}

}  // namespace sunload
