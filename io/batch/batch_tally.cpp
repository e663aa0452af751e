// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/batch_tally.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "geo/base/check.h"
#include "io/base/bands.h"
#include "io/batch/facade_means.h"
#include "solver/accuracy.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

constexpr std::string_view part_word = "part/";

/// Mean irradiance of every facade, [K][facade].
std::vector<float> facade_series(const BatchTally& tally, const Hierarchy& hierarchy,
                                 const Mesh& mesh) {
  std::vector<std::int32_t> facade;
  for (const auto& patch : hierarchy.patches())
    facade.push_back(patch.side == 0
                         ? mesh.triangle_facade[static_cast<std::size_t>(patch.triangle)].value
                         : -1);
  const FacadeMeans means(std::move(facade), hierarchy.area(), mesh.facades.size());
  const auto series =
      means.of(tally.irradiance[static_cast<std::size_t>(Part::total)], Divided::sums);
  return {series.begin(), series.end()};
}

/// Sums of every realization, [R][N], of which only the spread counts: in single precision, as in
/// the result.
void add_realizations(BatchWriter& writer, const std::string& name,
                      const std::vector<std::vector<double>>& rows, std::size_t N) {
  std::vector<float> values;
  values.reserve(rows.size() * N);
  for (const auto& row : rows)
    for (const double value : row) values.push_back(static_cast<float>(value));
  SUNLOAD_EXPECT(values.size() == rows.size() * N, "a value of every receiver and realization");
  writer.add({name, MergeRule::sum, ArrayType::float32, {rows.size(), N}}, values.data());
}

/// Sums over the batch's share of each step, [rows][n], of a series [K][n]: J m-2 of irradiance.
template <class Value>
std::vector<double> step_sums(const Value* series, std::size_t n, const BatchSteps& steps) {
  constexpr std::size_t columns_at_once = 4096;
  std::vector<double> sums(steps.rows.size() * n, 0);
  parallel_chunks(n, columns_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = 0; row < steps.rows.size(); ++row)
      for (std::size_t k = steps.rows[row].first; k < steps.rows[row].end; ++k)
        for (std::size_t i = begin; i < end; ++i)
          sums[row * n + i] += steps.length_s[k] * static_cast<double>(series[k * n + i]);
  });
  return sums;
}

/// A series of the batch's intervals, or what of its steps lies in them. The only place where
/// intervals become steps.
template <class Value>
void add_rows(BatchWriter& writer, const std::string& prefix, const ArraySpec& spec,
              const Value* series, const StoredSeries& stored) {
  const auto is_kept = [&](const std::string& name) {
    const auto& left_out = stored.left_out;
    return std::find(left_out.begin(), left_out.end(), name) == left_out.end();
  };
  ArraySpec of = spec;
  of.name = prefix + spec.name;
  const auto& rows = stored.steps.rows;
  // The result does not keep intervals beside steps: measures watch them, with all bits.
  if (!rows.empty()) of.mantissa_bits = all_mantissa_bits;
  if (is_kept(spec.name)) writer.add(of, series);
  if (rows.empty() || !is_kept(step_prefix + spec.name)) return;
  of.mantissa_bits = spec.mantissa_bits;
  of.name = prefix + step_prefix + spec.name;
  of.rule = MergeRule::step;
  of.type = ArrayType::float64;
  of.dims.front() = rows.size();
  const std::size_t n = spec.dims.size() > 1 ? spec.dims.back() : 1;
  writer.add(of, step_sums(series, n, stored.steps));
}

void add_ledger(BatchWriter& writer, const BatchTally& tally, const std::string& prefix,
                const StoredSeries& stored) {
  const std::size_t K = tally.intervals, R = tally.ledger_realization.size();
  for (std::size_t line = 0; line < ledger_line_count; ++line) {
    const auto value = [&](const Ledger& l) { return ledger_line(l, line); };
    const std::string name = std::string("power_") + ledger_line_names[line];
    std::vector<double> power, errors;
    for (const auto& ledger : tally.ledger) power.push_back(value(ledger));
    add_rows(writer, prefix, {name, MergeRule::append, ArrayType::float64, {K}}, power.data(),
             stored);
    if (tally.ledger_instants.empty()) continue;
    for (std::size_t k = 0; k < K; ++k) {
      std::vector<double> realizations;
      for (std::size_t r = 0; r < R; ++r)
        realizations.push_back(value(tally.ledger_instants[r][k]));
      errors.push_back(mean_error(realizations).standard_error);
    }
    writer.add({prefix + name + "_se", MergeRule::append, ArrayType::float64, {K}}, errors.data());
  }
  std::vector<double> energies;
  for (const auto& ledger : tally.ledger_realization) {
    for (std::size_t line = 0; line < ledger_line_count; ++line)
      energies.push_back(ledger_line(ledger, line));
  }
  writer.add(
      {prefix + batch_array::ledger, MergeRule::sum, ArrayType::float64, {R, ledger_line_count}},
      energies.data());
  const std::array energy{tally.energy.in(), tally.energy.residual(), tally.energy.lost_at_backs};
  writer.add({prefix + batch_array::energy, MergeRule::sum, ArrayType::float64, {energy.size()}},
             energy.data());
}

