// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How long this machine takes for a little of a variant's own work.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "io/plan/variant_plan.h"
#include "io/plan/work_estimate.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

/// Traces a few lines per patch, solves some suns of the period on them, and compares the time with
/// what the cost model says of the same. Takes a fraction of a second, and some seconds with a
/// million patches; memory as a run of few lines. Nothing where no interval has light. What else
/// runs on the machine counts, too. Throws Interrupted.
std::optional<WorkPace> measured_pace(const VariantPlan& plan,
                                      const std::shared_ptr<const Hierarchy>& mesh);

/// The intervals that it solves: no more than `most`, but at least one. Groups of neighbours are
/// taken from low suns to high ones, since costs differ most by the height of the sun; neighbours
/// in the order of a run, since together they cost less than each by itself. None where no interval
/// has light.
std::vector<std::size_t> tried_intervals(const VariantPlan& plan, double most);

/// Paces of a study's variants, which may be thousands: measured once for variants with mirrors and
/// once for variants without. The others have the same scene, or one much like it.
class StudyPaces {
 public:
  /// 1 where there is nothing to measure. Throws Interrupted.
  WorkPace of(const VariantPlan& plan, const std::shared_ptr<const Hierarchy>& mesh);

 private:
  std::optional<WorkPace> with_mirrors_, without_;
};

}  // namespace sunload
