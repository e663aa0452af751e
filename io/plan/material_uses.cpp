// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/material_uses.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "geo/base/check.h"
#include "io/base/name_pattern.h"
#include "io/plan/material_assign.h"
#include "io/plan/planner.h"
#include "io/plan/scene_build.h"

namespace sunload {

namespace {

using MaterialNames = std::set<std::string>;

/// What rules, seasons and ground of the study give to surfaces.
MaterialNames given_by_study(const SceneStudy& scene) {
  MaterialNames given;
  for (const AssignRule& rule : scene.assign) given.insert(rule.material);
  for (const MaterialStudy& m : scene.materials)
    for (const SeasonMaterial& in : m.seasons) given.insert(in.material);
  if (scene.ground) given.insert(scene.ground->material);
  return given;
}

/// What the faces have by the files and steps of the scene, whatever is left of them.
MaterialNames made_of(const Mesh& mesh) {
  MaterialNames names;
  for (const FileMaterial& m : mesh.file_materials) names.insert(m.name);
  for (const MaterialId id : mesh.triangle_material)
    if (!id.exists() || mesh.file_materials[id.index()].name.empty())
      names.insert(nameless_material);
  return names;
}

bool defines(const Study& study, const std::string& material) {
  return std::any_of(study.scene.materials.begin(), study.scene.materials.end(),
                     [&](const MaterialStudy& m) { return m.name == material; });
}

}  // namespace

bool MaterialUses::is_used_anywhere(const std::string& material) {
  if (const auto known = used_.find(material); known != used_.end()) return known->second;
  // What it costs to look elsewhere is paid for slips, and once.
  const bool is_used =
      std::any_of(file_.variants.begin(), file_.variants.end(), [&](const Study& variant) {
        if (!defines(variant, material)) return false;
        if (given_by_study(variant.scene).contains(material)) return true;
        try {
          const auto of_sources = materials_of_parallel_sources(variant.scene);
          return std::find(of_sources.begin(), of_sources.end(), material) != of_sources.end() ||
                 made_of(planner_.scene_uncovered(variant).scene.mesh).contains(material);
        } catch (const InputError&) {
          return true;  // its scene cannot be made, which is told where it is planned
        }
      });
  used_[material] = is_used;
  return is_used;
}

void MaterialUses::warn_of_idle(VariantPlan& plan) {
  const SceneStudy& scene = plan.study.scene;
  MaterialNames used = given_by_study(scene);
  used.merge(made_of(plan.built.scene.mesh));
  used.erase("");
  for (const MaterialStudy& m : scene.materials) {
    if (used.contains(m.name) || is_used_anywhere(m.name)) continue;
    const auto near = near_names(m.name, {used.begin(), used.end()});
    plan.built.warnings.push_back(
        message(m.where, fmt::format("material '{}' is used by nothing", m.name),
                "no surface, rule, season or ground of the scene has it, nor do parallel sources",
                near.empty() ? "give it by scene.assign, or remove it"
                             : fmt::format("did you mean '{}'?", fmt::join(near, "', '"))));
  }
}

}  // namespace sunload
