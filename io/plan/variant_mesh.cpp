// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/variant_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <list>
#include <optional>
#include <vector>

#include "io/plan/interval_lights.h"
#include "io/plan/mesh_family.h"
#include "io/plan/rules_of_study.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/matrix/form_factors.h"

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

  /// Few are made at once: each has its sky.
  void add(const std::vector<std::size_t>& intervals, double sun_weight, double sky_weight,
           std::vector<PeriodSun>& suns) {
    std::vector<IntervalLight> lights(intervals.size());
    parallel_for(intervals.size(), [&](std::size_t i) {
      lights[i] = lights_.of(plan_.light.intervals[intervals[i]], intervals[i]);
    });
    for (const IntervalLight& sun : lights) add(sun, sun_weight, sky_weight, suns);
  }

 private:
  void add(const IntervalLight& sun, double sun_weight, double sky_weight,
           std::vector<PeriodSun>& suns) {
    if (sun.has_sun() && sun.dni > 0)
      suns.push_back({sun.direction, sun_weight * sun.dni * sun.length_s});
    const double time = sky_weight * sun.length_s;
    for (std::size_t c = 0; c < sun.sky.size(); ++c) light_.sky[c] += pi * sun.sky[c] * time;
    light_.ground += sun.ground_exitance * time;
  }

  const VariantPlan& plan_;
  PeriodLight& light_;
  SkyGrid grid_;
  IntervalLights lights_;
};

/// Of the intervals that are not dark those that add light: a sun without power would take the
/// place of one that has some.
std::vector<std::size_t> intervals_with_light(const LightSeries& series,
                                              const std::vector<std::size_t>& wanted) {
  std::vector<std::size_t> lit;
  for (const std::size_t i : wanted) {
    const LitInterval& interval = series.intervals[i];
    const bool has_power = interval.mean.dni > 0 || interval.mean.dhi > 0;
    if (has_power && !is_dark(interval)) lit.push_back(i);
  }
  return lit;
}

}  // namespace

PeriodLight period_light(const VariantPlan& plan, std::optional<std::size_t> season) {
  PeriodLight light;
  PeriodSum sum(plan, light);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < plan.intervals(); ++i)
    if (!season || plan.seasons.of(i) == *season) wanted.push_back(i);
  for (const auto i : wanted) light.lamp_time_s += plan.light.intervals[i].when.length_s();
  const auto lit = intervals_with_light(plan.light, wanted);
  if (lit.size() <= most_mesh_pilot_suns) {
    sum.add(lit, 1, 1, light.suns);
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
  for (std::size_t sample = 0; sample < light.samples.size(); ++sample) {
    std::vector<std::size_t> drawn;
    for (std::size_t s = 0; s < suns_per_sample; ++s) {
      const double at = static_cast<double>(s) + static_cast<double>(uniform(words(sample, s)[0]));
      drawn.push_back(lit[std::min(static_cast<std::size_t>(at * stretch_length), lit.size() - 1)]);
    }
    sum.add(drawn, stretch_length, stretch_length / static_cast<double>(light.samples.size()),
            light.samples[sample]);
  }
  return light;
}

namespace {

/// All pairs of patches are too many soon.
void expect_small_enough(const VariantPlan& plan, const Hierarchy& mesh) {
  if (plan.study.solver.transport != Transport::matrix) return;
  if (mesh.patch_count() <= most_matrix_patches) return;
  throw InputError(plan.study.scene.where,
                   fmt::format("the scene has {} patches, and transport: matrix takes {} at most",
                               mesh.patch_count(), most_matrix_patches),
                   "its work grows with their number's third power",
                   "write a larger mesh.max_edge_m or light_tolerance (or mesh.oracle: none), take "
                   "a part of the scene, or write solver.transport: gather");
}

}  // namespace

VariantMesh unrefined_mesh(const VariantPlan& plan) {
  VariantMesh made;
  made.mesh = std::make_shared<const Hierarchy>(plan.built.scene, split_rules(plan.study));
  made.report.patches = made.report.patches_before = made.mesh->patch_count();
  expect_small_enough(plan, *made.mesh);
  return made;
}

