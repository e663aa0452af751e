#include "io/scene_raster.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <memory>
#include <mutex>

#include "io/indexed_faces.h"

namespace sunload {

namespace {

// The shore of the Dead Sea lies at −440 m, Mount Everest reaches 8849 m; with room for
// the sea floor near coasts.
constexpr double lowest_height_m = -1000, highest_height_m = 9000;

/// GDAL's messages of one reading; they do not reach stderr.
class GdalMessages {
 public:
  GdalMessages() { CPLPushErrorHandlerEx(&note, this); }
  ~GdalMessages() { CPLPopErrorHandler(); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;
  const std::string& first() const { return first_; }

 private:
  static void CPL_STDCALL note(CPLErr, CPLErrorNum, const char* text) {
    auto& self = *static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (self.first_.empty()) self.first_ = text;
  }
  std::string first_;
};

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};

class RasterReader {
 public:
  RasterReader(const std::string& path, const SceneFileRules& rules)
      : path_(path), unit_m_(rules.unit_m), faces_(path, rules, 'z') {}

  PolygonModel read() {
    open();
    read_crs();
    read_heights();
    add_vertices();
    add_triangles();
    auto model = faces_.finish();
    model.crs = crs_;
    return model;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const {
    throw InputError({path_}, what, why.empty() ? messages_.first() : why, hint);
  }

  void open() {
    static std::once_flag registered;
    std::call_once(registered, [] { GDALAllRegister(); });
    // Only these two: other drivers may follow links to elsewhere.
    const std::array<const char*, 3> drivers{"GTiff", "AAIGrid", nullptr};
    dataset_.reset(GDALOpenEx(path_.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(),
                              nullptr, nullptr));
    if (!dataset_) fail("cannot be read as a raster");
    columns_ = static_cast<std::size_t>(GDALGetRasterXSize(dataset_.get()));
    rows_ = static_cast<std::size_t>(GDALGetRasterYSize(dataset_.get()));
    if (static_cast<double>(columns_) * static_cast<double>(rows_) > most_raster_cells) {
      fail(fmt::format("has {} × {} cells", columns_, rows_),
           fmt::format("at most {:.0f} million can be read", most_raster_cells / 1e6),
           "cut out the part that matters, or take wider cells");
    }
    if (GDALGetRasterCount(dataset_.get()) < 1) fail("has no band", "heights were expected");
    if (GDALGetRasterCount(dataset_.get()) > 1)
      faces_.notes().say("the first of several bands of the raster is taken for heights");
    if (GDALGetGeoTransform(dataset_.get(), file_from_cell_.data()) != CE_None)
      fail("does not say where it lies", "it has no georeference");
  }

  void read_crs() {
    auto* crs = GDALGetSpatialRef(dataset_.get());
    if (crs == nullptr) return faces_.notes().say("the raster names no CRS: site.crs may");
    if (OSRIsGeographic(crs)) {
      fail("has coordinates in degrees", "distances are needed in metres",
           "project it first, for example with gdalwarp -t_srs EPSG:…");
    }
    const char* authority = OSRGetAuthorityName(crs, nullptr);
    const char* code = OSRGetAuthorityCode(crs, nullptr);
    if (authority != nullptr && code != nullptr) {
      crs_ = std::string(authority) + ":" + code;
    } else {
      char* text = nullptr;
      if (OSRExportToWkt(crs, &text) == OGRERR_NONE && text != nullptr) crs_ = text;
      CPLFree(text);
    }
    char* unit = nullptr;
    if (const double metres = OSRGetLinearUnits(crs, &unit); metres != 1 && unit_m_ == 1) {
      faces_.notes().say(fmt::format("coordinates of the raster are in {} of {:.6g} m, taken for "
                                     "metres: scene.unit_m says otherwise",
                                     unit == nullptr ? "units" : unit, metres));
    }
  }

  void read_heights() {
    auto* band = GDALGetRasterBand(dataset_.get(), 1);
    heights_.resize(columns_ * rows_);
    const auto width = static_cast<int>(columns_), height = static_cast<int>(rows_);
    if (GDALRasterIO(band, GF_Read, 0, 0, width, height, heights_.data(), width, height,
                     GDT_Float64, 0, 0) != CE_None)
      fail("cannot be read to its end", {}, "is it cut off?");
    int has_no_data = 0;
    double no_data = GDALGetRasterNoDataValue(band, &has_no_data);
    if (GDALGetRasterDataType(band) == GDT_Float32)
      no_data = static_cast<double>(static_cast<float>(no_data));
    const double scale = GDALGetRasterScale(band, nullptr);
    const double offset = GDALGetRasterOffset(band, nullptr);
    std::size_t missing = 0;
    for (std::size_t cell = 0; cell < heights_.size(); ++cell) {
      double& h = heights_[cell];
      if (std::isnan(h) || (has_no_data != 0 && h == no_data)) {
        h = std::nan("");
        ++missing;
        continue;
      }
      h = h * scale + offset;
      if (h * unit_m_ < lowest_height_m || h * unit_m_ > highest_height_m) {
        fail(fmt::format("has the height {} in row {}, column {}", h, cell / columns_ + 1,
                         cell % columns_ + 1),
             "no land lies there", "is it a NODATA value that the file does not declare?");
      }
    }
    faces_.notes().count("cells of the raster have no data and are left out", missing);
  }

  void add_vertices() {
    const auto& g = file_from_cell_;
    faces_.expect(heights_.size(), 2 * heights_.size());
    for (std::size_t cell = 0; cell < heights_.size(); ++cell) {
      const double column = static_cast<double>(cell % columns_) + 0.5;
      const double row = static_cast<double>(cell / columns_) + 0.5;
      // Cells without data make no face, so that their vertex is left out.
      const double height = std::isnan(heights_[cell]) ? 0 : heights_[cell];
      if (!faces_.add_vertex({g[0] + column * g[1] + row * g[2], g[3] + column * g[4] + row * g[5],
                              height}))
        fail("lies beyond all coordinates on Earth", "", "is unit_m right?");
    }
  }

  void add_triangles() {
    const auto& g = file_from_cell_;
    const bool rows_go_north = g[1] * g[5] - g[2] * g[4] > 0;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (std::isnan(heights_[a] + heights_[b] + heights_[c])) return;
      if (rows_go_north) std::swap(b, c);
      for (const auto corner : {a, b, c}) faces_.add_corner(static_cast<std::int32_t>(corner));
      faces_.end_face();
    };
    for (std::size_t row = 0; row + 1 < rows_; ++row) {
      for (std::size_t column = 0; column + 1 < columns_; ++column) {
        // Counter-clockwise seen from above, where rows go south.
        const auto a = row * columns_ + column, b = a + columns_, c = b + 1, d = a + 1;
        const double climb_ac = std::abs(heights_[a] - heights_[c]);
        const double climb_bd = std::abs(heights_[b] - heights_[d]);
        // A comparison with NaN is false: the diagonal between two cells with data is taken.
        const bool along_ac = !std::isnan(climb_ac) && !(climb_bd < climb_ac);
        if (along_ac) {
          add(a, b, c);
          add(a, c, d);
        } else {
          add(a, b, d);
          add(b, c, d);
        }
      }
    }
  }

  std::string path_;
  double unit_m_;
  GdalMessages messages_;
  IndexedFaces faces_;
  std::unique_ptr<void, CloseDataset> dataset_;
  std::array<double, 6> file_from_cell_{};
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<double> heights_;  ///< NaN: no data
  std::string crs_;
};

}  // namespace

PolygonModel read_scene_raster(const std::string& path, const SceneFileRules& rules) {
  return RasterReader(path, rules).read();
}

}  // namespace sunload