/// What receivers get: series, their time sums, and those of the realizations.
void add_received(BatchWriter& writer, const ReceiverTally& tally, std::size_t K,
                  const std::string& band, const std::string& receiver,
                  const StoredSeries& stored) {
  const std::size_t N = tally.sunlit_s.size();
  const std::string prefix = band + receiver;
  const auto add_series = [&](const std::string& name, const LargeVector<float>& values) {
    add_rows(writer, band,
             {receiver + name, MergeRule::append, ArrayType::float32, {K, N}, stored.mantissa_bits},
             values.data(), stored);
  };
  for (std::size_t p = 0; p < part_count; ++p) {
    if (tally.exposure[p].empty()) continue;
    const auto part = static_cast<Part>(p);
    if (!tally.irradiance[p].empty()) add_series(series_name(part), tally.irradiance[p]);
    writer.add({prefix + sum_name(part), MergeRule::sum, ArrayType::float64, {N}},
               tally.exposure[p].data());
  }
  if (!tally.irradiance_se.empty()) add_series("irradiance_se", tally.irradiance_se);
  add_realizations(writer, prefix + batch_array::exposure, tally.exposure_realization, N);
  for (std::size_t p = 0; p < part_count; ++p)
    if (!tally.part_realization[p].empty())
      add_realizations(writer, prefix + part_exposure_name(static_cast<Part>(p)),
                       tally.part_realization[p], N);
  const std::vector<double> largest(tally.irradiance_max.begin(), tally.irradiance_max.end());
  writer.add({prefix + batch_array::maximum, MergeRule::maximum, ArrayType::float64, {N}},
             largest.data());
}

/// Of receivers in all bands, without a band in its name: the largest irradiance of the bands'
/// mean, since not all of them are at their largest at one time.
void add_largest_mean(BatchWriter& writer,
                      const std::array<const ReceiverTally*, band_count>& bands,
                      const std::string& receiver) {
  const std::size_t N = bands.front()->sunlit_s.size();
  const auto total = [&](std::size_t b) -> const LargeVector<float>& {
    return bands[b]->irradiance[static_cast<std::size_t>(Part::total)];
  };
  std::vector<double> largest(N, 0);
  parallel_chunks(N, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = 0; row < total(0).size(); row += N)
      for (std::size_t i = begin; i < end; ++i)
        largest[i] = std::max(largest[i],
                              mean_of({total(0)[row + i], total(1)[row + i], total(2)[row + i]}));
  });
  writer.add({receiver + batch_array::maximum, MergeRule::maximum, ArrayType::float64, {N}},
             largest.data());
}

void add_sunlit(BatchWriter& writer, const ReceiverTally& tally, const std::string& prefix) {
  writer.add(
      {prefix + batch_array::sunlit, MergeRule::sum, ArrayType::float64, {tally.sunlit_s.size()}},
      tally.sunlit_s.data());
}

/// What is seen of the sky, with its errors: `prefix` is of patches or of sensors.
void add_sky_view(BatchWriter& writer, const std::string& prefix, const std::vector<double>& sky,
                  const std::vector<double>& errors) {
  for (const auto& [name, values] :
       {std::pair{batch_array::sky_view, &sky}, std::pair{batch_array::sky_view_se, &errors}})
    writer.add({prefix + name, MergeRule::maximum, ArrayType::float64, {values->size()}},
               values->data());
}

/// What sensors have that is the same in all bands.
void add_sensors(BatchWriter& writer, const BatchTally& tally, const SeenOnce& seen) {
  add_sunlit(writer, tally.sensors, sensor_prefix);
  add_sky_view(writer, sensor_prefix, seen.sensor_sky_view_factor, seen.sensor_sky_view_factor_se);
  const auto& backs = seen.sensor_backs;
  writer.add({batch_array::sensor_backs, MergeRule::maximum, ArrayType::float64, {backs.size()}},
             backs.data());
}

