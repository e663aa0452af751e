// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/measure_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/base/bands.h"
#include "io/base/hash.h"
#include "io/base/light_quantity.h"
#include "io/batch/batch_tally.h"
#include "io/measure/rules.h"
#include "io/plan/stored_bits.h"
#include "io/result/schema.h"

namespace sunload {

namespace {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

bool has_array(const BatchReader& batch, const std::string& name) {
  const auto& arrays = batch.arrays();
  return std::any_of(arrays.begin(), arrays.end(),
                     [&](const ArraySpec& spec) { return spec.name == name; });
}

/// A series of a batch, of bands their mean; empty where the scene cannot have it.
std::vector<double> series_of(const BatchReader& batch, const std::string& name, Bands bands) {
  std::vector<double> mean;
  const auto prefixes = band_prefixes(bands);
  for (const auto& prefix : prefixes) {
    if (!has_array(batch, prefix + name)) return {};
    const auto values = batch.doubles(prefix + name);
    mean.resize(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i)
      mean[i] += values[i] / static_cast<double>(prefixes.size());
  }
  return mean;
}

/// The columns of the chosen patches.
std::vector<double> columns_of(const std::vector<double>& values, std::size_t rows,
                               const std::vector<std::size_t>& chosen) {
  std::vector<double> picked(rows * chosen.size(), 0);
  if (values.empty()) return picked;
  const std::size_t n = values.size() / rows;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < chosen.size(); ++i)
      picked[row * chosen.size() + i] = values[row * n + chosen[i]];
  return picked;
}

std::vector<double> scattered(const std::vector<double>& values,
                              const std::vector<std::size_t>& places, std::size_t n) {
  std::vector<double> all(n, not_measured);
  for (std::size_t i = 0; i < places.size(); ++i) all[places[i]] = values[i];
  return all;
}

/// Area-weighted means over what is measured of each entry; -1: a patch is of none.
template <class Entry>
std::vector<double> entry_means(const std::vector<double>& values, const ResultGeometry& g,
                                std::size_t count, const Entry& entry) {
  std::vector<double> sum(count, 0), area(count, 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (entry(i) < 0 || std::isnan(values[i])) continue;
    const auto e = static_cast<std::size_t>(entry(i));
    sum[e] += g.patch_area[i] * values[i];
    area[e] += g.patch_area[i];
  }
  for (std::size_t e = 0; e < count; ++e) sum[e] = area[e] > 0 ? sum[e] / area[e] : not_measured;
  return sum;
}

std::vector<double> facade_means(const std::vector<double>& values, const ResultGeometry& g) {
  return entry_means(values, g, g.facade_name.size(),
                     [&](std::size_t i) { return g.patch_facade[i]; });
}

/// One after the other: they may overlap.
std::vector<double> selection_means(const std::vector<double>& values, const ResultGeometry& g) {
  std::vector<double> means;
  for (const auto& selected : g.selected)
    means.push_back(entry_means(values, g, 1, [&](std::size_t i) {
                      return selected[i] != 0 ? 0 : -1;
                    }).front());
  return means;
}

/// "2026-03-21T06:12:31Z/2026-03-21T08:40:02Z", one after the other (ISO 8601).
std::string spans_text(const std::vector<SunSpan>& spans) {
  std::string text;
  for (const SunSpan& span : spans)
    text += (text.empty() ? "" : " ") + iso_utc(std::round(span.begin)) + "/" +
            iso_utc(std::round(span.end));
  return text;
}

/// When it is about: a day, always, or (empty) the period.
std::string when_of(const StudyMeasure& of) {
  if (of.rule->needs == MeasureRule::Needs::geometry) return "always";
  if (!of.parameters.date) return {};
  return iso_utc(utc_from_calendar(*of.parameters.date))
      .substr(0, std::string("2026-03-21").size());
}

/// What is said of values that are not watched as they are; empty where they are.
std::string rounding_words(const StudyMeasure& of, const VariantPlan& plan) {
  const int bits = stored_bits(plan.study);
  if (of.measure->series().empty() || !plan.steps.empty() || bits == float_mantissa_bits) return {};
  return fmt::format("; of values rounded to {} bits ({:.2g} %)", bits,
                     100 * std::exp2(-(bits + 1)));
}

MeasureAttributes attributes_of(const StudyMeasure& of, const VariantPlan& plan) {
  MeasureAttributes a;
  a.text = {{"definition", definition_of(*of.rule, of.parameters) + rounding_words(of, plan)},
            {"source", of.rule->source},
            {"rule", of.rule->word},
            {"parameters", measure_text(of.parameters)}};
  if (const auto when = when_of(of); !when.empty()) a.text.emplace_back("when", when);
  const auto levels = levels_of(*of.rule, of.parameters);
  if (levels.empty()) return a;
  std::string words;
  for (const MeasureLevel& level : levels) {
    words += (words.empty() ? "" : " ") + level.word;
    a.level_values.push_back(level.value);
  }
  a.text.emplace_back("level_words", words);
  a.text.emplace_back("better", of.rule->better == MeasureRule::Better::more ? "more" : "less");
  a.area_percent = of.parameters.number("area_percent");
  return a;
}

}  // namespace

