// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/tree_points.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "geo/base/check.h"
#include "geo/sun/map_axes.h"
#include "io/base/file_text.h"
#include "io/base/first_of_many.h"
#include "io/scene/base/from_file.h"
#include "io/scene/raster/layer_columns.h"
#include "io/scene/raster/plan_layer.h"

namespace sunload {

namespace {

using Names = std::vector<std::string_view>;
const Names heights{"height",  "height_m",   "tree_height", "treeheight",
                    "hoogte",  "boomhoogte", "baumhoehe",   "hoehe",
                    "hoehe_m", "hauteur",    "hauteurenm",  "altura",
                    "altezza", "vyska",      "vyska_m",     "hoejde"};
const Names crowns{
    "crown_m",       "crown_diameter", "diameter_crown",    "crown_width",   "crown_spread",
    "crown_diam",    "crown",          "canopy_diameter",   "kroondiameter", "kroon_diameter",
    "kronedurch",    "kronendurch",    "kronendurchmesser", "kronenbreite",  "diametre_couronne",
    "diametro_copa", "prumer_koruny",  "sirka_koruny"};
const Names names{"id", "gml_id", "osm_id", "fid", "tree_id", "treeid", "ref", "name"};
constexpr std::array layer_types{wkbPoint, wkbMultiPoint, wkbUnknown};
constexpr double tallest_m = 150;  // the tallest trees have 116, and no crown is as wide

class TreePointReader {
 public:
  TreePointReader(const std::string& path, const TreePointRules& rules, const std::string& crs,
                  double unit_m)
      : path_(path), rules_(rules), crs_(crs), unit_m_(unit_m) {}

