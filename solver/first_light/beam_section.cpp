// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/beam_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunload {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The part of a convex polygon where inward·(p - through) >= -margin.
/// Sutherland & Hodgman (1974), Reentrant polygon clipping.
ConvexPolygon clipped(const ConvexPolygon& polygon, Vec3 through, Vec3 inward, double margin) {
  ConvexPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double at_p = dot(p - through, inward) + margin, at_q = dot(q - through, inward) + margin;
    if (at_p >= 0) kept.push_back(p);
    if ((at_p >= 0) != (at_q >= 0)) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return kept;
}

ConvexPolygon whole(const Mesh& mesh, std::int32_t triangle) {
  const auto t = static_cast<std::size_t>(triangle);
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

/// A rectangle on a wall, its sides level and upright.
class Rectangle {
 public:
  explicit Rectangle(Vec3 normal) {
    // Where the plane is nearly level any axes serve.
    constexpr double least_sine = 1e-3;
    const Vec3 level{-normal.y, normal.x, 0};
    u_ = norm(level) > least_sine ? normalized(level) : tangents(normal).tangent;
    v_ = cross(normal, u_);
  }
  void hold(const ConvexPolygon& polygon) {
    for (const Vec3 p : polygon) {
      u0_ = std::min(u0_, dot(p, u_)), u1_ = std::max(u1_, dot(p, u_));
      v0_ = std::min(v0_, dot(p, v_)), v1_ = std::max(v1_, dot(p, v_));
    }
  }
  bool holds(const Rectangle& other) const {
    return u0_ <= other.u0_ && u1_ >= other.u1_ && v0_ <= other.v0_ && v1_ >= other.v1_;
  }
  bool empty() const { return u0_ > u1_; }
  ConvexPolygon part_of(ConvexPolygon polygon) const {
    polygon = clipped(polygon, u_ * u0_, u_, 0);
    polygon = clipped(polygon, u_ * u1_, -u_, 0);
    polygon = clipped(polygon, v_ * v0_, v_, 0);
    return clipped(polygon, v_ * v1_, -v_, 0);
  }

 private:
  Vec3 u_, v_;
  double u0_ = infinite, u1_ = -infinite, v0_ = infinite, v1_ = -infinite;
};

}  // namespace

BeamSection::BeamSection(const BeamSource& source, const std::vector<ConvexPolygon>& parts)
    : source_(source),
      parts_(parts),
      axes_(tangents(source.w)),
      all_{infinite, -infinite, infinite, -infinite, infinite, -infinite},
      asked_(parts.size(), 0) {
  for (const auto& part : parts) {
    const Box b = box(part);
    boxes_.push_back(b);
    all_ = {std::min(all_.x0, b.x0),           std::max(all_.x1, b.x1),
            std::min(all_.y0, b.y0),           std::max(all_.y1, b.y1),
            std::min(all_.nearest, b.nearest), std::max(all_.farthest, b.farthest)};
  }
  constexpr double most_cells = 128;
  cells_ =
      static_cast<int>(std::clamp(std::sqrt(static_cast<double>(parts.size())), 1.0, most_cells));
  parts_of_cell_.resize(static_cast<std::size_t>(cells_ * cells_));
  for (std::size_t part = 0; part < parts.size(); ++part)
    for_each_cell(boxes_[part], [&](std::vector<std::uint32_t>& cell) {
      cell.push_back(static_cast<std::uint32_t>(part));
    });
}

BeamSection::Box BeamSection::box(const ConvexPolygon& polygon) const {
  Box b{infinite, -infinite, infinite, -infinite, infinite, -infinite};
  for (const Vec3 p : polygon) {
    const double x = dot(p, axes_.tangent), y = dot(p, axes_.bitangent), z = dot(p, source_.w);
    b = {std::min(b.x0, x), std::max(b.x1, x),      std::min(b.y0, y),
         std::max(b.y1, y), std::min(b.nearest, z), std::max(b.farthest, z)};
  }
  return b;
}

template <class Visit>
void BeamSection::for_each_cell(const Box& b, Visit&& visit) {
  constexpr double smallest_extent_m = 1e-6;
  const auto cell = [&](double v, double low, double high) {
    const double share = (v - low) / std::max(high - low, smallest_extent_m);
    return static_cast<int>(std::clamp(share * cells_, 0.0, cells_ - 1.0));
  };
  const int x0 = cell(b.x0, all_.x0, all_.x1), x1 = cell(b.x1, all_.x0, all_.x1);
  const int y0 = cell(b.y0, all_.y0, all_.y1), y1 = cell(b.y1, all_.y0, all_.y1);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) visit(parts_of_cell_[static_cast<std::size_t>(y * cells_ + x)]);
}

std::vector<ConvexPolygon> BeamSection::lit(const MirrorGroups& groups, std::size_t group) {
  std::vector<ConvexPolygon> section;
  for (const auto triangle : groups[group].triangles) {
    const ConvexPolygon mirror = whole(groups.scene().mesh, triangle);
    Box b = box(mirror);
    const double beside =
        source_.margin_m + source_.spread * std::max(0.0, all_.farthest - b.nearest);
    b.x0 -= beside, b.x1 += beside, b.y0 -= beside, b.y1 += beside;
    if (b.x1 < all_.x0 || b.x0 > all_.x1 || b.y1 < all_.y0 || b.y0 > all_.y1) continue;
    Rectangle all(groups[group].normal), lit(groups[group].normal);
    all.hold(mirror);
    ++question_;
    for_each_cell(b, [&](const std::vector<std::uint32_t>& cell) {
      for (const auto part : cell) {
        if (asked_[part] == question_ || lit.holds(all)) continue;
        asked_[part] = question_;
        const Box& from = boxes_[part];
        if (from.x1 < b.x0 || from.x0 > b.x1 || from.y1 < b.y0 || from.y0 > b.y1 ||
            from.farthest <= b.nearest)
          continue;
        lit.hold(lit_by(parts_[part], mirror, beside));
      }
    });
    if (lit.empty()) continue;
    ConvexPolygon part = lit.part_of(mirror);
    if (part.size() >= 3) section.push_back(std::move(part));
  }
  return section;
}

ConvexPolygon BeamSection::lit_by(const ConvexPolygon& part, ConvexPolygon mirror,
                                  double beside) const {
  mirror = clipped(mirror, part[0], source_.normal, source_.margin_m);  // what is before its plane
  Vec3 middle;
  for (const Vec3 p : part) middle += p / static_cast<double>(part.size());
  for (std::size_t i = 0; i < part.size() && !mirror.empty(); ++i) {
    const Vec3 p = part[i], across = cross(source_.w, part[(i + 1) % part.size()] - p);
    const double length = norm(across);
    if (length <= 0) continue;  // an edge along the light bounds nothing
    const Vec3 inward = across * (std::copysign(1.0, dot(middle - p, across)) / length);
    mirror = clipped(mirror, p, inward, beside);
  }
  return mirror;
}

}  // namespace sunload
