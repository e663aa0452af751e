// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a study decides of the solution: counts, bounces, transport.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/light/band.h"
#include "solver/light/sun_block.h"
#include "solver/light/tally.h"
#include "solver/light/transport.h"

namespace sunload {

/// Counts are shared equally by the realizations: multiples of their number.
struct SolverRules {
  /// Light reflected diffusely 1 … bounces times is followed; 0 … 2047.
  int bounces = 5;
  /// Fewer bounces (and mirrors of the sun) where less than this share is left; 0 or more.
  double unshot = 1e-4;
  /// Whether the light that bounces do not follow is estimated and added (Unfollowed).
  Unfollowed unfollowed = Unfollowed::estimate;
  int lines_per_patch = 256;             ///< over all realizations, 1 or more of each
  std::vector<int> lines_of_patch = {};  ///< if they differ; sensors have lines_per_patch
  int direct_samples = 16;    ///< per patch and sun, over all realizations, 1 or more of each
  int realizations = 8;       ///< 1 or more; 2 for standard errors
  int mirror_depth = 8;       ///< reflections of a chain of mirrors, 0 … most_reflections
  double faint_glint = 0.02;  ///< share of the sun below which light reflected again is no beam
  int most_sun_beams = 128;   ///< sequences of mirror orientations per sun that are beams
  /// On sensors no chains of mirrors end: beams go on to `unshot` of the sun where no more than so
  /// many sequences are there.
  int most_faint_beams = 512;
  /// Where no beams stand, sensors get the first reflection by mirrors; from a sun that more than
  /// so many orientations face they get none.
  int most_sensor_beams = 1 << 16;
  /// A link leads to an element above the leaves where no more than so many of a
  /// patch's lines can be expected to meet it; 0: to leaves only.
  double link_threshold = 0;
  std::uint64_t seed = 1;
  std::string isa = "auto";
  Errors errors = Errors::totals;
  Bands bands = Bands::broadband;  ///< rgb when gathering only
  Transport transport = Transport::gather;
  Year year = Year::each;                    ///< when gathering
  Jacobi jacobi = Jacobi::incremental;       ///< when shooting
  std::optional<double> power_per_sample_w;  ///< when shooting, ShootingRules; above 0
  std::optional<int> samples_per_patch;      ///< when shooting, ShootingRules; 1 or more
  /// Parts whose series are kept; time sums there are of all, and the total is kept in any case.
  std::array<bool, part_count> series = all_parts;
  /// BatchTally::by_source and, with errors per instant, se_by_source.
  bool by_source = false;
};

/// Throws std::logic_error for members that are out of their ranges.
void expect_valid(const SolverRules& rules);

/// Whether few solutions can serve a period by these rules at all
/// (solver/transport/year_gathering): gathered light with errors of totals.
inline bool year_can_serve(const SolverRules& rules) {
  return rules.transport == Transport::gather && rules.errors == Errors::totals;
}
/// Intervals with light that the solutions are tested on, and solved for that alone.
inline constexpr std::size_t year_tests = 2 * block_width;
/// Largest number of solutions worth making for a period with so many intervals with light: with
/// their tests they are a fixed share of these. Beyond that number, and where it has been tried in
/// vain, solving each interval costs less. Bands have solutions of their own, with rays of their
/// own to the sky about the sun, which otherwise serve all bands.
inline double most_of_few(const SolverRules& rules, double lit_intervals) {
  const double share = rules.bands == Bands::rgb ? 0.2 : 0.4;
  return share * lit_intervals - static_cast<double>(year_tests);
}

}  // namespace sunload
