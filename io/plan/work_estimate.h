// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Work, memory, disk and time of a variant, estimated before it starts (docs/scaling.md).
#pragma once

#include <cstdint>
#include <utility>

#include "io/plan/variant_plan.h"
#include "solver/accuracy.h"

namespace sunload {

struct WorkEstimate {
  std::size_t patches = 0;
  std::uint64_t line_rays = 0, direct_rays = 0;
  std::uint64_t samples = 0;  ///< that are shot
  double memory_bytes = 0, disk_bytes = 0, seconds = 0;
};
/// With the study's own counts, and the mesh of so many patches.
WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches);
/// The same with other counts.
WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches,
                           const SampleCounts& counts);

/// Between which times refining the mesh of so many patches takes [s]: how many it makes, the light
/// decides.
std::pair<double, double> refinement_seconds(const VariantPlan& plan, std::size_t patches);

/// Memory of the accuracy pilot.
double accuracy_pilot_memory_bytes(const VariantPlan& plan, std::size_t patches);

}  // namespace sunload
