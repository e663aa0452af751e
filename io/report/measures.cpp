// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "io/base/json_text.h"
#include "io/base/name_pattern.h"
#include "io/base/text.h"

namespace sunload {

namespace {

constexpr std::size_t changes_shown = 24;  // of changes: a screen

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

using Key = std::tuple<std::string, std::string, std::string>;
Key key_of(const MeasureRow& row) { return {row.measure, row.kind, row.name}; }

/// In the order of their tables.
constexpr std::array compared_kinds{"object", "facade", "selection", "sensor"};

bool has_verdict(const MeasureRow& row) {
  return !row.level.empty() &&
         std::find(compared_kinds.begin(), compared_kinds.end(), row.kind) != compared_kinds.end();
}

/// Names that one of two results lacks are no error here.
bool is_chosen(const MeasureRow& row, const NamedParts& parts) {
  if (parts.empty()) return true;
  const auto& patterns = row.kind == "object"      ? parts.objects
                         : row.kind == "facade"    ? parts.facades
                         : row.kind == "selection" ? parts.selections
                                                   : parts.sensors;
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return matches(pattern, row.name); });
}

MeasureChange::To change(const MeasureWords& words, const std::string& before,
                         const std::string& after) {
  if (before == after) return MeasureChange::To::same;
  const auto rank = [&](const std::string& level) {  // "fail" is none of the levels
    const auto found = std::find(words.levels.begin(), words.levels.end(), level);
    return found == words.levels.end() ? -1 : found - words.levels.begin();
  };
  return rank(after) > rank(before) ? MeasureChange::To::better : MeasureChange::To::worse;
}

enum class Likeness { same, of_other_years, different };

/// Of a measure of one name: by the same rule and limits, on the same day, or in another year.
Likeness likeness(const MeasureWords& base, const MeasureWords& variant) {
  if (base.parameters == variant.parameters) return Likeness::same;
  const Json before = Json::parse(base.parameters, nullptr, false);
  Json after = Json::parse(variant.parameters, nullptr, false);
  const auto is_dated = [](const Json& of) {
    return of.is_object() && of.contains("date") && is_date(of["date"]);
  };
  if (!is_dated(before) || !is_dated(after)) return Likeness::different;
  after["date"][0] = before["date"][0];
  return before == after ? Likeness::of_other_years : Likeness::different;
}

std::map<std::string, MeasureWords> words_by_name(const ResultReader& result) {
  std::map<std::string, MeasureWords> words;
  for (const auto& name : measure_names(result)) words[name] = measure_words(result, name);
  return words;
}

/// `4 → 3 of 4 facades, 1 → 1 of 1 sensor`: of the kinds that the measure has.
std::string passing_text(const std::vector<MeasureChange>& changes) {
  std::string text;
  for (const std::string kind : compared_kinds) {
    std::size_t before = 0, after = 0, all = 0;
    for (const auto& change : changes) {
      if (change.kind != kind) continue;
      ++all;
      if (change.base_level != "fail") ++before;
      if (change.variant_level != "fail") ++after;
    }
    if (all > 0)
      text += fmt::format("{}{} → {} of {} {}{}", text.empty() ? "" : ", ", before, after, all,
                          kind, all == 1 ? "" : "s");
  }
  return text;
}

