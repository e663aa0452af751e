// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A study from its text, planned, meshed and solved without files of results.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/plan/variant_mesh.h"
#include "solver/light/sun_block.h"
#include "solver/light/tally.h"
#include "solver/transport/light_transport.h"

namespace sunload::test {

/// Plan of the study's first variant. Throws what the reader throws.
VariantPlan plan_of(const std::string& yaml);

/// A built-in scene lit by its own emitters alone; `sections` are further lines of the study.
std::string night_study(const std::string& builtin, const std::string& sections);

/// All intervals of a plan as the solver takes them.
std::vector<IntervalLight> suns_of(const VariantPlan& plan, const SkyGrid& grid);

struct SolvedPlan {
  VariantPlan plan;
  VariantMesh made;
  BatchTally tally;
  std::optional<Reduction> reduction;  ///< where few solutions served the period

  const Hierarchy& mesh() const { return *made.mesh; }
  /// Object of a patch, by name.
  const std::string& object(std::size_t patch) const;
  /// Light load of a patch per realization [J m-2].
  std::vector<double> load(std::size_t patch) const;
};
SolvedPlan solve_study(const std::string& yaml);

}  // namespace sunload::test
