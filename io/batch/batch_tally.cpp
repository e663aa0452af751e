// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/batch_tally.h"

#include <array>
#include <numeric>

#include "io/base/bands.h"
#include "solver/accuracy.h"

namespace sunload {

namespace {

/// Area-weighted mean irradiance of every facade, [K][facade].
std::vector<float> facade_series(const BatchTally& tally, const Hierarchy& hierarchy,
                                 const Mesh& mesh) {
  const std::size_t patches = hierarchy.patch_count(), facades = mesh.facades.size();
  const auto& total = tally.irradiance[static_cast<std::size_t>(Part::total)];
  std::vector<double> area(facades, 0);
  std::vector<std::int32_t> facade_of(patches, -1);
  for (std::size_t i = 0; i < patches; ++i) {
    const auto& patch = hierarchy.patches()[i];
    if (patch.side != 0) continue;
    facade_of[i] = mesh.triangle_facade[static_cast<std::size_t>(patch.triangle)].value;
    if (facade_of[i] >= 0) area[static_cast<std::size_t>(facade_of[i])] += hierarchy.area()[i];
  }
  std::vector<float> series(tally.intervals * facades, 0);
  std::vector<double> power(facades);
  for (std::size_t k = 0; k < tally.intervals; ++k) {
    std::fill(power.begin(), power.end(), 0);
    for (std::size_t i = 0; i < patches; ++i)
      if (facade_of[i] >= 0)
        power[static_cast<std::size_t>(facade_of[i])] +=
            hierarchy.area()[i] * static_cast<double>(total[k * patches + i]);
    for (std::size_t f = 0; f < facades; ++f)
      if (area[f] > 0) series[k * facades + f] = static_cast<float>(power[f] / area[f]);
  }
  return series;
}

template <class Row>
std::vector<double> flattened(const std::vector<Row>& rows) {
  std::vector<double> flat;
  for (const auto& row : rows) flat.insert(flat.end(), row.begin(), row.end());
  return flat;
}

void add_ledger(BatchWriter& writer, const BatchTally& tally, const std::string& prefix) {
  const std::size_t K = tally.intervals, R = tally.ledger_realization.size();
  for (std::size_t t = 0; t <= term_count; ++t) {
    const auto value = [&](const Ledger& l) { return t < term_count ? l.terms[t] : l.residual(); };
    const std::string name = prefix + "power_" + (t < term_count ? term_names[t] : "residual");
    std::vector<double> power, errors;
    for (const auto& ledger : tally.ledger) power.push_back(value(ledger));
    writer.add({name, MergeRule::append, ArrayType::float64, {K}}, power.data());
    if (tally.ledger_instants.empty()) continue;
    for (std::size_t k = 0; k < K; ++k) {
      std::vector<double> realizations;
      for (std::size_t r = 0; r < R; ++r)
        realizations.push_back(value(tally.ledger_instants[r][k]));
      errors.push_back(mean_error(realizations).standard_error);
    }
    writer.add({name + "_se", MergeRule::append, ArrayType::float64, {K}}, errors.data());
  }
  std::vector<double> energies;
  for (const auto& ledger : tally.ledger_realization) {
    energies.insert(energies.end(), ledger.terms.begin(), ledger.terms.end());
    energies.push_back(ledger.residual());
  }
  writer.add(
      {prefix + batch_array::ledger, MergeRule::sum, ArrayType::float64, {R, term_count + 1}},
      energies.data());
  const std::array energy{tally.energy.in(), tally.energy.residual(), tally.energy.lost_at_backs};
  writer.add({prefix + batch_array::energy, MergeRule::sum, ArrayType::float64, {energy.size()}},
             energy.data());
}

/// What receivers get: series, their time sums, and those of the realizations.
void add_received(BatchWriter& writer, const ReceiverTally& tally, std::size_t K,
                  const std::string& prefix) {
  const std::size_t N = tally.sunlit_s.size(), R = tally.exposure_realization.size();
  for (std::size_t p = 0; p < part_count; ++p) {
    if (tally.irradiance[p].empty()) continue;
    const auto part = static_cast<Part>(p);
    writer.add({prefix + series_name(part), MergeRule::append, ArrayType::float32, {K, N}},
               tally.irradiance[p].data());
    writer.add({prefix + sum_name(part), MergeRule::sum, ArrayType::float64, {N}},
               tally.exposure[p].data());
  }
  if (!tally.irradiance_se.empty())
    writer.add({prefix + "irradiance_se", MergeRule::append, ArrayType::float32, {K, N}},
               tally.irradiance_se.data());
  writer.add({prefix + batch_array::exposure, MergeRule::sum, ArrayType::float64, {R, N}},
             flattened(tally.exposure_realization).data());
  const std::vector<double> largest(tally.irradiance_max.begin(), tally.irradiance_max.end());
  writer.add({prefix + batch_array::maximum, MergeRule::maximum, ArrayType::float64, {N}},
             largest.data());
}

void add_sunlit(BatchWriter& writer, const ReceiverTally& tally, const std::string& prefix) {
  writer.add(
      {prefix + batch_array::sunlit, MergeRule::sum, ArrayType::float64, {tally.sunlit_s.size()}},
      tally.sunlit_s.data());
}

/// What sensors have that is the same in all bands.
void add_sensors(BatchWriter& writer, const BatchTally& tally, const LightSolver& solver) {
  add_sunlit(writer, tally.sensors, sensor_prefix);
  std::vector<double> sky, backs;
  for (const auto& ends : solver.sensor_lines().pooled.ends) {
    sky.push_back(static_cast<double>(ends.sky));
    backs.push_back(static_cast<double>(ends.fate.backs));
  }
  writer.add(
      {sensor_prefix + batch_array::sky_view, MergeRule::maximum, ArrayType::float64, {sky.size()}},
      sky.data());
  writer.add({batch_array::sensor_backs, MergeRule::maximum, ArrayType::float64, {backs.size()}},
             backs.data());
}

}  // namespace

std::string series_name(Part part) {
  return part == Part::total
             ? "irradiance"
             : std::string("irradiance_") + part_names[static_cast<std::size_t>(part)];
}

std::string sum_name(Part part) {
  return std::string("sum_") + part_names[static_cast<std::size_t>(part)];
}

std::vector<double> work_values(const WorkDone& w) {
  return {static_cast<double>(w.line_rays),
          static_cast<double>(w.direct_rays),
          static_cast<double>(w.mirror_rays),
          w.lines_s,
          w.direct_s,
          w.mirror_s,
          w.solve_s,
          w.realizations_s,
          static_cast<double>(w.mirror_beams),
          static_cast<double>(w.mirror_shots),
          static_cast<double>(w.samples),
          static_cast<double>(w.shot_rays),
          w.shoot_s,
          static_cast<double>(w.sensor_rays),
          w.sensors_s};
}

WorkDone work_from(const std::vector<double>& v) {
  return {.line_rays = static_cast<std::uint64_t>(v.at(0)),
          .direct_rays = static_cast<std::uint64_t>(v.at(1)),
          .mirror_rays = static_cast<std::uint64_t>(v.at(2)),
          .sensor_rays = static_cast<std::uint64_t>(v.at(13)),
          .mirror_beams = static_cast<std::uint64_t>(v.at(8)),
          .mirror_shots = static_cast<std::uint64_t>(v.at(9)),
          .lines_s = v.at(3),
          .direct_s = v.at(4),
          .mirror_s = v.at(5),
          .solve_s = v.at(6),
          .realizations_s = v.at(7),
          .sensors_s = v.at(14),
          .samples = static_cast<std::uint64_t>(v.at(10)),
          .shot_rays = static_cast<std::uint64_t>(v.at(11)),
          .shoot_s = v.at(12)};
}

void add_tallies(BatchWriter& writer, const std::vector<BatchTally>& bands,
                 const LightSolver& solver, const Mesh& mesh, const WorkDone& work,
                 std::optional<double> irradiance_relative) {
  const Hierarchy& hierarchy = solver.hierarchy();
  const std::size_t N = hierarchy.patch_count();
  const auto prefixes = band_prefixes(solver.rules().bands);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const BatchTally& tally = bands[b];
    const std::size_t K = tally.intervals;
    const std::string& prefix = prefixes[b];
    add_received(writer, tally, K, prefix);
    if (!tally.sensors.sunlit_s.empty())
      add_received(writer, tally.sensors, K, prefix + sensor_prefix);
    if (!mesh.facades.empty())
      writer.add({prefix + "facade_irradiance",
                  MergeRule::append,
                  ArrayType::float32,
                  {K, mesh.facades.size()}},
                 facade_series(tally, hierarchy, mesh).data());
    add_ledger(writer, tally, prefix);
    writer.add({prefix + batch_array::outgoing, MergeRule::sum, ArrayType::float64, {N}},
               tally.outgoing.data());
  }
  add_sunlit(writer, bands.front(), "");
  if (!bands.front().sensors.sunlit_s.empty()) add_sensors(writer, bands.front(), solver);
  writer.add({batch_array::sky_view, MergeRule::maximum, ArrayType::float64, {N}},
             solver.sky_view_factor().data());
  const double bounces = solver.bounces();
  writer.add({batch_array::bounces, MergeRule::maximum, ArrayType::float64, {1}}, &bounces);
  const SolverRules& rules = solver.rules();
  const std::vector<double> lines(rules.lines_of_patch.begin(), rules.lines_of_patch.end());
  const double mean_lines = lines.empty() ? rules.lines_per_patch
                                          : std::accumulate(lines.begin(), lines.end(), 0.0) /
                                                static_cast<double>(lines.size());
  if (!lines.empty())
    writer.add({batch_array::patch_lines, MergeRule::maximum, ArrayType::float64, {N}},
               lines.data());
  std::vector<double> counts{mean_lines, static_cast<double>(rules.direct_samples)};
  if (rules.samples_per_patch) counts.push_back(*rules.samples_per_patch);
  writer.add({batch_array::counts, MergeRule::maximum, ArrayType::float64, {counts.size()}},
             counts.data());
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
