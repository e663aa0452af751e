// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes batches of one variant and writes them. Lines come first, once for each season with
/// materials of its own; then any batch may be computed.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/batch/batch_tally.h"
#include "io/batch/prepared_file.h"
#include "io/plan/variant_plan.h"
#include "io/run/progress.h"
#include "io/run/shared_rays.h"
#include "io/run/traced_season.h"
#include "io/run/work_folder.h"
#include "io/run/writing_behind.h"
#include "solver/solver.h"

namespace sunload {

class MpiWorld;

/// One process at work on one variant: call `prepare`, then `compute` for each batch, then
/// `finish`.
class VariantRun {
 public:
  /// `shared`: rays that this variant has in common with others, or null. All arguments but `mesh`
  /// must outlive it.
  VariantRun(const WorkFolder& folder, const VariantPlan& plan,
             std::shared_ptr<const Hierarchy> mesh, Progress& progress, TracedRays* shared);
  /// Ends when the batch in hand is written, and warns where that fails.
  ~VariantRun();
  VariantRun(const VariantRun&) = delete;
  VariantRun& operator=(const VariantRun&) = delete;

  /// Traces the lines, or reads them. If more than one batch is missing, even if other processes
  /// will compute them, the lines are kept in the prepared file, for those processes and for this
  /// one if it is killed; that file is written while the first batch is computed. All ranks of
  /// `world` (null: none) call this together; the first one traces. Throws Interrupted,
  /// MachineError.
  void prepare(MpiWorld* world);
  /// Computes a batch. Its file is written while the next one is computed, and is there after
  /// `finish`. Throws Interrupted, MachineError, also of the batch before.
  void compute(std::size_t batch);
  /// Waits until all batches are written. Throws MachineError.
  void finish();
  /// Gives the lines to the variants that share them; no batch can be computed afterwards.
  void leave_lines();
  /// Says what work was done and how long it took.
  void report_work() const;

 private:
  void read_or_trace();
  bool has_shared_lines() const { return shared_ && shared_->lines; }
  void take_shared_lines();
  RayRecord* record_of(std::size_t batch);
  void build_prepared(std::optional<Prepared> ready);
  void build(std::optional<Lines> lines, std::vector<SolvedNodes> nodes = {});
  void build_seasons();
  void add(std::unique_ptr<TracedSeason> season);
  void warn_of_sensors();
  void tell_reduction(const TracedSeason& season) const;
  Solved solved(std::size_t batch, const BatchParts& parts);
  void add_reduction(BatchWriter& writer) const;
  void keep_lines(const std::string& path);
  void write(const BatchWriter& writer, const std::string& path) const;
  void warn(const std::string& text) const;

  const WorkFolder& folder_;
  const VariantPlan& plan_;
  std::shared_ptr<const Hierarchy> mesh_;
  Progress& progress_;
  bool speaks_for_all_ = true;  ///< of those that prepare together
  TracedRays* shared_;
  SolverRules rules_;                                   ///< of the solver, counts decided
  std::vector<std::unique_ptr<TracedSeason>> seasons_;  ///< one where materials stay
  SeenOnce seen_;
  WorkDone unwritten_;     ///< work that no batch carries yet
  WorkDone done_;          ///< all of it
  WritingBehind writing_;  ///< of the prepared file, then of the batch before
};

}  // namespace sunload
