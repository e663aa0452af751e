/// Radiosity of elements above the leaves: sums go up the trees (METHOD 4; Bekaert 1999, 4.3).
#pragma once

#include <vector>

#include "solver/hierarchy.h"
#include "solver/sun_block.h"

namespace sunload {

/// Extends a column of patches to all elements: inner ones get the mean of their two halves, which
/// have equal areas. Does nothing to what has room for patches only.
void pull_up(const Hierarchy& mesh, Columns& radiosity);
void pull_up(const Hierarchy& mesh, std::vector<double>& radiosity);

}  // namespace sunload
