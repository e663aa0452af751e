// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/explain/explanation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/statistics.h"
#include "io/explain/light_of_part.h"
#include "io/explain/place.h"

namespace sunload {

namespace {

using Kind = ExplainedRow::Kind;

std::array<double, column_count> unknown_columns() {
  std::array<double, column_count> columns{};
  columns.fill(not_known);
  return columns;
}

ExplainedRow row_of(Kind kind, std::vector<double> realizations) {
  const SampleMean mean = sample_mean(realizations);
  return {kind, {}, unknown_columns(), mean.mean, mean.se, not_known, std::move(realizations)};
}

template <class Value>
std::vector<double> of_realizations(const Attribution& a, Value&& value) {
  std::vector<double> values;
  for (std::size_t r = 0; r < a.realizations(); ++r) values.push_back(value(r) / joules_per_kwh);
  return values;
}

template <class Value>
double mean_value(const Attribution& a, Value&& value) {
  return sample_mean(of_realizations(a, value)).mean;
}

ExplainedRow open_row(const Attribution& a) {
  using Open = Attribution::Open;
  constexpr std::array sources{Open::sun, Open::sky, Open::far_ground};
  ExplainedRow row = row_of(Kind::open, of_realizations(a, [&](std::size_t r) {
                              double sum = 0;
                              for (const Open source : sources) sum += a.open(source, r);
                              return sum;
                            }));
  row.columns.fill(0);
  for (std::size_t c = 0; c < sources.size(); ++c)
    row.columns[c] = mean_value(a, [&](std::size_t r) { return a.open(sources[c], r); });
  return row;
}

ExplainedRow object_row(const Attribution& a, std::size_t object, const std::string& name) {
  constexpr std::array flows{Flow::takes_sun, Flow::takes_sky, Flow::takes_far_ground,
                             Flow::reflects,  Flow::mirrors,   Flow::shines};
  constexpr std::size_t taken = 3;  // of these
  ExplainedRow row =
      row_of(Kind::object, of_realizations(a, [&](std::size_t r) { return a.net(object, r); }));
  row.name = name;
  for (std::size_t c = 0; c < flows.size(); ++c) {
    const double value = mean_value(a, [&](std::size_t r) { return a.flow(object, flows[c], r); });
    row.columns[c] = c < taken ? 0 - value : value;
  }
  return row;
}

bool does_anything(const ExplainedRow& row) {
  return std::any_of(row.columns.begin(), row.columns.end(), [](double v) { return v != 0; });
}

/// What the result has, and what of it nothing explains.
void add_result(const ResultReader& result, const Place& place, Explanation& into) {
  const std::string load = place.is_of_sensors ? "sensor_light_load" : "light_load";
  ExplainedRow stored = row_of(Kind::result, {}), rest = row_of(Kind::remainder, {});
  stored.total = mean_over(place, result.doubles(load));
  stored.se = rest.se = not_known;
  const ExplainedRow& sum = into.rows.back();
  rest.total = stored.total - sum.total;
  if (const std::string name = load + "_realization"; result.has(name)) {
    for (std::size_t r = 0; r < sum.realizations.size(); ++r) {
      stored.realizations.push_back(mean_over(place, result.row(name, r)));
      rest.realizations.push_back(stored.realizations.back() - sum.realizations[r]);
    }
    stored.se = sample_mean(stored.realizations).se;
    rest.se = sample_mean(rest.realizations).se;
  }
  into.rows.push_back(std::move(stored));
  into.rows.push_back(std::move(rest));
}

ExplainedRow sum_row(const Attribution& a, const std::vector<ExplainedRow>& rows) {
  ExplainedRow sum =
      row_of(Kind::sum, of_realizations(a, [&](std::size_t r) { return a.total(r); }));
  sum.columns.fill(0);
  for (const ExplainedRow& row : rows)
    for (std::size_t c = 0; c < column_count; ++c) sum.columns[c] += row.columns[c];
  return sum;
}

void note_what_is_left_out(const TracedScene& traced, Explanation& into) {
  std::string ways;
  const auto append = [&](bool is_there, const char* words) {
    if (is_there) ways += (ways.empty() ? "" : ", ") + std::string(words);
  };
  append(traced.optics.any_glossy, "the sun by glossy surfaces");
  append(!traced.scene.parallel_sources.exitance.empty(), "parallel sources");
  append(traced.scene.luminaires.any(), "luminaires");
  append(traced.mirror_orientations() > static_cast<std::size_t>(traced.rules.most_sun_beams),
         "the sun by mirrors of more orientations than are followed back");
  if (!ways.empty()) into.notes.push_back("the remainder holds what is not looked for: " + ways);
}

/// Objects by what they change, the most first; equal ones by name.
void sort_objects(std::vector<ExplainedRow>& rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const ExplainedRow& a, const ExplainedRow& b) {
    const bool are_objects = a.kind == Kind::object && b.kind == Kind::object;
    return are_objects ? std::abs(a.total) > std::abs(b.total) : a.kind < b.kind;
  });
}

}  // namespace

