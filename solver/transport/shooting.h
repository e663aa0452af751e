// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light by samples of power: every realization for itself, series and totals from their mean.
///
/// Suns of a block share their samples; when gathering, they share lines alone.
#pragma once

#include "solver/shoot/shooting.h"
#include "solver/transport/light_transport.h"

namespace sunload {

class Shooting : public LightTransport {
 public:
  /// Shoots the emitters' power.
  explicit Shooting(const TracedScene& traced);
  std::unique_ptr<BatchTransport> begin(std::vector<BatchTally>& tallies, WorkDone& work,
                                        RayRecord* record) const override;

 private:
  Shooter shooter_;
};

}  // namespace sunload
