// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of the period: what a batch has of them, and their totals over all batches.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "io/batch/batch_tally.h"
#include "io/batch/facade_means.h"
#include "io/plan/variant_plan.h"
#include "io/result/writer.h"
#include "io/run/band_writer.h"
#include "io/run/totals.h"

namespace sunload {

/// Parts that `count` intervals from `first` on have time in. Those that have the same share of
/// every interval are solved once; one that has all of it is the batch itself.
BatchParts parts_of_batch(const std::vector<PartTotals>& totals, std::size_t first,
                          std::size_t count);

/// Dimensions of a result.
std::vector<ResultDivision> result_divisions(const VariantPlan& plan);

/// Adds batches up part by part, in batch order, and writes a part as soon as no later batch has
/// time in it, so that days of a year do not pile up.
class PartMerge {
 public:
  /// `writer` and `geometry` must outlive it.
  PartMerge(ResultWriter& writer, const VariantPlan& plan, const ResultGeometry& geometry);
  void add(const BatchReader& batch);
  /// Writes parts that are still open because batches are missing.
  void finish();

 private:
  struct Place {
    std::string kind;     ///< the name of the division
    std::size_t row = 0;  ///< in it
    std::size_t last_batch = 0;
    bool with_errors = true;
  };
  void write(std::size_t part, const Totals& totals);
  void write_received(const Place& place, const Totals& totals, const std::string& prefix,
                      std::size_t receivers);

  BandWriter writer_;
  std::size_t realizations_, patches_, facades_, sensors_;
  FacadeMeans means_;
  std::vector<Place> places_;  ///< of every part
  std::map<std::size_t, Totals> open_;
};

}  // namespace sunload
