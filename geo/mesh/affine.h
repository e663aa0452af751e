// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Placements of shapes within shapes: transformations of VRML, glTF and city models.
#pragma once

#include <array>

#include "geo/base/vec.h"

namespace sunload {

/// x ↦ axes·x + origin, composed like functions: (a * b)(x) = a(b(x)).
struct Affine {
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< images of the axes
  Vec3 origin;

  Vec3 operator()(Vec3 p) const { return direction(p) + origin; }
  Vec3 direction(Vec3 v) const { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; }
  double determinant() const { return dot(axes[0], cross(axes[1], axes[2])); }
  friend Affine operator*(const Affine& a, const Affine& b) {
    return {{a.direction(b.axes[0]), a.direction(b.axes[1]), a.direction(b.axes[2])}, a(b.origin)};
  }
};

}  // namespace sunload
