// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/explain/result_scene.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "geo/base/check.h"
#include "io/explain/light_of_part.h"
#include "io/plan/content_hash.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/scene_seasons.h"
#include "io/study/named_files.h"
#include "io/study/study_text.h"

namespace sunload {

namespace {

InputError other_state(const ResultReader& result, const std::string& why) {
  return {
      {result.path()},
      "its scene cannot be made again: its study or a file of it is not what it was computed from",
      why,
      "name the folder of its study with --study-folder, or run the study with --overwrite"};
}

/// Of another state, or by a program whose numbers are others for the same state.
void expect_same_state(const ResultReader& result, const VariantPlan& plan) {
  if (result.text_attribute("study_sha256") == plan.content_hash) return;
  if (result.number_attribute("numerics_version") == numerics_version)
    throw other_state(result, "its content hash differs");
  throw InputError({result.path()}, "was computed by another version of the program",
                   "by " + result.text_attribute("source") +
                       ": its scene, made again, would not be what it was computed from",
                   "run the study again, or explain the result by that version");
}

VariantMesh mesh_of(const VariantPlan& plan) {
  Watch watch;
  return make_mesh(plan, watch);
}

/// The season in which all of the chosen part of the period lies, if there is one.
std::optional<std::size_t> only_season(const ResultReader& result, const VariantPlan& plan) {
  const auto shares = chosen_part(result, plan.light);
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < plan.intervals(); ++i) {
    if (!shares.empty() && shares[i] <= 0) continue;
    const std::size_t season = plan.seasons.of(i);
    if (only && *only != season) return {};
    only = season;
  }
  return only;
}

/// What the scene is made of then. The mesh is that of all seasons, and is made before.
const Scene& scene_of_chosen(const ResultReader& result, VariantPlan& plan) {
  if (plan.seasons.all.empty()) return plan.built.scene;
  if (const auto season = only_season(result, plan)) {
    plan.built.scene = scene_in(plan.built.scene, plan.seasons.all[*season]);
    plan.seasons = {};
  }
  return plan.built.scene;
}

}  // namespace

ResultScene::ResultScene(const ResultReader& result, VariantPlan plan,
                         std::vector<std::string> named)
    : path_(result.path()),
      files_(std::move(named)),
      plan_(std::move(plan)),
      mesh_(mesh_of(plan_)),
      traced_(std::make_unique<const TracedScene>(scene_of_chosen(result, plan_), mesh_.mesh,
                                                  solver_rules(plan_))),
      lights_(plan_.study, plan_.built.site, traced_->grid),
      period_(lights_, plan_.light) {
  files_.insert(files_.end(), plan_.built.files.begin(), plan_.built.files.end());
  if (mesh_.mesh->area() != result.doubles("patch_area"))
    throw other_state(result, "its patches differ");
}

void ResultScene::expect_one_season() const {
  if (!plan_.seasons.all.empty())
    throw InputError({path_}, "cannot be explained: its materials change with the seasons",
                     "light is followed back in one scene",
                     "choose a part of the period within one of them: --season, --month, --day");
}

struct ResultScenes::Opened {
  Opened(const std::string& path, const std::string& yaml)
      : file(study_of_text(path, yaml)), families(file, planner) {}
  StudyFile file;
  Planner planner;
  MeshFamilies families;
};

/// A result does not know where its study lay.
std::shared_ptr<ResultScenes::Opened> ResultScenes::open(const ResultReader& result,
                                                         const std::string& yaml) const {
  const std::string path =
      (std::filesystem::path(folder_) / ("study of " + result.text_attribute("variant"))).string();
  try {
    return std::make_shared<Opened>(path, yaml);
  } catch (const InputError& error) {
    if (!folder_.empty()) throw;
    Problems problems;
    problems.add(error);
    problems.add({result.path()}, "its study is not read as it was",
                 "its files are sought from the working directory",
                 "name the folder of its study with --study-folder");
    throw InputError(problems.list());
  }
}

std::unique_ptr<const ResultScene> ResultScenes::of(const ResultReader& result) {
  const auto text = result.strings("study_yaml");
  const std::string yaml = text.empty() ? "" : text.front();
  auto& opened = studies_[yaml];
  if (!opened) opened = open(result, yaml);
  const auto& variants = opened->file.variants;
  const auto study = std::find_if(variants.begin(), variants.end(), [&](const Study& s) {
    return s.variant == result.text_attribute("variant");
  });
  if (study == variants.end()) throw other_state(result, "its variant is not in its study");
  VariantPlan plan = opened->planner.plan(*study);
  opened->families.join(plan);
  plan.isa = usable_isa(result.text_attribute("isa"));
  plan.content_hash = hash_with_isa(plan, plan.isa);
  expect_same_state(result, plan);
  return std::make_unique<const ResultScene>(result, std::move(plan), named_files(opened->file));
}

}  // namespace sunload
