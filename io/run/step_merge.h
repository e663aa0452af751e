// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Series of steps: what batches have of them, put together into means.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "io/batch/file.h"
#include "io/plan/variant_plan.h"
#include "io/result/writer.h"

namespace sunload {

/// Adds batches up step by step, in batch order, and writes a row of chunks as soon as it is full.
/// A step of which a batch is not there stays empty.
class StepMerge {
 public:
  /// Both must outlive it.
  StepMerge(ResultWriter& writer, const VariantPlan& plan) : writer_(writer), plan_(plan) {}
  void add(const BatchReader& batch);
  /// What is left, after the last batch.
  void finish();

 private:
  void go_to(std::size_t step);
  void close_step();
  void write_chunk();
  bool has_all_batches() const;

  ResultWriter& writer_;
  const VariantPlan& plan_;
  std::map<std::string, ArraySpec> arrays_;          ///< by name, without the prefix of steps
  std::map<std::string, std::vector<double>> sums_;  ///< of the step in hand
  std::size_t step_ = 0, batches_of_step_ = 0;
  /// Finished steps of a row of chunks, [steps][n]: series as stored, and ledger terms.
  std::map<std::string, std::vector<float>> series_;
  std::map<std::string, std::vector<double>> ledger_;
  std::size_t chunk_ = 0;
};

}  // namespace sunload
