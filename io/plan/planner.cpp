// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/planner.h"

#include <fmt/format.h>

#include "geo/base/check.h"

namespace sunload {
namespace {

/// Everything that reading and preparing the scene depends on: all but materials and their rules.
std::string key_of_scene(const Study& study) {
  Study key;
  key.site = study.site;
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

std::string key_of_light(const Study& study, const Site& site) {
  Study key;
  key.site = study.site;
  key.period = study.period;
  key.sun = study.sun;
  key.light = study.light;
  return canonical_text(key) + fmt::format("\n{} {} {} {} {}\n{}", site.latitude_deg,
                                           site.longitude_deg, site.elevation_m, site.north_deg,
                                           site.timezone, study.light.weather);
}

}  // namespace

const BuiltScene& Planner::scene_before_materials(const Study& study) {
  const std::string key = key_of_scene(study);
  if (key == scene_key_) return scene_;
  scene_key_.clear();
  is_uncovered_ = false;
  scene_ = sunload::scene_before_materials(study);
  scene_key_ = key;
  return scene_;
}

const BuiltScene& Planner::scene_uncovered(const Study& study) {
  const BuiltScene& prepared = scene_before_materials(study);
  auto covers = covers_of(study, prepared);
  if (is_uncovered_ && covers == covers_) return uncovered_;
  is_uncovered_ = false;
  uncovered_ = sunload::scene_uncovered(study, prepared, covers);
  covers_ = std::move(covers);
  is_uncovered_ = true;
  return uncovered_;
}

const LightSeries& Planner::light(const Study& study, const Site& site) {
  const std::string key = key_of_light(study, site);
  if (key == light_key_) return light_;
  light_key_.clear();
  light_ = light_series(study, site);
  light_key_ = key;
  return light_;
}

VariantPlan Planner::plan(const Study& study) {
  BuiltScene built = scene_uncovered(study);
  give_materials(study, built);
  const LightSeries& of_period = light(study, built.site);
  return plan_of(study, std::move(built), of_period);
}

}  // namespace sunload
