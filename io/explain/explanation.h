// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Why a place has the light load that it has, and why it has another in another result.
///
/// Rows: what the place would have in the open; each object with what it takes (below 0) and gives;
/// their sum; what the result has; and what remains, which is the light that is not looked for
/// (solver/explain/attribution.h) and the samples' spread. Realizations are those of the result,
/// with its random numbers: errors of differences between results that share them are those of
/// pairs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/base/light_quantity.h"
#include "io/explain/result_scene.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// Light of one kind [kWh m-2, or klx h].
enum class Column { sun, sky, far_ground, reflects, mirrors, shines };
inline constexpr std::size_t column_count = 6;
/// As the table and its CSV name them.
inline constexpr std::array column_names{"sun",      "sky",     "far_ground",
                                         "reflects", "mirrors", "shines"};

/// One row of the table, in the unit of the explanation.
struct ExplainedRow {
  /// What the row is of, in the order of the table.
  enum class Kind { open, object, sum, result, remainder } kind;
  std::string name;  ///< of an object; else empty
  /// NaN where the result does not divide its light so.
  std::array<double, column_count> columns;
  double total = 0, se = 0;          ///< se: NaN where not known
  double share_percent;              ///< of the difference of the sums; NaN: of one result
  std::vector<double> realizations;  ///< of `total`; empty where not known
};
/// "open", "object" …
std::string kind_name(ExplainedRow::Kind kind);

/// The table for one place of one result, or of the difference of two.
struct Explanation {
  std::string study, variant, base;  ///< base: of the result that it is compared with, or empty
  std::string place;                 ///< as it was named
  std::string part;                  ///< of the period; empty: the whole
  std::string units;
  Quantity quantity = Quantity::irradiance;
  std::string extent;              ///< "388.22 m²", "2 sensors"
  std::vector<ExplainedRow> rows;  ///< objects: those that matter most first
  std::vector<std::string> notes;
};

/// Throws InputError for results that lack what it takes.
void expect_explainable(const ResultReader& result);

/// The mean over the facades and objects, or over the sensors, that are named. Throws InputError
/// where nothing or things of two kinds are named, and for results that lack what it takes.
Explanation explained(const ResultReader& result, const ResultScene& scene,
                      const NamedParts& parts);

/// Row by row what `variant` has more than `base`, objects by their names. Pairs: see
/// io/result/pairing.
Explanation difference(const Explanation& base, const Explanation& variant, bool are_pairs);

/// As people are shown it: the object's name, "in the open", "adds up to" …
std::string row_words(const ExplainedRow& row, const Explanation& of);
/// All rows, but of the objects the first `objects` and the others together, "3 others".
std::vector<ExplainedRow> shown_rows(const Explanation& explanation, std::size_t objects);

/// For people: objects of little weight are one row.
std::string explanation_text(const Explanation& explanation);
/// Header `row,name,sun_kwh_m2,sky_kwh_m2,far_ground_kwh_m2,reflects_kwh_m2,mirrors_kwh_m2,
/// shines_kwh_m2,total_kwh_m2,se_kwh_m2,share_percent` (klx_h of illuminance); empty: not known.
std::string explanation_csv(const Explanation& explanation);
/// The same with what it is of; null: not known.
std::string explanation_json(const Explanation& explanation);

}  // namespace sunload
