// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/memory_estimate.h"

#include <algorithm>

#include "io/plan/cost.h"
#include "io/plan/rules_of_study.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

using namespace cost;

/// Bytes of a patch while the tests of few solutions are made: what every realization receives in a
/// block, sums of its squares, and what is kept of each test.
double test_bytes_per_patch(double realizations, bool mirrors) {
  const double block = block_width * float_bytes;
  const double kinds = mirrors ? 3 : 2;  // straight, circumsolar, by mirrors
  constexpr double of_light = 10;        // what blocks of light are made of
  constexpr double spread = 16;          // sums and squares, in doubles
  constexpr double kept = 6;
  constexpr double blocks = static_cast<double>(year_tests) / static_cast<double>(block_width);
  return block *
         (realizations * kinds + of_light + spread + blocks * (kept + realizations * packed_share));
}

/// Scenes and lines of all seasons, suns, and what is known of every patch.
double bytes_of_scenes(const Workload& work) {
  const auto triangles = static_cast<double>(work.plan.built.scene.mesh.triangle_count());
  return program_bytes + work.seasons * work.lines * bytes_per_line +
         static_cast<double>(work.plan.light.parts()) * bytes_per_interval +
         std::min(most_bytes_of_share_grid, work.grid_points * work.patches) +
         work.receivers * bytes_per_patch +
         (work.seasons - 1) *
             (work.receivers * season_bytes_per_patch + triangles * season_bytes_per_triangle);
}

/// Light of a batch while it is computed, and that of the one before while it is written, for each
/// receiver.
double bytes_of_batches(const Workload& work) {
  return work.batch * work.kept_kinds * float_bytes + work.series.of_batch +
         work.batch_sum_bytes() + work.series.of_merge;
}

/// Totals of the period and of its parts.
double bytes_of_totals(const Workload& work) {
  // Of every part: all light, the direct one, sun hours; with errors the realizations, too.
  constexpr double sums_of_part = 3;
  const double arrays = arrays_of_realizations * double_bytes * work.plan.study.solver.realizations;
  return work.bands * work.receivers *
         (arrays + static_cast<double>(work.periods.most) * (arrays + sums_of_part * double_bytes));
}

/// The sun's light of each realization, straight and circumsolar, and by mirrors.
double bytes_of_realizations(const Workload& work) {
  if (!work.of_instants && work.plan.study.solver.bands != Bands::rgb) return 0;
  return work.receivers * work.plan.study.solver.realizations * block_width * float_bytes *
         (work.has_mirrors ? 3.0 : 2.0);
}

/// Few solutions: their tests, which are over before the first batch, and nodes.
double bytes_of_year(const Workload& work) {
  if (!work.of_few) return 0;
  const double of_tests =
      work.receivers * test_bytes_per_patch(work.plan.study.solver.realizations, work.has_mirrors);
  // Light of the sky and reflected light of a batch, kept until their time sums are known.
  constexpr double kinds = 2;
  return std::max(0.0, of_tests - work.receivers * bytes_of_batches(work)) +
         work.seasons * work.node_bytes() +
         kinds * work.bands * work.receivers * work.batch * float_bytes * packed_share;
}

double bytes_of_matrix(const Workload& work) {
  if (!work.by_matrix) return 0;
  return work.seasons * work.receivers * work.receivers *
         ((work.plan.study.solver.realizations + 1.0) * bytes_per_form_factor +
          thread_count() * bytes_per_factor_solved);
}

double bytes_of_shots(const Workload& work, const ShotSamples& samples) {
  if (!work.shoots) return 0;
  const double realizations = work.plan.study.solver.realizations;
  return work.receivers *
             (shooting_bytes_per_patch + double_bytes * realizations * columns_of_a_realization) +
         samples.of_one_shot / realizations * bytes_per_sample;
}

}  // namespace

double memory_bytes(const Workload& work, const ShotSamples& samples) {
  return bytes_of_scenes(work) + work.bands * work.receivers * bytes_of_batches(work) +
         bytes_of_totals(work) + bytes_of_realizations(work) + bytes_of_year(work) +
         bytes_of_matrix(work) + bytes_of_shots(work, samples);
}

double accuracy_pilot_memory_bytes(const VariantPlan& plan, std::size_t patches) {
  const bool of_instants = plan.study.solver.accuracy->irradiance_relative.has_value();
  const SolverRules rules = rules_of_accuracy_pilot(solver_rules(plan), of_instants);
  const double R = rules.realizations, block = block_width * float_bytes;
  constexpr double sun_columns = 4;      // straight, circumsolar, by mirrors, all of them
  constexpr double spread_columns = 16;  // sums, squares, variances of three sources, in doubles
  double per_patch = rules.lines_per_patch * bytes_per_line + bytes_per_patch +
                     arrays_of_realizations * double_bytes * R;
  if (of_instants) per_patch += (sun_columns * R + spread_columns) * block;
  if (rules.transport == Transport::shoot)
    per_patch += shooting_bytes_per_patch + columns_of_a_realization * double_bytes * R;
  return program_bytes + static_cast<double>(patches) * per_patch;
}

}  // namespace sunload
