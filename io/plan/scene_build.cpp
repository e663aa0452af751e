// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/mesh/covered.h"
#include "geo/mesh/dark_backs.h"
#include "geo/mesh/overlap.h"
#include "geo/sun/map_axes.h"
#include "geo/sun/weather.h"
#include "io/plan/far_places.h"
#include "io/plan/luminaires.h"
#include "io/plan/material_assign.h"
#include "io/plan/scene_cut.h"
#include "io/plan/scene_doubts.h"
#include "io/plan/scene_edit.h"
#include "io/plan/scene_gaps.h"
#include "io/plan/scene_land.h"
#include "io/plan/scene_models.h"
#include "io/plan/true_lengths.h"
#include "io/plan/weather_light.h"
#include "io/scene/file.h"

namespace sunload {

namespace {

/// Where a sensor looks, in the frame of the scene.
Vec3 normal_of(const SensorPoint& point, double north_deg) {
  if (!point.tilted) return point.normal;
  const auto [tilt_deg, azimuth_deg] = *point.tilted;
  return enu_direction({.azimuth_deg = azimuth_deg - north_deg, .elevation_deg = 90 - tilt_deg});
}

/// Sensors in the mesh's frame; a warning where they stand far from the scene.
std::vector<Sensor> place_sensors(const SensorsStudy& study, const Mesh& mesh, double north_deg,
                                  const Box& bounds, std::vector<std::string>& warnings) {
  std::vector<Sensor> sensors;
  sensors.reserve(study.points.size());
  FarPlaces far(mesh.origin, bounds);
  for (const auto& point : study.points) {
    const Vec3 at = point.position - mesh.origin;
    const Vec3 normal = normalized(normal_of(point, north_deg));
    sensors.push_back({at, normal, key_of_place(point.position, normal)});
    far.look_at(at);
  }
  clear_of_surfaces(mesh, sensors);
  if (far.any())
    warnings.push_back(message(study.where, far.words("sensors", "sensor"), "they see little of it",
                               FarPlaces::hint));
  return sensors;
}

PrepareRules prepare_rules(const Study& study, const PolygonModel& model, const Site& site) {
  PrepareRules rules;
  rules.north_deg = site.north_deg;
  rules.repair = study.scene.repair;
  rules.orientation = study.scene.orient;
  for (const SensorPoint& sensor : study.sensors.points) rules.beside.push_back(sensor.position);
  for (const LuminaireStudy& lamp : study.scene.luminaires) {
    rules.beside.push_back(lamp.position);
    if (lamp.to) rules.beside.push_back(*lamp.to);
  }
  const auto& ground = study.scene.ground;
  if (ground ? ground->wanted : model.is_city_format)
    rules.ground =
        ground ? GroundRules{ground->margin_m, ground->surface, ground->height_m} : GroundRules{};
  return rules;
}

bool is_any_in_metres(const SceneStudy& scene) {
  return std::any_of(scene.files.begin(), scene.files.end(), [&](const SceneFileStudy& file) {
    return !file.is_placed() && file.unit_m.value_or(scene.unit_m) == 1;
  });
}

/// Coordinates of a map in feet that nobody makes metres of.
std::string unit_warning(const SceneStudy& scene, const std::string& crs) {
  const MapAxes axes(crs);
  if (!axes.is_known() || axes.unit_m() == 1 || !is_any_in_metres(scene)) return {};
  return message(scene.where,
                 fmt::format("'{}' is in units of {:.6g} m, and the model is taken to be in metres",
                             crs, axes.unit_m()),
                 {}, fmt::format("scene.unit_m: {:.10g} makes metres of them", axes.unit_m()));
}

/// Site of the scene's middle on its map; `built` gets where it comes from and what is doubtful.
/// Where the study gives a position a map of no use is only warned about.
Site site_on_map(const Study& study, const std::string& crs, const PolygonModel& model,
                 BuiltScene& built) {
  const SiteStudy& given = study.site;
  constexpr double far_m = 10000;  // moves the sun by up to 0.1 degrees
  const Box box = bounding_box(model.vertices);
  Vec3 middle = (box.low + box.high) / 2;
  middle.z = box.low.z;
  Site site;
  try {
    site = site_from_crs(crs, middle);
  } catch (const InputError& error) {
    // What belongs to the map has no place of its own: the key stands with the site.
    if (!given.latitude_deg && !given.crs.empty())
      throw InputError(message(given.where, error.problems().front()));
    if (!given.latitude_deg) throw;
    built.warnings.push_back(std::string(error.problems().front()) +
                             "; north and elevation are not taken from it");
    built.site_source = "position from the study";
    return site;
  }
  built.site_source = given.latitude_deg ? "position from the study, north from " + crs
                                         : "position and north from " + crs;
  const std::string of_lengths =
      true_lengths_warning(crs, middle, site, given.where,
                           "heights are not, and shadows would reach too far or not far enough",
                           "convert the model to a projection that keeps lengths, such as");
  for (const auto& warning :
       {of_lengths, unit_warning(study.scene, crs), area_of_use_warning(crs, middle),
        north_warning(given, crs, site.north_deg)})
    if (!warning.empty()) built.warnings.push_back(warning);
  if (!given.latitude_deg) return site;
  const double away_m = distance_m(site, {.latitude_deg = *given.latitude_deg,
                                          .longitude_deg = given.longitude_deg.value_or(0)});
  if (away_m > far_m)
    built.warnings.push_back(fmt::format(
        "the position of the study is {:.0f} km from where {} puts the scene (latitude {:.4f}, "
        "longitude {:.4f}); the sun is that of the study's position",
        away_m / 1000, crs, site.latitude_deg, site.longitude_deg));
  return site;
}

Site resolve_site(const Study& study, const PolygonModel& model, BuiltScene& built) {
  const SiteStudy& given = study.site;
  const std::string crs = given.crs.empty() ? model.crs : given.crs;
  std::string& source = built.site_source;
  Site site;
  if (!crs.empty() && !model.vertices.empty()) {
    site = site_on_map(study, crs, model, built);
  } else if (const auto station = given.latitude_deg ? std::nullopt : weather_place(study)) {
    site.latitude_deg = station->latitude_deg;
    site.longitude_deg = station->longitude_deg;
    site.elevation_m = station->elevation_m;
    source = "position and elevation of the weather station " + station->name;
  } else if (!given.latitude_deg && !std::holds_alternative<PositionsPeriod>(study.period.kind)) {
    throw InputError(given.where, "site has no position",
                     "neither latitude_deg and longitude_deg nor a CRS is known",
                     "write site.latitude_deg and site.longitude_deg, or site.crs");
  }
  if (given.latitude_deg) {
    site.latitude_deg = *given.latitude_deg;
    site.longitude_deg = given.longitude_deg.value_or(0);
    if (source.empty()) source = "position from the study";
  }
  if (given.elevation_m) site.elevation_m = *given.elevation_m;
  if (given.north_deg) {
    site.north_deg = *given.north_deg;
    source += "; north_deg from the study";
  }
  site.timezone = given.timezone;
  site.horizon = given.horizon;
  return site;
}

PolygonModel model_of_parallel_sources(const SceneStudy& scene) {
  return read_scene_file(scene.parallel_sources, {scene.up, scene.unit_m, scene.lod,
                                                  scene.vrml_colour, scene.emission_scale_w});
}

/// Parallel emitters: of the file's materials only what they emit is read.
ParallelSources read_parallel_sources(const Study& study, Vec3 origin, BuiltScene& built) {
  const SceneStudy& scene = study.scene;
  if (scene.parallel_sources.empty()) return {};
  const PolygonModel model = model_of_parallel_sources(scene);
  built.files.insert(built.files.end(), model.files.begin(), model.files.end());
  const Mesh mesh =
      prepare(model,
              {.repair = scene.repair, .ground = {}, .orientation = scene.orient, .north_deg = 0})
          .mesh;
  std::vector<double> area(mesh.file_materials.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.triangle_material[t].exists())
      area[mesh.triangle_material[t].index()] += mesh.area_m2(t);
  const auto exitance = [&](MaterialId id) {
    if (!id.exists()) return 0.0;
    const FileMaterial& file = mesh.file_materials[id.index()];
    const auto named = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const MaterialStudy& m) { return m.name == file.name; });
    return named != scene.materials.end() ? emission_of(*named, study.light.quantity)
                                          : file.emitted_power_w / area[id.index()];
  };
  ParallelSources sources;
  for (const Vec3 p : mesh.vertices) sources.mesh.vertices.push_back(p + mesh.origin - origin);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double M = exitance(mesh.triangle_material[t]);
    if (M <= 0) continue;
    sources.mesh.triangles.push_back(mesh.triangles[t]);
    sources.exitance.push_back(M);
  }
  if (sources.exitance.empty())
    throw InputError(
        scene.parallel_sources_where,
        "scene.parallel_sources: nothing in " + scene.parallel_sources + " emits",
        "no material of it has an emission",
        "write scene.materials: {NAME: {emission_w_m2: …}} for a material of that file");
  if (const std::size_t dark = mesh.triangle_count() - sources.exitance.size(); dark > 0)
    built.notes.push_back(fmt::format("{}: {} triangles that emit nothing are left out",
                                      scene.parallel_sources, dark));
  return sources;
}

}  // namespace

