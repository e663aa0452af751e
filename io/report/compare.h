// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What changes between two results: differences of the light load, or of another total per patch,
/// with their significance, per facade, object, selection, orientation, storey, surface, sensor and
/// on the whole.
///
/// Groups are matched by name and compared by the area-weighted mean of what both results have of
/// them (io/result/common_area), in the same groups: new trees and storeys are in no mean of what
/// was there before, nor what a patch brings into a selection by its middle alone. What only one of
/// the two has stands in rows of its own. Where both results are pairs (io/result/pairing) and have
/// the same number of realizations, the standard error is that of the per-realization differences
/// of the group means, with R − 1 degrees of freedom (patches need not match one to one, so that
/// variants may differ in geometry). Otherwise both errors add up (Welch). p-values are corrected
/// by Holm within each kind of group. Of a total without realizations differences have no errors
/// and no p-values; what changes is then what changes by more than a share of the base.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/report/verdicts.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"
#include "io/result/schema.h"

namespace sunload {

/// One group; loads are area-weighted means [kWh m-2, klx h, or the unit of what is compared], NaN
/// where not known.
struct ComparisonRow {
  std::string kind;  ///< of io/result/patch_groups.h, or sensor
  std::string name;
  /// That is compared; of a row of one result, that it has alone; of sensors not known.
  double area_m2 = 0;
  std::optional<double> base_kwh_m2, variant_kwh_m2;  ///< absent: a row of the other result alone
  double difference_kwh_m2 = 0;                       ///< variant − base
  double difference_percent = 0;                      ///< of the base
  double se_kwh_m2 = 0;                               ///< standard error of the difference
  double degrees_of_freedom = 0;                      ///< of `se_kwh_m2`, for Student's t
  /// Of a difference that is no larger, either way, than `least_percent` of the base, or than the
  /// mesh's error where that is more: of none.
  double p_value = 0;
  double p_corrected = 0;        ///< for the number of groups of the same kind
  bool significant = false;      ///< p_corrected < significance_level
  double unmatched_area_m2 = 0;  ///< of the group in both, without a counterpart in the other
  /// What unlike meshes put the difference off (io/result/mesh_error), beside `se`; NaN: not known.
  /// No difference within it is sure.
  double mesh_error_kwh_m2 = 0;
};

/// All rows of a comparison, and what they rest on.
struct Comparison {
  std::string base, variant;  ///< names of the variants
  std::string dataset = std::string(usual_compared);
  std::string units;  ///< of the dataset, as the files state it
  Quantity quantity = Quantity::irradiance;
  std::size_t base_realizations = 0, variant_realizations = 0;
  double least_percent = 0;  ///< of the base: smaller differences do not matter, however sure
  /// unknown: a result lacks realizations; none: no result keeps any of this dataset.
  enum class Errors { paired, independent, unknown, none } errors = Errors::unknown;
  bool have_same_mesh = true;      ///< patch by patch
  std::vector<std::string> notes;  ///< what a reader must know, e.g. that the periods differ
  std::vector<ComparisonRow> rows;
  std::vector<MeasureChange> measures;  ///< that JSON lists, too

  bool is_of_light_load() const { return dataset == usual_compared; }
  bool has_errors() const { return errors == Errors::paired || errors == Errors::independent; }
};

/// What is compared, and which changes matter.
struct CompareRules {
  std::string dataset = std::string(usual_compared);  ///< a total per patch of both results
  double least_percent = 0;  ///< significant is what is surely more than this share of the base
  std::optional<double> storey_m = {};  ///< height of storeys, which have rows then
};

/// Rows of orientations always. A measure is compared where both results have it measured.
/// Throws InputError where a result does not have the dataset or the units differ.
Comparison compare_results(const ResultReader& base, const ResultReader& variant,
                           const CompareRules& rules = {});

/// Keeps the rows of the facades, objects, selections and sensors that are named (all where nothing
/// is); p-values stay corrected for all groups of their kind. Throws InputError for names that
/// neither result has.
void keep_named(Comparison& comparison, const NamedParts& parts, const std::string& path);

/// Groups of a kind that surely gain or lose more than asked for, and the others that both have; of
/// a dataset without errors those that gain or lose more than `least_percent`.
struct ChangeCounts {
  std::size_t gain = 0, lose = 0, others = 0;
};
ChangeCounts change_counts(const Comparison& comparison, const std::string& kind);

/// Table for people: significant differences first within each kind.
std::string comparison_table(const Comparison& comparison);
/// Header and rows for machines (docs/developer/design.md, Commands and exit codes; of illuminance
/// `klx_h` instead of `kwh_m2`, of other datasets than the light load no unit in the names but one
/// in a last column); fields without a value are empty.
std::string comparison_csv(const Comparison& comparison);
/// The same as JSON: one object per row, null where a value is not known.
std::string comparison_json(const Comparison& comparison);

/// The groups, the facades and, on the base's mesh, the patches that both results have, with their
/// differences and the standard errors of these (docs/comparison-file.md). The file appears when it
/// is complete. Throws MachineError where it cannot be written.
void write_comparison_hdf5(const Comparison& comparison, const ResultReader& base,
                           const ResultReader& variant, const std::string& path);

}  // namespace sunload
