// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials that a file calls transparent: no reader takes that, and each tells how many.
#pragma once

#include <set>

#include "geo/mesh/mesh.h"
#include "io/base/file_text.h"

namespace sunload {

/// What light passes is the study's to say, by materials of its own: the shares that files give are
/// for looks.
class TransparentMaterials {
 public:
  void add(MaterialId material) { materials_.insert(material); }

  /// Counts those that a polygon of the model has.
  void count_used(const PolygonModel& model, NoteCounter& notes) const;

 private:
  std::set<MaterialId> materials_;
};

}  // namespace sunload