BuiltScene scene_before_materials(const Study& study) {
  BuiltScene built;
  PolygonModel as_read = read_models(study);
  call_land(study.scene, as_read);
  // Steps that edit it leave the site where it is: variants have one sun, and stay paired.
  const bool is_empty = as_read.vertices.empty(), had_polygons = as_read.polygon_count() > 0;
  if (!is_empty) built.site = resolve_site(study, as_read, built);
  const auto [model, placed] = edited(std::move(as_read), study);
  built.placed = placed;
  if (had_polygons && model.polygon_count() == 0)
    throw InputError(study.scene.edit.back().where, "scene.edit leaves nothing of the scene",
                     "its steps take out all that the files have", "let some object stay");
  if (is_empty) built.site = resolve_site(study, model, built);
  built.files = model.files;
  built.notes = model.notes;
  built.warnings.insert(built.warnings.end(), model.warnings.begin(), model.warnings.end());
  built.crs = study.site.crs.empty() ? model.crs : study.site.crs;
  built.crs_unit_m = crs_unit_m(study.scene, built.crs);
  PreparedMesh prepared = prepare(model, prepare_rules(study, model, built.site));
  built.report = std::move(prepared.report);
  built.warnings.insert(built.warnings.end(), built.report.warnings.begin(),
                        built.report.warnings.end());
  built.scene.mesh = std::move(prepared.mesh);
  built.bodies = std::move(prepared.bodies);
  warn_of_gaps(study, model.is_city_format ? SceneKind::city : SceneKind::plain, built);
  if (const auto lying = on_its_side_warning(study, built, model.is_city_format); !lying.empty())
    built.warnings.push_back(lying);
  if (const auto unit = unit_warning(study, built, model.is_city_format); !unit.empty())
    built.warnings.push_back(unit);
  if (const auto lone = lone_piece_warning(study, built); !lone.empty())
    built.warnings.push_back(lone);
  warn_of_no_land(study.scene, built.scene.mesh, built.warnings);
  built.seals = std::move(prepared.seals);
  built.facades = std::move(prepared.facades);
  cut_at_selections(study.scene, built);
  return built;
}

