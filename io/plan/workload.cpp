// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/workload.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geo/base/units.h"
#include "io/plan/cost.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/seasons_of_plan.h"
#include "io/plan/shared_samples.h"
#include "io/plan/stored_bits.h"
#include "io/plan/surface_shares.h"
#include "io/plan/variant_mesh.h"
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

/// Counts of light: what is received, kept and stored of it.
void count_kinds(Workload& work) {
  const VariantPlan& plan = work.plan;
  work.kinds = 4.0 + (work.has_mirrors ? 1 : 0) + (has_lamps(plan) ? 1 : 0);
  const auto kept = kept_series(plan.study.output);
  work.kept_kinds =
      std::min(work.kinds, static_cast<double>(std::count(kept.begin(), kept.end(), true)));
  work.stored_kinds = std::min(work.kinds, static_cast<double>(plan.study.output.series.size())) +
                      (work.of_instants ? 1 : 0);
  constexpr double float_bits = 32, sign_and_exponent = float_bits - float_mantissa_bits;
  work.value_bytes =
      stored_bytes_per_value * (sign_and_exponent + stored_bits(plan.study)) / float_bits;
  work.series = series_bytes(plan, work.stored_kinds, work.value_bytes);
}

/// Counts of suns and of what is solved.
void count_solutions(Workload& work) {
  const VariantPlan& plan = work.plan;
  work.lit = static_cast<double>(lit_intervals(plan));
  work.suns = static_cast<double>(plan.light.sun_samples());
  work.shining = work.suns - clouded_suns(plan.light);
  work.grid_points = static_cast<double>(ShareGrid::points_about(plan.light.direct_suns()));
  work.batch = static_cast<double>(std::min(plan.batch_suns(), plan.intervals()));
  work.batches = static_cast<double>(plan.batches());
  work.of_few = is_year_of_few(plan);
  if (work.of_few) work.nodes = year_nodes(plan);
  work.solved = work.of_few
                    ? std::min(work.lit, work.seasons * (work.nodes.all() + solved_for_tests))
                    : work.lit;
  // The bright sky about the sun is that of the nodes of the sun, and of the tests.
  work.near_suns =
      work.of_few
          ? std::min(work.lit, work.seasons * (work.nodes.suns + static_cast<double>(year_tests)))
          : work.solved;
  work.periods = part_cost(plan.totals, plan.batch_suns());
  // Solved side by side, as suns are, by every realization on its lines.
  if (!work.shoots) work.suns_of_parts = static_cast<double>(work.periods.blocks * block_width);
}

}  // namespace

double Workload::looked_at() const {
  return grid_points == 0 ? suns : grid_points + cost_of_interpolation * suns;
}

double Workload::node_bytes() const {
  const double of_sky = 2.0 + (has_mirrors ? 1 : 0) + plan.study.solver.realizations;
  return bands * receivers * float_bytes * packed_share * (nodes.suns + nodes.skies * of_sky);
}

double Workload::batch_sum_bytes() const {
  return kinds * float_bytes * plan.study.solver.realizations + batch_bytes_per_patch;
}

Workload workload(const VariantPlan& plan, std::size_t patches, const SampleCounts& counts) {
  const SolverStudy& s = plan.study.solver;
  Workload work{plan, counts};
  work.patches = static_cast<double>(patches);
  work.receivers = static_cast<double>(patches + plan.built.scene.sensors.size());
  work.seasons = std::max<double>(1, static_cast<double>(plan.seasons.all.size()));
  work.bands = band_factor(plan);
  work.by_matrix = s.transport == Transport::matrix;
  work.shoots = s.transport == Transport::shoot;
  work.has_mirrors = any_sends_on(plan);
  work.is_guided = s.transport == Transport::gather && any_emits(plan);
  work.of_instants = plan.study.output.standard_error == StandardErrors::instants;
  work.lines_of_patches = work.patches * counts.mean_lines();
  work.lines = work.receivers * counts.mean_lines();
  work.links = work.by_matrix ? work.receivers * work.receivers : work.lines_of_patches * s.bounces;
  count_kinds(work);
  count_solutions(work);
  return work;
}

WorkloadRays rays_of(const Workload& work) {
  const VariantPlan& plan = work.plan;
  const auto patches = static_cast<std::size_t>(work.patches);
  const double samples = work.counts.direct_samples;
  const double net =
      static_cast<double>(net_size(work.counts.direct_samples, plan.study.solver.realizations));
  const double of_suns = work.shining * samples + (work.suns - work.shining) * net;
  WorkloadRays rays;
  rays.to_sun = facing_share * asked_by_rays(plan, patches) * of_suns;
  rays.of_sensors = sensors_that_face(plan) * of_suns;
  rays.circumsolar = facing_share * circumsolar_receivers(plan, patches) *
                     std::min(work.near_suns, work.shining) * (work.of_few ? work.bands : 1) *
                     samples * (work.of_few ? 1 : share_of_samples_drawn(plan));
  rays.to_luminaires = work.seasons * work.receivers * luminaires_seen * samples *
                       static_cast<double>(plan.built.scene.luminaires.all.size());
  return rays;
}

ShotSamples shot_samples(const Workload& work) {
  if (!work.shoots) return {};
  const SolverStudy& s = work.plan.study.solver;
  const auto blocks = static_cast<double>(lit_blocks(work.plan));
  ShotSamples samples;
  samples.all = mean_over_seasons(work.plan, [&](const MaterialsOfScene& of_season) {
    return estimated_samples(work.plan, of_season, work.receivers, blocks,
                             work.counts.samples_per_patch);
  });
  samples.of_one_shot = samples.all / std::max(1.0, blocks * s.bounces);
  // Less is a matter of memory; and as the estimate knows no shadows, whether it is too much for
  // a shot shows when it is shot.
  constexpr double most_counted = 9e18;  // in 64 bits
  if (samples.all > most_counted) refuse_samples(samples.of_one_shot / s.realizations);
  return samples;
}

bool is_year_of_few(const VariantPlan& plan) {
  const SolverRules rules = solver_rules(plan);
  if (rules.year == Year::modes) return true;
  return rules.year == Year::automatic && year_can_serve(rules) &&
         year_nodes(plan).all() <= most_of_few(rules, static_cast<double>(lit_intervals(plan)));
}

double circumsolar_receivers(const VariantPlan& plan, std::size_t patches) {
  return plan.study.solver.transport == Transport::shoot ? 0 : static_cast<double>(patches);
}

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

double sensors_that_face(const VariantPlan& plan) {
  double faced = 0;
  for (const Sensor& sensor : plan.built.scene.sensors) faced += (1 + sensor.normal.z) / 2;
  return faced;
}

bool any_sends_on(const VariantPlan& plan) {
  const auto materials = materials_of(plan);
  return std::any_of(materials.begin(), materials.end(), sends_on);
}

bool any_emits(const VariantPlan& plan) {
  const auto materials = materials_of(plan);
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material& m) { return m.emission_w_m2 > 0; });
}

double band_factor(const VariantPlan& plan) {
  return plan.study.solver.bands == Bands::rgb ? static_cast<double>(band_count) : 1;
}

}  // namespace sunload
