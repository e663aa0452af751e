// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Memory that a variant takes at most, estimated before it starts (docs/scaling.md).
#pragma once

#include "io/plan/variant_plan.h"
#include "io/plan/workload.h"

namespace sunload {

/// Of the whole run.
double memory_bytes(const Workload& work, const ShotSamples& samples);

/// Of the accuracy pilot, which comes before it.
double accuracy_pilot_memory_bytes(const VariantPlan& plan, std::size_t patches);

}  // namespace sunload
