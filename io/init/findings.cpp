// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/findings.h"
#include "geo/sun/map_axes.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "geo/base/check.h"
#include "geo/mesh/sunk_walls.h"
#include "geo/sun/sun.h"
#include "geo/sun/weather.h"
#include "geo/sun/weather_holes.h"
#include "geo/time/time.h"
#include "io/scene/file.h"

namespace sunload {

namespace {

/// A study of the files that says nothing else; without dates, it needs no place.
Study bare_study(const InitRules& rules, const Findings& found) {
  Study study;
  study.scene.files = {scene_file_of(rules)};
  study.scene.where = {rules.model, 0, 0};
  study.period.kind = PositionsPeriod{{SunAt{180, 45, 60}}};
  for (const auto& name : rules.land) study.scene.land.push_back({name, {rules.model, 0, 0}});
  study.site.crs = rules.crs;
  if (!rules.at.empty()) {
    const Site site = site_from_text(rules.at);
    study.site.latitude_deg = site.latitude_deg;
    study.site.longitude_deg = site.longitude_deg;
  }
  if (found.weather) {
    study.light.source = LightSource::weather;
    study.light.weather = rules.weather;
    study.light.missing = Missing::interpolate;
    if (!found.is_stamp_known) study.light.stamp = Stamp::end;
  }
  return study;
}

/// CSV has no convention of its own: its rows are read as ends of intervals, and the study says so.
void read_weather(const std::string& path, Findings& found) {
  if (path.empty()) return;
  try {
    found.weather = read_weather_file(path, {});
  } catch (const InputError&) {
    found.weather = read_weather_file(path, Stamp::end);
    found.is_stamp_known = false;
  }
  constexpr int any_leap_year = 2004;  // no record is left out
  const auto weather = dated(found.weather->records, any_leap_year, 0);
  found.weather_source = source_of(weather);
  found.records_incomplete = static_cast<std::size_t>(std::count_if(
      weather.begin(), weather.end(),
      [&](const DatedWeather& record) { return source_of(record.values) == WeatherSource::none; }));
}

/// By its ending: what is inside has been read by then.
bool is_raster(const std::string& path) {
  const auto format = scene_format_of_name(path);
  return format && format->kind == SceneFileKind::raster;
}

void look_at_site(const InitRules& rules, const BuiltScene& built, Findings& found) {
  found.crs = built.crs.empty() ? rules.crs : built.crs;
  if (!found.crs.empty())
    if (const MapAxes axes(found.crs); axes.is_known()) found.unit_of_crs_m = axes.unit_m();
  const bool has_station = found.weather && found.weather->place;
  if (!found.crs.empty() || !rules.at.empty() || has_station) {
    found.site = built.site;
    found.site_source = built.site_source;
  }
  found.is_at_station = has_station && found.crs.empty() && rules.at.empty();
  std::optional<double> offset = found.weather ? found.weather->offset_s : std::optional<double>();
  // Many files are written in UTC wherever their station stands.
  if (offset == 0.0) offset.reset();
  if (found.site)
    found.zone = guessed_zone(found.site->latitude_deg, found.site->longitude_deg, offset,
                              found.crs.empty() ? "" : area_of_use_words(found.crs));
  // That of another country, whose summer times are its own: better the weather's offset alone.
  constexpr double other_country_m = 1000e3;
  if (offset && found.zone && found.zone->away_m.value_or(0) > other_country_m)
    found.zone = ZoneGuess{offset_text(*offset)};
  if (has_station && found.site && !found.is_at_station)
    found.station_away_m =
        distance_m(*found.site, {.latitude_deg = found.weather->place->latitude_deg,
                                 .longitude_deg = found.weather->place->longitude_deg});
}

/// After the site, whose sun tells which rows are missing.
void look_for_missing_rows(Findings& found) {
  if (!found.weather || !found.site) return;
  constexpr int any_leap_year = 2004;
  const double offset_s = found.weather->offset_s.value_or(
      found.zone ? TimeZone(found.zone->name).standard_offset_s(any_leap_year) : 0);
  const auto weather = dated(found.weather->records, any_leap_year, offset_s);
  const SunEphemeris sun(weather.front().begin, weather.back().end, *found.site, Refraction::spa,
                         Ut1::table, standard_air(found.site->elevation_m));
  for (const auto& hole : sunlit_holes(weather, sun, found.site->longitude_deg))
    found.records_incomplete += hole.records.size();
}

/// Faces that look along an axis, as shares of the side of the box about the model across it: those
/// at its low end, and all others; and those that look against it, all of them and without those at
/// the low end, which bodies may stand on.
struct Covered {
  double foot = 0, above = 0, against = 0, against_above = 0;
};

Covered covered_along(const Mesh& mesh, const PrepareReport& report, double Vec3::*axis) {
  constexpr double share_of_height = 0.1;
  const Vec3 size = report.bounds.high - report.bounds.low;
  const double top = report.bounds.low.*axis + share_of_height * size.*axis;
  const double volume = size.x * size.y * size.z;
  Covered covered;
  for (std::size_t t = 0; t < mesh.triangle_count() && volume > 0; ++t) {
    const bool is_at_foot = mesh.corner(t, 0).*axis <= top && mesh.corner(t, 1).*axis <= top &&
                            mesh.corner(t, 2).*axis <= top;
    const double share = mesh.area_vector2(t).*axis / 2 * (size.*axis) / volume;
    if (share < 0) {
      covered.against -= share;
      if (!is_at_foot) covered.against_above -= share;
    } else {
      (is_at_foot ? covered.foot : covered.above) += share;
    }
  }
  return covered;
}

/// Ground with or without what stands on it; the floor of a house is under its roof.
bool is_ground(const Covered& covered) {
  constexpr double least = 0.2, most = 1.8;
  return covered.foot > least && covered.foot + covered.above < most;
}

/// Whether land seems to look along +y: a sheet that covers the box about it once and shows nothing
/// the other way but what bodies stand on, while along z there are faces both ways.
bool lies_on_its_side(const Covered& along_z, const Covered& along_y) {
  constexpr double hardly_any = 0.02, once = 0.9;
  return is_ground(along_y) && along_y.foot + along_y.above > once &&
         along_y.against_above < hardly_any && along_z.against > hardly_any;
}

/// Formats that do not say which axis points up, where z is taken for it.
bool may_be_on_its_side(const std::string& path) {
  const auto format = scene_format_of_name(path);
  return format && !format->says_up;
}

void look_at_surfaces(const Mesh& mesh, Findings& found) {
  found.triangles = mesh.triangle_count();
  found.objects = mesh.object_names.size();
  for (const auto& kind : mesh.object_kinds)
    if (!kind.empty()) ++found.kinds[kind];
  for (const auto& material : mesh.file_materials) {
    found.materials.push_back({material, 0});
    if (material.may_be_scaled && material.diffuse.value_or(0) + material.mirror.value_or(0) > 1)
      found.has_excess = true;
  }
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double area = mesh.area_m2(t);
    const auto surface = static_cast<std::size_t>(mesh.triangle_surface[t]);
    found.area[surface] += area;
    const MaterialId material = mesh.triangle_material[t];
    const bool has_material = material != MaterialId::none();
    if (has_material) found.materials[material.index()].area_m2 += area;
    if (!has_material || !mesh.file_materials[material.index()].diffuse)
      found.undetermined[surface] += area;
  }
}

/// Where houses go on below a sheet it is their terrain, and no roof.
std::string terrain_of(const SunkWalls& sunk) {
  constexpr double least_m2 = 1;
  return sunk.area_m2 >= least_m2 && sunk.sheet != sunk.wall ? sunk.sheet : "";
}

}  // namespace