/// What every band has of its own.
void add_band(BatchWriter& writer, const BatchTally& tally, const Hierarchy& hierarchy,
              const Mesh& mesh, const std::string& prefix, const StoredSeries& stored) {
  const std::size_t K = tally.intervals;
  add_received(writer, tally, K, prefix, "", stored);
  if (!tally.sensors.sunlit_s.empty())
    add_received(writer, tally.sensors, K, prefix, sensor_prefix, stored);
  if (!mesh.facades.empty())
    add_rows(writer, prefix,
             {"facade_irradiance", MergeRule::append, ArrayType::float32, {K, mesh.facades.size()}},
             facade_series(tally, hierarchy, mesh).data(), stored);
  add_ledger(writer, tally, prefix, stored);
  writer.add({prefix + batch_array::outgoing,
              MergeRule::sum,
              ArrayType::float64,
              {hierarchy.patch_count()}},
             tally.outgoing.data());
}

/// Sums of receivers in one band over a part of the period.
void add_part(BatchWriter& writer, const ReceiverTally& tally, const BatchParts::Source& source,
              const std::string& prefix) {
  const auto add = [&](const std::string& name, const std::vector<double>& values) {
    if (!values.empty())
      writer.add({prefix + name, MergeRule::sum, ArrayType::float64, {values.size()}},
                 values.data());
  };
  const PartTally* of = source.solved ? &tally.parts[*source.solved] : nullptr;
  const auto whole = [&](Part part) { return tally.exposure[static_cast<std::size_t>(part)]; };
  add(sum_name(Part::total), of ? of->total : whole(Part::total));
  add(sum_name(Part::direct), of ? of->direct : whole(Part::direct));
  if (!source.with_errors) return;
  const auto& rows = of ? of->exposure_realization : tally.exposure_realization;
  add_realizations(writer, prefix + batch_array::exposure, rows, tally.sunlit_s.size());
}

void add_part(BatchWriter& writer, const std::vector<BatchTally>& bands,
              const std::vector<std::string>& prefixes, const BatchParts::Source& source) {
  const std::string of_part = part_prefix(source.part);
  const bool has_sensors = !bands.front().sensors.sunlit_s.empty();
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const std::string prefix = prefixes[b] + of_part;
    add_part(writer, bands[b], source, prefix);
    if (has_sensors) add_part(writer, bands[b].sensors, source, prefix + sensor_prefix);
  }
  const auto add_sunlit = [&](const ReceiverTally& tally, const std::string& prefix) {
    const auto& sunlit = source.solved ? tally.parts[*source.solved].sunlit_s : tally.sunlit_s;
    writer.add({prefix + batch_array::sunlit, MergeRule::sum, ArrayType::float64, {sunlit.size()}},
               sunlit.data());
  };
  add_sunlit(bands.front(), of_part);
  if (has_sensors) add_sunlit(bands.front().sensors, of_part + sensor_prefix);
}

/// Lines and samples per patch that were taken.
void add_counts(BatchWriter& writer, const SolverRules& rules) {
  const std::vector<double> lines(rules.lines_of_patch.begin(), rules.lines_of_patch.end());
  const double mean_lines = lines.empty() ? rules.lines_per_patch
                                          : std::accumulate(lines.begin(), lines.end(), 0.0) /
                                                static_cast<double>(lines.size());
  if (!lines.empty())
    writer.add({batch_array::patch_lines, MergeRule::maximum, ArrayType::float64, {lines.size()}},
               lines.data());
  std::vector<double> counts{mean_lines, static_cast<double>(rules.direct_samples)};
  if (rules.samples_per_patch) counts.push_back(*rules.samples_per_patch);
  writer.add({batch_array::counts, MergeRule::maximum, ArrayType::float64, {counts.size()}},
             counts.data());
}

}  // namespace

SeenOnce seen_once(const TracedScene& traced) {
  SeenOnce seen;
  seen.sky_view_factor = sky_view_factors(traced.patches.lines.pooled);
  seen.sky_view_factor_se = sky_view_errors(traced.patches.lines);
  seen.sensor_sky_view_factor = sky_view_factors(traced.sensors.lines.pooled);
  seen.sensor_sky_view_factor_se = sky_view_errors(traced.sensors.lines);
  for (const auto& ends : traced.sensors.lines.pooled.ends)
    seen.sensor_backs.push_back(static_cast<double>(ends.fate.backs));
  seen.bounces = traced.bounces;
  return seen;
}

