// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light over lines traced once: pooled for the series, per realization for errors.
///
/// The results of an interval do not depend on the batch that it is solved in (time sums do, by the
/// order of additions).
#pragma once

#include "solver/transport/light_transport.h"

namespace sunload {

class Gathering : public LightTransport {
 public:
  /// `tried`: work that was done before it was chosen.
  explicit Gathering(const TracedScene& traced, const WorkDone& tried = {})
      : LightTransport(traced) {
    work_ = tried;
  }
  std::unique_ptr<BatchTransport> begin(std::vector<BatchTally>& tallies, WorkDone& work,
                                        RayRecord* record) const override;
};

}  // namespace sunload
