// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a result that is known before any light: patches, tables, times.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "io/plan/variant_plan.h"
#include "io/result/writer.h"

namespace sunload {

class Hierarchy;

/// Geometry of the result: the frozen mesh with its tables.
ResultGeometry result_geometry(const VariantPlan& plan, const Hierarchy& hierarchy);
/// Whether reflectances and emissions below are those of all seasons.
bool sends_alike_in_all_seasons(const VariantPlan& plan);
/// Diffuse reflectance of every patch, in that band or of all light; in the first season.
std::vector<double> diffuse_reflectances(const VariantPlan& plan, const Hierarchy& hierarchy,
                                         std::optional<std::size_t> band);
/// What every patch emits [W m-2], which is the same in all bands; in the first season.
std::vector<double> emitted_exitances(const VariantPlan& plan, const Hierarchy& hierarchy);
/// Rows of the result in time; with illuminances where the study asks for them.
ResultTimes result_times(const VariantPlan& plan);

}  // namespace sunload
