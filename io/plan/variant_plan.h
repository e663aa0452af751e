// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What one variant of a study will compute, and the hash that names it.
#pragma once

#include <string>
#include <vector>

#include "io/plan/light_series.h"
#include "io/plan/scene_build.h"
#include "io/study/study.h"
#include "solver/accuracy.h"
#include "solver/solver.h"

namespace sunload {

/// Raised when results change, not at every commit: part of the content hash.
inline constexpr int numerics_version = 6;

struct VariantPlan {
  Study study;
  BuiltScene built;
  LightSeries light;
  std::string isa;           ///< that rays will be traced with
  std::string content_hash;  ///< SHA-256 of everything that can change a number
  /// Equal where realizations share their random numbers. Counts that an accuracy has raised are no
  /// part of it: the first points are the same, and pairs are independent of each other.
  std::string pairing_id;

  std::size_t intervals() const { return light.intervals.size(); }
  std::size_t batch_suns() const { return static_cast<std::size_t>(study.solver.batch_suns); }
  std::size_t batches() const { return (intervals() + batch_suns() - 1) / batch_suns(); }
};

/// Reads the scene, makes sun path and light, and hashes. Throws InputError.
VariantPlan make_plan(const Study& study);

/// Content hash that the plan would have with another instruction set.
std::string hash_with_isa(const VariantPlan& plan, const std::string& isa);

SplitRules split_rules(const Study& study);
RefineRules refine_rules(const Study& study);
/// With the study's own counts, which `accuracy` makes the least ones.
SolverRules solver_rules(const VariantPlan& plan);
/// The study's goal; only of a study that has one.
AccuracyGoal accuracy_goal(const Study& study);
/// Memory of the pilot that an accuracy asks for.
double pilot_memory_bytes(const VariantPlan& plan, std::size_t patches);
/// "1 %", "5 % at every instant" or both.
std::string goal_words(const AccuracyStudy& accuracy);

/// Whether something in the scene shines by itself: then dark intervals are computed too.
bool has_lamps(const VariantPlan& plan);
/// Sun positions of a batch that cost work: intervals with light.
std::size_t sun_count(const VariantPlan& plan, std::size_t batch);

/// Work, memory, disk and time of a variant, estimated before it starts.
struct WorkEstimate {
  std::size_t patches = 0;
  std::uint64_t line_rays = 0, direct_rays = 0;
  std::uint64_t samples = 0;  ///< that are shot
  double memory_bytes = 0, disk_bytes = 0, seconds = 0;
};
WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches);
/// The same with other counts than the study's own.
WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches,
                           const SampleCounts& counts);

}  // namespace sunload
