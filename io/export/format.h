// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What all formats of `sunload export` draw from, and one function for each.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "io/export/export.h"
#include "io/result/patches.h"

namespace sunload {

/// Where it is written to; the path is for references to other files.
struct ExportTarget {
  std::ostream& stream;
  std::string path;  ///< empty: standard output
};

/// A quantity as colours.
struct ExportColours {
  ShownQuantity shown;
  double least = 0, largest = 1;  ///< values of the first and the last colour
  Palette palette = Palette::false_colour;
  /// A step of the palette for every patch, or for its corners; -1: not known.
  std::vector<std::int32_t> patch_step;
  std::vector<std::array<std::int32_t, 3>> corner_step;  ///< empty: constant patches
};

inline constexpr int export_palette_steps = 1024;
/// sRGB of a step; grey for -1.
Colour export_colour(Palette palette, std::int32_t step);

/// The quantity asked for, or light_load; of a comparison its difference. Throws InputError for a
/// time of what is no series.
ShownQuantity export_quantity(const ResultReader& result, const ExportRules& rules);

/// The one asked for; of differences their own. Throws InputError where both are wanted.
Palette export_palette(const ExportRules& rules, const ShownQuantity& shown);

ExportColours export_colours(const ResultReader& result, const ExportRules& rules,
                             const ResultPatches& patches);

/// Dataset and unit as the head of a column: "light_load" in "kWh m-2" → "light_load_kwh_m2".
std::string column_name(const ResultReader& result, const std::string& dataset);
std::string column_name(const ShownQuantity& shown);

/// Length of the unit of the scene's CRS [m], in which formats that name it have coordinates.
double crs_unit_m(const ResultReader& result);
/// "result.h5: light load kWh/m², when": a line for a head or comment.
std::string export_caption(const ResultReader& result, const ShownQuantity& shown);

using ExportWriter = void (*)(const ResultReader&, const ExportRules&, const ExportTarget&);
/// One row per patch, or a table of groups or sensors; a series (`export_series_csv`). RFC 4180.
void export_csv(const ResultReader&, const ExportRules&, const ExportTarget&);
/// Sun, sky, ledger and a series, of the intervals that the chosen part of the period has a share
/// in: means over the whole, surfaces, objects, facades and selections, or sensors. Throws
/// InputError for a quantity that is no series, and for one instant.
void export_series_csv(const ResultReader&, const ExportRules&, std::ostream&);
/// Legacy VTK PolyData, binary. Kitware, VTK File Formats.
void export_vtk(const ResultReader&, const ExportRules&, const ExportTarget&);
/// XDMF 2 whose numbers are those of the result file itself.
void export_xdmf(const ResultReader&, const ExportRules&, const ExportTarget&);
/// Binary glTF. Khronos Group (2021), glTF 2.0 Specification.
void export_glb(const ResultReader&, const ExportRules&, const ExportTarget&);
/// VRML97. ISO/IEC 14772-1:1997.
void export_vrml(const ResultReader&, const ExportRules&, const ExportTarget&);
/// Binary PLY with colours and values of faces. Turk (1994), The PLY Polygon File Format.
void export_ply(const ResultReader&, const ExportRules&, const ExportTarget&);

/// CityJSON: the model of `ExportRules::model` with what its surfaces and objects receive as
/// attributes, or CityJSON 2.0 of the patches. CityJSON specifications 2.0.1.
void export_cityjson(const ResultReader&, const ExportRules&, const ExportTarget&);

/// GeoPackage with the layers "patches", "objects" and "facades", surfaces with z, and "sensors",
/// points with z, in the scene's CRS where it has one, and with styles for QGIS. OGC 12-128r18,
/// GeoPackage Encoding Standard 1.3, written by GDAL.
void export_geopackage(const ResultReader&, const ExportRules&, const ExportTarget&);

/// Sunlit fraction of every facade and roof plane at every step of a year, CSV: direct light by
/// what an unshaded facade would get. The layout is what EnergyPlus writes ("eplusshading.csv") and
/// reads (Schedule:File:Shading): its sources ScheduleManager.cc and their tests, version 25.
void export_energyplus(const ResultReader&, const ExportRules&, const ExportTarget&);

}  // namespace sunload
