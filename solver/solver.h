// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The method on one screen: a scene traced once, a batch of suns solved on it.
///
///     const auto traced = trace_scene(scene, mesh, rules, watch);
///     const auto transport = transport_of(*traced);
///     const Solved solved = solve(*transport, suns, watch);
///
/// All results are the same bits for any number of threads.
#pragma once

#include <span>
#include <vector>

#include "solver/transport/light_transport.h"

namespace sunload {

struct Solved {
  std::vector<BatchTally> bands;  ///< in the order of `band_names`; broadband light is one band
  WorkDone work;                  ///< of this batch
};

/// Light of consecutive intervals, and the totals of `parts` of their time (ReceiverTally::parts).
/// With rgb every sun has its light in `bands`. Throws Interrupted.
/// `record`: see LightTransport::begin.
Solved solve(const LightTransport& transport, std::span<const IntervalLight> batch, Watch& watch,
             std::span<const PartOfBatch> parts = {}, RayRecord* record = nullptr);

}  // namespace sunload
