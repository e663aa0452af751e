// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What errors the light of a study will have: a pilot, with random numbers of its own, solves some
/// of the study's suns and tells for every patch the variance that one line (a), one direct sample
/// (b) and one sample shot per patch (c) bring. With L lines, D and S samples the standard error is
/// then about
///
///     SE² = a / L + b / D + c / S
///
/// (scrambled Sobol points do no worse than independent ones). When gathering, what is not the
/// sun's comes by lines, and c = 0. When shooting, lines bring the first light of sky and ground,
/// and reflected light counts as the samples' alone: what the errors of first light add to it is
/// the mean of many patches.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/solver.h"

namespace sunload {

/// Of one quantity, by patch, in squares of its unit.
struct Spread {
  std::vector<double> value;
  std::vector<double> of_line;    ///< a
  std::vector<double> of_sample;  ///< b
  std::vector<double> of_shot;    ///< c; empty: none is shot
};

/// What the pilot found of every patch: values, and the variances that one line, one direct sample
/// and one sample shot would bring.
struct PatchSpread {
  std::vector<double> area;        ///< m2
  Spread load;                     ///< J m-2
  std::vector<Spread> irradiance;  ///< W m-2, of every sun of the pilot; empty: not asked for
  /// Samples that a block of suns takes with all its reflections, for every one of the first shot.
  double shots_per_block = 0;
};

/// Suns of the pilot, at most.
inline constexpr std::size_t most_accuracy_pilot_suns = 32;

/// Which of a period's intervals with light the pilot solves: `most_accuracy_pilot_suns` of them,
/// evenly spread.
struct AccuracyPilotSuns {
  std::vector<std::size_t> places;  ///< in the list of these intervals
  double weight = 1;                ///< of them for which each stands
};
/// `lit`: how many intervals with light the period has.
AccuracyPilotSuns accuracy_pilot_suns(std::size_t lit);

/// The rules that the pilot of a study solves by. Its realizations are like the study's own (the
/// errors of few scrambled points are not those of many), only more, or with more lines where they
/// may not be as many as that takes.
SolverRules rules_of_accuracy_pilot(SolverRules of_study, bool of_instants);

/// How the suns of a pilot stand for the period, and what is asked of them beside the light load.
struct AccuracyPilotRules {
  double weight = 1;  ///< suns of the period for which each of the pilot's stands
  std::size_t batch_suns = block_width;  ///< of the period, which share samples when shooting
  bool of_instants = false;              ///< PatchSpread::irradiance
};

/// Solves `suns` with more realizations of the study's own kind. Deterministic. Variances of lines
/// are means over a patch and its nearest neighbours on the input triangle. Throws Interrupted.
PatchSpread accuracy_pilot_spread(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                                  const SolverRules& rules, std::span<const IntervalLight> suns,
                                  const AccuracyPilotRules& pilot, Watch& watch);

}  // namespace sunload
