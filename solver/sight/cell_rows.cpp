// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/cell_rows.h"

#include <limits>
#include <utility>

namespace sunload {

void CellRows::take(std::span<const ViewCorner> corners, double x0, double y0, double cells_per_m) {
  const auto in_cells = [&](const ViewCorner& p) {
    return ViewCorner{(p.x - x0) * cells_per_m, (p.y - y0) * cells_per_m};
  };
  ViewBox box;
  for (const ViewCorner& corner : corners) box.include(in_cells(corner));
  first_ = place(box.y0);
  last_ = place(box.y1);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (std::size_t r = first_; r <= last_; ++r) {
    left_[r] = infinite;
    right_[r] = -infinite;
  }
  ViewCorner from = in_cells(corners.back());
  for (const ViewCorner& corner : corners) {
    const ViewCorner to = in_cells(corner);
    add_edge(from, to);
    from = to;
  }
}

void CellRows::add_edge(ViewCorner a, ViewCorner b) {
  if (a.y > b.y) std::swap(a, b);
  const auto widen = [&](std::size_t row, double x) {
    left_[row] = std::min(left_[row], x);
    right_[row] = std::max(right_[row], x);
  };
  const std::size_t r0 = place(a.y), r1 = place(b.y);
  widen(r0, a.x);
  widen(r1, b.x);
  const double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
  for (std::size_t line = r0 + 1; line <= r1; ++line) {
    const double x = a.x + (static_cast<double>(line) - a.y) * slope;
    widen(line - 1, x);
    widen(line, x);
  }
}

}  // namespace sunload
