// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/beam_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace sunload {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// What lies on the side of a point to which `inward` shows, and `margin` beyond.
HalfSpace beside_point(Vec3 through, Vec3 inward, double margin) {
  return {inward, dot(through, inward) - margin};
}

FlatPolygon whole(const Mesh& mesh, std::int32_t triangle) {
  const auto t = static_cast<std::size_t>(triangle);
  return FlatPolygon(mesh.corners(t));
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
  void hold(const FlatPolygon& polygon) {
    for (const Vec3 p : polygon.corners()) {
      u0_ = std::min(u0_, dot(p, u_)), u1_ = std::max(u1_, dot(p, u_));
      v0_ = std::min(v0_, dot(p, v_)), v1_ = std::max(v1_, dot(p, v_));
    }
  }
  bool holds(const Rectangle& other) const {
    return u0_ <= other.u0_ && u1_ >= other.u1_ && v0_ <= other.v0_ && v1_ >= other.v1_;
  }
  bool empty() const { return u0_ > u1_; }
  FlatPolygon part_of(FlatPolygon polygon) const {
    constexpr double rounding_m = 1e-9;  // corners on the sides are of it
    for (const HalfSpace& side :
         {HalfSpace{u_, u0_ - rounding_m}, HalfSpace{-u_, -u1_ - rounding_m},
          HalfSpace{v_, v0_ - rounding_m}, HalfSpace{-v_, -v1_ - rounding_m}})
      polygon.keep_before(side);
    return polygon;
  }

 private:
  Vec3 u_, v_;
  double u0_ = infinite, u1_ = -infinite, v0_ = infinite, v1_ = -infinite;
};

}  // namespace

void BeamSection::Depths::include(double depth) {
  nearest = std::min(nearest, depth);
  farthest = std::max(farthest, depth);
}

BeamSection::BeamSection(const BeamSource& source, const std::vector<ConvexPolygon>& parts)
    : source_(source), parts_(parts), across_(source.w) {
  std::vector<ViewBox> boxes;
  for (const auto& part : parts) {
    boxes.push_back(box(part));
    depths_.push_back(depths(part));
    all_.include(depths_.back().nearest);
    all_.include(depths_.back().farthest);
  }
  grid_ = BoxGrid(std::move(boxes));
}

BeamSection::Depths BeamSection::depths(std::span<const Vec3> polygon) const {
  Depths along;
  for (const Vec3 p : polygon) along.include(dot(p, source_.w));
  return along;
}

ViewBox BeamSection::box(std::span<const Vec3> polygon) const {
  ViewBox box;
  for (const Vec3 p : polygon) box.include({dot(p, across_.x), dot(p, across_.y)});
  return box;
}

std::vector<ConvexPolygon> BeamSection::lit(const MirrorGroups& groups, std::size_t group) const {
  std::vector<ConvexPolygon> section;
  for (const auto triangle : groups[group].triangles) {
    const FlatPolygon mirror = whole(groups.scene().mesh, triangle);
    const double nearest = depths(mirror.corners()).nearest;
    const double beside =
        source_.margin_m + source_.spread * std::max(0.0, all_.farthest - nearest);
    ViewBox near = box(mirror.corners());
    near.x0 -= beside, near.x1 += beside, near.y0 -= beside, near.y1 += beside;
    Rectangle all(groups[group].normal), lit(groups[group].normal);
    all.hold(mirror);
    grid_.visit(near, [&](std::size_t part) {
      if (depths_[part].farthest > nearest && !lit.holds(all))
        lit.hold(lit_by(parts_[part], mirror, beside));
    });
    if (lit.empty()) continue;
    const FlatPolygon part = lit.part_of(mirror);
    if (part.corners().size() >= 3)
      section.emplace_back(part.corners().begin(), part.corners().end());
  }
  return section;
}

FlatPolygon BeamSection::lit_by(const ConvexPolygon& part, FlatPolygon mirror,
                                double beside) const {
  // What is before its plane.
  mirror.keep_before(beside_point(part[0], source_.normal, source_.margin_m));
  Vec3 middle;
  for (const Vec3 p : part) middle += p / static_cast<double>(part.size());
  for (std::size_t i = 0; i < part.size() && !mirror.corners().empty(); ++i) {
    const Vec3 p = part[i], across = cross(source_.w, part[(i + 1) % part.size()] - p);
    const double length = norm(across);
    if (length <= 0) continue;  // an edge along the light bounds nothing
    const Vec3 inward = across * (std::copysign(1.0, dot(middle - p, across)) / length);
    mirror.keep_before(beside_point(p, inward, beside));
  }
  return mirror;
}

}  // namespace sunload
