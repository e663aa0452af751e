// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/variant_plan.h"

#include <algorithm>
#include <utility>

#include "io/plan/content_hash.h"
#include "io/plan/mesh_family.h"
#include "io/plan/study_measures.h"
#include "io/plan/weather_albedo.h"
#include "solver/solver.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

namespace {

/// Lamps of a file are given by their power, and watts of a lamp say nothing of its lumens.
void refuse_watts_in_lux(const VariantPlan& plan) {
  if (plan.study.light.quantity == Quantity::irradiance) return;
  const auto has_lumens = [&](const std::string& name) {
    return std::any_of(
        plan.study.scene.materials.begin(), plan.study.scene.materials.end(),
        [&](const MaterialStudy& m) { return m.name == name && m.emission_lm_m2 > 0; });
  };
  for (const Material& material : materials_of(plan))
    if (material.emission_w_m2 > 0 && !has_lumens(material.name))
      throw InputError(plan.study.scene.where,
                       "material '" + material.name + "' emits light by its file",
                       "in W/m2, and how much of it the eye sees is not known",
                       "write scene.materials: {" + material.name +
                           ": {emission_lm_m2: …}}, or light.quantity: irradiance");
}

/// Form factors are those of opaque diffuse surfaces.
void refuse_smooth_surfaces_in_a_matrix(const VariantPlan& plan) {
  if (plan.study.solver.transport != Transport::matrix) return;
  for (const Material& material : materials_of(plan))
    if (goes_on_straight(material))
      throw InputError(plan.study.scene.where,
                       "material '" + material.name + "' is a mirror, glass, glossy or lets pass",
                       "transport: matrix exchanges light between opaque diffuse surfaces",
                       "make it diffuse, or write solver.transport: gather or shoot");
}

/// Steps of one interval each are the intervals, whose series take less time and room.
void take_steps(VariantPlan& plan) {
  plan.steps = series_steps(plan.study, plan.light);
  if (plan.steps.size() != plan.intervals()) return;
  plan.steps.clear();
  plan.study.output.series_step = {};
}

}  // namespace

VariantPlan unhashed_plan_of(const Study& study, BuiltScene built, LightSeries light) {
  VariantPlan plan;
  plan.study = study;
  plan.isa = usable_isa(study.solver.isa);
  plan.built = std::move(built);
  plan.light = std::move(light);
  expect_albedos(study, plan.light, plan.built.warnings);
  plan.seasons = take_seasons(study, plan.light, plan.built);
  if (!study.solver.batch_suns) plan.study.solver.batch_suns = batch_suns_for(plan.intervals());
  plan.totals = part_totals(study, plan.light, plan.built.site.latitude_deg);
  take_steps(plan);
  refuse_watts_in_lux(plan);
  expect_measurable(study, plan.light);
  warn_of_absent_places(study, plan.built, plan.built.warnings);
  warn_of_no_faces(study, plan.built, plan.built.warnings);
  warn_of_no_values(study, plan.light, plan.built.warnings);
  if (has_lamps(plan)) warn_of_lamps(study, plan.built.warnings);
  refuse_smooth_surfaces_in_a_matrix(plan);
  plan.pairing_id = pairing_id(study, plan.light);
  return plan;
}

VariantPlan plan_of(const Study& study, BuiltScene built, LightSeries light) {
  VariantPlan plan = unhashed_plan_of(study, std::move(built), std::move(light));
  plan.content_hash = hash_with_isa(plan, plan.isa);
  return plan;
}

VariantPlan make_plan(const Study& study) {
  BuiltScene built = build_scene(study);
  LightSeries light = light_series(study, built.site);
  return plan_of(study, std::move(built), std::move(light));
}

std::string hash_with_isa(const VariantPlan& plan, const std::string& isa) {
  return content_hash(plan.study, plan.built, plan.light, isa,
                      plan.family ? plan.family->digest : std::string(), plan.seasons);
}

std::vector<Material> materials_of(const VariantPlan& plan) {
  std::vector<Material> materials = plan.built.scene.materials;
  for (const SceneSeason& season : plan.seasons.all)
    materials.insert(materials.end(), season.materials.begin(), season.materials.end());
  return materials;
}

bool has_lamps(const VariantPlan& plan) {
  const auto materials = materials_of(plan);
  return plan.built.scene.any_lamp_beside_surfaces() ||
         std::any_of(materials.begin(), materials.end(),
                     [](const Material& m) { return m.emission_w_m2 > 0; });
}

std::size_t lit_intervals(const VariantPlan& plan) {
  return has_lamps(plan) ? plan.intervals() : plan.light.lit_count();
}

std::size_t sun_count(const VariantPlan& plan, std::size_t batch) {
  const std::size_t begin = batch * plan.batch_suns();
  const std::size_t end = std::min(begin + plan.batch_suns(), plan.intervals());
  if (has_lamps(plan)) return end - begin;
  return plan.light.lit_count(begin, end);
}

}  // namespace sunload
