// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sky_view.h"

#include <limits>

#include "solver/sight/sun_sight.h"

namespace sunload {

namespace {

using Bins = SunCells::Bins;
constexpr std::size_t sectors = SunCells::sectors;
constexpr double infinite = std::numeric_limits<double>::infinity();

// A ray that passes a face at such an angle or more (sine) and is off by the lateral margin meets
// the face within this many offsets of where it should; faces are drawn in by more.
constexpr double least_incidence = 0.05, drawn_in_offsets = 64, flat_offsets = 0.25;
static_assert((lateral_offsets + flat_offsets) / least_incidence < drawn_in_offsets);
/// Faces nearer than so many offsets may lie between a patch and the origins of its rays.
constexpr double near_offsets = 16;

double level_cross(Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; }
double level_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y; }

}  // namespace

Blockers blockers_of(const Mesh& mesh, std::span<const float> transmittance, double offset_m,
                     double least_face_m2) {
  Blockers all{Occluders(mesh, transmittance), {}, {}, offset_m};
  std::vector<Box> boxes;
  for (const ConvexFace& whole : convex_faces(all.triangles, flat_offsets * offset_m)) {
    ConvexFace face = inset(whole, drawn_in_offsets * offset_m);
    if (area_of(face) < least_face_m2) continue;
    boxes.push_back(bounding_box(face.corners));
    all.faces.push_back(std::move(face));
  }
  all.faces_tree = BoxTree(std::move(boxes));
  return all;
}

void SkyView::look(const std::array<Vec3, 3>& corners, Vec3 normal) {
  place(corners, normal);
  leave_out_what_is_behind();
  reached_.fill(0);
  closed_.fill(0);
  todo_ = before_;
  const auto meets = [&](const Box& box) { return may_matter(box); };
  blockers_.faces_tree.visit_near_first(centre_, meets,
                                        [&](std::size_t f) { cover(blockers_.faces[f]); });
  blockers_.triangles.tree().visit_near_first(centre_, meets, [&](std::size_t t) { block(t); });
}

void SkyView::place(const std::array<Vec3, 3>& corners, Vec3 normal) {
  margin_ = lateral_offsets * blockers_.offset_m;
  normal_ = normal;
  centre_ = (corners[0] + corners[1] + corners[2]) / 3;
  half_ = {0, 0, 0};
  radius_ = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = corner_[k] = corners[k] - centre_;
    half_ = {std::max(half_.x, std::abs(p.x)), std::max(half_.y, std::abs(p.y)),
             std::max(half_.z, std::abs(p.z))};
    radius_ = std::max(radius_, std::hypot(p.x, p.y));
  }
  for (std::size_t s = 0; s < sectors; ++s) {
    const auto& sector = cells_.sector(s);
    const auto extent = [&](Vec3 axis) {
      const double a = dot(corner_[0], axis), b = dot(corner_[1], axis), c = dot(corner_[2], axis);
      return Extent{std::min({a, b, c}), std::max({a, b, c})};
    };
    along_[s] = extent(sector.middle);
    across_[s] = extent(sector.left);
  }
}

/// Cells towards which the patch does not face wait for no answer.
void SkyView::leave_out_what_is_behind() {
  before_ = cells_.wanted();
  const double level = std::hypot(normal_.x, normal_.y);
  for (std::size_t s = 0; s < sectors; ++s) {
    if (before_[s] == 0) continue;
    const auto& sector = cells_.sector(s);
    // The most that n·w can be over the sector's directions, of level length 1.
    const double towards = level_dot(normal_, sector.middle);
    const double most = towards >= level * sector.cosine
                            ? level
                            : towards * sector.cosine + std::abs(level_dot(normal_, sector.left)) *
                                                            sector.cosine * sector.tangent;
    for (Bins left = before_[s]; left != 0; left &= left - 1) {
      const auto b = static_cast<std::size_t>(std::countr_zero(left));
      const auto tangent = [](std::size_t edge) {
        const double q = static_cast<double>(edge) / SunCells::bins;
        return q < 1 ? q / (1 - q) : infinite;
      };
      const double z = normal_.z > 0 ? tangent(b + 1) : tangent(b);
      if (most + (normal_.z != 0 ? normal_.z * z : 0) <= 0) before_[s] &= ~(Bins{1} << b);
    }
  }
}

