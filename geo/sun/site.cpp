// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Frames by GeographicLib, map projections by PROJ.
#include "geo/sun/site.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Math.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "geo/base/check.h"
#include "geo/sun/proj_objects.h"

namespace sunload {

namespace {

void expect_on_earth(const Site& site) {
  constexpr double pole_deg = 90;
  SUNLOAD_EXPECT(std::abs(site.latitude_deg) <= pole_deg && std::isfinite(site.longitude_deg) &&
                     std::isfinite(site.elevation_m) && std::isfinite(site.north_deg),
                 "site");
}

/// Where a point is, and the columns east, north, up there in Earth-centred axes.
struct LocalFrame {
  Vec3 position;
  Rotation enu_from_ecef;
};

LocalFrame local_frame(const Site& site) {
  expect_on_earth(site);
  LocalFrame frame;
  std::vector<double> m(9);  // GeographicLib: 3×3, row major, Earth-centred from east-north-up
  GeographicLib::Geocentric::WGS84().Forward(site.latitude_deg, site.longitude_deg,
                                             site.elevation_m, frame.position.x, frame.position.y,
                                             frame.position.z, m);
  frame.enu_from_ecef =
      Rotation{{Vec3{m[0], m[1], m[2]}, Vec3{m[3], m[4], m[5]}, Vec3{m[6], m[7], m[8]}}}.inverse();
  return frame;
}

ProjObject map_projection(PJ_CONTEXT* context, const std::string& crs) {
  ProjObject object = crs_of_name(context, crs);
  if (!object) {
    throw InputError({}, "unknown coordinate reference system '" + crs + "'",
                     "not in PROJ's database",
                     "use the code of a map projection such as EPSG:28992");
  }
  object = horizontal_part(context, std::move(object));
  if (!object || proj_get_type(object.get()) != PJ_TYPE_PROJECTED_CRS) {
    throw InputError({}, "coordinate reference system '" + crs + "' is no map projection",
                     "the scene's x and y must be lengths, not degrees",
                     "convert the scene to a map projection such as UTM, or give latitude_deg and "
                     "longitude_deg instead of crs");
  }
  return object;
}

/// From the map [m, east and north first] to WGS84.
class MapToEarth {
 public:
  explicit MapToEarth(const std::string& crs)
      : name_(crs),
        context_(make_proj_context()),
        projection_(map_projection(context_.get(), crs)) {
    metres_per_unit_ = unit_of(context_.get(), projection_.get());
    earth_from_map_ = earth_from_crs(context_.get(), projection_.get());
    if (!earth_from_map_) fail("PROJ knows no way from it to WGS84");
  }

  Site operator()(Vec3 position) const {
    const PJ_COORD map =
        proj_coord(position.x / metres_per_unit_, position.y / metres_per_unit_, 0, HUGE_VAL);
    const PJ_COORD earth = proj_trans(earth_from_map_.get(), PJ_FWD, map);
    const double longitude_deg = earth.lp.lam, latitude_deg = earth.lp.phi;
    if (!std::isfinite(longitude_deg) || !std::isfinite(latitude_deg)) {
      fail("the point x = " + std::to_string(position.x) + " m, y = " + std::to_string(position.y) +
           " m has no place on Earth in it");
    }
    return {.latitude_deg = latitude_deg,
            .longitude_deg = GeographicLib::Math::AngNormalize(longitude_deg),
            .elevation_m = position.z};
  }

  Vec3 back(double latitude_deg, double longitude_deg, double height_m) const {
    const PJ_COORD earth = proj_coord(longitude_deg, latitude_deg, 0, HUGE_VAL);
    const PJ_COORD map = proj_trans(earth_from_map_.get(), PJ_INV, earth);
    if (!std::isfinite(map.xy.x) || !std::isfinite(map.xy.y)) {
      fail("latitude " + std::to_string(latitude_deg) + ", longitude " +
           std::to_string(longitude_deg) + " has no place on its map");
    }
    return {map.xy.x * metres_per_unit_, map.xy.y * metres_per_unit_, height_m};
  }

