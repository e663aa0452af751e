// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The frozen mesh of a variant: split, refined by a pilot of the study's own suns.
#pragma once

#include <memory>
#include <optional>

#include "io/plan/variant_plan.h"
#include "solver/mesh/refine.h"

namespace sunload {

/// Up to so many suns the mesh pilot takes as they are; of more, two samples of half as many.
inline constexpr std::size_t most_mesh_pilot_suns = 32;

/// The light of a period in short, of its intervals that are not dark; `season`: of those in it
/// alone (SceneSeasons).
PeriodLight period_light(const VariantPlan& plan, std::optional<std::size_t> season = {});

/// A mesh, and how refinement ended.
struct VariantMesh {
  std::shared_ptr<const Hierarchy> mesh;
  RefineReport report;
};

/// Splits and refines. Depends on the plan's content alone, hence is the same for every shard.
/// Throws InputError beyond the largest number of patches, MachineError, Interrupted.
VariantMesh make_mesh(const VariantPlan& plan, Watch& watch);

/// The mesh before it is refined: the fewest patches that the variant can have. Throws InputError
/// beyond the largest number of patches.
VariantMesh unrefined_mesh(const VariantPlan& plan);

/// What refinement did, in words; empty where none was asked for.
std::string refine_text(const RefineReport& report, const Study& study);

/// The largest patch of every kind of surface with its object, the largest first: "ground 812 m2
/// (ground), wall 12.3 m2 (house_2)".
std::string largest_patches_text(const VariantPlan& plan, const Hierarchy& mesh);

}  // namespace sunload
