// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Readers of the sections of a study, for io/study/study.cpp alone.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geo/base/coordinates.h"
#include "io/study/study.h"
#include "io/study/yaml_map.h"

namespace sunload::study_sections {

/// What the site says beyond its values.
enum class ZoneWritten { no, yes };
/// The same of where the scene stands.
enum class PlaceWritten { no, yes };
/// The site, and which of its keys are written.
struct SiteRead {
  SiteStudy site;
  ZoneWritten zone_written = ZoneWritten::no;
  PlaceWritten place_written = PlaceWritten::no;  ///< right or wrong
};

/// The horizon file is relative to `folder`.
SiteRead read_site(YamlMap& map, const std::string& folder);
PeriodStudy read_period(YamlMap& map, const SiteRead& site);
SunStudy read_sun(YamlMap& map);
/// Paths of files are relative to `folder`.
LightStudy read_light(YamlMap& map, const std::string& folder);
SceneStudy read_scene(YamlMap& map, const std::string& folder);
/// A model in micrometres, one in thousands of kilometres.
inline constexpr Range units_m{1e-6, 1e6};
// What several sections have.
inline constexpr Range shares{0, 1};
inline constexpr Range trunk_shares{0, 0.99};  ///< of a tree's height
inline constexpr Range turns_deg{-360, 360};
inline constexpr Range coordinates_m{-largest_coordinate_m, largest_coordinate_m};
inline constexpr Range heights_m{-1e5, 1e5};
void check_lod(YamlMap& map, const std::string& lod);
/// `scene.files`; paths are relative to `folder`.
std::vector<SceneFileStudy> read_scene_files(YamlMap& scene, const std::string& folder);
/// A file that is there, relative to `folder`; empty where the key is absent. `source`: where it
/// can be had.
std::string read_path(YamlMap& map, const std::string& key, const std::string& folder,
                      const std::string& source = "paths are relative to the study file");
/// As many numbers as that; empty where the key is absent or wrong, which is reported.
std::vector<double> read_numbers(YamlMap& map, const std::string& key, std::size_t count,
                                 const std::string& in_words);
/// x and y; nothing where the key is absent or wrong, which is reported.
std::optional<Point2> read_point(YamlMap& map, const std::string& key);
/// Three of them; nothing where the key is absent or wrong, which is reported.
std::optional<Vec3> read_vector(YamlMap& map, const std::string& key);
/// That a row of things has both its keys, `to_m` and `every_m`, or none.
void check_row(YamlMap& map, const std::string& things);
/// `scene.luminaires`; paths are relative to `folder`.
std::vector<LuminaireStudy> read_luminaires(YamlMap& scene, const std::string& folder);
/// `scene.edit`; paths are relative to `folder`.
std::vector<EditStep> read_scene_edit(YamlMap& scene, const std::string& folder);
/// The keys `object`, `type`, `polygon` and `near`; the file is relative to `folder`.
SelectionStudy read_objects(YamlMap& map, const std::string& folder);
/// Section `selections`; paths are relative to `folder`.
std::vector<NamedSelection> read_selections(YamlMap& root, const std::string& folder);
/// Whether a key says `weather` in place of a number.
bool is_of_weather(YamlMap& map, const std::string& key);
/// Section `seasons`.
std::vector<SeasonStudy> read_seasons(YamlMap& root);
/// The key `seasons` of a material: what it is in some of them.
std::vector<SeasonMaterial> read_season_materials(YamlMap& material);
/// Materials and the far ground must name seasons of the file, `names`; of those that this variant
/// does not have nothing is left.
void settle_seasons(YamlMap& root, Study& study, const std::set<std::string>& names);
/// That each season is named in some variant.
void warn_of_unused_seasons(YamlReading& reading, const std::vector<Study>& variants);
/// The key `selection` of a map that chooses: its name alone.
std::optional<NamedSelection> read_selection_name(YamlMap& map);
/// Gives every selection that rules, steps, measures and other selections name what it is; names
/// that are none, selections that leave out themselves, and parts of objects where whole ones are
/// wanted are reported.
void resolve_selections(YamlReading& reading, std::vector<NamedSelection>& selections,
                        SceneStudy& scene, const std::vector<MeasureParameters>& measures);
/// What can be part of a dataset's name: letters A to Z, digits and _.
bool is_dataset_name(const std::string& name);
/// Corners [x, y], or a GeoJSON file relative to `folder`. Areas that cross themselves are
/// problems.
AreasStudy read_areas(YamlMap& map, const std::string& key, const std::string& folder);
MeshStudy read_mesh(YamlMap& map);
SolverStudy read_solver(YamlMap& map);
/// The file is relative to `folder`.
SensorsStudy read_sensors(YamlMap& map, const std::string& folder);
OutputStudy read_output(YamlMap& map);
MeasureParameters read_measure(const std::string& name, YamlMap& map);
/// What measures need of the other sections.
void check_measures(YamlMap& root, const Study& study, PlaceWritten placed);

/// Adds what a reader of the values found wrong without knowing the place.
void add_at(YamlMap& map, const std::string& key, const Where& where, const InputError& error);

/// Keys and values that are decided on, and that this version does not read yet.
std::vector<LaterKey> later_keys();

}  // namespace sunload::study_sections
