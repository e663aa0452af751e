// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The measures of a study at work on one variant.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/measure/rule.h"
#include "io/plan/variant_plan.h"

namespace sunload {

class Hierarchy;
class Planner;

/// Throws InputError where a measure is of objects or facades that no variant has: a slip. Looks at
/// those that are chosen first.
void expect_measured_somewhere(const StudyFile& file, const std::vector<Study>& chosen,
                               Planner& planner);
/// Warns of objects and facades of measures that this variant does not have.
void warn_of_absent_places(const Study& study, const BuiltScene& built,
                           std::vector<std::string>& warnings);
/// Warns of measures whose object, facade and surface no face of this variant has at once.
void warn_of_no_faces(const Study& study, const BuiltScene& built,
                      std::vector<std::string>& warnings);
/// Throws InputError where a measure needs a year that the period is not.
void expect_measurable(const Study& study, const LightSeries& light);

/// Warns of measures that have no value anywhere, as the light has no interval that they count.
void warn_of_no_values(const Study& study, const LightSeries& light,
                       std::vector<std::string>& warnings);

/// Of a scene with lamps: warns of measures of daylight that count what these bring.
void warn_of_lamps(const Study& study, std::vector<std::string>& warnings);

/// One measure of a study. What it refers to is kept by StudyMeasures.
struct StudyMeasure {
  MeasureParameters parameters;  ///< the date filled in
  const MeasureRule* rule = nullptr;
  std::vector<std::size_t> patches;  ///< that are measured, ascending
  std::unique_ptr<MeasuredScene> scene;
  std::unique_ptr<Measure> measure;
};

/// A line for each measure of the plan's study: where it is measured, and what it needs.
std::vector<std::string> measures_in_words(const VariantPlan& plan, const Hierarchy& hierarchy);

/// All measures of a study, with the ray caster and the intervals that they share.
class StudyMeasures {
 public:
  /// Plan and mesh must outlive it. Nothing is computed yet.
  StudyMeasures(const VariantPlan& plan, const Hierarchy& hierarchy);
  std::vector<StudyMeasure>& all() { return all_; }

 private:
  std::unique_ptr<const RayCaster> caster_;  ///< every surface opaque
  std::vector<MeasuredInterval> intervals_;
  std::vector<StudyMeasure> all_;
};

}  // namespace sunload
