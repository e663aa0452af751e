// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/variant_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/base/machine.h"
#include "io/base/waiting_lock.h"
#include "io/batch/batch_tally.h"
#include "io/batch/file.h"
#include "io/batch/prepared_file.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/work_estimate.h"
#include "io/run/merge.h"
#include "io/run/mpi_world.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

std::string rays_text(const char* what, std::uint64_t rays, double seconds) {
  if (rays == 0 || seconds <= 0) return {};
  return fmt::format("  {:<14} {:8.2f} s  {:9.3g} rays  {:7.1f} million rays/s\n", what, seconds,
                     static_cast<double>(rays), static_cast<double>(rays) / seconds / 1e6);
}

std::size_t suns_before(const VariantPlan& plan, std::size_t batch) {
  std::size_t suns = 0;
  for (std::size_t b = 0; b < batch; ++b) suns += sun_count(plan, b);
  return suns;
}

/// What the pilot decided.
std::string counts_text(const VariantPlan& plan, const SampleCounts& counts) {
  const SolverRules rules = with_counts(solver_rules(plan), counts);
  std::string shot;
  if (rules.power_per_sample_w)
    shot = fmt::format(", shots of {:.3g} W per sample", *rules.power_per_sample_w);
  else if (rules.samples_per_patch)
    shot = fmt::format(", {} samples per patch in the first shot", *rules.samples_per_patch);
  const auto [fewest, most] =
      std::minmax_element(counts.lines_of_patch.begin(), counts.lines_of_patch.end());
  const std::string lines =
      fewest == most || *fewest == *most
          ? fmt::format("{}", counts.lines_per_patch)
          : fmt::format("{} to {} (mean {:.0f})", *fewest, *most, counts.mean_lines());
  std::string text = fmt::format(
      "{}: accuracy of {}: {} lines and {} direct samples per patch{}, by which a pilot "
      "expects it on {:.3g} % of the area",
      plan.study.variant, goal_words(*plan.study.solver.accuracy), lines, counts.direct_samples,
      shot, 100 * counts.share);
  if (counts.share < share_to_be_met)
    text += fmt::format("; {} lines and samples at most cannot give more (max_lines_per_patch)",
                        plan.study.solver.max_lines_per_patch);
  return text;
}

/// The pilot, or counts that it chose, may need more than the least counts that `check` knows.
void refuse_too_much(double memory_bytes) {
  if (const double left = available_memory_bytes(); memory_bytes > left)
    throw MachineError(fmt::format(
        "too little memory for the accuracy asked for: about {:.1f} GiB are needed, {:.1f} GiB are "
        "available; use a smaller max_lines_per_patch or a larger error in accuracy",
        memory_bytes / gib, left / gib));
}

}  // namespace

VariantRun::VariantRun(const std::string& folder, const VariantPlan& plan,
                       std::shared_ptr<const Hierarchy> mesh, Progress& progress)
    : folder_(folder), plan_(plan), mesh_(std::move(mesh)), progress_(progress) {}

VariantRun::~VariantRun() { progress_.count_rays({}); }

void VariantRun::compute(UnitQueue& units, MpiWorld* world) {
  make_writable_folder(work_folder(folder_, plan_));
  // Ranks meet where the first of them traces the lines, before any takes a batch.
  if (world && world->any(!batches_not_there(folder_, plan_).empty())) make_solver(world);
  std::size_t suns_behind = 0;
  for (auto batch = units.next(); batch; batch = units.next()) {
    const std::size_t suns = sun_count(plan_, *batch);
    if (!is_finished(*batch)) {
      if (!solver_) make_solver(world);
      if (world) suns_behind = suns_before(plan_, *batch);
      progress_.begin_batch(suns_behind, suns);
      compute_batch(*batch);
    }
    suns_behind += suns;
  }
  if (solver_) report_work();
}

bool VariantRun::is_finished(std::size_t batch) {
  const auto check = check_batch(batch_path(folder_, plan_, batch), plan_.content_hash, batch);
  if (check.exists && !check.valid)
    progress_.say("warning: " + check.reason + "; it is computed again");
  return check.valid;
}

void VariantRun::make_solver(MpiWorld* world) {
  rules_ = decided_rules();
  if (!world) return read_or_trace();
  if (world->is_first()) read_or_trace();
  world->wait_for_all();
  if (!world->is_first()) build(read_prepared(prepared_path(folder_, plan_), plan_.content_hash));
}

void VariantRun::read_or_trace() {
  const std::string path = prepared_path(folder_, plan_);
  if (auto ready = read_prepared(path, plan_.content_hash)) return build(std::move(ready));
  if (batches_not_there(folder_, plan_).size() < 2) return build({});
  const WaitingLock lock(path + ".lock",
                         {.is_cancelled = [this] { return progress_.stop_requested(); },
                          .waiting =
                              [this] {
                                progress_.say(plan_.study.variant +
                                              ": another process traces the lines; waiting for it");
                              }});
  if (!lock.is_held())
    progress_.say("warning: cannot lock " + path + ".lock (" + lock.problem() +
                  "); processes that start together each trace the lines");
  build(read_prepared(path, plan_.content_hash));
  if (solver_->work().line_rays > 0) keep_lines(path);
}