std::string levels_changed_text(const std::vector<MeasureChange>& changes) {
  std::vector<std::string> lines;
  for (const auto& change : changes)
    if (change.to != MeasureChange::To::same)
      lines.push_back(fmt::format("  {} {}: {} → {} ({:.2f} → {:.2f} {})\n", change.kind,
                                  change.name, change.base_level, change.variant_level,
                                  change.base_reached, change.variant_reached,
                                  display_units(change.units)));
  std::string text;
  for (std::size_t i = 0; i < std::min(lines.size(), changes_shown); ++i) text += lines[i];
  if (lines.size() > changes_shown)
    text += fmt::format("  … and {} more: see --json\n", lines.size() - changes_shown);
  return text;
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
        line += fmt::format(", mean {:.3g} {}", row.mean, display_units(words.units));
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

namespace {

struct BeforeAndAfter {
  MeasureRow before, after;
};
/// Rows with a verdict of the variant that the base has, too; none where one has no measures.
std::vector<BeforeAndAfter> verdicts_of_both(const ResultReader& base,
                                             const ResultReader& variant) {
  std::vector<BeforeAndAfter> pairs;
  if (measure_names(base).empty() || measure_names(variant).empty()) return pairs;
  std::map<Key, MeasureRow> before;
  for (const MeasureRow& row : measure_table(base, {})) before.emplace(key_of(row), row);
  for (const MeasureRow& row : measure_table(variant, {}))
    if (const auto found = before.find(key_of(row)); found != before.end() && has_verdict(row))
      pairs.push_back({found->second, row});
  return pairs;
}

}  // namespace

std::vector<MeasureChange> measure_changes(const ResultReader& base, const ResultReader& variant,
                                           const NamedParts& parts) {
  std::vector<MeasureChange> changes;
  const auto before_words = words_by_name(base), after_words = words_by_name(variant);
  for (const auto& [before, row] : verdicts_of_both(base, variant)) {
    if (!is_chosen(row, parts)) continue;
    const MeasureWords& words = after_words.at(row.measure);
    if (likeness(before_words.at(row.measure), words) == Likeness::different) continue;
    changes.push_back({row.measure, words.units, row.kind, row.name, before.reached, row.reached,
                       before.level, row.level, change(words, before.level, row.level)});
  }
  return changes;
}

namespace {

/// Verdicts over surfaces of which the variant has more or fewer: what was built there counts.
std::string other_areas_in_words(const ResultReader& base, const ResultReader& variant) {
  constexpr double telling_share = 0.05;
  constexpr std::size_t most_told = 4;
  std::vector<std::string> others;
  for (const auto& [before, row] : verdicts_of_both(base, variant)) {
    const double was = before.area_m2;
    if (!(std::abs(row.area_m2 - was) > telling_share * was)) continue;
    others.push_back(fmt::format("{} {} of {} ({:.4g} → {:.4g} m2)", row.kind, row.name,
                                 row.measure, was, row.area_m2));
  }
  if (others.empty()) return {};
  const std::size_t count = others.size();
  others.resize(std::min(count, most_told));
  return fmt::format(
      "{} verdicts are over other surfaces in the variant than in the base: {}{}; --quantity "
      "measure_NAME compares what both have",
      count, fmt::join(others, ", "), count > most_told ? ", …" : "");
}

}  // namespace

std::vector<std::string> notes_on_verdicts(const ResultReader& base, const ResultReader& variant) {
  std::vector<std::string> notes, of_other_years;
  const auto before = words_by_name(base), after = words_by_name(variant);
  for (const std::string& name : measure_names(variant)) {
    const auto found = before.find(name);
    if (found == before.end()) continue;
    const MeasureWords &was = found->second, &is = after.at(name);
    if (was.levels.empty() || is.levels.empty()) continue;
    switch (likeness(was, is)) {
      case Likeness::same:
        break;
      case Likeness::of_other_years:
        of_other_years.push_back(name);
        break;
      case Likeness::different:
        notes.push_back(fmt::format(
            "verdicts of measure {} are not compared: it is {} ({}) in the base and {} ({}) in the "
            "variant",
            name, was.rule, parameters_text(was), is.rule, parameters_text(is)));
    }
  }
  if (const auto words = other_areas_in_words(base, variant); !words.empty())
    notes.push_back(words);
  if (!of_other_years.empty())
    notes.push_back(
        fmt::format("measures on the same day of different years are compared, whose sun's path is "
                    "not quite the same: {}",
                    fmt::join(of_other_years, ", ")));
  return notes;
}

std::string measure_changes_text(const std::vector<MeasureChange>& changes) {
  std::vector<std::string> measures;
  for (const auto& change : changes)
    if (measures.empty() || measures.back() != change.measure) measures.push_back(change.measure);
  std::string text;
  for (const auto& measure : measures) {
    std::vector<MeasureChange> of_measure;
    std::copy_if(changes.begin(), changes.end(), std::back_inserter(of_measure),
                 [&](const MeasureChange& change) { return change.measure == measure; });
    text += "\n" + measure + ": pass in the base → in the variant: " + passing_text(of_measure) +
            "\n" + levels_changed_text(of_measure);
  }
  return text;
}

}  // namespace sunload
