// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/measure_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/result/schema.h"

namespace sunload {

namespace {

constexpr double percent = 100, half = 0.5;

std::vector<std::string> split(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> list;
  for (std::string word; words >> word;) list.push_back(word);
  return list;
}

std::string dataset_of(const std::string& measure) { return std::string(measure_prefix) + measure; }

/// A named set of patches of one measure.
struct Group {
  std::string kind, name;
  std::vector<std::size_t> patches;
};

/// Patches by the entry of a list that they are of.
std::vector<Group> groups_of(const std::string& kind, const std::vector<std::string>& names,
                             const std::vector<std::int32_t>& entry,
                             const std::vector<std::size_t>& chosen) {
  std::vector<Group> groups;
  std::vector<std::int32_t> place(names.size(), -1);
  for (const std::size_t k : chosen) {
    place[k] = static_cast<std::int32_t>(groups.size());
    groups.push_back({kind, names[k], {}});
  }
  for (std::size_t i = 0; i < entry.size(); ++i)
    if (entry[i] >= 0 && place[static_cast<std::size_t>(entry[i])] >= 0)
      groups[static_cast<std::size_t>(place[static_cast<std::size_t>(entry[i])])].patches.push_back(
          i);
  return groups;
}

std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

std::vector<Group> chosen_groups(const ResultReader& result, const NamedParts& parts) {
  std::vector<Group> groups;
  const auto add = [&](std::vector<Group> more) {
    groups.insert(groups.end(), std::make_move_iterator(more.begin()),
                  std::make_move_iterator(more.end()));
  };
  const std::size_t patches = result.shape("patch_area").front();
  if (parts.empty()) {
    add({{"whole", "whole", all_of(patches)}});
    add(groups_of("surface", {surface_names.begin(), surface_names.end()},
                  result.integers("patch_surface"), all_of(surface_names.size())));
  }
  if (parts.empty() || !parts.objects.empty())
    add(groups_of("object", result.strings("object_name"), result.integers("patch_object"),
                  chosen_objects(result, parts)));
  if (parts.empty() || !parts.facades.empty())
    add(groups_of("facade", result.strings("facade_name"), result.integers("patch_facade"),
                  chosen_facades(result, parts)));
  if (parts.empty() || !parts.selections.empty()) {
    const auto names = selection_names(result);
    for (const auto k : chosen_selections(result, parts))
      add(groups_of("selection", {names[k]}, selection_entries(result, k), {0}));
  }
  return groups;
}

class Judge {
 public:
  explicit Judge(const MeasureWords& words) : words_(words) {}

  void put_verdict(MeasureRow& row, const std::vector<double>& values,
                   const std::vector<double>& area) const {
    double whole = 0;
    for (const double a : area) whole += a;
    const double share =
        (words_.levels.empty() ? half : words_.area_percent / percent) * (1 - rounding);
    row.reached = reached_by(share, values, area);
    row.margin = row.passing_percent = not_known;
    if (words_.levels.empty()) return;
    row.level = "fail";
    for (std::size_t l = 0; l < words_.levels.size(); ++l) {
      double reaching = 0;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (reaches(values[i], words_.level_values[l])) reaching += area[i];
      if (l == 0) row.passing_percent = percent * reaching / whole;
      // Of nothing but 0 any share is enough.
      if (reaching > 0 && reaching >= share * whole) row.level = words_.levels[l];
    }
    row.margin = (row.reached - words_.level_values.front()) * (words_.more_is_better ? 1 : -1);
  }

