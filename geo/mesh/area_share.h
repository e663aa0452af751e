// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Of the area of all triangles, that of those for whose number `property` holds; 0 of none.
template <class Property>
double area_share(const Mesh& mesh, const Property& property) {
  double area = 0, with_it = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double of_triangle = norm(mesh.area_vector2(t));
    area += of_triangle;
    if (property(t)) with_it += of_triangle;
  }
  return area > 0 ? with_it / area : 0;
}

}  // namespace sunload
