// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/footprints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "geo/edit/solids.h"
#include "geo/mesh/feet.h"
#include "geo/sun/map_axes.h"
#include "io/scene/base/from_file.h"
#include "io/scene/raster/crossing_outlines.h"
#include "io/scene/raster/fill_holes.h"
#include "io/scene/raster/footprint_map.h"
#include "io/scene/raster/footprint_table.h"
#include "io/scene/raster/plan_layer.h"
#include "io/scene/raster/raster.h"

namespace sunload {

namespace {

constexpr double highest_m = 2000;  // no building is higher
constexpr std::array layer_types{wkbPolygon, wkbMultiPolygon, wkbUnknown, wkbCurvePolygon,
                                 wkbMultiSurface};

class FootprintReader {
 public:
  FootprintReader(const std::string& path, const SceneFileRules& rules)
      : path_(path),
        rules_(rules.footprints),
        map_of_degrees_(rules.map_of_degrees),
        unit_m_(rules.unit_m) {}

  PolygonModel read() {
    dataset_ = open_plan_data(path_);
    if (!dataset_) fail("cannot be read as footprints");
    layer_ = plan_layer(path_, dataset_, rules_.layer,
                        {layer_types, "polygons", "the buildings", "footprints"});
    map_.emplace(path_, layer_, map_of_degrees_, unit_m_);
    table_.emplace(path_, layer_, rules_, unit_m_, notes_);
    read_terrain();
    map_->choose(terrain_ ? terrain_->crs : std::string(), notes_);
    expect_terrain_of_the_map();
    model_.crs = map_->crs();
    model_.source = path_;
    model_.is_city_format = true;
    gdal::OGR_L_ResetReading(layer_);
    while (const GdalFeature feature{gdal::OGR_L_GetNextFeature(layer_)}) add(feature.get());
    table_->refuse_without_height(model_.object_names.size());
    if (model_.object_names.empty()) fail_without_polygons(path_);
    tell();
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const {
    throw InputError({path_}, what, why.empty() ? messages_.first() : why, hint);
  }

  void read_terrain() {
    if (rules_.terrain.empty()) return;
    terrain_ = read_raster(rules_.terrain, map_->unit_m(), RasterValues::elevations, notes_);
    // Many terrain models have no data below buildings.
    notes_.count("cells without data in the terrain are filled from what is about them",
                 fill_holes(*terrain_, [](std::size_t) { return true; }).size());
  }

  void expect_terrain_of_the_map() const {
    if (!terrain_) return;
    if (!terrain_->crs.empty() && !map_->crs().empty() &&
        !are_of_one_map(terrain_->crs, map_->crs()))
      fail(fmt::format("is on the map {}, its terrain on {}", map_->crs(), terrain_->crs),
           "feet would stand on land elsewhere",
           fmt::format("project one of them, e.g. gdalwarp -t_srs {}", map_->crs()));
  }

  void add(OGRFeatureH feature) {
    OGRGeometryH geometry = gdal::OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr) return notes_.count("features without a footprint are left out");
    const auto type = gdal::OGR_GT_Flatten(gdal::OGR_G_GetGeometryType(geometry));
    if (type == wkbCurvePolygon || type == wkbMultiSurface) {
      gdal::OGR_F_SetGeometryDirectly(feature, gdal::OGR_G_GetLinearGeometry(geometry, 0, nullptr));
      geometry = gdal::OGR_F_GetGeometryRef(feature);
    }
    std::vector<PlanArea> areas;
    double lowest_z = std::numeric_limits<double>::infinity();
    add_areas(geometry, areas, lowest_z);
    if (areas.empty())
      return notes_.count(type == wkbPoint || type == wkbMultiPoint
                              ? "points among the footprints are left out (of trees: scene.edit "
                                "adds them, add: {trees: {file: …}})"
                              : "features that are no polygons are left out");
    const std::string name = unique_(table_->name_of(feature));
    const auto height = table_->height_m(feature, name);
    if (!height) return;
    if (!(*height <= highest_m))
      fail(fmt::format("{} is {:g} m high", name, *height), "no building is",
           "is the column one of heights above the ground?");
    const double foot = foot_m(feature, areas, lowest_z, name);
    const double begins_m = table_->lower_end_m(feature, *height, name);
    add_prism(model_, areas, foot + begins_m, foot + *height,
              {.name = name, .kind = begins_m > 0 ? hanging_kind : "Building", .material = {}});
  }

