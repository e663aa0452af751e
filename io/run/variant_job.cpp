// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/variant_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

#include "io/base/exit_code.h"
#include "io/base/merge_lock.h"
#include "io/plan/content_hash.h"
#include "io/plan/expected_error.h"
#include "io/plan/room.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/work_estimate.h"
#include "io/result/energy_text.h"
#include "io/result/reader.h"
#include "io/run/merge.h"
#include "io/run/mpi_world.h"
#include "io/run/shared_rays.h"
#include "io/run/variant_run.h"

namespace sunload {

namespace {

/// Refuses work that cannot fit; `there`: bytes of finished work.
void expect_room_for(const WorkEstimate& work, PatchesAre patches, const std::string& folder,
                     double there) {
  for (const auto& problem : {memory_problem(work, patches), disk_problem(work, folder, there)})
    if (!problem.empty()) throw MachineError(problem);
}

/// Whether a result is of this very study, computed with another instruction set.
bool is_of_other_isa(const ResultReader& result, const ResultState& is, const VariantPlan& plan) {
  const std::string by = result.text_attribute("isa");
  return by != plan.isa && is.content_hash == hash_with_isa(plan, by);
}

InputError of_another_state(const WorkFolder& folder, const ResultState& is,
                            const VariantPlan& plan, const char* hint) {
  const ResultReader result(folder.result());
  if (result.number_attribute("numerics_version") != numerics_version)
    return {{folder.result()},
            "is the result of another version of the program",
            "by " + result.text_attribute("source") + ", whose numbers are others",
            hint};
  if (is_of_other_isa(result, is, plan)) {
    const std::string by = result.text_attribute("isa");
    return {{folder.result()},
            "is the result of another instruction set",
            "computed with " + by + ", this processor would use " + plan.isa,
            "write solver: {isa: " + by + "} into the study to accept it; " + hint};
  }
  const ResultState wanted = folder.wanted_state();
  const char* why =
      is.content_hash != wanted.content_hash
          ? "its content hash differs: the study, a file, or a variant that shares its mesh is "
            "another"
      : is.measures_hash != wanted.measures_hash ? "its measures or selections differ"
                                                 : "it lacks series that the study stores";
  return {{folder.result()}, "is the result of another state of the study", why, hint};
}

std::string list_text(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const auto n : numbers) text += " " + std::to_string(n);
  return text;
}

/// Place of a variant in the study, which decides the numbers of its units.
std::size_t place_of(const std::string& variant, const StudyFile& file) {
  const auto found = std::find_if(file.variants.begin(), file.variants.end(),
                                  [&](const Study& s) { return s.variant == variant; });
  return static_cast<std::size_t>(found - file.variants.begin());
}

std::size_t suns_before(const VariantPlan& plan, std::size_t batch) {
  std::size_t suns = 0;
  for (std::size_t b = 0; b < batch; ++b) suns += sun_count(plan, b);
  return suns;
}

}  // namespace

VariantJob::VariantJob(const StudyWork& work, VariantPlan plan)
    : work_(work),
      name_(plan.study.variant),
      plan_(std::move(plan)),
      folder_(work.folder, plan_.study, plan_.content_hash, plan_.batches()),
      stamp_before_(stamp()) {}

VariantJob::~VariantJob() = default;

void VariantJob::expect_may_run() const {
  refuse_other_isa();
  if (is_overwritten() || !folder_.state()) return;
  refuse_other_state("use --overwrite to replace it, or --output");
  // Of a shard's variants others may be finished by other shards before it comes.
  if (work_.options.existing == Existing::refuse && work_.options.shard.is_whole())
    throw InputError({folder_.result()}, "is there already, of this very study",
                     "nothing of it is left to compute",
                     "use --resume to accept it, or --overwrite to compute it again");
}

void VariantJob::expect_may_merge() const {
  const auto lacking = folder_.batches_not_there();
  if (lacking.empty()) return refuse_other_state("use --overwrite to replace it");
  // Nothing to merge, and a run with --resume would be refused for what lies there.
  if (lacking.size() == plan_.batches())
    refuse_other_state("run the study with --overwrite to replace it, or --output");
  if (is_merged()) return;
  if (const auto state = folder_.state();
      state && is_of_other_isa(ResultReader(folder_.result()), *state, plan_))
    refuse_other_state("use --overwrite to replace it");
  if (const auto other = batches_of_other_isa())
    throw InputError({other->folder}, "holds batches of this study computed with " + other->isa,
                     "of " + plan_.isa + ", which this processor uses, some are missing",
                     "write solver: {isa: " + other->isa + "} into the study to merge those");
}

