// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/study_plan.h"

#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "solver/solver.h"
#include "tests/support/program.h"

namespace sunload::test {

VariantPlan plan_of(const std::string& yaml) {
  const WorkFolder folder;
  return make_plan(read_study(folder.write("study.yaml", yaml)).variants.front());
}

std::string night_study(const std::string& builtin, const std::string& sections) {
  return "format: sunload-study-1\nname: " + builtin +
         "\nperiod: {positions: [{azimuth_deg: 180, elevation_deg: 45, interval_min: 60}]}\n"
         "light: {source: fixed, dni_w_m2: 0, dhi_w_m2: 0, far_ground_albedo: 0}\n"
         "scene: {builtin: {name: " +
         builtin + "}}\n" + sections;
}

std::vector<IntervalLight> suns_of(const VariantPlan& plan, const SkyGrid& grid) {
  return IntervalLights(plan.study, plan.built.site, grid).of(plan.light);
}

const std::string& SolvedPlan::object(std::size_t patch) const {
  const Mesh& m = plan.built.scene.mesh;
  const auto triangle = static_cast<std::size_t>(mesh().patches()[patch].triangle);
  return m.object_names[m.triangle_object[triangle].index()];
}

std::vector<double> SolvedPlan::load(std::size_t patch) const {
  std::vector<double> load;
  for (const auto& realization : tally.exposure_realization) load.push_back(realization[patch]);
  return load;
}

SolvedPlan solve_study(const std::string& yaml) {
  Watch watch;
  SolvedPlan solved{plan_of(yaml), {}, {}, {}};
  solved.made = make_mesh(solved.plan, watch);
  const auto traced =
      trace_scene(solved.plan.built.scene, solved.made.mesh, solver_rules(solved.plan), watch);
  const IntervalLights lights(solved.plan.study, solved.plan.built.site, traced->grid);
  const SeriesLight period(lights, solved.plan.light);
  const auto transport = transport_of(*traced, period, watch);
  if (const Reduction* reduction = transport->reduction()) solved.reduction = *reduction;
  solved.tally =
      std::move(solve(*transport, suns_of(solved.plan, traced->grid), watch).bands.front());
  return solved;
}

}  // namespace sunload::test
