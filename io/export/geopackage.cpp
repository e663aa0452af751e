// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "io/base/gdal.h"
#include "io/export/format.h"
#include "io/export/qgis_style.h"
#include "io/export/surface_values.h"
#include "io/result/group_table.h"
#include "io/result/schema.h"

namespace sunload {
namespace {

/// Objects of GDAL are pointers to nothing that could be seen.
template <class Destroy>
auto owned(void* object, Destroy& destroy) {
  return std::unique_ptr<void, Destroy&>(object, destroy);
}

struct QuietErrors {
  QuietErrors() {
    gdal::CPLPushErrorHandler([](CPLErr, CPLErrorNum, const char*) {});
  }
  ~QuietErrors() { gdal::CPLPopErrorHandler(); }
};

[[noreturn]] void fail(const std::string& path) {
  throw MachineError("cannot write " + path + ": " + gdal::CPLGetLastErrorMsg());
}

/// The file while it is in memory; its name is that of this process alone.
class MemoryFile {
 public:
  MemoryFile() : path_(fmt::format("/vsimem/{}.gpkg", static_cast<const void*>(this))) {}
  ~MemoryFile() { gdal::VSIUnlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const char* path() const { return path_.c_str(); }
  std::string_view bytes() const {
    vsi_l_offset count = 0;
    const auto* data = gdal::VSIGetMemFileBuffer(path_.c_str(), &count, FALSE);
    return {reinterpret_cast<const char*>(data),
            data == nullptr ? 0 : static_cast<std::size_t>(count)};
  }

 private:
  std::string path_;
};

/// Triangles of patches in absolute coordinates, in the unit of their map.
class Shapes {
 public:
  Shapes(const ResultPatches& patches, double unit_m) : patches_(patches), unit_m_(unit_m) {}

  OGRGeometryH triangle(std::size_t patch) const {
    OGRGeometryH ring = gdal::OGR_G_CreateGeometry(wkbLinearRing);
    for (const std::size_t k : {0U, 1U, 2U, 0U}) {
      const Vec3 at =
          on_map(patches_.vertices[static_cast<std::size_t>(patches_.corners[patch][k])]);
      gdal::OGR_G_AddPoint(ring, at.x, at.y, at.z);
    }
    OGRGeometryH polygon = gdal::OGR_G_CreateGeometry(wkbPolygon25D);
    gdal::OGR_G_AddGeometryDirectly(polygon, ring);
    return polygon;
  }
  OGRGeometryH point(Vec3 in_scene) const {
    const Vec3 at = on_map(in_scene);
    OGRGeometryH shape = gdal::OGR_G_CreateGeometry(wkbPoint25D);
    gdal::OGR_G_SetPoint(shape, 0, at.x, at.y, at.z);
    return shape;
  }
  OGRGeometryH all(const std::vector<std::size_t>& patches) const {
    OGRGeometryH shape = gdal::OGR_G_CreateGeometry(wkbMultiPolygon25D);
    for (const auto p : patches) gdal::OGR_G_AddGeometryDirectly(shape, triangle(p));
    return shape;
  }

 private:
  Vec3 on_map(Vec3 in_scene) const { return (in_scene + patches_.origin) / unit_m_; }

  const ResultPatches& patches_;
  double unit_m_;
};

using Words = std::vector<std::pair<std::string, std::string>>;

/// A layer with these columns of numbers, and those of words that its first row has.
class Layer {
 public:
  Layer(GDALDatasetH file, const char* name, OGRSpatialReferenceH crs, OGRwkbGeometryType type,
        std::vector<std::string> numbers)
      : layer_(gdal::GDALDatasetCreateLayer(file, name, crs, type, nullptr)),
        numbers_(std::move(numbers)) {
    if (layer_ == nullptr) fail(name);
  }
  void add(const Words& words, const SurfaceValues::Named& values, OGRGeometryH shape) {
    if (gdal::OGR_FD_GetFieldCount(gdal::OGR_L_GetLayerDefn(layer_)) == 0) make_columns(words);
    const auto feature =
        owned(gdal::OGR_F_Create(gdal::OGR_L_GetLayerDefn(layer_)), gdal::OGR_F_Destroy);
    const auto column = [&](const std::string& name) {
      return gdal::OGR_F_GetFieldIndex(feature.get(), name.c_str());
    };
    for (const auto& [name, word] : words)
      gdal::OGR_F_SetFieldString(feature.get(), column(name), word.c_str());
    for (const auto& [name, value] : values)
      if (const int place = column(name); place >= 0 && std::isfinite(value))
        gdal::OGR_F_SetFieldDouble(feature.get(), place, value);
    if ((shape != nullptr &&
         gdal::OGR_F_SetGeometryDirectly(feature.get(), shape) != OGRERR_NONE) ||
        gdal::OGR_L_CreateFeature(layer_, feature.get()) != OGRERR_NONE)
      fail("a row");
  }

