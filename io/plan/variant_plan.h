// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What one variant of a study will compute.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/plan/light_series.h"
#include "io/plan/part_totals.h"
#include "io/plan/scene_build.h"
#include "io/plan/scene_seasons.h"
#include "io/plan/series_steps.h"
#include "io/study/study.h"

namespace sunload {

struct MeshFamily;

struct VariantPlan {
  Study study;       ///< with a number of batch_suns; no series_step where steps are intervals
  BuiltScene built;  ///< with materials as written, where they change with the seasons
  SceneSeasons seasons;
  LightSeries light;
  std::vector<PartTotals> totals;  ///< of parts of the period
  std::vector<SeriesStep> steps;   ///< of stored series; none: they are of intervals
  std::string isa;                 ///< that rays will be traced with
  std::string content_hash;        ///< SHA-256 of everything that can change a number
  /// Equal where realizations share their random numbers. Counts that an accuracy has raised are no
  /// part of it: the first points are the same, and pairs are independent of each other.
  std::string pairing_id;
  /// The variants that it shares a mesh with; null: none.
  std::shared_ptr<const MeshFamily> family = {};

  std::size_t intervals() const { return light.intervals.size(); }
  std::size_t batch_suns() const { return static_cast<std::size_t>(*study.solver.batch_suns); }
  std::size_t batches() const { return (intervals() + batch_suns() - 1) / batch_suns(); }
};

/// Reads the scene, makes sun path and light, and hashes. Throws InputError.
VariantPlan make_plan(const Study& study);
/// The same of what was read and computed before. Throws InputError.
VariantPlan plan_of(const Study& study, BuiltScene built, LightSeries light);
/// Without its hash, for those who need many plans and few hashes.
VariantPlan unhashed_plan_of(const Study& study, BuiltScene built, LightSeries light);

/// Content hash that the plan would have with another instruction set.
std::string hash_with_isa(const VariantPlan& plan, const std::string& isa);

/// Materials of the scene in all its seasons; some may be there more than once.
std::vector<Material> materials_of(const VariantPlan& plan);
/// Whether something in the scene shines by itself: then dark intervals are computed too.
bool has_lamps(const VariantPlan& plan);
/// Intervals with light, which are all where lamps shine.
std::size_t lit_intervals(const VariantPlan& plan);
/// Sun positions of a batch that cost work: intervals that are not dark, all of them with lamps.
std::size_t sun_count(const VariantPlan& plan, std::size_t batch);

}  // namespace sunload
