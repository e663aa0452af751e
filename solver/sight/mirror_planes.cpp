// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/mirror_planes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geo/mesh/box_tree.h"
#include "solver/sight/convex_faces.h"
#include "solver/sight/sun_faces.h"
#include "solver/sight/view_cut.h"

namespace sunload {

namespace {

/// Planes of one group, found by their distance from the origin.
class PlanesByOffset {
 public:
  PlanesByOffset(double flat_m, std::vector<MirrorPlane>& planes)
      : flat_(flat_m), planes_(planes) {}
  MirrorPlane& of(std::span<const Vec3> corners, Vec3 normal) {
    const HalfSpace own{normal, dot(normal, corners[0])};
    const auto last = numbers_.upper_bound(own.offset + flat_);
    for (auto it = numbers_.lower_bound(own.offset - flat_); it != last; ++it) {
      const HalfSpace& plane = planes_[it->second].before;
      if (std::all_of(corners.begin(), corners.end(),
                      [&](Vec3 p) { return std::abs(plane.above(p)) <= flat_; }))
        return planes_[it->second];
    }
    numbers_.emplace(own.offset, planes_.size());
    planes_.push_back({own, {}});
    return planes_.back();
  }

 private:
  double flat_;
  std::vector<MirrorPlane>& planes_;
  std::multimap<double, std::size_t> numbers_;
};

/// Whether two convex polygons of a plane have more in common than an edge.
bool overlap(std::span<const Vec3> a, std::span<const Vec3> b, const ViewFrame& frame) {
  constexpr double least_share = 1e-6;
  const ViewPolygon other = FlatPolygon(b).seen(frame);
  ViewPolygon common = FlatPolygon(a).seen(frame);
  const double least = least_share * std::min(common.area(), other.area());
  return !keep_within(common, other) || (common.has_area() && common.area() > least);
}

void find_covered(MirrorPlane& plane) {
  std::vector<Box> boxes(plane.faces.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (const Vec3& corner : plane.faces[i].corners) include(boxes[i], corner);
  const BoxTree tree(boxes);
  const ViewFrame frame(plane.before.normal);
  for (std::size_t i = 0; i < plane.faces.size(); ++i) {
    MirrorFace& face = plane.faces[i];
    tree.visit_meeting(boxes[i], [&](std::size_t j) {
      if (j < i && overlap(face.corners, plane.faces[j].corners, frame))
        face.covered_by.push_back(static_cast<std::uint32_t>(j));
    });
    std::sort(face.covered_by.begin(), face.covered_by.end());
  }
}

/// The triangles of a group that are of one material, fronts as they reflect.
struct Mirrors {
  Mesh mesh;  ///< vertices and triangles alone
  std::vector<std::int32_t> triangles;
};
Mirrors mirrors_of(const MirrorGroups& groups, std::size_t group, MaterialId material) {
  const Scene& scene = groups.scene();
  Mirrors mirrors;
  for (const std::int32_t triangle : groups[group].triangles) {
    const auto t = static_cast<std::size_t>(triangle);
    if (scene.material[t] != material) continue;
    const auto first = static_cast<std::int32_t>(mirrors.mesh.vertices.size());
    for (int k = 0; k < 3; ++k) mirrors.mesh.vertices.push_back(scene.mesh.corner(t, k));
    const bool front = groups.of_side(triangle, true) == static_cast<std::int32_t>(group);
    mirrors.mesh.triangles.push_back({first, first + (front ? 1 : 2), first + (front ? 2 : 1)});
    mirrors.triangles.push_back(triangle);
  }
  return mirrors;
}

}  // namespace

MirrorPlanes::MirrorPlanes(const MirrorGroups& groups, double flat_m) : planes_(groups.size()) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    PlanesByOffset planes(flat_m, planes_[g]);
    for (const MaterialId material : groups[g].materials) {
      const Mirrors mirrors = mirrors_of(groups, g, material);
      const bool is_screen = groups.scene().materials[material.index()].transmittance > 0;
      for (const ConvexFace& face :
           convex_faces(Occluders(mirrors.mesh, {}), flat_m, SunFaces::most_corners)) {
        MirrorFace mirror{face.corners, {}, {}, is_screen};
        for (const auto i : face.triangles) mirror.triangles.push_back(mirrors.triangles[i]);
        planes.of(face.corners, face.normal).faces.push_back(std::move(mirror));
      }
    }
    for (MirrorPlane& plane : planes_[g]) find_covered(plane);
  }
}

}  // namespace sunload