/// Of the study as it was, or as somebody has changed it meanwhile.
void VariantJob::refuse_other_state(const char* hint) const {
  if (is_overwritten()) return;
  const auto state = folder_.state();
  if (state && state != folder_.wanted_state())
    throw of_another_state(folder_, *state, plan_, hint);
}

std::optional<VariantJob::OfOtherIsa> VariantJob::batches_of_other_isa() const {
  // From small to large: both processors have what comes first.
  bool is_smaller = true;
  for (const std::string isa : {"sse4.2", "avx2", "avx512"}) {
    if (isa == plan_.isa) {
      is_smaller = false;
      continue;
    }
    if (const WorkFolder other = folder_.with_hash(hash_with_isa(plan_, isa)); other.is_there())
      return OfOtherIsa{other.path(), isa, is_smaller ? isa : plan_.isa};
  }
  return std::nullopt;
}

/// Shards on machines of different instruction sets would not fit together.
void VariantJob::refuse_other_isa() const {
  if (work_.options.shard.is_whole()) return;
  if (const auto other = batches_of_other_isa())
    throw InputError(
        {other->folder}, "holds batches of this study computed with " + other->isa,
        "this processor would use " + plan_.isa + ", and bits would differ",
        "write solver: {isa: " + other->both_have + "} into the study, or run on equal processors");
}

/// A result that cannot be read is no obstacle to --overwrite.
bool VariantJob::is_merged() const {
  try {
    return folder_.state() == folder_.wanted_state();
  } catch (const InputError&) {
    if (is_overwritten()) return false;
    throw;
  }
}

/// Tells a result that is to be overwritten from the one that has replaced it.
VariantJob::ResultStamp VariantJob::stamp() const {
  std::error_code not_there;
  const auto written = std::filesystem::last_write_time(folder_.result(), not_there);
  if (not_there) return {};
  return std::pair(written, std::filesystem::file_size(folder_.result(), not_there));
}

/// Whether the result that this run is for is there, whoever has written it.
bool VariantJob::has_result() const {
  return is_merged() && (!is_overwritten() || was_merged_ || stamp() != stamp_before_);
}

bool VariantJob::is_finished() const { return !is_overwritten() && is_merged(); }

void VariantJob::leave_finished() const {
  say("finished already, nothing to do");
  folder_.remove_finished_work();
}

void VariantJob::expect_room() const {
  const std::size_t patches = mesh_.mesh
                                  ? mesh_.mesh->patch_count()
                                  : least_patch_count(plan_.built.scene, split_rules(plan_.study));
  expect_room_for(estimate_work(plan_, patches),
                  mesh_.mesh ? PatchesAre::counted : PatchesAre::at_least, work_.folder,
                  folder_.bytes_there());
}

UnitQueue VariantJob::own_units(MpiWorld* world) const {
  return {place_of(name_, work_.file), plan_.batches(), work_.options.shard, world};
}

void VariantJob::begin(const UnitQueue& units, const MpiWorld* world) {
  std::size_t suns = 0;
  for (std::size_t b = 0; b < plan_.batches(); ++b)
    if (units.may_give(b)) suns += sun_count(plan_, b);
  work_.progress.begin_variant(name_, suns);
  if (!speaks_for_all(world)) return;
  if (const auto other = batches_of_other_isa())
    warn(
        fmt::format("{} holds batches computed with {}, and is not used: this processor uses {}, "
                    "and bits would differ; solver: {{isa: {}}} in the study would go on from it",
                    other->folder, other->isa, plan_.isa, other->isa));
  for (const auto& list : {plan_.built.warnings, plan_.light.notes})
    for (const auto& line : list) warn(line);
}

void VariantJob::make_mesh() {
  if (!mesh_.mesh) mesh_ = sunload::make_mesh(plan_, work_.progress);
}

