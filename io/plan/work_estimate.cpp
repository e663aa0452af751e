// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/work_estimate.h"

#include <algorithm>
#include <set>
#include <utility>

#include "io/plan/cost.h"
#include "io/plan/disk_estimate.h"
#include "io/plan/memory_estimate.h"
#include "io/plan/mesh_family.h"
#include "io/plan/shared_samples.h"
#include "io/plan/surface_shares.h"
#include "io/plan/workload.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

using namespace cost;

/// Rays of the mesh pilot.
double refinement_rays(const VariantPlan& plan, double patches, double lit) {
  return patches * elements_per_leaf * points_per_element *
         (std::min(lit, static_cast<double>(most_mesh_pilot_suns)) + other_directions +
          luminaires_seen * static_cast<double>(plan.built.scene.luminaires.all.size()));
}

/// Of the sun in panes and the like. Sums are of one core.
double mirror_seconds(const VariantPlan& plan, double patches, double suns, double samples) {
  const bool is_disk = plan.study.sun.disk == SunDisk::finite;
  return patches * mirrored_share * suns *
         (is_disk ? samples * s_per_mirror_ray : s_per_mirrored_share);
}

/// Shares of patches that see the suns, and rays.
double sun_seconds(double patches, double suns, double rays_to_sun, double circumsolar_rays) {
  return patches * facing_share * suns * s_per_lit_share + rays_to_sun * s_per_direct_ray +
         circumsolar_rays * s_per_circumsolar_ray;
}

/// Each of so many suns solved on links.
double solution_seconds(double patches, double links, double suns) {
  return links * suns * s_per_link_sun + patches * suns * s_per_patch_sun;
}

double line_seconds(const VariantPlan& plan) {
  const Mesh& mesh = plan.built.scene.mesh;
  const auto triangles = static_cast<double>(std::max<std::size_t>(mesh.triangle_count(), 1));
  return s_per_line_ray(triangles) *
         mean_over_seasons(plan, [&](const MaterialsOfScene& of_season) {
           return rays_per_line(mesh, of_season, plan.study.solver.mirror_depth);
         });
}

/// Of n receivers with so many lines in all; `guided`: they look for bright surfaces.
double tracing_seconds(const VariantPlan& plan, double n, double lines, bool guided) {
  return lines * (guided ? 1 + rays_by_guide : 1) * line_seconds(plan) +
         (guided ? n * s_per_guided_patch : 0);
}

/// Lines and rays of all sensors, and so many suns gathered from what the patches sent last. Of one
/// core.
double sensor_seconds(const VariantPlan& plan, double lines_per_sensor, double suns, double rays,
                      double samples) {
  const auto count = static_cast<double>(plan.built.scene.sensors.size());
  const double lines = count * lines_per_sensor;
  return tracing_seconds(plan, count, lines, false) + rays * s_per_direct_ray +
         solution_seconds(count, lines, suns) +
         (any_sends_on(plan) ? mirror_seconds(plan, count, suns, samples) : 0);
}

/// Lines, shots, and the pilot of the mesh. Of one core, as the others.
double seconds_of_lines(const Workload& work, const ShotSamples& samples) {
  const double pilot = work.plan.study.mesh.oracle == Oracle::none
                           ? 0
                           : refinement_rays(work.plan, work.receivers, work.lit);
  return work.seasons *
             tracing_seconds(work.plan, work.patches, work.lines_of_patches, work.is_guided) +
         samples.all * s_per_sample +  // a shot meets surfaces as a line does
         pilot * s_per_direct_ray;
}

double seconds_of_direct(const Workload& work, const WorkloadRays& rays) {
  return sun_seconds(work.patches, work.looked_at(), rays.to_sun,
                     work.of_few ? 0 : rays.circumsolar) +
         rays.to_luminaires * s_per_luminaire_ray;
}

double seconds_of_mirrors(const Workload& work) {
  if (!work.has_mirrors) return 0;
  const double sent_on = work.shining / std::max(work.suns, 1.0) *
                         static_cast<double>(work.plan.light.suns_of_mirrors());
  return mirror_seconds(work.plan, work.patches, sent_on, work.counts.direct_samples);
}

/// Realizations of batches, of parts of the period and of instants, on their own lines.
double seconds_of_realizations(const Workload& work) {
  const double realizations = work.plan.study.solver.realizations;
  const double sums = work.receivers *
                      (work.batches + static_cast<double>(work.periods.stored_with_errors)) *
                      realizations * s_per_patch_batch_realization;
  if (work.shoots) return work.bands * sums;
  const auto of_suns = [&](double suns) {
    return work.links * suns * s_per_link_sun +
           work.receivers * suns * realizations * s_per_patch_sun_realization;
  };
  return work.bands * (sums + work.links * work.batches * s_per_link_batch +
                       of_suns(work.suns_of_parts) + (work.of_instants ? of_suns(work.lit) : 0));
}

double seconds_of_solutions(const Workload& work) {
  const double n = work.receivers, realizations = work.plan.study.solver.realizations;
  const double of_matrix =
      work.by_matrix
          ? work.seasons * n * n * (s_per_form_factor + n * realizations * s_per_factor_solved)
          : 0;
  const double solved_links = work.shoots ? 0 : work.links;
  return of_matrix + seconds_of_realizations(work) +
         work.bands * (work.lit * s_per_sun + solution_seconds(n, solved_links, work.solved) +
                       (work.of_few ? n * work.lit * s_per_patch_interval_of_year : 0));
}

