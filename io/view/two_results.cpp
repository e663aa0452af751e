// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/view/two_results.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/result/common_area.h"
#include "io/view/scale_of_times.h"

namespace sunload {
namespace {

bool is_each_its_own(const PatchOverlaps& overlaps) {
  if (overlaps.base_area.size() != overlaps.variant_area.size()) return false;
  for (std::size_t p = 0; p < overlaps.of_base.size(); ++p)
    if (overlaps.of_base[p].size() != 1 || overlaps.of_base[p].front().patch != p) return false;
  return true;
}

void add_pairs(const PatchOverlaps& overlaps, TwoResults& two) {
  const auto covered =
      means_on_base(overlaps, std::vector<double>(overlaps.variant_area.size(), 1));
  two.count.assign(covered.size(), 0);
  for (std::size_t p = 0; p < covered.size(); ++p) {
    if (std::isnan(covered[p])) continue;
    for (const auto& [other, common] : overlaps.of_base[p]) {
      if (!(common > 0)) continue;
      ++two.count[p];
      two.patch.push_back(static_cast<std::int32_t>(other));
      two.area.push_back(static_cast<float>(common));
    }
  }
}

/// Of the intervals that a page has, the one that holds an instant.
std::optional<std::size_t> interval_with(const std::vector<double>& bounds, double time,
                                         std::size_t step) {
  for (std::size_t i = 0; 2 * i + 1 < bounds.size(); i += step)
    if (bounds[2 * i] <= time && time < bounds[2 * i + 1]) return i;
  return {};
}

/// End of the scale of differences at all times.
double end_of_series(const ResultReader& first, const ResultReader& second,
                     const PatchOverlaps& overlaps, const std::string& name, std::size_t step) {
  const auto bounds = first.doubles("time_bounds"), others = second.doubles("time_bounds");
  ScaleOfTimes scale(overlaps.base_area);
  for (std::size_t i = 0; 2 * i + 1 < bounds.size(); i += step) {
    const auto other = interval_with(others, (bounds[2 * i] + bounds[2 * i + 1]) / 2, step);
    if (!other) continue;
    const auto own = first.row(name, i);
    auto apart = means_on_base(overlaps, second.row(name, *other));
    for (std::size_t p = 0; p < apart.size(); ++p) apart[p] = std::abs(apart[p] - own[p]);
    scale.add(apart);
  }
  return scale.end();
}

}  // namespace

TwoResults two_results(const ResultReader& first, const ResultReader& second,
                       const std::string& series, std::size_t step) {
  const PatchOverlaps overlaps = patch_overlaps(first, second);
  TwoResults two;
  two.is_same = is_each_its_own(overlaps);
  if (!two.is_same) add_pairs(overlaps, two);
  if (!series.empty()) two.end = end_of_series(first, second, overlaps, series, step);
  return two;
}

}  // namespace sunload