void expect_explainable(const ResultReader& result) {
  if (const std::string lacking = result.lacking(); !lacking.empty())
    throw InputError({result.path()}, "is incomplete: " + lacking,
                     "what objects take and give is that of the whole period",
                     "explain the result of a finished run");
  const std::string needed = result.chosen().any() ? "light_load" : "power_load";
  if (!result.has(needed))
    throw InputError({result.path()}, "has no " + needed, "it is what objects give",
                     "run the study again");
}

std::string kind_name(ExplainedRow::Kind kind) {
  constexpr std::array names{"open", "object", "sum", "result", "remainder"};
  return names[static_cast<std::size_t>(kind)];
}

Explanation explained(const ResultReader& result, const ResultScene& scene,
                      const NamedParts& parts) {
  expect_explainable(result);
  scene.expect_one_season();
  const Place place = place_named(result, parts);
  Explanation into;
  into.study = result.text_attribute("study");
  into.variant = result.text_attribute("variant");
  into.place = words_of(parts);
  into.part = result.chosen().words();
  into.units = result.units("light_load");
  into.quantity = result.quantity();
  into.extent = extent_of(result, place);

  const Attribution a = attribute_light(scene.traced(), scene.period(), sent_light(result, scene),
                                        place, chosen_part(result, scene.light()));
  into.rows.push_back(open_row(a));
  const auto& names = scene.traced().scene.mesh.object_names;
  for (std::size_t o = 0; o < a.objects(); ++o) {
    ExplainedRow row = object_row(a, o, names[o]);
    if (does_anything(row)) into.rows.push_back(std::move(row));
  }
  sort_objects(into.rows);
  into.rows.push_back(sum_row(a, into.rows));
  add_result(result, place, into);
  note_what_is_left_out(scene.traced(), into);
  return into;
}

namespace {

/// variant − base; errors of pairs where the realizations are.
ExplainedRow row_difference(const ExplainedRow& base, const ExplainedRow& variant, bool are_pairs) {
  ExplainedRow row = variant;
  row.total -= base.total;
  for (std::size_t c = 0; c < column_count; ++c) row.columns[c] -= base.columns[c];
  row.se = std::hypot(base.se, variant.se);
  row.realizations.clear();
  if (!are_pairs || base.realizations.size() != variant.realizations.size()) return row;
  for (std::size_t r = 0; r < base.realizations.size(); ++r)
    row.realizations.push_back(variant.realizations[r] - base.realizations[r]);
  if (!row.realizations.empty()) row.se = sample_mean(row.realizations).se;
  return row;
}

/// A row of an object that is not there.
ExplainedRow nothing_like(const ExplainedRow& row) {
  ExplainedRow none = row;
  none.columns.fill(0);
  none.total = none.se = 0;
  std::fill(none.realizations.begin(), none.realizations.end(), 0.0);
  return none;
}

}  // namespace

Explanation difference(const Explanation& base, const Explanation& variant, bool are_pairs) {
  if (base.units != variant.units)
    throw InputError({}, "results of " + base.units + " and " + variant.units,
                     "they have no difference", "explain results of one quantity");
  Explanation change = variant;
  change.base = base.variant;
  change.rows.clear();
  change.notes.emplace_back(are_pairs ? "errors are those of paired realizations"
                                      : "the results share no random numbers: errors add up");
  std::map<std::pair<Kind, std::string>, const ExplainedRow*> before;
  for (const ExplainedRow& row : base.rows) before[{row.kind, row.name}] = &row;
  for (const ExplainedRow& row : variant.rows) {
    const auto found = before.find({row.kind, row.name});
    const bool is_new = found == before.end();
    change.rows.push_back(
        row_difference(is_new ? nothing_like(row) : *found->second, row, are_pairs));
    if (!is_new) before.erase(found);
  }
  for (const auto& [key, row] : before)
    change.rows.push_back(row_difference(*row, nothing_like(*row), are_pairs));
  sort_objects(change.rows);
  const auto sum = std::find_if(change.rows.begin(), change.rows.end(),
                                [](const ExplainedRow& row) { return row.kind == Kind::sum; });
  for (ExplainedRow& row : change.rows)
    if (sum->total != 0 && row.kind <= Kind::sum) row.share_percent = 100 * row.total / sum->total;
  return change;
}

}  // namespace sunload
