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

/// What the jobs of a study have in common. It must outlive them.
struct StudyWork {
  const StudyFile& file;
  const RunOptions& options;
  std::string folder;  ///< of all results
  Progress& progress;
  SharedRays& rays;
};

/// Whether a result is written only when all batches are there, or also from those that are.
enum class Merge { complete, partial };

/// What became of the batches that this process had to compute. done: none of them is missing, or
/// the variant is merged; lost: some were there and are gone or damaged.
enum class OwnBatches { done, lost };

/// The work of one process (a whole run, a shard or a rank) on one variant. The mesh is made when
/// it is first needed, so that memory holds the mesh and the lines of one variant at a time, beside
/// what `SharedRays` keep.
class VariantJob {
 public:
  VariantJob(const StudyWork& work, VariantPlan plan);
  ~VariantJob();
  VariantJob(const VariantJob&) = delete;
  VariantJob& operator=(const VariantJob&) = delete;

  const std::string& name() const { return name_; }
  const std::string& content_hash() const { return folder_.content_hash(); }
  /// Throws InputError where a result exists that the options allow neither to replace nor to
  /// accept, or where other shards compute with another instruction set.
  void expect_may_run() const;
  /// Throws InputError where merging would replace a result without --overwrite, or where what is
  /// there was computed with another instruction set.
  void expect_may_merge() const;
  /// Whether there is nothing to do: a result of exactly these inputs exists, and the options do
  /// not ask to replace it.
  bool is_finished() const;
  /// Reports that there is nothing to do, and removes what is left in the work folder by a process
  /// that was killed after its merge.
  void leave_finished() const;

  /// Throws MachineError where memory or disk are too little: for the mesh, or before it is made
  /// for the fewest patches that it can have.
  void expect_room() const;
  /// Announces that the variant will be computed: others may share its rays.
  void announce();
  /// Computes those batches of this process that are missing. Throws Interrupted, MachineError.
  void compute(MpiWorld* world);
  /// Merges if all batches are there, else lists the batches that other processes owe. Where
  /// batches of this process were removed or damaged by somebody else, warns and returns `lost`.
  OwnBatches merge_if_complete(MpiWorld* world);
  /// Merges, or tells which batches are missing. Returns the exit code of the program.
  int merge_what_is_there(Merge merge);
  /// Removes the batches of a variant that was merged here with --overwrite. They are kept until
  /// all variants are merged, so that the same command, given again, finds them.
  void remove_merged() const;
  /// Frees mesh, scene and light, and the shared rays that no other variant waits for. The job can
  /// do nothing afterwards but `remove_merged`.
  void release();

 private:
  /// How one attempt to merge ended.
  enum class Merging { done, incomplete, by_another };
  using ResultStamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;

  bool is_overwritten() const { return work_.options.existing == Existing::overwrite; }
  bool is_merged() const;
  ResultStamp stamp() const;
  bool has_result() const;
  OwnBatches tell_missing(const std::vector<std::size_t>& missing, const UnitQueue& own) const;
  /// Work of the very same study on a processor of another instruction set.
  struct OfOtherIsa {
    std::string folder, isa;
    std::string both_have;  ///< the instruction set that this processor and that one have
  };
  std::optional<OfOtherIsa> batches_of_other_isa() const;
  void refuse_other_isa() const;
  void refuse_other_state(const char* hint) const;
  UnitQueue own_units(MpiWorld* world) const;
  void begin(const UnitQueue& units, const MpiWorld* world);
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
  std::string rays_key_;      ///< empty until `announce`
  VariantMesh mesh_;          ///< empty until it is needed
  ResultStamp stamp_before_;  ///< of the result that was there when the work began
  bool was_merged_ = false;
};

}  // namespace sunload
