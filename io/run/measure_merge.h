// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The measures of a study, from its scene and batches into the result.
#pragma once

#include "io/batch/file.h"
#include "io/plan/study_measures.h"
#include "io/result/writer.h"

namespace sunload {

class MeasureMerge {
 public:
  /// All must outlive it.
  MeasureMerge(const VariantPlan& plan, const Hierarchy& hierarchy, const ResultGeometry& geometry);
  /// Adds the series of a batch that measures watch.
  void add(const BatchReader& batch);
  /// Computes and writes; after the last batch.
  void write(ResultWriter& writer);

 private:
  void write_one(ResultWriter& writer, const StudyMeasure& measure) const;

  const VariantPlan& plan_;
  const ResultGeometry& geometry_;
  StudyMeasures measures_;
};

/// SHA-256 of what the study asks to be measured; empty where it asks nothing.
std::string measures_hash(const Study& study);

}  // namespace sunload
