// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Houses without a floor, told by their shape alone.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/edge_table.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// Bodies that are open along lower edges of walls and nowhere else, and whose fronts look outward.
/// (Terrain is open along its rim.)
class OpenBelow {
 public:
  /// Both must outlive it. Cost: one pass over the edges of open bodies.
  OpenBelow(const Mesh& mesh, const Bodies& bodies);
  /// `body`: its number, or -1.
  bool has(std::int32_t body) const {
    return body >= 0 && is_house_[static_cast<std::size_t>(body)] != 0;
  }

 private:
  std::size_t body(std::size_t t) const {
    return static_cast<std::size_t>(bodies_.triangle_body[t]);
  }
  bool is_foot_or_goes_on(const EdgeUse& use, std::span<const EdgeUse> uses) const;
  std::vector<double> volumes_above_foot(const std::vector<std::uint8_t>& asked) const;

  const Mesh& mesh_;
  const Bodies& bodies_;
  std::vector<std::uint8_t> is_house_;  ///< per body
};

}  // namespace sunload
