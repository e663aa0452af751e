// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/footprints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>

#include "geo/edit/solids.h"
#include "geo/mesh/feet.h"
#include "geo/sun/map_axes.h"
#include "io/scene/base/from_file.h"
#include "io/scene/raster/crossing_outlines.h"
#include "io/scene/raster/fill_holes.h"
#include "io/scene/raster/gdal_file.h"
#include "io/scene/raster/raster.h"
#include "io/scene/raster/written_length.h"

namespace sunload {

namespace {

constexpr double highest_m = 2000;  // no building is higher
constexpr std::size_t most_named = 5;

/// Usual names of columns, the more telling first; lower case.
using Names = std::vector<std::string_view>;
// Not New York's heightroof or Portland's avg_height, which are in feet: who names it sees to the
// unit.
const Names heights{
    "height", "height_m", "building_height", "bldg_height", "measuredheight", "b_hoogte", "hoogte",
    "hoehe",  "hoehe_m",  "hauteur",         "vyska",       "altura",         "altezza",  "h"};
const Names storeys{"building:levels", "building_levels", "storeys",     "stories", "levels",
                    "num_floors",      "num_story",       "num_stories", "floors",  "etages",
                    "geschosse",       "podlazi",         "plantas",     "piani"};
const Names bases{"base_height", "base_m", "ground_height", "ground_elevation"};
// Of OpenStreetMap: where a part of a building begins above the ground.
const Names lower_ends{"min_height"}, lower_levels{"building:min_level", "min_level"};
const Names names{"id", "gml_id", "osm_id", "fid", "egid", "ref", "name"};

struct DestroyFeature {
  void operator()(void* feature) const { gdal::OGR_F_Destroy(feature); }
};
class FootprintReader {
 public:
  FootprintReader(const std::string& path, const SceneFileRules& rules)
      : path_(path), rules_(rules.footprints), map_(rules.map_of_degrees), unit_m_(rules.unit_m) {}

  PolygonModel read() {
    dataset_ =
        open_with_gdal(path_, GDAL_OF_VECTOR, {"GeoJSON", "GPKG", "ESRI Shapefile", "FlatGeobuf"});
    if (!dataset_) fail("cannot be read as footprints");
    layer_ = chosen_layer();
    is_in_degrees_ = is_in_degrees();
    find_columns();
    read_terrain();
    read_crs();
    expect_terrain_of_the_map();
    model_.source = path_;
    model_.is_city_format = true;
    gdal::OGR_L_ResetReading(layer_);
    while (const Feature feature{gdal::OGR_L_GetNextFeature(layer_)}) add(feature.get());
    refuse_without_height();
    if (model_.object_names.empty()) fail_without_polygons();
    tell();
    return std::move(model_);
  }

 private:
  using Feature = std::unique_ptr<void, DestroyFeature>;

  [[noreturn]] void fail_without_polygons() const {
    fail("has no polygons", "footprints were expected");
  }
  [[noreturn]] void fail(const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const {
    throw InputError({path_}, what, why.empty() ? messages_.first() : why, hint);
  }

  // ---- layer and columns

  OGRLayerH chosen_layer() const {
    std::string known;
    OGRLayerH found = nullptr;
    int polygons = 0;
    for (int k = 0; k < gdal::GDALDatasetGetLayerCount(dataset_.get()); ++k) {
      OGRLayerH layer = gdal::GDALDatasetGetLayer(dataset_.get(), k);
      const std::string name = gdal::OGR_L_GetName(layer);
      known += (known.empty() ? "" : ", ") + name;
      if (!rules_.layer.empty()) {
        if (name == rules_.layer) found = layer;
        continue;
      }
      const auto type = gdal::OGR_GT_Flatten(gdal::OGR_L_GetGeomType(layer));
      const bool may_be = type == wkbPolygon || type == wkbMultiPolygon || type == wkbUnknown ||
                          type == wkbCurvePolygon || type == wkbMultiSurface;
      if (!may_be) continue;
      found = layer;
      ++polygons;
    }
    if (polygons > 1)
      fail("has several layers of polygons: " + known, "which are the buildings is not known",
           "name one: footprints: {layer: …}");
    if (found == nullptr)
      fail(
          rules_.layer.empty() ? "has no layer of polygons" : "has no layer '" + rules_.layer + "'",
          "its layers: " + known);
    return found;
  }

  std::vector<std::string> columns() const {
    std::vector<std::string> all;
    OGRFeatureDefnH definition = gdal::OGR_L_GetLayerDefn(layer_);
    const int count = gdal::OGR_FD_GetFieldCount(definition);
    all.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k)
      all.emplace_back(gdal::OGR_Fld_GetNameRef(gdal::OGR_FD_GetFieldDefn(definition, k)));
    return all;
  }

