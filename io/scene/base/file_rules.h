// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How scene files are to be understood, whatever their format.
#pragma once

#include <optional>
#include <string>

namespace sunload {

/// The strength of a VRML colour: mean of its components, or their Euclidean norm.
enum class VrmlColour { mean, norm };
/// Colours that reflect more than arrives: an error, or made smaller with their ratio kept.
enum class VrmlExcess { refuse, scale };

/// Columns of plan data (io/scene/raster/footprints.h); empty: found by their usual names.
struct FootprintRules {
  std::string height, storeys;  ///< of the building above its foot
  std::string base;             ///< height of its foot
  std::string name;
  std::string layer;                       ///< empty: the only one of polygons
  double storey_m = 3;                     ///< height of a storey
  std::optional<double> default_height_m;  ///< where no column has one
  std::string terrain;                     ///< raster of the land that feet stand on, or empty
};

/// Columns of points that are trees (io/scene/raster/tree_points.h); empty: found by their usual
/// names.
struct TreePointRules {
  std::string height = {}, crown = {};  ///< of the tree above its foot; greatest width of its crown
  std::string name = {};
  std::string layer = {};  ///< empty: the only one of points
  std::optional<double> default_height_m = {}, default_crown_m = {};  ///< where no column has one
};

/// How the coordinates and the levels of detail of a scene file are to be understood.
struct SceneFileRules {
  char up = 0;        ///< axis of the file that points up: 'x', 'y', 'z'; 0 = default of the format
  double unit_m = 1;  ///< length of one unit of the file [m]
  std::string lod = "highest";  ///< city models: "highest", or a level such as "2" or "2.2"
  VrmlColour vrml_colour = VrmlColour::mean;
  double emission_scale_w = 1;  ///< power that a VRML emissiveColor of strength 1 stands for [W]
  FootprintRules footprints = {};
  /// Map that degrees are brought onto, as `site_from_crs` takes it; empty: the UTM zone of the
  /// place.
  std::string map_of_degrees = {};
};

}  // namespace sunload
