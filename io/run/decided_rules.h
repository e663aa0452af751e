// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The solver's rules of a variant, as they are before its first line is cast.
#pragma once

#include <memory>

#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "io/run/progress.h"
#include "solver/accuracy.h"

namespace sunload {

/// The study's rules, with counts raised by a pilot where it asks for an accuracy; what the pilot
/// expects is told. Every process of a study comes to the same counts. Throws MachineError where
/// the pilot, or what it chose, takes more memory than there is, and Interrupted.
SolverRules decided_rules(const VariantPlan& plan, const std::shared_ptr<const Hierarchy>& mesh,
                          Progress& progress);

}  // namespace sunload
