// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/rules_of_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/measure/rules.h"

namespace sunload {

namespace {

/// The historic threshold F_eps is a form factor, the default one a number of lines.
double link_threshold(const Study& study) {
  const double threshold = study.mesh.link_threshold;
  return study.mesh.oracle == Oracle::historic ? threshold * study.solver.lines_per_patch
                                               : threshold;
}

}  // namespace

SplitRules split_rules(const Study& study) {
  return {.max_edge_m = study.mesh.max_edge_m, .min_area_m2 = study.mesh.min_area_m2};
}

RefineRules refine_rules(const Study& study) {
  return {.oracle = study.mesh.oracle,
          .light_tolerance = study.mesh.light_tolerance,
          .light_threshold_m2 = study.mesh.light_threshold_m2,
          .form_factor_threshold = study.mesh.link_threshold,
          .t_vertices = study.mesh.t_vertices};
}

bool stores_series(const OutputStudy& output, Part part) {
  const auto& names = output.series;
  return std::find(names.begin(), names.end(), part_names[static_cast<std::size_t>(part)]) !=
         names.end();
}

bool is_watched(const Study& study, Part part) {
  return std::any_of(study.measures.begin(), study.measures.end(), [&](const auto& measure) {
    return watched_light(*find_measure_rule(measure.rule), measure) ==
           part_names[static_cast<std::size_t>(part)];
  });
}

std::array<bool, part_count> kept_series(const OutputStudy& output) {
  std::array<bool, part_count> kept{};
  for (std::size_t p = 0; p < part_count; ++p)
    kept[p] = static_cast<Part>(p) == Part::total || stores_series(output, static_cast<Part>(p));
  return kept;
}

SolverRules solver_rules(const VariantPlan& plan) {
  const Study& study = plan.study;
  const SolverStudy& s = study.solver;
  return {.bounces = s.bounces,
          .unshot = s.unshot,
          .unfollowed = s.unfollowed,
          .lines_per_patch = s.lines_per_patch,
          .lines_of_patch = {},
          .direct_samples = s.direct_samples,
          .realizations = s.realizations,
          .mirror_depth = s.mirror_depth,
          .link_threshold = link_threshold(study),
          .seed = s.seed,
          .isa = plan.isa,
          .errors = study.output.standard_error == StandardErrors::instants ? Errors::instants
                                                                            : Errors::totals,
          .bands = s.bands,
          .transport = s.transport,
          .year = s.year,
          .jacobi = s.jacobi,
          .power_per_sample_w = s.power_per_sample_w,
          .samples_per_patch = {},
          .series = kept_series(study.output),
          .by_source = false};
}

AccuracyGoal accuracy_goal(const Study& study) {
  const AccuracyStudy& accuracy = *study.solver.accuracy;
  return {.light_load_relative = accuracy.light_load_relative,
          .most_per_patch = study.solver.max_lines_per_patch,
          .irradiance_relative = accuracy.irradiance_relative};
}

std::string goal_words(const AccuracyStudy& accuracy) {
  const auto load = accuracy.light_load_relative, irradiance = accuracy.irradiance_relative;
  std::string words = load ? fmt::format("{:.3g} %", 100 * *load) : "";
  if (load && irradiance) words += " and ";
  if (irradiance) words += fmt::format("{:.3g} % at every instant", 100 * *irradiance);
  return words;
}

}  // namespace sunload
