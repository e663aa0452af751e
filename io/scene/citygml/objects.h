// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// City objects of a file, and which of their geometries are read.
#pragma once

#include <string>
#include <vector>

#include "io/scene/base/city_types.h"
#include "io/scene/base/lod.h"
#include "io/scene/citygml/document.h"

namespace sunload {

/// A geometry of an object or of one of its boundary surfaces.
struct CityGeometry {
  XmlElement geometry;  ///< GML, or ImplicitGeometry
  Lod lod;
  SemanticSurface surface;      ///< of the boundary surface, `other` where it is of the object
  bool is_of_boundary = false;  ///< of a boundary surface
  bool is_roof_edge = false;    ///< lod0RoofEdge
};

/// A Building, a BuildingPart, a WaterBody …
struct CityObject {
  XmlElement element;
  std::string type;  ///< as CityJSON has it
  bool is_part = false;
  std::vector<CityGeometry> geometries;  ///< all of one level once they are chosen
  LodRank rank{};
  std::vector<CityObject> children;
};

/// The object of a feature of the file with those inside of it, and the geometries that are read:
/// of one level each, by the rules of `read_scene_citygml`. Interior features are left out.
CityObject city_object(XmlElement feature, const CityDocument& document, const LodWish& wish,
                       NoteCounter& notes);

/// Whether a feature is inside of a building, bridge or tunnel, or no longer there; noted where it
/// is.
bool is_left_out(XmlElement feature, NoteCounter& notes);

}  // namespace sunload
