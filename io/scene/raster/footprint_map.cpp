// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/footprint_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "io/scene/base/from_file.h"
#include "io/scene/raster/gdal_file.h"

namespace sunload {

void fail_without_polygons(const std::string& path) {
  throw InputError({path}, "has no polygons", "footprints were expected");
}

FootprintMap::FootprintMap(const std::string& path, OGRLayerH layer,
                           const std::string& map_of_degrees, double unit_m)
    : path_(path),
      layer_(layer),
      map_(map_of_degrees),
      unit_m_(unit_m),
      is_in_degrees_(is_in_degrees()) {}

bool FootprintMap::is_in_degrees() {
  OGRSpatialReferenceH crs = gdal::OGR_L_GetSpatialRef(layer_);
  if (crs == nullptr || gdal::OSRIsGeographic(crs) == 0) return false;
  if (map_.empty()) return true;
  constexpr double most_north = 90, most_east = 360;
  const OGREnvelope& extent = extent_of_polygons();
  return std::max(-extent.MinY, extent.MaxY) <= most_north &&
         std::max(-extent.MinX, extent.MaxX) <= most_east;
}

/// The extent that a GeoPackage stores is for information, and often that of a whole country.
const OGREnvelope& FootprintMap::extent_of_polygons() {
  if (extent_) return *extent_;
  OGREnvelope all;
  gdal::OGR_L_ResetReading(layer_);
  while (const GdalFeature feature{gdal::OGR_L_GetNextFeature(layer_)}) {
    const OGRGeometryH geometry = gdal::OGR_F_GetGeometryRef(feature.get());
    if (geometry == nullptr || gdal::OGR_G_IsEmpty(geometry) != 0 ||
        gdal::OGR_G_GetDimension(geometry) < 2)
      continue;
    OGREnvelope one;
    gdal::OGR_G_GetEnvelope(geometry, &one);
    all.Merge(one);
  }
  if (all.IsInit() == 0) fail_without_polygons(path_);
  return extent_.emplace(all);
}

void FootprintMap::choose(const std::string& map_of_terrain, NoteCounter& notes) {
  OGRSpatialReferenceH crs = gdal::OGR_L_GetSpatialRef(layer_);
  if (crs == nullptr) return notes.say("the footprints name no CRS: site.crs may");
  if (!is_in_degrees_) {
    const bool says_degrees = gdal::OSRIsGeographic(crs) != 0;
    if (says_degrees) notes.say("numbers of the footprints are no degrees: coordinates of " + map_);
    crs_ = says_degrees ? map_ : crs_name(crs);
    return;
  }
  const OGREnvelope& extent = extent_of_polygons();
  expect_a_town(extent);
  const double longitude = (extent.MinX + extent.MaxX) / 2,
               latitude = (extent.MinY + extent.MaxY) / 2;
  crs_ = !map_.empty()             ? map_
         : !map_of_terrain.empty() ? map_of_terrain
                                   : utm_at(latitude, longitude);
  from_degrees_.emplace(crs_name(crs), crs_);
  notes.say("degrees of the footprints are projected to " + crs_);
}

void FootprintMap::expect_a_town(const OGREnvelope& extent) const {
  constexpr double most_degrees = 3, half_turn = 180;
  constexpr double both_sides = 300;  // of the 180th meridian
  const double latitude = (extent.MinY + extent.MaxY) / 2;
  if (std::abs(latitude) < 90 && extent.MaxX <= half_turn && extent.MinX >= -half_turn &&
      extent.MaxX - extent.MinX > both_sides)
    throw InputError(
        {path_}, "lies on both sides of the 180th meridian",
        "its degrees east are as far apart as they can be",
        "project it first, for example with ogr2ogr -t_srs " + utm_at(latitude, half_turn - 1));
  if (!(std::abs(latitude) < 90 && extent.MaxX - extent.MinX < most_degrees))
    throw InputError(
        {path_},
        fmt::format("lies between {:g} and {:g} degrees east, {:g} and {:g} north", extent.MinX,
                    extent.MaxX, extent.MinY, extent.MaxY),
        "that is no town",
        "are longitude and latitude exchanged? If these are metres of a map, site.crs names it");
}

Point2 FootprintMap::place(double x, double y) const {
  const Vec3 place =
      from_degrees_ ? (*from_degrees_)(x, y, 0) : Vec3{x * unit_m(), y * unit_m(), 0};
  if (is_usable(place)) return {place.x, place.y};
  if (from_degrees_)
    throw InputError({path_}, fmt::format("has the corner {:g}, {:g}", x, y),
                     "it cannot be projected");
  throw InputError({path_}, "lies beyond all coordinates on Earth", "", "is unit_m right?");
}

}  // namespace sunload
