// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_land.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "io/base/name_pattern.h"
#include "io/plan/selection.h"

namespace sunload {

namespace {

constexpr const char* type_of_land = "TINRelief";  // CityJSON 2.0.1, section 2.2.9

std::string offer(const std::vector<std::string>& names) {
  return names.empty() ? "sunload check without scene.land lists what is there"
                       : fmt::format("did you mean '{}'?", fmt::join(names, "', '"));
}

}  // namespace

void call_land(const SceneStudy& scene, PolygonModel& model) {
  Problems problems;
  std::vector<std::string> kinds = model.object_kinds;
  kinds.resize(model.object_names.size());
  for (const auto& [pattern, where] : scene.land) {
    const ChosenObjects named =
        objects_named(pattern, FamilyTree(model.object_names, model.object_kinds, model.families));
    bool any = false;
    for (std::size_t o = 0; o < kinds.size(); ++o) {
      if (!named[o]) continue;
      any = true;
      kinds[o] = type_of_land;
    }
    if (!any)
      problems.add(where, fmt::format("scene.land: no object is called '{}'", pattern),
                   "what it names is the terrain", offer(near_names(pattern, model.object_names)));
  }
  problems.throw_if_any();
  model.object_kinds = std::move(kinds);
}

}  // namespace sunload