  AreaOfUse area() const { return area_of_use(context_.get(), projection_.get()); }

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError({}, "coordinate reference system '" + name_ + "' cannot be used", why,
                     "does the scene's crs belong to its coordinates?");
  }

 private:
  std::string name_;
  ProjContext context_;
  ProjObject projection_;
  ProjObject earth_from_map_;
  double metres_per_unit_ = 1;
};

// Steps on a map: short against the radius of any projection's curvature (the error falls with its
// square), long against the rounding of map coordinates.
constexpr double half_step_m = 50;
constexpr Vec3 east{half_step_m, 0, 0}, north{0, half_step_m, 0};

// Azimuth at `site` of the way from one point to another.
double azimuth_deg(const Site& site, const Site& from, const Site& to) {
  return horizontal(enu_from_ecef(site)(ecef_position(to) - ecef_position(from))).azimuth_deg;
}

}  // namespace

Rotation scene_from_enu(const Site& site) {
  expect_on_earth(site);
  double s = 0, c = 0;
  GeographicLib::Math::sincosd(site.north_deg, s, c);  // exact at multiples of 90°
  return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
}

Rotation enu_from_ecef(const Site& site) { return local_frame(site).enu_from_ecef; }

Vec3 ecef_position(const Site& site) { return local_frame(site).position; }

Site site_from_crs(const std::string& crs, Vec3 position) {
  // Conformal maps give 90° here; a mirrored pair of axes gives 270°.
  constexpr double half_turn_deg = 180;
  const MapToEarth earth_from_map(crs);
  Site site = earth_from_map(position);
  site.north_deg =
      azimuth_deg(site, earth_from_map(position - north), earth_from_map(position + north));
  const double east_deg =
      azimuth_deg(site, earth_from_map(position - east), earth_from_map(position + east));
  if (wrapped_deg(east_deg - site.north_deg) > half_turn_deg) {
    earth_from_map.fail("its axes are left-handed, and the scene would be a mirror image");
  }
  return site;
}

double map_stretch(const std::string& crs, Vec3 position) {
  const MapToEarth earth_from_map(crs);
  position.z = 0;  // maps show what lies at sea level
  const auto on_ground = [&](Vec3 step) {
    return (ecef_position(earth_from_map(position + step)) -
            ecef_position(earth_from_map(position - step))) /
           (2 * half_step_m);
  };
  // Singular values of the ground's way by the map's, which are those of no axis where it shears.
  const Vec3 a = on_ground(east), b = on_ground(north);
  const double mean = (dot(a, a) + dot(b, b)) / 2;
  const double off = std::hypot((dot(a, a) - dot(b, b)) / 2, dot(a, b));
  const double longest = 1 / std::sqrt(mean - off) - 1, shortest = 1 / std::sqrt(mean + off) - 1;
  return std::abs(longest) > std::abs(shortest) ? longest : shortest;
}

Vec3 map_position(const std::string& crs, double latitude_deg, double longitude_deg,
                  double height_m) {
  return MapToEarth(crs).back(latitude_deg, longitude_deg, height_m);
}

std::string area_of_use_words(const std::string& crs) { return MapToEarth(crs).area().name; }

std::string area_of_use_warning(const std::string& crs, Vec3 position) {
  const MapToEarth earth_from_map(crs);
  const auto area = earth_from_map.area();
  if (!area.known) return {};
  const Site site = earth_from_map(position);
  if (area.contains(site.latitude_deg, site.longitude_deg)) return {};
  return message({},
                 "the scene at latitude " + std::to_string(site.latitude_deg) + ", longitude " +
                     std::to_string(site.longitude_deg) + " lies outside of the area of use of '" +
                     crs + "'",
                 area.name, "does the scene's crs belong to its coordinates?");
}

}  // namespace sunload
