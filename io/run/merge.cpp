// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/merge.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "io/base/bands.h"
#include "io/batch/batch_tally.h"
#include "io/batch/facade_means.h"
#include "io/result/schema.h"
#include "io/run/band_writer.h"
#include "io/run/measure_merge.h"
#include "io/run/part_merge.h"
#include "io/run/result_attributes.h"
#include "io/run/result_geometry.h"
#include "io/run/step_merge.h"
#include "io/run/stored_series.h"
#include "io/run/totals.h"
#include "io/study/words.h"

namespace sunload {

namespace {

/// Light loads of selections, which may overlap: one after the other.
void write_selections(BandWriter& writer, const Totals& totals, const ResultGeometry& geometry,
                      std::size_t realizations) {
  const std::size_t count = geometry.selection_name.size();
  if (count == 0 || geometry.patch_area.empty()) return;
  std::vector<FacadeMeans> means;
  for (const auto& flags : geometry.selected) {
    std::vector<std::int32_t> entry;
    entry.reserve(flags.size());
    for (const auto flag : flags) entry.push_back(flag != 0 ? 0 : -1);
    means.emplace_back(std::move(entry), geometry.patch_area, 1);
  }
  const auto of_selections = [&](const std::string& array) {
    const auto values = scaled(totals[array], kwh_per_joule);
    std::vector<double> all(values.size() / geometry.patch_area.size() * count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto of_one = means[k].of(values, Divided::terms);
      for (std::size_t row = 0; row < of_one.size(); ++row)
        all[row * count + k] = geometry.selection_area[k] > 0 ? of_one[row] : std::nan("");
    }
    return all;
  };
  const auto of_realizations = [&](const std::string& band) {
    return of_selections(band + batch_array::exposure);
  };
  writer.write("selection_light_load_realization", realizations, of_realizations);
  writer.write("selection_light_load_se", 1,
               [&](const std::string& band) { return errors_of(of_realizations(band), count); });
  writer.write("selection_light_load", 1, [&](const std::string& band) {
    return of_selections(band + sum_name(Part::total));
  });
}

/// Totals of N patches or sensors; names begin with `prefix`.
void write_received(BandWriter& writer, const Totals& totals, const std::string& prefix,
                    std::size_t N, std::size_t realizations) {
  for (std::size_t p = 0; p < part_count; ++p) {
    const std::string sum = prefix + sum_name(static_cast<Part>(p));
    if (!totals.has(writer.first() + sum)) continue;
    const std::string name = static_cast<Part>(p) == Part::total
                                 ? "light_load"
                                 : std::string("light_load_") + part_names[p];
    writer.write(prefix + name, 1, [&](const std::string& band) {
      return scaled(totals[band + sum], kwh_per_joule);
    });
    const std::string exposure = prefix + part_exposure_name(static_cast<Part>(p));
    if (totals.has(writer.first() + exposure))
      writer.write(prefix + name + "_se", 1, [&](const std::string& band) {
        return errors_of(scaled(totals[band + exposure], kwh_per_joule), N);
      });
  }
  const auto of_realizations = [&](const std::string& band) {
    return scaled(totals[band + prefix + batch_array::exposure], kwh_per_joule);
  };
  writer.write(prefix + "light_load_realization", realizations, of_realizations);
  writer.write(prefix + "light_load_se", 1,
               [&](const std::string& band) { return errors_of(of_realizations(band), N); });
  writer.write_once(prefix + "sun_hours",
                    scaled(totals[prefix + batch_array::sunlit], 1 / seconds_per_hour));
  writer.write(prefix + "irradiance_max", 1, [&](const std::string& band) {
    return totals[band + prefix + batch_array::maximum];
  });
  if (!writer.first().empty())
    writer.write_once(largest_of_mean_dataset(prefix + "irradiance_max"),
                      totals[prefix + batch_array::maximum]);
  writer.write_once(prefix + "sky_view_factor", totals[prefix + batch_array::sky_view]);
  writer.write_once(prefix + "sky_view_factor_se", totals[prefix + batch_array::sky_view_se]);
}

void write_loads(BandWriter& writer, const Totals& totals, const ResultGeometry& geometry,
                 std::size_t realizations) {
  const std::size_t N = geometry.patch_area.size(), F = geometry.facade_name.size();
  write_received(writer, totals, "", N, realizations);
  if (totals.has(batch_array::patch_lines))
    writer.write_once(batch_array::patch_lines, totals[batch_array::patch_lines]);
  writer.write("power_load", 1, [&](const std::string& band) {
    return scaled(totals[band + batch_array::outgoing], kwh_per_joule);
  });
  if (const std::size_t S = geometry.sensor_position.size(); S > 0)
    write_received(writer, totals, sensor_prefix, S, realizations);
  write_selections(writer, totals, geometry, realizations);
  if (F == 0) return;
  const FacadeMeans means(geometry.patch_facade, geometry.patch_area, F);
  const auto of_facades = [&](const std::string& band) {
    return means.of(scaled(totals[band + batch_array::exposure], kwh_per_joule), Divided::terms);
  };
  writer.write("facade_light_load_realization", realizations, of_facades);
  writer.write("facade_light_load_se", 1,
               [&](const std::string& band) { return errors_of(of_facades(band), F); });
  writer.write("facade_light_load", 1, [&](const std::string& band) {
    return means.of(scaled(totals[band + sum_name(Part::total)], kwh_per_joule), Divided::terms);
  });
}

/// What makes of incident light the light that patches send diffusely. Nothing of it is known
/// where materials change so with the seasons.
void write_surfaces(BandWriter& writer, const VariantPlan& plan, const Hierarchy& hierarchy) {
  if (!sends_alike_in_all_seasons(plan)) return;
  writer.write("diffuse_reflectance", 1, [&](const std::string& band) {
    return diffuse_reflectances(plan, hierarchy, band_array(band).band);
  });
  const auto exitance = emitted_exitances(plan, hierarchy);
  const bool any_emits =
      std::any_of(exitance.begin(), exitance.end(), [](double m) { return m > 0; });
  if (any_emits) writer.write_once("emitted_exitance", exitance);
}

void write_ledger_errors(BandWriter& writer, const Totals& totals) {
  for (std::size_t line = 0; line < ledger_line_count; ++line) {
    const std::string name = ledger_line_names[line];
    writer.write("power_" + name + "_se", 1, [&](const std::string& band) {
      const auto rows = scaled(totals[band + batch_array::ledger], kwh_per_joule);
      return std::vector{errors_of(rows, ledger_line_count)[line]};
    });
  }
}

ResultWriter::Options writer_options(const VariantPlan& plan) {
  ResultWriter::Options options;
  options.chunk_intervals = plan.steps.empty() ? plan.batch_suns() : series_step_rows;
  if (!plan.steps.empty()) options.series_step = word_of(plan.study.output.series_step);
  options.compression = plan.study.output.compression;
  options.realizations = static_cast<std::size_t>(plan.study.solver.realizations);
  options.times_are_synthetic = plan.light.times_are_synthetic;
  options.left_out = unwanted_series(plan.study);
  options.quantity = plan.study.light.quantity;
  options.bands = plan.study.solver.bands;
  options.divisions = result_divisions(plan);
  return options;
}

}  // namespace

std::vector<std::string> merge_variant(const WorkFolder& folder, const VariantPlan& plan,
                                       const StudyFile& file, const Hierarchy& hierarchy,
                                       const std::string& path,
                                       const std::vector<std::size_t>& left_out) {
  const ResultGeometry geometry = result_geometry(plan, hierarchy);
  const ResultWriter::Options options = writer_options(plan);
  ResultWriter writer(path, geometry, result_times(plan), options);
  Totals totals;
  PartMerge parts(writer, plan, geometry);
  MeasureMerge measures(plan, hierarchy, geometry);
  StepMerge steps(writer, plan);
  for (std::size_t b = 0; b < plan.batches(); ++b) {
    if (std::find(left_out.begin(), left_out.end(), b) != left_out.end()) continue;
    const BatchReader batch(folder.batch(b));
    expect_series(batch, options.left_out);
    if (plan.steps.empty())
      writer.append(batch);
    else
      steps.add(batch);
    totals.add(batch);
    parts.add(batch);
    measures.add(batch);
  }
  parts.finish();
  steps.finish();
  totals.add_means();
  BandWriter band_writer(writer, options.bands);
  write_loads(band_writer, totals, geometry, options.realizations);
  write_surfaces(band_writer, plan, hierarchy);
  write_ledger_errors(band_writer, totals);
  measures.write(writer);
  writer.finish(result_attributes({plan, file, totals, geometry, left_out}), file.yaml);
  return result_warnings(totals, geometry);
}

}  // namespace sunload
