// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of all datasets of a result file, top-down (docs/result-file.md).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/light_quantity.h"
#include "io/result/h5.h"

namespace sunload {

/// Who fills a dataset, and with that what it may lack.
enum class ResultPart : std::uint8_t {
  coordinate,  ///< of times and vertices: complete, no _FillValue
  geometry,    ///< patches, facades and their names
  sun,         ///< one row per interval, complete
  series,      ///< rows come with the batches; float32, chunked
  ledger,      ///< power terms: rows come with the batches
  total,       ///< after the last batch
  division,    ///< parts of the period, where they have totals: complete, no _FillValue
  study
};

/// A row of the table: a dataset, its dimensions, units and attributes.
struct ResultVariable {
  std::string_view name;
  std::string_view dims;  ///< names with commas; empty: a scalar
  h5::Type type = h5::Type::float64;
  std::string_view units;  ///< UDUNITS; empty: text, indices and flags
  ResultPart part = ResultPart::geometry;
  std::string_view long_name;
  std::string_view standard_name = {};  ///< only where CF has the very quantity
  std::string_view cell_methods = {};   ///< how it stands for its interval (CF 7.3)
};

/// The datasets of a result of that quantity. Illuminance has the rows of irradiance in its own
/// names and units, but for `dni`, `dhi` and `ghi`, which stay what the study says.
std::span<const ResultVariable> result_schema(Quantity quantity = Quantity::irradiance);
/// Begins the names of measures of patches; those of facades and sensors have a prefix more.
inline constexpr std::string_view measure_prefix = "measure_";
/// Ends the names of the texts that list all spans of sun of sensors.
inline constexpr std::string_view measure_spans_end = "_spans";
/// Null where the schema has no such dataset. Of measures, whose names the study gives, it is the
/// row that all of them share: without name and units.
const ResultVariable* find_result_variable(std::string_view name,
                                           Quantity quantity = Quantity::irradiance);
/// Whether it is the variable of its own dimension: `time`, `band`, or names as labels.
bool is_coordinate_of_itself(const ResultVariable& variable);
/// "time,patch" → {"time", "patch"}.
std::vector<std::string> dimension_names(const ResultVariable& variable);
/// Whether it is of the scene, whatever the time: the same of every part of the period.
bool is_of_scene(std::string_view dataset);
/// Whether there is a value per band in a result of light in bands: series, totals and the ledger,
/// but for what is the same in all of them (sun hours, sky view factors, emitters).
bool has_bands(const ResultVariable& variable);

/// Name of the dataset that has the largest value of the bands' mean, from the name of the one that
/// has the largest of each band: which do not lie at one time, so that the mean does not follow.
std::string largest_of_mean_dataset(const std::string& largest);
bool is_of_mean(std::string_view dataset);
/// The same dimensions with `band` put in: before those of patches, facades and sensors, else last.
std::vector<std::string> with_band(std::vector<std::string> dimensions);

/// The total that is compared where nobody names another.
inline constexpr std::string_view usual_compared = "light_load";
/// What a comparison file has of its patches (docs/comparison-file.md), of the whole period: of the
/// light load, or of the dataset `compared` in its place.
std::span<const ResultVariable> comparison_schema(
    Quantity quantity = Quantity::irradiance,
    const std::string& compared = std::string(usual_compared));
/// The dataset of differences of the compared one: values on both sides of 0.
std::string difference_dataset(const std::string& compared);
/// The dataset of the realizations of a total; empty where results keep none of it.
std::string realizations_of(const std::string& total);

/// What a map of a place has of the patches that give and take its light (docs/explain.md).
std::span<const ResultVariable> place_map_schema(Quantity quantity = Quantity::irradiance);
/// The dataset of it that is shown where nobody says which.
inline constexpr std::string_view given_dataset = "light_given";

inline constexpr std::string_view result_format = "sunload-result-1";
inline constexpr std::string_view comparison_format = "sunload-comparison-1";
inline constexpr std::string_view place_map_format = "sunload-place-map-1";
inline constexpr std::string_view result_conventions = "CF-1.10 UGRID-1.0";
inline constexpr std::string_view time_units = "seconds since 1970-01-01T00:00:00Z";

}  // namespace sunload