SceneFileStudy scene_file_of(const InitRules& rules) {
  SceneFileStudy file;
  file.path = rules.model;
  file.where = {rules.model, 0, 0};
  file.terrain = rules.terrain;
  file.canopy = rules.canopy;
  file.footprints.height = rules.height;
  file.footprints.storeys = rules.storeys;
  if (!rules.up.empty()) file.up = rules.up.front();
  if (rules.unit_m != 1) file.unit_m = rules.unit_m;
  return file;
}

Findings findings_of(const InitRules& rules) {
  Findings found;
  read_weather(rules.weather, found);
  const BuiltScene built = scene_before_materials(bare_study(rules, found));
  const PrepareReport& report = built.report;
  look_at_site(rules, built, found);
  look_for_missing_rows(found);
  look_at_surfaces(built.scene.mesh, found);
  found.polygons = report.polygons_read;
  found.size = report.bounds.high - report.bounds.low;
  found.middle = built.scene.mesh.origin + (report.bounds.high + report.bounds.low) / 2;
  found.is_city_format = report.ground.has_value();
  found.has_ground = found.area[static_cast<std::size_t>(Surface::ground)] > 0;
  const Covered upward = covered_along(built.scene.mesh, report, &Vec3::z);
  if (is_ground(upward)) found.foot_share = upward.foot;
  found.is_on_its_side =
      rules.up.empty() && may_be_on_its_side(rules.model) &&
      lies_on_its_side(upward, covered_along(built.scene.mesh, report, &Vec3::y));
  found.sunk_into = terrain_of(report.sunk);
  found.is_raster = is_raster(rules.model);
  found.warnings = built.warnings;
  std::copy_if(
      built.notes.begin(), built.notes.end(), std::back_inserter(found.footprint_notes),
      [](const std::string& note) { return note.find("footprints") != std::string::npos; });
  return found;
}

}  // namespace sunload
