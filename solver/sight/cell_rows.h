// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The cells of a square grid that convex polygons meet, row by row: scan conversion.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/sight/view_polygon.h"

namespace sunload {

class CellRows {
 public:
  /// Of a grid of so many rows and columns. Those at the rim stand for all beyond.
  explicit CellRows(std::size_t across) : across_(across), left_(across), right_(across) {}

  /// Goes to a polygon on a grid that begins at (x0, y0).
  void take(std::span<const ViewCorner> corners, double x0, double y0, double cells_per_m);
  std::size_t first() const { return first_; }
  std::size_t last() const { return last_; }
  /// First and last cell of a row that the polygon meets, both included.
  struct Columns {
    std::size_t first, last;
  };
  Columns columns(std::size_t row) const { return {place(left_[row]), place(right_[row])}; }

 private:
  void add_edge(ViewCorner a, ViewCorner b);
  std::size_t place(double at) const {
    return at > 0 ? std::min(static_cast<std::size_t>(at), across_ - 1) : 0;
  }

  std::size_t across_, first_ = 0, last_ = 0;
  std::vector<double> left_, right_;  ///< of every row, in cells
};

}  // namespace sunload
