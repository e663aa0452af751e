// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Names of coordinate reference systems in GML files.
#pragma once

#include <string>

namespace sunload {

/// A srsName, and what its form says of the order of axes.
struct SrsName {
  std::string crs;  ///< as PROJ may know it
  /// URNs and URIs of definitions have the axes in the order of the authority; short forms and
  /// those of GML 2 begin in the east whatever the authority says. Reference: GDAL, GML driver.
  bool has_official_axes = false;
};

/// - `urn:ogc:def:crs:EPSG::25832`, `urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783`,
///   `http://www.opengis.net/def/crs/EPSG/0/25832`: as they are;
/// - `EPSG:25832`, `http://www.opengis.net/gml/srs/epsg.xml#25832`, `EPSG:25832, EPSG:5783`;
/// - German surveys: `urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH`, `urn:adv:crs:DE_DHDN_3GK3`.
///
/// Anything else is handed out as it is.
SrsName read_srs_name(const std::string& name);

}  // namespace sunload
