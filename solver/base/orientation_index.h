// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which of many unit vectors point nearly the same way as another.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// Vectors in a grid of cells about as wide as the angle that they may differ by: adding and
/// finding one takes constant time while few are that near to each other.
class OrientationIndex {
 public:
  /// `angle` in radians, above 1e-5.
  explicit OrientationIndex(double angle);

  void add(Vec3 unit, std::int32_t number);
  /// The smallest number of those within the angle; -1: none.
  std::int32_t find(Vec3 unit) const;

 private:
  struct Entry {
    Vec3 unit;
    std::int32_t number;
  };
  double least_cosine_, cells_per_unit_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

}  // namespace sunload
