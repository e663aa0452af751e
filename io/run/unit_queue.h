// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Hands out the batches of a variant that are a process' own to compute.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "io/run/shard.h"

namespace sunload {

class MpiWorld;

/// Batches of one variant, one after another: a fixed share of a shard, or
/// whatever the common counter of MPI ranks gives next.
class UnitQueue {
 public:
  /// `variant`: the variant's place in the study. `world` may be null.
  UnitQueue(std::size_t variant, std::size_t batches, Shard shard, MpiWorld* world);
  /// The next batch to look at; none when the variant is handed out.
  std::optional<std::size_t> next();
  /// Whether this process may be given a batch.
  bool may_give(std::size_t batch) const;

 private:
  std::size_t variant_, batches_;
  Shard shard_;
  MpiWorld* world_;
  std::size_t position_ = 0;
};

}  // namespace sunload