/// Mesh and lines; what cannot fit is refused before anything is written.
std::unique_ptr<VariantRun> VariantJob::start(MpiWorld* world) {
  make_mesh();
  if (const auto text = refine_text(mesh_.report, plan_.study); !text.empty()) say(text);
  expect_room();
  if (speaks_for_all(world))
    for (const auto& line : expected_error_warnings(plan_, *mesh_.mesh)) warn(line);
  folder_.make();
  auto run = std::make_unique<VariantRun>(folder_, plan_, mesh_.mesh, work_.progress,
                                          work_.rays.of(rays_key_));
  run->prepare(world);
  return run;
}

bool VariantJob::is_there(std::size_t batch) const {
  const BatchCheck found = folder_.check(batch);
  if (found.exists && !found.valid)
    work_.progress.warn("warning: " + found.reason + "; it is computed again");
  return found.valid;
}

void VariantJob::compute(MpiWorld* world) {
  UnitQueue units = own_units(world);
  begin(units, world);
  try {
    compute_missing(units, world);
  } catch (...) {
    folder_.remove_empty_folders();
    throw;
  }
}

void VariantJob::compute_missing(UnitQueue& units, MpiWorld* world) {
  std::unique_ptr<VariantRun> run;
  // Ranks meet where the first of them traces the lines, before any takes a batch.
  if (world && world->any(!folder_.batches_not_there().empty())) run = start(world);
  std::size_t suns_behind = 0;
  for (auto batch = units.next(); batch; batch = units.next()) {
    const std::size_t suns = sun_count(plan_, *batch);
    if (!is_there(*batch)) {
      // Of ranks that have not met only this one found its batch damaged.
      if (!run) run = start(nullptr);
      if (world) suns_behind = suns_before(plan_, *batch);
      work_.progress.begin_batch(suns_behind, suns);
      run->compute(*batch);
    }
    suns_behind += suns;
  }
  if (!run) return;
  run->finish();
  run->report_work();
  run->leave_lines();
}

OwnBatches VariantJob::merge_if_complete(MpiWorld* world) {
  std::vector<std::size_t> missing = folder_.batches_not_there();
  while (missing.empty()) {
    const Merging merging = merge();
    if (merging == Merging::done) return OwnBatches::done;
    if (merging == Merging::by_another) {
      say("another process is merging");
      if (!work_.options.shard.is_whole()) return OwnBatches::done;
      wait_for_other_merge();
      missing = folder_.batches_not_there();
    } else {
      missing = folder_.missing_batches().numbers;
      break;
    }
  }
  if (!has_result()) return tell_missing(missing, own_units(world));
  // Another process merged it; what this one computed besides is not wanted.
  folder_.remove_finished_work();
  return OwnBatches::done;
}

/// Somebody removes batches where they lie too long or take too much room.
OwnBatches VariantJob::tell_missing(const std::vector<std::size_t>& missing,
                                    const UnitQueue& own) const {
  std::vector<std::size_t> lost;
  std::copy_if(missing.begin(), missing.end(), std::back_inserter(lost),
               [&](std::size_t batch) { return own.may_give(batch); });
  if (lost.empty()) {
    say(fmt::format("{} of {} batches are still owed by other shards:{}", missing.size(),
                    plan_.batches(), list_text(missing)));
    return OwnBatches::done;
  }
  warn(
      fmt::format("{} of {} batches were there and are gone or damaged:{}; somebody else writes "
                  "in {}",
                  lost.size(), plan_.batches(), list_text(lost), folder_.path()));
  return OwnBatches::lost;
}

/// A run of the whole study that ends well has its results: it does not leave them to another.
void VariantJob::wait_for_other_merge() const {
  constexpr std::chrono::milliseconds pause{100};
  while (!MergeLock(folder_.merge_lock()).is_held()) {
    if (work_.progress.stop_requested()) throw Interrupted("stopped while another process merges");
    std::this_thread::sleep_for(pause);
  }
}

