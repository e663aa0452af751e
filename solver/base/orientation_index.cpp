// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/orientation_index.h"

#include <cmath>

#include "geo/base/check.h"

namespace sunload {

namespace {

constexpr double least_angle = 1e-5;
// Cells are wider than the chord of the angle by more than rounding.
constexpr double room = 1 + 1e-6;

struct Cell {
  std::int64_t x, y, z;
  std::uint64_t key() const {
    constexpr int bits = 21;  // ± 1e5 cells
    constexpr std::int64_t middle = std::int64_t{1} << (bits - 1);
    const auto part = [](std::int64_t c) { return static_cast<std::uint64_t>(c + middle); };
    return part(x) << 2 * bits | part(y) << bits | part(z);
  }
};

Cell cell_of(Vec3 unit, double cells_per_unit) {
  const auto part = [&](double c) {
    return static_cast<std::int64_t>(std::floor(c * cells_per_unit));
  };
  return {part(unit.x), part(unit.y), part(unit.z)};
}

}  // namespace

OrientationIndex::OrientationIndex(double angle)
    : least_cosine_(std::cos(angle)), cells_per_unit_(1 / (2 * std::sin(angle / 2) * room)) {
  SUNLOAD_EXPECT(angle > least_angle, "an angle well above rounding");
}

void OrientationIndex::add(Vec3 unit, std::int32_t number) {
  cells_[cell_of(unit, cells_per_unit_).key()].push_back({unit, number});
}

std::int32_t OrientationIndex::find(Vec3 unit) const {
  const Cell middle = cell_of(unit, cells_per_unit_);
  std::int32_t found = -1;
  for (std::int64_t x = -1; x <= 1; ++x)
    for (std::int64_t y = -1; y <= 1; ++y)
      for (std::int64_t z = -1; z <= 1; ++z) {
        const auto cell = cells_.find(Cell{middle.x + x, middle.y + y, middle.z + z}.key());
        if (cell == cells_.end()) continue;
        for (const Entry& entry : cell->second)
          if (dot(entry.unit, unit) >= least_cosine_ && (found < 0 || entry.number < found))
            found = entry.number;
      }
  return found;
}

}  // namespace sunload
