// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What does not depend on the batch, kept beside the batches: the traced lines, and the skies and
/// suns that are solved for a period which few solutions serve (solver/transport/node_light).
///
/// Shards and ranks read them instead of tracing and solving again, and so does a process that goes
/// on with the work. The file is checked by content hash, length and checksum, safe to delete,
/// rebuilt if missing; the numbers are the same bits either way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/lines/lines.h"
#include "solver/transport/node_light.h"

namespace sunload {

/// Written aside and renamed. `nodes`: of each band; none where each interval has its own solution.
/// Throws MachineError.
void write_prepared(const std::string& path, const std::string& content_hash, const Lines& lines,
                    const std::vector<const SolvedNodes*>& nodes = {});

/// What a prepared file holds.
struct Prepared {
  Lines lines;
  std::vector<SolvedNodes> nodes;  ///< of each band; none: each interval has its own solution
};
/// None where the file is missing, of another hash, or damaged.
std::optional<Prepared> read_prepared(const std::string& path, const std::string& content_hash);

}  // namespace sunload
