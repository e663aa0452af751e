// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One value per patch of a result, chosen by name and time, and the end of its colour scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/base/check.h"
#include "io/result/reader.h"

namespace sunload {

/// Values per patch and how to name them.
struct ShownQuantity {
  std::vector<double> values;
  std::string dataset;
  std::string name;            ///< words: "light load"
  std::string units;           ///< as people write them
  std::string stored_units;    ///< as files have them: "kWh m-2"
  std::string when;            ///< the whole period, or the interval in words
  std::size_t interval = 0;    ///< of the time asked for, or the brightest one
  bool is_series = false;      ///< values are those of `interval`
  bool is_derived = false;     ///< made of datasets, and none itself
  bool is_difference = false;  ///< values lie on both sides of 0

  /// Value of the first colour of a scale that ends with `largest`.
  double scale_begin(double largest) const { return is_difference ? -largest : 0; }
  /// Sizes of the values, which decide the end of a scale.
  std::vector<double> sizes() const;
};

/// What is shown where nobody says: the light load, or of a comparison its difference.
std::string usual_quantity(const ResultReader& result);

/// What to try where a time is given for a quantity that is a total.
std::string leave_out_or_name_a_series(const ResultReader& result);

/// A dataset [patch] as it is, or the interval of a dataset [time, patch] that holds `time`
/// (as in a study; empty: the brightest); or the radiance of what leaves diffusely (luminance, of a
/// result of illuminance) in that interval, or where `time` is empty its mean
/// (io/result/radiance.h). Throws InputError that lists what there is.
ShownQuantity shown_quantity(const ResultReader& result, const std::string& dataset,
                             const std::string& time);

/// Datasets of numbers per patch that the result has, as the schema orders them:
/// those of the whole period, or the series.
enum class PatchDatasets { totals, series };
std::vector<std::string> patch_datasets(const ResultReader& result, PatchDatasets which);

/// What to say of a quantity that is none of `known`.
InputError unknown_quantity(const ResultReader& result, const std::string& quantity,
                            const std::vector<std::string>& known, const std::string& why);

/// Share of the area that lies below the end of a scale, so that a few glints do not darken the
/// rest.
inline constexpr double scale_share = 0.995;

/// Value of the last colour: `largest` where given (InputError unless above 0), else a round
/// number below which `scale_share` of the area lie.
double scale_end(const std::optional<double>& largest, const std::vector<double>& values,
                 const std::vector<double>& area);

}  // namespace sunload
