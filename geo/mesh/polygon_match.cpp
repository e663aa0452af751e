// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/polygon_match.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/mesh/clip.h"
#include "geo/mesh/mesh.h"

namespace sunload {
namespace {

// Faces of a polygon that is not quite plane turn by a little from its mean plane.
constexpr double least_cosine = 0.9;

std::array<double, 2> seen_along(int drop, Vec3 p) {
  if (drop == 0) return {p.y, p.z};
  if (drop == 1) return {p.x, p.z};
  return {p.x, p.y};
}

/// Whether a ray from the point to +x crosses the ring an odd number of times.
bool is_inside(const std::vector<Vec3>& ring, int drop, Vec3 point) {
  const auto [x, y] = seen_along(drop, point);
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const auto a = seen_along(drop, ring[i]), b = seen_along(drop, ring[j]);
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]))
      inside = !inside;
  }
  return inside;
}

}  // namespace

PolygonMatch::PolygonMatch(std::vector<PolygonRings> polygons) {
  std::vector<Vec3> points;
  for (auto& rings : polygons) {
    Polygon polygon;
    const Vec3 area = rings.empty() ? Vec3{} : area_vector2(rings.front());
    if (norm(area) > 0) {
      polygon.normal = normalized(area);
      const std::array<double, 3> size{std::abs(area.x), std::abs(area.y), std::abs(area.z)};
      polygon.drop = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
      for (const Vec3 p : rings.front())
        polygon.middle += p / static_cast<double>(rings.front().size());
      for (const Vec3 p : rings.front())
        polygon.out_of_plane =
            std::max(polygon.out_of_plane, std::abs(dot(p - polygon.middle, polygon.normal)));
      points.insert(points.end(), rings.front().begin(), rings.front().end());
      polygon.rings = std::move(rings);
    }
    polygons_.push_back(std::move(polygon));
  }
  if (points.empty()) return;
  const Box box = bounding_box(points);
  side_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(polygons_.size()))));
  const auto steps = static_cast<double>(side_);
  low_x_ = box.low.x;
  low_y_ = box.low.y;
  step_x_ = std::max((box.high.x - box.low.x) / steps, tolerance_m);
  step_y_ = std::max((box.high.y - box.low.y) / steps, tolerance_m);
  cells_.resize(side_ * side_);
  for (std::size_t k = 0; k < polygons_.size(); ++k) {
    if (polygons_[k].rings.empty()) continue;
    const Box plan = bounding_box(polygons_[k].rings.front());
    const double rim = tolerance_m;
    const std::size_t first = cell(plan.low.x - rim, plan.low.y - rim),
                      last = cell(plan.high.x + rim, plan.high.y + rim);
    for (std::size_t row = first / side_; row <= last / side_; ++row)
      for (std::size_t column = first % side_; column <= last % side_; ++column)
        cells_[row * side_ + column].push_back(k);
  }
}

std::size_t PolygonMatch::cell(double x, double y) const {
  const auto place = [&](double offset, double step) {
    const auto last = static_cast<double>(side_ - 1);
    return static_cast<std::size_t>(std::clamp(std::floor(offset / step), 0.0, last));
  };
  return place(y - low_y_, step_y_) * side_ + place(x - low_x_, step_x_);
}

bool PolygonMatch::holds(const Polygon& polygon, Vec3 point) const {
  if (!is_inside(polygon.rings.front(), polygon.drop, point)) return false;
  return std::none_of(polygon.rings.begin() + 1, polygon.rings.end(),
                      [&](const auto& hole) { return is_inside(hole, polygon.drop, point); });
}

std::optional<std::size_t> PolygonMatch::polygon_at(Vec3 point, Vec3 normal) const {
  if (cells_.empty()) return std::nullopt;
  std::optional<std::size_t> found;
  double nearest = 0;
  for (const auto k : cells_[cell(point.x, point.y)]) {
    const auto& polygon = polygons_[k];
    const double away = std::abs(dot(point - polygon.middle, polygon.normal));
    if (away > tolerance_m + polygon.out_of_plane || (found && away >= nearest) ||
        std::abs(dot(normal, polygon.normal)) < least_cosine || !holds(polygon, point))
      continue;
    found = k;
    nearest = away;
  }
  return found;
}

}  // namespace sunload
