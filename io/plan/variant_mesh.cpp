// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/variant_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "solver/base/rng.h"

namespace sunload {

namespace {

/// Up to so many suns are taken as they are; of more, two samples of half as many.
constexpr std::size_t most_suns = 32;
constexpr std::size_t suns_per_sample = most_suns / 2;

/// Adds the light of intervals to a pilot's, each with a weight.
class PilotSum {
 public:
  PilotSum(const VariantPlan& plan, PilotLight& light)
      : plan_(plan),
        light_(light),
        open_share_(open_shares(grid_, plan.built.site.horizon, scene_from_enu(plan.built.site))) {
    light_.sky.assign(static_cast<std::size_t>(grid_.cell_count()), 0);
  }

  void add(std::size_t interval, double sun_weight, double sky_weight,
           std::vector<PilotSun>& suns) {
    const SunLight sun =
        sun_light(plan_.light.intervals[interval], static_cast<std::uint32_t>(interval),
                  plan_.study.light, grid_, open_share_);
    if (sun.has_sun() && sun.dni > 0)
      suns.push_back({sun.direction, sun_weight * sun.dni * sun.length_s});
    const double time = sky_weight * sun.length_s;
    for (std::size_t c = 0; c < sun.sky.size(); ++c) light_.sky[c] += pi * sun.sky[c] * time;
    light_.ground += sun.ground_exitance * time;
  }

 private:
  const VariantPlan& plan_;
  PilotLight& light_;
  SkyGrid grid_;
  std::vector<double> open_share_;
};

std::vector<std::size_t> intervals_with_light(const LightSeries& series) {
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < series.intervals.size(); ++i) {
    const auto& mean = series.intervals[i].mean;
    if (mean.dni > 0 || mean.dhi > 0) lit.push_back(i);
  }
  return lit;
}

}  // namespace

PilotLight pilot_light(const VariantPlan& plan) {
  PilotLight light;
  PilotSum sum(plan, light);
  for (const auto& interval : plan.light.intervals) light.lamp_time_s += interval.when.length_s();
  const auto lit = intervals_with_light(plan.light);
  if (lit.size() <= most_suns) {
    for (const auto i : lit) sum.add(i, 1, 1, light.suns);
    return light;
  }
  // One interval at random of every stretch of the period: all hours and seasons come in.
  const auto words = [&](std::size_t sample, std::size_t stretch) {
    return random_words({.seed = plan.study.solver.seed,
                         .purpose = Purpose::pilot,
                         .realization = static_cast<std::uint32_t>(sample),
                         .element = stretch});
  };
  const double stretch_length = static_cast<double>(lit.size()) / suns_per_sample;
  for (std::size_t sample = 0; sample < light.samples.size(); ++sample)
    for (std::size_t s = 0; s < suns_per_sample; ++s) {
      const double at = static_cast<double>(s) + static_cast<double>(uniform(words(sample, s)[0]));
      const auto chosen = std::min(static_cast<std::size_t>(at * stretch_length), lit.size() - 1);
      sum.add(lit[chosen], stretch_length,
              stretch_length / static_cast<double>(light.samples.size()), light.samples[sample]);
    }
  return light;
}

VariantMesh make_mesh(const VariantPlan& plan, Watch& watch) {
  VariantMesh made;
  const Scene& scene = plan.built.scene;
  const SplitRules split = split_rules(plan.study);
  if (plan.study.mesh.oracle == Oracle::none) {
    made.mesh = std::make_shared<const Hierarchy>(scene, split);
    made.report.patches = made.report.patches_before = made.mesh->patch_count();
    return made;
  }
  expect_splittable(scene, split);
  const RayCaster caster(scene.mesh, plan.isa, screens(scene));
  made.mesh = std::make_shared<const Hierarchy>(refined_mesh(
      scene, caster, split, refine_rules(plan.study), pilot_light(plan), watch, &made.report));
  return made;
}

std::string refine_text(const RefineReport& report, const Study& study) {
  if (study.mesh.oracle == Oracle::none || report.patches == report.patches_before) return {};
  if (study.mesh.oracle == Oracle::historic)
    return fmt::format("{} patches refined to {} by the historic oracle (threshold {:g} m2)",
                       report.patches_before, report.patches, study.mesh.light_threshold_m2);
  return fmt::format(
      "{} patches refined to {}: the light load inside of patches varies by {:.1f} % of its mean "
      "(was {:.1f} %, tolerance {:g} %{})",
      report.patches_before, report.patches, 100 * report.error, 100 * report.error_before,
      100 * study.mesh.light_tolerance,
      report.is_exhausted ? "; mesh.min_area_m2 allows no finer" : "");
}

}  // namespace sunload
