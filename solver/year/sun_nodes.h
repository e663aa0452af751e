// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Suns of a period between which reflected sunlight is interpolated.
///
/// What surfaces reflect of the sun changes slowly with the sun's direction, in proportion to its
/// strength: shadows move, but each patch sees many of them. So suns of the period are chosen, each
/// the one furthest from those before it (Gonzalez 1985), and any sun is Σ w_m of its neighbours
/// among them: a linear function fitted to them by moving least squares (Lancaster & Salkauskas
/// 1981), so that Σ w_m = 1 and directions are met exactly.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/light/lit_period.h"

namespace sunload {

class SunNodes {
 public:
  /// Ranks suns of the period, `most` at most, of up to `most_candidates` that stand above the
  /// horizon, spread evenly over it, without `left_out` (ascending).
  SunNodes(const LitPeriod& period, std::size_t most,
           const std::vector<std::size_t>& left_out = {});

  static constexpr std::size_t most_candidates = 4000;

  const std::vector<std::size_t>& ranked() const { return ranked_; }
  /// Number of ranked suns after which no candidate is further from them than this [rad]; all where
  /// there is no such number.
  std::size_t count_for(double distance) const;
  void take(std::size_t count);
  std::size_t count() const { return taken_; }

  /// Part of a chosen sun, by its place in `ranked`, in the light of another; may be below 0.
  struct Weight {
    std::size_t node;
    double weight;
  };
  /// Of a unit direction. From any thread, after `take` of at least one.
  std::vector<Weight> weights(Vec3 to_sun) const;

 private:
  std::vector<std::size_t> ranked_;
  std::vector<Vec3> directions_;  ///< of the ranked intervals
  std::vector<double> distance_;  ///< [m] chord from the furthest candidate to m suns
  std::size_t taken_ = 0;
};

}  // namespace sunload
