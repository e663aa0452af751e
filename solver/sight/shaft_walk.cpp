// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/shaft_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunload {

namespace {

constexpr double lateral = lateral_offsets, surely_below = surely_below_offsets;
/// Above the origins of all rays, in offsets, where a surface faces the sun; as much more as it is
/// seen edge-on.
constexpr double surely_above = 2;
/// Blockers of an element's shaft for each of its patches beyond which rays cost less.
constexpr std::size_t most_per_patch = 16;

}  // namespace

OutlinePoint ShaftWalk::project(Vec3 p) const {
  const Vec3 d = p - base_;
  return {dot(d, across_x_), dot(d, across_y_), dot(d, normal_), -1};
}

Outline ShaftWalk::outline_of(Element element) const {
  Outline outline;
  for (const auto vertex : shafts_.corners(element))
    outline.add(project(shafts_.hierarchy().vertices()[static_cast<std::size_t>(vertex)]));
  outline.close();
  return outline;
}

double ShaftWalk::facing(std::size_t triangle) const {
  const Occluders& o = shafts_.occluders();
  const Vec3 a = o.corner(triangle, 1) - o.corner(triangle, 0),
             b = o.corner(triangle, 2) - o.corner(triangle, 0), c = b - a;
  const double longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
  return longest > 0 ? dot(cross(a, b), sun_) / longest : 0;
}

void ShaftWalk::run(Element group, const IntervalLight& sun, std::size_t k) {
  column_ = k;
  if (!face(group, sun) || !collect(group)) return;
  if (in_shaft_.empty()) in_shaft_.resize(1);
  in_shaft_[0].clear();
  for (std::uint32_t b = 0; b < blockers_.size(); ++b) in_shaft_[0].push_back(b);
  walk(group, 0);
}

/// The frame of the shaft. False where the sun is down, behind or grazes.
bool ShaftWalk::face(Element group, const IntervalLight& sun) {
  if (!sun.has_sun()) return false;
  const auto& vertices = shafts_.hierarchy().vertices();
  std::array<Vec3, 3> corner;
  for (std::size_t c = 0; c < 3; ++c)
    corner[c] = vertices[static_cast<std::size_t>(shafts_.corners(group)[c])];
  // Halves are turned as it happens; the patch knows its own side.
  Element patch = group;
  while (patch >= shafts_.hierarchy().patch_count())
    patch = shafts_.hierarchy().halves_of(patch - shafts_.hierarchy().patch_count())[0];
  normal_ = shafts_.hierarchy().normal(patch);
  spread_ = sun.disk_half_angle > 0 ? std::tan(sun.disk_half_angle) : 0;
  if (dot(normal_, sun.direction) <= spread_ + least_facing) return false;
  sun_ = sun.direction;
  base_ = corner[0];
  const Tangents axes = tangents(sun_);
  across_x_ = axes.tangent;
  across_y_ = axes.bitangent;
  nearest_ = std::min({depth_of(corner[0]), depth_of(corner[1]), depth_of(corner[2])});
  group_ = outline_of(group);
  return true;
}

/// False where there are so many that rays are cheaper.
bool ShaftWalk::collect(Element group) {
  const double offset = shafts_.offset_m(), margin = lateral * offset;
  struct Plane {
    Vec3 normal, width;
    double offset;
  };
  std::array<Plane, 3> sides;
  const auto absolute = [](Vec3 v) { return Vec3{std::abs(v.x), std::abs(v.y), std::abs(v.z)}; };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& line = group_.line(i);
    const Vec3 n = across_x_ * line.x + across_y_ * line.y;
    sides[i] = {n, absolute(n), line.offset};
  }
  const Vec3 up_width = absolute(normal_), depth_width = absolute(sun_);
  const auto meets = [&](const Box& box) {
    const Vec3 d = centre_of(box) - base_, half = half_of(box);
    if (dot(d, normal_) + dot(half, up_width) <= surely_below * offset) return false;
    const double farthest = dot(d, sun_) + dot(half, depth_width) - nearest_;
    const double reach = margin + spread_ * std::max(farthest, 0.0);
    for (const auto& side : sides)
      if (dot(d, side.normal) - dot(half, side.width) - side.offset > reach) return false;
    return true;
  };
  triangles_.clear();
  blockers_.clear();
  strips_.clear();
  const std::size_t most = most_per_patch * shafts_.patches_in(group);
  if (!shafts_.occluders().tree().collect(meets, most, triangles_)) return false;
  std::sort(triangles_.begin(), triangles_.end());
  for (const auto triangle : triangles_) add_blocker(triangle);
  sheet_.resize(blockers_.size());
  ends_.resize(blockers_.size());
  asked_for_.assign(blockers_.size(), 0);
  question_ = 0;
  return true;
}

