// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/verdicts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "io/base/first_of_many.h"
#include "io/base/name_pattern.h"
#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/report/common_groups.h"
#include "io/report/compared.h"
#include "io/report/compared_sensors.h"
#include "io/report/measures.h"
#include "io/result/schema.h"

namespace sunload {

namespace {

using To = MeasureChange::To;

constexpr std::size_t changes_shown = 24;  // of changes: a screen

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

To change(const MeasureWords& words, const VerdictPair& pair) {
  if (!pair.variant) return To::only_in_base;
  if (!pair.base) return To::only_in_variant;
  if (pair.base->level == pair.variant->level) return To::same;
  const auto rank = [&](const std::string& level) {  // "fail" is none of the levels
    const auto found = std::find(words.levels.begin(), words.levels.end(), level);
    return found == words.levels.end() ? -1 : found - words.levels.begin();
  };
  return rank(pair.variant->level) > rank(pair.base->level) ? To::better : To::worse;
}

bool have_both(const MeasureChange& change) {
  return change.to != To::only_in_base && change.to != To::only_in_variant;
}

std::map<std::string, MeasureWords> words_by_name(const ResultReader& result) {
  std::map<std::string, MeasureWords> words;
  for (const auto& name : measure_names(result)) words[name] = measure_words(result, name);
  return words;
}

using Key = std::tuple<std::string, std::string, std::string>;
Key key_of(const MeasureRow& row) { return {row.measure, row.kind, row.name}; }

/// Area that both results measure, by group.
using CommonAreas = std::map<Key, double>;

CommonAreas common_areas(const ResultReader& base, const ResultReader& variant,
                         const std::vector<std::string>& measures) {
  const PatchOverlaps overlaps = patch_overlaps(base, variant);
  const auto of_base = patch_divisions(base), of_variant = patch_divisions(variant);
  CommonAreas areas;
  for (const auto& measure : measures) {
    const auto counted = counted_patches(base, variant, std::string(measure_prefix) + measure);
    for (const PatchMembers& common : common_groups(overlaps, counted, of_base, of_variant).base)
      for (const PatchMember& member : common.members)
        areas[{measure, common.kind, common.names.at(member.name)}] += member.area_m2;
  }
  return areas;
}

/// Finds what has a counterpart in the other result.
class Counterparts {
 public:
  Counterparts(const ResultReader& base, const ResultReader& variant,
               const std::vector<std::string>& measures)
      : areas_(common_areas(base, variant, measures)) {
    const auto names = sensor_names(base);
    const auto kept = sensors_in_both(base, variant);
    for (std::size_t s = 0; s < kept.size(); ++s)
      if (kept[s] != 0) sensors_.push_back(names[s]);
  }

  bool has(const MeasureRow& row) const {
    if (row.kind != "sensor") return areas_.contains(key_of(row));
    return std::find(sensors_.begin(), sensors_.end(), row.name) != sensors_.end();
  }
  double area_m2(const MeasureRow& row) const {
    const auto found = areas_.find(key_of(row));
    return found == areas_.end() ? 0 : found->second;
  }

