// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/compared.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "io/result/named_parts.h"
#include "io/result/schema.h"
#include "io/result/shown_quantity.h"
#include "io/result/time.h"

namespace sunload {
namespace {

bool is_measure(const std::string& dataset) { return dataset.starts_with(measure_prefix); }

bool is_one_of(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Totals that have means over groups: no areas, counts and errors; of a part of the period none
/// that are of the scene alone.
std::vector<std::string> totals_of(const ResultReader& result) {
  auto names = patch_datasets(result, PatchDatasets::totals);
  std::erase_if(names, [&](const std::string& name) {
    return name == "patch_area" || name == "patch_lines" ||
           (name.ends_with("_se") && !is_measure(name)) ||
           (result.chosen().any() && is_of_scene(name));
  });
  return names;
}

void expect_total(const ResultReader& base, const ResultReader& variant,
                  const std::string& dataset) {
  const auto of_base = totals_of(base), of_variant = totals_of(variant);
  if (is_one_of(of_base, dataset) && is_one_of(of_variant, dataset)) return;
  std::vector<std::string> known;
  for (const auto& name : of_base)
    if (is_one_of(of_variant, name)) known.push_back(name);
  throw unknown_quantity(
      is_one_of(of_base, dataset) ? variant : base, dataset, known,
      base.chosen().any() ? "it is not known of " + base.chosen().words() : std::string());
}

std::vector<char> measured(const ResultReader& result, const std::string& dataset) {
  std::vector<char> is_known;
  for (const double value : result.doubles(dataset)) is_known.push_back(std::isnan(value) ? 0 : 1);
  return is_known;
}

std::vector<std::string> notes_on_measures(const ResultReader& base, const ResultReader& variant,
                                           const std::string& dataset) {
  std::vector<std::string> notes;
  if (!is_measure(dataset)) return notes;
  const auto differ = [&](const char* attribute) {
    return base.text_attribute(dataset, attribute) != variant.text_attribute(dataset, attribute);
  };
  if (differ("rule") || differ("parameters"))
    notes.emplace_back("the two results are measured by different rules of one name");
  if (base.doubles("patch_area") != variant.doubles("patch_area"))
    notes.emplace_back(
        "patches differ, and the measure is taken at their middles: finer patches, finer answers");
  return notes;
}

}  // namespace

void expect_comparable(const ResultReader& base, const ResultReader& variant,
                       const std::string& dataset) {
  for (const ResultReader* result : {&base, &variant})
    if (dataset == usual_compared && !result->has(dataset))
      throw InputError({result->path()}, "no dataset light_load", "there is nothing to compare",
                       "compare finished results of sunload run");
  expect_total(base, variant, dataset);
  if (base.units(dataset) != variant.units(dataset))
    throw InputError({variant.path()}, dataset + " is in " + variant.units(dataset),
                     "the base has it in " + base.units(dataset),
                     is_measure(dataset) ? "compare results of the same measures"
                                         : "compare results of one light.quantity");
}

CountedPatches counted_patches(const ResultReader& base, const ResultReader& variant,
                               const std::string& dataset) {
  if (!is_measure(dataset)) return {};
  return {measured(base, dataset), measured(variant, dataset)};
}

bool has_mesh_error(const std::string& dataset) {
  return dataset == usual_compared || dataset == "light_load_reflected";
}

std::vector<std::string> notes_on(const ResultReader& base, const ResultReader& variant,
                                  const std::string& dataset) {
  auto notes = notes_on_measures(base, variant, dataset);
  const auto step = [](const ResultReader& result) {
    const std::string word = series_step(result);
    return word.empty() ? std::string("interval") : word;
  };
  if (step(base) != step(variant))
    notes.push_back("the two results have series of other steps: " + step(base) + " and " +
                    step(variant));
  else if (auto times = different_times_in_words(base, variant); !times.empty())
    notes.push_back(std::move(times));
  if (base.chosen().any()) notes.push_back("a part of the period: " + period_in_words(base));
  const auto version = [](const ResultReader& result) { return result.text_attribute("source"); };
  if (version(base) != version(variant))
    notes.push_back("the two results come from different versions: " + version(base) + " and " +
                    version(variant));
  const auto differ = [&](const char* attribute) {
    return std::abs(base.number_attribute(attribute) - variant.number_attribute(attribute)) > 0;
  };
  const ResultVariable* variable = find_result_variable(dataset, base.quantity());
  if (variable && has_bands(*variable) && differ("bounces"))
    notes.push_back(fmt::format(
        "{} reflections are followed in one result and {} in the other, and the rest is estimated: "
        "small differences may be of that; solver.unshot: 0 follows as many in both",
        base.number_attribute("bounces"), variant.number_attribute("bounces")));
  if (auto turned = different_north_in_words(base, variant); !turned.empty())
    notes.push_back(std::move(turned));
  return notes;
}

}  // namespace sunload
