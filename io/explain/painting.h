// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which surface is worth painting: what a place gains where diffuse reflectances rise by 0.1.
///
/// First-order changes (solver/explain/importance.h), by all reflections, with the errors of the
/// result's realizations. What surfaces reflect as mirrors stays.
#pragma once

#include <string>
#include <vector>

#include "io/base/light_quantity.h"
#include "io/explain/result_scene.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// What painting one material, or one object's surfaces of it, brings.
struct PaintedRow {
  enum class Kind { material, surface } kind;  ///< everywhere, or on one object
  std::string material, object;                ///< object: of a surface
  double area_m2 = 0;
  double reflectance = 0;     ///< diffuse, mean of the bands
  double change = 0, se = 0;  ///< for 0.1 more [kWh m-2, or klx h]; se NaN: not known
  double per_100_m2() const { return 100 * change / area_m2; }
};

/// What painting brings for one place of one result.
struct Painting {
  std::string study, variant, place, part;  ///< part of the period; empty: the whole
  std::string units, extent;
  Quantity quantity = Quantity::irradiance;
  double load = 0;               ///< that the place has
  std::vector<PaintedRow> rows;  ///< materials, then surfaces; the greatest changes first
};

/// Throws InputError where the place is not one.
Painting painted(const ResultReader& result, const ResultScene& scene, const NamedParts& parts);

/// For people: a screen of each.
std::string painting_text(const Painting& painting);
/// Header `row,material,object,area_m2,reflectance,change_kwh_m2,se_kwh_m2,per_100_m2_kwh_m2`.
std::string painting_csv(const Painting& painting);
std::string painting_json(const Painting& painting);

}  // namespace sunload