void ShaftWalk::add_blocker(std::int32_t triangle) {
  const auto t = static_cast<std::size_t>(triangle);
  const Occluders& occluders = shafts_.occluders();
  const double offset = shafts_.offset_m();
  Outline outline;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, farthest = -lowest;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 corner = occluders.corner(t, c);
    OutlinePoint p = project(corner);
    p.edge = static_cast<int>(c);
    lowest = std::min(lowest, p.height);
    highest = std::max(highest, p.height);
    farthest = std::max(farthest, depth_of(corner));
    outline.add(p);
  }
  const double margin = lateral * offset + spread_ * std::max(farthest - nearest_, 0.0);
  if (highest <= surely_below * offset || group_.keeps_off(outline, margin)) return;
  outline.close();
  if (lowest < surely_below * offset) outline = outline.above(surely_below * offset);
  if (outline.size() < 3 || apart(outline, group_, margin)) return;
  const double faces = std::abs(facing(t));
  const bool sure = occluders.is_opaque(t) && faces > spread_ + least_facing;
  std::int32_t strip = none;
  const double safe = sure ? (surely_above + 1 / faces) * offset : 0;
  if (sure && lowest < safe) {
    strip = static_cast<std::int32_t>(strips_.size());
    strips_.push_back(outline.below(safe));
  }
  blockers_.push_back({outline, triangle, strip, sure, margin, {}});
  blockers_.back().beyond.fill(not_asked);
}

void ShaftWalk::walk(Element element, std::size_t depth) {
  const Outline target = depth == 0 ? group_ : outline_of(element);
  if (depth > 0) {
    if (in_shaft_.size() <= depth) in_shaft_.resize(depth + 1);
    auto& inside = in_shaft_[depth];
    inside.clear();
    for (const auto b : in_shaft_[depth - 1])
      if (!apart(blockers_[b].outline, target, blockers_[b].margin)) inside.push_back(b);
  }
  if (in_shaft_[depth].empty()) return tell(element, SunSight::open);
  if (in_shaft_[depth].size() > most_per_patch * shafts_.patches_in(element)) return;
  if (covers(target, in_shaft_[depth])) return tell(element, SunSight::closed);
  const std::size_t patches = shafts_.hierarchy().patch_count();
  if (element < patches) return;
  for (const auto half : shafts_.hierarchy().halves_of(element - patches)) walk(half, depth + 1);
}

std::uint32_t ShaftWalk::sheet(std::uint32_t blocker) const {
  while (sheet_[blocker] != blocker) blocker = sheet_[blocker] = sheet_[sheet_[blocker]];
  return blocker;
}

/// Whether a sheet of sure blockers without an end in the shaft has the target's middle behind it.
bool ShaftWalk::covers(const Outline& target, std::span<const std::uint32_t> blockers) {
  ++question_;
  for (const auto b : blockers) {
    sheet_[b] = b;
    asked_for_[b] = question_;
    const Blocker& it = blockers_[b];
    ends_[b] = !it.sure || (it.strip >= 0 &&
                            !apart(strips_[static_cast<std::size_t>(it.strip)], target, it.margin));
  }
  for (const auto b : blockers)
    for (std::size_t edge = 0; !ends_[b] && edge < blockers_[b].outline.size(); ++edge)
      if (!edge_apart(blockers_[b].outline, edge, target, blockers_[b].margin))
        join_across(b, edge);
  // What ends was not joined further; its neighbours were joined with it.
  for (const auto b : blockers)
    if (ends_[b]) ends_[sheet(b)] = 1;
  const double x = (target[0].x + target[1].x + target[2].x) / 3,
               y = (target[0].y + target[1].y + target[2].y) / 3;
  return std::any_of(blockers.begin(), blockers.end(), [&](std::uint32_t b) {
    return !ends_[sheet(b)] && blockers_[b].outline.contains(x, y);
  });
}

void ShaftWalk::join_across(std::uint32_t blocker, std::size_t edge) {
  const std::int32_t other = beyond(blocker, edge);
  if (other < 0 || asked_for_[static_cast<std::size_t>(other)] != question_) {
    ends_[blocker] = 1;
    return;
  }
  const std::uint32_t a = sheet(blocker), b = sheet(static_cast<std::uint32_t>(other));
  sheet_[std::max(a, b)] = std::min(a, b);
}

std::int32_t ShaftWalk::beyond(std::uint32_t blocker, std::size_t edge) {
  std::int32_t& known = blockers_[blocker].beyond[edge];
  if (known == not_asked) known = find_beyond(blockers_[blocker], edge);
  return known;
}

/// A sure blocker that has the same edge, and lies on its other side as the sun sees it.
std::int32_t ShaftWalk::find_beyond(const Blocker& blocker, std::size_t edge) const {
  const int of_triangle = blocker.outline[edge].edge;
  if (of_triangle < 0) return none;
  const Occluders& occluders = shafts_.occluders();
  const auto t = static_cast<std::size_t>(blocker.triangle);
  const auto k = static_cast<std::size_t>(of_triangle);
  const Vec3 a = occluders.corner(t, k), b = occluders.corner(t, (k + 1) % 3);
  const Vec3 side = cross(b - a, sun_);
  const bool own = dot(occluders.beside_edge(t, t, k) - a, side) > 0;
  for (const auto other : occluders.at_edge(t, k)) {
    const auto o = static_cast<std::size_t>(other);
    if (o == t || (dot(occluders.beside_edge(o, t, k) - a, side) > 0) == own) continue;
    const auto found =
        std::lower_bound(blockers_.begin(), blockers_.end(), other,
                         [](const Blocker& x, std::int32_t y) { return x.triangle < y; });
    if (found != blockers_.end() && found->triangle == other && found->sure)
      return static_cast<std::int32_t>(found - blockers_.begin());
  }
  return none;
}

void ShaftWalk::tell(Element element, SunSight sight) {
  const std::size_t patches = shafts_.hierarchy().patch_count();
  if (element < patches) {
    sights_[element * block_width + column_] = sight;
    return;
  }
  for (const auto half : shafts_.hierarchy().halves_of(element - patches)) tell(half, sight);
}

}  // namespace sunload