  /// -1: there is none.
  int column(const std::string& wanted, const Names& usual, const char* what) {
    const auto all = columns();
    if (!wanted.empty()) {
      const auto found = std::find(all.begin(), all.end(), wanted);
      if (found == all.end())
        fail(fmt::format("has no column '{}'", wanted),
             all.empty() ? "it has no columns"
                         : fmt::format("its columns: {}", fmt::join(all, ", ")));
      return static_cast<int>(found - all.begin());
    }
    const int found = usual_column(usual);
    if (found >= 0)
      notes_.say(fmt::format("{} of footprints from column {}", what,
                             all[static_cast<std::size_t>(found)]));
    return found;
  }
  /// The first of these that there is; -1: none.
  int usual_column(const Names& usual) const {
    const auto all = columns();
    for (const auto name : usual)
      for (std::size_t k = 0; k < all.size(); ++k)
        if (lower_case(all[k]) == name) return static_cast<int>(k);
    return -1;
  }

  void find_columns() {
    height_ = column(rules_.height, rules_.storeys.empty() ? heights : Names{}, "heights");
    storeys_ = column(rules_.storeys, storeys, "storeys");
    base_ = column(rules_.base, rules_.terrain.empty() ? bases : Names{}, "feet");
    name_ = column(rules_.name, names, "names");
    lower_end_ = usual_column(lower_ends);
    lower_level_ = usual_column(lower_levels);
    if (height_ >= 0 || storeys_ >= 0 || rules_.default_height_m) return;
    const auto all = columns();
    fail("no column of heights is known",
         all.empty() ? "it has no columns" : fmt::format("its columns: {}", fmt::join(all, ", ")),
         "name one: footprints: {height: COLUMN} or {storeys: COLUMN} (of sunload init --height or "
         "--storeys), or give {default_height_m: …} for all");
  }

  // ---- place

  /// The extent that a GeoPackage stores is for information, and often that of a whole country.
  const OGREnvelope& extent_of_polygons() {
    if (extent_) return *extent_;
    OGREnvelope all;
    gdal::OGR_L_ResetReading(layer_);
    while (const Feature feature{gdal::OGR_L_GetNextFeature(layer_)}) {
      const OGRGeometryH geometry = gdal::OGR_F_GetGeometryRef(feature.get());
      if (geometry == nullptr || gdal::OGR_G_IsEmpty(geometry) != 0 ||
          gdal::OGR_G_GetDimension(geometry) < 2)
        continue;
      OGREnvelope one;
      gdal::OGR_G_GetEnvelope(geometry, &one);
      all.Merge(one);
    }
    if (all.IsInit() == 0) fail_without_polygons();
    return extent_.emplace(all);
  }

