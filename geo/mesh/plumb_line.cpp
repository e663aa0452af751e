// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/plumb_line.h"

#include "geo/mesh/constrained_delaunay.h"

namespace sunload {

int plumb_crossing(const std::array<Vec3, 3>& corners, double x, double y) {
  const PlanKernel::Point_2 p(x, y);
  int positive = 0, negative = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = corners[k], b = corners[(k + 1) % 3];
    int side = CGAL::orientation(PlanKernel::Point_2(a.x, a.y), PlanKernel::Point_2(b.x, b.y), p);
    if (side == 0)
      side = a.y != b.y ? (a.y > b.y ? 1 : -1) : (a.x != b.x ? (b.x > a.x ? 1 : -1) : 0);
    if (side == 0) return 0;
    ++(side > 0 ? positive : negative);
  }
  return positive == 3 ? 1 : (negative == 3 ? -1 : 0);
}

}  // namespace sunload
