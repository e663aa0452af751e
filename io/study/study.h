// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A study as the YAML file states it, with defaults filled in (docs/developer/design.md, Study).
///
/// Reading rejects unknown keys (with the nearest name), wrong types, units and
/// ranges, each with file:line:column, all at once. Keys of later versions are
/// refused by name. Every variant is a complete study: the base with the
/// variant's overrides merged in (maps merge, `scene.assign` and `scene.edit` are
/// appended to, other lists are replaced).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geo/base/check.h"
#include "geo/edit/solids.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/mesh_prepare.h"
#include "geo/sky/horizon.h"
#include "geo/sky/irradiance.h"
#include "geo/sky/sky.h"
#include "geo/sun/sun.h"
#include "geo/sun/weather.h"
#include "geo/time/period_parts.h"
#include "geo/time/time.h"
#include "io/base/light_quantity.h"
#include "io/measure/parameters.h"
#include "io/scene/file.h"
#include "io/scene/sensor_file.h"
#include "solver/light/band.h"
#include "solver/light/transport.h"
#include "solver/mesh/oracle.h"
#include "solver/surface/smooth.h"

namespace sunload {

/// Position as written; what is absent comes from the scene's CRS.
struct SiteStudy {
  std::optional<double> latitude_deg, longitude_deg;
  std::string crs;  ///< of the scene's coordinates, overrides the file's own
  std::optional<double> elevation_m;
  /// Must be written unless the period has only `positions` or UTC times.
  std::string timezone = "UTC";
  std::optional<double> north_deg;
  Horizon horizon;
  Where where;
};

struct DaysPeriod {  ///< days × [from, to) in steps, civil time
  std::vector<CivilTime> days;
  double from_s = 0, to_s = 86400;  ///< seconds since midnight
  double step_min = 60;
};
struct RangePeriod {  ///< [start, end) in steps
  ParsedTime start, end;
  double step_min = 60;
};
/// Single instants; each stands for an interval of that length.
struct InstantsPeriod {
  std::vector<ParsedTime> instants;
  double interval_min = 60;
};
/// A place of the sun, and the length of time that it stands there.
struct SunAt {
  double azimuth_deg = 0, elevation_deg = 0, interval_min = 60;
};
/// Places of the sun without a date.
struct PositionsPeriod {
  std::vector<SunAt> positions;
};
struct WeatherPeriod {         ///< `year_of: weather`: one interval per record of the file
  std::optional<int> as_year;  ///< absent: actual years as they are, typical ones as 2001
};
/// Section `period`: the time over which light is computed, in one of five forms.
struct PeriodStudy {
  std::variant<DaysPeriod, RangePeriod, InstantsPeriod, PositionsPeriod, WeatherPeriod> kind;
  Where where;
};

/// Section `sun`: how the sun is computed.
struct SunStudy {
  Refraction refraction = Refraction::spa;
  Ut1 ut1_utc = Ut1::table;
  SunDisk disk = SunDisk::point;
};

/// Of light in bands: sun and sky as Holubář (2007) colours them, or white.
enum class LightColour { sky, white };

/// Where the irradiances of sun and sky come from.
enum class LightSource { clear_sky, weather, fixed };
/// Strength of the sky: that of the source's diffuse irradiance, or the model's own luminance.
enum class SkyScale { diffuse, absolute };

/// The far ground in a season.
struct SeasonAlbedo {
  std::string season;
  double albedo = 0;
  Where where;
};

/// Section `light`: strength and distribution of the light of sun, sky and far ground.
struct LightStudy {
  LightSource source = LightSource::clear_sky;
  ClearSkyModel model = ClearSkyModel::ineichen;
  Turbidity linke_turbidity;
  double dni_w_m2 = 0, dhi_w_m2 = 0;  ///< of `fixed`
  SkyModel sky = SkyModel::perez;
  int sky_type = 12;     ///< of cie_general
  double turbidity = 3;  ///< of preetham, and of the zenith's luminance of absolute CIE skies
  SkyScale sky_scale = SkyScale::diffuse;
  std::optional<double> zenith_luminance_cd_m2;  ///< of absolute skies; absent: by turbidity
  double far_ground_albedo = 0.2;
  bool far_ground_of_weather = false;  ///< in place of the albedo: that of each day of the file
  std::vector<SeasonAlbedo> far_ground_seasons = {};
  Quantity quantity = Quantity::irradiance;
  std::string weather;  ///< file, already resolved; the rest is of `weather` too
  LightColour colour = LightColour::sky;
  std::optional<Stamp> stamp;  ///< absent: the format's own
  Missing missing = Missing::refuse;
  Decomposition decomposition = Decomposition::erbs;
};

/// A date of every year, or of one.
struct SeasonDate {
  std::optional<int> year;
  int month = 1, day = 1;
};
/// An entry of `seasons`: a stretch of time in which materials may be others.
struct SeasonStudy {
  std::string name;
  std::vector<int> months;  ///< whole ones, of every year; empty: …
  SeasonDate first,
      end_date;  ///< … from the first date to before the other, over new year if need be
  Where where;
};
/// Whether a civil time lies in the season.
bool is_in(const SeasonStudy& season, const CivilTime& time);

/// In a season a material is another one.
struct SeasonMaterial {
  std::string season, material;
  Where where;
};

/// Optical properties as written; absent ones fall back as docs/developer/design.md, Study, says.
struct MaterialStudy {
  std::string name;
  std::optional<double> diffuse, mirror;
  std::optional<BandShares> diffuse_rgb;  ///< where written as colour, with `diffuse` its mean
  double emission_w_m2 = 0;               ///< diffuse exitance of an emitter
  double emission_lm_m2 = 0;              ///< the same of a study of illuminance
  std::optional<Sides> sides;
  Where where;
  Smooth smooth;
  double glossy = 0, glossy_exponent = 0;
  double transmittance = 0;  ///< straight through
  std::vector<SeasonMaterial> seasons = {};
  bool diffuse_of_weather = false;  ///< in place of `diffuse`: the ground's albedo of each day
};

/// In what the study computes.
inline double emission_of(const MaterialStudy& material, Quantity quantity) {
  return quantity == Quantity::illuminance ? material.emission_lm_m2 : material.emission_w_m2;
}

/// Areas in plan as written, or of a GeoJSON file.
struct AreasStudy {
  std::vector<PlanArea> areas;
  bool in_degrees = false;  ///< longitude and latitude, where the scene has a CRS
};

/// What is chosen of a scene: whole objects, or faces and patches. All that is written must hold;
/// what is empty chooses all. `*` and `?` are wildcards.
struct SelectionStudy {
  std::string object, kind;
  AreasStudy polygon;          ///< holds the middle: of an object's bounding box, a face, a patch
  std::optional<Point2> near;  ///< the nearest object, or all that come …
  std::optional<double> within_m;
  // Of faces and patches alone.
  std::string facade = {}, surface = {};
  /// From the first, clockwise, to before the second: of the outward normal, from true north.
  std::optional<std::array<double, 2>> azimuth_deg = {};
  /// From the first to below the second: of the middle above the lowest point of its object.
  std::optional<std::array<double, 2>> height_m = {};

