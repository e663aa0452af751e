// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The canonical text of a study. Structured bindings name every member of every
// struct: a new member does not compile until it is put in or left out on purpose.
#define JSON_DISABLE_ENUM_SERIALIZATION 1  // choices are words, not numbers
#include <nlohmann/json.hpp>

#include "io/study/study.h"
#include "io/study/words.h"

namespace sunload {

namespace {

using nlohmann::json;

template <class T>
json maybe(const std::optional<T>& value) {
  if (!value) return {};
  if constexpr (std::is_enum_v<T>)
    return word_of(*value);
  else
    return *value;
}

json canonical(const CivilTime& time) {
  const auto& [year, month, day, hour, minute, second] = time;
  return {year, month, day, hour, minute, second};
}

json canonical(const ParsedTime& time) {
  // Whether a time of day was written makes no difference: midnight is 00:00.
  const auto& [civil, has_time, has_offset, offset_s] = time;
  return {{"civil", canonical(civil)}, {"offset_s", has_offset ? json(offset_s) : json()}};
}

json canonical(const SiteStudy& site) {
  const auto& [latitude_deg, longitude_deg, crs, elevation_m, timezone, north_deg, horizon, where] =
      site;
  json all{{"latitude_deg", maybe(latitude_deg)},
           {"longitude_deg", maybe(longitude_deg)},
           {"crs", crs},
           {"elevation_m", maybe(elevation_m)},
           {"timezone", timezone},
           {"north_deg", maybe(north_deg)}};
  if (horizon.is_open()) return all;
  json line = json::array();
  for (const auto& [azimuth_deg, elevation_deg] : horizon.points())
    line.push_back({azimuth_deg, elevation_deg});
  all["horizon"] = line;
  return all;
}

json canonical(const SunAt& sun);
json canonical(const MaterialStudy& material);
json canonical(const AssignRule& rule);
json canonical(const SceneFileStudy& file);
json canonical(const MeasureParameters& measure);
json canonical(const EditStep& step);
json canonical(const LuminaireStudy& luminaire);
json choice(const NamedSelection& selection);
json canonical(const NamedSelection& selection);
json canonical(const SeasonStudy& season);

template <class T>
json list_of(const std::vector<T>& values) {
  json list = json::array();
  for (const T& value : values) list.push_back(canonical(value));
  return list;
}

json canonical(const DaysPeriod& period) {
  const auto& [days, from_s, to_s, step_min] = period;
  return {{"days", list_of(days)}, {"from_s", from_s}, {"to_s", to_s}, {"step_min", step_min}};
}

json canonical(const RangePeriod& period) {
  const auto& [start, end, step_min] = period;
  return {{"start", canonical(start)}, {"end", canonical(end)}, {"step_min", step_min}};
}

json canonical(const InstantsPeriod& period) {
  const auto& [instants, interval_min] = period;
  return {{"instants", list_of(instants)}, {"interval_min", interval_min}};
}

json canonical(const SunAt& sun) {
  const auto& [azimuth_deg, elevation_deg, interval_min] = sun;
  return {azimuth_deg, elevation_deg, interval_min};
}

json canonical(const PositionsPeriod& period) {
  const auto& [positions] = period;
  return {{"positions", list_of(positions)}};
}

json canonical(const WeatherPeriod& period) {
  const auto& [as_year] = period;
  return {{"as_year", maybe(as_year)}};
}

json canonical(const PeriodStudy& period) {
  const auto& [kind, where] = period;
  return std::visit([](const auto& value) { return canonical(value); }, kind);
}

json canonical(const SunStudy& sun) {
  const auto& [refraction, ut1_utc, disk] = sun;
  return {
      {"refraction", word_of(refraction)}, {"ut1_utc", word_of(ut1_utc)}, {"disk", word_of(disk)}};
}

json canonical(const LightStudy& light) {
  const auto& [source, model, linke_turbidity, dni_w_m2, dhi_w_m2, sky, sky_type, turbidity,
               sky_scale, zenith_luminance_cd_m2, far_ground_albedo, far_ground_of_weather,
               far_ground_seasons, quantity, weather, colour, stamp, missing, decomposition] =
      light;
  // The weather file is hashed by its bytes; the colour belongs to the solver's bands.
  json canon = {{"stamp", maybe(stamp)},       {"quantity", word_of(quantity)},
                {"missing", word_of(missing)}, {"decomposition", word_of(decomposition)},
                {"source", word_of(source)},   {"model", word_of(model)},
                {"dni_w_m2", dni_w_m2},        {"linke_turbidity", linke_turbidity.monthly},
                {"dhi_w_m2", dhi_w_m2},        {"sky", word_of(sky)},
                {"sky_type", sky_type},        {"far_ground_albedo", far_ground_albedo},
                {"turbidity", turbidity}};
  // The usual scale has no key: hashes stay those of the time before there was another.
  if (sky_scale != SkyScale::diffuse) canon["sky_scale"] = word_of(sky_scale);
  if (far_ground_of_weather) canon["far_ground_albedo"] = "weather";
  for (const auto& [season, albedo, place] : far_ground_seasons)
    canon["far_ground_seasons"].push_back({season, albedo});
  if (zenith_luminance_cd_m2) canon["zenith_luminance_cd_m2"] = *zenith_luminance_cd_m2;
  return canon;
}

json canonical(const ConstantShares& /*all are equal*/) { return json::object(); }
json canonical(const Panes& panes) {
  const auto& [refractive_index, thickness_m, absorption_per_m, count] = panes;
  return {{"refractive_index", refractive_index},
          {"thickness_m", thickness_m},
          {"absorption_per_m", absorption_per_m},
          {"panes", count}};
}
json canonical(const ClearGlass& glass) {
  const auto& [normal_transmittance] = glass;
  return {{"normal_transmittance", normal_transmittance}};
}
json canonical(const Metal& metal) {
  const auto& [refractive_index, extinction_coefficient] = metal;
  return {{"refractive_index", refractive_index},
          {"extinction_coefficient", extinction_coefficient}};
}

json canonical(const MaterialStudy& material) {
  // A colour is hashed with the scene, where bands are asked for.
  const auto& [name, diffuse, mirror, diffuse_rgb, emission_w_m2, emission_lm_m2, sides, where,
               smooth, glossy, glossy_exponent, transmittance, seasons, diffuse_of_weather] =
      material;
  json canon = {{"name", name},
                {"diffuse", maybe(diffuse)},
                {"mirror", maybe(mirror)},
                {"emission_w_m2", emission_w_m2},
                {"sides", maybe(sides)},
                {"glossy", glossy},
                {"glossy_exponent", glossy_exponent},
                {"transmittance", transmittance}};
  if (emission_lm_m2 != 0) canon["emission_lm_m2"] = emission_lm_m2;
  if (diffuse_of_weather) canon["diffuse"] = "weather";
  canon.update(std::visit([](const auto& kind) { return canonical(kind); }, smooth));
  for (const auto& [season, other, place] : seasons) canon["seasons"].push_back({season, other});
  return canon;
}

json canonical(const SeasonDate& date) {
  const auto& [year, month, day] = date;
  return {maybe(year), month, day};
}

json canonical(const SeasonStudy& season) {
  const auto& [name, months, first, end_date, where] = season;
  return {{"name", name},
          {"months", months},
          {"first", canonical(first)},
          {"end", canonical(end_date)}};
}

json canonical(const AssignRule& rule) {
  const auto& [object, surface, material_was, kind, selection, material, where, overruled] = rule;
  std::ignore = overruled;  // of warnings alone
  json all{{"object", object},
           {"surface", surface},
           {"was", material_was},
           {"type", kind},
           {"material", material}};
  // By what it is, not by its name.
  if (selection) all["selection"] = choice(*selection);
  return all;
}

json canonical(const GroundStudy& ground) {
  const auto& [wanted, margin_m, material, surface, height_m] = ground;
  return {{"wanted", wanted},
          {"margin_m", margin_m},
          {"material", material},
          {"surface", word_of(surface)},
          {"height_m", maybe(height_m)}};
}

json canonical(const BuiltinStudy& builtin) {
  const auto& [name, parameters, where] = builtin;
  return {{"name", name}, {"parameters", parameters}};
}

json canonical(const FootprintRules& rules) {
  const auto& [height, storeys, base, name, layer, storey_m, default_height_m, terrain] = rules;
  return {{"height", height},
          {"storeys", storeys},
          {"base", base},
          {"name", name},
          {"layer", layer},
          {"storey_m", storey_m},
          {"default_height_m", maybe(default_height_m)}};  // terrain: see blocks
}

json canonical(const SceneFileStudy& file) {
  // Files are hashed by their bytes.
  const auto& [path, where, up, unit_m, lod, position, earth_position, turn_deg, material, terrain,
               canopy, least_height_m, trunk_share, footprints] = file;
  json all{{"up", up == 0 ? std::string() : std::string(1, up)},
           {"unit_m", maybe(unit_m)},
           {"lod", lod},
           {"turn_deg", turn_deg},
           {"material", material}};
  if (position) all["position"] = {position->x, position->y, position->z};
  if (earth_position)
    all["earth_position"] = {earth_position->latitude_deg, earth_position->longitude_deg,
                             earth_position->height_m};
  if (!terrain.empty())
    all["blocks"] = {{"least_height_m", least_height_m},
                     {"trunk_share", trunk_share},
                     {"has_canopy", !canopy.empty()}};
  // Studies without plan data keep their hashes.
  if (const json of_footprints = canonical(footprints);
      of_footprints != canonical(FootprintRules{}))
    all["footprints"] = of_footprints;
  return all;
}

json canonical(const AreasStudy& all) {
  const auto& [areas, in_degrees] = all;
  json rings = json::array();
  for (const PlanArea& area : areas) {
    rings.push_back(json::array());
    for (const auto& ring : area) {
      json corners = json::array();
      for (const Point2 p : ring) corners.push_back({p.u, p.v});
      rings.back().push_back(corners);
    }
  }
  return {{"areas", rings}, {"in_degrees", in_degrees}};
}

json canonical(const std::optional<Point2>& p) { return p ? json{p->u, p->v} : json(); }

json canonical(const SelectionStudy& chosen) {
  const auto& [object, kind, polygon, near, within_m, facade, surface, azimuth_deg, height_m] =
      chosen;
  json all{{"object", object},
           {"type", kind},
           {"polygon", canonical(polygon)},
           {"near", canonical(near)},
           {"within_m", maybe(within_m)}};
  if (!chosen.is_of_parts()) return all;
  all.update({{"facade", facade},
              {"surface", surface},
              {"azimuth_deg", maybe(azimuth_deg)},
              {"height_m", maybe(height_m)}});
  return all;
}

/// What it chooses, whatever it and what it leaves out are called.
json choice(const NamedSelection& selection) {
  json all = canonical(selection.of);
  for (const NamedSelection& other : selection.except) all["except"].push_back(choice(other));
  return all;
}

json canonical(const NamedSelection& selection) {
  return {{"name", selection.name}, {"of", choice(selection)}};
}

json canonical(const RemoveEdit& /*has no values*/) { return {{"remove", true}}; }
json canonical(const RaiseEdit& raise) {
  const auto& [by_m, from_m] = raise;
  return {{"raise", by_m}, {"from_m", maybe(from_m)}};
}
json canonical(const MoveEdit& move) {
  const auto& [by] = move;
  return {{"move", {by.x, by.y, by.z}}};
}
json canonical(const TurnEdit& turn) {
  const auto& [by_deg, about] = turn;
  return {{"turn", by_deg}, {"about", canonical(about)}};
}
// Files by their bytes, which the mesh has; paths tell studies of one run apart.
json canonical(const ReplaceEdit& replace) {
  return {{"replace", canonical(replace.file)}, {"path", replace.file.path}};
}
json canonical(const AddFileEdit& add) {
  return {{"add", canonical(add.file)}, {"path", add.file.path}};
}
json canonical(const AddPrismEdit& add) {
  const auto& [name, material, areas, base_m, height_m] = add;
  return {{"prism", name},
          {"material", material},
          {"areas", canonical(areas)},
          {"base_m", maybe(base_m)},
          {"height_m", height_m}};
}
json canonical(const AddTreesEdit& add) {
  const auto& [name, at, base_m, to, every_m, shape] = add;
  const auto& [height_m, crown_m, trunk_m, leaves, trunk] = shape;
  return {{"tree", name},
          {"at", {at.u, at.v}},
          {"base_m", maybe(base_m)},
          {"to", canonical(to)},
          {"every_m", every_m},
          {"shape", {height_m, crown_m, trunk_m}},
          {"materials", {leaves, trunk}}};
}

// What the points say, the mesh has.
json canonical(const AddTreePointsEdit& add) {
  const auto& [name, path, rules, trunk_share, leaves, trunk] = add;
  const auto& [height, crown, name_of_each, layer, default_height_m, default_crown_m] = rules;
  return {{"trees", name},
          {"path", path},
          {"columns", {height, crown, name_of_each}},
          {"layer", layer},
          {"defaults", {maybe(default_height_m), maybe(default_crown_m)}},
          {"trunk_share", trunk_share},
          {"materials", {leaves, trunk}}};
}

json canonical(const EditStep& step) {
  const auto& [objects, selection, action, where] = step;
  json all{{"objects", canonical(objects)},
           {"action", std::visit([](const auto& kind) { return canonical(kind); }, action)}};
  if (selection) all["selection"] = choice(*selection);
  return all;
}

/// Files by the intensities in them, which the scene has.
json canonical(const LuminaireStudy& luminaire) {
  const auto& [position, to, every_m, towards, turn_deg, file, beam_deg, intensity_cd, flux_lm,
               where] = luminaire;
  return {{"position", {position.x, position.y, position.z}},
          {"to", to ? json{to->x, to->y, to->z} : json()},
          {"every_m", every_m},
          {"towards", {towards.x, towards.y, towards.z}},
          {"turn_deg", turn_deg},
          {"file", !file.empty()},
          {"beam_deg", beam_deg},
          {"intensity_cd", maybe(intensity_cd)},
          {"flux_lm", maybe(flux_lm)}};
}

json canonical(const SceneStudy& scene) {
  const auto& [files, builtin, parallel_sources, parallel_sources_where, luminaires, up, unit_m,
               lod, vrml_colour, vrml_excess, emission_scale_w, repair, orient, materials, assign,
               land, cut, ground, edit, where] = scene;
  json canon{{"builtin", builtin ? canonical(*builtin) : json()},
             {"files", list_of(files)},
             {"up", up == 0 ? std::string() : std::string(1, up)},
             {"unit_m", unit_m},
             {"lod", lod},
             {"vrml_colour", word_of(vrml_colour)},
             {"emission_scale_w", emission_scale_w},
             {"repair", word_of(repair)},
             {"orient", word_of(orient)},
             {"materials", list_of(materials)},
             {"assign", list_of(assign)},
             {"ground", ground ? canonical(*ground) : json()}};
  if (!edit.empty()) canon["edit"] = list_of(edit);
  for (const NamedSelection& selection : cut) canon["cut"].push_back(choice(selection));
  for (const LandName& name : land) canon["land"].push_back(name.pattern);
  if (!luminaires.empty()) canon["luminaires"] = list_of(luminaires);
  // What most studies refuse has no key: their hashes stay.
  if (vrml_excess != VrmlExcess::refuse) canon["vrml_excess"] = word_of(vrml_excess);
  return canon;
}

json canonical(const MeshStudy& mesh) {
  const auto& [max_edge_m, min_area_m2, oracle, light_tolerance, light_threshold_m2, t_vertices,
               link_threshold] = mesh;
  json values{{"max_edge_m", max_edge_m},
              {"min_area_m2", min_area_m2},
              {"oracle", word_of(oracle)},
              {"link_threshold", link_threshold}};
  // Thresholds of an oracle that is not asked change nothing.
  if (oracle == Oracle::light_load) values["light_tolerance"] = light_tolerance;
  if (oracle == Oracle::historic) values["light_threshold_m2"] = light_threshold_m2;
  if (oracle != Oracle::none) values["t_vertices"] = word_of(t_vertices);
  return values;
}

json canonical(const SolverStudy& solver, LightColour colour) {
  // `isa` is left out: the instruction set in force is hashed apart, so that
  // pinning it finds the batches that `auto` computed on such a machine.
  const auto& [transport, jacobi, power_per_sample_w, bands, bounces, unshot, unfollowed, year,
               short_intervals, lines_per_patch, direct_samples, sun_samples_per_interval,
               realizations, mirror_depth, batch_suns, isa, seed, accuracy, max_lines_per_patch] =
      solver;
  json all{{"transport", word_of(transport)},
           {"jacobi", word_of(jacobi)},
           {"power_per_sample_w", maybe(power_per_sample_w)},
           {"bounces", bounces},
           {"unshot", unshot},
           {"unfollowed", word_of(unfollowed)},
           {"lines_per_patch", lines_per_patch},
           {"direct_samples", direct_samples},
           {"realizations", realizations},
           {"mirror_depth", mirror_depth},
           {"batch_suns", maybe(batch_suns)},
           {"seed", seed}};
  if (bands == Bands::rgb) {
    all["bands"] = word_of(bands);
    all["colour"] = word_of(colour);
  }
  // What is left to the program has no key, either.
  if (year != Year::automatic) all["year"] = word_of(year);
  if (short_intervals != ShortIntervals::automatic)
    all["short_intervals"] = word_of(short_intervals);
  // One sun, as most studies have it, has no key: their hashes stay.
  if (sun_samples_per_interval != 1)
    all["sun_samples_per_interval"] =
        sun_samples_per_interval ? json(*sun_samples_per_interval) : json("auto");
  if (accuracy) {
    const auto& [light_load_relative, irradiance_relative] = *accuracy;
    all["accuracy"] = {{"light_load_relative", maybe(light_load_relative)},
                       {"irradiance_relative", maybe(irradiance_relative)},
                       {"max_lines_per_patch", max_lines_per_patch}};
  }
  return all;
}

json canonical(const MeasureParameters& measure) {
  const auto& [name, rule, numbers, words, date, of, where] = measure;
  const auto& [object, facade, surface, selection] = of;
  json canon{{"name", name}, {"rule", rule}};
  for (const auto& [key, value] : numbers) canon[key] = value;
  for (const auto& [key, word] : words) canon[key] = word;
  if (date) canon["date"] = {date->year, date->month, date->day};
  for (const auto& [key, pattern] : {std::pair{"object", object},
                                     {"facade", facade},
                                     {"surface", surface},
                                     {"selection", selection}})
    if (!pattern.empty()) canon["of"][key] = pattern;
  return canon;
}

}  // namespace

std::string measure_text(const MeasureParameters& measure) { return canonical(measure).dump(); }

std::string measures_text(const Study& study) {
  if (!study.selections.empty())
    return json{{"measures", list_of(study.measures)}, {"selections", list_of(study.selections)}}
        .dump();
  return study.measures.empty() ? std::string() : list_of(study.measures).dump();
}

std::string canonical_text(const Study& study) {
  // Sensors are hashed with the scene; measures and selections are made of finished batches
  // (measures_text).
  const auto& [name, variant, site, period, sun, light, scene, mesh, solver, sensors, output,
               measures, selections, seasons] = study;
  json all{{"site", canonical(site)},
           {"period", canonical(period)},
           {"sun", canonical(sun)},
           {"light", canonical(light)},
           {"scene", canonical(scene)},
           {"mesh", canonical(mesh)},
           {"solver", canonical(solver, light.colour)}};
  if (!seasons.empty()) all["seasons"] = list_of(seasons);
  return all.dump();
}

}  // namespace sunload
