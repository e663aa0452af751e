// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Standard error of every patch or sensor and sun of a block, from the realizations.
#pragma once

#include <numeric>
#include <span>
#include <vector>

#include "solver/base/chunks.h"
#include "solver/base/spread.h"
#include "solver/base/threads.h"
#include "solver/light/tally.h"

namespace sunload {

/// Irradiance of patch i and sun k by BlockLight, ShotLight …
template <class Light>
auto total_of(const Light& light) {
  return [&light](std::size_t i, std::size_t k) { return light.total(i, k); };
}

/// Sums and squares of irradiance over realizations, which are added one after another; errors lose
/// the digits by which the mean exceeds the spread. 16 bytes for each receiver and sun.
class InstantSpread {
 public:
  InstantSpread(std::size_t receivers, std::size_t suns)
      : receivers_(receivers), suns_(suns), sum_(receivers * block_width, 0), squares_(sum_) {}

  /// `irradiance(i, k)`: that of the next realization.
  template <class Irradiance>
  void add(const Irradiance& irradiance) {
    ++realizations_;
    parallel_for(
        receivers_,
        [&](std::size_t i) {
          for (std::size_t k = 0; k < suns_; ++k) {
            const auto E = static_cast<double>(irradiance(i, k));
            sum_[i * block_width + k] += E;
            squares_[i * block_width + k] += E * E;
          }
        },
        receivers_per_chunk);
  }
  /// s / √R of all suns, [K][N].
  std::vector<float> errors() const {
    std::vector<std::size_t> rows(suns_);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::vector<float> all(suns_ * receivers_);
    store(rows, all);
    return all;
  }
  /// The same to these rows of [K][N], one for each sun. `Errors`: a vector.
  template <class Errors>
  void store(std::span<const std::size_t> rows, Errors& errors) const {
    parallel_for(
        receivers_,
        [&](std::size_t i) {
          for (std::size_t k = 0; k < suns_; ++k) {
            const std::size_t at = i * block_width + k;
            errors[rows[k] * receivers_ + i] = static_cast<float>(standard_error(
                variance_by_sums(realizations_, sum_[at], squares_[at]), realizations_));
          }
        },
        receivers_per_chunk);
  }

 private:
  std::size_t receivers_, suns_;
  std::size_t realizations_ = 0;
  std::vector<double> sum_, squares_;
};

/// The same of the parts that come by direct samples, by samples shot, and by lines.
class InstantSpreadBySource {
 public:
  InstantSpreadBySource(std::size_t receivers, std::size_t suns)
      : samples_(receivers, suns), shots_(receivers, suns), lines_(receivers, suns) {}

  template <class Total, class BySamples, class ByShots>
  void add(const Total& total, const BySamples& by_samples, const ByShots& by_shots) {
    samples_.add(by_samples);
    shots_.add(by_shots);
    lines_.add([&](std::size_t i, std::size_t k) {
      return static_cast<double>(total(i, k)) - static_cast<double>(by_samples(i, k)) -
             static_cast<double>(by_shots(i, k));
    });
  }
  void store(std::span<const std::size_t> rows, ErrorsBySource& errors) const {
    samples_.store(rows, errors.samples);
    shots_.store(rows, errors.shots);
    lines_.store(rows, errors.lines);
  }

 private:
  InstantSpread samples_, shots_, lines_;
};

}  // namespace sunload