void VariantRun::build(std::optional<Lines> ready) {
  progress_.count_rays(
      [rays = static_cast<double>(estimate_work(plan_, mesh_->patch_count()).line_rays)](
          Stage, double share) { return rays * share; });
  if (!ready) progress_.advance(Stage::lines, 0);
  solver_ =
      std::make_unique<LightSolver>(plan_.built.scene, mesh_, rules_, progress_, std::move(ready));
  warn_of_sensors();
  progress_.count_rays([this](Stage, double) {
    const WorkDone& work = solver_->work();
    return static_cast<double>(work.direct_rays + work.mirror_rays);
  });
  lights_.emplace(plan_.study, plan_.built.site, solver_->sky_grid());
}

void VariantRun::warn_of_sensors() {
  const std::size_t orientations = solver_->mirror_orientations();
  const auto most = static_cast<std::size_t>(rules_.most_sensor_beams);
  if (plan_.built.scene.sensors.empty() || orientations <= most) return;
  progress_.say(fmt::format(
      "{}: warning: mirrors face in {} directions; sensors do not see the sun by way of mirrors "
      "while more than {} face it (patches do)",
      plan_.study.variant, orientations, most));
}

/// Only a help for later: where it cannot be written, the work goes on.
void VariantRun::keep_lines(const std::string& path) {
  try {
    make_writable_folder(work_folder(folder_, plan_));
    write_prepared(path, plan_.content_hash, solver_->lines());
  } catch (const MachineError& error) {
    progress_.say(plan_.study.variant + ": warning: the traced lines are not kept (" +
                  error.what() + "); who goes on with this work traces them again");
  }
}

/// The study's rules, with counts raised by a pilot where it asks for an accuracy. Every
/// process of a study comes to the same counts.
SolverRules VariantRun::decided_rules() {
  SolverRules rules = solver_rules(plan_);
  if (!plan_.study.solver.accuracy) return rules;
  const Scene& scene = plan_.built.scene;
  const bool lamps = has_lamps(plan_);
  std::vector<std::size_t> lit;
  for (std::size_t k = 0; k < plan_.intervals(); ++k)
    if (lamps || !is_dark(plan_.light.intervals[k])) lit.push_back(k);
  const std::size_t count = std::min(pilot_suns, lit.size());
  const SkyGrid grid;
  const IntervalLights lights(plan_.study, plan_.built.site, grid);
  std::vector<SunLight> suns(count);
  parallel_for(count, [&](std::size_t p) {
    const std::size_t k = lit[(2 * p + 1) * lit.size() / (2 * count)];
    suns[p] = lights.of(plan_.light.intervals[k], k);
  });
  const double weight =
      count > 0 ? static_cast<double>(lit.size()) / static_cast<double>(count) : 1;
  SolverRules of_pilot = rules;
  of_pilot.bands = Bands::broadband;  // the goal is for the mean of the bands
  const AccuracyGoal goal = accuracy_goal(plan_.study);
  refuse_too_much(pilot_memory_bytes(plan_, mesh_->patch_count()));
  const PatchSpread spread =
      pilot_spread(scene, mesh_, of_pilot, suns,
                   {weight, plan_.batch_suns(), goal.irradiance_relative.has_value()}, progress_);
  const SampleCounts counts = needed_counts(spread, rules, goal, lit.size());
  refuse_too_much(estimate_work(plan_, spread.area.size(), counts).memory_bytes);
  progress_.say(counts_text(plan_, counts));
  return with_counts(rules, counts);
}

void VariantRun::compute_batch(std::size_t batch) {
  const std::size_t first = batch * plan_.batch_suns();
  const std::size_t count = std::min(plan_.batch_suns(), plan_.intervals() - first);
  const std::vector<SunLight> light = lights_->of(plan_.light, first, count);
  const std::vector<BatchTally> tallies = solver_->solve_bands(light, progress_);
  WorkDone work = solver_->work();
  work -= written_;
  BatchWriter writer({.content_hash = plan_.content_hash,
                      .variant = plan_.study.variant,
                      .isa = plan_.isa,
                      .batch = batch,
                      .first_interval = first,
                      .interval_count = count,
                      .chunk_intervals = plan_.batch_suns(),
                      .compression = plan_.study.output.compression});
  const auto& accuracy = plan_.study.solver.accuracy;
  add_tallies(writer, tallies, *solver_, plan_.built.scene.mesh, work,
              accuracy ? accuracy->irradiance_relative : std::nullopt);
  // Another process that failed may have removed the folder, which was empty until now.
  make_writable_folder(work_folder(folder_, plan_));
  writer.write(batch_path(folder_, plan_, batch));
  written_ = solver_->work();
}

void VariantRun::report_work() const {
  const WorkDone& w = solver_->work();
  std::string text =
      fmt::format("{}: {} patches\n", plan_.study.variant, solver_->hierarchy().patch_count());
  text += rays_text("lines", w.line_rays, w.lines_s);
  text += rays_text("direct sun", w.direct_rays, w.direct_s);
  text += rays_text("mirrored sun", w.mirror_rays, w.mirror_s);
  if (w.mirror_beams + w.mirror_shots > 0)
    text += fmt::format("  {:<14} {} beams by image directions, {} arrivals by shooting\n", "",
                        w.mirror_beams, w.mirror_shots);
  text += rays_text("shooting", w.shot_rays, w.shoot_s);
  text += rays_text("sensors", w.sensor_rays, w.sensors_s);
  text += fmt::format("  {:<14} {:8.2f} s\n  {:<14} {:8.2f} s  peak memory {:.0f} MiB",
                      "sky and Jacobi", w.solve_s, "realizations", w.realizations_s,
                      peak_memory_bytes() / mib);
  progress_.say(text);
}

}  // namespace sunload
