// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What error a study's counts of samples and its mesh let expect, before anything is computed.
#pragma once

#include <string>
#include <vector>

#include "io/plan/variant_plan.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

/// One line for every count that is too small for its patches, with the error to expect and the
/// count that would do; empty where all is well. Rules of thumb:
///
/// - sky and reflected light of a patch by n lines: 0.6 / √n (median over a street's patches under
///   a clear sky, where 256 lines leave 3 … 5 %);
/// - the sun on a patch that a shadow's edge crosses by n samples: at most 0.5 / √n;
/// - reflected light when shooting N samples over the area A on a patch of area a: √(A / (N a)),
///   the variance of equation 13 of docs/developer/method.md, Shooting, with a reflectance of 1.
///
/// And where rays start far off their surfaces, and where mesh.min_area_m2 keeps patches above
/// mesh.max_edge_m.
std::vector<std::string> expected_error_warnings(const VariantPlan& plan, const Hierarchy& mesh);

}  // namespace sunload
