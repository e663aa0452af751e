// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene of a result again, as it was when it was computed: materials, light, patches.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/plan/interval_lights.h"
#include "io/plan/mesh_family.h"
#include "io/plan/planner.h"
#include "io/plan/variant_mesh.h"
#include "io/result/reader.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

/// Everything refers to the plan, hence stays where it is.
class ResultScene {
 public:
  /// Throws InputError where this is not what `result` was computed from. Where materials change
  /// with the seasons and the part of the period that is chosen lies in one of them, the scene is
  /// made of what it is then.
  /// `named`: files that its study names.
  ResultScene(const ResultReader& result, VariantPlan plan, std::vector<std::string> named);
  ResultScene(const ResultScene&) = delete;
  ResultScene& operator=(const ResultScene&) = delete;

  const TracedScene& traced() const { return *traced_; }
  const LitPeriod& period() const { return period_; }
  const LightSeries& light() const { return plan_.light; }
  /// Throws InputError where the scene's materials change in the course of what is chosen.
  void expect_one_season() const;
  const VariantPlan& plan() const { return plan_; }
  /// All that it has been made from, which no output may replace.
  const std::vector<std::string>& files() const { return files_; }

 private:
  std::string path_;
  std::vector<std::string> files_;
  VariantPlan plan_;
  VariantMesh mesh_;
  std::unique_ptr<const TracedScene> traced_;  ///< without lines
  IntervalLights lights_;
  SeriesLight period_;
};

/// Makes scenes of results from the studies that these keep. Variants of one study share what
/// they shared when they were computed.
class ResultScenes {
 public:
  /// `folder`: that the files named in studies are relative to.
  explicit ResultScenes(std::string folder) : folder_(std::move(folder)) {}
  /// Throws InputError where study or files differ from what the result was computed from. Cost:
  /// reading and refining the scene.
  std::unique_ptr<const ResultScene> of(const ResultReader& result);

 private:
  struct Opened;
  std::shared_ptr<Opened> open(const ResultReader& result, const std::string& yaml) const;

  std::string folder_;
  std::map<std::string, std::shared_ptr<Opened>> studies_;  ///< by text
};

}  // namespace sunload
