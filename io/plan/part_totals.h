// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One division of the period whose parts have totals in the result.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/time/period_parts.h"
#include "io/plan/light_series.h"
#include "io/study/study.h"

namespace sunload {

struct PartTotals {
  PeriodDivision division;
  bool with_errors = true;  ///< standard errors and realizations too
};

/// A realization's light of a part costs a solution of its own in every batch that the part has
/// time in, and room on the disk: of more parts than these only the pooled estimate is kept.
inline constexpr std::size_t most_parts_with_errors = 31;
/// `auto`: months where the period has several, and days where it has no more than these.
inline constexpr std::size_t most_days_by_themselves = 12;

/// What `output.totals` asks for, or `auto` stands for: divisions in the order of `PartKind`. None
/// where times are synthetic. Throws InputError where parts are asked for there.
std::vector<PartTotals> part_totals(const Study& study, const LightSeries& light,
                                    double latitude_deg);

/// What the totals cost, counted over all batches.
struct PartCost {
  std::size_t parts = 0;                           ///< of all divisions
  std::size_t parts_with_errors = 0;               ///< of these
  std::size_t stored = 0, stored_with_errors = 0;  ///< parts that batches have time in
  std::size_t blocks = 0;  ///< up to 16 parts that every realization solves side by side
  std::size_t most = 0;    ///< parts with time in one batch, of all divisions
};
PartCost part_cost(const std::vector<PartTotals>& totals, std::size_t batch_suns);

}  // namespace sunload
