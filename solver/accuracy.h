// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of lines, direct samples and, when shooting, samples of power that a study needs for the
/// accuracy that it asks for, from what a pilot found.
///
/// Every patch gets the lines that it needs itself. Direct samples and samples shot are doubled
/// until the goals are met on 95 % of the leaf area that counts, the cheapest way. All counts
/// are frozen before the first tally, with room for the errors of the errors that so few
/// realizations state: counts chosen from the very realizations that are tallied would
/// bias them. Patches with less than 1 % of the largest value do not count, those that can
/// receive no light among them; the pilot has lines enough that a patch of which none finds
/// light lies below that share.
#pragma once

#include <optional>
#include <vector>

#include "solver/accuracy_pilot.h"

namespace sunload {

/// What a study asks for: at least one of the two errors is given.
struct AccuracyGoal {
  std::optional<double> light_load_relative = {};  ///< standard error / light load of a patch
  int most_per_patch = 4096;                       ///< lines, direct samples, samples shot
  std::optional<double> irradiance_relative = {};  ///< standard error / irradiance, every instant
};

/// Of the leaf area (with irradiance: of that of all suns) whose value is at least
/// `share_that_counts` of the largest, `share_to_be_met` shall meet the goal
/// (docs/developer/design.md, Study).
inline constexpr double share_that_counts = 0.01, share_to_be_met = 0.95;

/// Over all realizations together.
struct SampleCounts {
  /// Of patches unless `lines_of_patch` has them, and of sensors: then the least of the doubled
  /// counts that is no less than the mean of patches.
  int lines_per_patch = 0;
  int direct_samples = 0;
  /// Of the first shot, in the mean of patches. With a power per sample of its own this is what
  /// `lines_per_patch` stands for, and the power falls as the count rises.
  int samples_per_patch = 0;
  double share = 0;  ///< of the area that counts, where the goals will be met
  std::vector<int> lines_of_patch = {};

  int lines_of(std::size_t patch) const {
    return lines_of_patch.empty() ? lines_per_patch : lines_of_patch[patch];
  }
  /// Mean over patches.
  double mean_lines() const;
};

/// Area of all instants together [m2]: that counts, and of it that where the errors of the series
/// (Errors::instants) are no more than `irradiance_relative` of it.
struct KeptArea {
  double counts = 0, kept = 0;
};
/// `area`: [receiver], m2. Sums over the intervals of the tally, whose series of totals and of
/// their errors must have been kept.
KeptArea kept_area(const ReceiverTally& tally, const std::vector<double>& area,
                   double irradiance_relative);

/// The rules with these counts; `least` are those that the counts were chosen for.
SolverRules with_counts(const SolverRules& least, const SampleCounts& counts);

/// Share of the area that counts where √(a/L + b/D + c/S) ≤ goal · value, the smaller of those of
/// the goals; 1 where nothing counts.
double share_met(const PatchSpread& spread, const AccuracyGoal& goal, const SampleCounts& counts);

/// The cheapest counts that meet the goals on `share_to_be_met` of the area that counts: lines for
/// every patch, where what else it receives by samples leaves room, or until lines are no more of
/// its error than those; samples for all. From the counts of `least` on, doubled, at most
/// `most_per_patch`; where none do, the cheapest that come within 10 % of the errors of the most.
/// `suns`: of the whole period. Depends on nothing else.
SampleCounts needed_counts(const PatchSpread& spread, const SolverRules& least,
                           const AccuracyGoal& goal, std::size_t suns);

}  // namespace sunload
