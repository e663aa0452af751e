// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/proj_objects.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {

ProjContext make_proj_context() {
  ProjContext context(proj_context_create());
  SUNLOAD_EXPECT(context != nullptr, "PROJ context");
  proj_log_level(context.get(), PJ_LOG_NONE);
  proj_context_set_enable_network(context.get(), 0);  // the same answer with and without network
  return context;
}

ProjObject crs_of_name(PJ_CONTEXT* context, const std::string& name) {
  const bool is_number =
      !name.empty() &&
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  ProjObject crs(proj_create(context, (is_number ? "EPSG:" + name : name).c_str()));
  if (crs && proj_is_crs(crs.get()) == 0) crs.reset();
  return crs;
}

ProjObject horizontal_part(PJ_CONTEXT* context, ProjObject crs) {
  while (crs) {
    const PJ_TYPE type = proj_get_type(crs.get());
    if (type == PJ_TYPE_COMPOUND_CRS) {
      crs.reset(proj_crs_get_sub_crs(context, crs.get(), 0));
    } else if (type == PJ_TYPE_BOUND_CRS) {
      crs.reset(proj_get_source_crs(context, crs.get()));
    } else {
      break;
    }
  }
  return crs;
}

ProjObject vertical_part(PJ_CONTEXT* context, ProjObject crs) {
  while (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
    crs.reset(proj_get_source_crs(context, crs.get()));
  if (!crs || proj_get_type(crs.get()) != PJ_TYPE_COMPOUND_CRS) return nullptr;
  ProjObject heights(proj_crs_get_sub_crs(context, crs.get(), 1));
  while (heights && proj_get_type(heights.get()) == PJ_TYPE_BOUND_CRS)
    heights.reset(proj_get_source_crs(context, heights.get()));
  return heights;
}

double unit_of(PJ_CONTEXT* context, const PJ* crs) {
  const ProjObject axes(proj_crs_get_coordinate_system(context, crs));
  double factor = 0;
  const bool known = axes && proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr,
                                                   nullptr, &factor, nullptr, nullptr, nullptr);
  SUNLOAD_EXPECT(known && factor > 0, "unit of a coordinate system");
  return factor;
}

ProjObject earth_from_crs(PJ_CONTEXT* context, const PJ* crs) {
  const ProjObject wgs84(proj_create(context, "EPSG:4326"));
  const ProjObject as_defined(
      proj_create_crs_to_crs_from_pj(context, crs, wgs84.get(), nullptr, nullptr));
  return ProjObject(as_defined ? proj_normalize_for_visualization(context, as_defined.get())
                               : nullptr);
}

bool AreaOfUse::contains(double latitude_deg, double longitude_deg) const {
  constexpr double margin_deg = 0.2;
  const double width_deg = wrapped_deg(east - west);  // may cross the date line
  const bool all_around = east - west >= 360;
  return latitude_deg >= south - margin_deg && latitude_deg <= north + margin_deg &&
         (all_around ||
          wrapped_deg(longitude_deg - west + margin_deg) <= width_deg + 2 * margin_deg);
}

AreaOfUse area_of_use(PJ_CONTEXT* context, const PJ* crs) {
  AreaOfUse area;
  const char* name = nullptr;
  constexpr double unknown = -1000;  // PROJ's own mark
  area.known = proj_get_area_of_use(context, crs, &area.west, &area.south, &area.east, &area.north,
                                    &name) != 0 &&
               area.west > unknown;
  if (name) area.name = name;
  return area;
}

}  // namespace sunload
