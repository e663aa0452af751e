// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What of a result is known before any light: patches, tables, times.
#pragma once

#include "io/plan/variant_plan.h"
#include "io/result/writer.h"

namespace sunload {

class Hierarchy;

/// Geometry of the result: the frozen mesh with its tables.
ResultGeometry result_geometry(const VariantPlan& plan, const Hierarchy& hierarchy);
/// Its rows; with illuminances where the study asks for them.
ResultTimes result_times(const VariantPlan& plan);

}  // namespace sunload
