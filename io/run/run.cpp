// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>

#include "io/base/machine.h"
#include "io/base/merge_lock.h"
#include "io/plan/expected_error.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "io/plan/work_estimate.h"
#include "io/result/energy_text.h"
#include "io/result/reader.h"
#include "io/run/leftovers.h"
#include "io/run/merge.h"
#include "io/run/mpi_world.h"
#include "io/run/unit_queue.h"
#include "io/run/variant_run.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

std::string folder_of(const StudyFile& file, const RunOptions& options) {
  return options.output.empty() ? file.variants.front().output.folder : options.output;
}

/// What is to be done with a variant whose result may be there already.
enum class Todo { compute, nothing };

Todo check_existing(const std::string& folder, const VariantPlan& plan, const RunOptions& options) {
  const std::string path = result_path(folder, plan.study);
  if (!fs::exists(path) || options.existing == Existing::overwrite) return Todo::compute;
  const std::string hash = ResultReader(path).text_attribute("study_sha256");
  if (hash != plan.content_hash)
    throw InputError({path}, "is the result of another state of the study",
                     "its content hash differs", "use --overwrite to replace it, or --output");
  if (options.existing == Existing::resume) {
    remove_finished_work(folder, plan.study, hash);
    return Todo::nothing;
  }
  throw InputError({path}, "is there already, of this very study", "nothing is left to compute",
                   "use --resume to accept it, or --overwrite to compute it again");
}

/// Size of the batches and lines that are there.
double bytes_there(const std::string& folder, const VariantPlan& plan) {
  double bytes = 0;
  const auto add = [&](const std::string& path) {
    std::error_code not_there;
    const auto size = fs::file_size(path, not_there);
    if (!not_there) bytes += static_cast<double>(size);
  };
  for (std::size_t b = 0; b < plan.batches(); ++b) add(batch_path(folder, plan, b));
  add(prepared_path(folder, plan));
  return bytes;
}

/// Refuses work that cannot fit before it starts; `there`: bytes of finished work.
void check_limits(const std::string& folder, const WorkEstimate& work, double there) {
  if (const double left = available_memory_bytes(); work.memory_bytes > left)
    throw MachineError(fmt::format(
        "too little memory: about {:.1f} GiB are needed for {} patches, {:.1f} GiB are available; "
        "use a larger mesh.max_edge_m, fewer lines_per_patch or a smaller batch_suns{}",
        work.memory_bytes / gib, work.patches, left / gib,
        work.samples > 0 ? ", and a larger power_per_sample_w or auto" : ""));
  if (const double left = free_disk_bytes(folder); work.disk_bytes - there > left)
    throw MachineError(fmt::format(
        "too little disk space for {}: about {:.1f} GiB are needed, {:.1f} GiB are free; "
        "choose another folder with --output, or fewer output.series",
        folder, (work.disk_bytes - there) / gib, left / gib));
}

void print_warnings(Progress& progress, const VariantPlan& plan) {
  for (const auto& list : {plan.built.warnings, plan.light.notes})
    for (const auto& line : list) progress.say(plan.study.variant + ": warning: " + line);
}

bool result_has_hash(const std::string& path, const std::string& hash) {
  return fs::exists(path) && ResultReader(path).text_attribute("study_sha256") == hash;
}

std::string list_text(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const auto n : numbers) text += " " + std::to_string(n);
  return text;
}

/// Shards on machines of different instruction sets would not fit together.
void refuse_other_isa(const std::string& folder, const VariantPlan& plan,
                      const RunOptions& options) {
  if (options.shard.is_whole()) return;
  // From small to large: both processors have what comes first.
  bool is_smaller = true;
  for (const std::string isa : {"sse4.2", "avx2", "avx512"}) {
    if (isa == plan.isa) {
      is_smaller = false;
      continue;
    }
    VariantPlan other;
    other.study = plan.study;
    other.content_hash = hash_with_isa(plan, isa);
    if (fs::exists(work_folder(folder, other)))
      throw InputError({work_folder(folder, other)},
                       "holds batches of this study computed with " + isa,
                       "this processor would use " + plan.isa + ", and bits would differ",
                       "write solver: {isa: " + (is_smaller ? isa : plan.isa) +
                           "} into the study, or run on equal processors");
  }
}

enum class Merging { done, was_done, by_another };

/// Merges a variant of which every batch is there, unless another process does
/// or did meanwhile; `say` gets the warnings.
Merging merge_once(const std::string& folder, const StudyFile& file, const VariantPlan& plan,
                   const Hierarchy& mesh, const std::string& result, const RunOptions& options,
                   const std::function<void(const std::string&)>& say) {
  {
    const MergeLock lock(merge_lock_path(folder, plan.study));
    if (!lock.is_held()) return Merging::by_another;
    if (!batches_not_there(folder, plan).empty()) return Merging::was_done;
    if (options.batches == Batches::keep) keep_work(folder, plan);
    for (const auto& warning : merge_variant(folder, plan, file, mesh, result))
      say(plan.study.variant + ": warning: " + warning);
    if (options.batches == Batches::remove) remove_work(folder, plan);
  }
  remove_empty_folders(folder, plan);
  return Merging::done;
}

