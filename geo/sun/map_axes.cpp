// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/map_axes.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/sun/proj_objects.h"

namespace sunload {

namespace {

std::string code_of(const PJ* crs, const std::string& otherwise) {
  const char* authority = proj_get_id_auth_name(crs, 0);
  const char* code = proj_get_id_code(crs, 0);
  return authority != nullptr && code != nullptr ? std::string(authority) + ":" + code : otherwise;
}

bool begins_in_the_north(PJ_CONTEXT* context, const PJ* crs) {
  const ProjObject axes(proj_crs_get_coordinate_system(context, crs));
  const char* direction = nullptr;
  if (!axes || proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, &direction, nullptr,
                                     nullptr, nullptr, nullptr) == 0)
    return false;
  const std::string_view first = direction == nullptr ? "" : direction;
  return first == "north" || first == "south";
}

}  // namespace

struct MapAxes::Parts {
  ProjContext context = make_proj_context();
  ProjObject crs, earth_from_crs;
  std::string name;
  double unit_m = 1, height_unit_m = 1;
  bool is_geocentric = false, is_in_degrees = false, is_north_first = false;
  AreaOfUse area;
};

MapAxes::MapAxes(const std::string& crs) : parts_(std::make_unique<Parts>()) {
  Parts& own = *parts_;
  auto* const context = own.context.get();
  own.crs = horizontal_part(context, crs_of_name(context, crs));
  own.name = crs;
  if (!own.crs) return;
  const PJ_TYPE type = proj_get_type(own.crs.get());
  own.is_geocentric = type == PJ_TYPE_GEOCENTRIC_CRS;
  own.is_in_degrees = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
  if (!own.is_geocentric && !own.is_in_degrees && type != PJ_TYPE_PROJECTED_CRS) {
    own.crs.reset();
    return;
  }
  own.name = code_of(own.crs.get(), crs);
  if (type == PJ_TYPE_PROJECTED_CRS) own.unit_m = unit_of(context, own.crs.get());
  const ProjObject heights = vertical_part(context, crs_of_name(context, crs));
  own.height_unit_m = heights ? unit_of(context, heights.get()) : own.unit_m;
  own.is_north_first = begins_in_the_north(context, own.crs.get());
  own.earth_from_crs = earth_from_crs(context, own.crs.get());
  own.area = area_of_use(context, own.crs.get());
}

MapAxes::~MapAxes() = default;

bool MapAxes::is_known() const { return parts_->crs != nullptr; }
bool MapAxes::is_geocentric() const { return parts_->is_geocentric; }
bool MapAxes::is_in_degrees() const { return parts_->is_in_degrees; }
bool MapAxes::is_north_first() const { return parts_->is_north_first; }
double MapAxes::unit_m() const { return parts_->unit_m; }
double MapAxes::height_unit_m() const { return parts_->height_unit_m; }
const std::string& MapAxes::name() const { return parts_->name; }

bool MapAxes::is_in_use_at(double east, double north) const {
  if (!parts_->area.known || !parts_->earth_from_crs) return true;
  constexpr double pole_deg = 90, most_longitude_deg = 360;
  if (is_in_degrees() && !(std::abs(north) <= pole_deg && std::abs(east) <= most_longitude_deg))
    return false;
  const PJ_COORD earth =
      proj_trans(parts_->earth_from_crs.get(), PJ_FWD, proj_coord(east, north, 0, HUGE_VAL));
  return std::isfinite(earth.lp.lam) && std::isfinite(earth.lp.phi) &&
         parts_->area.contains(earth.lp.phi, earth.lp.lam);
}

bool are_of_one_map(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const MapAxes of_a(a), of_b(b);
  return of_a.is_known() && of_b.is_known() && of_a.name() == of_b.name();
}

std::string utm_at(double latitude_deg, double longitude_deg) {
  constexpr double half_turn = 180, zone_width = 6;
  constexpr int zones = 60, north_code = 32600, south_code = 32700;
  const double east_of_date_line = wrapped_deg(longitude_deg + half_turn);
  const int zone = std::clamp(static_cast<int>(east_of_date_line / zone_width) + 1, 1, zones);
  return "EPSG:" + std::to_string((latitude_deg < 0 ? south_code : north_code) + zone);
}

struct MapFromDegrees::Parts {
  ProjContext context = make_proj_context();
  ProjObject map_from_degrees;
};

MapFromDegrees::MapFromDegrees(const std::string& degrees, const std::string& map)
    : parts_(std::make_unique<Parts>()) {
  auto* const context = parts_->context.get();
  const ProjObject from = horizontal_part(context, crs_of_name(context, degrees)),
                   to = horizontal_part(context, crs_of_name(context, map));
  if (to && (proj_get_type(to.get()) != PJ_TYPE_PROJECTED_CRS || unit_of(context, to.get()) != 1))
    throw InputError({}, "degrees cannot be brought onto '" + map + "'",
                     "it is no map projection in metres",
                     "leave site.crs out, or convert the model to its coordinates");
  const ProjObject as_defined(
      from && to ? proj_create_crs_to_crs_from_pj(context, from.get(), to.get(), nullptr, nullptr)
                 : nullptr);
  if (as_defined)
    parts_->map_from_degrees.reset(proj_normalize_for_visualization(context, as_defined.get()));
  if (!parts_->map_from_degrees)
    throw InputError({}, "coordinate reference system '" + degrees + "' cannot be used",
                     "PROJ knows no way from it to " + map);
}

MapFromDegrees::~MapFromDegrees() = default;

Vec3 MapFromDegrees::operator()(double longitude_deg, double latitude_deg, double height) const {
  const PJ_COORD map = proj_trans(parts_->map_from_degrees.get(), PJ_FWD,
                                  proj_coord(longitude_deg, latitude_deg, 0, HUGE_VAL));
  return {map.xy.x, map.xy.y, height};
}

}  // namespace sunload