  /// Of a polygon, or of several.
  void add_areas(OGRGeometryH geometry, std::vector<PlanArea>& areas, double& lowest_z,
                 bool is_cut = false) {
    const auto type = gdal::OGR_GT_Flatten(gdal::OGR_G_GetGeometryType(geometry));
    if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
      for (int k = 0; k < gdal::OGR_G_GetGeometryCount(geometry); ++k)
        add_areas(gdal::OGR_G_GetGeometryRef(geometry, k), areas, lowest_z, is_cut);
      return;
    }
    if (type != wkbPolygon) return;
    const GdalGeometry cut =
        !is_cut && crosses_itself(geometry) ? cut_at_crossings(geometry) : nullptr;
    if (!cut) return add_area(geometry, areas, lowest_z);
    notes_.count("polygons whose outlines cross or touch themselves are cut there");
    add_areas(cut.get(), areas, lowest_z, true);
  }

  void add_area(OGRGeometryH polygon, std::vector<PlanArea>& areas, double& lowest_z) {
    constexpr int least_corners = 4;  // the first one twice
    PlanArea area;
    for (int r = 0; r < gdal::OGR_G_GetGeometryCount(polygon); ++r) {
      OGRGeometryH ring = gdal::OGR_G_GetGeometryRef(polygon, r);
      const int count = gdal::OGR_G_GetPointCount(ring);
      if (count < least_corners) {
        if (r == 0) return;
        continue;
      }
      const bool has_z = gdal::OGR_G_Is3D(ring) != 0;
      std::vector<Point2> corners;
      for (int k = 0; k < count; ++k) {
        corners.push_back(map_->place(gdal::OGR_G_GetX(ring, k), gdal::OGR_G_GetY(ring, k)));
        if (has_z) lowest_z = std::min(lowest_z, gdal::OGR_G_GetZ(ring, k) * unit_m_);
      }
      area.push_back(std::move(corners));
    }
    corners_ += static_cast<std::size_t>(area.empty() ? 0 : area.front().size());
    if (corners_ > most_corners_of(std::filesystem::file_size(path_)))
      fail("has more corners than its size can hold", "is it damaged?");
    if (!area.empty()) areas.push_back(std::move(area));
  }

  double foot_m(OGRFeatureH feature, const std::vector<PlanArea>& areas, double lowest_z,
                const std::string& name) {
    if (const auto base = table_->foot_m(feature)) return *base;
    if (terrain_) {
      double lowest = std::numeric_limits<double>::infinity();
      for (const auto& area : areas)
        for (const Point2 corner : area.front())
          if (const auto land = height_between_cells(*terrain_, map_->unit_m(), corner.u, corner.v))
            lowest = std::min(lowest, *land);
      if (std::isfinite(lowest)) return lowest;
      fail(name + " lies outside of the terrain",
           rules_.terrain + " has no data below it, nor on most sides about it",
           "take a larger raster, or footprints: {base: COLUMN}");
    }
    if (std::isfinite(lowest_z)) return lowest_z;
    notes_.say("footprints stand at the height 0: neither column nor terrain tells another");
    return 0;
  }

  void tell() {
    table_->note(model_.object_names.size());
    if (const auto warning = table_->warning(model_.object_names.size()); !warning.empty())
      model_.warnings.push_back(warning);
    put_notes(notes_, model_);
  }

  std::string path_;
  FootprintRules rules_;
  std::string map_of_degrees_;
  double unit_m_;
  GdalMessages messages_;
  GdalDataset dataset_;
  OGRLayerH layer_ = nullptr;
  NoteCounter notes_;
  std::optional<FootprintMap> map_;
  std::optional<FootprintTable> table_;
  std::optional<Raster> terrain_;
  PolygonModel model_;
  UniqueNames unique_;
  std::size_t corners_ = 0;
};

}  // namespace

bool is_footprint_file(const std::string& path, std::string_view head) {
  const std::string extension = lower_extension(path);
  constexpr std::string_view shapefile("\0\0\x27\x0A", 4);
  if (head.starts_with("SQLite format 3") || head.starts_with(shapefile) || head.starts_with("fgb"))
    return true;
  return head.starts_with('{') &&
         (extension == ".geojson" || head.find("\"FeatureCollection\"") != std::string_view::npos);
}

PolygonModel read_scene_footprints(const std::string& path, const SceneFileRules& rules) {
  return FootprintReader(path, rules).read();
}

}  // namespace sunload
