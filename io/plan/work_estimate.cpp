// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/work_estimate.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geo/base/units.h"
#include "io/plan/disk_estimate.h"
#include "io/plan/mesh_family.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/seasons_of_plan.h"
#include "io/plan/shared_samples.h"
#include "io/plan/stored_bits.h"
#include "io/plan/surface_shares.h"
#include "io/plan/variant_mesh.h"
#include "solver/base/cost.h"
#include "solver/base/threads.h"
#include "solver/light/sun_samples.h"
#include "solver/shoot/shot_power.h"
#include "solver/sight/share_grid.h"

namespace sunload {

namespace {

using namespace cost;

/// Blocks of intervals with light that are solved side by side.
std::size_t lit_blocks(const VariantPlan& plan) {
  const bool lamps = has_lamps(plan);
  std::size_t blocks = 0, lit = 0;
  for (std::size_t k = 0; k < plan.intervals(); ++k) {
    if (k % plan.batch_suns() == 0) lit = 0;
    if (!lamps && is_dark(plan.light.intervals[k])) continue;
    if (lit++ % block_width == 0) ++blocks;
  }
  return blocks;
}

/// Samples of all shots: those of the first reflection, then (incremental) less by what is
/// absorbed or leaves, one at least of every patch. The light on a patch is taken as that on a
/// sphere.
double estimated_samples(const VariantPlan& plan, const MaterialsOfScene& of_season, double patches,
                         double blocks, int samples_per_patch) {
  const SolverStudy& s = plan.study.solver;
  const Scene& scene = plan.built.scene;
  double area = 0, reflecting = 0, emitted_w = 0, brightest_w_m2 = 0;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const Material& m = of_season.of(t);
    const double a = scene.mesh.area_m2(t);
    area += a;
    reflecting += a * m.diffuse;
    emitted_w += a * m.emission_w_m2;
  }
  for (const auto& i : plan.light.intervals)
    brightest_w_m2 = std::max(brightest_w_m2, i.mean.dni / 4 + i.mean.dhi / 2);
  const double by_auto = patches * samples_per_patch, least = patches * s.realizations;
  const double raised = static_cast<double>(samples_per_patch) / s.lines_per_patch;
  const auto samples_of = [&](double power_w) {
    return s.power_per_sample_w ? raised * power_w / *s.power_per_sample_w : by_auto;
  };
  const double first = samples_of(reflecting * brightest_w_m2 + emitted_w);
  // After a reflection: what meets something, and is not absorbed there.
  const double left = s.jacobi == Jacobi::regular ? 1 : share_that_meets * reflecting / area;
  double samples = 0, share = 1;
  for (int b = 0; b < s.bounces; ++b, share *= left) samples += std::max(least, first * share);
  return blocks * samples + (emitted_w > 0 ? samples_of(emitted_w) : 0);
}

/// Suns above the horizon that bring no direct light, all those that stand for one interval
/// counted.
double clouded_suns(const LightSeries& light) {
  double count = 0;
  for (const LitInterval& interval : light.intervals)
    if (interval.when.sunlit_s > 0 && interval.mean.dni <= 0)
      count += static_cast<double>(interval.suns());
  return count;
}

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

bool emits(const Material& material) { return material.emission_w_m2 > 0; }

/// Of n receivers with so many lines in all; `guided`: they look for bright surfaces.
double tracing_seconds(const VariantPlan& plan, double n, double lines, bool guided) {
  return lines * (guided ? 1 + rays_by_guide : 1) * line_seconds(plan) +
         (guided ? n * s_per_guided_patch : 0);
}

/// Patches and sensors.
double receivers(const VariantPlan& plan, std::size_t patches) {
  return static_cast<double>(patches + plan.built.scene.sensors.size());
}

double band_factor(const VariantPlan& plan) {
  return plan.study.solver.bands == Bands::rgb ? static_cast<double>(band_count) : 1;
}

/// Patches that look at the bright sky about the sun by rays; shooting leaves it to lines.
double circumsolar_receivers(const VariantPlan& plan, std::size_t patches) {
  return plan.study.solver.transport == Transport::shoot ? 0 : static_cast<double>(patches);
}

/// Patches to which rays tell of the sun: where edges of shadows cross what sends light on by rays,
/// or the sun has a disk, and behind screens.
double asked_by_rays(const VariantPlan& plan, std::size_t patches) {
  const bool by_grid = plan.light.any_joined();
  const double share = mean_over_seasons(plan, [&](const MaterialsOfScene& of_season) {
    const Mesh& mesh = plan.built.scene.mesh;
    const double sending =
        by_grid ? 0 : share_that_sends_on_by_rays(mesh, of_season, plan.study.solver.transport);
    const bool screens = share_of_screens(mesh, of_season) > 0;
    double left = screens ? share_behind_screens : 0;
    if (plan.study.sun.disk == SunDisk::finite) left = std::max(left, share_at_edges);
    return sending * std::max(left, share_at_edges) + (1 - sending) * left;
  });
  return share * static_cast<double>(patches);
}

bool any_sends_on(const VariantPlan& plan) {
  const auto materials = materials_of(plan);
  return std::any_of(materials.begin(), materials.end(), sends_on);
}

/// Sensors, each as often as the suns of the half space above the horizon that it faces.
double sensors_that_face(const VariantPlan& plan) {
  double faced = 0;
  for (const Sensor& sensor : plan.built.scene.sensors) faced += (1 + sensor.normal.z) / 2;
  return faced;
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

/// Solutions that serve all intervals of a period, where few do.
struct YearNodes {
  double skies, suns;
  double all() const { return skies + suns; }
};

/// By the parts of the sky that the suns of the period pass: squares of equal area.
YearNodes year_nodes(const VariantPlan& plan) {
  constexpr double width = year_square_deg * radians_per_degree;
  const auto square_of = [](double along) { return static_cast<int>(std::floor(along / width)); };
  std::set<std::pair<int, int>> squares;
  for (const LitInterval& interval : plan.light.intervals) {
    if (interval.when.sunlit_s <= 0) continue;
    const EqualAreaPlace sun = equal_area_place(interval.when.direction);
    squares.insert({square_of(sun.x), square_of(sun.y)});
  }
  const auto count = static_cast<double>(std::max<std::size_t>(squares.size(), 1));
  return {std::max(fewest_skies, skies_per_square * count),
          std::max(fewest_suns, suns_per_square * count)};
}

/// Bytes of a patch while the tests of few solutions are made: what every realization receives in a
/// block, sums of its squares, and what is kept of each test.
double test_bytes_per_patch(double realizations, bool mirrors) {
  const double block = block_width * float_bytes;
  const double kinds = mirrors ? 3 : 2;  // straight, circumsolar, by mirrors
  constexpr double of_light = 10;        // what blocks of light are made of
  constexpr double spread = 16;          // sums and squares, in doubles
  constexpr double kept = 6;
  constexpr double blocks = static_cast<double>(year_tests) / static_cast<double>(block_width);
  return block *
         (realizations * kinds + of_light + spread + blocks * (kept + realizations * packed_share));
}

}  // namespace

bool is_year_of_few(const VariantPlan& plan) {
  const SolverRules rules = solver_rules(plan);
  if (rules.year == Year::modes) return true;
  return rules.year == Year::automatic && year_can_serve(rules) &&
         year_nodes(plan).all() <= most_of_few(rules, static_cast<double>(lit_intervals(plan)));
}

WorkSeconds modelled_seconds(const VariantPlan& plan, std::size_t patches,
                             const BlockCounts& counts) {
  const double n = static_cast<double>(patches), lines = n * counts.lines_per_patch;
  const double threads = thread_count();
  const auto materials = materials_of(plan);
  const bool guided = std::any_of(materials.begin(), materials.end(), emits);  // by who gathers
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

double accuracy_pilot_memory_bytes(const VariantPlan& plan, std::size_t patches) {
  const bool of_instants = plan.study.solver.accuracy->irradiance_relative.has_value();
  const SolverRules rules = rules_of_accuracy_pilot(solver_rules(plan), of_instants);
  const double R = rules.realizations, block = block_width * float_bytes;
  constexpr double sun_columns = 4;      // straight, circumsolar, by mirrors, all of them
  constexpr double spread_columns = 16;  // sums, squares, variances of three sources, in doubles
  double per_patch = rules.lines_per_patch * bytes_per_line + bytes_per_patch +
                     arrays_of_realizations * double_bytes * R;
  if (of_instants) per_patch += (sun_columns * R + spread_columns) * block;
  if (rules.transport == Transport::shoot)
    per_patch += shooting_bytes_per_patch + columns_of_a_realization * double_bytes * R;
  return program_bytes + static_cast<double>(patches) * per_patch;
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
  const SolverStudy& s = plan.study.solver;
  const auto materials = materials_of(plan);
  // Each is a scene of its own with its lines, and its own solutions of a year.
  const double seasons = std::max<double>(1, static_cast<double>(plan.seasons.all.size()));
  const auto has = [&](auto property) {
    return std::any_of(materials.begin(), materials.end(), property);
  };
  const bool mirrors = any_sends_on(plan);
  const bool lamps = has_lamps(plan);
  const bool guided =
      s.transport == Transport::gather && has([](const Material& m) { return emits(m); });
  // Total, direct, sky, reflected, and what the scene has besides.
  const double parts = 4.0 + (mirrors ? 1 : 0) + (lamps ? 1 : 0);
  const auto series_of_study = kept_series(plan.study.output);
  const double kept = std::min(
      parts, static_cast<double>(std::count(series_of_study.begin(), series_of_study.end(), true)));
  const double n = receivers(plan, patches), lit = static_cast<double>(lit_intervals(plan));
  const auto suns = static_cast<double>(plan.light.sun_samples());
  const double shining = suns - clouded_suns(plan.light);
  // Where there are more suns for what is straight alone, points of a grid are looked at, and suns
  // interpolated.
  const auto points = static_cast<double>(ShareGrid::points_about(plan.light.direct_suns()));
  const double looked_at = points == 0 ? suns : points + cost_of_interpolation * suns;
  const auto batch = static_cast<double>(std::min(plan.batch_suns(), plan.intervals()));
  const auto batches = static_cast<double>(plan.batches());
  const bool by_matrix = s.transport == Transport::matrix;
  const auto own = static_cast<double>(patches);  // without sensors, which have a pace of their own
  const double of_patches = own * counts.mean_lines();
  const double lines = n * counts.mean_lines(), links = by_matrix ? n * n : of_patches * s.bounces;
  const double of_realizations = double_bytes * s.realizations;
  const bool of_instants = plan.study.output.standard_error == StandardErrors::instants;
  const bool is_rgb = s.bands == Bands::rgb;
  const double bands = band_factor(plan);

  const bool of_few = is_year_of_few(plan);
  const YearNodes nodes = of_few ? year_nodes(plan) : YearNodes{};
  const double solved = of_few ? std::min(lit, seasons * (nodes.all() + solved_for_tests)) : lit;
  // The bright sky about the sun is that of the nodes of the sun, and of the tests.
  const double near_suns =
      of_few ? std::min(lit, seasons * (nodes.suns + static_cast<double>(year_tests))) : solved;
  // Zero where there are none.
  const double node_bytes = bands * n * float_bytes * packed_share *
                            (nodes.suns + nodes.skies * (2.0 + (mirrors ? 1 : 0) + s.realizations));
  const PartCost periods = part_cost(plan.totals, plan.batch_suns());
  // Solved side by side, as suns are, by every realization on its lines.
  const double suns_of_parts =
      s.transport != Transport::shoot ? static_cast<double>(periods.blocks * block_width) : 0;
  // Of every part: all light, the direct one, sun hours; with errors the realizations, too.
  constexpr double sums_of_part = 3, values_of_part = 4;

  WorkEstimate work;
  work.patches = patches;
  work.line_rays = static_cast<std::uint64_t>(seasons * lines);
  const double rays_of_suns =
      shining * counts.direct_samples +
      (suns - shining) * static_cast<double>(net_size(counts.direct_samples, s.realizations));
  const double rays_to_sun = facing_share * asked_by_rays(plan, patches) * rays_of_suns;
  const double rays_of_sensors = sensors_that_face(plan) * rays_of_suns;
  const double circumsolar_rays =
      facing_share * circumsolar_receivers(plan, patches) * std::min(near_suns, shining) *
      (of_few ? bands : 1) * counts.direct_samples * (of_few ? 1 : share_of_samples_drawn(plan));
  const double luminaire_rays = seasons * n * luminaires_seen * counts.direct_samples *
                                static_cast<double>(plan.built.scene.luminaires.all.size());
  work.direct_rays =
      static_cast<std::uint64_t>(rays_to_sun + rays_of_sensors + circumsolar_rays + luminaire_rays);
  work.memory_bytes =
      program_bytes + seasons * lines * bytes_per_line +
      static_cast<double>(plan.light.parts()) * bytes_per_interval +
      std::min(most_bytes_of_share_grid, points * static_cast<double>(patches)) +
      n * (bands * (batch * kept * float_bytes + arrays_of_realizations * of_realizations) +
           bytes_per_patch);
  work.memory_bytes +=
      (seasons - 1) *
      (n * season_bytes_per_patch +
       static_cast<double>(plan.built.scene.mesh.triangle_count()) * season_bytes_per_triangle);
  // One batch is written while the next is computed.
  const double series =
      std::min(parts, static_cast<double>(plan.study.output.series.size())) + (of_instants ? 1 : 0);
  constexpr double float_bits = 32, sign_and_exponent = float_bits - float_mantissa_bits;
  const double value_bytes =
      stored_bytes_per_value * (sign_and_exponent + stored_bits(plan.study)) / float_bits;
  const SeriesBytes stored = series_bytes(plan, series, value_bytes);
  const double batch_sums = parts * float_bytes * s.realizations + batch_bytes_per_patch;
  work.memory_bytes += bands * n * (stored.of_batch + batch_sums);
  work.memory_bytes += bands * n * stored.of_merge;
  // The sun's light of each realization, straight and circumsolar, and by mirrors.
  if (is_rgb || of_instants)
    work.memory_bytes += n * s.realizations * block_width * float_bytes * (mirrors ? 3.0 : 2.0);
  if (of_few) {
    // Before the first batch.
    const double of_batches =
        n * (batch * kept * float_bytes + stored.of_batch + batch_sums + stored.of_merge);
    work.memory_bytes +=
        std::max(0.0, n * test_bytes_per_patch(s.realizations, mirrors) - of_batches);
    work.memory_bytes += seasons * node_bytes;
    // Light of the sky and reflected light of a batch, kept until their time sums are known.
    constexpr double kinds = 2;
    work.memory_bytes += kinds * bands * n * batch * float_bytes * packed_share;
  }
  work.memory_bytes += bands * n * static_cast<double>(periods.most) *
                       (arrays_of_realizations * of_realizations + sums_of_part * double_bytes);
  if (by_matrix)
    work.memory_bytes +=
        seasons * n * n *
        ((s.realizations + 1.0) * bytes_per_form_factor + thread_count() * bytes_per_factor_solved);
  if (s.transport == Transport::shoot) {
    const auto blocks = static_cast<double>(lit_blocks(plan));
    const double samples = mean_over_seasons(plan, [&](const MaterialsOfScene& of_season) {
      return estimated_samples(plan, of_season, n, blocks, counts.samples_per_patch);
    });
    const double per_shot = samples / std::max(1.0, blocks * s.bounces);
    // Less is a matter of memory; and as the estimate knows no shadows, whether it is too much for
    // a shot shows when it is shot.
    constexpr double most_counted = 9e18;  // in 64 bits
    if (samples > most_counted) refuse_samples(per_shot / s.realizations);
    work.samples = static_cast<std::uint64_t>(samples);
    work.memory_bytes +=
        n * (shooting_bytes_per_patch + of_realizations * columns_of_a_realization) +
        per_shot / s.realizations * bytes_per_sample;
  }
  work.disk_bytes =
      bands * n * stored.on_disk + bands * n * batches * batch_sums +
      result_bytes(plan, n, parts, bands) + interval_bytes(plan, bands, value_bytes) +
      bands * n *
          (static_cast<double>(periods.stored) * sums_of_part * double_bytes +
           static_cast<double>(periods.stored_with_errors) * float_bytes * s.realizations) +
      bands * n * float_bytes *
          (static_cast<double>(periods.parts) * values_of_part +
           static_cast<double>(periods.parts_with_errors) * s.realizations) +
      prepared_bytes(plan, static_cast<double>(patches), counts.mean_lines(), guided, node_bytes);
  WorkSeconds core;  // of one core
  core.lines =
      seasons * tracing_seconds(plan, own, of_patches, guided) +
      static_cast<double>(work.samples) * s_per_sample +  // a shot meets surfaces as a line does
      (plan.study.mesh.oracle == Oracle::none ? 0
                                              : refinement_rays(plan, n, lit) * s_per_direct_ray);
  core.direct = sun_seconds(static_cast<double>(patches), looked_at, rays_to_sun,
                            of_few ? 0 : circumsolar_rays) +
                luminaire_rays * s_per_luminaire_ray;
  const double sent_on =
      shining / std::max(suns, 1.0) * static_cast<double>(plan.light.suns_of_mirrors());
  core.mirror = mirrors ? mirror_seconds(plan, own, sent_on, counts.direct_samples) : 0;
  core.sensors =
      sensor_seconds(plan, counts.mean_lines(), lit, rays_of_sensors, counts.direct_samples);
  if (by_matrix)
    core.solve += seasons * n * n * (s_per_form_factor + n * s.realizations * s_per_factor_solved);
  if (s.transport != Transport::shoot)
    core.solve +=
        bands * (links * batches * s_per_link_batch + links * suns_of_parts * s_per_link_sun +
                 n * suns_of_parts * s.realizations * s_per_patch_sun_realization +
                 (of_instants ? links * lit * s_per_link_sun +
                                    n * lit * s.realizations * s_per_patch_sun_realization
                              : 0));
  const double solved_links = s.transport != Transport::shoot ? links : 0;
  core.solve += bands * (lit * s_per_sun + solution_seconds(n, solved_links, solved) +
                         (of_few ? n * lit * s_per_patch_interval_of_year : 0) +
                         n * (batches + static_cast<double>(periods.stored_with_errors)) *
                             s.realizations * s_per_patch_batch_realization);
  const double files = bands * n *
                           (static_cast<double>(plan.intervals()) * s_per_value +
                            batches * batch_sums * s_per_byte_of_sums) +
                       n * s_per_patch;
  const double rows = plan.steps.empty() ? lit : static_cast<double>(plan.steps.size());
  const double further_series = bands * n * rows * std::max(0.0, series - 1) * s_per_further_value;
  work.is_of_this_machine = pace.is_measured;
  // Of a disk the model itself goes by samples.
  const double mirror_pace = plan.study.sun.disk == SunDisk::finite
                                 ? pace.mirror
                                 : pace.mirror_with(counts.direct_samples);
  // The trial of a period of few solutions has no sky, and none has that of parts.
  const double untried =
      (of_few ? circumsolar_rays * s_per_circumsolar_ray : 0) +
      std::max(0.0, static_cast<double>(plan.light.lit_parts()) - lit) * s_per_sky_of_part;
  // Series are put together by one thread.
  work.seconds = files + (s_to_start + untried + further_series + core.lines * pace.lines +
                          core.direct * pace.direct + core.mirror * mirror_pace +
                          core.solve * pace.solve + core.sensors * pace.sensors) /
                             thread_count();
  return work;
}

}  // namespace sunload
