// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How scene files are to be understood, whatever their format.
#pragma once

#include <string>

namespace sunload {

/// The strength of a VRML colour: mean of its components, or their Euclidean norm.
enum class VrmlColour { mean, norm };
/// Colours that reflect more than arrives: an error, or made smaller with their ratio kept.
enum class VrmlExcess { refuse, scale };

/// How the coordinates and the levels of detail of a scene file are to be understood.
struct SceneFileRules {
  char up = 0;        ///< axis of the file that points up: 'x', 'y', 'z'; 0 = default of the format
  double unit_m = 1;  ///< length of one unit of the file [m]
  std::string lod = "highest";  ///< CityJSON: "highest", or a level such as "2" or "2.2"
  VrmlColour vrml_colour = VrmlColour::mean;
  double emission_scale_w = 1;  ///< power that a VRML emissiveColor of strength 1 stands for [W]
};

}  // namespace sunload
