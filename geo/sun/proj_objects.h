// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// PROJ's objects, for the files of this room that ask PROJ.
#pragma once

#include <proj.h>

#include <memory>
#include <string>

namespace sunload {

/// Releases what PROJ has handed out.
struct ProjDeleter {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, ProjDeleter>;
using ProjObject = std::unique_ptr<PJ, ProjDeleter>;

/// Silent, and without network. Not thread-safe: each call of ours has one of its own.
ProjContext make_proj_context();

/// The CRS of that name, a bare number being an EPSG code; null where PROJ knows none.
ProjObject crs_of_name(PJ_CONTEXT* context, const std::string& name);

/// The part of a CRS that places points on the map.
ProjObject horizontal_part(PJ_CONTEXT* context, ProjObject crs);

/// The part of a compound CRS that heights are in; null where it has none.
ProjObject vertical_part(PJ_CONTEXT* context, ProjObject crs);

/// Length of a map projection's own unit [m], e.g. a US survey foot; of degrees in radians.
double unit_of(PJ_CONTEXT* context, const PJ* crs);

/// To WGS84, longitude first, from the CRS, east first; null where PROJ knows no way.
ProjObject earth_from_crs(PJ_CONTEXT* context, const PJ* crs);

/// Bounds in degrees; nothing where the database has none.
struct AreaOfUse {
  bool known = false;
  double west = 0, south = 0, east = 0, north = 0;
  std::string name;

  /// True in the area and its neighbourhood, which maps serve, too.
  bool contains(double latitude_deg, double longitude_deg) const;
};
AreaOfUse area_of_use(PJ_CONTEXT* context, const PJ* crs);

}  // namespace sunload
