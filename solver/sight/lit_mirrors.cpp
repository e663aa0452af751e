// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/lit_mirrors.h"

#include <algorithm>
#include <utility>

#include "solver/sight/lit_area.h"
#include "solver/sight/view_cut.h"

namespace sunload {

namespace {

BoxGrid grid_of(const std::vector<LitPart>& parts) {
  std::vector<ViewBox> boxes;
  boxes.reserve(parts.size());
  for (const LitPart& part : parts) boxes.push_back(box_of(part.polygon));
  return BoxGrid(std::move(boxes));
}

/// One plane's mirrors before one sun.
class PlaneBeforeSun {
 public:
  PlaneBeforeSun(const MirrorPlane& plane, const ViewFrame& sun, const ViewFrame& image)
      : plane_(plane), sun_(sun), image_(image) {}

  /// Appends the parts of one mirror that the sun lights.
  void add(const MirrorFace& face, double reflectance, const MirrorShades& shades,
           std::vector<LitPart>& parts) {
    const ViewPolygon mirror = FlatPolygon(face.corners).seen(sun_);
    if (mirror.area() <= 0) return;
    if (face.is_screen) return add(mirror, reflectance, false, parts);
    near_.clear();
    shades.visit(box_of(mirror), [&](const FaceOutline& shade) { near_.push_back(&shade); });
    std::sort(near_.begin(), near_.end(), LargestFirst());
    covered_.clear();
    for (const auto other : face.covered_by)
      covered_.push_back(FlatPolygon(plane_.faces[other].corners).seen(sun_));
    cover_.clear();
    screens_.clear();
    for (const ViewPolygon& other : covered_) cover_.push_back(&other);
    for (const FaceOutline* shade : near_)
      (shade->is_solid ? cover_ : screens_).push_back(&shade->polygon);
    if (!area_.parts(mirror, cover_, lit_)) return add(mirror, reflectance, false, parts);
    for (const ViewPolygon& part : lit_)
      add(part, reflectance, !any_reaches_into(screens_, part), parts);
  }

 private:
  /// From across the sun's light to across that of its image, by way of the plane.
  void add(const ViewPolygon& part, double reflectance, bool is_certain,
           std::vector<LitPart>& parts) const {
    const Vec3 normal = plane_.before.normal;
    const double along_x = dot(normal, sun_.x), along_y = dot(normal, sun_.y),
                 along_sun = dot(normal, sun_.to_sun);
    ViewPolygon seen;
    for (std::size_t i = part.size(); i > 0; --i) {  // mirrored: the other way round
      const auto [x, y] = part[i - 1];
      const double h = (plane_.before.offset - x * along_x - y * along_y) / along_sun;
      const Vec3 p = x * sun_.x + y * sun_.y + h * sun_.to_sun;
      seen.add({dot(p, image_.x), dot(p, image_.y)});
    }
    if (seen.area() > 0) parts.push_back({seen, reflectance, is_certain});
  }

  const MirrorPlane& plane_;
  const ViewFrame& sun_;
  const ViewFrame& image_;
  std::vector<const FaceOutline*> near_;
  std::vector<const ViewPolygon*> cover_, screens_;
  std::vector<ViewPolygon> covered_, lit_;
  LitArea area_;
};

}  // namespace

LitPlane::LitPlane(const FaceTree& tree, const ViewFrame& image, const HalfSpace& before,
                   double offset_m, std::vector<LitPart> parts)
    : before_(before),
      parts_(std::move(parts)),
      grid_(grid_of(parts_)),
      shades_(tree, image, grid_.all(), {before.normal, before.offset + offset_m}) {}

LitMirrors::LitMirrors(const MirrorGroups& groups, const MirrorPlanes& planes, const FaceTree& tree,
                       double offset_m, const MirroredSun& by_mirrors, Vec3 direction)
    : frame_(by_mirrors.image) {
  const double cos_theta = -dot(groups[by_mirrors.group].normal, by_mirrors.image);
  const ViewFrame sun(direction);
  std::vector<std::int32_t> not_dark(by_mirrors.triangles.begin(), by_mirrors.triangles.end());
  std::sort(not_dark.begin(), not_dark.end());
  const auto may_see = [&](std::int32_t triangle) {
    return std::binary_search(not_dark.begin(), not_dark.end(), triangle);
  };
  for (const MirrorPlane& plane : planes.of_group(by_mirrors.group)) {
    if (dot(plane.before.normal, direction) <= 0) continue;
    std::vector<const MirrorFace*> faces;
    ViewBox box;
    for (const MirrorFace& face : plane.faces) {
      if (std::none_of(face.triangles.begin(), face.triangles.end(), may_see)) continue;
      faces.push_back(&face);
      for (const Vec3& p : face.corners) box.include({dot(p, sun.x), dot(p, sun.y)});
    }
    if (faces.empty()) continue;
    const MirrorShades shades(tree, sun, box,
                              {plane.before.normal, plane.before.offset + offset_m});
    PlaneBeforeSun before_sun(plane, sun, frame_);
    std::vector<LitPart> parts;
    for (const MirrorFace* face : faces)
      if (const double reflectance = groups.reflectance(face->triangles.front(), cos_theta);
          reflectance > 0)
        before_sun.add(*face, reflectance, shades, parts);
    if (parts.empty()) continue;
    planes_.emplace_back(tree, frame_, plane.before, offset_m, std::move(parts));
    box_.include_box(planes_.back().box());
  }
}

}  // namespace sunload