namespace {

/// Refined by the pilots of all variants that share it.
VariantMesh mesh_of_family(const VariantPlan& plan, Watch& watch) {
  const SplitRules split = split_rules(plan.study);
  expect_splittable(plan.built.scene, split);
  struct Cast {
    Cast(const Mesh& mesh, const std::string& isa, const Screens& passed)
        : transmittance(passed.transmittance), caster(mesh, isa, passed) {}
    std::vector<float> transmittance;
    RayCaster caster;
  };
  std::list<Scene> scenes;
  std::list<Cast> casts;       // of scenes that let the same light pass
  std::list<PilotView> alike;  // those that see alike one after the other
  for (const MeshPilotInput& pilot : plan.family->pilots) {
    Scene& scene = scenes.emplace_back();
    scene.mesh = plan.built.scene.mesh;
    scene.materials = pilot.materials;
    scene.material = pilot.material;
    scene.luminaires = pilot.luminaires;
    const Screens passed = screens(scene);
    auto cast = std::find_if(casts.begin(), casts.end(), [&](const Cast& c) {
      return c.transmittance == passed.transmittance;
    });
    if (cast == casts.end()) {
      casts.emplace_back(scene.mesh, plan.isa, passed);
      cast = std::prev(casts.end());
    }
    const auto after = std::find_if(alike.rbegin(), alike.rend(), [&](const PilotView& view) {
      return &view.caster == &cast->caster && &view.light == pilot.light.get();
    });
    alike.insert(after.base(), {scene, cast->caster, *pilot.light});
  }
  const std::vector<PilotView> views(alike.begin(), alike.end());
  VariantMesh made;
  made.mesh = std::make_shared<const Hierarchy>(
      refined_mesh(views, split, refine_rules(plan.study), watch, &made.report));
  return made;
}

}  // namespace

namespace {

VariantMesh mesh_by_oracle(const VariantPlan& plan, Watch& watch) {
  if (plan.family) {
    if (!plan.family->made) plan.family->made = mesh_of_family(plan, watch);
    return *plan.family->made;
  }
  VariantMesh made;
  const Scene& scene = plan.built.scene;
  const SplitRules split = split_rules(plan.study);
  expect_splittable(scene, split);
  const RayCaster caster(scene.mesh, plan.isa, screens(scene));
  made.mesh = std::make_shared<const Hierarchy>(refined_mesh(
      scene, caster, split, refine_rules(plan.study), period_light(plan), watch, &made.report));
  return made;
}

}  // namespace

VariantMesh make_mesh(const VariantPlan& plan, Watch& watch) {
  if (plan.study.mesh.oracle == Oracle::none) return unrefined_mesh(plan);
  VariantMesh made = mesh_by_oracle(plan, watch);
  expect_small_enough(plan, *made.mesh);
  return made;
}

std::string refine_text(const RefineReport& report, const Study& study) {
  if (study.mesh.oracle == Oracle::none || report.patches == report.patches_before) return {};
  if (study.mesh.oracle == Oracle::historic)
    return fmt::format("{} patches refined to {} by the historic oracle (threshold {:g} m2)",
                       report.patches_before, report.patches, study.mesh.light_threshold_m2);
  std::string kinds;
  for (std::size_t k = 0; k < mesh_kind_names.size(); ++k)
    if (report.error_of_kind[k] > 0)
      kinds += fmt::format("{}{} {:.1f}", kinds.empty() ? "" : ", ", mesh_kind_names[k],
                           100 * report.error_of_kind[k]);
  return fmt::format(
             "{} patches refined to {}: the light load inside of patches varies by {:.1f} % of its "
             "mean "
             "(was {:.1f} %, tolerance {:g} %{}{})",
             report.patches_before, report.patches, 100 * report.error, 100 * report.error_before,
             100 * study.mesh.light_tolerance, kinds.empty() ? "" : "; " + kinds,
             report.is_exhausted ? "; mesh.min_area_m2 allows no finer" : "") +
         (report.pilots > 1
              ? fmt::format("; by {} pilots, of all variants of this geometry", report.pilots)
              : "");
}

std::string largest_patches_text(const VariantPlan& plan, const Hierarchy& mesh) {
  const Mesh& triangles = plan.built.scene.mesh;
  const auto triangle = [&](std::size_t patch) {
    return static_cast<std::size_t>(mesh.patches()[patch].triangle);
  };
  std::array<std::optional<std::size_t>, surface_names.size()> largest;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
    auto& of_kind = largest[static_cast<std::size_t>(triangles.triangle_surface[triangle(i)])];
    if (!of_kind || mesh.area()[i] > mesh.area()[*of_kind]) of_kind = i;
  }
  std::vector<std::size_t> patches;
  for (const auto& patch : largest)
    if (patch) patches.push_back(*patch);
  std::stable_sort(patches.begin(), patches.end(),
                   [&](std::size_t a, std::size_t b) { return mesh.area()[a] > mesh.area()[b]; });
  std::string text;
  for (const auto patch : patches) {
    const std::size_t t = triangle(patch);
    text += fmt::format("{}{} {:.3g} m2 ({})", text.empty() ? "" : ", ",
                        surface_names[static_cast<std::size_t>(triangles.triangle_surface[t])],
                        mesh.area()[patch],
                        triangles.object_names[triangles.triangle_object[t].index()]);
  }
  return text;
}

}  // namespace sunload
