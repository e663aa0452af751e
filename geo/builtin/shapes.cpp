// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/builtin/shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload::builtin {
namespace {

/// Points closer than this are one vertex: far above rounding, far below any detail.
constexpr double grid_m = 1e-6;

std::vector<Vec3> points(const Frame& frame, const Ring& ring) {
  std::vector<Vec3> result;
  for (const auto p : ring) result.push_back(frame.at(p));
  return result;
}

double signed_area2(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 a = ring[i], b = ring[(i + 1) % ring.size()];
    sum += a.u * b.v - a.v * b.u;
  }
  return sum;
}

/// Turns `p` about the unit vector `axis` (Rodrigues' formula).
Vec3 turned(Vec3 p, Vec3 axis, double angle) {
  return std::cos(angle) * p + std::sin(angle) * cross(axis, p) +
         (1 - std::cos(angle)) * dot(axis, p) * axis;
}

}  // namespace

Ring rectangle(Point2 low, Point2 high) { return {low, {high.u, low.v}, high, {low.u, high.v}}; }

Builder::Builder(std::string source) { model_.source = std::move(source); }

MaterialId Builder::material(const std::string& name, double diffuse, double mirror,
                             double emitted_power_w) {
  model_.materials.push_back({name, diffuse, mirror, emitted_power_w});
  return make_id<MaterialId>(model_.materials.size() - 1);
}

void Builder::begin_object(const std::string& name, Placement placement) {
  model_.object_names.push_back(name);
  model_.object_kinds.emplace_back();
  placement_ = placement;
  vertex_of_.clear();
}

std::int32_t Builder::vertex(Vec3 point) {
  const Vec3 placed = placement_(point);
  const auto on_grid = [](double x) { return static_cast<std::int64_t>(std::llround(x / grid_m)); };
  const auto [entry, is_new] =
      vertex_of_.try_emplace({on_grid(placed.x), on_grid(placed.y), on_grid(placed.z)},
                             static_cast<std::int32_t>(model_.vertices.size()));
  if (is_new) model_.vertices.push_back(placed);
  return entry->second;
}

void Builder::face(const std::vector<std::vector<Vec3>>& rings, Finish finish) {
  SUNLOAD_EXPECT(!model_.object_names.empty(), "a face needs an object");
  std::vector<std::vector<std::int32_t>> indices;
  for (const auto& ring : rings) {
    auto& row = indices.emplace_back();
    for (const auto& point : ring) row.push_back(vertex(point));
  }
  const auto object = make_id<ObjectId>(model_.object_names.size() - 1);
  model_.add_polygon(indices, {object, finish.material, finish.surface, Sides::one});
}

Face::Face(Builder& builder, Frame frame, Ring outline, Finish finish)
    : builder_(&builder), frame_(frame), outline_(std::move(outline)), finish_(finish) {
  SUNLOAD_EXPECT(signed_area2(outline_) > 0, "outlines are counter-clockwise");
  low_ = high_ = outline_.front();
  for (const auto p : outline_) {
    low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
    high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
  }
}

void Face::cut(const Ring& ring) {
  SUNLOAD_EXPECT(signed_area2(ring) > 0, "openings are given counter-clockwise");
  for (const auto p : ring)
    SUNLOAD_EXPECT(p.u > low_.u && p.u < high_.u && p.v > low_.v && p.v < high_.v,
                   "openings lie inside their face");
  holes_.emplace_back(ring.rbegin(), ring.rend());
}

Face Face::step(const Ring& ring, double height, Finish sides, Finish cap) {
  const Frame cap_frame = frame_.lifted(height);
  return step_to(ring, points(cap_frame, ring), cap_frame, sides, cap);
}

Face Face::step_to(const Ring& ring, const std::vector<Vec3>& moved, Frame cap_frame, Finish sides,
                   Finish cap) {
  cut(ring);
  const auto start = points(frame_, ring);
  Ring cap_ring;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t next = (i + 1) % ring.size();
    builder_->face({{start[i], start[next], moved[next], moved[i]}}, sides);
    cap_ring.push_back(cap_frame.coordinates(moved[i]));
  }
  return Face(*builder_, cap_frame, cap_ring, cap);
}

