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
  // Rings that cross or share a side with others.
  const GdalMessages of_this;
  return gdal::OGR_G_IsValid(polygon) == 0;
}

namespace {

/// What a ring encloses; null where GDAL cannot tell.
GdalGeometry inside_of(OGRGeometryH polygon, int ring) {
  const GdalGeometry area(gdal::OGR_G_CreateGeometry(wkbPolygon));
  gdal::OGR_G_AddGeometry(area.get(), gdal::OGR_G_GetGeometryRef(polygon, ring));
  return GdalGeometry(gdal::OGR_G_MakeValid(area.get()));
}

}  // namespace

GdalGeometry cut_at_crossings(OGRGeometryH polygon) {
  const GdalMessages of_this;  // a polygon that cannot be cut is taken as it is
  GdalGeometry parts = inside_of(polygon, 0);
  for (int r = 1; parts && r < gdal::OGR_G_GetGeometryCount(polygon); ++r) {
    const GdalGeometry hole = inside_of(polygon, r);
    if (!hole) return nullptr;
    parts.reset(gdal::OGR_G_Difference(parts.get(), hole.get()));
  }
  return parts && gdal::OGR_G_GetDimension(parts.get()) == 2 ? std::move(parts) : nullptr;
}

}  // namespace sunload