/// What the trial of a machine has no part in: of a period of few solutions it has no sky, and none
/// has that of parts.
double seconds_untried(const Workload& work, const WorkloadRays& rays) {
  return (work.of_few ? rays.circumsolar * s_per_circumsolar_ray : 0) +
         std::max(0.0, static_cast<double>(work.plan.light.lit_parts()) - work.lit) *
             s_per_sky_of_part;
}

double seconds_of_further_series(const Workload& work) {
  const auto& steps = work.plan.steps;
  const double rows = steps.empty() ? work.lit : static_cast<double>(steps.size());
  return work.bands * work.receivers * rows * std::max(0.0, work.stored_kinds - 1) *
         s_per_further_value;
}

/// Series are put together by one thread.
double seconds_of_files(const Workload& work) {
  return work.bands * work.receivers *
             (static_cast<double>(work.plan.intervals()) * s_per_value +
              work.batches * work.batch_sum_bytes() * s_per_byte_of_sums) +
         work.receivers * s_per_patch;
}

double seconds_of(const Workload& work, const WorkloadRays& rays, const ShotSamples& samples,
                  const WorkPace& pace) {
  const auto samples_of_sun = work.counts.direct_samples;
  // Of a disk the model itself goes by samples.
  const double mirror_pace =
      work.plan.study.sun.disk == SunDisk::finite ? pace.mirror : pace.mirror_with(samples_of_sun);
  const double sensors = sensor_seconds(work.plan, work.counts.mean_lines(), work.lit,
                                        rays.of_sensors, samples_of_sun);
  const double core = s_to_start + seconds_untried(work, rays) + seconds_of_further_series(work) +
                      seconds_of_lines(work, samples) * pace.lines +
                      seconds_of_direct(work, rays) * pace.direct +
                      seconds_of_mirrors(work) * mirror_pace +
                      seconds_of_solutions(work) * pace.solve + sensors * pace.sensors;
  return seconds_of_files(work) + core / thread_count();
}

}  // namespace

WorkSeconds modelled_seconds(const VariantPlan& plan, std::size_t patches,
                             const BlockCounts& counts) {
  const double n = static_cast<double>(patches), lines = n * counts.lines_per_patch;
  const double threads = thread_count();
  const bool guided = any_emits(plan);  // the trial gathers
  // A period of few solutions is tried without a sky.
  const double to_sky = is_year_of_few(plan)
                            ? 0
                            : circumsolar_receivers(plan, patches) * share_of_samples_drawn(plan);
  return {
      tracing_seconds(plan, n, lines, guided) / threads,
      sun_seconds(static_cast<double>(patches), counts.suns,
                  facing_share * counts.suns * counts.direct_samples * asked_by_rays(plan, patches),
                  facing_share * counts.suns * counts.direct_samples * to_sky) /
          threads,
      mirror_seconds(plan, n, counts.suns, counts.direct_samples) / threads,
      // A block that is not full takes as long.
      band_factor(plan) * solution_seconds(n, lines * plan.study.solver.bounces, block_width) /
          threads,
      sensor_seconds(plan, counts.lines_per_patch, counts.suns,
                     sensors_that_face(plan) * counts.suns * counts.direct_samples,
                     counts.direct_samples) /
          threads};
}

std::pair<double, double> refinement_seconds(const VariantPlan& plan, std::size_t patches) {
  if (plan.study.mesh.oracle == Oracle::none) return {0, 0};
  // Measured on built-in streets and cities, where the mesh grows 2 … 7 times, and on large real
  // ones, of which only some is looked at.
  constexpr double least = 0.25, most = 4;
  const auto triangles = static_cast<double>(plan.built.scene.mesh.triangle_count());
  // Pilots of one light see alike: what mirrors and lamps add to that is little.
  std::set<const PeriodLight*> lights;
  if (plan.family)
    for (const MeshPilotInput& pilot : plan.family->pilots) lights.insert(pilot.light.get());
  const double seconds = static_cast<double>(std::max<std::size_t>(lights.size(), 1)) *
                         refinement_rays(plan, static_cast<double>(patches),
                                         static_cast<double>(plan.light.lit_count())) *
                         s_per_line_ray(std::max(triangles, 1.0)) / thread_count();
  return {least * seconds, most * seconds};
}

WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches, const WorkPace& pace) {
  const SolverStudy& s = plan.study.solver;
  return estimate_work(plan, patches, {s.lines_per_patch, s.direct_samples, s.lines_per_patch},
                       pace);
}

WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches, const SampleCounts& counts,
                           const WorkPace& pace) {
  const Workload work = workload(plan, patches, counts);
  const WorkloadRays rays = rays_of(work);
  const ShotSamples samples = shot_samples(work);
  return {.patches = patches,
          .line_rays = static_cast<std::uint64_t>(work.seasons * work.lines),
          .direct_rays = static_cast<std::uint64_t>(rays.all()),
          .samples = static_cast<std::uint64_t>(samples.all),
          .memory_bytes = memory_bytes(work, samples),
          .disk_bytes = disk_bytes(work),
          .seconds = seconds_of(work, rays, samples, pace),
          .is_of_this_machine = pace.is_measured};
}

}  // namespace sunload