void turn_to_north(const Study& study, BuiltScene& built) {
  const double north_deg = study.site.north_deg.value_or(0);
  if (north_deg == built.site.north_deg) return;
  built.site.north_deg = north_deg;
  turn_facades(built.scene.mesh, built.facades, north_deg);
}

namespace {

/// What follows from surfaces that lie in others, in words.
struct Consequence {
  const char *of, *why, *what_to_try;
};
constexpr Consequence are_left_out{
    "that lie in other surfaces and face the same way are left out",
    "a place receives light once; what emits stays, then windows, then what comes first",
    "leave one of the two out of the files; a plate of the model's own goes with scene.ground: "
    "{surface: none}"};
constexpr Consequence receive_twice{
    "lie in other surfaces that face the same way",
    "both receive the light of one, and what they send on counts twice",
    "leave one of the two out of the files, or to scene.repair: safe"};

/// A plate under the made ground, a house that two files have. `mesh`: what the triangles are of.
void warn_of_doubled(const Doubled& doubled, const Mesh& mesh, const Consequence& consequence,
                     BuiltScene& built) {
  constexpr double worth_telling_m2 = 1e-3;
  if (doubled.area_m2 < worth_telling_m2) return;
  const auto name = [&](std::size_t t) {
    return mesh.object_names[mesh.triangle_object[t].index()];
  };
  built.warnings.push_back(
      message({},
              fmt::format("{:.4g} m2 {} (first {} in {})", doubled.area_m2, consequence.of,
                          name(doubled.first[1]), name(doubled.first[0])),
              consequence.why, consequence.what_to_try));
}

/// Of each triangle one of its facts.
std::vector<std::uint8_t> flags_of(const FactsOfScene& facts, bool SurfaceFacts::*fact) {
  std::vector<std::uint8_t> flags(facts.of_triangle.size());
  std::ranges::transform(facts.of_triangle, flags.begin(),
                         [fact](const SurfaceFacts& of) { return of.*fact ? 1 : 0; });
  return flags;
}

/// What has a dark back is lit from one side.
void mark_dark_backs(const Mesh& mesh, const Bodies& bodies, FactsOfScene& facts) {
  const auto backs = dark_backs(mesh, bodies, flags_of(facts, &SurfaceFacts::is_opaque));
  for (std::size_t t = 0; t < backs.size(); ++t) {
    if (backs[t] == 0) continue;
    facts.of_triangle[t].is_two_sided = false;
    facts.of_triangle[t].has_dark_back = true;
  }
}

}  // namespace

