// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes batches of one variant and writes them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/plan/interval_lights.h"
#include "io/plan/variant_plan.h"
#include "io/run/progress.h"
#include "io/run/unit_queue.h"
#include "solver/solver.h"

namespace sunload {

class VariantRun {
 public:
  VariantRun(const std::string& folder, const VariantPlan& plan,
             std::shared_ptr<const Hierarchy> mesh, Progress& progress);
  ~VariantRun();
  VariantRun(const VariantRun&) = delete;
  VariantRun& operator=(const VariantRun&) = delete;

  /// Goes through the process' own batches and computes those that have no valid file yet. Where
  /// more than one is missing, whoever may compute it, the traced lines are kept in the prepared
  /// file: for other processes, and for this one if it is killed. Throws Interrupted, MachineError.
  void compute(UnitQueue& units, MpiWorld* world);

 private:
  bool is_finished(std::size_t batch);
  void make_solver(MpiWorld* world);
  void read_or_trace();
  void build(std::optional<Lines> ready);
  void warn_of_sensors();
  void keep_lines(const std::string& path);
  SolverRules decided_rules();
  void compute_batch(std::size_t batch);
  void report_work() const;

  const std::string& folder_;
  const VariantPlan& plan_;
  std::shared_ptr<const Hierarchy> mesh_;
  Progress& progress_;
  SolverRules rules_;  ///< of the solver, counts decided
  std::unique_ptr<LightSolver> solver_;
  std::optional<IntervalLights> lights_;  ///< on the solver's sky grid
  WorkDone written_;                      ///< work that finished batches carry already
};

}  // namespace sunload
