/// Computes batches of one variant and writes them.
#pragma once

#include <memory>
#include <string>

#include "io/progress.h"
#include "io/units.h"
#include "io/variant_plan.h"
#include "solver/solver.h"

namespace sunload {

class VariantRun {
 public:
  VariantRun(const std::string& folder, const VariantPlan& plan,
             std::shared_ptr<const Hierarchy> mesh, Progress& progress);

  /// Goes through the process' own batches and computes those that have no
  /// valid file yet. Where others work on the variant too, the traced lines are
  /// shared by the prepared file. Throws Interrupted, MachineError.
  void compute(UnitQueue& units, MpiWorld* world);

 private:
  bool is_finished(std::size_t batch);
  void make_solver(bool others_work_too, MpiWorld* world);
  SolverRules decided_rules();
  SunLight light_of(std::size_t interval, const SkyGrid& grid,
                    const std::vector<double>& open_share) const;
  void compute_batch(std::size_t batch);
  void report_work() const;

  const std::string& folder_;
  const VariantPlan& plan_;
  std::shared_ptr<const Hierarchy> mesh_;
  Progress& progress_;
  std::unique_ptr<LightSolver> solver_;
  std::vector<double> open_share_;  ///< of the solver's sky cells: what hills leave free
  WorkDone written_;  ///< work that finished batches carry already
};

}  // namespace sunload
