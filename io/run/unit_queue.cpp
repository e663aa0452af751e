// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/unit_queue.h"

#include "io/run/mpi_world.h"

namespace sunload {

UnitQueue::UnitQueue(std::size_t variant, std::size_t batches, Shard shard, MpiWorld* world)
    : variant_(variant), batches_(batches), shard_(shard), world_(world) {}

std::optional<std::size_t> UnitQueue::next() {
  if (world_) {
    const std::size_t batch = world_->next_of(variant_);
    return batch < batches_ ? std::optional(batch) : std::nullopt;
  }
  while (position_ < batches_) {
    const std::size_t batch = position_++;
    if (may_give(batch)) return batch;
  }
  return {};
}

bool UnitQueue::may_give(std::size_t batch) const {
  return world_ != nullptr || shard_.owns(variant_ * batches_ + batch);
}

}  // namespace sunload
