// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/step_merge.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/batch/batch_tally.h"
#include "io/run/stored_series.h"

namespace sunload {

namespace {

std::size_t columns_of(const ArraySpec& spec) { return spec.dims.size() > 1 ? spec.dims[1] : 1; }

/// Of arrays [time]; all others are series.
bool is_ledger(const ArraySpec& spec) { return spec.dims.size() == 1; }

/// "red/step/irradiance" → "red/irradiance".
std::string without_prefix(std::string name) {
  return name.erase(name.find(step_prefix), step_prefix.size());
}

/// Of a step whose batches are not all there.
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void StepMerge::add(const BatchReader& batch) {
  std::map<std::string, std::vector<double>> rows;
  std::size_t count = 0;
  for (const ArraySpec& spec : batch.arrays()) {
    if (spec.rule != MergeRule::step) continue;
    const std::string name = without_prefix(spec.name);
    arrays_.try_emplace(name, spec);
    rows[name] = batch.doubles(spec.name);
    count = spec.dims.front();
  }
  const std::size_t first = first_step(plan_, batch.header().batch);
  for (std::size_t row = 0; row < count; ++row) {
    go_to(first + row);
    for (const auto& [name, values] : rows) {
      const std::size_t n = columns_of(arrays_.at(name));
      auto& sum = sums_[name];
      sum.resize(n, 0);
      for (std::size_t i = 0; i < n; ++i) sum[i] += values[row * n + i];
    }
    ++batches_of_step_;
  }
}

void StepMerge::finish() {
  if (arrays_.empty()) return;
  close_step();
  write_chunk();
}

/// Steps come in their order; between them may be some of batches that are not there.
void StepMerge::go_to(std::size_t step) {
  if (step == step_) return;
  close_step();
  step_ = step;
  if (step_ / series_step_rows == chunk_) return;
  write_chunk();
  chunk_ = step_ / series_step_rows;
}

bool StepMerge::has_all_batches() const {
  const SeriesStep& step = plan_.steps[step_];
  return batches_of_step_ ==
         (step.end() - 1) / plan_.batch_suns() - step.first / plan_.batch_suns() + 1;
}

void StepMerge::close_step() {
  const std::size_t row = step_ % series_step_rows;
  if (has_all_batches()) {
    const double length_s = plan_.steps[step_].bounds[1] - plan_.steps[step_].bounds[0];
    for (const auto& [name, sum] : sums_) {
      const auto put = [&, &values = sum](auto& rows) {
        using Value = typename std::decay_t<decltype(rows)>::value_type;
        rows.resize(row * values.size(), static_cast<Value>(missing));
        for (const double value : values) rows.push_back(static_cast<Value>(value / length_s));
      };
      if (is_ledger(arrays_.at(name)))
        put(ledger_[name]);
      else
        put(series_[name]);
    }
  }
  sums_.clear();
  batches_of_step_ = 0;
}

void StepMerge::write_chunk() {
  StepRows rows;
  rows.first = chunk_ * series_step_rows;
  rows.count = std::min(series_step_rows, plan_.steps.size() - rows.first);
  for (const auto& [name, spec] : arrays_) {
    const std::size_t n = columns_of(spec), size = rows.count * n;
    if (is_ledger(spec)) {
      ledger_[name].resize(size, missing);
      rows.ledger.push_back({name, std::move(ledger_[name])});
    } else {
      series_[name].resize(size, missing);
      rows.series.push_back({name, spec.mantissa_bits, n, std::move(series_[name])});
    }
  }
  series_.clear();
  ledger_.clear();
  writer_.append(rows);
}

}  // namespace sunload
