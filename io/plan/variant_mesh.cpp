// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/variant_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "solver/base/rng.h"

namespace sunload {

namespace {

constexpr std::size_t suns_per_sample = most_mesh_pilot_suns / 2;

/// Adds up the light of intervals, each with a weight.
class PeriodSum {
 public:
  PeriodSum(const VariantPlan& plan, PeriodLight& light)
      : plan_(plan), light_(light), lights_(plan.study, plan.built.site, grid_) {
    light_.sky.assign(static_cast<std::size_t>(grid_.cell_count()), 0);
  }

  void add(std::size_t interval, double sun_weight, double sky_weight,
           std::vector<PeriodSun>& suns) {
    const IntervalLight sun = lights_.of(plan_.light.intervals[interval], interval);
    if (sun.has_sun() && sun.dni > 0)
      suns.push_back({sun.direction, sun_weight * sun.dni * sun.length_s});
    const double time = sky_weight * sun.length_s;
    for (std::size_t c = 0; c < sun.sky.size(); ++c) light_.sky[c] += pi * sun.sky[c] * time;
    light_.ground += sun.ground_exitance * time;
  }

 private:
  const VariantPlan& plan_;
  PeriodLight& light_;
  SkyGrid grid_;
  IntervalLights lights_;
};

/// Of the intervals that are not dark those that add light: a sun without power would take the
/// place of one that has some.
std::vector<std::size_t> intervals_with_light(const LightSeries& series) {
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < series.intervals.size(); ++i) {
    const LitInterval& interval = series.intervals[i];
    const bool has_power = interval.mean.dni > 0 || interval.mean.dhi > 0;
    if (has_power && !is_dark(interval)) lit.push_back(i);
  }
  return lit;
}

}  // namespace

PeriodLight period_light(const VariantPlan& plan) {
  PeriodLight light;
  PeriodSum sum(plan, light);
  for (const auto& interval : plan.light.intervals) light.lamp_time_s += interval.when.length_s();
  const auto lit = intervals_with_light(plan.light);
  if (lit.size() <= most_mesh_pilot_suns) {
    for (const auto i : lit) sum.add(i, 1, 1, light.suns);
    return light;
  }
  // One interval at random of every stretch of the period: all hours and seasons come in.
  const auto words = [&](std::size_t sample, std::size_t stretch) {
    return random_words({.seed = mesh_pilot_seed,
                         .purpose = Purpose::mesh_pilot,
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

VariantMesh unrefined_mesh(const VariantPlan& plan) {
  VariantMesh made;
  made.mesh = std::make_shared<const Hierarchy>(plan.built.scene, split_rules(plan.study));
  made.report.patches = made.report.patches_before = made.mesh->patch_count();
  return made;
}

VariantMesh make_mesh(const VariantPlan& plan, Watch& watch) {
  if (plan.study.mesh.oracle == Oracle::none) return unrefined_mesh(plan);
  VariantMesh made;
  const Scene& scene = plan.built.scene;
  const SplitRules split = split_rules(plan.study);
  expect_splittable(scene, split);
  const RayCaster caster(scene.mesh, plan.isa, screens(scene));
  made.mesh = std::make_shared<const Hierarchy>(refined_mesh(
      scene, caster, split, refine_rules(plan.study), period_light(plan), watch, &made.report));
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