/// Whether the box may reach into a cell that is not decided.
bool SkyView::may_matter(const Box& box) const {
  const Vec3 at = centre_of(box) - centre_, half = half_of(box);
  const Vec3 reach{half.x + half_.x + margin_, half.y + half_.y + margin_,
                   half.z + half_.z + margin_};
  const double up =
      std::abs(normal_.x) * half.x + std::abs(normal_.y) * half.y + std::abs(normal_.z) * half.z;
  if (dot(at, normal_) + up <= surely_below_offsets * blockers_.offset_m) return false;
  const double highest = at.z + reach.z;
  if (highest <= 0) return false;
  const double dx = std::max(0.0, std::abs(at.x) - reach.x),
               dy = std::max(0.0, std::abs(at.y) - reach.y);
  const double nearest = std::sqrt(dx * dx + dy * dy), lowest = at.z - reach.z;
  std::size_t first = 0, count = sectors;
  std::size_t high = SunCells::bins - 1;
  if (nearest > 0) {
    high = SunCells::bin_of(highest / nearest);
    Polygon frame;
    for (const double x : {-reach.x, reach.x})
      for (const double y : {-reach.y, reach.y}) frame.add({at.x + x, at.y + y, 0});
    const Sectors sectors_of_box = sectors_of(frame, 0);
    first = sectors_of_box.first;
    count = sectors_of_box.count;
  }
  const double fx = std::abs(at.x) + reach.x, fy = std::abs(at.y) + reach.y;
  const std::size_t low = lowest > 0 ? SunCells::bin_of(lowest / std::sqrt(fx * fx + fy * fy)) : 0;
  const Bins bits = SunCells::bits(low, high);
  for (std::size_t i = 0; i < count; ++i)
    if ((todo_[(first + i) % sectors] & bits) != 0) return true;
  return false;
}

/// Sectors of a convex thing that does not reach over the patch, seen from a disk about its centre.
SkyView::Sectors SkyView::sectors_of(const Polygon& thing, double aside) const {
  Vec3 right, left;
  for (std::size_t k = 0; k < thing.size; ++k) {
    const Vec3 v = thing.p[k];
    Vec3 to_right = v, to_left = v;
    if (aside > 0) {
      const double length2 = level_dot(v, v), sine = std::min(1.0, aside / std::sqrt(length2)),
                   cosine = std::sqrt(1 - sine * sine);
      to_right = {v.x * cosine + v.y * sine, v.y * cosine - v.x * sine, 0};
      to_left = {v.x * cosine - v.y * sine, v.y * cosine + v.x * sine, 0};
    }
    if (k == 0 || level_cross(right, to_right) < 0) right = to_right;
    if (k == 0 || level_cross(left, to_left) > 0) left = to_left;
  }
  const std::size_t first = SunCells::sector_of(right.x, right.y),
                    last = SunCells::sector_of(left.x, left.y);
  return {first, (last + sectors - first) % sectors + 1};
}

/// The tangents of elevation between which all three corners see the face in the direction of a
/// sector's first side; low > high: none.
SkyView::Extent SkyView::covered_at(const ConvexFace& face, std::size_t side) const {
  constexpr Extent nothing{1, 0};
  const Vec3 e = cells_.sector(side % sectors).first;
  Extent common{0, infinite};
  for (const Vec3 from : corner_) {
    Extent seen{infinite, -infinite};
    Vec3 p = face.corners.back() - centre_ - from;
    double beside = level_cross(e, p);
    for (const Vec3 corner : face.corners) {
      const Vec3 q = corner - centre_ - from;
      const double beside_q = level_cross(e, q);
      if ((beside < 0) != (beside_q < 0)) {
        const double t = beside / (beside - beside_q);
        const Vec3 at = p + (q - p) * t;
        const double ahead = level_dot(e, at);
        if (ahead <= near_offsets * blockers_.offset_m) return nothing;
        seen.low = std::min(seen.low, at.z / ahead);
        seen.high = std::max(seen.high, at.z / ahead);
      }
      p = q;
      beside = beside_q;
    }
    common.low = std::max(common.low, seen.low);
    common.high = std::min(common.high, seen.high);
    if (common.low >= common.high) return nothing;
  }
  return common;
}

/// Sets the cells that the face covers before all of the patch. Seen from one point, what a convex
/// face covers within a sector is convex, too: tangents that it covers on both sides of the sector
/// it covers between them, but for the sector's curvature.
void SkyView::cover(const ConvexFace& face) {
  Polygon outline;
  Vec3 middle{0, 0, 0};
  for (const Vec3 corner : face.corners) middle += corner - centre_;
  bool ahead = true;
  std::array<Vec3, 2> ends{middle, middle};  // farthest to the right and to the left
  for (const Vec3 corner : face.corners) {
    const Vec3 v = corner - centre_;
    ahead = ahead && level_dot(v, middle) > 0;
    if (level_cross(ends[0], v) < 0) ends[0] = v;
    if (level_cross(ends[1], v) > 0) ends[1] = v;
  }
  Sectors those{0, sectors};
  if (ahead) {
    for (const Vec3 end : ends) outline.add(end);
    those = sectors_of(outline, 0);
  }
  constexpr std::size_t none = sectors;
  std::size_t known = none;  // the side that `left` is of
  Extent right{}, left{};
  for (std::size_t i = 0; i < those.count; ++i) {
    const std::size_t s = (those.first + i) % sectors;
    if (todo_[s] == 0) continue;
    right = known == s ? left : covered_at(face, s);
    left = covered_at(face, s + 1);
    known = (s + 1) % sectors;
    const double cosine = cells_.sector(s).cosine;
    const Extent both{std::max(right.low, left.low) / cosine, std::min(right.high, left.high)};
    const bool some = right.low < right.high && left.low < left.high && both.low < both.high;
    if (!some || !is_surely_met(face, s, both)) continue;
    const auto first = static_cast<std::size_t>(std::ceil(SunCells::place_of(both.low))),
               end = static_cast<std::size_t>(SunCells::place_of(both.high));
    if (first >= end) continue;
    const Bins bits = SunCells::bits(first, end - 1) & before_[s];
    closed_[s] |= bits;
    reached_[s] |= bits;
    todo_[s] &= ~bits;
  }
}