int VariantJob::merge_what_is_there(Merge merge) {
  if (is_merged()) {
    say("merged already, nothing to do");
    if (!is_overwritten()) folder_.remove_finished_work();
    return exit_code::done;
  }
  work_.progress.begin_variant(name_, 0);
  const MissingBatches missing = folder_.missing_batches();
  for (const auto& reason : missing.reasons) work_.progress.warn("warning: " + reason);
  if (missing.numbers.empty()) {
    if (merge_if_complete(nullptr) == OwnBatches::lost) return exit_code::unfinished;
    remove_merged();
    return exit_code::done;
  }
  if (merge == Merge::partial && missing.numbers.size() < plan_.batches()) {
    merge_without(missing);
    return exit_code::done;
  }
  const auto state = folder_.state();
  const bool is_of_other_state = state && state != folder_.wanted_state();
  say(fmt::format("{} of {} batches are missing:{}; run the study again with {}{}",
                  missing.numbers.size(), plan_.batches(), list_text(missing.numbers),
                  is_of_other_state ? "--overwrite" : "--resume",
                  folder_.has_others() ? " (there is work of another state of the study, too: was "
                                         "it edited meanwhile?)"
                                       : ""));
  return exit_code::unfinished;
}

/// Says what was written. Batches, of other shards or one's own, may turn out to be damaged, or
/// vanish while they are read.
VariantJob::Merging VariantJob::merge() {
  try {
    const Merging merging = merge_once();
    if (merging == Merging::done)
      say("wrote " + folder_.result() + "\n" + energy_text(ResultReader(folder_.result())));
    return merging;
  } catch (const InputError&) {
    if (has_result()) return Merging::by_another;
    const MissingBatches damaged = folder_.missing_batches();
    if (damaged.numbers.empty()) throw;
    for (const auto& reason : damaged.reasons) work_.progress.warn("warning: " + reason);
    if (!damaged.reasons.empty())
      work_.progress.warn(
          fmt::format("{}: batches{} must be computed again: run the study with --resume", name_,
                      list_text(damaged.numbers)));
    return Merging::incomplete;
  } catch (const MachineError&) {
    if (has_result()) return Merging::by_another;
    if (!batches_vanish()) throw;
    return Merging::incomplete;
  }
}

/// The folder that the result is written into may vanish, and all batches with it, perhaps a
/// little later than what was written.
bool VariantJob::batches_vanish() const {
  constexpr int looks = 10;
  constexpr std::chrono::milliseconds pause{100};
  for (int look = 0; look < looks; ++look) {
    if (!folder_.batches_not_there().empty()) return true;
    std::this_thread::sleep_for(pause);
  }
  return false;
}

/// Merges unless another process does or did meanwhile.
VariantJob::Merging VariantJob::merge_once() {
  {
    const MergeLock lock(folder_.merge_lock());
    if (!lock.is_held()) return Merging::by_another;
    if (!lock.problem().empty())
      warn(fmt::format("the file system has no locks ({}): let no other process merge meanwhile",
                       lock.problem()));
    if (!folder_.batches_not_there().empty()) return Merging::incomplete;
    refuse_other_state("it was written meanwhile: use --overwrite to replace it, or --output");
    make_mesh();
    if (work_.options.batches == Batches::keep) folder_.keep_work();
    for (const auto& warning :
         merge_variant(folder_, plan_, work_.file, *mesh_.mesh, folder_.result()))
      warn(warning);
    was_merged_ = true;
    if (work_.options.batches == Batches::remove && !is_overwritten()) folder_.remove_work();
  }
  folder_.remove_empty_folders();
  return Merging::done;
}

void VariantJob::merge_without(const MissingBatches& missing) {
  make_mesh();
  for (const auto& warning :
       merge_variant(folder_, plan_, work_.file, *mesh_.mesh, folder_.partial(), missing.numbers))
    warn(warning);
  say(fmt::format("wrote {} of {} batches to {}", plan_.batches() - missing.numbers.size(),
                  plan_.batches(), folder_.partial()));
}

void VariantJob::remove_merged() const {
  if (was_merged_ && work_.options.batches == Batches::remove) folder_.remove_finished_work();
}

void VariantJob::announce() {
  rays_key_ = rays_key(plan_);
  work_.rays.expect(rays_key_);
}

void VariantJob::release() {
  work_.rays.release(rays_key_);
  mesh_ = {};
  plan_.built = {};
  plan_.family.reset();
  plan_.light = {};
}

void VariantJob::say(const std::string& text) const { work_.progress.say(name_ + ": " + text); }

void VariantJob::warn(const std::string& text) const {
  work_.progress.warn(name_ + ": warning: " + text);
}

}  // namespace sunload
