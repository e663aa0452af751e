/// Standard error of every patch or sensor and sun of a block, from the realizations.
#pragma once

#include <cmath>
#include <vector>

#include "solver/parallel.h"
#include "solver/tally.h"

namespace sunload {

class InstantSpread {
 public:
  InstantSpread(std::size_t receivers, std::size_t suns)
      : receivers_(receivers), suns_(suns), sum_(receivers * block_width, 0), squares_(sum_) {}

  /// `light.total(i, k)`: irradiance of the next realization.
  template <class Light>
  void add(const Light& light) {
    ++realizations_;
    parallel_for(receivers_, [&](std::size_t i) {
      for (std::size_t k = 0; k < suns_; ++k) {
        const auto E = static_cast<double>(light.total(i, k));
        sum_[i * block_width + k] += E;
        squares_[i * block_width + k] += E * E;
      }
    }, receivers_per_task);
  }
  /// Writes s / √R to the rows from `first_row` on.
  void store(std::size_t first_row, ReceiverTally& tally) const {
    const auto n = static_cast<double>(realizations_);
    parallel_for(receivers_, [&](std::size_t i) {
      for (std::size_t k = 0; k < suns_; ++k) {
        const std::size_t at = i * block_width + k;
        const double variance = std::max(0.0, squares_[at] - sum_[at] * sum_[at] / n) / (n - 1);
        tally.irradiance_se[(first_row + k) * receivers_ + i] =
            static_cast<float>(std::sqrt(variance / n));
      }
    }, receivers_per_task);
  }

 private:
  static constexpr std::size_t receivers_per_task = 1024;
  std::size_t receivers_, suns_;
  int realizations_ = 0;
  std::vector<double> sum_, squares_;
};

}  // namespace sunload