// Materials are assigned anew afterwards, since a file's power is shared by what is left of its
// lamps. Light that panes transmit leaves the scene: they cover as walls do.
FactsOfScene surface_facts(const Study& study, const BuiltScene& prepared) {
  FactsOfScene facts;
  if (study.scene.repair == Repair::none) return facts;
  Scene scene;
  scene.mesh = prepared.scene.mesh;
  std::vector<std::string> said_later;
  assign_materials(study, {prepared.crs, prepared.site.north_deg}, scene, said_later);
  facts.of_triangle.resize(scene.material.size());
  bool has_lamps = !study.scene.luminaires.empty() || !study.scene.parallel_sources.empty();
  for (std::size_t t = 0; t < scene.material.size(); ++t) {
    const Material& material = scene.material_of(t);
    facts.of_triangle[t] = {.is_opaque = material.transmittance == 0,
                            .is_two_sided = scene.mesh.triangle_sides[t] == Sides::two,
                            .emits = material.emission_w_m2 > 0};
    has_lamps |= material.emission_w_m2 > 0;
  }
  if (has_lamps)
    facts.cavities = Cavities::lit;
  else
    mark_dark_backs(scene.mesh, prepared.bodies, facts);
  return facts;
}

std::string FactsOfScene::key() const {
  std::string key(cavities == Cavities::lit ? "lit" : "dark");
  for (const SurfaceFacts& of : of_triangle)
    key += static_cast<char>('0' + of.is_opaque + 2 * of.is_two_sided + 4 * of.emits +
                             8 * of.has_dark_back);
  return key;
}