  void read_crs() {
    OGRSpatialReferenceH crs = gdal::OGR_L_GetSpatialRef(layer_);
    if (crs == nullptr) return notes_.say("the footprints name no CRS: site.crs may");
    if (!is_in_degrees_) {
      const bool says_degrees = gdal::OSRIsGeographic(crs) != 0;
      if (says_degrees)
        notes_.say("numbers of the footprints are no degrees: coordinates of " + map_);
      model_.crs = says_degrees ? map_ : crs_name(crs);
      return;
    }
    const OGREnvelope& extent = extent_of_polygons();
    const double longitude = (extent.MinX + extent.MaxX) / 2,
                 latitude = (extent.MinY + extent.MaxY) / 2;
    constexpr double most_degrees = 3, half_turn = 180;
    constexpr double both_sides = 300;  // of the 180th meridian
    if (std::abs(latitude) < 90 && extent.MaxX <= half_turn && extent.MinX >= -half_turn &&
        extent.MaxX - extent.MinX > both_sides)
      fail("lies on both sides of the 180th meridian",
           "its degrees east are as far apart as they can be",
           "project it first, for example with ogr2ogr -t_srs " + utm_at(latitude, half_turn - 1));
    if (!(std::abs(latitude) < 90 && extent.MaxX - extent.MinX < most_degrees))
      fail(fmt::format("lies between {:g} and {:g} degrees east, {:g} and {:g} north", extent.MinX,
                       extent.MaxX, extent.MinY, extent.MaxY),
           "that is no town",
           "are longitude and latitude exchanged? If these are metres of a map, site.crs names it");
    const bool is_of_terrain = map_.empty() && terrain_ && !terrain_->crs.empty();
    model_.crs = is_of_terrain ? terrain_->crs : !map_.empty() ? map_ : utm_at(latitude, longitude);
    to_map_.emplace(crs_name(crs), model_.crs);
    notes_.say("degrees of the footprints are projected to " + model_.crs);
  }

  /// GeoJSON that names no CRS is in degrees by its standard, and often in metres of the scene's
  /// map.
  bool is_in_degrees() {
    OGRSpatialReferenceH crs = gdal::OGR_L_GetSpatialRef(layer_);
    if (crs == nullptr || gdal::OSRIsGeographic(crs) == 0) return false;
    if (map_.empty()) return true;
    constexpr double most_north = 90, most_east = 360;
    const OGREnvelope& extent = extent_of_polygons();
    return std::max(-extent.MinY, extent.MaxY) <= most_north &&
           std::max(-extent.MinX, extent.MaxX) <= most_east;
  }
  /// Degrees are brought onto a map in metres: the study's unit is that of heights then.
  double map_unit_m() const { return is_in_degrees_ ? 1 : unit_m_; }

  void read_terrain() {
    if (rules_.terrain.empty()) return;
    terrain_ = read_raster(rules_.terrain, map_unit_m(), RasterValues::elevations, notes_);
    // Many terrain models have no data below buildings.
    notes_.count("cells without data in the terrain are filled from what is about them",
                 fill_holes(*terrain_, [](std::size_t) { return true; }).size());
  }

  void expect_terrain_of_the_map() const {
    if (!terrain_) return;
    if (!terrain_->crs.empty() && !model_.crs.empty() && !are_of_one_map(terrain_->crs, model_.crs))
      fail(fmt::format("is on the map {}, its terrain on {}", model_.crs, terrain_->crs),
           "feet would stand on land elsewhere",
           fmt::format("project one of them, e.g. gdalwarp -t_srs {}", model_.crs));
  }

  // ---- features

  /// Storeys with a comma may be a list.
  enum class Commas { decimal, unknown };
  /// Texts that are no number are counted.
  std::optional<WrittenLength> written(OGRFeatureH feature, int column, Commas commas) {
    if (column < 0 || gdal::OGR_F_IsFieldSetAndNotNull(feature, column) == 0) return {};
    const std::string text(trimmed(gdal::OGR_F_GetFieldAsString(feature, column)));
    if (text.empty()) return {};
    auto found = written_length(commas == Commas::decimal ? with_decimal_point(text) : text);
    if (!found) count_unread(text);
    return found;
  }
  void count_unread(const std::string& text) {
    constexpr std::size_t enough = 20;
    last_unread_ = text.substr(0, enough);
    if (unread_++ == 0) first_unread_ = last_unread_;
  }

