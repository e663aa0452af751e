// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/decided_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/base/machine.h"
#include "io/plan/interval_lights.h"
#include "io/plan/room.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/work_estimate.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// What the pilot decided.
std::string counts_text(const VariantPlan& plan, const SampleCounts& counts) {
  const SolverRules rules = with_counts(solver_rules(plan), counts);
  std::string shot;
  if (rules.power_per_sample_w)
    shot = fmt::format(", shots of {:.3g} W per sample", *rules.power_per_sample_w);
  else if (rules.samples_per_patch)
    shot = fmt::format(", {} samples per patch in the first shot", *rules.samples_per_patch);
  const auto [fewest, most] =
      std::minmax_element(counts.lines_of_patch.begin(), counts.lines_of_patch.end());
  const std::string lines =
      fewest == most || *fewest == *most
          ? fmt::format("{}", counts.lines_per_patch)
          : fmt::format("{} to {} (mean {:.0f})", *fewest, *most, counts.mean_lines());
  std::string text = fmt::format(
      "{}: accuracy of {}: {} lines and {} direct samples per patch{}, by which a pilot "
      "expects it on {:.3g} % of the area",
      plan.study.variant, goal_words(*plan.study.solver.accuracy), lines, counts.direct_samples,
      shot, 100 * counts.share);
  if (counts.share < share_to_be_met)
    text += fmt::format("; {} lines and samples at most cannot give more (max_lines_per_patch)",
                        plan.study.solver.max_lines_per_patch);
  // Errors of what lamps bring fall faster with more lines than by the pilot's law.
  if (counts.share < share_to_be_met && has_lamps(plan))
    text +=
        "; of lamps it expects too large errors: lines_per_patch as large as that, without "
        "accuracy, may reach it";
  return text;
}

/// The pilot, or counts that it chose, may need more than the least counts that `check` knows.
void refuse_too_much(double memory_bytes) {
  if (const double left = available_memory_bytes(); memory_bytes > left)
    throw MachineError(
        fmt::format("too little memory for the accuracy asked for: about {} are needed, {} are "
                    "available; use a smaller max_lines_per_patch or a larger error in accuracy",
                    bytes_text(memory_bytes), bytes_text(left)));
}

std::vector<std::size_t> intervals_with_light(const VariantPlan& plan) {
  const bool lamps = has_lamps(plan);
  std::vector<std::size_t> lit;
  for (std::size_t k = 0; k < plan.intervals(); ++k)
    if (lamps || !is_dark(plan.light.intervals[k])) lit.push_back(k);
  return lit;
}

/// `places`: in `lit`.
std::vector<IntervalLight> lights_of(const VariantPlan& plan, const std::vector<std::size_t>& lit,
                                     const std::vector<std::size_t>& places) {
  const SkyGrid grid;
  const IntervalLights lights(plan.study, plan.built.site, grid);
  std::vector<IntervalLight> suns(places.size());
  parallel_for(suns.size(), [&](std::size_t p) {
    const std::size_t k = lit[places[p]];
    suns[p] = lights.of(plan.light.intervals[k], k);
  });
  return suns;
}

}  // namespace

SolverRules decided_rules(const VariantPlan& plan, const std::shared_ptr<const Hierarchy>& mesh,
                          Progress& progress) {
  SolverRules rules = solver_rules(plan);
  if (!plan.study.solver.accuracy) return rules;
  if (const auto problem = accuracy_pilot_problem(plan, mesh->patch_count()); !problem.empty())
    throw MachineError(problem);
  const auto lit = intervals_with_light(plan);
  const AccuracyPilotSuns choice = accuracy_pilot_suns(lit.size());
  const AccuracyGoal goal = accuracy_goal(plan.study);
  const PatchSpread spread = accuracy_pilot_spread(
      plan.built.scene, mesh, rules, lights_of(plan, lit, choice.places),
      {choice.weight, plan.batch_suns(), goal.irradiance_relative.has_value()}, progress);
  const SampleCounts counts = needed_counts(spread, rules, goal, lit.size());
  refuse_too_much(estimate_work(plan, spread.area.size(), counts).memory_bytes);
  progress.say(counts_text(plan, counts));
  return with_counts(rules, counts);
}

}  // namespace sunload