  bool is_of_parts() const {
    return !facade.empty() || !surface.empty() || azimuth_deg || height_m;
  }
  /// Whether it ends within faces.
  bool has_ends() const { return height_m || !polygon.areas.empty(); }
  bool chooses() const {
    return !object.empty() || !kind.empty() || near || !polygon.areas.empty() || is_of_parts();
  }
};
/// An entry of `selections`, or where one is named.
struct NamedSelection {
  std::string name;
  SelectionStudy of;
  Where where;
  std::vector<NamedSelection> except = {};  ///< what these choose is left out

  /// Of it, or of what it leaves out.
  bool is_of_parts() const {
    return has([](const auto& each) { return each.is_of_parts(); });
  }
  bool has_ends() const {
    return has([](const auto& each) { return each.has_ends(); });
  }

 private:
  template <class Property>
  bool has(const Property& property) const {
    return property(of) || std::any_of(except.begin(), except.end(), property);
  }
};

/// One rule of `scene.assign`; empty pattern = any. `*` and `?` are wildcards.
struct AssignRule {
  std::string object, surface, material_was, kind;
  std::optional<NamedSelection> selection;  ///< that must hold besides
  std::string material;                     ///< name to be assigned
  Where where;
  bool may_be_overruled = false;  ///< of the study: the variant adds rules of its own, which win
};

/// Key `scene.ground`: the ground that is made.
struct GroundStudy {
  bool wanted = true;
  double margin_m = 50;
  std::string material;
  GroundSurface surface = GroundSurface::feet;
  std::optional<double> height_m;  ///< of a level one; absent: the lowest point of the scene
};

/// One name of `scene.land`.
struct LandName {
  std::string pattern;  ///< of objects, or of what they belong to
  Where where;
};

/// Key `scene.builtin`: a scene that comes with the program (io/scene/builtin.h).
struct BuiltinStudy {
  std::string name;
  std::map<std::string, std::string> parameters;
  Where where;
};

/// One file of the scene, how it is to be understood and where it stands. Paths are absolute or
/// relative to the working directory, already resolved.
///
/// A place in the scene is position + turn · unit_m · (the file's place with its `up` turned to z).
struct SceneFileStudy {
  std::string path;
  Where where;
  char up = 0;                   ///< 'x', 'y', 'z'; 0: scene.up
  std::optional<double> unit_m;  ///< absent: scene.unit_m
  std::string lod;               ///< empty: scene.lod
  std::optional<Vec3> position;  ///< of the file's origin in the scene [m]
  struct EarthPosition {
    double latitude_deg = 0, longitude_deg = 0, height_m = 0;
  };
  std::optional<EarthPosition> earth_position;  ///< the same by way of the scene's CRS
  double turn_deg = 0;   ///< about the file's origin, clockwise seen from above
  std::string material;  ///< of all its faces; empty: as the file says
  /// Raster of bare ground: `path` is a raster of surfaces, made into blocks; or of footprints.
  std::string terrain;
  std::string canopy;         ///< raster of heights of crowns above the ground
  double least_height_m = 2;  ///< of buildings in rasters
  double trunk_share = 0.25;  ///< of a crown's height, free below it
  FootprintRules footprints;  ///< but for their terrain

