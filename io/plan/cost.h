// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What work costs beyond what the solver itself decides by (solver/base/cost.h): the place of all
/// other measured constants of time, memory and disk.
///
/// Times are those of one core [s], sizes are bytes, both fitted by scripts/scaling.py to the
/// built-in street with 20 000 … 260 000 patches (AVX-512): docs/scaling.md, which a test compares
/// with these. Estimates are made of them.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/base/cost.h"

namespace sunload::cost {

// Start, and what every patch takes.
inline constexpr double s_to_start = 0.1;
inline constexpr double s_per_patch = 2e-7;

// Lines.
inline constexpr double s_per_line = 1.0e-7;   ///< through an empty scene …
inline constexpr double s_per_level = 8.3e-9;  ///< … and more for each doubling of its triangles
/// A ray of a line through so many input triangles: from a box on a plane to a city.
inline double s_per_line_ray(double triangles) {
  return s_per_line + s_per_level * std::log2(triangles);
}
inline constexpr double share_that_meets = 0.6;  ///< of the lines; the others leave the scene
/// Where surfaces emit, a line has a point on a bright surface beside it …
inline constexpr double rays_by_guide = 1;
/// … and every patch has its part in finding out which of them it sees (solver/gather/guide.cpp).
inline constexpr double s_per_guided_patch = 2.1e-4;

// The sun: what share of a patch sees it, by geometry; rays where that does not tell, and to the
// bright sky about it.
inline constexpr double s_per_lit_share = 4.0e-7;
/// Of one of many suns between the points of a grid, relative to that.
inline constexpr double cost_of_interpolation = 0.045;
inline constexpr double s_per_circumsolar_ray = 1.0e-7;
/// Of these rays, where suns share them: of one in the place of another, and from where on each has
/// its own.
inline constexpr double rays_in_one_place = 0.2, degrees_to_share_rays = 18;
/// Of patches that a sun stands before: that edges of shadows cross, and that are behind screens.
inline constexpr double share_at_edges = 0.15, share_behind_screens = 0.1;
inline constexpr double s_per_luminaire_ray = 1.0e-7;
inline constexpr double luminaires_seen = 0.5;  ///< of a patch: before it, and sending towards it
inline constexpr double mirrored_share = 0.11;  ///< of them again, where there are mirrors
inline constexpr double s_per_mirrored_share = 1.4e-6;
inline constexpr double s_per_mirror_ray = 1.3e-7;  ///< in place of that, of a sun with a disk

// The light's way on.
inline constexpr double s_per_link_batch = 6.6e-10;  ///< one link of one batch's realizations
inline constexpr double s_per_patch_sun = 2.5e-7;
/// Where few solutions serve a period: skies and suns for each part of the sky that its suns pass,
/// a square of so many degrees (a year of Gothenburg passes 151), at least so many (what weeks
/// take), and what else is solved to test them; and one patch of one interval that is made up of
/// them.
inline constexpr double year_square_deg = 7.5, skies_per_square = 1.2, suns_per_square = 1,
                        fewest_skies = 48, fewest_suns = 32, solved_for_tests = 80;
inline constexpr double s_per_patch_interval_of_year = 1.2e-7;
/// Of the bytes of a float: what a node brings, by lines or one realization's samples of the sky
/// about its sun (solver/light/packed_columns.h).
inline constexpr double packed_share = 36.0 / 64;
/// One patch of one sun in a realization's own solution, where errors per instant are asked for.
inline constexpr double s_per_patch_sun_realization = 6e-8;
/// One patch of one batch in a realization's time sums: made, compressed, written, read again.
inline constexpr double s_per_patch_batch_realization = 2e-7;
inline constexpr double s_per_sun = 4.2e-4;  ///< in a scene of any size: its sky, cell by cell
/// The sky of each interval but one of those that are solved together.
inline constexpr double s_per_sky_of_part = 1.7e-4;
inline constexpr double s_per_value = 1.2e-8;  ///< one patch of one interval, stored
/// The same of each series beyond the first, of intervals that are computed (Rotterdam, six weeks).
inline constexpr double s_per_further_value = 6e-8;
inline constexpr double s_per_byte_of_sums = 3e-9;  ///< in batches: written, read, added up

// The mesh pilot: for every element that it ever looks at, 16 points look along its suns; four look
// along 16 other directions, which costs what 8 of all points do.
inline constexpr double elements_per_leaf = 1.5, points_per_element = 16;
inline constexpr double other_directions = 8;

// The matrix of a small scene: one form factor, and its share in a realization's factorisation.
inline constexpr double s_per_form_factor = 1.5e-6, s_per_factor_solved = 3e-10;

// Memory.
inline constexpr double double_bytes = 8, float_bytes = 4;
inline constexpr double program_bytes = 6.7e7, bytes_per_line = 6.4, bytes_per_patch = 1400;
inline constexpr double bytes_per_interval = 500;
/// Of each season after the first, beside its lines: a scene of its own (Delft, 2 seasons).
inline constexpr double season_bytes_per_patch = 680, season_bytes_per_triangle = 240;
inline constexpr double bytes_per_form_factor = 12;       ///< of one realization: it and its link
inline constexpr double bytes_per_factor_solved = 40;     ///< of one thread
inline constexpr double bytes_per_sample = 40;            ///< of one realization and iteration
inline constexpr double shooting_bytes_per_patch = 2700;  ///< columns in double
inline constexpr double columns_of_a_realization = 8;     ///< direct sun, in doubles
inline constexpr double arrays_of_realizations = 4;       ///< doubles of a patch and realization

// Disk.
inline constexpr double stored_bytes_per_value = 3.2;
inline constexpr double batch_bytes_per_patch = 88, bytes_per_batch = 1e4;
/// Of the result: geometry, what it has once and of each kind of light, and measures with their
/// times; names, text and tables; sun, sky and ledger of an interval, in batches and result.
inline constexpr double geometry_bytes_per_patch = 110, result_bytes_per_patch = 48,
                        result_bytes_per_kind = 16, bytes_per_measure = 24,
                        bytes_per_result = 1.3e5, stored_bytes_per_interval = 300;
/// The prepared file, of each realization and of all together: beginnings of links and ends of
/// lines, what emitters send, and of cells of the sky the fate of what surfaces send on.
inline constexpr double kept_bytes_per_patch = 44, kept_bytes_per_lit_patch = 8,
                        kept_bytes_per_cell = 40;
inline constexpr double kept_bytes_per_factor = 8;  ///< of each two patches, by matrix
/// Links, in their realization and in all lines together. The more lines a patch has, the more of
/// them end where others do (streets and a square, 16 … 1024 lines; nowhere more).
inline double kept_bytes_per_line(double lines_per_patch) {
  constexpr double of_one = 9.3, less_for_twice = 0.3, least = 4;
  return std::max(least, of_one - less_for_twice * std::log2(std::max(lines_per_patch, 1.0)));
}
/// Links that have weights of their own: of what is sent on, and by points on bright surfaces.
inline constexpr double kept_bytes_per_weighted_link = 16, kept_bytes_per_guided_line = 11;
/// Where a line met a glossy surface.
inline constexpr double kept_bytes_per_glimpse = 48;

}  // namespace sunload::cost
