// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/disk_estimate.h"

#include <algorithm>

#include "geo/sky/sky.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/surface_shares.h"
#include "solver/base/cost.h"

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

double prepared_bytes(const VariantPlan& plan, double patches, double lines_per_patch, bool guided,
                      double node_bytes) {
  if (plan.batches() < 2 || !plan.seasons.all.empty()) return 0;
  const auto materials = materials_of(plan);
  const bool sent_on = std::any_of(materials.begin(), materials.end(), sends_on);
  const double cells = sent_on ? SkyGrid().cell_count() + 1.0 : 0;  // and the far ground
  const bool by_matrix = plan.study.solver.transport == Transport::matrix;
  const double sets = plan.study.solver.realizations + 1.0;  // and all together
  return sets * (patches * (kept_bytes_per_patch + (guided ? kept_bytes_per_lit_patch : 0) +
                            (by_matrix ? patches * kept_bytes_per_factor : 0)) +
                 cells * kept_bytes_per_cell) +
         patches * lines_per_patch * kept_bytes_of_line(plan, lines_per_patch, guided) + node_bytes;
}

double result_bytes(const VariantPlan& plan, double n, double parts, double bands) {
  const double kinds =
      parts * result_bytes_per_kind + double_bytes * plan.study.solver.realizations;
  return bytes_per_result + n * geometry_bytes_per_patch +
         n * static_cast<double>(plan.study.measures.size()) * bytes_per_measure +
         bands * n * (result_bytes_per_patch + kinds);
}

double interval_bytes(const VariantPlan& plan, double bands, double value_bytes) {
  const auto facades = static_cast<double>(plan.built.scene.mesh.facades.size());
  return static_cast<double>(plan.batches()) * bytes_per_batch +
         static_cast<double>(plan.intervals()) * bands * stored_bytes_per_interval +
         2 * static_cast<double>(lit_intervals(plan)) * bands * facades * value_bytes;
}

}  // namespace sunload
