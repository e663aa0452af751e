/// How many lines, direct samples and, when shooting, samples of power a study needs for the
/// accuracy it asks for.
///
/// A pilot, with random numbers of its own, solves some of the study's suns and tells for
/// every patch the variance that one line (a), one direct sample (b) and one sample shot per patch
/// (c) bring to its light load H. With L lines, D and S samples the standard error is then about
///
///     SE² = a / L + b / D + c / S
///
/// (scrambled Sobol points do no worse than independent ones). When gathering, what is not the
/// sun's comes by lines, and c = 0. When shooting, lines bring the first light of sky and ground,
/// and reflected light counts as the samples' alone: what the errors of first light add to it is
/// the mean of many patches. Counts are doubled until
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
  int most_per_patch = 4096;          ///< lines, direct samples, samples shot
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
  std::vector<double> of_shot;     ///< c: variance by one sample shot per patch; empty: none is
  /// Samples that a block of suns takes with all its reflections, for every one of the first shot.
  double shots_per_block = 0;
};

/// Over all realizations together.
struct SampleCounts {
  int lines_per_patch = 0, direct_samples = 0;
  /// Of the first shot, in the mean of patches. With a power per sample of its own this is what
  /// `lines_per_patch` stands for, and the power falls as the count rises.
  int samples_per_patch = 0;
  double share = 0;  ///< of the area that counts, where the goal will be met
};

/// The rules with these counts; `least` are those that the counts were chosen for.
SolverRules with_counts(const SolverRules& least, const SampleCounts& counts);

/// Share of the area that counts where √(a/L + b/D + c/S) ≤ goal · load; 1 where nothing counts.
double share_met(const PatchSpread& spread, double light_load_relative,
                 const SampleCounts& counts);

/// The cheapest counts that meet the goal on `share_to_be_met` of the area that counts, from
/// those of `least` on, doubled, at most `most_per_patch`; where no counts do, the cheapest
/// that come within 10 % of the errors of the most. `suns`: of the whole period. Depends on nothing
/// else.
SampleCounts needed_counts(const PatchSpread& spread, const SolverRules& least,
                           const AccuracyGoal& goal, std::size_t suns);

/// Suns of a pilot, at most.
inline constexpr std::size_t pilot_suns = 32;

/// Solves `suns`, each of which stands for `weight` suns of the period, which is solved in batches
/// of `batch_suns`. Deterministic.
PatchSpread pilot_spread(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                         const SolverRules& rules, std::span<const SunLight> suns, double weight,
                         Watch& watch, std::size_t batch_suns = block_width);

}  // namespace sunload
