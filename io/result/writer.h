// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the result file (docs/result-file.md): HDF5 that netCDF-4 tools read.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geo/base/vec.h"
#include "geo/mesh/mesh.h"
#include "io/base/light_quantity.h"
#include "io/batch/file.h"
#include "solver/light/band.h"

namespace sunload {

/// Everything of a result that does not depend on time. Sizes: patches N,
/// vertices, input triangles, objects, facades, materials.
struct ResultGeometry {
  std::vector<Vec3> vertices;  ///< scene frame, relative to origin
  std::vector<std::array<std::int32_t, 3>> patch_vertices;
  std::vector<double> patch_area;
  std::vector<Vec3> patch_centroid, patch_normal;
  std::vector<std::int32_t> patch_object, patch_facade, patch_material, patch_input_triangle;
  std::vector<std::uint8_t> patch_surface, patch_side;
  std::vector<std::array<std::int32_t, 3>> input_triangle_vertices;
  std::vector<std::string> object_name, facade_name, material_name;
  std::vector<double> facade_area, facade_azimuth_deg;  ///< azimuth from true north
  std::vector<std::string> selection_name;              ///< empty: a study without selections
  std::vector<std::vector<std::uint8_t>> selected;      ///< [selection][patch], 1: it is of it
  std::vector<double> selection_area;
  std::vector<Vec3> sensor_position, sensor_normal;  ///< empty: a study without sensors
  Vec3 origin;
};

/// One row per interval, or per step of the series.
struct ResultTimes {
  std::vector<double> time;  ///< UTC s since 1970, the sun's instant
  std::vector<std::array<double, 2>> bounds;
  std::vector<double> sun_azimuth_deg, sun_elevation_deg;
  std::vector<Vec3> sun_direction;
  std::vector<double> dni, dhi, ghi;
  /// [lx]; empty unless the result is of illuminance.
  std::vector<double> direct_illuminance, diffuse_illuminance, global_illuminance;
  std::vector<std::string> season_names = {};    ///< of the study; empty: it has none
  std::vector<std::int32_t> study_seasons = {};  ///< bits in the order of the names
};

/// A division of the period whose parts have totals of their own.
struct ResultDivision {
  std::string name;                           ///< of the dimension: month, season, day, hour_of_day
  std::vector<std::string> label;             ///< of the parts; whole numbers for hours
  std::vector<std::array<double, 2>> bounds;  ///< UTC s since 1970; empty: none in the calendar
  std::vector<double> duration_h;
  bool with_errors = true;
};

/// Root attributes: text and numbers by name.
struct ResultAttributes {
  std::vector<std::pair<std::string, std::string>> text;
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<std::pair<std::string, std::int64_t>> integers;
};

/// Rows of series that are no batch's own: means over steps. Names are those of batches' arrays.
struct StepRows {
  /// Rows of one series.
  struct Series {
    std::string name;
    int mantissa_bits = all_mantissa_bits;
    std::size_t columns = 0;
    std::vector<float> values;  ///< [count][columns]
  };
  /// Rows of one term of the ledger.
  struct Ledger {
    std::string name;
    std::vector<double> values;  ///< [count]
  };
  std::size_t first = 0, count = 0;  ///< a row of chunks
  std::vector<Series> series;
  std::vector<Ledger> ledger;
};

/// A finished array per patch, facade, selection, realization × patch, or scalar.
struct ResultArray {
  std::string name;            ///< must be in the table of result_schema.cpp for irradiance
  std::vector<double> values;  ///< row-major, stored in the type of the schema
};

/// Values of a measure per patch, facade, selection or sensor, as the beginning of its name says:
/// measure_NAME, facade_measure_NAME, selection_measure_NAME, sensor_measure_NAME; NaN where there
/// is none.
struct MeasureArray {
  std::string name, units;
  std::vector<double> values;
  std::vector<std::string> texts = {};  ///< in place of values: all spans of sun
};
/// What its datasets say of it.
struct MeasureAttributes {
  std::vector<std::pair<std::string, std::string>> text;
  std::vector<double> level_values;  ///< empty: it has no verdict, and no share of area
  double area_percent = 0;
};

/// Writes `<path>` aside and renames it at `finish`; nothing is left behind if
/// the writer is destroyed before. Memory stays bounded by one batch.
class ResultWriter {
 public:
  /// How series are stored, and which dimensions the file gets.
  struct Options {
    std::size_t chunk_intervals = 64;
    int compression = 4;
    std::size_t realizations = 8;
    bool times_are_synthetic = false;
    std::string series_step;            ///< word of it; empty: series are of intervals
    std::vector<std::string> left_out;  ///< arrays of the batches that the result does not get
    /// Batches and totals come with the names of irradiance, and are stored as this.
    Quantity quantity = Quantity::irradiance;
    /// With rgb, batches bring the arrays of each band, and totals those of all bands side by side.
    Bands bands = Bands::broadband;
    std::vector<ResultDivision> divisions;
  };
  ResultWriter(const std::string& path, const ResultGeometry& geometry, const ResultTimes& times,
               const Options& options);
  ~ResultWriter();
  /// Series of one batch at its rows; compressed chunks are copied as they are.
  /// An array "irradiance_direct" of the batch becomes the dataset of that name, or
  /// "illuminance_direct".
  void append(const BatchReader& batch);
  /// The same of steps.
  void append(const StepRows& rows);
  /// Time integrals and other arrays without time: name must be in the schema.
  void write(const ResultArray& array);
  void write_measure(const MeasureArray& array, const MeasureAttributes& attributes);
  /// One part's values of totals of parts of the period, `light_load_by_month`, …: row `part`.
  void write_part(const ResultArray& array, std::size_t part);
  /// One value per interval: ledger terms (power_sun …), facade series come by `append`.
  void finish(const ResultAttributes& attributes, const std::string& study_yaml);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace sunload
