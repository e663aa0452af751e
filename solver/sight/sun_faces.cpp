// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_faces.h"

#include <algorithm>

#include "solver/sight/convex_faces.h"

namespace sunload {

SunFaces::SunFaces(const Scene& scene, double flat_m) {
  const Occluders occluders(scene.mesh, screens(scene).transmittance);
  const std::vector<Closed> bodies = closed_bodies(occluders);
  for (const ConvexFace& face : convex_faces(occluders, flat_m, most_corners))
    add(face.corners, face.normal, false, bodies[face.triangles.front()]);
  for (std::size_t t = 0; t < occluders.triangle_count(); ++t) {
    const Vec3 a = occluders.corner(t, 0), b = occluders.corner(t, 1), c = occluders.corner(t, 2);
    const Vec3 area2 = cross(b - a, c - a);
    if (!occluders.is_screen(t) || norm(area2) <= 0) continue;
    add({a, b, c}, normalized(area2), true, Closed::no);
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
