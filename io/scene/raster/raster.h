// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Height rasters (GeoTIFF, ESRI ASCII), through GDAL.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geo/base/vec.h"
#include "io/scene/base/from_file.h"

namespace sunload {

inline constexpr double most_raster_cells = 25e6;  ///< 50 million triangles, 4 GB
/// Packed cells may take little room, but a small file shall not ask for more than 1 GB.
inline constexpr double raster_cells_at_least = 4e6, raster_cells_per_byte = 4;

/// What the values of a raster are: heights of land, or heights above it.
enum class RasterValues { elevations, heights };

/// The first band, row by row from the file's first.
struct Raster {
  std::size_t columns = 0, rows = 0;
  /// x = g0 + column·g1 + row·g2, y = g3 + column·g4 + row·g5, from the corner of the first cell.
  std::array<double, 6> file_from_cell{};
  std::vector<double> values;  ///< scale and offset of the band applied; NaN: no data
  std::string crs;             ///< `EPSG:…` or WKT

  double at(std::size_t column, std::size_t row) const { return values[row * columns + column]; }
  /// x and y of a place between columns and rows; whole numbers are corners of cells.
  Vec3 place(double column, double row, double height) const {
    const auto& g = file_from_cell;
    return {g[0] + column * g[1] + row * g[2], g[3] + column * g[4] + row * g[5], height};
  }
  /// Rows usually go south; where they go north, faces seen from above turn round.
  bool rows_go_north() const {
    return file_from_cell[1] * file_from_cell[5] - file_from_cell[2] * file_from_cell[4] > 0;
  }
};

/// Notes what is left out and what the file does not say. Throws InputError for damaged files,
/// coordinates in degrees, more than `most_raster_cells`, and values that no land has (a NODATA
/// value that the file does not declare); `unit_m` is the length of one unit of the file, which
/// notes call `unit_key`. Heights of which the file says another unit than of its coordinates, as
/// feet over a grid of metres, are converted to the coordinates' unit: `unit_m` is of both.
Raster read_raster(const std::string& path, double unit_m, RasterValues values, NoteCounter& notes,
                   const std::string& unit_key = "scene.unit_m");

/// Height at a place on the raster's map [m], linear between the middles of cells; none outside,
/// and where a cell about it has no data.
std::optional<double> height_between_cells(const Raster& raster, double unit_m, double x_m,
                                           double y_m);

}  // namespace sunload