SeenOnce mean_seen(const std::vector<SeenOnce>& scenes, const std::vector<double>& shares) {
  SeenOnce mean;
  const auto add = [](const std::vector<double>& values, double share, std::vector<double>& sum) {
    sum.resize(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] += share * values[i];
  };
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    add(scenes[s].sky_view_factor, shares[s], mean.sky_view_factor);
    add(scenes[s].sky_view_factor_se, shares[s], mean.sky_view_factor_se);
    add(scenes[s].sensor_sky_view_factor, shares[s], mean.sensor_sky_view_factor);
    add(scenes[s].sensor_sky_view_factor_se, shares[s], mean.sensor_sky_view_factor_se);
    add(scenes[s].sensor_backs, shares[s], mean.sensor_backs);
    mean.bounces = std::max(mean.bounces, scenes[s].bounces);
  }
  return mean;
}

std::string series_name(Part part) {
  return part == Part::total
             ? "irradiance"
             : std::string("irradiance_") + part_names[static_cast<std::size_t>(part)];
}

std::string sum_name(Part part) {
  return std::string("sum_") + part_names[static_cast<std::size_t>(part)];
}

std::string part_exposure_name(Part part) {
  return batch_array::exposure + ("_" + std::string(part_names[static_cast<std::size_t>(part)]));
}

std::string part_prefix(std::size_t part) {
  return std::string(part_word) + std::to_string(part) + "/";
}

PartArray part_array(const std::string& name) {
  const auto begin = name.find(part_word);
  if (begin == std::string::npos) return {{}, name};
  const auto number = begin + part_word.size(), end = name.find('/', number);
  SUNLOAD_EXPECT(end != std::string::npos, "name of a part's array");
  return {std::stoul(name.substr(number, end - number)),
          name.substr(0, begin) + name.substr(end + 1)};
}

std::vector<double> work_values(const WorkDone& work) {
  return {work.values().begin(), work.values().end()};
}

WorkDone work_from(const std::vector<double>& values) {
  SUNLOAD_EXPECT(values.size() == work_count, "kinds of work");
  WorkDone work;
  std::copy(values.begin(), values.end(), work.values().begin());
  return work;
}

void add_tallies(BatchWriter& writer, const std::vector<BatchTally>& bands,
                 const TracedScene& traced, const SeenOnce& seen, const Mesh& mesh,
                 const BatchParts& parts, const WorkDone& work,
                 std::optional<double> irradiance_relative, const StoredSeries& stored) {
  const Hierarchy& hierarchy = traced.hierarchy();
  const auto prefixes = band_prefixes(traced.rules.bands);
  for (std::size_t b = 0; b < bands.size(); ++b)
    add_band(writer, bands[b], hierarchy, mesh, prefixes[b], stored);
  for (const auto& source : parts.sources) add_part(writer, bands, prefixes, source);
  if (bands.size() == band_count) {
    add_largest_mean(writer, {&bands[0], &bands[1], &bands[2]}, "");
    if (!bands.front().sensors.sunlit_s.empty())
      add_largest_mean(writer, {&bands[0].sensors, &bands[1].sensors, &bands[2].sensors},
                       sensor_prefix);
  }
  add_sunlit(writer, bands.front(), "");
  if (!bands.front().sensors.sunlit_s.empty()) add_sensors(writer, bands.front(), seen);
  add_sky_view(writer, "", seen.sky_view_factor, seen.sky_view_factor_se);
  const double bounces = seen.bounces;
  writer.add({batch_array::bounces, MergeRule::maximum, ArrayType::float64, {1}}, &bounces);
  add_counts(writer, traced.rules);
  if (irradiance_relative && bands.size() == 1 && !bands.front().irradiance_se.empty()) {
    const auto [all, kept] = kept_area(bands.front(), hierarchy.area(), *irradiance_relative);
    const std::array area{all, kept};
    writer.add({batch_array::kept_area, MergeRule::sum, ArrayType::float64, {area.size()}},
               area.data());
  }
  const auto cost = work_values(work);
  writer.add({batch_array::work, MergeRule::sum, ArrayType::float64, {cost.size()}}, cost.data());
}

}  // namespace sunload
