// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/variant_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "io/base/file_writing.h"
#include "io/base/machine.h"
#include "io/base/waiting_lock.h"
#include "io/batch/batch_tally.h"
#include "io/batch/file.h"
#include "io/run/decided_rules.h"
#include "io/run/mpi_world.h"
#include "io/run/part_merge.h"
#include "io/run/stored_series.h"

namespace sunload {

namespace {

std::string rays_text(const char* what, double rays, double seconds) {
  if (rays == 0 || seconds <= 0) return {};
  return fmt::format("  {:<14} {:8.2f} s  {:9.3g} rays  {:7.1f} million rays/s\n", what, seconds,
                     rays, rays / seconds / 1e6);
}

}  // namespace

VariantRun::VariantRun(const WorkFolder& folder, const VariantPlan& plan,
                       std::shared_ptr<const Hierarchy> mesh, Progress& progress,
                       TracedRays* shared)
    : folder_(folder), plan_(plan), mesh_(std::move(mesh)), progress_(progress), shared_(shared) {}

VariantRun::~VariantRun() {
  try {
    finish();
  } catch (const std::exception& error) {
    warn(std::string("the last batch is lost: ") + error.what());
  }
}

void VariantRun::prepare(MpiWorld* world) {
  speaks_for_all_ = speaks_for_all(world);
  rules_ = decided_rules(plan_, mesh_, progress_);
  if (!plan_.seasons.all.empty()) return build_seasons();
  if (!world) return read_or_trace();
  if (world->is_first()) {
    read_or_trace();
    finish();  // what the others read
  }
  world->wait_for_all();
  if (world->is_first()) return;
  if (has_shared_lines()) return take_shared_lines();
  build_prepared(read_prepared(folder_.prepared(), plan_.content_hash));
}

void VariantRun::take_shared_lines() {
  if (shared_->traced_by != plan_.study.variant)
    progress_.say(fmt::format("{}: rays tell of it what they told of {}; they are not cast again",
                              plan_.study.variant, shared_->traced_by));
  build(std::exchange(shared_->lines, {}));
  unwritten_.add(Work::line_rays, seasons_.front()->traced().patches.lines.rays);
}

void VariantRun::read_or_trace() {
  if (has_shared_lines()) return take_shared_lines();
  const std::string path = folder_.prepared(), lock_path = folder_.prepared_lock();
  if (auto ready = read_prepared(path, plan_.content_hash)) return build_prepared(std::move(ready));
  if (folder_.batches_not_there().size() < 2) return build({});
  const auto say_waiting = [this] {
    progress_.say(plan_.study.variant + ": another process traces the lines; waiting for it");
  };
  auto lock = std::make_shared<const WaitingLock>(
      lock_path, WaitingLock::Rules{.is_cancelled = [this] { return progress_.stop_requested(); },
                                    .waiting = say_waiting});
  if (!lock->is_held())
    progress_.warn("warning: cannot lock " + lock_path + " (" + lock->problem() +
                   "); processes that start together each trace the lines");
  build_prepared(read_prepared(path, plan_.content_hash));
  if (unwritten_[Work::line_rays] == 0) return;
  // Who waits for the lock reads the file: it is let go when that is there.
  writing_.begin([this, path, lock = std::move(lock)]() mutable {
    keep_lines(path);
    lock.reset();
  });
}

/// With what another process has traced, solved, or found not to pay; none: all anew.
void VariantRun::build_prepared(std::optional<Prepared> ready) {
  if (!ready) return build({});
  if (ready->nodes.empty()) rules_.year = Year::each;
  build(std::move(ready->lines), std::move(ready->nodes));
}

void VariantRun::build(std::optional<Lines> lines, std::vector<SolvedNodes> nodes) {
  if (!lines) progress_.advance(Stage::lines, 0);
  add(std::make_unique<TracedSeason>(plan_, 0, mesh_, rules_, progress_, std::move(lines),
                                     std::move(nodes)));
  seen_ = seen_once(seasons_.front()->traced());
}

/// Every process traces them for itself: nothing is kept in the prepared file.
void VariantRun::build_seasons() {
  std::vector<SeenOnce> seen;
  std::vector<double> shares;
  for (std::size_t s = 0; s < plan_.seasons.all.size(); ++s) {
    progress_.advance(Stage::lines, 0);
    add(std::make_unique<TracedSeason>(plan_, s, mesh_, rules_, progress_));
    seen.push_back(seen_once(seasons_.back()->traced()));
    shares.push_back(seasons_.back()->share());
  }
  seen_ = mean_seen(seen, shares);
}

void VariantRun::add(std::unique_ptr<TracedSeason> season) {
  unwritten_ += season->work();
  done_ = unwritten_;
  seasons_.push_back(std::move(season));
  if (!speaks_for_all_) return;
  if (seasons_.size() == 1) warn_of_sensors();
  tell_reduction(*seasons_.back());
}

void VariantRun::tell_reduction(const TracedSeason& season) const {
  const Reduction* reduction = season.transport().reduction();
  if (!reduction) return;
  const std::string text = fmt::format(
      "sky and reflected light of all intervals from {} skies and {} suns; on intervals that are "
      "none of them this differs by {:.2g} W/m2 from their own solutions, {:.0f} % of the "
      "standard error that an interval's have",
      reduction->skies, reduction->suns, reduction->error_w_m2, 100 * reduction->share());
  if (reduction->is_met)
    progress_.say(plan_.study.variant + ": " + text);
  else
    warn(text +
         ", and is not surely below the third that is aimed at; solver.year: each has no such "
         "error");
}

void VariantRun::warn_of_sensors() {
  const std::size_t orientations = seasons_.front()->traced().mirror_orientations();
  const auto most = static_cast<std::size_t>(rules_.most_sensor_beams);
  if (plan_.built.scene.sensors.empty() || orientations <= most) return;
  warn(fmt::format(
      "mirrors face in {} directions; sensors do not see the sun by way of mirrors while more than "
      "{} face it (patches do)",
      orientations, most));
}

/// Only a help for later: where it cannot be written, the work goes on.
void VariantRun::keep_lines(const std::string& path) {
  try {
    folder_.make();
    write_prepared(path, plan_.content_hash, seasons_.front()->traced().patches.lines,
                   seasons_.front()->transport().nodes());
  } catch (const MachineError& error) {
    warn(std::string("the traced lines are not kept (") + error.what() +
         "); who goes on with this work traces them again");
  }
}

void VariantRun::warn(const std::string& text) const {
  progress_.warn(plan_.study.variant + ": warning: " + text);
}

void VariantRun::compute(std::size_t batch) {
  const std::size_t first = batch * plan_.batch_suns();
  const std::size_t count = std::min(plan_.batch_suns(), plan_.intervals() - first);
  const BatchParts parts = parts_of_batch(plan_.totals, first, count);
  const Solved solved = this->solved(batch, parts);
  unwritten_ += solved.work;
  done_ += solved.work;
  const StoredSeries stored = stored_series(plan_, batch);
  auto writer =
      std::make_shared<BatchWriter>(BatchHeader{.content_hash = plan_.content_hash,
                                                .variant = plan_.study.variant,
                                                .isa = plan_.isa,
                                                .batch = batch,
                                                .first_interval = first,
                                                .interval_count = count,
                                                .chunk_intervals = plan_.batch_suns(),
                                                .compression = plan_.study.output.compression,
                                                .left_out = stored.left_out});
  const auto& accuracy = plan_.study.solver.accuracy;
  add_tallies(*writer, solved.bands, seasons_.front()->traced(), seen_, plan_.built.scene.mesh,
              parts, unwritten_, accuracy ? accuracy->irradiance_relative : std::nullopt, stored);
  add_reduction(*writer);
  writing_.begin([this, writer = std::move(writer), path = folder_.batch(batch)]() mutable {
    write(*writer, path);
    writer.reset();  // its memory; the thread's state lives until the next file
  });
  unwritten_ = {};
}

Solved VariantRun::solved(std::size_t batch, const BatchParts& parts) {
  const std::size_t first = batch * plan_.batch_suns();
  const std::size_t count = std::min(plan_.batch_suns(), plan_.intervals() - first);
  const auto suns = seasons_.front()->lights().of(plan_.light, first, count);
  if (seasons_.size() == 1)
    return solve(seasons_.front()->transport(), suns, progress_, parts.solved, record_of(batch));
  std::vector<const LightTransport*> scenes;
  for (const auto& season : seasons_) scenes.push_back(&season->transport());
  std::vector<Stretch> stretches;
  for (const SeasonStretch& stretch : plan_.seasons.stretches(first, count))
    stretches.push_back({stretch.season, stretch.count});
  return solve_in_turns(scenes, stretches, suns, progress_, parts.solved);
}

/// The worst of all seasons.
void VariantRun::add_reduction(BatchWriter& writer) const {
  std::array<double, 4> values{};
  bool is_there = false;
  for (const auto& season : seasons_)
    if (const Reduction* reduction = season->transport().reduction()) {
      is_there = true;
      const std::array of_season{static_cast<double>(reduction->skies),
                                 static_cast<double>(reduction->suns), reduction->error_w_m2,
                                 reduction->standard_error_w_m2};
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::max(values[i], of_season[i]);
    }
  if (is_there)
    writer.add({batch_array::reduction, MergeRule::maximum, ArrayType::float64, {values.size()}},
               values.data());
}

/// Where another variant is to come that takes it, or this one can take it.
RayRecord* VariantRun::record_of(std::size_t batch) {
  if (!shared_) return nullptr;
  const auto kept = shared_->batches.find(batch);
  if (kept != shared_->batches.end() && kept->second.state == RayRecord::State::whole)
    return &kept->second;
  if (!shared_->is_wanted_later) return nullptr;
  RayRecord& record = shared_->batches[batch];
  record.most_bytes = SharedRays::room_bytes();
  return &record;
}

void VariantRun::finish() { writing_.finish(); }

void VariantRun::leave_lines() {
  if (!shared_ || !shared_->is_wanted_later || seasons_.size() != 1) return;
  if (shared_->traced_by.empty()) shared_->traced_by = plan_.study.variant;
  shared_->lines = seasons_.front()->leave_lines();
  seasons_.clear();
}

/// Another process that failed may have removed the folder, which was empty until now; who cleans
/// up may remove what is written, and the folder a while later.
void VariantRun::write(const BatchWriter& writer, const std::string& path) const {
  constexpr int attempts = 10;
  constexpr std::chrono::milliseconds pause{100};
  for (int attempt = 1;; ++attempt) {
    folder_.make();
    try {
      return writer.write(path);
    } catch (const VanishedError&) {
      if (attempt == attempts) throw;
    }
    std::this_thread::sleep_for(pause);
  }
}

void VariantRun::report_work() const {
  const WorkDone& w = done_;
  std::string text = fmt::format("{}: {} patches\n", plan_.study.variant, mesh_->patch_count());
  text += rays_text("lines", w[Work::line_rays], w[Work::lines_s]);
  text += rays_text("direct sun", w[Work::direct_rays], w[Work::direct_s]);
  text += rays_text("mirrored sun", w[Work::mirror_rays], w[Work::mirror_s]);
  if (w[Work::mirror_beams] + w[Work::mirror_shots] > 0)
    text += fmt::format("  {:<14} {} beams by image directions, {} arrivals by shooting\n", "",
                        w[Work::mirror_beams], w[Work::mirror_shots]);
  text += rays_text("shooting", w[Work::shot_rays], w[Work::shoot_s]);
  text += rays_text("sensors", w[Work::sensor_rays], w[Work::sensors_s]);
  text += fmt::format("  {:<14} {:8.2f} s\n  {:<14} {:8.2f} s  peak memory {:.0f} MiB",
                      "sky and Jacobi", w[Work::solve_s], "realizations", w[Work::realizations_s],
                      peak_memory_bytes() / mib);
  progress_.say(text);
}

}  // namespace sunload
