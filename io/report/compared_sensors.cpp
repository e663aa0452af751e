// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/compared_sensors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "io/base/statistics.h"
#include "io/report/compared.h"
#include "io/report/difference.h"
#include "io/result/mesh_error.h"
#include "io/result/named_parts.h"
#include "io/result/schema.h"

namespace sunload {
namespace {

/// What a result tells of its sensors.
struct Sensors {
  std::vector<std::string> names;
  std::vector<double> position, normal;           ///< three numbers each; positions absolute
  std::vector<double> load;                       ///< or what is compared in its place
  std::vector<double> reflected;                  ///< light load; empty: not known
  std::vector<std::vector<double>> realizations;  ///< [sensor][realization]; empty: none

  std::size_t count() const { return names.size(); }
};

/// What they are called, where they stand and look to.
Sensors placed_sensors(const ResultReader& result) {
  Sensors all{sensor_names(result),
              result.doubles("sensor_position"),
              result.doubles("sensor_normal"),
              {},
              {},
              {}};
  const Vec3 origin = result.origin();
  for (std::size_t s = 0; s < all.count(); ++s) {
    all.position[3 * s] += origin.x;
    all.position[3 * s + 1] += origin.y;
    all.position[3 * s + 2] += origin.z;
  }
  return all;
}

Sensors sensors_of(const ResultReader& result, const std::string& dataset) {
  Sensors all = placed_sensors(result);
  all.load = result.doubles(dataset);
  if (result.has("sensor_light_load_reflected"))
    all.reflected = result.doubles("sensor_light_load_reflected");
  const std::string rows = realizations_of(dataset);
  if (rows.empty() || !result.has(rows)) return all;
  all.realizations.resize(all.count());
  for (std::size_t r = 0; r < result.shape(rows).front(); ++r) {
    const auto row = result.row(rows, r);
    for (std::size_t s = 0; s < all.count(); ++s) all.realizations[s].push_back(row[s]);
  }
  return all;
}

bool are_near(const std::vector<double>& a, const std::vector<double>& b, std::size_t sensor) {
  constexpr double least_apart = 1e-3;
  for (std::size_t k = 3 * sensor; k < 3 * sensor + 3; ++k)
    if (!(std::abs(a[k] - b[k]) <= least_apart)) return false;
  return true;
}

bool is_in_both(const Sensors& base, const Sensors& variant, std::size_t sensor) {
  return sensor < std::min(base.count(), variant.count()) &&
         are_near(base.position, variant.position, sensor) &&
         are_near(base.normal, variant.normal, sensor);
}

/// As if all of its reflected light came from patches that differ.
double mesh_error(const Sensors& base, const Sensors& variant, std::size_t sensor,
                  const Comparison& comparison) {
  if (comparison.have_same_mesh) return 0;
  if (!has_mesh_error(comparison.dataset) || base.reflected.empty() || variant.reflected.empty())
    return not_known;
  return mesh_error_of_reflected * std::hypot(base.reflected[sensor], variant.reflected[sensor]);
}

ComparisonRow row_of_both(const Sensors& base, const Sensors& variant, std::size_t sensor,
                          const Comparison& comparison) {
  ComparisonRow row = row_without_difference("sensor", base.names[sensor]);
  row.base_kwh_m2 = base.load[sensor];
  row.variant_kwh_m2 = variant.load[sensor];
  row.mesh_error_kwh_m2 = mesh_error(base, variant, sensor, comparison);
  const bool has_errors =
      comparison.has_errors() && !base.realizations.empty() && !variant.realizations.empty();
  tell_difference(row,
                  has_errors
                      ? std::optional(TwoSamples{base.realizations[sensor],
                                                 variant.realizations[sensor], comparison.errors})
                      : std::nullopt,
                  comparison.least_percent);
  return row;
}

}  // namespace

std::vector<char> sensors_in_both(const ResultReader& base, const ResultReader& variant) {
  if (!base.has("sensor_position") || !variant.has("sensor_position")) return {};
  const Sensors of_base = placed_sensors(base), of_variant = placed_sensors(variant);
  std::vector<char> are_in_both;
  for (std::size_t s = 0; s < of_base.count(); ++s)
    are_in_both.push_back(is_in_both(of_base, of_variant, s) ? 1 : 0);
  return are_in_both;
}

std::vector<ComparisonRow> compared_sensors(const ResultReader& base, const ResultReader& variant,
                                            const Comparison& comparison) {
  const std::string dataset = "sensor_" + comparison.dataset;
  std::vector<ComparisonRow> rows;
  if (!base.has(dataset) || !variant.has(dataset)) return rows;
  const Sensors of_base = sensors_of(base, dataset), of_variant = sensors_of(variant, dataset);
  for (std::size_t s = 0; s < std::max(of_base.count(), of_variant.count()); ++s) {
    if (is_in_both(of_base, of_variant, s)) {
      rows.push_back(row_of_both(of_base, of_variant, s, comparison));
      continue;
    }
    if (s < of_base.count()) {
      rows.push_back(row_without_difference("sensor", of_base.names[s]));
      rows.back().base_kwh_m2 = of_base.load[s];
    }
    if (s < of_variant.count()) {
      rows.push_back(row_without_difference("sensor", of_variant.names[s]));
      rows.back().variant_kwh_m2 = of_variant.load[s];
    }
  }
  return rows;
}

}  // namespace sunload
