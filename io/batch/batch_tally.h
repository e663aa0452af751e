// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A batch's tally as the arrays of a batch file, and back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/batch/file.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

/// Names of arrays that merge needs but the result does not show.
namespace batch_array {
inline constexpr const char* exposure = "exposure";               ///< [R, N] J m-2
inline constexpr const char* ledger = "ledger";                   ///< [R, 9] J: terms, residual
inline constexpr const char* outgoing = "outgoing";               ///< [N] J m-2
inline constexpr const char* sunlit = "sunlit";                   ///< [N] s
inline constexpr const char* maximum = "irradiance_max";          ///< [N] W m-2
inline constexpr const char* sky_view = "sky_view_factor";        ///< [N]
inline constexpr const char* sky_view_se = "sky_view_factor_se";  ///< [N]
inline constexpr const char* bounces = "bounces";                 ///< [1]
/// Per patch: lines in the mean, direct samples, and samples of the first shot where a pilot chose
/// them.
inline constexpr const char* counts = "counts";
inline constexpr const char* patch_lines = "patch_lines";    ///< [N] if a pilot chose them
inline constexpr const char* kept_area = "kept_area";        ///< [2] see KeptArea
inline constexpr const char* energy = "energy";              ///< [3] J: in, residual, lost at backs
inline constexpr const char* sensor_backs = "sensor_backs";  ///< [S] share of lines that met backs
/// [4] of a year from few solutions: skies, suns; what it differs by from a solution for each
/// interval, and the standard error of these [W m-2], root mean squares.
inline constexpr const char* reduction = "reduction";
inline constexpr const char* work = "work";  ///< see WorkDone
}  // namespace batch_array

/// What a batch has of the parts of the period, for its file.
struct BatchParts {
  /// Where the totals of a part of the period come from.
  struct Source {
    std::size_t part = 0;               ///< number in the period, over all divisions
    bool with_errors = true;            ///< the realizations' sums, too
    std::optional<std::size_t> solved;  ///< in `solved`; absent: the batch lies in it as a whole
  };
  std::vector<PartOfBatch> solved;  ///< for the solver: no two alike
  std::vector<Source> sources;
};
/// Begins the names of a part's arrays, behind the band: `part/3/exposure`.
std::string part_prefix(std::size_t part);
/// Number of the part and the rest of the name; none for arrays of the whole.
struct PartArray {
  std::optional<std::size_t> part;
  std::string name;
};
PartArray part_array(const std::string& name);

/// Before the names of arrays and datasets of sensors: `sensor_irradiance`, ….
inline const std::string sensor_prefix = "sensor_";

/// Name of the series of a part: `irradiance`, `irradiance_direct`, ….
std::string series_name(Part part);
/// Name of its time sum within a batch file: `sum_total`, `sum_direct`, …
std::string sum_name(Part part);
/// Name of the time sums of every realization of a part (not of `total`): "exposure_direct", …
std::string part_exposure_name(Part part);

/// Rays and seconds as one row of a batch file, and back.
std::vector<double> work_values(const WorkDone& work);
WorkDone work_from(const std::vector<double>& values);

/// Begins the names of series that are sums over steps, behind the band: `step/irradiance`.
inline const std::string step_prefix = "step/";

/// What a batch has of the steps that series are means over.
struct BatchSteps {
  /// One step, or as much of it as lies in the batch.
  struct Row {
    std::size_t first = 0, end = 0;  ///< intervals within the batch
  };
  std::vector<Row> rows;         ///< none: series are of intervals
  std::vector<double> length_s;  ///< of the batch's intervals
};

/// What is stored of the series of patches and sensors. Means of facades keep all bits: many
/// patches make them surer than any of these.
struct StoredSeries {
  std::vector<std::string> left_out;  ///< names, as in BatchHeader
  int mantissa_bits = all_mantissa_bits;
  BatchSteps steps = {};
};

/// What of a scene is the same for all suns. Where materials change in the course of time: means
/// over it.
struct SeenOnce {
  std::vector<double> sky_view_factor, sensor_sky_view_factor;
  /// Their standard errors; of means: the means of them, since lines are the same at all times.
  std::vector<double> sky_view_factor_se, sensor_sky_view_factor_se;
  std::vector<double> sensor_backs;  ///< share of a sensor's lines that met backs
  int bounces = 0;                   ///< the most
};
SeenOnce seen_once(const TracedScene& traced);
/// With their shares of time, which add up to 1.
SeenOnce mean_seen(const std::vector<SeenOnce>& scenes, const std::vector<double>& shares);

/// Everything of the tallies, one per band, into a batch file's arrays; `parts` are those that they
/// were solved with; `work` is what this batch cost; `irradiance_relative` is the goal that the
/// study has for its series, if it has one. Arrays of three bands have the prefixes of
/// `band_prefixes`, but for those that are the same in all of them.
void add_tallies(BatchWriter& writer, const std::vector<BatchTally>& bands,
                 const TracedScene& traced, const SeenOnce& seen, const Mesh& mesh,
                 const BatchParts& parts, const WorkDone& work,
                 std::optional<double> irradiance_relative, const StoredSeries& stored = {});

}  // namespace sunload