void Face::emit() {
  std::vector<std::vector<Vec3>> rings{points(frame_, outline_)};
  for (const auto& hole : holes_) rings.push_back(points(frame_, hole));
  builder_->face(rings, finish_);
}

void box(Builder& builder, Vec3 low, Vec3 high, Finish finish, std::optional<Finish> bottom) {
  prism(builder, rectangle({low.x, low.y}, {high.x, high.y}), low.z, high.z,
        {finish, finish, bottom.value_or(finish), finish});
}

void turned_box(Builder& builder, Vec3 centre, Vec3 size, Vec3 axis, double angle, Finish finish) {
  const auto corner = [&](int i) {
    const Vec3 p{(i & 1 ? size.x : -size.x) / 2, (i & 2 ? size.y : -size.y) / 2,
                 (i & 4 ? size.z : -size.z) / 2};
    return centre + turned(p, axis, angle);
  };
  // Bit k of a corner's number says whether it lies on the high side of axis k.
  constexpr int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  for (const auto& side : sides)
    builder.face({{corner(side[0]), corner(side[1]), corner(side[2]), corner(side[3])}}, finish);
}

void prism(Builder& builder, const Ring& outline, double z_low, double z_high, PrismFinish finish,
           const std::vector<Ring>& shafts) {
  std::vector<Ring> rings{outline};
  for (const auto& shaft : shafts) rings.emplace_back(shaft.rbegin(), shaft.rend());
  std::vector<std::vector<Vec3>> top, bottom;
  for (const auto& ring : rings) {
    const Finish side = &ring == &rings.front() ? finish.side : finish.shaft;
    auto& above = top.emplace_back();
    auto& below = bottom.emplace_back();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 a = ring[i], b = ring[(i + 1) % ring.size()];
      builder.face({{{a.u, a.v, z_low}, {b.u, b.v, z_low}, {b.u, b.v, z_high}, {a.u, a.v, z_high}}},
                   side);
      above.push_back({a.u, a.v, z_high});
      below.push_back({a.u, a.v, z_low});
    }
    std::reverse(below.begin(), below.end());
  }
  builder.face(top, finish.top);
  builder.face(bottom, finish.bottom);
}

Ring scaled(const Ring& ring, Point2 centre, double factor) {
  Ring result;
  for (const auto p : ring)
    result.push_back({centre.u + factor * (p.u - centre.u), centre.v + factor * (p.v - centre.v)});
  return result;
}

Ring moved(const Ring& ring, Point2 by) {
  Ring result;
  for (const auto p : ring) result.push_back({p.u + by.u, p.v + by.v});
  return result;
}

void lathe(Builder& builder, Vec3 foot, const std::vector<Point2>& profile, int sides,
           Finish finish, Finish bottom) {
  const auto point = [&](Point2 p, int k) {
    const double angle = 2 * pi * (k % sides) / sides;
    return foot + Vec3{p.u * std::cos(angle), p.u * std::sin(angle), p.v};
  };
  const auto disk = [&](Point2 rim) {
    std::vector<Vec3> ring;
    for (int k = 0; k < sides; ++k) ring.push_back(point(rim, k));
    return ring;
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Point2 a = profile[i], b = profile[i + 1];
    if (a.u <= 0) {  // flat foot
      auto ring = disk(b);
      std::reverse(ring.begin(), ring.end());
      builder.face({ring}, bottom);
    } else if (b.u <= 0 && a.v == b.v) {  // flat top
      builder.face({disk(a)}, finish);
    } else {
      for (int k = 0; k < sides; ++k) {
        std::vector<Vec3> ring{point(a, k), point(a, k + 1), point(b, k + 1)};
        if (b.u > 0) ring.push_back(point(b, k));
        builder.face({ring}, finish);
      }
    }
  }
}

Ring regular_polygon(int sides, double radius) {
  Ring ring;
  for (int k = 0; k < sides; ++k) {
    const double angle = -pi / 2 + pi * (2 * k - 1) / sides;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

void sheet(Builder& builder, Vec3 corner, Vec3 edge_u, Vec3 edge_v, Finish finish) {
  builder.face({{corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v}}, finish);
}

}  // namespace sunload::builtin
