/// How many lines and direct samples a study needs for the accuracy it asks for.
///
/// A pilot, with random numbers of its own, solves some of the study's suns and tells for
/// every patch the variance that one line (a) and one direct sample (b) bring to its light
/// load H. With L lines and D samples the standard error is then about
///
///     SE² = a / L + b / D
///
/// (scrambled Sobol points do no worse than independent ones). Counts are doubled until
/// SE / H meets the goal on 95 % of the leaf area that counts, the cheapest way, and frozen
/// before the first tally, with room for the errors of the errors that so few realizations state:
/// counts chosen from the very realizations that are tallied would
/// bias them. Patches whose load is below 1 % of the largest do not count, those that can
/// receive no light among them; the pilot has lines enough that a patch of which none finds
/// light lies below that share.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/solver.h"

namespace sunload {

struct AccuracyGoal {
  double light_load_relative = 0.01;  ///< standard error / light load of a patch
  int most_per_patch = 4096;          ///< lines, and direct samples
};

/// Of the leaf area whose load is at least `share_that_counts` of the largest,
/// `share_to_be_met` shall meet the goal (DESIGN 4).
inline constexpr double share_that_counts = 0.01, share_to_be_met = 0.95;

/// What a pilot finds out of every patch.
struct PatchSpread {
  std::vector<double> area;        ///< m2
  std::vector<double> load;        ///< J m-2
  std::vector<double> of_line;     ///< a: variance of the load by one line
  std::vector<double> of_sample;   ///< b: variance of the load by one direct sample
};

struct SampleCounts {
  int lines_per_patch = 0, direct_samples = 0;  ///< over all realizations together
  double share = 0;  ///< of the area that counts, where the goal will be met
};

/// Share of the area that counts where √(a/L + b/D) ≤ goal · load; 1 where nothing counts.
double share_met(const PatchSpread& spread, double light_load_relative, int lines, int samples);

/// The cheapest counts that meet the goal on `share_to_be_met` of the area that counts, from
/// those of `least` on, doubled, at most `most_per_patch`; where no counts do, the cheapest
/// that come within 10 % of the errors of the most. `suns`: of the whole period. Depends on nothing
/// else.
SampleCounts needed_counts(const PatchSpread& spread, const SolverRules& least,
                           const AccuracyGoal& goal, std::size_t suns);

/// Suns of a pilot, at most.
inline constexpr std::size_t pilot_suns = 32;

/// Solves `suns`, each of which stands for `weight` suns of the period. Deterministic.
PatchSpread pilot_spread(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                         const SolverRules& rules, std::span<const SunLight> suns, double weight,
                         Watch& watch);

}  // namespace sunload