 private:
  void make_columns(const Words& words) {
    const auto make = [&](const std::string& name, OGRFieldType type) {
      const auto column = owned(gdal::OGR_Fld_Create(name.c_str(), type), gdal::OGR_Fld_Destroy);
      if (gdal::OGR_L_CreateField(layer_, column.get(), TRUE) != OGRERR_NONE) fail(name);
    };
    for (const auto& [name, word] : words) make(name, OFTString);
    for (const auto& name : numbers_) make(name, OFTReal);
  }

  OGRLayerH layer_;
  std::vector<std::string> numbers_;
};

std::string name_at(const std::vector<std::string>& names, std::int32_t place) {
  return place < 0 ? std::string() : names.at(static_cast<std::size_t>(place));
}

/// What columns of numbers are called, as in `SurfaceValues`.
std::string sunload_name(const std::string& key) { return "sunload_" + key; }

std::vector<std::string> names_of(const GroupTable& table) {
  std::vector<std::string> names;
  for (const auto& column : table.columns) names.push_back(sunload_name(column.key));
  return names;
}

SurfaceValues::Named numbers(const GroupTable& table, std::size_t row) {
  SurfaceValues::Named named;
  for (const auto& column : table.columns)
    named.emplace_back(sunload_name(column.key), column.values[row]);
  return named;
}

/// The layers of a result, one function for each.
class ResultLayers {
 public:
  ResultLayers(const ResultReader& result, const ExportRules& rules, GDALDatasetH file,
               OGRSpatialReferenceH crs)
      : result_(result),
        rules_(rules),
        file_(file),
        crs_(crs),
        patches_(result),
        values_(result, rules),
        shapes_(patches_, crs_unit_m(result)),
        shown_(export_quantity(result, rules)),
        largest_(scale_end(rules.largest, shown_.sizes(), patches_.area)),
        side_(result.integers("patch_side")) {}

  void write() {
    const auto& parts = rules_.parts;
    const bool is_all = parts.empty();
    if (is_all || parts.choose_patches()) write_patches();
    if (is_all || !parts.objects.empty()) write_objects();
    if ((is_all && !result_.strings("facade_name").empty()) || !parts.facades.empty())
      write_facades();
    if ((is_all && result_.has("sensor_position")) || !parts.sensors.empty()) write_sensors();
    write_styles();
  }

 private:
  void write_patches() {
    const auto facades = result_.strings("facade_name"),
               materials = result_.strings("material_name");
    const auto facade = result_.integers("patch_facade"),
               material = result_.integers("patch_material"),
               surface = result_.integers("patch_surface");
    Layer rows(file_, "patches", crs_, wkbPolygon25D, values_.names());
    for (const auto p : chosen_patches(result_, rules_.parts))
      rows.add({{"object", name_at(patches_.object_names, patches_.object[p])},
                {"facade", name_at(facades, facade[p])},
                {"surface", surface_names[static_cast<std::size_t>(surface[p])]},
                {"material", name_at(materials, material[p])},
                {"side", side_[p] == 0 ? "front" : "back"}},
               values_.of({p}), shapes_.triangle(p));
    styled("patches", StyledAs::areas);
  }

  void write_objects() {
    const auto of_object = fronts_by(patches_.object, patches_.object_names.size());
    Layer rows(file_, "objects", crs_, wkbMultiPolygon25D, values_.names());
    for (const auto k : chosen_objects(result_, rules_.parts))
      if (!of_object[k].empty())
        rows.add({{"object", patches_.object_names[k]}}, values_.of(of_object[k]),
                 shapes_.all(of_object[k]));
    styled("objects", StyledAs::areas);
  }

  /// The numbers of the table of facades; of a quantity that was asked for, its mean.
  void write_facades() {
    NamedParts parts;
    parts.facades = rules_.parts.facades;
    const auto of_facade =
        fronts_by(result_.integers("patch_facade"), result_.strings("facade_name").size());
    styled("facades", StyledAs::outlines);
    const auto add = [&](Layer& rows, const std::string& name, std::size_t facade,
                         const SurfaceValues::Named& values) {
      const auto& own = of_facade[facade];
      rows.add({{"facade", name},
                {"object", name_at(patches_.object_names, patches_.object[own.front()])}},
               values, shapes_.all(own));
    };
    const auto names = result_.strings("facade_name");
    if (result_.is_comparison() && shown_.is_difference) {
      const auto compared = compared_facades();
      Layer rows(file_, "facades", crs_, wkbMultiPolygon25D,
                 {compared[0].first, compared[1].first});
      for (const auto f : chosen_facades(result_, parts))
        if (!of_facade[f].empty())
          add(rows, names[f], f,
              {{compared[0].first, compared[0].second[f]},
               {compared[1].first, compared[1].second[f]}});
      return;
    }
    if (result_.is_derived() || !rules_.quantity.empty()) {
      Layer rows(file_, "facades", crs_, wkbMultiPolygon25D, values_.names());
      for (const auto f : chosen_facades(result_, parts))
        if (!of_facade[f].empty()) add(rows, names[f], f, values_.of(of_facade[f]));
      return;
    }
    const auto table = group_table(result_, TableOf::facades, parts);
    Layer rows(file_, "facades", crs_, wkbMultiPolygon25D, names_of(table));
    for (std::size_t row = 0; row < table.names.size(); ++row)
      if (!of_facade[table.entries[row]].empty())
        add(rows, table.names[row], table.entries[row], numbers(table, row));
  }