  bool is_placed() const { return position || earth_position || turn_deg != 0; }
};

/// Removes the chosen objects.
struct RemoveEdit {};
/// Makes the chosen objects higher, or lower below 0 (geo/edit/raise.h).
struct RaiseEdit {
  double by_m = 0;
  std::optional<double> from_m;  ///< above the object's foot; absent: its eaves
};
/// Moves the chosen objects [m].
struct MoveEdit {
  Vec3 by;
};
/// Turns the chosen objects about a vertical axis.
struct TurnEdit {
  double by_deg = 0;            ///< clockwise seen from above
  std::optional<Point2> about;  ///< absent: the middle of what is turned
};
/// Puts a file in the place of the chosen objects.
struct ReplaceEdit {
  SceneFileStudy file;
};
/// Adds the model of a file.
struct AddFileEdit {
  SceneFileStudy file;
};
/// Areas between two heights: a box, or an extruded footprint.
struct AddPrismEdit {
  std::string name, material;
  AreasStudy areas;
  std::optional<double> base_m;  ///< absent: what is below its middle
  double height_m = 0;
};
/// Adds a tree, or a row of trees from `at` to `to`, one every `every_m`.
struct AddTreesEdit {
  std::string name;
  Point2 at{0, 0};
  std::optional<double> base_m;
  std::optional<Point2> to;  ///< of a row
  double every_m = 0;
  TreeShape shape{};
};
/// Adds the trees of a file of points.
struct AddTreePointsEdit {
  std::string name;  ///< before that of each
  std::string path;
  TreePointRules rules;
  double trunk_share = 0.25;  ///< of a tree's height, free of leaves
  std::string leaves, trunk;  ///< materials
};
using EditAction = std::variant<RemoveEdit, RaiseEdit, MoveEdit, TurnEdit, ReplaceEdit, AddFileEdit,
                                AddPrismEdit, AddTreesEdit, AddTreePointsEdit>;
/// One step of `scene.edit`.
struct EditStep {
  SelectionStudy objects;                   ///< not of what is added
  std::optional<NamedSelection> selection;  ///< that must hold besides
  EditAction action;
  Where where;
};

/// A point that sends light, or a row of them.
struct LuminaireStudy {
  Vec3 position;
  std::optional<Vec3> to;  ///< of a row
  double every_m = 0;
  Vec3 towards{0, 0, -1};  ///< of any length
  double turn_deg = 0;     ///< clockwise seen from above
  std::string file;        ///< its photometry, already resolved; empty: even within the beam
  double beam_deg = 360;
  std::optional<double> intensity_cd, flux_lm;  ///< one of them at most
  Where where;
};

/// Section `scene`, with what the study says of its materials.
struct SceneStudy {
  std::vector<SceneFileStudy> files;
  std::optional<BuiltinStudy> builtin;
  std::string parallel_sources;  ///< file of parallel emitters, already resolved; empty: none
  Where parallel_sources_where;
  std::vector<LuminaireStudy> luminaires;
  char up = 0;  ///< 'x', 'y', 'z' or 0: default of the format
  double unit_m = 1;
  std::string lod = "highest";
  VrmlColour vrml_colour = VrmlColour::mean;
  VrmlExcess vrml_excess = VrmlExcess::refuse;
  double emission_scale_w = 1;  ///< power of a VRML emissiveColor of strength 1
  Repair repair = Repair::safe;
  Orientation orient = Orientation::outward;
  std::vector<MaterialStudy> materials;
  std::vector<AssignRule> assign;
  std::vector<LandName> land;         ///< objects that are terrain
  std::vector<NamedSelection> cut;    ///< along whose ends faces are cut
  std::optional<GroundStudy> ground;  ///< absent: the default of the format
  std::vector<EditStep> edit;         ///< one after the other, before preparation
  Where where;
};

/// What decides how fine the mesh is beyond `max_edge_m`.
struct MeshStudy {
  double max_edge_m = 1e9;  ///< absent: input triangles are the roots and may stay leaves
  double min_area_m2 = 0.01;
  Oracle oracle = Oracle::light_load;
  double light_tolerance = 0.07;      ///< of the default oracle
  double light_threshold_m2 = 0.005;  ///< of the historic one
  TVertices t_vertices = TVertices::remove;
  double link_threshold = 0.5;  ///< of the exchange between elements
};

/// Counts per patch are raised until errors are as small as asked for: at least one of these.
struct AccuracyStudy {
  std::optional<double> light_load_relative = {};  ///< standard error / light load
  std::optional<double> irradiance_relative = {};  ///< standard error / irradiance, every instant
};
/// Whether intervals that are shorter than what is asked of them are solved together
/// (io/plan/joined_intervals.h): each by itself, those of a step together, or what pays.
enum class ShortIntervals { each, together, automatic };
/// Section `solver`: how light is computed. Counts are over all realizations together.
struct SolverStudy {
  Transport transport = Transport::gather;
  Jacobi jacobi = Jacobi::incremental;
  std::optional<double> power_per_sample_w;  ///< absent: auto
  Bands bands = Bands::broadband;
  int bounces = 5;
  double unshot = 1e-4;
  Unfollowed unfollowed = Unfollowed::estimate;
  Year year = Year::automatic;
  ShortIntervals short_intervals = ShortIntervals::automatic;
  int lines_per_patch = 256;
  int direct_samples = 16;
  std::optional<int> sun_samples_per_interval = 1;  ///< absent: auto
  int realizations = 8;
  int mirror_depth = 8;
  std::optional<int> batch_suns;  ///< absent: auto, by the length of the period
  std::string isa = "auto";       ///< auto | sse4.2 | avx2 | avx512
  std::uint64_t seed = 1;
  std::optional<AccuracyStudy> accuracy;
  int max_lines_per_patch = 4096;  ///< of accuracy: the most lines, and the most direct samples
};

inline constexpr int float_mantissa_bits = 23;
/// Of what standard errors are stored: nothing, totals, or every interval, too.
enum class StandardErrors { none, totals, instants };
/// What values of stored series are means over: intervals, or steps of the site's clock.
struct SeriesStepStudy {
  /// What a step is: an interval of the period, so many minutes, a day or a month of the calendar.
  enum class Unit { interval, minutes, day, month } unit = Unit::interval;
  int minutes = 0;  ///< of a step in minutes: a divisor of a day
  Where where = {};

