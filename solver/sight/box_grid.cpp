// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/box_grid.h"

#include <cmath>
#include <utility>

namespace sunload {

namespace {

constexpr double most_cells_across = 128;
constexpr double smallest_extent_m = 1e-9;

}  // namespace

BoxGrid::BoxGrid(std::vector<ViewBox> boxes) : boxes_(std::move(boxes)) {
  for (const ViewBox& box : boxes_) all_.include_box(box);
  const double side = std::sqrt(static_cast<double>(boxes_.size()));
  across_ = static_cast<std::size_t>(std::clamp(side, 1.0, most_cells_across));
  const auto cells = static_cast<double>(across_);
  per_x_ = cells / std::max(all_.x1 - all_.x0, smallest_extent_m);
  per_y_ = cells / std::max(all_.y1 - all_.y0, smallest_extent_m);
  first_.assign(across_ * across_ + 1, 0);
  for (const ViewBox& box : boxes_)
    for_each_cell(box, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  number_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    for_each_cell(boxes_[i],
                  [&](std::size_t cell) { number_[next[cell]++] = static_cast<std::uint32_t>(i); });
}

template <class Visit>
void BoxGrid::for_each_cell(const ViewBox& box, const Visit& visit) const {
  const Cells of = cells_of(box);
  for (std::size_t y = of.y0; y <= of.y1; ++y)
    for (std::size_t x = of.x0; x <= of.x1; ++x) visit(y * across_ + x);
}

}  // namespace sunload
