// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Boxes in the plane across light, listed by the cells of a grid about them that they meet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solver/sight/view_polygon.h"

namespace sunload {

class BoxGrid {
 public:
  BoxGrid() = default;
  /// As many cells as boxes.
  explicit BoxGrid(std::vector<ViewBox> boxes);
  const ViewBox& all() const { return all_; }

  /// Calls `visit` with the number of each box that meets another one, in an order of its own.
  template <class Visit>
  void visit(const ViewBox& box, const Visit& visit) const {
    if (boxes_.empty() || all_.is_apart_from(box, 0, 0)) return;
    const Cells cells = cells_of(box);
    for (std::size_t y = cells.y0; y <= cells.y1; ++y)
      for (std::size_t x = cells.x0; x <= cells.x1; ++x) {
        const std::size_t cell = y * across_ + x;
        for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
          const ViewBox& other = boxes_[number_[i]];
          if (other.is_apart_from(box, 0, 0)) continue;
          // Of the cells that both are in, the first one shows it.
          const bool is_first_x = x == cells.x0 || x == place((other.x0 - all_.x0) * per_x_);
          const bool is_first_y = y == cells.y0 || y == place((other.y0 - all_.y0) * per_y_);
          if (is_first_x && is_first_y) visit(static_cast<std::size_t>(number_[i]));
        }
      }
  }

 private:
  /// Inclusive.
  struct Cells {
    std::size_t x0, x1, y0, y1;
  };
  Cells cells_of(const ViewBox& box) const {
    return {place((box.x0 - all_.x0) * per_x_), place((box.x1 - all_.x0) * per_x_),
            place((box.y0 - all_.y0) * per_y_), place((box.y1 - all_.y0) * per_y_)};
  }
  std::size_t place(double at) const {
    return at > 0 ? std::min(static_cast<std::size_t>(at), across_ - 1) : 0;
  }
  template <class Visit>
  void for_each_cell(const ViewBox& box, const Visit& visit) const;

  std::vector<ViewBox> boxes_;
  ViewBox all_;
  std::size_t across_ = 1;
  double per_x_ = 0, per_y_ = 0;
  std::vector<std::uint32_t> first_, number_;
};

}  // namespace sunload
