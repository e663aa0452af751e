// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// VRML97, VRML 1.0 and Inventor text files, through Coin.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads the faces of a VRML file with everything that it inlines.
///
/// - Plain or gzip, told by content. PROTO, EXTERNPROTO, DEF/USE, Inline (relative to the
///   file that holds it; a file that inlines itself is refused), all grouping nodes. Of LOD
///   the first level, of Switch the chosen one. Behaviour, light, sound, text, lines, points
///   and textures are left out, with a note where they would be seen.
/// - Object of a shape: the DEF names of the nodes on the way to it, joined by '/': the shape
///   itself included, its geometry only where nothing else has a name; the file's stem where
///   nothing has. Every instance of a named node is an object: `tree`, `tree_2`, ….
/// - Material: one per Material node. Strength of a colour: `rules.vrml_colour`. diffuseColor
///   is the diffuse reflectance, specularColor the mirror reflectance, emissiveColor ×
///   `rules.emission_scale_w` the power that all faces of the node emit together.
///   Sums above 1 are kept and noted; a scene that uses such a material is refused.
/// - `solid FALSE` makes faces two-sided; in VRML 1.0 so do all ShapeHints but SOLID.
///   `ccw FALSE` turns them. creaseAngle and normals are for the eye only.
/// - Curved shapes have `turn_segments` segments per turn.
/// - Coin keeps coordinates in single precision; transformations are computed in double.
/// - A field or node that Coin does not know is left out and counted with its line.
/// - y is up unless the rules say otherwise.
///
/// Throws InputError for what Coin cannot parse (with its line), indices out of range, files
/// that are nested too deep or without end.
/// Reference: ISO/IEC 14772-1:1997, The Virtual Reality Modeling Language.
PolygonModel read_scene_vrml(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
