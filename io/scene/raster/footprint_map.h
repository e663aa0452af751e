// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The map that footprints lie on, in metres.
#pragma once

#include <optional>
#include <string>

#include "geo/edit/solids.h"
#include "geo/sun/map_axes.h"
#include "io/base/file_text.h"
#include "io/base/gdal.h"

namespace sunload {

class FootprintMap {
 public:
  /// `map_of_degrees`: of the study, or empty. GeoJSON that names no CRS is in degrees by its
  /// standard, and often in metres of the scene's map: its numbers tell. `unit_m`: of coordinates
  /// that are no degrees. Throws InputError for layers without polygons.
  FootprintMap(const std::string& path, OGRLayerH layer, const std::string& map_of_degrees,
               double unit_m);

  /// Of coordinates and heights that are not told in metres: degrees are brought onto a map in
  /// metres, and the study's unit is that of heights then.
  double unit_m() const { return is_in_degrees_ ? 1 : unit_m_; }
  /// Brings degrees onto the study's map, that of the terrain (empty: there is none, or it names
  /// none) or the UTM zone; notes what was done. Throws InputError for what is no town.
  void choose(const std::string& map_of_terrain, NoteCounter& notes);
  const std::string& crs() const { return crs_; }  ///< empty: it is not known
  /// Throws InputError for what lies beyond the Earth, or cannot be projected.
  Point2 place(double x, double y) const;

 private:
  const OGREnvelope& extent_of_polygons();
  bool is_in_degrees();
  void expect_a_town(const OGREnvelope& extent) const;

  std::string path_;
  OGRLayerH layer_;
  std::string map_;
  double unit_m_;
  std::optional<OGREnvelope> extent_;  ///< once it is asked for
  bool is_in_degrees_;
  std::string crs_;
  std::optional<MapFromDegrees> from_degrees_;
};

/// What readers of footprints say of a layer without any.
[[noreturn]] void fail_without_polygons(const std::string& path);

}  // namespace sunload
