/// Scene files of every format: one entry, one table of formats.
#pragma once

#include <string>

#include "geo/mesh.h"

namespace sunload {

/// The strength of a VRML colour: mean of its components, or their Euclidean norm.
enum class VrmlColour { mean, norm };

/// How the coordinates and the levels of detail of a scene file are to be understood.
struct SceneFileRules {
  char up = 0;        ///< axis of the file that points up: 'x', 'y', 'z'; 0 = default of the format
  double unit_m = 1;  ///< length of one unit of the file [m]
  std::string lod = "highest";  ///< CityJSON: "highest", or a level such as "2" or "2.2"
  VrmlColour vrml_colour = VrmlColour::mean;
  double emission_scale_w = 1;  ///< power that a VRML emissiveColor of strength 1 stands for [W]
};

/// Reads a scene file; its format is told by its content, then by its extension.
///
/// Coordinates come out in metres with z up ('y' turns (x, y, z) → (x, −z, y),
/// 'x' turns (x, y, z) → (y, z, x)), absolute, in double. What was counted,
/// tolerated or left out is in `PolygonModel::notes`.
/// Throws InputError where the file is missing, of an unknown format, or wrong.
PolygonModel read_scene_file(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