  /// Differences of a comparison over the area that both have, and their standard errors.
  std::array<std::pair<std::string, std::vector<double>>, 2> compared_facades() const {
    const std::string difference = difference_dataset(result_.compared());
    const auto column = [&](const std::string& dataset) {
      return std::pair(sunload_name(column_name(result_, dataset)),
                       result_.doubles("facade_" + dataset));
    };
    return {column(difference), column(difference + "_se")};
  }

  /// Their own totals, whatever quantity of patches was asked for.
  void write_sensors() {
    NamedParts parts;
    parts.sensors = rules_.parts.sensors;
    const auto table = group_table(result_, TableOf::sensors, parts);
    const auto position = result_.doubles("sensor_position");
    Layer rows(file_, "sensors", crs_, wkbPoint25D, names_of(table));
    for (std::size_t row = 0; row < table.names.size(); ++row) {
      const double* at = position.data() + 3 * table.entries[row];
      rows.add({{"sensor", table.names[row]}}, numbers(table, row),
               shapes_.point({at[0], at[1], at[2]}));
    }
    const auto load = result_.doubles("sensor_light_load");
    styles_.push_back({"sensors", "light load",
                       qgis_style(sunload_name(unit_names("light_load_kwh_m2", result_.quantity())),
                                  {0, scale_end({}, load, std::vector<double>(load.size(), 1))},
                                  palette(), StyledAs::dots)});
  }

  std::vector<std::vector<std::size_t>> fronts_by(const std::vector<std::int32_t>& entry,
                                                  std::size_t count) const {
    std::vector<std::vector<std::size_t>> patches(count);
    for (std::size_t p = 0; p < entry.size(); ++p)
      if (entry[p] >= 0 && side_[p] == 0) patches[static_cast<std::size_t>(entry[p])].push_back(p);
    return patches;
  }

  Palette palette() const { return export_palette(rules_, shown_); }

  void styled(const char* layer, StyledAs as) {
    styles_.push_back({layer, shown_.name,
                       qgis_style(sunload_name(column_name(shown_)),
                                  {shown_.scale_begin(largest_), largest_}, palette(), as)});
  }

  /// The table in which QGIS looks for styles, with the columns that it makes itself.
  void write_styles() {
    Layer rows(file_, "layer_styles", nullptr, wkbNone, {"useAsDefault"});
    for (const auto& style : styles_)
      rows.add({{"f_table_catalog", ""},
                {"f_table_schema", ""},
                {"f_table_name", style.layer},
                {"f_geometry_column", "geom"},
                {"styleName", style.name},
                {"styleQML", style.qml},
                {"styleSLD", ""},
                {"description", export_caption(result_, shown_)},
                {"owner", ""},
                {"ui", ""},
                {"update_time", ""}},
               {{"useAsDefault", 1}}, nullptr);
  }

  struct Style {
    std::string layer, name, qml;
  };

  const ResultReader& result_;
  const ExportRules& rules_;
  GDALDatasetH file_;
  OGRSpatialReferenceH crs_;
  ResultPatches patches_;
  SurfaceValues values_;
  Shapes shapes_;
  ShownQuantity shown_;
  double largest_;
  std::vector<std::int32_t> side_;
  std::vector<Style> styles_;
};

}  // namespace

void export_geopackage(const ResultReader& result, const ExportRules& rules,
                       const ExportTarget& target) {
  gdal::GDALAllRegister();
  const QuietErrors quiet;
  const auto driver = gdal::GDALGetDriverByName("GPKG");
  if (driver == nullptr) throw MachineError("GDAL has no driver GPKG here");
  const MemoryFile memory;
  {
    const auto file = owned(gdal::GDALCreate(driver, memory.path(), 0, 0, 0, GDT_Unknown, nullptr),
                            gdal::GDALClose);
    if (!file) fail(target.path);
    const auto crs = owned(gdal::OSRNewSpatialReference(nullptr), gdal::OSRDestroySpatialReference);
    const auto name = result.text_attribute("crs");
    const auto is_set = [&](const char* text) {
      return gdal::OSRSetFromUserInput(crs.get(), text) == OGRERR_NONE;
    };
    // Without any, readers would take metres for degrees.
    constexpr auto* undefined = R"(LOCAL_CS["Undefined Cartesian SRS"])";
    const bool has_crs = (!name.empty() && is_set(name.c_str())) || is_set(undefined);
    gdal::OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    // One transaction: a row for itself would be flushed for itself.
    gdal::GDALDatasetStartTransaction(file.get(), FALSE);
    ResultLayers(result, rules, file.get(), has_crs ? crs.get() : nullptr).write();
    if (gdal::GDALDatasetCommitTransaction(file.get()) != OGRERR_NONE) fail(target.path);
  }
  target.stream << memory.bytes();
}

}  // namespace sunload
