// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/planner.h"

#include <fmt/format.h>

#include "geo/base/check.h"
#include "io/plan/joined_intervals.h"
#include "io/plan/scene_cut.h"
#include "io/plan/weather_albedo.h"

namespace sunload {
namespace {

/// Everything that reading and preparing the scene depends on: all but materials and their rules,
/// and north.
std::string key_of_scene(const Study& study) {
  Study key;
  key.site = study.site;
  if (key.site.north_deg && !are_cut_by_north(study.scene)) key.site.north_deg = 0;
  key.scene = study.scene;
  key.scene.materials.clear();
  key.scene.assign.clear();
  std::string text = canonical_text(key);
  for (const auto& file : study.scene.files)
    text += "\n" + file.path + "\n" + file.terrain + "\n" + file.canopy;
  // Without a position of its own the scene is where the weather station stands, and only suns
  // that are put somewhere need none.
  return text + "\n" + study.light.weather + "\n" + std::to_string(study.period.kind.index()) +
         "\n" + study.scene.where.file;
}

/// A scene with a CRS has a north of its own, which that of a study is compared with.
std::string key_with_north(const std::string& key, const Study& study) {
  return key + fmt::format("\nnorth {}", study.site.north_deg.value_or(0));
}

double weight_of(const BuiltScene& built) {
  return static_cast<double>(built.scene.mesh.triangle_count());
}

}  // namespace

std::string Planner::key_of_light(const Study& study, const Site& site) {
  Study key;
  key.site = study.site;
  key.period = study.period;
  key.sun = study.sun;
  key.light = study.light;
  if (!study.light.far_ground_seasons.empty()) key.seasons = study.seasons;
  key.solver.sun_samples_per_interval = study.solver.sun_samples_per_interval;
  return canonical_text(key) +
         fmt::format("\n{} {} {} {} {}\n{}\n{}\n{}", site.latitude_deg, site.longitude_deg,
                     site.elevation_m, site.north_deg, site.timezone, study.light.weather,
                     asks_for_albedos(study) ? "albedos" : "", joining_words(study));
}

/// `key` gets what it is kept by.
const BuiltScene& Planner::scene_before_materials(const Study& study, std::string& key) {
  const std::string of_any_north = key_of_scene(study);
  key = of_any_north;
  if (BuiltScene* turnable = scenes_.of(key)) {
    turn_to_north(study, *turnable);
    return *turnable;
  }
  key = key_with_north(of_any_north, study);
  if (const BuiltScene* known = scenes_.of(key)) return *known;
  BuiltScene built = sunload::scene_before_materials(study);
  if (built.crs.empty()) key = of_any_north;
  const double weight = weight_of(built);
  return scenes_.keep(key, std::move(built), weight);
}

const BuiltScene& Planner::scene_uncovered(const Study& study) {
  std::string key;
  const BuiltScene& prepared = scene_before_materials(study, key);
  const FactsOfScene facts = surface_facts(study, prepared);
  key += '\n' + facts.key();
  if (BuiltScene* known = uncovered_.of(key)) {
    if (known->crs.empty()) turn_to_north(study, *known);
    return *known;
  }
  BuiltScene built = sunload::scene_uncovered(study, prepared, facts);
  const double weight = weight_of(built);
  return uncovered_.keep(key, std::move(built), weight);
}

const LightSeries& Planner::light(const Study& study, const Site& site) {
  const std::string key = key_of_light(study, site);
  if (const LightSeries* known = lights_.of(key)) return *known;
  LightSeries series = light_series(study, site);
  const auto weight = static_cast<double>(series.intervals.size());
  return lights_.keep(key, std::move(series), weight);
}

VariantPlan Planner::unhashed_plan(const Study& study) {
  BuiltScene built = scene_uncovered(study);
  give_materials(study, built);
  const LightSeries& of_period = light(study, built.site);
  return unhashed_plan_of(study, std::move(built), of_period);
}

VariantPlan Planner::plan(const Study& study) {
  VariantPlan plan = unhashed_plan(study);
  plan.content_hash = hash_with_isa(plan, plan.isa);
  return plan;
}

}  // namespace sunload
