// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/measure/rules.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/measure/all_rules.h"

namespace sunload {

namespace {

constexpr double right_angle_deg = 90, minutes_of_day = 1440, hours_of_year = 8784, percent = 100;
constexpr double brightest_w_m2 = 1e6, brightest_lx = 1e9;

std::string range_words(const MeasureRule& rule) {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  if (rule.day)
    add(rule.day->first == 0 ? "`date` (needed)"
                             : fmt::format("`date` ({}-{:02})", rule.day->first, rule.day->second));
  for (const RuleKey& key : rule.keys)
    add("`" + key.key + "`" +
        (key.is_needed() ? " (needed)" : fmt::format(" ({:g})", *key.absent)));
  for (const RuleWords& key : rule.words)
    add(fmt::format("`{}`: {}", key.key, fmt::join(key.words, " \\| ")));
  return text;
}

}  // namespace

const std::vector<MeasureRule>& measure_rules() {
  static const std::vector<MeasureRule> all{
      rules::sun_hours(),       rules::en_17037(),    rules::csn_73_4301(),
      rules::bre_209_garden(),  rules::bre_209_vsc(), rules::bre_209_probable_sun(),
      rules::bright_sun(),      rules::light_hours(), rules::glint_hours(),
      rules::daylight_factor(), rules::peak_light(),  rules::roof_potential()};
  return all;
}

const MeasureRule* find_measure_rule(const std::string& word) {
  const auto& all = measure_rules();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const MeasureRule& rule) { return rule.word == word; });
  return found == all.end() ? nullptr : &*found;
}

const std::vector<MeasureKey>& measure_keys() {
  static const std::vector<MeasureKey> all{{"least_elevation_deg", 0, right_angle_deg},
                                           {"least_angle_deg", 0, right_angle_deg},
                                           {"least_plan_angle_deg", 0, right_angle_deg},
                                           {"least_span_min", 0, minutes_of_day},
                                           {"least_dni_w_m2", 0, brightest_w_m2},
                                           {"above_w_m2", 0, brightest_w_m2},
                                           {"above_lx", 0, brightest_lx},
                                           {"least_h", 0, hours_of_year},
                                           {"most_h", 0, hours_of_year},
                                           {"least_percent", 0, percent},
                                           {"area_percent", 0, percent}};
  return all;
}

const std::vector<RuleWords>& measure_word_keys() {
  static const std::vector<RuleWords> all{
      {"count", {"all", "longest"}},
      {"season", {"year", "winter"}},
      {"light", {"total", "direct", "sky", "mirror", "lamps", "reflected"}}};
  return all;
}

std::string watched_light(const MeasureRule& rule, const MeasureParameters& parameters) {
  if (rule.needs != MeasureRule::Needs::series) return {};
  const auto word = parameters.words.find("light");
  return word != parameters.words.end() ? word->second : rule.light;
}

std::vector<MeasureLevel> levels_of(const MeasureRule& rule, const MeasureParameters& parameters) {
  return rule.levels ? rule.levels(parameters) : std::vector<MeasureLevel>();
}

std::string definition_of(const MeasureRule& rule, const MeasureParameters& parameters) {
  std::vector<std::string> changed;
  for (const RuleKey& key : rule.keys)
    if (const double value = parameters.number(key.key); value != key.absent)
      changed.push_back(fmt::format("{} {:g}", key.key, value));
  for (const RuleWords& key : rule.words)
    if (const std::string& word = parameters.words.at(key.key); word != key.words.front())
      changed.push_back(key.key + " " + word);
  if (!levels_of(rule, parameters).empty())
    if (const double share = parameters.number("area_percent"); share != usual_area_percent)
      changed.push_back(fmt::format("area_percent {:g}", share));
  if (const auto& date = parameters.date;
      date && rule.day && std::pair(date->month, date->day) != *rule.day)
    changed.push_back(fmt::format("date {:04}-{:02}-{:02}", date->year, date->month, date->day));
  if (changed.empty()) return rule.definition;
  return fmt::format("{}; here with {}", rule.definition, fmt::join(changed, ", "));
}

std::string measure_rules_markdown() {
  std::string text = "| rule | value | source | keys (defaults) |\n|---|---|---|---|\n";
  for (const MeasureRule& rule : measure_rules())
    text += fmt::format("| `{}` | {} [{}] | {} | {} |\n", rule.word, rule.definition, rule.units,
                        rule.source, range_words(rule));
  return text;
}

}  // namespace sunload
