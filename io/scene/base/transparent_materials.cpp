// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/base/transparent_materials.h"

namespace sunload {

void TransparentMaterials::count_used(const PolygonModel& model, NoteCounter& notes) const {
  if (materials_.empty()) return;
  std::set<MaterialId> used;
  for (const auto& facts : model.facts)
    if (materials_.contains(facts.material)) used.insert(facts.material);
  notes.count("transparencies of materials ignored", used.size());
}

}  // namespace sunload
