// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_faces.h"

#include <algorithm>
#include <utility>

#include "solver/sight/convex_faces.h"

namespace sunload {

namespace {

/// Cores keep so many times the flatness of faces from them.
constexpr double core_depths = 16;

}  // namespace

SunFaces::SunFaces(const Scene& scene, double flat_m) {
  const Occluders occluders(scene.mesh, screens(scene).transmittance);
  const ClosedBodies bodies = closed_bodies(occluders);
  const std::vector<ConvexFace> faces = convex_faces(occluders, flat_m, most_corners);
  of_triangle_.assign(occluders.triangle_count(), none);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    add(faces[f].corners, faces[f].normal, false, bodies.turned[faces[f].triangles.front()]);
    for (const auto triangle : faces[f].triangles) of_triangle_[triangle] = f;
  }
  for (std::size_t t = 0; t < occluders.triangle_count(); ++t) {
    const Vec3 a = occluders.corner(t, 0), b = occluders.corner(t, 1), c = occluders.corner(t, 2);
    const Vec3 area2 = cross(b - a, c - a);
    if (!occluders.is_screen(t) || norm(area2) <= 0) continue;
    add({a, b, c}, normalized(area2), true, Closed::no);
  }
  face_count_ = normal_.size();
  for (BodyCore& core : body_cores(occluders, bodies, faces, core_depths * flat_m)) {
    add(core.corners, {0, 0, 0}, false, Closed::no);
    edges_of_core_.push_back(std::move(core.edges));
  }
}

void SunFaces::add(const std::vector<Vec3>& corners, Vec3 normal, bool is_screen, Closed body) {
  corner_.insert(corner_.end(), corners.begin(), corners.end());
  begin_.push_back(static_cast<std::uint32_t>(corner_.size()));
  normal_.push_back(normal);
  is_screen_.push_back(is_screen);
  Vec3 centre{0, 0, 0};
  for (const Vec3& corner : corners) centre += corner / static_cast<double>(corners.size());
  double radius = 0;
  top_.push_back(-1e300);
  for (const Vec3& corner : corners) {
    radius = std::max(radius, norm(corner - centre));
    top_.back() = std::max(top_.back(), corner.z);
  }
  top_of_all_ = std::max(top_of_all_, top_.back());
  sphere_.push_back({centre, radius});
  body_.push_back(body);
}

}  // namespace sunload
