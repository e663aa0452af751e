// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a model and a weather file tell about a study of them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geo/base/vec.h"
#include "geo/mesh/mesh.h"
#include "geo/sun/site.h"
#include "io/init/zone_guess.h"
#include "io/plan/scene_build.h"
#include "io/weather/file.h"

namespace sunload {

/// What the user gives of it.
struct InitRules {
  std::string model = {};                 ///< any scene file
  std::string weather = {};               ///< empty: clear sky
  std::string terrain = {}, canopy = {};  ///< rasters beside a raster of surfaces
  std::string height = {}, storeys = {};  ///< columns of footprints; empty: of usual names
  std::string crs = {};                   ///< empty: what the model names
  std::string at = {};         ///< latitude and longitude in words (site_from_text); empty: unknown
  std::string zone = {};       ///< empty: a guess
  std::string up = {};         ///< x, y, z; empty: of the format
  bool is_up_guessed = false;  ///< by what lies at the foot
  std::vector<std::string> land = {};  ///< objects that are terrain: a guess
  double unit_m = 1;
  bool is_unit_of_crs = false;             ///< by the CRS, not said by the user
  std::vector<std::string> measures = {};  ///< rules of planning, by their words
};

/// Areas of the surfaces that could be patches [m2].
using Areas = std::array<double, surface_names.size()>;

/// A material of the model, and the area that it has.
struct FoundMaterial {
  FileMaterial material;
  double area_m2 = 0;
};

/// What `init` knows before it writes a study.
struct Findings {
  std::string crs;           ///< empty: none is known
  std::optional<Site> site;  ///< nothing where no place is known
  double unit_of_crs_m = 1;  ///< of its coordinates
  std::string site_source;
  std::string sunk_into;       ///< an object that houses of others are sunk into; empty: none
  bool is_at_station = false;  ///< the place is that of the weather station
  std::optional<ZoneGuess> zone;
  std::optional<double> station_away_m;

  std::size_t polygons = 0, triangles = 0, objects = 0;
  std::map<std::string, std::size_t> kinds;  ///< of city objects, with their count
  Vec3 size;                                 ///< of the bounding box [m]
  Vec3 middle;                               ///< its place in the file's coordinates
  Areas area{}, undetermined{};              ///< … of it: no reflectance in the file
  std::vector<FoundMaterial> materials;
  bool has_ground = false, is_city_format = false;
  /// Of the model's plan, covered by faces at its foot that may be its ground; 0: there are none.
  double foot_share = 0;
  bool is_on_its_side = false;  ///< land seems to look along +y, and no one has chosen z
  bool is_raster = false;       ///< of heights, which are the ground, too
  bool has_excess = false;      ///< colours of VRML that reflect more than arrives
  std::vector<std::string> warnings;
  std::vector<std::string> footprint_notes;  ///< what columns of plan data were taken

  std::optional<WeatherFile> weather;
  bool is_year_too_long = false;  ///< of the weather, for a first picture
  /// Of the rules that would be written those that give no surface its material, by their place.
  std::set<std::size_t> idle_rules;
  /// Of the weather, that lack what light is made from, or have no row.
  std::size_t records_incomplete = 0;
  WeatherSource weather_source = WeatherSource::none;
  bool is_stamp_known = true;  ///< else stamps of the weather are taken as ends of intervals
};

/// Reads both files. Throws InputError.
Findings findings_of(const InitRules& rules);
/// The scene's part of a study of these files, as `findings_of` reads it.
SceneFileStudy scene_file_of(const InitRules& rules);

}  // namespace sunload
