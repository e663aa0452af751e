// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/crossing_outlines.h"

#include <utility>

#include "io/scene/raster/gdal_file.h"

namespace sunload {

bool crosses_itself(OGRGeometryH polygon) {
  for (int r = 0; r < gdal::OGR_G_GetGeometryCount(polygon); ++r) {
    OGRGeometryH ring = gdal::OGR_G_GetGeometryRef(polygon, r);
    const GdalGeometry line(gdal::OGR_G_CreateGeometry(wkbLineString));  // of rings it is not told
    for (int k = 0; k < gdal::OGR_G_GetPointCount(ring); ++k)
      gdal::OGR_G_AddPoint(line.get(), gdal::OGR_G_GetX(ring, k), gdal::OGR_G_GetY(ring, k), 0);
    if (gdal::OGR_G_IsSimple(line.get()) == 0) return true;
  }
  return false;
}

GdalGeometry cut_at_crossings(OGRGeometryH polygon) {
  const GdalMessages of_this;  // a polygon that cannot be cut is taken as it is
  GdalGeometry parts(gdal::OGR_G_MakeValid(polygon));
  return parts && gdal::OGR_G_GetDimension(parts.get()) == 2 ? std::move(parts) : nullptr;
}

}  // namespace sunload
