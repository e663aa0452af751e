// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which units of work are a process' own: shards of a job array, ranks of MPI.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace sunload {

/// Unit u = variant · (batches per variant) + batch belongs to shard u mod count.
struct Shard {
  std::size_t index = 0, count = 1;
  bool is_rank = false;  ///< of this process among those that were started together with it
  bool is_whole() const { return count == 1; }
  bool owns(std::size_t unit) const { return unit % count == index; }
};

/// Value of an environment variable, empty if it is not set.
using Environment = std::function<std::string(const char* name)>;
std::string process_environment(const char* name);

/// Reads `I/N` (I = 0 … N-1), `auto` (Slurm array or srun step, OpenMPI) or
/// `auto/N` (schedulers that give an index only: PBS_ARRAY_INDEX, PBS_ARRAYID).
///
/// A Slurm array task is the place of SLURM_ARRAY_TASK_ID in the array's range
/// and step; the process id of `srun` counts only inside a step with several
/// tasks. Shards of a step and of OpenMPI are ranks: each process has another. Throws InputError
/// where nothing or more than one thing is said.
Shard parse_shard(const std::string& text, const Environment& environment = process_environment);

}  // namespace sunload
