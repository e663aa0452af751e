// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/part_totals.h"

#include <algorithm>
#include <map>
#include <set>

#include "geo/base/check.h"

namespace sunload {

namespace {

std::vector<PeriodDivision> asked_for(const std::vector<PartKind>& kinds,
                                      const std::vector<TimeSpan>& intervals, const TimeZone& zone,
                                      double latitude_deg) {
  std::vector<PeriodDivision> divisions;
  divisions.reserve(kinds.size());
  for (const PartKind kind : kinds)
    divisions.push_back(divided(kind, intervals, zone, latitude_deg));
  return divisions;
}

/// Those that cost little and that nearly everyone wants to see.
std::vector<PeriodDivision> by_themselves(const std::vector<TimeSpan>& intervals,
                                          const TimeZone& zone, double latitude_deg) {
  std::vector<PeriodDivision> divisions;
  for (const auto& [kind, most] : {std::pair{PartKind::month, intervals.size()},
                                   std::pair{PartKind::day, most_days_by_themselves}}) {
    PeriodDivision division = divided(kind, intervals, zone, latitude_deg);
    if (division.parts.size() > 1 && division.parts.size() <= most)
      divisions.push_back(std::move(division));
  }
  return divisions;
}

}  // namespace

std::vector<PartTotals> part_totals(const Study& study, const LightSeries& light,
                                    double latitude_deg) {
  const auto& kinds = study.output.totals;
  if (light.times_are_synthetic) {
    if (kinds && !kinds->empty())
      throw InputError(study.output.totals_where,
                       "output.totals: the period has no months, days and hours",
                       "suns are given by their positions, without times", "write totals: auto");
    return {};
  }
  const std::vector<TimeSpan> intervals = light.spans();
  const TimeZone zone(study.site.timezone);
  auto divisions = kinds ? asked_for(*kinds, intervals, zone, latitude_deg)
                         : by_themselves(intervals, zone, latitude_deg);
  std::vector<PartTotals> totals;
  for (auto& division : divisions) {
    const bool with_errors = study.output.standard_error != StandardErrors::none &&
                             division.parts.size() <= most_parts_with_errors;
    totals.push_back({std::move(division), with_errors});
  }
  return totals;
}

PartCost part_cost(const std::vector<PartTotals>& totals, std::size_t batch_suns) {
  PartCost cost;
  std::map<std::size_t, std::size_t> of_batch, solved;  // parts of all divisions
  for (const auto& [division, with_errors] : totals) {
    std::map<std::size_t, std::size_t> parts;  // of this division, by batch
    for (const auto& part : division.parts) {
      std::set<std::size_t> batches;
      for (const auto& share : part.intervals) batches.insert(share.interval / batch_suns);
      for (const std::size_t batch : batches) ++parts[batch];
    }
    cost.parts += division.parts.size();
    if (with_errors) cost.parts_with_errors += division.parts.size();
    for (const auto& [batch, count] : parts) {
      cost.stored += count;
      of_batch[batch] += count;
      if (!with_errors) continue;
      cost.stored_with_errors += count;
      if (count > 1) solved[batch] += count;
    }
  }
  for (const auto& [batch, count] : of_batch) cost.most = std::max(cost.most, count);
  for (const auto& [batch, count] : solved) cost.blocks += (count + block_width - 1) / block_width;
  return cost;
}

}  // namespace sunload
