// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "io/scene/raster/gdal_file.h"

namespace sunload {

namespace {

// The shore of the Dead Sea lies at −440 m, Mount Everest reaches 8849 m; with room for
// the sea floor near coasts.
constexpr double lowest_elevation_m = -1000, highest_elevation_m = 9000;
// Of what stands on land; rounding leaves small negative differences.
constexpr double lowest_height_m = -1, highest_height_m = 2000;

/// A unit that the file names.
struct NamedUnit {
  std::string name;
  double m = 1;
};

/// By the names that GDAL and what writes for it give to units of a band; none: another word.
std::optional<double> length_of_unit(const std::string& name) {
  constexpr double foot = 0.3048, us_survey_foot = 1200.0 / 3937;  // as they are defined
  static const std::map<std::string, double> units{
      {"m", 1},
      {"metre", 1},
      {"meter", 1},
      {"metres", 1},
      {"meters", 1},
      {"cm", 0.01},
      {"centimetre", 0.01},
      {"centimeter", 0.01},
      {"mm", 0.001},
      {"millimetre", 0.001},
      {"millimeter", 0.001},
      {"ft", foot},
      {"foot", foot},
      {"feet", foot},
      {"international foot", foot},
      {"us survey foot", us_survey_foot},
      {"us survey feet", us_survey_foot},
      {"us-ft", us_survey_foot},
      {"ftus", us_survey_foot},
      {"foot_us", us_survey_foot},
  };
  const auto found = units.find(lower_case(name));
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

class RasterReader {
 public:
  RasterReader(const std::string& path, double unit_m, RasterValues values, NoteCounter& notes,
               std::string unit_key)
      : path_(path),
        unit_m_(unit_m),
        kind_(values),
        notes_(notes),
        unit_key_(std::move(unit_key)) {}

  Raster read() {
    open();
    read_crs();
    read_unit_of_heights();
    read_values();
    return std::move(raster_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const {
    throw InputError({path_}, what, why.empty() ? messages_.first() : why, hint);
  }

  void open() {
    dataset_ = open_with_gdal(path_, GDAL_OF_RASTER, {"GTiff", "AAIGrid"});
    std::error_code unreadable;
    if (!dataset_ && !std::filesystem::exists(path_, unreadable)) fail("there is no such file");
    if (!dataset_) fail("cannot be read as a raster");
    raster_.columns = static_cast<std::size_t>(gdal::GDALGetRasterXSize(dataset_.get()));
    raster_.rows = static_cast<std::size_t>(gdal::GDALGetRasterYSize(dataset_.get()));
    if (static_cast<double>(raster_.columns) * static_cast<double>(raster_.rows) >
        most_raster_cells) {
      fail(fmt::format("has {} × {} cells", raster_.columns, raster_.rows),
           fmt::format("at most {:.0f} million can be read", most_raster_cells / 1e6),
           "cut out the part that matters, or take wider cells");
    }
    if (static_cast<double>(raster_.columns) * static_cast<double>(raster_.rows) >
        raster_cells_at_least +
            raster_cells_per_byte * static_cast<double>(std::filesystem::file_size(path_))) {
      fail(fmt::format("has {} × {} cells", raster_.columns, raster_.rows),
           "they are too many for its size", "is it cut off?");
    }
    if (gdal::GDALGetRasterCount(dataset_.get()) < 1) fail("has no band", "heights were expected");
    check_blocks();
    if (gdal::GDALGetRasterCount(dataset_.get()) > 1)
      notes_.say("the first of several bands of the raster is taken for heights");
    if (gdal::GDALGetGeoTransform(dataset_.get(), raster_.file_from_cell.data()) != CE_None)
      fail("does not say where it lies", "it has no georeference");
    const auto& g = raster_.file_from_cell;
    if (!(std::abs(g[1] * g[5] - g[2] * g[4]) > 0))
      fail("has cells without area", "its georeference is degenerate");
  }

  /// GDAL unpacks a block of all bands at once, whatever the size that the file states for it.
  void check_blocks() const {
    constexpr double most_bytes = 256e6;
    auto* band = gdal::GDALGetRasterBand(dataset_.get(), 1);
    int width = 0, height = 0;
    gdal::GDALGetBlockSize(band, &width, &height);
    const int bands = gdal::GDALGetRasterCount(dataset_.get());
    const double bytes = static_cast<double>(width) * height * bands *
                         gdal::GDALGetDataTypeSizeBytes(gdal::GDALGetRasterDataType(band));
    if (bytes > most_bytes) {
      fail(fmt::format("has blocks of {} × {} cells in {} bands", width, height, bands),
           "they do not fit into memory", "store it in smaller tiles");
    }
  }

  void read_crs() {
    auto* crs = gdal::GDALGetSpatialRef(dataset_.get());
    if (crs == nullptr) return notes_.say("the raster itself names no CRS: site.crs or --crs may");
    if (gdal::OSRIsGeographic(crs)) {
      fail("has coordinates in degrees", "distances are needed in metres",
           "project it first, for example with gdalwarp -t_srs EPSG:…");
    }
    raster_.crs = crs_name(crs);
    char* unit = nullptr;
    plane_.m = gdal::OSRGetLinearUnits(crs, &unit);
    plane_.name = unit == nullptr ? "units" : unit;
    if (plane_.m != 1 && unit_m_ == 1) {
      notes_.say(
          fmt::format("coordinates of the raster are in {} of {:.6g} m, taken for "
                      "metres: {} says otherwise",
                      plane_.name, plane_.m, unit_key_));
    }
  }

  /// That of the band, else of heights in the CRS; none where the file says none that is known.
  std::optional<NamedUnit> unit_of_heights() const {
    if (const std::string name =
            gdal::GDALGetRasterUnitType(gdal::GDALGetRasterBand(dataset_.get(), 1));
        !name.empty()) {
      if (const auto metres = length_of_unit(name)) return NamedUnit{name, *metres};
      notes_.say("heights of the raster are in '" + name +
                 "', an unknown unit: taken for that of its coordinates");
      return {};
    }
    auto* crs = gdal::GDALGetSpatialRef(dataset_.get());
    if (crs == nullptr || gdal::OSRIsCompound(crs) == 0) return {};
    char* unit = nullptr;
    const double metres = gdal::OSRGetTargetLinearUnits(crs, "VERT_CS", &unit);
    return NamedUnit{unit == nullptr ? "units" : unit, metres};
  }

  void read_unit_of_heights() {
    const auto heights = unit_of_heights();
    if (!heights || heights->m == plane_.m) return;
    const std::string text =
        fmt::format("heights of the raster are in {} of {:.6g} m", heights->name, heights->m);
    // The study's word against the file's about the coordinates: it holds for heights as well.
    if (plane_.m == 1 && unit_m_ != 1)
      return notes_.say(
          fmt::format("{}, taken for units of {:g} m by {}", text, unit_m_, unit_key_));
    plane_from_height_ = heights->m / plane_.m;
    notes_.say(text + ", converted to " +
               (plane_.m == 1 ? "metres" : plane_.name + ", the unit of its coordinates"));
    auto* crs = gdal::GDALGetSpatialRef(dataset_.get());
    if (crs == nullptr || gdal::OSRIsCompound(crs) == 0) return;
    // Its heights are no longer those of the CRS.
    auto* plane = gdal::OSRClone(crs);
    if (gdal::OSRStripVertical(plane) == OGRERR_NONE) raster_.crs = crs_name(plane);
    gdal::OSRRelease(plane);
  }

  void read_values() {
    auto* band = gdal::GDALGetRasterBand(dataset_.get(), 1);
    auto& values = raster_.values;
    values.resize(raster_.columns * raster_.rows);
    const auto width = static_cast<int>(raster_.columns), height = static_cast<int>(raster_.rows);
    if (gdal::GDALRasterIO(band, GF_Read, 0, 0, width, height, values.data(), width, height,
                           GDT_Float64, 0, 0) != CE_None)
      fail("cannot be read to its end", {}, "is it cut off?");
    int has_no_data = 0;
    double no_data = gdal::GDALGetRasterNoDataValue(band, &has_no_data);
    if (gdal::GDALGetRasterDataType(band) == GDT_Float32)
      no_data = static_cast<double>(static_cast<float>(no_data));
    const double scale = gdal::GDALGetRasterScale(band, nullptr);
    const double offset = gdal::GDALGetRasterOffset(band, nullptr);
    const auto is_valid = valid_cells(band, width, height);
    std::size_t missing = 0;
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      double& value = values[cell];
      const bool is_masked = !is_valid.empty() && is_valid[cell] == 0;
      if (is_masked || std::isnan(value) || (has_no_data != 0 && value == no_data)) {
        value = std::nan("");
        ++missing;
        continue;
      }
      value = value * scale + offset;
      expect_usual(value, cell);
      value *= plane_from_height_;
    }
    notes_.count("cells of the raster have no data", missing);
  }

  /// By the file's mask or alpha band: 0 where there is no data. Empty where it has none.
  std::vector<std::uint8_t> valid_cells(GDALRasterBandH band, int width, int height) const {
    if ((gdal::GDALGetMaskFlags(band) & GMF_PER_DATASET) == 0) return {};
    std::vector<std::uint8_t> is_valid(raster_.columns * raster_.rows);
    if (gdal::GDALRasterIO(gdal::GDALGetMaskBand(band), GF_Read, 0, 0, width, height,
                           is_valid.data(), width, height, GDT_Byte, 0, 0) != CE_None)
      fail("has a mask that cannot be read to its end", {}, "is it cut off?");
    return is_valid;
  }

  void expect_usual(double value, std::size_t cell) const {
    const bool is_land = kind_ == RasterValues::elevations;
    const double low = is_land ? lowest_elevation_m : lowest_height_m;
    const double high = is_land ? highest_elevation_m : highest_height_m;
    const double metres = value * plane_from_height_ * unit_m_;
    if (metres >= low && metres <= high) return;
    fail(fmt::format("has the height {} in row {}, column {}", value, cell / raster_.columns + 1,
                     cell % raster_.columns + 1),
         is_land ? "no land lies there" : "no tree is so high above the ground",
         "is it a NODATA value that the file does not declare?");
  }

  std::string path_;
  double unit_m_;
  RasterValues kind_;
  NoteCounter& notes_;
  std::string unit_key_;
  NamedUnit plane_;  ///< of coordinates, as the file says it
  double plane_from_height_ = 1;
  GdalMessages messages_;
  GdalDataset dataset_;
  Raster raster_;
};

}  // namespace

Raster read_raster(const std::string& path, double unit_m, RasterValues values, NoteCounter& notes,
                   const std::string& unit_key) {
  return RasterReader(path, unit_m, values, notes, unit_key).read();
}

std::optional<double> height_between_cells(const Raster& raster, double unit_m, double x_m,
                                           double y_m) {
  const auto& g = raster.file_from_cell;
  const double determinant = g[1] * g[5] - g[2] * g[4];
  const double dx = x_m / unit_m - g[0], dy = y_m / unit_m - g[3];
  // From middles of cells.
  const double column = (dx * g[5] - dy * g[2]) / determinant - 0.5;
  const double row = (dy * g[1] - dx * g[4]) / determinant - 0.5;
  const auto last_column = static_cast<double>(raster.columns) - 1;
  const auto last_row = static_cast<double>(raster.rows) - 1;
  // Half a cell at the rim has the height of its cell.
  if (!(column >= -0.5 && column <= last_column + 0.5 && row >= -0.5 && row <= last_row + 0.5))
    return {};
  const double c = std::clamp(column, 0.0, last_column), r = std::clamp(row, 0.0, last_row);
  const auto c0 = static_cast<std::size_t>(c), r0 = static_cast<std::size_t>(r);
  const std::size_t c1 = std::min(c0 + 1, raster.columns - 1);
  const std::size_t r1 = std::min(r0 + 1, raster.rows - 1);
  const double u = c - static_cast<double>(c0), v = r - static_cast<double>(r0);
  const double height = (1 - v) * ((1 - u) * raster.at(c0, r0) + u * raster.at(c1, r0)) +
                        v * ((1 - u) * raster.at(c0, r1) + u * raster.at(c1, r1));
  if (std::isnan(height)) return {};
  return height * unit_m;
}

}  // namespace sunload
