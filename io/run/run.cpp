// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/run.h"

#include <iterator>
#include <list>
#include <memory>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/run/mpi_world.h"

namespace sunload {

namespace {

/// The jobs that have work left. Every variant is read before the first one is worked on, and all
/// that is wrong is said at once.
std::list<VariantJob> planned_jobs(const StudyWork& work,
                                   void (VariantJob::*expect_allowed)() const) {
  std::list<VariantJob> jobs, finished;
  Problems problems;
  for (const auto& study : chosen_variants(work.file, work.options)) {
    try {
      VariantJob& job = jobs.emplace_back(work, study);
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

std::unique_ptr<MpiWorld> joined_world(const StudyWork& work) {
  auto world = MpiWorld::join(work.file.variants.size());
  if (world && !work.options.shard.is_whole())
    throw InputError({}, "--shard under MPI", "ranks share the work by themselves",
                     "leave --shard away, or start without mpirun");
  return world;
}

void run(VariantJob& job, MpiWorld* world) {
  // Another process may have finished it while this one had other variants in hand.
  if (!world && job.is_finished()) return job.leave_finished();
  job.compute(world);
  if (world) world->wait_for_all();
  if (!world || world->is_first()) job.merge_if_complete();
}

}  // namespace

int run_study(const std::string& path, const RunOptions& options) {
  use_threads(options);
  const StudyFile file = read_study(path);
  Progress progress(options.progress, options.time_limit_min);
  for (const auto& warning : file.warnings) progress.warn("warning: " + warning);
  const StudyWork work{file, options, results_folder(file, options), progress};
  std::list<VariantJob> jobs = planned_jobs(work, &VariantJob::expect_may_run);
  const auto world = joined_world(work);
  remove_left_over(work.folder, file.name);
  for (const auto& job : jobs) job.expect_room();
  for (auto& job : jobs) {
    run(job, world.get());
    job.release();
  }
  for (const auto& job : jobs) job.remove_merged();
  return exit_code::done;
}

int merge_study(const std::string& path, const RunOptions& options, Merge merge) {
  use_threads(options);
  const StudyFile file = read_study(path);
  Progress progress(options.progress);
  const StudyWork work{file, options, results_folder(file, options), progress};
  int code = exit_code::done;
  for (auto& job : planned_jobs(work, &VariantJob::expect_may_merge)) {
    if (job.merge_what_is_there(merge) == exit_code::unfinished) code = exit_code::unfinished;
    job.release();
  }
  return code;
}

}  // namespace sunload
