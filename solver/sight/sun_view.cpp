// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_view.h"

#include <cmath>
#include <limits>

#include "solver/sight/cell_rows.h"
#include "solver/sight/view_hull.h"

namespace sunload {

SunView::SunView(const SunFaces& faces, const Extent& extent, const SunCluster& suns)
    : faces_(faces),
      suns_(suns),
      cells_per_m_(1 / extent.cell_m),
      across_(std::max<std::size_t>(
          1, static_cast<std::size_t>(std::ceil(2 * extent.radius_m * cells_per_m_)))) {
  const ViewPoint centre = suns.frame(extent.centre);
  x0_ = centre.x - extent.radius_m;
  y0_ = centre.y - extent.radius_m;
  project();
  std::array<std::vector<std::uint32_t>, 2> numbers;
  const double drift = std::max(suns_.drift_x, suns_.drift_y);
  for (std::size_t f = 0; f < faces_.count_with_cores(); ++f)
    if (faces_.is_needed(f, suns_.frame.to_sun, 2 * drift))
      numbers[faces_.is_core(f) ? 1 : 0].push_back(static_cast<std::uint32_t>(f));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::sort(numbers[i].begin(), numbers[i].end(), [this](std::uint32_t a, std::uint32_t b) {
      const double of_a = bounds_[a].highest.along, of_b = bounds_[b].highest.along;
      return of_a != of_b ? of_a > of_b : a < b;
    });
    in_cell_[i] = listed(numbers[i]);
  }
}

void SunView::project() {
  corner_.resize(faces_.corner_count());
  bounds_.resize(faces_.count_with_cores());
  for (std::size_t f = 0; f < bounds_.size(); ++f) {
    Bounds bounds{{}, {faces_.top(f), -std::numeric_limits<double>::infinity()}};
    std::size_t at = faces_.first_corner(f);
    for (const Vec3& corner : faces_.corners(f)) {
      const ViewPoint p = suns_.frame(corner);
      corner_[at] = {p.x, p.y};
      bounds.box.include(corner_[at++]);
      bounds.highest.along = std::max(bounds.highest.along, p.h);
    }
    bounds_[f] = bounds;
    highest_.along = std::max(highest_.along, bounds.highest.along);
  }
  highest_.z = faces_.top();
}

SunView::InCells SunView::listed(const std::vector<std::uint32_t>& highest_first) const {
  struct Entry {
    std::uint32_t cell, number;
  };
  std::vector<Entry> entries;
  InCells in{std::vector<std::uint32_t>(across_ * across_ + 1, 0), {}};
  CellRows rows(across_);
  std::vector<ViewCorner> hull;
  for (const auto f : highest_first) {
    auto corners = std::span(corner_).subspan(faces_.first_corner(f), faces_.corners(f).size());
    if (faces_.is_core(f)) corners = convex_hull(corners, hull);
    rows.take(corners, x0_, y0_, cells_per_m_);
    for (std::size_t r = rows.first(); r <= rows.last(); ++r) {
      const auto columns = rows.columns(r);
      for (std::size_t c = columns.first; c <= columns.last; ++c) {
        const std::size_t at = r * across_ + c;
        entries.push_back({static_cast<std::uint32_t>(at), f});
        ++in.first[at + 1];
      }
    }
  }
  for (std::size_t c = 1; c < in.first.size(); ++c) in.first[c] += in.first[c - 1];
  in.number.resize(entries.size());
  std::vector<std::uint32_t> next(in.first.begin(), in.first.end() - 1);
  for (const Entry& entry : entries) in.number[next[entry.cell]++] = entry.number;
  return in;
}

}  // namespace sunload
