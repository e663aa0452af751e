// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// glTF 2.0 scenes, as .gltf with its buffers or as .glb.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads the triangles (also strips and fans) of the file's scene.
///
/// - Object of a triangle: the name of the node that holds its mesh, of the nearest named node
///   above it, of the mesh, or the file's stem; every node is an object: `tree`, `tree_2`, ….
/// - Material: diffuse reflectance is the mean of baseColorFactor (of diffuseFactor under
///   KHR_materials_pbrSpecularGlossiness). Where a texture gives the colour, or nothing, the
///   study decides. Metal and roughness are for the eye: no mirror is made of them. Emission is
///   noted only: it has no power. `doubleSided` makes faces two-sided.
/// - Transformations are computed in double; positions are floats in the file itself.
/// - Buffers lie in the file, in data URIs, or in files beside it. Compressed meshes, sparse
///   accessors and other extensions that the file requires are refused by name.
/// - Skins, morphs, points and lines are passed over, with a note.
/// - y is up unless the rules say otherwise.
///
/// Throws InputError for what contradicts the format, with the JSON path in words.
/// Reference: Khronos Group (2021), glTF 2.0 Specification.
PolygonModel read_scene_gltf(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
