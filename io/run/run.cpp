// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/run.h"

#include <filesystem>
#include <functional>
#include <iterator>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/base/output_target.h"
#include "io/plan/material_uses.h"
#include "io/plan/mesh_family.h"
#include "io/plan/planner.h"
#include "io/plan/study_measures.h"
#include "io/run/mpi_world.h"
#include "io/run/shared_rays.h"
#include "io/study/named_files.h"

namespace sunload {

namespace {

/// Every result has a file of its own, which links may lead to, and no folder is in its way.
void expect_own_files(const StudyWork& work, const std::vector<Study>& chosen, Problems& problems) {
  std::map<std::string, std::string> variant_of;
  for (const auto& study : chosen) {
    const std::string path = result_path(work.folder, study);
    std::error_code no_matter;
    const std::string file =
        std::filesystem::weakly_canonical(output_target(path).path, no_matter).string();
    const auto [other, is_first] = variant_of.try_emplace(file, study.variant);
    if (!is_first)
      problems.add({path}, "is the result of variant '" + other->second + "', too",
                   "a link leads to " + file, "remove the link, or choose another --output");
  }
}

/// The jobs that have work left. Every variant is read before the first one is worked on, and all
/// that is wrong is said at once.
std::list<VariantJob> planned_jobs(const StudyWork& work,
                                   void (VariantJob::*expect_allowed)() const) {
  std::list<VariantJob> jobs, finished;
  Problems problems;
  const std::vector<std::string> inputs = named_files(work.file);
  Planner planner;
  const MeshFamilies families(work.file, planner);
  MaterialUses uses(work.file, planner);
  const std::vector<Study> chosen = chosen_variants(work.file, work.options);
  expect_measured_somewhere(work.file, chosen, planner);
  expect_own_files(work, chosen, problems);
  for (const auto& study : chosen) {
    try {
      expect_not_read(result_path(work.folder, study), inputs);
      VariantPlan plan = planner.plan(study);
      expect_not_read(result_path(work.folder, study), plan.built.files);
      families.join(plan);
      uses.warn_of_idle(plan);
      VariantJob& job = jobs.emplace_back(work, std::move(plan));
      (job.*expect_allowed)();
      if (!job.is_finished()) continue;
      job.release();
      finished.splice(finished.end(), jobs, std::prev(jobs.end()));
    } catch (const InputError& error) {
      problems.add(error);
    }
  }
  problems.throw_if_any();
  for (const auto& job : finished) job.leave_finished();
  return jobs;
}

/// Null where this process is no rank, or has a shard of its own among them.
std::unique_ptr<MpiWorld> joined_world(const StudyFile& file, const Shard& shard) {
  if (shard.is_rank) return {};
  if (!shard.is_whole() && MpiWorld::is_launched())
    throw InputError({}, "--shard under MPI",
                     "ranks share the work by themselves, and all of them would have this shard",
                     "leave --shard away, start without mpirun, or use --shard auto");
  return MpiWorld::join(file.variants.size());
}

/// Ranks that disagree of what is left to do would wait for each other for ever.
void expect_same_jobs(const std::list<VariantJob>& jobs, const std::string& folder,
                      MpiWorld& world) {
  std::string names;
  for (const auto& job : jobs) names += job.name() + " " + job.content_hash() + "\n";
  if (world.all_have(std::hash<std::string>{}(names))) return;
  throw MachineError(folder +
                     ": ranks see different results there, or another state of the study: "
                     "a network file system may be slow to tell, another process finishes one just "
                     "now, or a file was changed meanwhile; start again");
}

OwnBatches run(VariantJob& job, MpiWorld* world) {
  // Another process may have finished it while this one had other variants in hand.
  if (!world && job.is_finished()) {
    job.leave_finished();
    return OwnBatches::done;
  }
  job.compute(world);
  if (world) world->wait_for_all();
  return world && !world->is_first() ? OwnBatches::done : job.merge_if_complete(world);
}

/// What vanishes while it is worked on is computed again, but not for ever. Ranks have taken their
/// numbers by then and leave it to the next run.
OwnBatches run_twice_at_most(VariantJob& job, MpiWorld* world) {
  const OwnBatches first = run(job, world);
  if (first == OwnBatches::done || world) return first;
  return run(job, world);
}

/// The results that a run of the whole study promises.
std::vector<std::string> results_not_there(const StudyWork& work) {
  std::vector<std::string> missing;
  if (!work.options.shard.is_whole()) return missing;
  std::error_code unreadable;
  for (const auto& study : chosen_variants(work.file, work.options))
    if (const auto path = result_path(work.folder, study);
        !std::filesystem::exists(path, unreadable))
      missing.push_back(path);
  return missing;
}

}  // namespace

int run_study(const std::string& path, const RunOptions& options) {
  use_threads(options);
  const StudyFile file = read_study(path);
  const auto world = joined_world(file, options.shard);
  Progress progress(options.progress, options.time_limit_min);
  if (speaks_for_all(world.get()))
    for (const auto& warning : file.warnings) progress.warn("warning: " + warning);
  SharedRays rays;
  const StudyWork work{file, options, results_folder(file, options), progress, rays};
  std::list<VariantJob> jobs = planned_jobs(work, &VariantJob::expect_may_run);
  if (world) expect_same_jobs(jobs, work.folder, *world);
  remove_left_over(work.folder, file.name);
  for (const auto& job : jobs) job.expect_room();
  for (auto& job : jobs) job.announce();
  bool is_complete = true;
  for (auto& job : jobs) {
    if (run_twice_at_most(job, world.get()) == OwnBatches::lost) is_complete = false;
    job.release();
  }
  for (const auto& job : jobs) job.remove_merged();
  if (world && !world->is_first()) return exit_code::done;
  for (const auto& result : results_not_there(work)) {
    progress.warn(result + " is not there; run the study again with --resume");
    is_complete = false;
  }
  return is_complete ? exit_code::done : exit_code::unfinished;
}

int merge_study(const std::string& path, const RunOptions& options, Merge merge) {
  use_threads(options);
  const StudyFile file = read_study(path);
  Progress progress(options.progress);
  SharedRays rays;
  const StudyWork work{file, options, results_folder(file, options), progress, rays};
  std::list<VariantJob> jobs = planned_jobs(work, &VariantJob::expect_may_merge);
  remove_left_over(work.folder, file.name);
  int code = exit_code::done;
  for (auto& job : jobs) {
    if (job.merge_what_is_there(merge) == exit_code::unfinished) code = exit_code::unfinished;
    job.release();
  }
  return code;
}

}  // namespace sunload
