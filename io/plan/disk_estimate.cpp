// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/disk_estimate.h"

#include <algorithm>

#include "geo/sky/sky.h"
#include "io/plan/cost.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/surface_shares.h"
#include "io/plan/workload.h"

namespace sunload {

namespace {

using namespace cost;

/// What is kept of a line of a patch that has so many: links to diffuse surfaces and to the sky,
/// those of what mirrors and the like send on, and where it met a glossy surface.
double kept_bytes_of_line(const VariantPlan& plan, double lines_per_patch, bool guided) {
  const Mesh& mesh = plan.built.scene.mesh;
  return (guided ? kept_bytes_per_guided_line : 0) +
         mean_over_seasons(plan, [&](const MaterialsOfScene& of_season) {
           const auto is_linked = [](const Material& m) {
             return m.diffuse > 0 || m.emission_w_m2 > 0;
           };
           const auto is_glossy = [](const Material& m) { return m.glossy > 0; };
           const double linked = share_of_surfaces(mesh, of_season, is_linked);
           const double rays = rays_per_line(mesh, of_season, plan.study.solver.mirror_depth);
           const double met = share_that_meets * linked, left = 1 - share_that_meets;
           return kept_bytes_per_line(lines_per_patch) * (met + left) +
                  kept_bytes_per_weighted_link * (rays - 1) * (met + left) +
                  kept_bytes_per_glimpse * rays * share_that_meets *
                      share_of_surfaces(mesh, of_season, is_glossy);
         });
}

/// Lines and skies and suns of few that a process leaves for those that come later; of sensors
/// nothing. Written where there are two batches, and the scene is one in all seasons.
double prepared_bytes(const Workload& work) {
  const VariantPlan& plan = work.plan;
  if (plan.batches() < 2 || !plan.seasons.all.empty()) return 0;
  const double cells = work.has_mirrors ? SkyGrid().cell_count() + 1.0 : 0;  // and the far ground
  const double sets = plan.study.solver.realizations + 1.0;                  // and all together
  const double lines_per_patch = work.counts.mean_lines();
  return sets * (work.patches *
                     (kept_bytes_per_patch + (work.is_guided ? kept_bytes_per_lit_patch : 0) +
                      (work.by_matrix ? work.patches * kept_bytes_per_factor : 0)) +
                 cells * kept_bytes_per_cell) +
         work.patches * lines_per_patch *
             kept_bytes_of_line(plan, lines_per_patch, work.is_guided) +
         work.node_bytes();
}

/// The result but for series and parts of the period.
double result_bytes(const Workload& work) {
  const SolverStudy& s = work.plan.study.solver;
  const double kinds = work.kinds * result_bytes_per_kind + double_bytes * s.realizations;
  return bytes_per_result + work.receivers * geometry_bytes_per_patch +
         work.receivers * static_cast<double>(work.plan.study.measures.size()) * bytes_per_measure +
         work.bands * work.receivers * (result_bytes_per_patch + kinds);
}

/// Sun, sky, ledger and facades' means of every interval in batches and result, and what batches
/// have besides.
double interval_bytes(const Workload& work) {
  const auto facades = static_cast<double>(work.plan.built.scene.mesh.facades.size());
  return work.batches * bytes_per_batch +
         static_cast<double>(work.plan.intervals()) * work.bands * stored_bytes_per_interval +
         2 * work.lit * work.bands * facades * work.value_bytes;
}

/// Of parts of the period, in batches and in the result, for each receiver and band.
double bytes_of_parts(const Workload& work) {
  // Of every part: all light, the direct one, sun hours; with errors the realizations, too.
  constexpr double sums_of_part = 3, values_of_part = 4;
  const double realizations = work.plan.study.solver.realizations;
  const auto& of = work.periods;
  return static_cast<double>(of.stored) * sums_of_part * double_bytes +
         static_cast<double>(of.stored_with_errors) * float_bytes * realizations +
         float_bytes * (static_cast<double>(of.parts) * values_of_part +
                        static_cast<double>(of.parts_with_errors) * realizations);
}

}  // namespace

SeriesBytes series_bytes(const VariantPlan& plan, double series, double value_bytes) {
  const auto lit = static_cast<double>(lit_intervals(plan));
  const auto batch = static_cast<double>(std::min(plan.batch_suns(), plan.intervals()));
  if (plan.steps.empty()) return {batch * series * value_bytes, 0, 2 * lit * series * value_bytes};
  const auto steps = static_cast<double>(plan.steps.size()),
             batches = static_cast<double>(plan.batches());
  // A batch begins and ends within steps.
  const double of_steps = series * double_bytes * (steps / batches + 1);
  double watched = 0;
  for (std::size_t p = 0; p < part_count; ++p)
    watched += is_watched(plan.study, static_cast<Part>(p)) ? 1 : 0;
  return {
      of_steps + watched * batch * stored_bytes_per_value,
      series * (static_cast<double>(series_step_rows) * float_bytes + double_bytes),
      batches * of_steps + watched * lit * stored_bytes_per_value + steps * series * value_bytes};
}

double disk_bytes(const Workload& work) {
  return work.bands * work.receivers *
             (work.series.on_disk + work.batches * work.batch_sum_bytes() + bytes_of_parts(work)) +
         result_bytes(work) + interval_bytes(work) + prepared_bytes(work);
}

}  // namespace sunload
