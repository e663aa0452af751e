// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces by index into a table of vertices: what PLY, OFF and the like hold.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "geo/mesh/mesh.h"
#include "io/scene/base/from_file.h"
#include "io/scene/base/transparent_materials.h"

namespace sunload {

/// Collects vertices and faces; `finish` makes the model of them.
class IndexedFaces {
 public:
  /// `default_up` is that of the format. Until `use_object` the object is the file's stem.
  IndexedFaces(const std::string& path, const SceneFileRules& rules, char default_up);

  /// Room for so many, where a header promises them.
  void expect(std::size_t vertices, std::size_t faces);

  /// False where the position is beyond all coordinates on Earth.
  bool add_vertex(Vec3 in_file);
  /// That a position was read in single precision: far from the origin that is coarse.
  void note_single_precision(Vec3 as_read);
  std::size_t vertex_count() const { return vertices_.size(); }
  std::size_t corner_count() const { return model_.ring_vertex.size(); }

  /// What the faces that follow belong to; the same name again is the same object.
  /// `kind` is a CityJSON type or empty.
  void use_object(const std::string& name, const std::string& kind = {});
  /// `other` until it is called: decided by preparation.
  void use_surface(Surface surface) { facts_.surface = surface; }
  void use_material(MaterialId material, Sides sides = Sides::one);
  MaterialId add_material(FileMaterial material);
  /// That the file lets light pass it.
  void note_transparent(MaterialId material) { transparent_.add(material); }

  /// Corners of the next face one by one; faces of fewer than 3 are left out and counted.
  void add_corner(std::int32_t vertex) { model_.ring_vertex.push_back(vertex); }
  void end_face();

  NoteCounter& notes() { return notes_; }

  /// Vertices that no face uses are left out: they would only blow up the bounding box.
  /// All corners must be within [0, vertex_count()).
  PolygonModel finish();

 private:
  /// What single precision leaves of coordinates far from the origin.
  void tell_coarse_steps();

  SceneFromFile scene_from_file_;
  PolygonModel model_;
  NoteCounter notes_;
  TransparentMaterials transparent_;
  std::vector<Vec3> vertices_;
  std::unordered_map<std::string, ObjectId> objects_;
  std::string object_name_, object_kind_;
  PolygonModel::Facts facts_;
  double largest_single_ = 0;  ///< coordinate that was read in single precision
};

}  // namespace sunload