  std::optional<double> number(OGRFeatureH feature, int column) {
    const auto found = written(feature, column, Commas::unknown);
    if (!found || found->unit.empty()) return found ? std::optional(found->value) : std::nullopt;
    count_unread(fmt::format("{:g} {}", found->value, found->unit));
    return {};
  }

  /// In the unit that stands behind it, as OpenStreetMap has it (`12 m`, `40'`), or in the file's.
  std::optional<double> length_m(OGRFeatureH feature, int column) {
    constexpr double international_foot_m = 0.3048;
    const auto found = written(feature, column, Commas::decimal);
    if (!found) return {};
    return found->value * (found->unit.empty()   ? unit_m_
                           : found->is_in_feet() ? international_foot_m
                                                 : 1);
  }

  std::string title(OGRFeatureH feature) const {
    if (name_ >= 0 && gdal::OGR_F_IsFieldSetAndNotNull(feature, name_) != 0)
      if (std::string name = gdal::OGR_F_GetFieldAsString(feature, name_); !name.empty())
        return name;
    return fmt::format("building_{}", gdal::OGR_F_GetFID(feature) + 1);
  }

  std::optional<double> height_m(OGRFeatureH feature) {
    if (const auto height = length_m(feature, height_); height && *height > 0) return *height;
    if (const auto count = number(feature, storeys_); count && *count > 0)
      return *count * rules_.storey_m;
    if (rules_.default_height_m) ++of_default_height_;
    return rules_.default_height_m;
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
    if (areas.empty()) return notes_.count("features that are no polygons are left out");
    const std::string name = unique_(title(feature));
    last_unread_.clear();
    const auto height = height_m(feature);
    if (!height) return note_without_height(name);
    if (!(*height <= highest_m))
      fail(fmt::format("{} is {:g} m high", name, *height), "no building is",
           "is the column one of heights above the ground?");
    const double foot = foot_m(feature, areas, lowest_z, name);
    const double begins_m = lower_end_m(feature, *height, name);
    add_prism(model_, areas, foot + begins_m, foot + *height,
              {.name = name, .kind = begins_m > 0 ? hanging_kind : "Building", .material = {}});
  }

  void note_without_height(const std::string& name) {
    is_any_unread_ |= !last_unread_.empty();
    if (without_height_++ >= most_named) return;
    named_ += (named_.empty() ? "" : ", ") + name;
    if (!last_unread_.empty()) named_ += fmt::format(": '{}'", last_unread_);
  }

  /// Where a part of a building begins above its foot; 0: there.
  double lower_end_m(OGRFeatureH feature, double height_m, const std::string& name) {
    auto begins_m = length_m(feature, lower_end_);
    if (!begins_m)
      if (const auto levels = number(feature, lower_level_)) begins_m = *levels * rules_.storey_m;
    if (!begins_m || !(*begins_m > 0)) return 0;
    if (*begins_m < height_m) {
      ++raised_;
      return *begins_m;
    }
    if (upside_down_++ < most_named)
      upside_down_named_ +=
          fmt::format("{}{} from {:g} to {:g} m", upside_down_named_.empty() ? "" : ", ", name,
                      *begins_m, height_m);
    return 0;
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
        corners.push_back(on_map(gdal::OGR_G_GetX(ring, k), gdal::OGR_G_GetY(ring, k)));
        if (has_z) lowest_z = std::min(lowest_z, gdal::OGR_G_GetZ(ring, k) * unit_m_);
      }
      area.push_back(std::move(corners));
    }
    corners_ += static_cast<std::size_t>(area.empty() ? 0 : area.front().size());
    if (corners_ > most_corners_of(std::filesystem::file_size(path_)))
      fail("has more corners than its size can hold", "is it damaged?");
    if (!area.empty()) areas.push_back(std::move(area));
  }

