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

/// Results of one batch.
struct Solved {
  std::vector<BatchTally> bands;  ///< in the order of `band_names`; broadband light is one band
  WorkDone work;                  ///< of this batch
};

/// Number of suns in a batch that suits a period (`batch_suns: auto` of a study). In few and large
/// batches suns of one hour stand together, so that one look at the scene serves them, and fewer
/// totals of all realizations are made.
int batch_suns_for(std::size_t intervals);

/// Room for what a scene gets in consecutive intervals, and in `parts` of their time.
TallyShape tally_shape(const TracedScene& traced, std::size_t intervals,
                       std::span<const PartOfBatch> parts = {});

/// Light of consecutive intervals, and the totals of `parts` of their time (ReceiverTally::parts).
/// With rgb every sun has its light in `bands`. Throws Interrupted, and std::logic_error for light
/// that is none (expect_valid of solver/light/sun_block).
/// `record`: see LightTransport::begin.
Solved solve(const LightTransport& transport, std::span<const IntervalLight> batch, Watch& watch,
             std::span<const PartOfBatch> parts = {}, RayRecord* record = nullptr);

/// Consecutive intervals of a batch with the same scene: the number of their transport.
struct Stretch {
  std::size_t scene = 0, intervals = 0;
};

/// The same where materials change in the course of time: scenes that differ in nothing else, each
/// with its transport, take turns. `stretches` make up the batch. A part of light that any of the
/// scenes can have is there in all batches.
Solved solve_in_turns(std::span<const LightTransport* const> scenes,
                      std::span<const Stretch> stretches, std::span<const IntervalLight> batch,
                      Watch& watch, std::span<const PartOfBatch> parts = {});

}  // namespace sunload
