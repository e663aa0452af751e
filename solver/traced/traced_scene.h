// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Trace once: a scene on its frozen mesh with all that serves every sun position.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "solver/base/watch.h"
#include "solver/first_light/glossy_sun.h"
#include "solver/first_light/lamp_light.h"
#include "solver/first_light/mirror_chains.h"
#include "solver/first_light/mirror_sun.h"
#include "solver/gather/jacobi.h"
#include "solver/light/work.h"
#include "solver/lines/lines.h"
#include "solver/matrix/form_factors.h"
#include "solver/mesh/hierarchy.h"
#include "solver/mesh/patch_optics.h"
#include "solver/sight/lit_shares.h"
#include "solver/sight/share_grid.h"
#include "solver/traced/rules.h"

namespace sunload {

/// What receives light: the patches, or the sensors.
struct Receivers {
  explicit Receivers(SunSampler points) : sampler(std::move(points)) {}
  SunSampler sampler;  ///< points from which the sun is looked for
  Lines lines;         ///< no rows where there are no receivers
  LampLight lamps;     ///< that are no surfaces

  std::size_t count() const { return sampler.receivers(); }
};

/// Immutable once it is traced; immovable, as its parts refer to each other. All of it is the same
/// bits for any number of threads.
struct TracedScene {
  /// All but what rays tell: see `trace_scene`.
  TracedScene(const Scene& scene, std::shared_ptr<const Hierarchy> mesh, const SolverRules& rules);
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  const Hierarchy& hierarchy() const { return *mesh; }
  bool is_rgb() const { return rules.bands == Bands::rgb; }
  /// Parts of the irradiance that the scene can have.
  bool has_part(Part part) const;
  /// Directions in which the scene's mirrors face.
  std::size_t mirror_orientations() const { return mirrors.reflecting(); }

  const Scene& scene;
  SolverRules rules;
  std::shared_ptr<const Hierarchy> mesh;
  RayCaster caster;
  SkyGrid grid;
  PatchOptics optics;                       ///< broadband
  std::vector<PatchOptics> optics_of_band;  ///< one where light is broadband
  Receivers patches, sensors;
  SendsOn what_sends_on;  ///< to the sun
  LitShares lit_shares;   ///< of patches
  ShareGrid share_grid;   ///< for many suns
  MirrorGroups mirrors;
  MirrorSun mirror_sun;
  MirrorChains mirror_chains;
  GlossySun glossy_sun;
  LobeImages lobe_images;  ///< for patches
  LobeImages lobe_images_of_sensors;
  int bounces = 0;  ///< that are followed: `rules.bounces`, or fewer for `rules.unshot`
  std::vector<std::vector<float>> beyond_of_band;  ///< light_beyond; empty ones: it is left
  BounceRules bounce_rules(std::size_t band) const { return {bounces, beyond_of_band[band]}; }
  WorkDone work;  ///< that tracing took
};

/// Rules for lines that follow from a study's.
LineRules line_rules(const SolverRules& rules);
/// The same for form factors, which take no fewer lines than they need by default.
FormFactorRules form_factor_rules(const SolverRules& rules);

/// Builds the ray caster and traces all lines, unless those of an equal scene are handed over
/// (`ready`). `scene` must outlive the result. Cost: a ray for each line of every patch. Throws
/// Interrupted, and std::logic_error for rules out of range (SolverRules).
std::unique_ptr<TracedScene> trace_scene(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                                         const SolverRules& rules, Watch& watch,
                                         std::optional<Lines> ready = {});
/// On a mesh that is split by edge length alone. Throws as Hierarchy does, too.
std::unique_ptr<TracedScene> trace_scene(const Scene& scene, const SplitRules& split,
                                         const SolverRules& rules, Watch& watch,
                                         std::optional<Lines> ready = {});

}  // namespace sunload
