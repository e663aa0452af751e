// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/accuracy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "solver/base/cost.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// Only ratios matter.
struct Cost {
  double per_line, per_direct_sample, per_shot_sample;
  double of(const SampleCounts& counts) const {
    return counts.mean_lines() * per_line + counts.direct_samples * per_direct_sample +
           counts.samples_per_patch * per_shot_sample;
  }
};

Cost cost_of(const PatchSpread& spread, const SolverRules& rules, double suns) {
  const double samples = cost::facing_share * suns * cost::s_per_direct_ray;
  if (spread.load.of_shot.empty())
    return {cost::s_per_line_of_street + rules.bounces * suns * cost::s_per_link_sun, samples, 0};
  const double blocks = std::ceil(suns / static_cast<double>(block_width));
  return {cost::s_per_line_of_street, samples,
          blocks * spread.shots_per_block * cost::s_per_sample};
}

/// A quantity of the patches and how exact it shall be.
struct Wanted {
  const Spread& spread;
  double relative;
  double least_value;  ///< that counts

  Wanted(const Spread& of, double goal)
      : spread(of),
        relative(goal),
        least_value(of.value.empty()
                        ? 0
                        : share_that_counts * *std::max_element(of.value.begin(), of.value.end())) {
  }
  bool counts(std::size_t i) const { return spread.value[i] > 0 && spread.value[i] >= least_value; }
  double largest_variance(std::size_t i) const {
    const double error = relative * spread.value[i];
    return error * error;
  }
  double by_samples(std::size_t i, const SampleCounts& by) const {
    return spread.of_sample[i] / by.direct_samples +
           (spread.of_shot.empty() ? 0 : spread.of_shot[i] / by.samples_per_patch);
  }
  bool is_met(std::size_t i, const SampleCounts& by) const {
    return spread.of_line[i] / by.lines_of(i) + by_samples(i, by) <= largest_variance(i);
  }
  /// Where samples leave too little room for `most` lines, lines shall be no more of the error
  /// than they are.
  double needed_lines(std::size_t i, const SampleCounts& by, int most) const {
    const double samples = by_samples(i, by), room = largest_variance(i) - samples;
    const bool is_enough = room > 0 && spread.of_line[i] <= most * room;
    return spread.of_line[i] / (is_enough ? room : std::max(room, samples));
  }
};

/// Area of one quantity, or of that of several suns, that counts, and where it meets its goal.
struct Share {
  double counts = 0, met = 0;
  void add(const PatchSpread& spread, const Wanted& wanted, const SampleCounts& by) {
    for (std::size_t i = 0; i < spread.area.size(); ++i) {
      if (!wanted.counts(i)) continue;
      counts += spread.area[i];
      if (wanted.is_met(i, by)) met += spread.area[i];
    }
  }
  double value() const { return counts > 0 ? met / counts : 1; }
};

std::vector<Wanted> wanted_loads(const PatchSpread& spread, const AccuracyGoal& goal) {
  if (!goal.light_load_relative) return {};
  return {Wanted(spread.load, *goal.light_load_relative)};
}

std::vector<Wanted> wanted_irradiances(const PatchSpread& spread, const AccuracyGoal& goal) {
  std::vector<Wanted> wanted;
  if (goal.irradiance_relative)
    for (const Spread& of_sun : spread.irradiance)
      wanted.emplace_back(of_sun, *goal.irradiance_relative);
  return wanted;
}

double share_of(const PatchSpread& spread, const std::vector<Wanted>& wanted,
                const SampleCounts& by) {
  Share share;
  for (const Wanted& quantity : wanted) share.add(spread, quantity, by);
  return share.value();
}

/// The smallest goal of one kind that is met on `share_to_be_met` of the area that counts, to 1 %.
template <class GoalOf>
double reachable(const PatchSpread& spread, const SampleCounts& counts, const GoalOf& goal_of) {
  constexpr double step = 1.01, finest = 1e-6, coarsest = 1e6;
  double low = finest, high = coarsest;
  while (high > step * low) {
    const double middle = std::sqrt(low * high);
    (share_met(spread, goal_of(middle), counts) >= share_to_be_met ? high : low) = middle;
  }
  return high;
}

/// What can be aimed at with `most`: the goal, or where it is out of reach errors nearly as small
/// as the most can make them.
AccuracyGoal within_reach(const PatchSpread& spread, AccuracyGoal goal, const SampleCounts& most) {
  constexpr double nearly = 1.1;
  const auto mend = [&](std::optional<double> AccuracyGoal::*kind) {
    const auto goal_of = [&](double relative) {
      AccuracyGoal alone;
      alone.*kind = relative;
      return alone;
    };
    if (goal.*kind && share_met(spread, goal_of(*(goal.*kind)), most) < share_to_be_met)
      goal.*kind = nearly * reachable(spread, most, goal_of);
  };
  mend(&AccuracyGoal::light_load_relative);
  mend(&AccuracyGoal::irradiance_relative);
  return goal;
}

/// The errors that the result states are known to one part in √(2(R − 1)); 19 of 20 of those that
/// are just small enough shall be stated so (normal distribution, one side).
AccuracyGoal with_room(AccuracyGoal goal, int realizations) {
  constexpr double one_in_20 = 1.645;
  const double noise = one_in_20 / std::sqrt(2.0 * (realizations - 1));
  if (goal.light_load_relative) *goal.light_load_relative /= 1 + noise;
  if (goal.irradiance_relative) *goal.irradiance_relative /= 1 + noise;
  return goal;
}

