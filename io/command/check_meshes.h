// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The meshes that `sunload check` looks at.
#pragma once

#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "io/run/progress.h"

namespace sunload {

/// Whether the mesh is refined as a run would do it, or told without: seconds, or much less.
enum class CheckMesh { refined, unrefined };

/// Whether a run would refine what is looked at unrefined.
bool is_left_unrefined(const VariantPlan& plan, CheckMesh mesh);

/// Meshes of variants one after the other. Refinement is told of before it begins, and while it
/// goes on; without it the mesh follows from triangles alone, and most variants have the same.
class CheckMeshes {
 public:
  CheckMeshes(CheckMesh kind, ProgressStyle progress) : kind_(kind), progress_(progress) {}

  /// Stays until the next is asked for.
  const VariantMesh& of(const VariantPlan& plan);

 private:
  bool has_unrefined_of(const VariantPlan& plan) const;
  void keep_unrefined_of(const VariantPlan& plan);
  void tell_of_refinement(const VariantPlan& plan);

  CheckMesh kind_;
  Progress progress_;
  VariantMesh refined_, unrefined_;
  // What `unrefined_` was made from.
  SplitRules rules_;
  decltype(Mesh::triangles) triangles_;
  decltype(Mesh::vertices) vertices_;
  decltype(Mesh::triangle_sides) sides_;
  decltype(Mesh::triangle_surface) surfaces_;
  decltype(Mesh::triangle_object) objects_;
};

}  // namespace sunload
