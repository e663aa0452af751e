// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_view.h"

#include <cmath>
#include <limits>

#include "solver/sight/cell_rows.h"

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
  project_faces();
  list_faces();
}

void SunView::project_faces() {
  corner_.resize(faces_.corner_count());
  bounds_.resize(faces_.count());
  const double drift = std::max(suns_.drift_x, suns_.drift_y);
  for (std::size_t f = 0; f < faces_.count(); ++f) {
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
    if (faces_.is_needed(f, suns_.frame.to_sun, 2 * drift))
      needed_.push_back(static_cast<std::uint32_t>(f));
  }
  highest_.z = faces_.top();
  std::sort(needed_.begin(), needed_.end(), [this](std::uint32_t a, std::uint32_t b) {
    const double of_a = bounds_[a].highest.along, of_b = bounds_[b].highest.along;
    return of_a != of_b ? of_a > of_b : a < b;
  });
}

void SunView::list_faces() {
  struct Entry {
    std::uint32_t cell, face;
  };
  std::vector<Entry> entries;
  first_.assign(across_ * across_ + 1, 0);
  CellRows rows(across_);
  for (const auto f : needed_) {
    const auto corners =
        std::span(corner_).subspan(faces_.first_corner(f), faces_.corners(f).size());
    rows.take(corners, x0_, y0_, cells_per_m_);
    for (std::size_t r = rows.first(); r <= rows.last(); ++r) {
      const auto columns = rows.columns(r);
      for (std::size_t c = columns.first; c <= columns.last; ++c) {
        const std::size_t at = r * across_ + c;
        entries.push_back({static_cast<std::uint32_t>(at), f});
        ++first_[at + 1];
      }
    }
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  face_.resize(entries.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Entry& entry : entries) face_[next[entry.cell]++] = entry.face;
}

}  // namespace sunload