namespace {

/// Results are of patches, and sensors beside them.
void expect_patches(const Study& study, const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.bears_patches(t)) return;
  throw InputError(study.scene.where, "no surface of the scene can receive light",
                   "all of them are floors, or covered by others",
                   "give it ground (scene.ground), or other surfaces");
}

}  // namespace

BuiltScene scene_uncovered(const Study& study, const BuiltScene& prepared,
                           const FactsOfScene& facts) {
  BuiltScene built = prepared;
  if (study.scene.repair != Repair::none) {
    Mesh& mesh = built.scene.mesh;
    const auto sides_of_files = mesh.triangle_sides;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      mesh.triangle_sides[t] = facts.of_triangle[t].is_two_sided ? Sides::two : Sides::one;
    const CoveredCut cut =
        cut_covered(mesh, built.bodies, flags_of(facts, &SurfaceFacts::is_opaque), built.seals,
                    flags_of(facts, &SurfaceFacts::emits), facts.cavities);
    for (std::size_t t = 0; t < cut.source.size(); ++t) {
      mesh.triangle_sides[t] = sides_of_files[cut.source[t]];
      const bool is_dark = facts.of_triangle[cut.source[t]].has_dark_back;
      built.dark_backs.push_back(is_dark);
      if (is_dark && mesh.bears_patches(t)) built.report.dark_backs_m2 += mesh.area_m2(t);
    }
    if (cut.covered > 0 || cut.taken.area_m2 > 0) measure(mesh, built.report);
    warn_of_doubled(cut.taken, prepared.scene.mesh, are_left_out, built);
  }
  warn_of_doubled(find_doubled(built.scene.mesh), built.scene.mesh, receive_twice, built);
  expect_patches(study, built.scene.mesh);
  tell_of_hidden(study, built);
  built.bodies = {};
  built.seals.clear();
  return built;
}

void take_dark_backs(const BuiltScene& built, Mesh& mesh) {
  for (std::size_t t = 0; t < built.dark_backs.size(); ++t)
    if (built.dark_backs[t] != 0) mesh.triangle_sides[t] = Sides::one;
}

void give_materials(const Study& study, BuiltScene& built) {
  built.sides_of_files = built.scene.mesh.triangle_sides;
  built.rules =
      assign_materials(study, {built.crs, built.site.north_deg}, built.scene, built.warnings);
  take_dark_backs(built, built.scene.mesh);
  warn_of_reflectances(study, built);
  if (std::string open = open_panes_note(built.scene); !open.empty())
    built.notes.push_back(std::move(open));
  if (const auto uncut = uncut_warning(study.scene, built); !uncut.empty())
    built.warnings.push_back(uncut);
  built.scene.parallel_sources = read_parallel_sources(study, built.scene.mesh.origin, built);
  built.scene.luminaires = place_luminaires(study.scene.luminaires, built.scene.mesh,
                                            built.report.bounds, built.warnings);
  built.scene.sensors = place_sensors(study.sensors, built.scene.mesh, built.site.north_deg,
                                      built.report.bounds, built.warnings);
  if (const auto inside = sensors_in_bodies_warning(study.sensors, built.scene); !inside.empty())
    built.warnings.push_back(inside);
}

double crs_unit_m(const SceneStudy& scene, const std::string& crs) {
  if (crs.empty() || is_any_in_metres(scene)) return 1;
  const MapAxes axes(crs);
  return axes.is_known() ? axes.unit_m() : 1;
}

BuiltScene build_scene(const Study& study) {
  const BuiltScene prepared = scene_before_materials(study);
  BuiltScene built = scene_uncovered(study, prepared, surface_facts(study, prepared));
  give_materials(study, built);
  return built;
}

std::vector<std::string> materials_of_parallel_sources(const SceneStudy& scene) {
  std::vector<std::string> names;
  if (scene.parallel_sources.empty()) return names;
  for (const FileMaterial& m : model_of_parallel_sources(scene).materials) names.push_back(m.name);
  return names;
}

}  // namespace sunload