void use_threads(const RunOptions& options) {
  set_thread_count(options.threads > 0 ? options.threads : permitted_processors());
}

}  // namespace

std::vector<Study> chosen_variants(const StudyFile& file, const RunOptions& options) {
  if (options.variants.empty()) return file.variants;
  std::vector<Study> chosen;
  Problems problems;
  for (const auto& name : options.variants) {
    const auto found = std::find_if(file.variants.begin(), file.variants.end(),
                                    [&](const Study& s) { return s.variant == name; });
    if (found != file.variants.end()) {
      chosen.push_back(*found);
      continue;
    }
    std::string names;
    for (const auto& v : file.variants) names += (names.empty() ? "" : ", ") + v.variant;
    problems.add({file.path}, "no variant '" + name + "'", {}, "the study has: " + names);
  }
  problems.throw_if_any();
  return chosen;
}

namespace {

/// All units of a study on behalf of one process: a whole run, a shard or a rank.
class StudyRun {
 public:
  StudyRun(const StudyFile& file, const RunOptions& options)
      : file_(file),
        options_(options),
        folder_(folder_of(file, options)),
        progress_(options.progress, options.time_limit_min) {}

  int run() {
    for (const auto& warning : file_.warnings) progress_.say("warning: " + warning);
    make_plans();
    world_ = MpiWorld::join(file_.variants.size());
    if (world_ && !options_.shard.is_whole())
      throw InputError({}, "--shard under MPI", "ranks share the work by themselves",
                       "leave --shard away, or start without mpirun");
    remove_left_over(folder_, file_.name);
    for (auto& place : plans_) split(place);
    if (!plans_.empty()) make_writable_folder(folder_ + "/" + file_.name);
    compute();
    if (world_) world_->wait_for_all();
    if (!world_ || world_->is_first())
      for (auto& place : plans_) merge_if_complete(place);
    return exit_code::done;
  }

 private:
  /// A variant that has work, and its place in the study.
  struct Place {
    std::size_t variant;
    VariantPlan plan;
    std::shared_ptr<const Hierarchy> mesh;
  };

  /// Every variant is checked before the first one is computed.
  void make_plans() {
    Problems problems;
    for (const auto& study : chosen_variants(file_, options_)) {
      try {
        VariantPlan plan = make_plan(study);
        refuse_other_isa(folder_, plan, options_);
        if (check_existing(folder_, plan, options_) == Todo::nothing)
          progress_.say(study.variant + ": finished already, nothing to do");
        else
          plans_.push_back({place_of(study), std::move(plan), nullptr});
      } catch (const InputError& error) {
        problems.add(error);
      }
    }
    problems.throw_if_any();
  }

  std::size_t place_of(const Study& study) const {
    const auto found = std::find_if(file_.variants.begin(), file_.variants.end(),
                                    [&](const Study& s) { return s.variant == study.variant; });
    return static_cast<std::size_t>(found - file_.variants.begin());
  }

  UnitQueue units_of(const Place& place) const {
    return {place.variant, place.plan.batches(), options_.shard, world_.get()};
  }

  /// Sun positions that may fall to this process.
  std::size_t own_suns(const Place& place) const {
    const UnitQueue units = units_of(place);
    std::size_t suns = 0;
    for (std::size_t b = 0; b < place.plan.batches(); ++b)
      if (units.may_give(b)) suns += sun_count(place.plan, b);
    return suns;
  }

  /// Makes the mesh; work that cannot fit is refused before anything is written.
  void split(Place& place) {
    const VariantPlan& plan = place.plan;
    const double there = bytes_there(folder_, plan);
    const std::size_t least = least_patch_count(plan.built.scene, split_rules(plan.study));
    check_limits(folder_, estimate_work(plan, least), there);
    progress_.begin_variant(plan.study.variant, own_suns(place));
    const VariantMesh made = make_mesh(plan, progress_);
    place.mesh = made.mesh;
    if (const auto text = refine_text(made.report, plan.study); !text.empty())
      progress_.say(plan.study.variant + ": " + text);
    check_limits(folder_, estimate_work(plan, place.mesh->patch_count()), there);
    for (const auto& line : expected_error_warnings(plan, *place.mesh))
      progress_.say(plan.study.variant + ": warning: " + line);
  }

