// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <memory>
#include <string>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "io/export/format.h"
#include "io/export/surface_values.h"

namespace sunload {
namespace {

/// Objects of GDAL are pointers to nothing that could be seen.
template <class Destroy>
auto owned(void* object, Destroy destroy) {
  return std::unique_ptr<void, Destroy>(object, destroy);
}

struct QuietErrors {
  QuietErrors() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietErrors() { CPLPopErrorHandler(); }
};

[[noreturn]] void fail(const std::string& path) {
  throw MachineError("cannot write " + path + ": " + CPLGetLastErrorMsg());
}

/// The file while it is in memory; its name is that of this process alone.
class MemoryFile {
 public:
  MemoryFile() : path_(fmt::format("/vsimem/{}.gpkg", static_cast<const void*>(this))) {}
  ~MemoryFile() { VSIUnlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const char* path() const { return path_.c_str(); }
  std::string_view bytes() const {
    vsi_l_offset count = 0;
    const auto* data = VSIGetMemFileBuffer(path_.c_str(), &count, FALSE);
    return {reinterpret_cast<const char*>(data),
            data == nullptr ? 0 : static_cast<std::size_t>(count)};
  }

 private:
  std::string path_;
};

/// Triangles of patches in absolute coordinates.
class Shapes {
 public:
  explicit Shapes(const ResultPatches& patches) : patches_(patches) {}

  OGRGeometryH triangle(std::size_t patch) const {
    OGRGeometryH ring = OGR_G_CreateGeometry(wkbLinearRing);
    for (const std::size_t k : {0U, 1U, 2U, 0U}) {
      const Vec3 at =
          patches_.vertices[static_cast<std::size_t>(patches_.corners[patch][k])] + patches_.origin;
      OGR_G_AddPoint(ring, at.x, at.y, at.z);
    }
    OGRGeometryH polygon = OGR_G_CreateGeometry(wkbPolygon25D);
    OGR_G_AddGeometryDirectly(polygon, ring);
    return polygon;
  }
  OGRGeometryH all(const std::vector<std::size_t>& patches) const {
    OGRGeometryH shape = OGR_G_CreateGeometry(wkbMultiPolygon25D);
    for (const auto p : patches) OGR_G_AddGeometryDirectly(shape, triangle(p));
    return shape;
  }

 private:
  const ResultPatches& patches_;
};

using Words = std::vector<std::pair<std::string, std::string>>;

/// A layer whose columns are those of its first row.
class Layer {
 public:
  Layer(GDALDatasetH file, const char* name, OGRSpatialReferenceH crs, OGRwkbGeometryType type)
      : layer_(GDALDatasetCreateLayer(file, name, crs, type, nullptr)) {
    if (layer_ == nullptr) fail(name);
  }
  void add(const Words& words, const SurfaceValues::Named& values, OGRGeometryH shape) {
    if (OGR_FD_GetFieldCount(OGR_L_GetLayerDefn(layer_)) == 0) make_columns(words, values);
    const auto feature = owned(OGR_F_Create(OGR_L_GetLayerDefn(layer_)), &OGR_F_Destroy);
    const auto column = [&](const std::string& name) {
      return OGR_F_GetFieldIndex(feature.get(), name.c_str());
    };
    for (const auto& [name, word] : words)
      OGR_F_SetFieldString(feature.get(), column(name), word.c_str());
    for (const auto& [name, value] : values)
      if (const int place = column(name); place >= 0)
        OGR_F_SetFieldDouble(feature.get(), place, value);
    if (OGR_F_SetGeometryDirectly(feature.get(), shape) != OGRERR_NONE ||
        OGR_L_CreateFeature(layer_, feature.get()) != OGRERR_NONE)
      fail("a row");
  }

 private:
  void make_columns(const Words& words, const SurfaceValues::Named& values) {
    const auto make = [&](const std::string& name, OGRFieldType type) {
      const auto column = owned(OGR_Fld_Create(name.c_str(), type), &OGR_Fld_Destroy);
      if (OGR_L_CreateField(layer_, column.get(), TRUE) != OGRERR_NONE) fail(name);
    };
    for (const auto& [name, word] : words) make(name, OFTString);
    for (const auto& [name, value] : values) make(name, OFTReal);
  }

  OGRLayerH layer_;
};

std::string name_at(const std::vector<std::string>& names, std::int32_t place) {
  return place < 0 ? std::string() : names.at(static_cast<std::size_t>(place));
}

void write_layers(const ResultReader& result, const ExportRules& rules, GDALDatasetH file,
                  OGRSpatialReferenceH crs) {
  const ResultPatches patches(result);
  const SurfaceValues values(result, rules);
  const Shapes shapes(patches);
  const auto facades = result.strings("facade_name"), materials = result.strings("material_name");
  const auto facade = result.integers("patch_facade"), material = result.integers("patch_material"),
             surface = result.integers("patch_surface"), side = result.integers("patch_side");
  std::vector<std::vector<std::size_t>> of_object(patches.object_names.size());
  Layer rows(file, "patches", crs, wkbPolygon25D);
  for (std::size_t p = 0; p < patches.corners.size(); ++p) {
    rows.add({{"object", name_at(patches.object_names, patches.object[p])},
              {"facade", name_at(facades, facade[p])},
              {"surface", surface_names[static_cast<std::size_t>(surface[p])]},
              {"material", name_at(materials, material[p])},
              {"side", side[p] == 0 ? "front" : "back"}},
             values.of({p}), shapes.triangle(p));
    if (side[p] == 0) of_object[static_cast<std::size_t>(patches.object[p])].push_back(p);
  }
  Layer objects(file, "objects", crs, wkbMultiPolygon25D);
  for (std::size_t k = 0; k < of_object.size(); ++k)
    if (!of_object[k].empty())
      objects.add({{"object", patches.object_names[k]}}, values.of(of_object[k]),
                  shapes.all(of_object[k]));
}

}  // namespace

void export_geopackage(const ResultReader& result, const ExportRules& rules,
                       const ExportTarget& target) {
  GDALAllRegister();
  const QuietErrors quiet;
  const auto driver = GDALGetDriverByName("GPKG");
  if (driver == nullptr) throw MachineError("GDAL has no driver GPKG here");
  const MemoryFile memory;
  {
    const auto file =
        owned(GDALCreate(driver, memory.path(), 0, 0, 0, GDT_Unknown, nullptr), &GDALClose);
    if (!file) fail(target.path);
    const auto crs = owned(OSRNewSpatialReference(nullptr), &OSRDestroySpatialReference);
    const auto name = result.text_attribute("crs");
    const bool has_crs =
        !name.empty() && OSRSetFromUserInput(crs.get(), name.c_str()) == OGRERR_NONE;
    OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    // One transaction: a row for itself would be flushed for itself.
    GDALDatasetStartTransaction(file.get(), FALSE);
    write_layers(result, rules, file.get(), has_crs ? crs.get() : nullptr);
    if (GDALDatasetCommitTransaction(file.get()) != OGRERR_NONE) fail(target.path);
  }
  target.stream << memory.bytes();
}

}  // namespace sunload