 private:
  CommonAreas areas_;
  std::vector<std::string> sensors_;  ///< called so in both, as numbers are the same
};

/// Rows with a verdict, of some measures.
std::vector<MeasureRow> judged_rows(const ResultReader& result,
                                    const std::vector<std::string>& measures) {
  auto rows = measure_table(result, {});
  std::erase_if(rows, [&](const MeasureRow& row) {
    return !has_verdict(row) ||
           std::find(measures.begin(), measures.end(), row.measure) == measures.end();
  });
  return rows;
}

std::vector<VerdictPair> verdict_pairs(std::vector<MeasureRow> base,
                                       std::vector<MeasureRow> variant,
                                       const Counterparts& counterparts) {
  std::map<Key, std::size_t> place;
  for (std::size_t b = 0; b < base.size(); ++b)
    if (counterparts.has(base[b])) place.emplace(key_of(base[b]), b);
  std::vector<char> is_matched(base.size(), 0);
  std::vector<VerdictPair> pairs;
  for (MeasureRow& row : variant) {
    const auto found = place.find(key_of(row));
    if (found == place.end()) {
      pairs.push_back({{}, std::move(row), 0});
      continue;
    }
    const double common = counterparts.area_m2(row);
    pairs.push_back({base[found->second], std::move(row), common});
    is_matched[found->second] = 1;
  }
  for (std::size_t b = 0; b < base.size(); ++b)
    if (is_matched[b] == 0) pairs.push_back({std::move(base[b]), {}, 0});
  return pairs;
}

}  // namespace

Verdicts verdicts_of_both(const ResultReader& base, const ResultReader& variant) {
  Verdicts verdicts;
  verdicts.base_words = words_by_name(base);
  verdicts.variant_words = words_by_name(variant);
  for (const auto& name : measure_names(variant))
    if (verdicts.base_words.contains(name)) verdicts.measures.push_back(name);
  if (verdicts.measures.empty()) return verdicts;
  verdicts.pairs =
      verdict_pairs(judged_rows(base, verdicts.measures), judged_rows(variant, verdicts.measures),
                    Counterparts(base, variant, verdicts.measures));
  return verdicts;
}

namespace {

MeasureChange change_of(const VerdictPair& pair, const MeasureWords& words) {
  const MeasureRow& row = pair.either();
  MeasureChange c{row.measure, words.units, row.kind, row.name,           not_known,
                  not_known,   {},          {},       change(words, pair)};
  if (pair.base) {
    c.base_reached = pair.base->reached;
    c.base_level = pair.base->level;
  }
  if (pair.variant) {
    c.variant_reached = pair.variant->reached;
    c.variant_level = pair.variant->level;
  }
  return c;
}

}  // namespace

std::vector<MeasureChange> measure_changes(const Verdicts& verdicts, const NamedParts& parts) {
  std::vector<MeasureChange> changes;
  for (const VerdictPair& pair : verdicts.pairs) {
    const MeasureRow& row = pair.either();
    if (!is_chosen(row, parts)) continue;
    const MeasureWords& words = verdicts.variant_words.at(row.measure);
    if (likeness_of(verdicts.base_words.at(row.measure), words) == MeasureLikeness::different)
      continue;
    changes.push_back(change_of(pair, words));
  }
  return changes;
}

namespace {

/// Whether one of two verdicts is over much that the other does not see.
bool is_of_other_surfaces(const VerdictPair& pair) {
  constexpr double telling_share = 0.05;
  if (!pair.base || !pair.variant) return false;
  const double larger = std::max(pair.base->area_m2, pair.variant->area_m2);  // NaN of sensors
  return larger - pair.common_m2 > telling_share * larger;
}

std::string other_surfaces_in_words(const Verdicts& verdicts) {
  constexpr std::size_t most_told = 4;
  FirstOfMany others(most_told);
  for (const VerdictPair& pair : verdicts.pairs)
    if (is_of_other_surfaces(pair))
      others.add(fmt::format("{} {} of {} ({:.4g} → {:.4g} m2, {:.4g} in common)", pair.base->kind,
                             pair.base->name, pair.base->measure, pair.base->area_m2,
                             pair.variant->area_m2, pair.common_m2));
  if (others.count() == 0) return {};
  return fmt::format(
      "{} verdicts are over other surfaces in the variant than in the base: {}; --quantity "
      "measure_NAME compares what both have",
      others.count(), others.text());
}

}  // namespace

std::vector<std::string> notes_on_verdicts(const Verdicts& verdicts) {
  std::vector<std::string> notes, of_other_years;
  for (const std::string& name : verdicts.measures) {
    const MeasureWords &was = verdicts.base_words.at(name), &is = verdicts.variant_words.at(name);
    if (was.levels.empty() || is.levels.empty()) continue;
    switch (likeness_of(was, is)) {
      case MeasureLikeness::same:
        break;
      case MeasureLikeness::of_other_years:
        of_other_years.push_back(name);
        break;
      case MeasureLikeness::different:
        notes.push_back(fmt::format(
            "verdicts of measure {} are not compared: it is {} ({}) in the base and {} ({}) in the "
            "variant",
            name, was.rule, parameters_in_words(was), is.rule, parameters_in_words(is)));
    }
  }
  if (const auto words = other_surfaces_in_words(verdicts); !words.empty()) notes.push_back(words);
  if (!of_other_years.empty())
    notes.push_back(
        fmt::format("measures on the same day of different years are compared, whose sun's path is "
                    "not quite the same: {}",
                    fmt::join(of_other_years, ", ")));
  return notes;
}

namespace {

struct PassCounts {
  std::size_t before = 0, after = 0, both = 0, alone = 0;
};

PassCounts pass_counts(const std::vector<MeasureChange>& changes, const std::string& kind) {
  PassCounts counts;
  for (const auto& change : changes) {
    if (change.kind != kind) continue;
    if (!have_both(change)) {
      ++counts.alone;
      continue;
    }
    ++counts.both;
    if (change.base_level != "fail") ++counts.before;
    if (change.variant_level != "fail") ++counts.after;
  }
  return counts;
}

/// `4 → 3 of 4 facades, 1 → 1 of 1 sensor`: of the kinds that the measure has.
std::string passing_text(const std::vector<MeasureChange>& changes) {
  std::string text;
  for (const std::string kind : compared_kinds) {
    const auto [before, after, both, alone] = pass_counts(changes, kind);
    if (both + alone > 0)
      text += fmt::format("{}{} → {} of {} {}{}", text.empty() ? "" : ", ", before, after, both,
                          kind, both == 1 ? "" : "s");
  }
  return text;
}

std::string line_of(const MeasureChange& change) {
  const std::string units = display_units(change.units);
  switch (change.to) {
    case To::only_in_base:
      return fmt::format("  {} {}: only in the base, {} ({:.2f} {})\n", change.kind, change.name,
                         change.base_level, change.base_reached, units);
    case To::only_in_variant:
      return fmt::format("  {} {}: only in the variant, {} ({:.2f} {})\n", change.kind, change.name,
                         change.variant_level, change.variant_reached, units);
    default:
      return fmt::format("  {} {}: {} → {} ({:.2f} → {:.2f} {})\n", change.kind, change.name,
                         change.base_level, change.variant_level, change.base_reached,
                         change.variant_reached, units);
  }
}

/// What changes, then what has no counterpart.
std::string changed_text(std::vector<MeasureChange> changes) {
  std::erase_if(changes, [](const MeasureChange& change) { return change.to == To::same; });
  std::stable_partition(changes.begin(), changes.end(), have_both);
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), changes_shown); ++i)
    text += line_of(changes[i]);
  if (changes.size() > changes_shown)
    text += fmt::format("  … and {} more: see --json\n", changes.size() - changes_shown);
  return text;
}

}  // namespace

std::string measure_changes_text(const std::vector<MeasureChange>& changes) {
  std::vector<std::string> measures;
  for (const auto& change : changes)
    if (std::find(measures.begin(), measures.end(), change.measure) == measures.end())
      measures.push_back(change.measure);
  std::string text;
  for (const auto& measure : measures) {
    std::vector<MeasureChange> of_measure;
    std::copy_if(changes.begin(), changes.end(), std::back_inserter(of_measure),
                 [&](const MeasureChange& change) { return change.measure == measure; });
    text += "\n" + measure + ": pass in the base → in the variant: " + passing_text(of_measure) +
            "\n" + changed_text(of_measure);
  }
  return text;
}

}  // namespace sunload
