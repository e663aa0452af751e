// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/traced/traced_scene.h"

#include <algorithm>

#include "geo/base/check.h"
#include "geo/mesh/area_share.h"
#include "solver/base/stopwatch.h"
#include "solver/gather/guide.h"
#include "solver/gather/jacobi.h"
#include "solver/gather/unfollowed.h"
#include "solver/lines/sensor_lines.h"
#include "solver/matrix/form_factors.h"

namespace sunload {

namespace {

std::vector<PatchOptics> optics_of_bands(const Scene& scene, const Hierarchy& hierarchy,
                                         const PatchOptics& broadband, Bands bands) {
  if (bands == Bands::broadband) return {broadband};
  std::vector<PatchOptics> optics;
  for (std::size_t b = 0; b < band_count; ++b) optics.push_back(patch_optics(scene, hierarchy, b));
  return optics;
}

Lines lines_of_patches(TracedScene& traced, Watch& watch) {
  const Stopwatch time(traced.work[Work::lines_s]);
  const LineRules rules = line_rules(traced.rules);
  Guide guide;  // shooting samples emitters in its own way
  if (traced.rules.transport == Transport::gather)
    guide = lit_surfaces(traced.scene, *traced.mesh, traced.caster, traced.grid, traced.optics,
                         rules, traced.rules.bounces);
  Lines lines =
      trace_lines(traced.scene, *traced.mesh, traced.caster, traced.grid, guide, rules, watch);
  traced.work.add(Work::line_rays, lines.rays);
  return lines;
}

Lines lines_of_sensors(TracedScene& traced) {
  const Stopwatch time(traced.work[Work::sensors_s]);
  Guide guide;
  if (traced.sensors.count() > 0)
    guide = emitting_surfaces(traced.scene, *traced.mesh, traced.optics);
  Lines lines = trace_sensor_lines(traced.scene, *traced.mesh, traced.caster, traced.grid, guide,
                                   line_rules(traced.rules));
  traced.work.add(Work::sensor_rays, lines.rays);
  return lines;
}

void add_lamp_light(TracedScene& traced) {
  const auto realizations = static_cast<std::size_t>(traced.rules.realizations);
  traced.patches.lamps =
      lamp_light(traced.scene, *traced.mesh, traced.caster, traced.patches.sampler, traced.optics,
                 realizations, traced.rules.mirror_depth);
  traced.sensors.lamps = lamp_light_on_sensors(traced.scene, traced.caster, traced.sensors.sampler,
                                               traced.mirrors, realizations);
  traced.work.add(Work::direct_rays, traced.patches.lamps.rays);
}

/// As many as the brightest band needs.
int bounces_of_bands(const TracedScene& traced) {
  int bounces = 0;
  for (const auto& optics : traced.optics_of_band)
    bounces = std::max(bounces, bounces_needed(*traced.mesh, traced.patches.lines.pooled, optics,
                                               traced.rules.bounces, traced.rules.unshot));
  return bounces;
}

/// Of every band, or nothing where that light is left out. Regular iterations are estimates anew,
/// whose last differences are all noise.
std::vector<std::vector<float>> beyond_of_bands(const TracedScene& traced) {
  const SolverRules& rules = traced.rules;
  const bool leaves = rules.unfollowed == Unfollowed::leave ||
                      rules.transport == Transport::matrix ||  // or nothing is left
                      (rules.transport == Transport::shoot && rules.jacobi == Jacobi::regular);
  std::vector<std::vector<float>> beyond(traced.optics_of_band.size());
  for (std::size_t b = 0; b < beyond.size() && !leaves; ++b)
    beyond[b] = light_beyond(*traced.mesh, traced.patches.lines.pooled, traced.optics_of_band[b],
                             traced.bounces);
  return beyond;
}

/// Form factors in place of links between patches.
void use_form_factors(TracedScene& traced, Watch& watch) {
  const Stopwatch time(traced.work[Work::lines_s]);
  const SolverRules& rules = traced.rules;
  const FormFactors factors =
      form_factors(traced.scene.mesh, *traced.mesh, traced.caster, form_factor_rules(rules), watch);
  const bool follows_all = rules.unfollowed == Unfollowed::estimate && rules.bounces > 0;
  put_form_factors(factors, traced.optics, follows_all ? Reflections::all : Reflections::counted,
                   traced.patches.lines);
  traced.work.add(Work::line_rays, factors.rays);
}

DirectRules direct_rules(const SolverRules& rules) {
  return {.samples = rules.direct_samples, .realizations = rules.realizations, .seed = rules.seed};
}

double share_that_sends_on(const Scene& scene) {
  return area_share(scene.mesh, [&](std::size_t t) { return sends_on(scene.material_of(t)); });
}

}  // namespace

// Members are made in the order in which the header has them: each needs those before it.
TracedScene::TracedScene(const Scene& whole, std::shared_ptr<const Hierarchy> frozen,
                         const SolverRules& of_study)
    : scene(whole),
      rules(of_study),
      mesh(std::move(frozen)),
      caster(whole.mesh, of_study.isa, screens(whole)),
      optics(patch_optics(whole, *mesh)),
      optics_of_band(optics_of_bands(whole, *mesh, optics, of_study.bands)),
      patches(SunSampler(*mesh, caster, direct_rules(of_study))),
      sensors(SunSampler(whole.sensors, caster, direct_rules(of_study))),
      what_sends_on(asked_for_the_sun(share_that_sends_on(whole), of_study.transport)),
      lit_shares(whole, *mesh, caster.offset_m()),
      share_grid(lit_shares),
      mirrors(whole),
      mirror_sun(caster, mirrors, lit_shares),
      mirror_chains(*mesh, caster, patches.sampler, mirrors,
                    {.mirror_depth = of_study.mirror_depth,
                     .negligible = of_study.unshot,
                     .books_samples = what_sends_on == SendsOn::as_others}),
      glossy_sun(whole, *mesh, caster, patches.sampler, optics, line_rules(of_study)),
      lobe_images(whole, caster, patches.sampler, line_rules(of_study)),
      lobe_images_of_sensors(whole, caster, sensors.sampler, line_rules(of_study)) {
  SUNLOAD_EXPECT(!is_rgb() || rules.transport == Transport::gather, "bands are gathered");
  SUNLOAD_EXPECT(rules.transport != Transport::matrix ||
                     std::none_of(whole.materials.begin(), whole.materials.end(), goes_on_straight),
                 "form factors are of opaque diffuse surfaces");
}

bool TracedScene::has_part(Part part) const {
  if (part == Part::mirror) return optics.any_mirror;
  if (part == Part::lamps) return optics.any_emission;
  return true;
}

LineRules line_rules(const SolverRules& rules) {
  return {.lines_per_patch = rules.lines_per_patch,
          .lines_of_patch = rules.lines_of_patch,
          .realizations = rules.realizations,
          .mirror_depth = rules.mirror_depth,
          .seed = rules.seed,
          .largest_link = rules.link_threshold / rules.lines_per_patch};
}

FormFactorRules form_factor_rules(const SolverRules& rules) {
  FormFactorRules of_factors{.realizations = rules.realizations, .seed = rules.seed};
  of_factors.lines_per_patch = std::max(of_factors.lines_per_patch, rules.lines_per_patch);
  return of_factors;
}

std::unique_ptr<TracedScene> trace_scene(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                                         const SolverRules& rules, Watch& watch,
                                         std::optional<Lines> ready) {
  expect_valid(rules);
  auto traced = std::make_unique<TracedScene>(scene, std::move(mesh), rules);
  traced->patches.lines = ready ? std::move(*ready) : lines_of_patches(*traced, watch);
  if (rules.transport == Transport::matrix) use_form_factors(*traced, watch);
  traced->sensors.lines = lines_of_sensors(*traced);
  add_lamp_light(*traced);
  traced->bounces = bounces_of_bands(*traced);
  traced->beyond_of_band = beyond_of_bands(*traced);
  return traced;
}

std::unique_ptr<TracedScene> trace_scene(const Scene& scene, const SplitRules& split,
                                         const SolverRules& rules, Watch& watch,
                                         std::optional<Lines> ready) {
  return trace_scene(scene, std::make_shared<const Hierarchy>(scene, split), rules, watch,
                     std::move(ready));
}

}  // namespace sunload
