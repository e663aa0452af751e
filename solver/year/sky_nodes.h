// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Skies of a period that make up all others.
///
/// Light is linear in its sources, and the skies of a year, thousands of them, have the numerical
/// rank of some tens: they are one family of functions of the sun's place and the clearness. So
/// real skies of the period are chosen, each the one that those before it make up worst (QR with
/// column pivoting, Businger & Golub 1965; as a choice of columns Cheng et al. 2005), and any sky
/// is L ≈ Σ c_m L_m, by least squares over its directions.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/light/lit_period.h"
#include "solver/year/dense_fit.h"

namespace sunload {

class SkyNodes {
 public:
  /// Ranks skies of the period, `most` at most. Candidates are up to `most_candidates` intervals
  /// with a sky, spread evenly over the period, without `left_out` (ascending). Cost: candidates ×
  /// most × cells / 4 operations.
  SkyNodes(const SkyGrid& grid, const LitPeriod& period, std::size_t most,
           const std::vector<std::size_t>& left_out = {});

  static constexpr std::size_t most_candidates = 1000;

  /// Intervals in the order in which they are chosen.
  const std::vector<std::size_t>& ranked() const { return ranked_; }
  /// Number of ranked skies after which the candidates' root mean square rest falls below this
  /// share of them; all where it never does.
  std::size_t count_for(double rest) const;
  /// From now on skies are made up of the first `count` (≤ ranked().size()).
  void take(std::size_t count);
  std::size_t count() const { return fit_ ? fit_->size() : 0; }
  /// c_m of a sky of the grid [W m-2 sr-1]; empty: none. From any thread, after `take`.
  std::vector<double> weights(const std::vector<double>& sky) const;

 private:
  std::vector<float> coarse(const std::vector<double>& sky) const;

  std::size_t side_;
  std::vector<std::size_t> ranked_;
  std::vector<std::vector<float>> skies_;  ///< of the ranked intervals, coarse, of unit strength
  std::vector<double> strength_;           ///< their Σ radiance of the coarse cells
  std::vector<double> rest_;               ///< [m] after m skies
  std::optional<DenseFit> fit_;
};

}  // namespace sunload
