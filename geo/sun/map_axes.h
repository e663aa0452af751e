// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the numbers of a file mean in its CRS: the order of axes; degrees put on a map (PROJ).
#pragma once

#include <memory>
#include <string>

#include "geo/base/vec.h"

namespace sunload {

/// The axes of a coordinate reference system by its authority's definition.
class MapAxes {
 public:
  /// `crs` as for `site_from_crs`, and systems in degrees. Of a compound system the horizontal
  /// part.
  explicit MapAxes(const std::string& crs);
  ~MapAxes();
  MapAxes(const MapAxes&) = delete;
  MapAxes& operator=(const MapAxes&) = delete;

  /// False: PROJ does not know it, or not what it is for; nothing else may be asked.
  bool is_known() const;
  bool is_geocentric() const;
  /// Latitude and longitude.
  bool is_in_degrees() const;
  /// Northing (or latitude, or southing) is the first axis.
  bool is_north_first() const;
  /// Length of the unit of a map projection [m]; 1 for all else.
  double unit_m() const;
  /// Length of the unit of heights [m]: of a compound system its vertical part's, else as `unit_m`.
  double height_unit_m() const;
  /// `EPSG:25832`: the code of the horizontal part; the name asked for where it has none.
  const std::string& name() const;
  /// Whether a point, east (longitude) first, in the unit of the CRS, lies where the CRS is used;
  /// true where the database does not say.
  bool is_in_use_at(double east, double north) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Whether two systems have one map: with and without heights.
bool are_of_one_map(const std::string& a, const std::string& b);

/// The UTM zone (WGS84) of a point: `EPSG:32654`.
std::string utm_at(double latitude_deg, double longitude_deg);

/// From degrees of one CRS to another CRS; throws InputError where that is no map projection in
/// metres, and where PROJ knows no way.
class MapFromDegrees {
 public:
  MapFromDegrees(const std::string& degrees, const std::string& map);
  ~MapFromDegrees();
  MapFromDegrees(const MapFromDegrees&) = delete;
  MapFromDegrees& operator=(const MapFromDegrees&) = delete;
  /// East and north [m]; z is `height`. Infinite where the point has no place on the map.
  Vec3 operator()(double longitude_deg, double latitude_deg, double height) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sunload