  void compute() {
    try {
      for (auto& place : plans_) compute(place);
    } catch (...) {
      for (const auto& place : plans_) remove_empty_folders(folder_, place.plan);
      throw;
    }
  }

  void compute(Place& place) {
    const VariantPlan& plan = place.plan;
    UnitQueue units = units_of(place);
    progress_.begin_variant(plan.study.variant, own_suns(place));
    print_warnings(progress_, plan);
    VariantRun run(folder_, plan, place.mesh, progress_);
    run.compute(units, world_.get());
  }

  void merge_if_complete(Place& place) {
    const VariantPlan& plan = place.plan;
    const std::string result = result_path(folder_, plan.study);
    const auto missing = batches_not_there(folder_, plan);
    if (!missing.empty()) {
      if (result_has_hash(result, plan.content_hash)) {
        // Another process merged it; what this one computed besides is not wanted.
        if (options_.existing != Existing::overwrite)
          remove_finished_work(folder_, plan.study, plan.content_hash);
        return;
      }
      progress_.say(fmt::format("{}: {} of {} batches are still owed by other shards:{}",
                                plan.study.variant, missing.size(), plan.batches(),
                                list_text(missing)));
      return;
    }
    if (!merged(place, result)) return;
    progress_.say(plan.study.variant + ": wrote " + result + "\n" +
                  energy_text(ResultReader(result)));
  }

  /// True where this process has merged, false where another one does, or where
  /// a batch of another shard turned out to be damaged.
  bool merged(const Place& place, const std::string& result) {
    const VariantPlan& plan = place.plan;
    try {
      const Merging outcome = merge_once(folder_, file_, plan, *place.mesh, result, options_,
                                         [&](const std::string& text) { progress_.say(text); });
      if (outcome == Merging::by_another)
        progress_.say(plan.study.variant + ": another process is merging");
      return outcome == Merging::done;
    } catch (const InputError&) {
      const auto damaged = missing_batches(folder_, plan);
      if (damaged.numbers.empty()) throw;
      for (const auto& reason : damaged.reasons) progress_.say("warning: " + reason);
      progress_.say(fmt::format("{}: batches{} must be computed again: run the study with --resume",
                                plan.study.variant, list_text(damaged.numbers)));
      return false;
    }
  }

  const StudyFile& file_;
  const RunOptions& options_;
  std::string folder_;
  Progress progress_;
  std::unique_ptr<MpiWorld> world_;
  std::vector<Place> plans_;
};

}  // namespace

int run_study(const std::string& path, const RunOptions& options) {
  use_threads(options);
  const StudyFile file = read_study(path);
  return StudyRun(file, options).run();
}

int merge_study(const std::string& path, const RunOptions& options, Merge merge) {
  use_threads(options);
  const StudyFile file = read_study(path);
  const std::string folder = folder_of(file, options);
  int code = exit_code::done;
  for (const auto& study : chosen_variants(file, options)) {
    const VariantPlan plan = make_plan(study);
    const std::string result = result_path(folder, plan.study);
    if (result_has_hash(result, plan.content_hash)) {
      fmt::print(stderr, "{}: merged already, nothing to do\n", study.variant);
      if (options.existing != Existing::overwrite)
        remove_finished_work(folder, plan.study, plan.content_hash);
      continue;
    }
    const auto missing = missing_batches(folder, plan);
    for (const auto& reason : missing.reasons) fmt::print(stderr, "{}\n", reason);
    const bool something_is_there = missing.numbers.size() < plan.batches();
    if (merge == Merge::partial && something_is_there && !missing.numbers.empty()) {
      const std::string partial = work_folder(folder, plan) + "/partial.h5";
      Watch nobody;
      merge_variant(folder, plan, file, *make_mesh(plan, nobody).mesh, partial, missing.numbers);
      fmt::print(stderr, "{}: wrote {} of {} batches to {}\n", study.variant,
                 plan.batches() - missing.numbers.size(), plan.batches(), partial);
      continue;
    }
    if (!missing.numbers.empty()) {
      fmt::print(stderr, "{}: {} of {} batches are missing:{}; run the study again with --resume\n",
                 study.variant, missing.numbers.size(), plan.batches(), list_text(missing.numbers));
      code = exit_code::unfinished;
      continue;
    }
    if (fs::exists(result) && options.existing != Existing::overwrite)
      throw InputError({result}, "is the result of another state of the study",
                       "its content hash differs", "use --overwrite to replace it");
    Watch nobody;
    const auto mesh = make_mesh(plan, nobody).mesh;
    const auto say = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
    if (merge_once(folder, file, plan, *mesh, result, options, say) == Merging::by_another) {
      fmt::print(stderr, "{}: another process is merging\n", study.variant);
      continue;
    }
    fmt::print(stderr, "{}: wrote {}\n", study.variant, result);
  }
  return code;
}

}  // namespace sunload
