// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What of the mirrors of one orientation a sun lights, as receivers see it along the sun's image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/sight/box_grid.h"
#include "solver/sight/mirror_planes.h"
#include "solver/sight/mirror_shades.h"

namespace sunload {

/// A sun by way of mirrors of one orientation.
struct MirroredSun {
  std::size_t group;
  std::span<const std::int32_t> triangles;  ///< of the group: those that may see the sun
  Vec3 image;                               ///< direction in which receivers see it
};

/// A convex part of a mirror that the sun lights.
struct LitPart {
  ViewPolygon polygon;
  double reflectance;
  bool is_certain;  ///< else rays must tell what of it is lit
};

/// Such parts of mirrors of one plane, and what stands before them in the light that they send on.
class LitPlane {
 public:
  LitPlane(const FaceTree& tree, const ViewFrame& image, const HalfSpace& before, double offset_m,
           std::vector<LitPart> parts);
  const HalfSpace& before() const { return before_; }  ///< where the mirrors reflect
  const ViewBox& box() const { return grid_.all(); }   ///< of all parts
  const MirrorShades& shades() const { return shades_; }
  /// Calls `visit` with each part whose box meets another.
  template <class Visit>
  void visit(const ViewBox& box, const Visit& visit) const {
    grid_.visit(box, [&](std::size_t i) { visit(parts_[i]); });
  }

 private:
  HalfSpace before_;
  std::vector<LitPart> parts_;
  BoxGrid grid_;
  MirrorShades shades_;
};

/// All of them, plane by plane.
class LitMirrors {
 public:
  /// `offset_m`: of the ray caster; what is nearer to a mirror than that does not shade it.
  LitMirrors(const MirrorGroups& groups, const MirrorPlanes& planes, const FaceTree& tree,
             double offset_m, const MirroredSun& by_mirrors, Vec3 sun);
  const ViewFrame& frame() const { return frame_; }  ///< across the image's light
  const std::vector<LitPlane>& planes() const { return planes_; }
  const ViewBox& box() const { return box_; }  ///< of all parts

 private:
  ViewFrame frame_;
  std::vector<LitPlane> planes_;
  ViewBox box_;
};

}  // namespace sunload
