// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The rules of splitting, refining and solving that a study asks for.
#pragma once

#include <string>

#include "io/plan/variant_plan.h"
#include "solver/accuracy.h"
#include "solver/mesh/refine.h"
#include "solver/solver.h"

namespace sunload {

SplitRules split_rules(const Study& study);
RefineRules refine_rules(const Study& study);
/// Whether the study stores the series of that part of the irradiance.
bool stores_series(const OutputStudy& output, Part part);
/// Whether a measure asks for every interval of that series.
bool is_watched(const Study& study, Part part);
/// Parts of the irradiance of which a batch holds the series: those of the study, and the total.
std::array<bool, part_count> kept_series(const OutputStudy& output);
/// With the study's own counts, which `accuracy` makes the least ones.
SolverRules solver_rules(const VariantPlan& plan);
/// The study's goal; only of a study that has one.
AccuracyGoal accuracy_goal(const Study& study);
/// "1 %", "5 % at every instant" or both.
std::string goal_words(const AccuracyStudy& accuracy);

}  // namespace sunload
