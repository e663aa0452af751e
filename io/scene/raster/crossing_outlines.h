// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons whose outline crosses or touches itself: walls on it would look outward on one side of
/// the crossing and inward on the other.
#pragma once

#include <memory>

#include "io/base/gdal.h"

namespace sunload {

struct DestroyGeometry {
  void operator()(void* geometry) const { gdal::OGR_G_DestroyGeometry(geometry); }
};
using GdalGeometry = std::unique_ptr<void, DestroyGeometry>;

/// One of the polygon's rings does, or crosses another, or shares a side with one.
bool crosses_itself(OGRGeometryH polygon);
/// The same area in polygons that do not; null where GDAL cannot.
GdalGeometry cut_at_crossings(OGRGeometryH polygon);

}  // namespace sunload
