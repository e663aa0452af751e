// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/work_probe.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "io/plan/cost.h"
#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/workload.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/solver.h"

namespace sunload {

namespace {

// Long enough for a clock, short enough for who waits: some tenths of a second on two cores.
constexpr double lines_wanted = 1e6, sun_rays_wanted = 6e6;
/// What took less is done again, small scenes several times, and the fastest counts: the first run
/// waits for memory that the system clears, a tenth of a longer one.
constexpr double long_enough_s = 0.3;
constexpr int most_repetitions = 5;
constexpr int probe_realizations = 2, most_probe_samples = 16;

/// The study's own, with fewer lines, samples and realizations.
SolverRules probe_rules(const VariantPlan& plan, std::size_t patches) {
  SolverRules rules = solver_rules(plan);
  const auto even = [](double count) { return std::max(2, 2 * static_cast<int>(count / 2)); };
  rules.lines_per_patch =
      even(std::min<double>(rules.lines_per_patch, lines_wanted / static_cast<double>(patches)));
  rules.direct_samples = even(std::min(rules.direct_samples, most_probe_samples));
  rules.realizations = probe_realizations;
  rules.errors = Errors::totals;
  rules.transport = Transport::gather;
  rules.year = Year::each;
  rules.by_source = false;
  return rules;
}

/// Those with the sun above the horizon, or else with light, in the order in which a run looks at
/// them: batch by batch, by azimuth.
std::vector<std::size_t> intervals_in_order(const VariantPlan& plan) {
  std::vector<std::size_t> sunlit, lit;
  for (std::size_t k = 0; k < plan.intervals(); ++k) {
    const LitInterval& interval = plan.light.intervals[k];
    if (is_dark(interval)) continue;
    lit.push_back(k);
    if (interval.when.sunlit_s > 0) sunlit.push_back(k);
  }
  auto& order = sunlit.empty() ? lit : sunlit;
  const auto place = [&](std::size_t k) {
    return std::pair{k / plan.batch_suns(), place_in_batch(plan.light.intervals[k].when.direction)};
  };
  std::ranges::sort(order, {}, place);
  return std::move(order);
}

std::vector<IntervalLight> suns_of(const VariantPlan& plan, const SkyGrid& grid,
                                   const std::vector<std::size_t>& intervals) {
  const IntervalLights lights(plan.study, plan.built.site, grid);
  const bool of_few = is_year_of_few(plan);
  std::vector<IntervalLight> suns;
  for (const std::size_t k : intervals) {
    suns.push_back(lights.of(plan.light.intervals[k], k));
    // Behind clouds none would go by mirrors.
    if (suns.back().has_sun()) suns.back().dni = std::max(suns.back().dni, 1.0);
    // One sun of many: what many of them cost is told by the model.
    if (suns.back().has_direct_suns()) suns.back().sun_samples.clear();
    suns.back().direct_suns.clear();
    // In a year of few solutions these alone have rays to the bright sky about their sun.
    if (!of_few) continue;
    suns.back().dhi = suns.back().ground_exitance = 0;
    suns.back().sky.clear();
  }
  return suns;
}

/// The least of each kind of work.
WorkDone fastest(const std::vector<WorkDone>& runs) {
  WorkDone least = runs.front();
  for (const WorkDone& run : runs)
    for (std::size_t w = 0; w < work_count; ++w)
      least.values()[w] = std::min(least.values()[w], run.values()[w]);
  return least;
}

template <class Run>
WorkDone repeated(const Run& run) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  std::vector<WorkDone> runs;
  do {
    runs.push_back(run());
  } while (runs.size() < most_repetitions &&
           std::chrono::duration<double>(Clock::now() - begin).count() < long_enough_s);
  return fastest(runs);
}

constexpr double most_ratio = 50;  // beyond, something else was measured
/// The model knows nothing of light that goes from mirror to mirror.
constexpr double most_ratio_of_mirrors = 1e5;

double ratio(double measured_s, double modelled_s, double most = most_ratio) {
  constexpr double least = 0.05;
  return modelled_s > 0 && measured_s > 0 ? std::clamp(measured_s / modelled_s, least, most) : 1;
}

}  // namespace

std::vector<std::size_t> tried_intervals(const VariantPlan& plan, double most) {
  constexpr std::size_t neighbours = 4;
  const auto order = intervals_in_order(plan);
  const std::size_t count =
      std::min(order.size(), static_cast<std::size_t>(std::clamp<double>(most, 1, block_width)));
  const std::size_t places = chunk_count(count, neighbours);
  if (places == 0) return {};
  const std::size_t together = count / places;
  std::vector<std::size_t> begins;
  for (std::size_t at = 0; at + together <= order.size(); at += together) begins.push_back(at);
  std::ranges::stable_sort(begins, {}, [&](std::size_t at) {
    return plan.light.intervals[order[at + together / 2]].when.direction.z;
  });
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < places; ++i) {
    const std::size_t at = begins[(2 * i + 1) * begins.size() / (2 * places)];
    for (std::size_t k = at; k < at + together; ++k) chosen.push_back(order[k]);
  }
  return chosen;
}

std::optional<WorkPace> measured_pace(const VariantPlan& plan,
                                      const std::shared_ptr<const Hierarchy>& mesh) {
  const std::size_t patches = mesh->patch_count();
  const SolverRules rules = probe_rules(plan, patches);
  const double rays_of_sun = static_cast<double>(patches) * rules.direct_samples;
  const auto intervals = tried_intervals(plan, sun_rays_wanted / rays_of_sun);
  if (intervals.empty()) return {};
  Watch watch;
  const auto traced = trace_scene(plan.built.scene, mesh, rules, watch);
  const auto suns = suns_of(plan, traced->grid, intervals);
  const auto transport = transport_of(*traced);
  const WorkDone done = repeated([&] { return solve(*transport, suns, watch).work; });
  double all_suns = 0;
  for (const IntervalLight& sun : suns)
    all_suns += static_cast<double>(std::max<std::size_t>(sun.sun_samples.size(), 1));
  const WorkSeconds modelled =
      modelled_seconds(plan, patches, {rules.lines_per_patch, rules.direct_samples, all_suns});
  WorkPace pace;
  pace.is_measured = true;
  pace.lines = ratio(traced->work[Work::lines_s], modelled.lines);
  pace.direct = ratio(done[Work::direct_s], modelled.direct);
  pace.mirror = ratio(done[Work::mirror_s], modelled.mirror, most_ratio_of_mirrors);
  pace.direct_samples = rules.direct_samples;
  if (done[Work::mirror_s] > 0)
    pace.rays_of_mirrors = std::min(1.0, done[Work::mirror_rays] * cost::s_per_mirror_ray /
                                             (thread_count() * done[Work::mirror_s]));
  pace.solve = ratio(done[Work::solve_s], modelled.solve);
  pace.sensors = ratio(traced->work[Work::sensors_s] + done[Work::sensors_s], modelled.sensors);
  return pace;
}

WorkPace StudyPaces::of(const VariantPlan& plan, const std::shared_ptr<const Hierarchy>& mesh) {
  const auto materials = materials_of(plan);
  const bool has_mirrors = std::any_of(materials.begin(), materials.end(), sends_on);
  auto& pace = has_mirrors ? with_mirrors_ : without_;
  if (!pace) pace = measured_pace(plan, mesh);
  return pace.value_or(WorkPace());
}

}  // namespace sunload
