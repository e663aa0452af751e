// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Points that are meant to be one become one.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// Distinct points, and which of them each given point became.
struct Welded {
  std::vector<Vec3> vertices;           ///< distinct points, in the order of their first use
  std::vector<std::int32_t> new_index;  ///< of each given point; -1 where it is not used
  std::size_t merged = 0;               ///< used points that fell on another one
};

/// Merges each used point into the nearest earlier representative within
/// `tolerance` (0: equal coordinates only; -0 equals 0). Representatives never
/// move and chains do not grow: every point stays within `tolerance` of its
/// new position. Expected time O(n).
Welded weld(const std::vector<Vec3>& points, const std::vector<std::uint8_t>& is_used,
            double tolerance);

}  // namespace sunload
