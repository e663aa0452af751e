// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of elements above the leaves: radiosity goes up the trees, irradiance down (Hanrahan,
/// Salzman & Aupperle 1991; docs/developer/method.md, Mesh).
#pragma once

#include <vector>

#include "solver/light/sun_block.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

/// Extends a column of patches to all elements: inner ones get the mean of their two halves, which
/// have equal areas. Does nothing to what has room for patches only.
void pull_up(const Hierarchy& mesh, Columns& radiosity);
void pull_up(const Hierarchy& mesh, std::vector<double>& radiosity);

/// Gives what inner elements receive to all of their patches, which alone are left. Does nothing
/// to a column of patches only.
void push_down(const Hierarchy& mesh, DoubleColumns& irradiance);

}  // namespace sunload
