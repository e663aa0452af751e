// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/check_meshes.h"

#include <fmt/format.h>

#include "io/plan/mesh_family.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/work_estimate.h"

namespace sunload {

bool is_left_unrefined(const VariantPlan& plan, CheckMesh mesh) {
  return mesh == CheckMesh::unrefined && plan.study.mesh.oracle != Oracle::none;
}

const VariantMesh& CheckMeshes::of(const VariantPlan& plan) {
  if (plan.study.mesh.oracle == Oracle::none || kind_ == CheckMesh::unrefined) {
    if (!has_unrefined_of(plan)) keep_unrefined_of(plan);
    return unrefined_;
  }
  if (!plan.family || !plan.family->made) tell_of_refinement(plan);
  progress_.begin_variant(plan.study.variant, 0);
  refined_ = make_mesh(plan, progress_);
  return refined_;
}

bool CheckMeshes::has_unrefined_of(const VariantPlan& plan) const {
  const Mesh& mesh = plan.built.scene.mesh;
  const SplitRules rules = split_rules(plan.study);
  return unrefined_.mesh && rules.max_edge_m == rules_.max_edge_m &&
         rules.min_area_m2 == rules_.min_area_m2 && mesh.triangles == triangles_ &&
         mesh.vertices == vertices_ && mesh.triangle_sides == sides_ &&
         mesh.triangle_surface == surfaces_ && mesh.triangle_object == objects_;
}

void CheckMeshes::keep_unrefined_of(const VariantPlan& plan) {
  unrefined_ = unrefined_mesh(plan);
  const Mesh& mesh = plan.built.scene.mesh;
  rules_ = split_rules(plan.study);
  triangles_ = mesh.triangles;
  vertices_ = mesh.vertices;
  sides_ = mesh.triangle_sides;
  surfaces_ = mesh.triangle_surface;
  objects_ = mesh.triangle_object;
}

/// So that nobody waits without knowing for what.
void CheckMeshes::tell_of_refinement(const VariantPlan& plan) {
  constexpr double worth_telling_s = 2;
  const std::size_t patches = least_patch_count(plan.built.scene, split_rules(plan.study));
  const auto [least_s, most_s] = refinement_seconds(plan, patches);
  if (most_s < worth_telling_s) return;
  progress_.say(
      fmt::format("{}: refines its mesh of {} patches, which takes between {:.0f} s and {:.0f} "
                  "s; --no-refine "
                  "leaves this out",
                  plan.study.variant, patches, least_s, most_s));
}

}  // namespace sunload