/// A pilot's variances are noisy, and the cheapest counts that seem to do are chosen by them: what
/// seems to be met is so on up to 2 % less of the area (a square with a house of glass, goals of 3
/// … 10 % at every instant).
constexpr double share_aimed_at = share_to_be_met + 0.02;

/// least, 2·least, … and at last the most that all realizations can share.
std::vector<int> doubled(int least, int most, int realizations) {
  most = std::max(least, most / realizations * realizations);
  std::vector<int> counts;
  for (int count = least; count<most; count = count> most / 2 ? most : 2 * count)
    counts.push_back(count);
  counts.push_back(most);
  return counts;
}

/// Gives every patch the least of `levels` that it needs beside these samples.
void choose_lines(const PatchSpread& spread, const AccuracyGoal& goal,
                  const std::vector<int>& levels, SampleCounts& counts) {
  const std::vector<Wanted> of_kinds[] = {wanted_loads(spread, goal),
                                          wanted_irradiances(spread, goal)};
  constexpr std::size_t patches_per_task = 4096;
  counts.lines_of_patch.assign(spread.area.size(), levels.front());
  parallel_for(
      spread.area.size(),
      [&](std::size_t i) {
        double needed = 0;
        for (const auto& kind : of_kinds)
          for (const Wanted& quantity : kind)
            if (quantity.counts(i))
              needed = std::max(needed, quantity.needed_lines(i, counts, levels.back()));
        const auto level = std::lower_bound(levels.begin(), levels.end(), needed);
        counts.lines_of_patch[i] = level == levels.end() ? levels.back() : *level;
      },
      patches_per_task);
  const double mean = counts.mean_lines();
  counts.lines_per_patch = *std::lower_bound(levels.begin(), levels.end(), mean);
}

}  // namespace

double SampleCounts::mean_lines() const {
  if (lines_of_patch.empty()) return lines_per_patch;
  const auto sum = std::accumulate(lines_of_patch.begin(), lines_of_patch.end(), 0.0);
  return sum / static_cast<double>(lines_of_patch.size());
}

double share_met(const PatchSpread& spread, const AccuracyGoal& goal, const SampleCounts& counts) {
  return std::min(share_of(spread, wanted_loads(spread, goal), counts),
                  share_of(spread, wanted_irradiances(spread, goal), counts));
}

SampleCounts needed_counts(const PatchSpread& spread, const SolverRules& least,
                           const AccuracyGoal& goal, std::size_t suns) {
  const auto lines = doubled(least.lines_per_patch, goal.most_per_patch, least.realizations);
  const auto samples = doubled(least.direct_samples, goal.most_per_patch, least.realizations);
  const auto shots = spread.load.of_shot.empty() ? std::vector{least.lines_per_patch} : lines;
  const SampleCounts most{lines.back(), samples.back(), shots.back()};
  const AccuracyGoal stated = with_room(goal, least.realizations);
  const AccuracyGoal aim = within_reach(spread, stated, most);
  const Cost cost = cost_of(spread, least, static_cast<double>(suns));
  const auto with_lines = [&](int D, int S) {
    SampleCounts counts{lines.front(), D, S};
    choose_lines(spread, aim, lines, counts);
    counts.share = share_met(spread, aim, counts);
    return counts;
  };
  SampleCounts chosen = with_lines(most.direct_samples, most.samples_per_patch);
  const double wanted = std::min(share_aimed_at, chosen.share);
  for (const int D : samples) {
    const auto enough = std::partition_point(
        shots.begin(), shots.end(), [&](int S) { return with_lines(D, S).share < wanted; });
    if (enough == shots.end()) continue;
    // More samples of one kind may save more lines than they cost.
    for (auto S = enough; S != shots.end(); ++S)
      if (auto counts = with_lines(D, *S); cost.of(counts) < cost.of(chosen))
        chosen = std::move(counts);
  }
  chosen.share = share_met(spread, goal, chosen);
  return chosen;
}

KeptArea kept_area(const ReceiverTally& tally, const std::vector<double>& area,
                   double irradiance_relative) {
  const auto& irradiance = tally.irradiance[static_cast<std::size_t>(Part::total)];
  KeptArea sum;
  const std::size_t patches = area.size();
  for (std::size_t begin = 0; begin < irradiance.size(); begin += patches) {
    const auto of_sun = std::span(irradiance).subspan(begin, patches);
    const double least_value = share_that_counts * static_cast<double>(std::ranges::max(of_sun));
    for (std::size_t i = 0; i < patches; ++i) {
      const auto value = static_cast<double>(of_sun[i]);
      if (value <= 0 || value < least_value) continue;
      sum.counts += area[i];
      const auto error = static_cast<double>(tally.irradiance_se[begin + i]);
      if (error <= irradiance_relative * value) sum.kept += area[i];
    }
  }
  return sum;
}

SolverRules with_counts(const SolverRules& least, const SampleCounts& counts) {
  SolverRules rules = least;
  rules.lines_per_patch = counts.lines_per_patch;
  rules.lines_of_patch = counts.lines_of_patch;
  rules.direct_samples = counts.direct_samples;
  if (least.transport != Transport::shoot) return rules;
  rules.samples_per_patch = counts.samples_per_patch;
  if (rules.power_per_sample_w)
    *rules.power_per_sample_w *=
        static_cast<double>(least.lines_per_patch) / counts.samples_per_patch;
  return rules;
}

}  // namespace sunload