/// No direction of these is so nearly along the face that rounding may carry a ray past it.
bool SkyView::is_surely_met(const ConvexFace& face, std::size_t sector, Extent tangents) const {
  double least = infinite, most = -infinite;
  for (const std::size_t side : {sector, (sector + 1) % sectors})
    for (const double tangent : {tangents.low, std::min(tangents.high, 1e6)}) {
      const Vec3 level = cells_.sector(side).first;
      const double sine =
          dot(face.normal, {level.x, level.y, tangent}) / std::sqrt(1 + tangent * tangent);
      least = std::min(least, sine);
      most = std::max(most, sine);
    }
  return least > least_incidence || most < -least_incidence;
}

/// The part where v·normal ≥ offset.
SkyView::Polygon SkyView::cut(const Polygon& thing, Vec3 normal, double offset) {
  Polygon left;
  if (thing.size == 0) return left;
  Vec3 p = thing.p[thing.size - 1];
  double above = dot(p, normal) - offset;
  for (std::size_t k = 0; k < thing.size; ++k) {
    const Vec3 q = thing.p[k];
    const double above_q = dot(q, normal) - offset;
    if ((above < 0) != (above_q < 0)) left.add(p + (q - p) * (above / (above - above_q)));
    if (above_q >= 0) left.add(q);
    p = q;
    above = above_q;
  }
  return left;
}

/// Sets the cells into which the triangle reaches as seen from any point of the patch.
void SkyView::block(std::size_t triangle) {
  Polygon thing;
  for (std::size_t k = 0; k < 3; ++k) thing.add(blockers_.triangles.corner(triangle, k) - centre_);
  const double least = surely_below_offsets * blockers_.offset_m;
  std::size_t above = 0;
  for (std::size_t k = 0; k < 3; ++k) above += dot(thing.p[k], normal_) >= least;
  if (above == 0) return;
  if (above < 3) thing = cut(thing, normal_, least);
  const double aside = radius_ + margin_;
  const Sectors those =
      level_distance(thing) > aside ? sectors_of(thing, aside) : Sectors{0, sectors};
  for (std::size_t i = 0; i < those.count; ++i) {
    const std::size_t s = (those.first + i) % sectors;
    if (todo_[s] != 0) block_in(s, thing);
  }
}

/// From the centre, as on a map.
double SkyView::level_distance(const Polygon& thing) {
  double nearest2 = infinite, least = infinite, most = -infinite;
  for (std::size_t k = 0; k < thing.size; ++k) {
    const Vec3 p = thing.p[k], way = thing.p[(k + 1) % thing.size] - p;
    const double length2 = level_dot(way, way);
    const double t = length2 > 0 ? std::clamp(-level_dot(p, way) / length2, 0.0, 1.0) : 0;
    const Vec3 at = p + way * t;
    nearest2 = std::min(nearest2, level_dot(at, at));
    const double side = level_cross(p, way);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  const bool is_round_the_centre = least >= 0 || most <= 0;
  return is_round_the_centre ? 0 : std::sqrt(nearest2);
}

void SkyView::block_in(std::size_t s, const Polygon& thing) {
  const auto& sector = cells_.sector(s);
  const auto [nearest, farthest] = along_[s];
  const auto [right, left] = across_[s];
  const double t = sector.tangent, wide = margin_ * (1 + t);
  Polygon part = cut(thing, sector.middle, nearest - margin_);
  part = cut(part, sector.middle * t - sector.left, t * nearest - left - wide);
  part = cut(part, sector.middle * t + sector.left, t * nearest + right - wide);
  double low = infinite, high = -infinite;
  for (std::size_t k = 0; k < part.size; ++k) {
    const Vec3 v = part.p[k];
    const double along = level_dot(v, sector.middle), far = along - nearest + margin_,
                 near = along - farthest - margin_;
    const double over_lowest = v.z + half_.z + margin_, over_highest = v.z - half_.z - margin_;
    if (over_lowest > 0) high = std::max(high, near > 0 ? over_lowest / near : infinite);
    low = std::min(low, over_highest <= 0 ? 0 : far > 0 ? over_highest / far : infinite);
  }
  if (high < 0) return;
  const Bins bits =
      SunCells::bits(SunCells::bin_of(std::min(low, high) * sector.cosine), SunCells::bin_of(high));
  reached_[s] |= bits;
  todo_[s] &= ~bits;
}

}  // namespace sunload
