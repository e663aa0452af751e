// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Section `measures` of a study.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/measure/rules.h"
#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

using Needs = MeasureRule::Needs;

std::vector<std::string> rule_words() {
  std::vector<std::string> words;
  for (const MeasureRule& rule : measure_rules()) words.push_back(rule.word);
  return words;
}

MeasureOf read_of(YamlMap& map) {
  MeasureOf of;
  of.object = map.text("object", "");
  of.facade = map.text("facade", "");
  of.surface = map.word("surface", {"wall", "window", "roof", "ground", "other"}, "");
  of.selection = map.text("selection", "");
  return of;
}

/// A calendar day, without time of day.
std::optional<CivilTime> read_date(YamlMap& map) {
  const auto text = map.text("date");
  if (!text) return {};
  try {
    const ParsedTime time = parse_time(*text);
    if (!time.has_time) return time.civil;
    map.problem("date", "'" + *text + "' has a time of day", "the whole day is measured",
                "write the date alone");
  } catch (const InputError& error) {
    add_at(map, "date", map.where("date"), error);
  }
  return {};
}

/// Keys of other rules would be without effect.
void refuse_unknown(YamlMap& map, const MeasureRule& rule, const std::string& key, bool knows) {
  if (map.has(key) && !knows)
    map.problem(key, "rule " + rule.word + " has no such limit", "it would be without effect",
                "remove it, or see docs/measures.md for the rule's own keys");
}

void check_day(YamlMap& map, const MeasureRule& rule, const MeasureParameters& measure) {
  refuse_unknown(map, rule, "date", rule.day.has_value());
  if (rule.day && rule.day->first == 0) map.require("date", "the rule has no day of its own");
  if (rule.word != "en_17037" || !measure.date) return;
  const auto day = std::pair(measure.date->month, measure.date->day);
  if (day < std::pair(2, 1) || day > std::pair(3, 21))
    map.problem("date", "EN 17037 wants a day from 1 February to 21 March", "",
                "for other days write rule: sun_hours");
}

void read_parameters(YamlMap& map, const MeasureRule* rule, MeasureParameters& measure) {
  for (const MeasureKey& key : measure_keys()) {
    const auto value = map.number(key.key, {key.low, key.high});
    if (value) measure.numbers[key.key] = *value;
    if (!rule) continue;
    const bool is_of_all = key.key == "area_percent";
    const auto known = std::find_if(rule->keys.begin(), rule->keys.end(),
                                    [&](const RuleKey& k) { return k.key == key.key; });
    refuse_unknown(map, *rule, key.key, is_of_all || known != rule->keys.end());
    if (is_of_all) measure.numbers.try_emplace(key.key, usual_area_percent);
    if (known == rule->keys.end()) continue;
    if (!known->absent)
      map.require(key.key, "the standard tabulates it by capital",
                  "take it from the standard's table: 13 for the Czech Republic");
    measure.numbers.try_emplace(key.key, known->absent.value_or(0));
  }
  for (const RuleWords& key : measure_word_keys()) {
    const std::string word = map.word(key.key, key.words, key.words.front());
    if (!rule) continue;
    const bool knows = std::any_of(rule->words.begin(), rule->words.end(),
                                   [&](const RuleWords& k) { return k.key == key.key; });
    refuse_unknown(map, *rule, key.key, knows);
    if (knows) measure.words[key.key] = word;
  }
}

}  // namespace

MeasureParameters read_measure(const std::string& name, YamlMap& map) {
  MeasureParameters measure;
  measure.name = name;
  measure.where = map.where();
  if (!is_dataset_name(name) && map.is_usable() && name != "*")
    map.reading().problem(map.where(), "'" + name + "' cannot be the name of a measure",
                          "it becomes part of the names of datasets",
                          "letters A to Z, digits and _ make names");
  if (name.ends_with("_begin") || name.ends_with("_end") || name.ends_with("_spans"))
    map.reading().problem(map.where(), "'" + name + "' cannot be the name of a measure",
                          "_begin, _end and _spans are datasets of its sun", "name it otherwise");
  map.require("rule", "", "write one of " + fmt::format("{}", fmt::join(rule_words(), ", ")));
  measure.rule = map.word("rule", rule_words(), "");
  const MeasureRule* rule = find_measure_rule(measure.rule);
  map.section("of", [&](YamlMap& of) { measure.of = read_of(of); });
  measure.date = read_date(map);
  read_parameters(map, rule, measure);
  if (rule) check_day(map, *rule, measure);
  return measure;
}

void check_measures(YamlMap& root, const Study& study, PlaceWritten placed) {
  const bool positions = std::holds_alternative<PositionsPeriod>(study.period.kind);
  const auto refuse = [&](const MeasureParameters& measure, const std::string& what,
                          const std::string& why, const std::string& hint) {
    root.reading().problem(measure.where, "measure " + measure.name + " " + what, why, hint);
  };
  for (const MeasureParameters& measure : study.measures) {
    const MeasureRule* rule = find_measure_rule(measure.rule);
    if (!rule) continue;
    if (rule->needs == Needs::sun_path && positions) {
      refuse(measure, "needs a period with dates", "its sun is that of a day",
             placed == PlaceWritten::yes ? "write period: {days: [...]}"
                                         : "write period: {days: [...]} and the site's position");
    }
    if (rule->spans == MeasureRule::Spans::year_of_weather &&
        study.light.source != LightSource::weather)
      refuse(measure, "needs light.source: weather", "it counts the sunshine of a year",
             "write light: {source: weather, weather: x.epw} and period: {year_of: weather}");
    if (study.solver.short_intervals == ShortIntervals::together &&
        !watched_light(*rule, measure).empty())
      refuse(measure, "cannot go with solver.short_intervals: together",
             "it looks at the light of every interval", "write short_intervals: auto or each");
    if (rule->needs != Needs::series) continue;
    const bool lux = study.light.quantity == Quantity::illuminance;
    if (rule->spans == MeasureRule::Spans::whole_year && lux)
      refuse(measure, "needs light.quantity: irradiance", "its classes are of energy",
             "leave light.quantity away");
    const char* wanted = lux ? "above_lx" : "above_w_m2";
    const char* other = lux ? "above_w_m2" : "above_lx";
    const bool has_threshold = measure.numbers.contains(wanted);
    if (has_threshold && (measure.number(wanted) <= 0 || measure.number(other) > 0))
      refuse(measure, std::string("needs ") + wanted,
             lux ? "light.quantity is illuminance" : "light.quantity is irradiance",
             std::string("write ") + wanted + " alone, above 0");
    const std::string light = watched_light(*rule, measure);
    const auto& series = study.output.series;
    if (std::find(series.begin(), series.end(), light) == series.end())
      refuse(measure, "watches the series " + light, "output.series leaves it out",
             "add " + light + " to output.series");
  }
}

}  // namespace sunload::study_sections
