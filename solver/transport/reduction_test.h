// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Intervals that are solved by themselves, to measure how near to this the light made up of nodes
/// comes.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "solver/transport/node_light.h"

namespace sunload {

/// Squared errors of light that is made up of nodes [W2 m-4]: means over patches, by area, summed
/// over intervals.
struct Squares {
  double sky = 0, reflected = 0;  ///< of each alone
  double error = 0;               ///< of both together; this and `sky` without the noise of samples
  double standard_error = 0;
  double error2 = 0;  ///< sum of the squares of each interval's `error`
  Squares& operator+=(const Squares& more) {
    sky += more.sky;
    reflected += more.reflected;
    error += more.error;
    standard_error += more.standard_error;
    error2 += more.error2;
    return *this;
  }
};

/// Keeps the exact light of its intervals, to compare any number of nodes with.
class ReductionTest {
 public:
  /// Solves up to `block_width` intervals, in the light of a band, by all lines and by each
  /// realization. `traced` must outlive it.
  ReductionTest(const TracedScene& traced, std::size_t band, std::vector<IntervalLight> suns,
                WorkDone& work);
  /// Of light that these nodes make up, summed over the intervals.
  Squares squares_of(const NodeLight& nodes) const;

 private:
  bool has_circumsolar() const { return any_circumsolar(sources_.circumsolar); }

  struct OfIntervals {
    std::array<Squares, block_width> of{};
    OfIntervals& operator+=(const OfIntervals& more) {
      for (std::size_t k = 0; k < block_width; ++k) of[k] += more.of[k];
      return *this;
    }
  };
  void add_squares(const BlockLight& made, const std::vector<float>& noise, std::size_t patch,
                   OfIntervals& sums) const;
  void keep_light(BlockLight exact);
  std::vector<float> noise_of_samples(const NodeLight& nodes,
                                      const std::vector<NodeWeights>& weights) const;

  const TracedScene& traced_;
  const PatchOptics& optics_;                               ///< of the band
  std::unique_ptr<const std::vector<IntervalLight>> suns_;  ///< where `sources_` looks for them
  BlockSources sources_;
  RayColumns rays_;                         ///< direct and by mirrors
  Columns sky_, mirror_, reflected_;        ///< of the exact solution
  std::vector<PackedColumns> circumsolar_;  ///< [R] samples of the sky about the sun; none: none
  std::vector<float> standard_error_;       ///< [interval][patch]
};

}  // namespace sunload