 private:
  /// Of areas: corners of files are rounded to millimetres, and halves of a house are halves of it.
  static constexpr double rounding = 1e-3;
  /// The best value that so much of the area has or betters.
  double reached_by(double share, std::vector<double> values,
                    const std::vector<double>& area) const {
    if (!words_.more_is_better) return weighted_quantile(values, area, share);
    for (double& value : values) value = -value;
    return -weighted_quantile(values, area, share);
  }
  bool reaches(double value, double threshold) const {
    return words_.more_is_better ? value >= threshold : value <= threshold;
  }
  const MeasureWords& words_;
};

void add_groups(const ResultReader& result, const MeasureWords& words,
                const std::vector<Group>& groups, std::vector<MeasureRow>& rows) {
  const auto all = result.doubles(dataset_of(words.name)),
             patch_area = result.doubles("patch_area");
  const Judge judge(words);
  for (const Group& group : groups) {
    std::vector<double> values, area;
    MeasureRow row{words.name, group.kind, group.name, 0, 0, 0, {}, 0, 0, {}};
    for (const std::size_t i : group.patches) {
      if (std::isnan(all[i])) continue;
      values.push_back(all[i]);
      area.push_back(patch_area[i]);
      row.area_m2 += patch_area[i];
      row.mean += patch_area[i] * all[i];
    }
    if (values.empty()) continue;
    row.mean /= row.area_m2;
    judge.put_verdict(row, values, area);
    rows.push_back(std::move(row));
  }
}

void add_sensors(const ResultReader& result, const MeasureWords& words, const NamedParts& parts,
                 std::vector<MeasureRow>& rows) {
  const std::string dataset = "sensor_" + dataset_of(words.name);
  if (!result.has(dataset) || (!parts.empty() && parts.sensors.empty())) return;
  const auto values = result.doubles(dataset);
  const auto names = sensor_names(result);
  const std::string of_spans = dataset + std::string(measure_spans_end);
  const auto spans = result.has(of_spans) ? result.strings(of_spans) : std::vector<std::string>();
  const Judge judge(words);
  for (const std::size_t s : chosen_sensors(result, parts)) {
    if (std::isnan(values[s])) continue;
    MeasureRow row{words.name, "sensor", names[s], not_known, values[s], 0, {}, 0, 0, {}};
    judge.put_verdict(row, {values[s]}, {1});
    if (s < spans.size()) row.spans = spans[s];
    rows.push_back(std::move(row));
  }
}

}  // namespace

std::vector<std::string> measure_names(const ResultReader& result) {
  auto names = split(result.text_attribute("measures"));
  std::erase_if(names, [&](const std::string& name) { return !result.has(dataset_of(name)); });
  return names;
}

bool has_values(const ResultReader& result, const std::string& measure) {
  const auto is_known = [](double value) { return !std::isnan(value); };
  for (const std::string& dataset : {dataset_of(measure), "sensor_" + dataset_of(measure)})
    if (result.has(dataset)) {
      const auto values = result.doubles(dataset);
      if (std::any_of(values.begin(), values.end(), is_known)) return true;
    }
  return false;
}

MeasureWords measure_words(const ResultReader& result, const std::string& measure) {
  const std::string dataset = dataset_of(measure);
  const auto text = [&](const char* name) { return result.text_attribute(dataset, name); };
  MeasureWords words;
  words.name = measure;
  words.units = result.units(dataset);
  words.rule = text("rule");
  words.definition = text("definition");
  words.source = text("source");
  words.parameters = text("parameters");
  words.levels = split(text("level_words"));
  words.level_values = result.number_attributes(dataset, "level_values");
  words.more_is_better = text("better") != "less";
  words.area_percent = result.number_attribute(dataset, "area_percent");
  if (words.levels.size() != words.level_values.size() ||
      (!words.levels.empty() && !(words.area_percent >= 0 && words.area_percent <= percent)))
    throw InputError({result.path()}, "the levels of " + dataset + " cannot be used",
                     "their words, values and share of area do not fit together",
                     "run the study again with --overwrite");
  return words;
}

std::vector<MeasureRow> measure_table(const ResultReader& result, const NamedParts& parts) {
  const auto names = measure_names(result);
  if (names.empty())
    throw result.chosen().any()
        ? InputError({result.path()}, "there are no measures of a part of the period",
                     "each is of the time that its rule says", "leave out the part of the period")
        : InputError({result.path()}, "the result has no measures",
                     "its study has no section measures",
                     "write one, e.g. measures: {sun: {rule: csn_73_4301}}");
  const auto groups = chosen_groups(result, parts);
  std::vector<MeasureRow> rows;
  for (const auto& name : names) {
    const MeasureWords words = measure_words(result, name);
    add_groups(result, words, groups, rows);
    add_sensors(result, words, parts, rows);
  }
  return rows;
}

std::string measure_table_csv(const ResultReader& result, const std::vector<MeasureRow>& rows) {
  std::string text =
      "measure,group,name,area_m2,mean,reached,units,level,margin,passing_percent,spans\n";
  for (const MeasureRow& row : rows)
    text += row.measure + "," + row.kind + "," + csv_text(row.name) + "," +
            csv_number(row.area_m2) + "," + csv_number(row.mean) + "," + csv_number(row.reached) +
            "," + result.units(dataset_of(row.measure)) + "," + row.level + "," +
            csv_number(row.margin) + "," + csv_number(row.passing_percent) + "," + row.spans + "\n";
  return text;
}

}  // namespace sunload
