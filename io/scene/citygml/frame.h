// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// From the positions of a file to those of the scene: order of axes, degrees, axes and units.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geo/sun/map_axes.h"
#include "io/scene/base/from_file.h"
#include "io/scene/citygml/coordinates.h"
#include "io/scene/citygml/document.h"

namespace sunload {

/// Where a file's positions lie.
///
/// Which axis comes first is told by the srsName where the CRS begins in the north (latitude,
/// northing): first by the area of use that one order meets and the other misses; else by the side
/// that roofs and bodies face, which the wrong order mirrors; else by the form of the name. What
/// was taken is noted. One that begins in the east is read otherwise only where its area of use
/// says so (files that put northings first whatever their srsName). Positions in degrees are put on
/// `map_of_degrees`, by default the UTM zone (WGS84) of the place.
class CityFrame {
 public:
  CityFrame(const CityDocument& document, CityCoordinates& coordinates,
            const SceneFromFile& scene_from_file, const std::string& map_of_degrees,
            NoteCounter& notes);

  /// Position in the scene; not finite where it has no place on the map.
  Vec3 operator()(Vec3 in_file) const;
  /// Of the scene's positions; empty where the file names none.
  const std::string& crs() const { return crs_; }

 private:
  SceneFromFile scene_from_file_;
  std::string crs_;
  bool is_north_first_ = false;
  std::unique_ptr<MapFromDegrees> map_from_degrees_;
};

}  // namespace sunload
