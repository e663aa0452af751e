// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of VRML97's geometries and of Inventor's shapes.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "io/scene/vrml/nodes.h"
#include "io/scene/vrml/shapes.h"

// NOLINTBEGIN(cppcoreguidelines-virtual-class-destructor): Coin's, which are counted
class SoCoordinate3;
class SoMFInt32;
class SoQuadMesh;
class SoVRMLElevationGrid;
class SoVRMLIndexedFaceSet;
// NOLINTEND(cppcoreguidelines-virtual-class-destructor)

namespace sunload {

/// Converts one geometry after another; keeps count of what it makes, against files that ask for
/// too much.
class VrmlFaces {
 public:
  using PlaceOf = std::function<Where(const SoNode&)>;
  /// `place_of` tells where a node stands, for messages.
  VrmlFaces(NoteCounter& notes, const VrmlFiles& files, PlaceOf place_of);

  /// None of a geometry that has no surface. Throws InputError.
  std::optional<ShapeFaces> of_vrml97(SoNode* geometry);

  /// What property nodes have set for an Inventor shape.
  struct Hints {
    SoCoordinate3* coordinates = nullptr;
    bool is_solid = false, is_clockwise = false;
  };
  /// The same of a shape of Inventor or VRML 1.0.
  std::optional<ShapeFaces> of_inventor(SoNode* shape, const Hints& hints);

 private:
  [[noreturn]] void refuse(const SoNode& node, const std::string& what,
                           const std::string& why) const;
  ShapeFaces face_set(SoVRMLIndexedFaceSet& node);
  ShapeFaces elevation_grid(SoVRMLElevationGrid& node);
  void add_faces(const SoNode& node, const SoMFInt32& indices, std::int32_t count,
                 ShapeFaces& shape);
  void add_vertex_shape(SoNode* node, std::int32_t count, ShapeFaces& shape);
  void add_rows(const SoNode& node, const SoMFInt32& lengths, std::int32_t first,
                std::int32_t count, ShapeFaces& shape);
  void add_mesh(const SoQuadMesh& node, std::int32_t count, ShapeFaces& shape);

  NoteCounter& notes_;
  const VrmlFiles& files_;
  PlaceOf place_of_;
  double extruded_ = 0;  ///< points of all Extrusions so far
};

}  // namespace sunload