  Point2 on_map(double x, double y) const {
    const Vec3 place = to_map_ ? (*to_map_)(x, y, 0) : Vec3{x * map_unit_m(), y * map_unit_m(), 0};
    if (is_usable(place)) return {place.x, place.y};
    if (to_map_) fail(fmt::format("has the corner {:g}, {:g}", x, y), "it cannot be projected");
    fail("lies beyond all coordinates on Earth", "", "is unit_m right?");
  }

  double foot_m(OGRFeatureH feature, const std::vector<PlanArea>& areas, double lowest_z,
                const std::string& name) {
    if (const auto base = length_m(feature, base_)) return *base;
    if (terrain_) {
      double lowest = std::numeric_limits<double>::infinity();
      for (const auto& area : areas)
        for (const Point2 corner : area.front())
          if (const auto land = height_between_cells(*terrain_, map_unit_m(), corner.u, corner.v))
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

  void refuse_without_height() const {
    if (without_height_ == 0) return;
    fail(fmt::format("{} of {} footprints have no height above 0 ({}{})", without_height_,
                     without_height_ + model_.object_names.size(), named_,
                     without_height_ > most_named ? ", …" : ""),
         is_any_unread_ ? "what is written there is no number, nor one with m, ft or '"
                        : "neither a height nor storeys above 0 are written there",
         "footprints: {default_height_m: …} gives them one");
  }

  void tell() {
    if (of_default_height_ > 0)
      notes_.say(fmt::format("{} of {} footprints have no height above 0 and are {:g} m high",
                             of_default_height_, model_.object_names.size(),
                             *rules_.default_height_m));
    if (unread_ > 0)
      notes_.say(
          fmt::format("{} values of heights, storeys or feet are no numbers, such as '{}': "
                      "they count as not written",
                      unread_, first_unread_));
    if (raised_ > 0)
      notes_.say(
          fmt::format("{} of {} footprints begin above the ground, by min_height or "
                      "building:min_level",
                      raised_, model_.object_names.size()));
    if (upside_down_ > 0)
      model_.warnings.push_back(message(
          {path_},
          fmt::format("{} of {} footprints begin no lower than they end, by min_height or "
                      "building:min_level ({}{})",
                      upside_down_, model_.object_names.size(), upside_down_named_,
                      upside_down_ > most_named ? ", …" : ""),
          "they are drawn from their feet on", "correct them, or take them away in scene.edit"));
    if (storeys_ >= 0) notes_.say(fmt::format("a storey is {:g} m high", rules_.storey_m));
    put_notes(notes_, model_);
  }

  std::string path_;
  FootprintRules rules_;
  std::string map_;  ///< for degrees; empty: the terrain's, or UTM
  double unit_m_;
  GdalMessages messages_;
  GdalDataset dataset_;
  OGRLayerH layer_ = nullptr;
  bool is_in_degrees_ = false;
  std::optional<OGREnvelope> extent_;                       ///< once it is asked for
  int height_ = -1, storeys_ = -1, base_ = -1, name_ = -1;  ///< columns
  int lower_end_ = -1, lower_level_ = -1;                   ///< the same
  std::optional<MapFromDegrees> to_map_;                    ///< none: on the map already
  std::optional<Raster> terrain_;
  PolygonModel model_;
  NoteCounter notes_;
  UniqueNames unique_;
  std::size_t without_height_ = 0, corners_ = 0, of_default_height_ = 0, unread_ = 0;
  std::size_t raised_ = 0;       ///< that begin above the ground
  std::size_t upside_down_ = 0;  ///< of those that would, begin no lower than they end
  bool is_any_unread_ = false;   ///< of those without height
  std::string first_unread_, last_unread_;
  std::string named_;              ///< the first of those without height
  std::string upside_down_named_;  ///< the first of those
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
