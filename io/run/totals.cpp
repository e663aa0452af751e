// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/totals.h"

#include <algorithm>

#include "io/base/bands.h"
#include "io/batch/batch_tally.h"

namespace sunload {

void Totals::add(const BatchReader& batch) {
  for (const auto& spec : batch.arrays()) {
    const bool is_total = spec.rule == MergeRule::sum || spec.rule == MergeRule::maximum;
    if (is_total && !part_array(spec.name).part)
      add(spec.name, spec.rule, batch.doubles(spec.name));
  }
}

void Totals::add(const std::string& name, MergeRule rule, std::vector<double> values) {
  auto [place, is_first] = arrays_.try_emplace(name);
  if (is_first) {
    place->second = std::move(values);
    return;
  }
  auto& total = place->second;
  for (std::size_t i = 0; i < total.size(); ++i)
    total[i] = rule == MergeRule::sum ? total[i] + values[i] : std::max(total[i], values[i]);
}

void Totals::add_means() {
  const auto prefixes = band_prefixes(Bands::rgb);
  std::map<std::string, std::vector<double>> means;
  for (const auto& [name, values] : arrays_) {
    const BandArray array = band_array(name);
    if (array.band != 0) continue;
    auto mean = values;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      for (std::size_t b = 1; b < band_count; ++b)
        mean[i] += arrays_.at(prefixes[b] + array.name)[i];
      mean[i] /= static_cast<double>(band_count);
    }
    means.emplace(array.name, std::move(mean));
  }
  arrays_.merge(means);
}

/// Standard error over the rows of a [realization, n] array.
std::vector<double> errors_of(const std::vector<double>& rows, std::size_t n) {
  const std::size_t realizations = n > 0 ? rows.size() / n : 0;
  std::vector<double> errors(n), values(realizations);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = 0; r < realizations; ++r) values[r] = rows[r * n + i];
    errors[i] = mean_error(values).standard_error;
  }
  return errors;
}

}  // namespace sunload
