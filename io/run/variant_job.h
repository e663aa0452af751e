// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The work on one variant: mesh, batches, merge.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "io/run/options.h"
#include "io/run/progress.h"
#include "io/run/unit_queue.h"
#include "io/run/work_folder.h"

namespace sunload {

class SharedRays;
class VariantRun;

/// What the jobs of a study have in common; must outlive them.
struct StudyWork {
  const StudyFile& file;
  const RunOptions& options;
  std::string folder;  ///< of all results
  Progress& progress;
  SharedRays& rays;
};

enum class Merge { complete, partial };

/// Of what a process has computed: still there when it is to be merged, or merged; or vanished.
enum class OwnBatches { done, lost };

/// One variant on behalf of one process: a whole run, a shard or a rank. The mesh is made when it
/// is first needed, so that memory holds the mesh and the lines of one variant at a time
/// (beside what `SharedRays` keep).
class VariantJob {
 public:
  VariantJob(const StudyWork& work, VariantPlan plan);
  ~VariantJob();
  VariantJob(const VariantJob&) = delete;
  VariantJob& operator=(const VariantJob&) = delete;

  const std::string& name() const { return name_; }
  /// Throws InputError where a result is there that the options do not let replace or accept, or
  /// where other shards compute with another instruction set.
  void expect_may_run() const;
  /// Throws InputError where merging would replace a result without --overwrite.
  void expect_may_merge() const;
  /// Whether nothing is to be done: the result of this very state is there and need not be
  /// replaced.
  bool is_finished() const;
  /// Says so, and removes work that a process left which was killed at the very end.
  void leave_finished() const;

  /// Throws MachineError where memory or disk are too little: for the mesh, or before it is made
  /// for the fewest patches that it can have.
  void expect_room() const;
  /// That it will be computed: others may share its rays.
  void announce();
  /// Computes what is missing of this process' own batches. Throws Interrupted, MachineError.
  void compute(MpiWorld* world);
  /// Merges where all batches are there; otherwise lists those that others owe. Batches of this
  /// process that somebody else has removed or damaged meanwhile are lost, which is warned of.
  OwnBatches merge_if_complete(MpiWorld* world);
  /// Merges, or says why not; returns the exit code.
  int merge_what_is_there(Merge merge);
  /// Removes the batches of what was merged here, where --overwrite has kept them: until all
  /// variants are merged, the same command may come again and shall find them.
  void remove_merged() const;
  /// Gives the memory back; the job can do no more but `remove_merged`.
  void release();

 private:
  enum class Merging { done, incomplete, by_another };
  using ResultStamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;

  bool is_overwritten() const { return work_.options.existing == Existing::overwrite; }
  bool is_merged() const;
  ResultStamp stamp() const;
  bool has_result() const;
  OwnBatches tell_missing(const std::vector<std::size_t>& missing, const UnitQueue& own) const;
  void refuse_other_isa() const;
  UnitQueue own_units(MpiWorld* world) const;
  void begin(const UnitQueue& units);
  void make_mesh();
  std::unique_ptr<VariantRun> start(MpiWorld* world);
  void compute_missing(UnitQueue& units, MpiWorld* world);
  bool is_there(std::size_t batch) const;
  Merging merge();
  Merging merge_once();
  bool batches_vanish() const;
  void wait_for_other_merge() const;
  void merge_without(const MissingBatches& missing);
  void say(const std::string& text) const;
  void warn(const std::string& text) const;

  const StudyWork& work_;
  std::string name_;
  VariantPlan plan_;
  WorkFolder folder_;
  std::string rays_key_;      ///< empty until it is known that it will be computed
  VariantMesh mesh_;          ///< empty until it is needed
  ResultStamp stamp_before_;  ///< of the result that was there when the work began
  bool was_merged_ = false;
};

}  // namespace sunload