  bool is_interval() const { return unit == Unit::interval; }
};
/// Section `output`: what is stored, and where.
struct OutputStudy {
  std::string folder = "results";
  std::vector<std::string> series{"total", "direct", "sky", "mirror", "lamps", "reflected"};
  StandardErrors standard_error = StandardErrors::totals;
  int compression = 4;
  /// Parts of the period that get totals of their own; absent: auto (io/plan/part_totals.h).
  std::optional<std::vector<PartKind>> totals;
  Where totals_where;
  SeriesStepStudy series_step;
  /// Of the mantissa, in stored series: 1 … 23, all of a float (off); none: auto.
  std::optional<int> significant_bits = float_mantissa_bits;
};

/// Points that receive without disturbing the scene, inline or from a file.
struct SensorsStudy {
  std::vector<SensorPoint> points;
  Where where;
};

/// One variant with all its sections.
struct Study {
  std::string name;
  std::string variant = "baseline";
  SiteStudy site;
  PeriodStudy period;
  SunStudy sun;
  LightStudy light;
  SceneStudy scene;
  MeshStudy mesh;
  SolverStudy solver;
  SensorsStudy sensors;
  OutputStudy output;
  std::vector<MeasureParameters> measures = {};
  std::vector<NamedSelection> selections = {};  ///< of unique names
  std::vector<SeasonStudy> seasons = {};  ///< of unique names; of several at once the last rules
};

/// A study file with its variants.
struct StudyFile {
  std::string path;
  std::string yaml;  ///< verbatim
  std::string name;
  std::vector<Study> variants;  ///< at least one, in the order of the file
  std::vector<std::string> warnings;
};

/// Throws InputError with every problem of the file.
StudyFile read_study(const std::string& path);

/// Section `scene` of a study that was run once, with what the variant changes, from the text that
/// its result keeps: nothing is refused, and files need not be there any more. Their paths are
/// relative to the study's folder.
SceneStudy scene_of_text(const std::string& yaml, const std::string& variant);

/// Canonical text (JSON, sorted keys, numbers with all digits) of every value
/// that can change a number of the result: not names, `output`, or paths (the
/// bytes of the files are hashed apart, and so is the instruction set in force,
/// which `solver.isa` only pins). Equal texts, equal results.
std::string canonical_text(const Study& study);

/// The same of measures and selections, which are no part of it: batches know nothing of them.
/// Empty where there are none.
std::string measures_text(const Study& study);
/// Of one of them.
std::string measure_text(const MeasureParameters& measure);

/// Every key that the reader knows, sorted: `scene.materials.*.diffuse`,
/// `period.positions[].azimuth_deg`; `*` is a name of the user's choice.
std::vector<std::string> study_keys();

}  // namespace sunload
