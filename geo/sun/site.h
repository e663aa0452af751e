// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the scene stands on Earth, and how its axes lie (GeographicLib, PROJ).
#pragma once

#include <string>

#include "geo/base/units.h"
#include "geo/base/vec.h"
#include "geo/sky/horizon.h"

namespace sunload {

/// Position on WGS84 and orientation of the scene.
struct Site {
  double latitude_deg = 0;       ///< geodetic, north positive, [-90, 90]
  double longitude_deg = 0;      ///< east positive, [-180, 180]
  double elevation_m = 0;        ///< above the ellipsoid, feeds pressure and parallax
  double north_deg = 0;          ///< azimuth, clockwise from true north, of the scene's +y axis
  std::string timezone = "UTC";  ///< IANA name, UTC, or a fixed offset such as +01:00
  Horizon horizon{};             ///< far hills, in true azimuths
};

/// Scene axes from local east-north-up: turns a sun direction, not the mesh.
Rotation scene_from_enu(const Site& site);

/// Earth-centred Earth-fixed axes to local east-north-up at the site.
Rotation enu_from_ecef(const Site& site);

/// Earth-centred Earth-fixed position of the site [m].
Vec3 ecef_position(const Site& site);

/// Site of a point [m] in a map projection, with north_deg the azimuth of the
/// grid's +y axis there (minus the meridian convergence), found from two
/// transformed points. Of a compound system the horizontal part is used, with
/// the axes in the order east, north; a projection in feet is fed in feet.
/// Elevation is the point's z: heights above sea level are not converted.
///
/// `crs`: anything that PROJ reads, e.g. `EPSG:28992`, `28992`,
/// `urn:ogc:def:crs:EPSG::7415`, `https://www.opengis.net/def/crs/EPSG/0/7415`.
/// Throws InputError for an unknown system, one in degrees, left-handed axes,
/// and a point that has no place on Earth.
Site site_from_crs(const std::string& crs, Vec3 position);

/// By how much lengths on the map are longer than on the ground about a point, in the direction
/// where that is most: as share, below 0 where they are shorter. In UTM up to 0.001; in web
/// Mercator 0.64 at 52 degrees. Throws as `site_from_crs` does.
double map_stretch(const std::string& crs, Vec3 position);

/// Where a point of WGS84 lies on the map [m], east and north first; z is `height_m`. The way back
/// from `site_from_crs`; throws as it does.
Vec3 map_position(const std::string& crs, double latitude_deg, double longitude_deg,
                  double height_m);

/// Latitude and longitude of a position as people write it; the rest of the site is default.
///
/// - degrees: `49.7475 13.3776` (latitude first), `49d44'51"N 13d22'39"E`, `N49:44:51 E13:22:39`,
///   each angle without blanks in it;
/// - UTM and UPS [m]: `33north 451234 5512345`, `33n …`, `33U …` (latitude band), `north …`;
/// - MGRS: `33UVR5123412345`, the middle of the square, of 1 km at most.
///
/// WGS84. Grid north of UTM and MGRS is not used: that is what a crs is for. Reference:
/// GeographicLib, class GeoCoords. Throws InputError (without place) for anything else.
Site site_from_text(const std::string& text);

/// `49d44'51.0"N 013d22'39.4"E`; site_from_text reads it.
std::string position_text(const Site& site);

/// Where a map projection is meant to be used, in words of PROJ's database, countries among them;
/// empty where it does not say. Throws InputError for a name that is none.
std::string area_of_use_words(const std::string& crs);
/// What to warn about where the point lies outside of the projection's area of
/// use by more than 0.2° (usually the wrong projection); empty otherwise. Throws as above.
std::string area_of_use_warning(const std::string& crs, Vec3 position);

}  // namespace sunload
