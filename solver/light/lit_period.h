// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The light of a whole period, interval by interval as it is asked for.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/light/sun_block.h"

namespace sunload {

class LitPeriod {
 public:
  LitPeriod() = default;
  LitPeriod(const LitPeriod&) = delete;
  LitPeriod& operator=(const LitPeriod&) = delete;
  virtual ~LitPeriod() = default;

  virtual std::size_t intervals() const = 0;
  /// As `IntervalLight::is_dark`, `has_sun` and `direction`, without the cost of the sky.
  virtual bool is_dark(std::size_t interval) const = 0;
  virtual bool has_sun(std::size_t interval) const = 0;
  virtual Vec3 direction(std::size_t interval) const = 0;
  /// To all suns that stand for the interval: more than one where it has `sun_samples`.
  virtual std::vector<Vec3> suns(std::size_t interval) const { return {direction(interval)}; }
  /// From any thread. Cost: some 0.1 ms for the sky.
  virtual IntervalLight of(std::size_t interval) const = 0;
};

}  // namespace sunload
