// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What work costs, as far as the solver decides by it: by these counts for an accuracy are chosen,
/// in whatever scene, and other values would choose others, which changes results.
///
/// Times are those of one core [s], fitted by scripts/scaling.py to the built-in street (AVX-512):
/// docs/scaling.md, which a test compares with these. All other costs: io/plan/cost.h.
#pragma once

namespace sunload::cost {

inline constexpr double s_per_line_of_street = 2.3e-7;  ///< on the street, whatever the scene
inline constexpr double facing_share = 0.62;            ///< of patches, that a sun stands before
inline constexpr double s_per_direct_ray = 3.5e-8;
inline constexpr double s_per_link_sun = 2.0e-10;  ///< one link of one sun and one bounce
inline constexpr double s_per_sample = 6e-7;       ///< shot, with its deposit

/// What points of a grid of suns may take [bytes].
inline constexpr double most_bytes_of_share_grid = 1 << 30;

}  // namespace sunload::cost
