// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What one variant has traced, kept for later ones that differ from it in diffuse reflectances
/// alone: rays would bring the same, bit for bit.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "io/plan/variant_plan.h"
#include "solver/solver.h"

namespace sunload {

/// What the variants of one key share.
struct TracedRays {
  std::string traced_by;       ///< the first variant; empty: nothing is traced yet
  std::optional<Lines> lines;  ///< while no variant has them
  std::map<std::size_t, RayRecord> batches;
  bool is_wanted_later = false;  ///< by a variant after the one in hand
};

/// Key of a variant, equal where rays tell the same. Empty where a variant shares with none: its
/// rays depend on what shines, on counts that a pilot chooses, or are those of its own samples.
std::string rays_key(const VariantPlan& plan);

/// What the variants of one process share, by key.
class SharedRays {
 public:
  /// A variant of this key is still to be computed.
  void expect(const std::string& key);
  /// That variant is done; rays that no variant waits for are dropped.
  void release(const std::string& key);
  /// What variants of this key share; null: there is no other.
  TracedRays* of(const std::string& key);
  /// Bytes that more records may take: a share of the free memory.
  static double room_bytes();

 private:
  struct Shared {
    int variants = 0;  ///< to come
    TracedRays rays;
  };
  std::map<std::string, Shared> shared_;
};

}  // namespace sunload