MeasureMerge::MeasureMerge(const VariantPlan& plan, const Hierarchy& hierarchy,
                           const ResultGeometry& geometry)
    : plan_(plan), geometry_(geometry), measures_(plan, hierarchy) {}

void MeasureMerge::add(const BatchReader& batch) {
  const BatchHeader& header = batch.header();
  std::vector<std::size_t> sensors(geometry_.sensor_position.size());
  for (std::size_t s = 0; s < sensors.size(); ++s) sensors[s] = s;
  for (StudyMeasure& of : measures_.all()) {
    const std::string series = of.measure->series();
    if (series.empty()) continue;
    const Bands bands = plan_.study.solver.bands;
    const auto patch =
        columns_of(series_of(batch, series, bands), header.interval_count, of.patches);
    const auto sensor =
        columns_of(series_of(batch, sensor_prefix + series, bands), header.interval_count, sensors);
    of.measure->watch({header.first_interval, header.interval_count, patch, sensor});
  }
}

void MeasureMerge::write(ResultWriter& writer) {
  for (StudyMeasure& of : measures_.all()) write_one(writer, of);
}

void MeasureMerge::write_one(ResultWriter& writer, const StudyMeasure& of) const {
  const MeasureValues found = of.measure->values();
  const std::string name = "measure_" + of.parameters.name;
  const MeasureAttributes attributes = attributes_of(of, plan_);
  const std::size_t n = of.patches.size();
  const auto put = [&](const std::string& suffix, const std::vector<double>& values,
                       const std::string& units) {
    const auto patches = scattered(values, of.patches, geometry_.patch_area.size());
    writer.write_measure({name + suffix, units, patches}, attributes);
    if (suffix.empty() && !geometry_.facade_name.empty())
      writer.write_measure({"facade_" + name, units, facade_means(patches, geometry_)}, attributes);
    if (suffix.empty() && !geometry_.selection_name.empty())
      writer.write_measure({"selection_" + name, units, selection_means(patches, geometry_)},
                           attributes);
    if (!geometry_.sensor_position.empty())
      writer.write_measure({sensor_prefix + name + suffix,
                            units,
                            {values.begin() + static_cast<std::ptrdiff_t>(n), values.end()}},
                           attributes);
  };
  put("", found.value, light_units(of.rule->units, plan_.study.light.quantity));
  if (found.spans.empty()) return;
  std::vector<double> begin, end;
  for (const auto& spans : found.spans) {
    const SunSpan one = longest(spans);
    begin.push_back(one.length_s() > 0 ? one.begin : not_measured);
    end.push_back(one.length_s() > 0 ? one.end : not_measured);
  }
  put("_begin", begin, std::string(time_units));
  put("_end", end, std::string(time_units));
  if (geometry_.sensor_position.empty()) return;
  std::vector<std::string> texts;
  for (std::size_t p = n; p < found.spans.size(); ++p) texts.push_back(spans_text(found.spans[p]));
  writer.write_measure({sensor_prefix + name + "_spans", {}, {}, texts}, attributes);
}

std::string measures_hash(const Study& study) {
  const std::string text = measures_text(study);
  if (text.empty()) return {};
  Digest digest;
  digest.add(text);
  return digest.hex();
}

}  // namespace sunload
