// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Work, memory, disk and time of a variant, estimated before it starts (docs/scaling.md): what
/// io/plan/workload counts, and what that takes.
#pragma once

#include <cstdint>
#include <utility>

#include "io/plan/variant_plan.h"
#include "solver/accuracy.h"

namespace sunload {

/// Time that a machine takes, as a multiple of what the cost model says (io/plan/cost.h), by
/// kind of work.
struct WorkPace {
  double lines = 1, direct = 1, mirror = 1, solve = 1, sensors = 1;
  /// Of the time for mirrors the share that goes to rays, of which each sample of a sun has some:
  /// light that goes from mirror to mirror; and the samples with which that was measured.
  double rays_of_mirrors = 0;
  int direct_samples = 0;
  bool is_measured = false;  ///< io/plan/work_probe.h
  /// What mirrors take with so many samples.
  double mirror_with(int samples) const {
    if (direct_samples <= 0) return mirror;
    return mirror * (1 + rays_of_mirrors * (static_cast<double>(samples) / direct_samples - 1));
  }
};

/// What a variant will cost.
struct WorkEstimate {
  std::size_t patches = 0;
  std::uint64_t line_rays = 0, direct_rays = 0;
  std::uint64_t samples = 0;  ///< that are shot
  double memory_bytes = 0, disk_bytes = 0, seconds = 0;
  bool is_of_this_machine = false;  ///< the time
};
/// With the study's own counts, and the mesh of so many patches.
WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches, const WorkPace& pace = {});
/// The same with other counts.
WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches, const SampleCounts& counts,
                           const WorkPace& pace = {});

/// One block of suns, each interval solved by gathering, on few lines.
struct BlockCounts {
  int lines_per_patch = 0, direct_samples = 0;
  double suns = 0;  ///< that shine, all those that stand for one interval counted
};
/// Seconds by those stages that `WorkDone` has times of: of patches, and all that sensors take.
struct WorkSeconds {
  double lines = 0, direct = 0, mirror = 0, solve = 0, sensors = 0;
};
/// What the cost model says of one block of the plan, on the threads that are used.
WorkSeconds modelled_seconds(const VariantPlan& plan, std::size_t patches,
                             const BlockCounts& counts);

/// Least and most time that refining a mesh of so many patches takes [s]; the light decides how
/// many patches it makes.
std::pair<double, double> refinement_seconds(const VariantPlan& plan, std::size_t patches);

}  // namespace sunload
