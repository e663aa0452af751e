// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "geo/mesh/delaunay.h"

namespace sunload {

/// Where edges of closed rings, of one or of two of them, cross between their ends; nothing where
/// none do. Rings that touch do not cross. Cost: corners times edges above the same x, which for
/// outlines with many corners are few.
std::optional<Point2> ring_crossing(const std::vector<std::vector<Point2>>& rings);

}  // namespace sunload
