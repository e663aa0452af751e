// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/stored_series.h"

#include <algorithm>

#include "io/plan/rules_of_study.h"
#include "io/plan/stored_bits.h"

namespace sunload {

namespace {

/// The batch's rows of the plan's steps.
BatchSteps steps_of_batch(const VariantPlan& plan, std::size_t batch) {
  BatchSteps of;
  const std::size_t begin = batch * plan.batch_suns(),
                    end = std::min(begin + plan.batch_suns(), plan.intervals());
  for (std::size_t row = first_step(plan, batch);
       row < plan.steps.size() && plan.steps[row].first < end; ++row) {
    const SeriesStep& step = plan.steps[row];
    of.rows.push_back({std::max(step.first, begin) - begin, std::min(step.end(), end) - begin});
  }
  for (std::size_t k = begin; k < end; ++k)
    of.length_s.push_back(plan.light.intervals[k].when.length_s());
  return of;
}

}  // namespace

std::size_t first_step(const VariantPlan& plan, std::size_t batch) {
  const auto step = std::partition_point(
      plan.steps.begin(), plan.steps.end(),
      [&](const SeriesStep& of) { return of.end() <= batch * plan.batch_suns(); });
  return static_cast<std::size_t>(step - plan.steps.begin());
}

std::vector<std::string> unwanted_series(const Study& study) {
  const bool has_steps = !study.output.series_step.is_interval();
  std::vector<std::string> unwanted;
  for (std::size_t p = 0; p < part_count; ++p) {
    const auto part = static_cast<Part>(p);
    const bool is_stored = stores_series(study.output, part);
    for (const auto& prefix : {std::string(), sensor_prefix}) {
      const std::string name = prefix + series_name(part);
      if (has_steps && !is_stored) unwanted.push_back(step_prefix + name);
      if (has_steps ? !is_watched(study, part) : !is_stored) unwanted.push_back(name);
    }
  }
  if (!has_steps) return unwanted;
  unwanted.emplace_back("facade_irradiance");
  for (const char* line : ledger_line_names) unwanted.push_back(std::string("power_") + line);
  return unwanted;
}

StoredSeries stored_series(const VariantPlan& plan, std::size_t batch) {
  return {.left_out = unwanted_series(plan.study),
          .mantissa_bits = stored_bits(plan.study),
          .steps = plan.steps.empty() ? BatchSteps{} : steps_of_batch(plan, batch)};
}

}  // namespace sunload
