// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A batch of a period that few solutions serve: the sun's own rays are those of its intervals, all
/// other light is made up of the nodes', and time sums are exact (exact_totals.h).
#pragma once

#include <memory>
#include <vector>

#include "solver/transport/node_light.h"

namespace sunload {

/// `nodes`: of each band. All must outlive what is returned.
std::unique_ptr<BatchTransport> year_batch(const TracedScene& traced,
                                           const std::vector<std::unique_ptr<NodeLight>>& nodes,
                                           std::vector<BatchTally>& tallies, WorkDone& work,
                                           RayRecord* record);

}  // namespace sunload