  TreePoints read() {
    dataset_ = open_plan_data(path_);
    if (!dataset_) fail("cannot be read as points of trees", messages_.first());
    layer_ =
        plan_layer(path_, dataset_, rules_.layer, {layer_types, "points", "the trees", "trees"});
    find_columns();
    choose_map();
    gdal::OGR_L_ResetReading(layer_);
    while (const GdalFeature feature{gdal::OGR_L_GetNextFeature(layer_)}) add(feature.get());
    refuse_unshaped();
    if (found_.trees.empty()) fail("has no trees", "points were expected");
    tell();
    return std::move(found_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& why,
                         const std::string& hint = {}) const {
    throw InputError({path_}, what, why, hint);
  }

  void find_columns() {
    columns_.emplace(path_, layer_, unit_m_);
    height_ = columns_->found(rules_.height, heights, "heights of trees", notes_);
    crown_ = columns_->found(rules_.crown, crowns, "widths of crowns", notes_);
    name_ = columns_->found(rules_.name, names, "names of trees", notes_);
    kind_ = columns_->usual(Names{"natural"});
    for (const auto& [found, usual, what, key] :
         {std::tuple{height_, rules_.default_height_m, "heights", "height"},
          std::tuple{crown_, rules_.default_crown_m, "widths of crowns", "crown"}})
      if (found < 0 && !usual)
        fail(fmt::format("no column of {} is known", what), columns_->in_words(),
             fmt::format("name one: trees: {{{}: COLUMN}}, or give {{default_{}_m: …}} for all",
                         key, key));
  }

  /// GeoJSON that names no CRS is in degrees by its standard, and often in metres of the scene's
  /// map: each point tells (`place`).
  void choose_map() {
    OGRSpatialReferenceH crs = gdal::OGR_L_GetSpatialRef(layer_);
    if (crs == nullptr) return;
    if (gdal::OSRIsGeographic(crs) != 0) {
      if (crs_.empty())
        fail("has coordinates in degrees", "the scene has no CRS that they could be brought onto",
             "site.crs names it; or project the trees first, e.g. with ogr2ogr -t_srs");
      from_degrees_.emplace(crs_name(crs), crs_);
      notes_.say("degrees of the trees are projected to " + crs_);
      return;
    }
    const std::string own = crs_name(crs);
    if (!crs_.empty() && !are_of_one_map(own, crs_))
      fail("has coordinates in " + own, "the scene has " + crs_,
           "project it, e.g. ogr2ogr -t_srs " + crs_);
  }

  void add(OGRFeatureH feature) {
    const OGRGeometryH geometry = gdal::OGR_F_GetGeometryRef(feature);
    std::vector<Point2> places;
    if (geometry != nullptr) add_places(geometry, places);
    if (places.empty()) return notes_.count("features that are no points are left out");
    if (kind_ >= 0 && columns_->text(feature, kind_) != "tree")
      return notes_.count("points that are no trees by their column natural are left out");
    const std::string written = columns_->text(feature, name_);
    const std::string name =
        written.empty() ? std::to_string(gdal::OGR_F_GetFID(feature) + 1) : written;
    const auto height = length_m(feature, height_, rules_.default_height_m, name, without_height_);
    const auto crown = length_m(feature, crown_, rules_.default_crown_m, name, without_crown_);
    if (!height || !crown) return;
    for (const Point2 place : places) found_.trees.push_back({place, *height, *crown, name});
  }

  void add_places(OGRGeometryH geometry, std::vector<Point2>& places) const {
    const auto type = gdal::OGR_GT_Flatten(gdal::OGR_G_GetGeometryType(geometry));
    if (type == wkbMultiPoint || type == wkbGeometryCollection)
      for (int k = 0; k < gdal::OGR_G_GetGeometryCount(geometry); ++k)
        add_places(gdal::OGR_G_GetGeometryRef(geometry, k), places);
    else if (type == wkbPoint && gdal::OGR_G_IsEmpty(geometry) == 0)
      places.push_back(place(gdal::OGR_G_GetX(geometry, 0), gdal::OGR_G_GetY(geometry, 0)));
  }

  Point2 place(double x, double y) const {
    constexpr double most_north = 90, most_east = 360;
    const bool is_in_degrees =
        from_degrees_ && std::abs(x) <= most_east && std::abs(y) <= most_north;
    const Vec3 place =
        is_in_degrees ? (*from_degrees_)(x, y, 0) : Vec3{x * unit_m_, y * unit_m_, 0};
    if (!is_usable(place))
      fail(fmt::format("has a tree at {:g}, {:g}", x, y), "that is no place on the scene's map");
    return {place.x, place.y};
  }

  /// Those that have none are counted under their name.
  std::optional<double> length_m(OGRFeatureH feature, int column,
                                 const std::optional<double>& usual, const std::string& name,
                                 FirstOfMany& without) {
    columns_->look_anew();
    const auto written = columns_->length_m(feature, column);
    if (written && *written > tallest_m)
      fail(fmt::format("{} has {:g} m in column {}", name, *written, columns_->name(column)),
           fmt::format("no tree is above {:g} m high or wide", tallest_m),
           "is it in another unit? unit_m of the scene holds for lengths as well");
    if (written && *written > 0) return written;
    const std::string& unread = columns_->last_unread();
    if (usual)
      notes_.count(fmt::format("trees without {} have {:g} m",
                               column == height_ ? "height" : "width of crown", *usual));
    else
      without.add(unread.empty() ? name : fmt::format("{}: '{}'", name, unread));
    return usual;
  }

  void refuse_unshaped() const {
    Problems problems;
    for (const auto& [without, what, key] :
         {std::tuple{&without_height_, "height", "height"},
          std::tuple{&without_crown_, "width of crown", "crown"}})
      if (without->count() > 0)
        problems.add({path_},
                     fmt::format("{} trees have no {} above 0 ({})", without->count(), what,
                                 without->text()),
                     "what is written there is empty or no length",
                     fmt::format("trees: {{default_{}_m: …}} gives them one", key));
    problems.throw_if_any();
  }

  void tell() {
    if (columns_->unread() > 0)
      notes_.say(
          fmt::format("{} lengths of trees are no numbers, such as '{}': they count as not "
                      "written",
                      columns_->unread(), columns_->first_unread()));
    found_.notes = notes_.lines();
  }

  std::string path_;
  TreePointRules rules_;
  std::string crs_;
  double unit_m_;
  GdalMessages messages_;
  GdalDataset dataset_;
  OGRLayerH layer_ = nullptr;
  NoteCounter notes_;
  std::optional<LayerColumns> columns_;
  std::optional<MapFromDegrees> from_degrees_;
  int height_ = -1, crown_ = -1, name_ = -1, kind_ = -1;
  FirstOfMany without_height_, without_crown_;
  TreePoints found_;
};

}  // namespace

TreePoints read_tree_points(const std::string& path, const TreePointRules& rules,
                            const std::string& crs, double unit_m) {
  return TreePointReader(path, rules, crs, unit_m).read();
}

}  // namespace sunload
