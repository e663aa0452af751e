// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials that a file's appearances give to surfaces.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "geo/mesh/mesh.h"
#include "io/scene/base/transparent_materials.h"
#include "io/scene/citygml/document.h"

namespace sunload {

/// X3DMaterial by the ids that it targets. Of several themes the first in alphabetical order is
/// taken for each target; materials of backs are not read.
class CityAppearance {
 public:
  /// Adds the materials of the file to `model`.
  CityAppearance(const CityDocument& document, PolygonModel& model, NoteCounter& notes);

  /// The material of the element with this id, or `otherwise`.
  MaterialId of(XmlElement element, MaterialId otherwise) const;

  const TransparentMaterials& transparent() const { return transparent_; }

 private:
  struct Themed {
    std::string theme;
    MaterialId material;
  };
  MaterialId add_material(XmlElement material, PolygonModel& model, NoteCounter& notes);

  std::unordered_map<std::string, Themed> of_id_;
  std::unordered_map<std::string, MaterialId> ids_;  ///< by name and colour
  TransparentMaterials transparent_;
};

}  // namespace sunload
