// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene that a walk through a VRML file builds: placed shapes, objects, materials.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "geo/mesh/affine.h"
#include "geo/mesh/mesh.h"
#include "io/scene/base/from_file.h"
#include "io/scene/base/transparent_materials.h"
#include "io/scene/vrml/shapes.h"

namespace sunload {

/// Colours of one Material node, as the file gives them.
struct VrmlMaterial {
  std::string name;
  std::array<double, 3> diffuse{}, specular{}, emissive{};
  double transparency = 0;
};

/// One place in the tree under a name; every instance of a node is a place of its own.
struct VrmlPlace {
  std::string name;                    ///< DEFs from the root, joined by '/'
  ObjectId object = ObjectId::none();  ///< once it has faces
};

/// Collects what a walk meets; call `finish` at the end.
class VrmlModel {
 public:
  VrmlModel(const std::string& path, const SceneFileRules& rules);

  /// The file whose materials come next.
  void set_file(const std::string& path) { file_ = path; }
  /// Length of all files read so far: nested USEs let a short file stand for any number of faces.
  void set_file_bytes(std::size_t bytes) { file_bytes_ = bytes; }

  /// A place below `parent` (an index, −1 = the root) under the name of a DEF.
  int enter(int parent, const std::string& name);

  /// Material of a node's colours; the same node and index again is the same material.
  MaterialId material(const void* node, int index, const VrmlMaterial& colours);

  /// Adds a shape; `materials` has one entry, or one for every `face_material`.
  void add(const ShapeFaces& shape, const Affine& file_from_shape, int place,
           const std::vector<MaterialId>& materials);

  NoteCounter& notes() { return notes_; }
  PolygonModel finish();

 private:
  double strength(const std::array<double, 3>& colour) const;
  ObjectId object_of(int place);

  SceneFileRules rules_;
  SceneFromFile scene_from_file_;
  PolygonModel model_;
  NoteCounter notes_;
  TransparentMaterials transparent_;
  std::string stem_;
  std::vector<VrmlPlace> places_;
  ObjectId nameless_;
  std::map<std::pair<const void*, int>, MaterialId> materials_;
  UniqueNames object_names_, material_names_;
  double largest_ = 0;
  std::size_t file_bytes_ = 0;
  std::string file_;
};

}  // namespace sunload
