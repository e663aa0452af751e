// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Power that samples bring to patches, kept until a shot is complete and then
/// added in an order that does not depend on threads.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/light/sun_block.h"

namespace sunload {

/// `weight` of the power of row `source` arrives at the patch or element `target`.
struct Deposit {
  std::uint32_t target, source;
  double weight;
};

/// Deposits by chunk of samples.
class Deposits {
 public:
  explicit Deposits(std::size_t chunks = 0) : chunks_(chunks) {}

  /// What the samples of one chunk brought; chunks may be put from any thread.
  void put(std::size_t chunk, std::vector<Deposit> deposits);

  /// irradiance[target] += weight · power[source] / area[target] for all suns of
  /// a block; chunk by chunk, within each by source.
  void add_to(DoubleColumns& irradiance, const DoubleColumns& power,
              const std::vector<double>& area) const;

 private:
  std::vector<std::vector<Deposit>> chunks_;  ///< each sorted by target, then source; merged
};

}  // namespace sunload
