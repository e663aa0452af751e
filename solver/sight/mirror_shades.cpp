// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/mirror_shades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/sight/view_cut.h"

namespace sunload {

namespace {

BoxTree tree_of(const SunFaces& faces) {
  std::vector<Box> boxes(faces.count());
  for (std::size_t f = 0; f < faces.count(); ++f)
    for (const Vec3& corner : faces.corners(f)) include(boxes[f], corner);
  return BoxTree(std::move(boxes));
}

/// Boxes that may have something in the light before the plane.
class MayReach {
 public:
  MayReach(const ViewFrame& frame, const ViewBox& box, const HalfSpace& before)
      : frame_(frame), box_(box), before_(before) {}
  bool operator()(const Box& b) const {
    const Vec3 centre = centre_of(b), half = half_of(b);
    const auto reach = [&](Vec3 along) {
      return std::abs(along.x) * half.x + std::abs(along.y) * half.y + std::abs(along.z) * half.z;
    };
    const double x = dot(frame_.x, centre), by_x = reach(frame_.x);
    if (x + by_x < box_.x0 || x - by_x > box_.x1) return false;
    const double y = dot(frame_.y, centre), by_y = reach(frame_.y);
    if (y + by_y < box_.y0 || y - by_y > box_.y1) return false;
    return before_.above(centre) + reach(before_.normal) > 0;
  }

 private:
  const ViewFrame& frame_;
  const ViewBox& box_;
  const HalfSpace& before_;
};

ViewBox box_across(std::span<const Vec3> corners, const ViewFrame& frame) {
  ViewBox box;
  for (const Vec3& p : corners) box.include({dot(p, frame.x), dot(p, frame.y)});
  return box;
}

}  // namespace

FaceTree::FaceTree(const SunFaces& faces) : faces_(faces), boxes_(tree_of(faces)) {}

MirrorShades::MirrorShades(const FaceTree& tree, const ViewFrame& frame, const ViewBox& box,
                           const HalfSpace& before)
    : tree_(tree), frame_(frame), before_(before) {
  const SunFaces& faces = tree.faces();
  std::vector<std::int32_t> found;
  tree.boxes().collect(MayReach(frame_, box, before_), std::numeric_limits<std::size_t>::max(),
                       found);
  std::vector<ViewBox> boxes;
  for (const std::int32_t number : found) {
    const auto face = static_cast<std::uint32_t>(number);
    if (!faces.is_needed(face, frame_.to_sun, 0)) continue;
    if (box_across(faces.corners(face), frame_).is_apart_from(box, 0, 0)) continue;
    outlines_.emplace_back();
    const bool has_area = make_outline(face, std::span(&before_, 1), outlines_.back());
    if (has_area && !outlines_.back().box.is_apart_from(box, 0, 0))
      boxes.push_back(outlines_.back().box);
    else
      outlines_.pop_back();
  }
  grid_ = BoxGrid(std::move(boxes));
}

MirrorShades::Before MirrorShades::part_before(const HalfSpace& plane, const FaceOutline& outline,
                                               FaceOutline& part) const {
  const SunFaces::Sphere& sphere = tree_.faces().sphere(outline.face);
  const double above = plane.above(sphere.centre);
  if (above <= -sphere.radius) return Before::none;
  if (above > sphere.radius) return Before::all;
  const auto corners = tree_.faces().corners(outline.face);
  const auto is_above = [&](const Vec3& corner) { return plane.above(corner) > 0; };
  if (std::all_of(corners.begin(), corners.end(), is_above)) return Before::all;
  const std::array planes{before_, plane};
  return make_outline(outline.face, planes, part) ? Before::part : Before::none;
}

/// False where it has no area.
bool MirrorShades::make_outline(std::uint32_t face, std::span<const HalfSpace> planes,
                                FaceOutline& made) const {
  FlatPolygon kept(tree_.faces().corners(face));
  made.face = face;
  made.is_solid = !tree_.faces().is_screen(face);
  made.polygon.clear();
  for (const HalfSpace& plane : planes) {
    const FlatPolygon::Kept part = kept.keep_before(plane);
    if (part == FlatPolygon::Kept::none) return false;
    if (part == FlatPolygon::Kept::too_many_corners) made.is_solid = false;
  }
  made.polygon = kept.seen(frame_);
  made.box = box_of(made.polygon);
  made.area = made.polygon.area();
  return made.area > 0;
}

}  // namespace sunload
