// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The faces before mirrors of one plane as they stand in light along one direction, that of the
/// sun or of its image. For suns that shine on all of a scene solver/sight/sun_view.h lists faces
/// once; here a tree finds those that stand in some of the light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "solver/sight/box_grid.h"
#include "solver/sight/flat_polygon.h"
#include "solver/sight/sun_faces.h"

namespace sunload {

/// What of a face lies before planes, seen along the light.
struct FaceOutline {
  ViewPolygon polygon;
  ViewBox box;
  double area = 0;  ///< [m2]
  std::uint32_t face = 0;
  bool is_solid = true;  ///< no light passes it; of others rays must tell
};

/// All faces of a scene in boxes; const, and may be asked from any thread.
class FaceTree {
 public:
  /// `faces` must outlive it.
  explicit FaceTree(const SunFaces& faces);
  const SunFaces& faces() const { return faces_; }
  const BoxTree& boxes() const { return boxes_; }

 private:
  const SunFaces& faces_;
  BoxTree boxes_;
};

/// Those that meet a box across the light, and have some part before the mirrors. Of a closed body
/// only what looks along the light is named (SunFaces::is_needed): a mirror that sees the sun lies
/// within none. Const, and may be asked from any thread.
class MirrorShades {
 public:
  /// `tree` must outlive it. `frame`: towards the sun, or towards the mirrors.
  MirrorShades(const FaceTree& tree, const ViewFrame& frame, const ViewBox& box,
               const HalfSpace& before);
  /// Calls `visit` with each outline whose box meets another.
  template <class Visit>
  void visit(const ViewBox& box, const Visit& visit) const {
    grid_.visit(box, [&](std::size_t i) { visit(outlines_[i]); });
  }
  /// What of an outline's face lies before another plane, too; false: nothing. `part` is made where
  /// it is not all of the outline.
  enum class Before { none, all, part };
  Before part_before(const HalfSpace& plane, const FaceOutline& outline, FaceOutline& part) const;

 private:
  bool make_outline(std::uint32_t face, std::span<const HalfSpace> planes, FaceOutline& made) const;

  const FaceTree& tree_;
  ViewFrame frame_;
  HalfSpace before_;
  std::vector<FaceOutline> outlines_;
  BoxGrid grid_;
};

}  // namespace sunload
