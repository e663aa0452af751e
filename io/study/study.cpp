// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include "io/base/key_names.h"
#include "io/scene/base/from_file.h"
#include "io/scene/file.h"
#include "io/study/matrix.h"
#include "io/study/not_a_study.h"
#include "io/study/sections.h"
#include "io/study/study_text.h"
#include "io/study/yaml_map.h"

namespace sunload {

namespace {

using namespace study_sections;
namespace fs = std::filesystem;

const std::string format_name = "sunload-study-1";
constexpr std::uintmax_t largest_study_bytes = 8'000'000;  // 400 000 instants
constexpr std::size_t longest_name = 100;  // with suffixes below the 255 of file systems

/// Sections that a variant may change, and why it may not change the others.
const std::vector<std::string> variant_sections{"site",  "period", "seasons", "scene",
                                                "light", "mesh",   "solver"};
const std::map<std::string, std::string> common_sections{
    {"format", "it belongs to the file"},
    {"name", "it belongs to the file"},
    {"matrix", "a matrix makes variants"},
    {"sun", "all variants follow the same sun, or they could not be compared"},
    {"sensors", "all variants are measured at the same points"},
    {"selections", "all variants have the same ones, or they could not be compared"},
    {"measures", "all variants are measured alike, or they could not be compared"},
    {"output", "all results of a study go to one place"},
    {"variants", "a variant has no variants"}};
const std::map<std::string, std::string> common_solver_keys{
    {"batch_suns", "shards count the same batches in every variant"},
    {"isa", "one run uses one instruction set"}};
/// The only key of the site that a variant may change.
const std::string variant_site_key = "north_deg";
const std::string same_place = "all variants stand in the same place";
const std::vector<std::string> appended_lists{"scene.assign", "scene.edit"};

struct Variant {
  std::string name = "baseline";
  YamlTree over;                         ///< map of sections, null without changes
  std::vector<MatrixValue> values = {};  ///< of a matrix, put over those
};

std::string read_text_of(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError({path}, "the study is not there");
  if (fs::is_directory(path, error)) throw InputError({path}, "is a folder, not a study");
  refuse_other_files(path);
  // Pipes have no size.
  if (fs::is_regular_file(path, error) && fs::file_size(path, error) > largest_study_bytes) {
    throw InputError({path}, "is too large for a study",
                     "more than " + std::to_string(largest_study_bytes) + " bytes");
  }
  return read_whole_file(path);
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// A name that can be part of a path on every system.
std::string read_name(YamlMap& map) {
  map.require("name");
  std::string name = map.text("name", "");
  const bool allowed = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
  if (!allowed || name.starts_with('.')) {
    map.problem("name", "'" + name + "' cannot be a name",
                "letters A to Z, digits and _ - . make names, which do not start with a dot");
  } else if (name.size() > longest_name) {
    map.problem("name", "is longer than " + std::to_string(longest_name) + " characters");
  }
  return name;
}

void refuse_common_keys(YamlMap& variant) {
  const auto each_key = [&](const char* section, const auto& reason_of) {
    const YamlTree map = variant.tree(section);
    if (!map || map->kind != YamlNode::Kind::map) return;
    for (const auto& entry : map->entries)
      if (const std::string reason = reason_of(entry.key); !reason.empty())
        variant.reading().problem(
            entry.where, std::string("a variant cannot change ") + section + "." + entry.key,
            reason, std::string("write it in the study's own section ") + section);
  };
  each_key("solver", [](const std::string& key) {
    const auto common = common_solver_keys.find(key);
    return common == common_solver_keys.end() ? std::string() : common->second;
  });
  each_key("site", [](const std::string& key) {
    return key == variant_site_key ? std::string() : same_place;
  });
}

/// The same for the keys of a matrix.
void refuse_common_keys(const MatrixValue& value, YamlReading& reading) {
  const std::string& section = value.path.front().key;
  const std::string key = value.path.size() > 1 ? value.path[1].key : "";
  std::string reason;
  if (const auto common = common_sections.find(section); common != common_sections.end())
    reason = common->second;
  else if (const auto of_solver = common_solver_keys.find(key);
           section == "solver" && of_solver != common_solver_keys.end())
    reason = of_solver->second;
  else if (section == "site" && key != variant_site_key)
    reason = same_place;
  else if (std::find(variant_sections.begin(), variant_sections.end(), section) ==
           variant_sections.end())
    reason = "the sections of variants are site, period, seasons, scene, light, mesh and solver";
  else
    return;
  reading.problem(value.where,
                  "matrix: a variant cannot change " + section + (key.empty() ? "" : "." + key),
                  reason);
}

YamlTree no_value(const Where& where) {
  YamlNode none;
  none.where = where;
  return std::make_shared<const YamlNode>(std::move(none));
}

Variant read_variant(YamlMap& map) {
  Variant variant;
  variant.name = read_name(map);
  auto over = std::make_shared<YamlNode>();
  over->kind = YamlNode::Kind::map;
  over->where = map.where();
  for (const auto& section : variant_sections) {
    // Without a value: without seasons, as keys within sections are taken away.
    const bool is_none = section == "seasons" && map.is_none(section);
    const YamlTree value = is_none ? no_value(map.where(section)) : map.tree(section);
    if (value) over->entries.push_back({section, value->where, value});
  }
  variant.over = std::move(over);
  for (const auto& [section, reason] : common_sections) {
    if (section != "name" && map.has(section)) {
      map.refuse(section, "a variant cannot change this", reason, "make another study of it");
    }
  }
  refuse_common_keys(map);
  return variant;
}

std::vector<Variant> read_variants(YamlMap& root) {
  std::vector<Variant> variants;
  std::set<std::string> names;
  root.each("variants", [&](YamlMap& map) {
    variants.push_back(read_variant(map));
    const std::string& name = variants.back().name;
    if (!names.insert(lower(name)).second) {
      map.problem("name", "'" + name + "' is used twice", "case makes no difference",
                  "give each variant a name of its own");
    }
  });
  if (variants.empty()) variants.emplace_back();
  return variants;
}

/// Every variant with every combination of the matrix; its name is that of the variant, where the
/// study writes any, and the labels of the values.
std::vector<Variant> read_all_variants(YamlMap& root) {
  const bool are_named = root.has("variants");
  std::vector<Variant> written = read_variants(root);
  const auto axes = read_matrix(root, written.size());
  if (axes.empty()) return written;
  for (const auto& axis : axes) refuse_common_keys(axis.front(), root.reading());
  std::vector<Variant> all;
  std::set<std::string> names;
  for (const Variant& base : written)
    for (auto& values : combinations(axes)) {
      Variant variant{are_named ? base.name : "", base.over, std::move(values)};
      for (const MatrixValue& value : variant.values)
        variant.name += (variant.name.empty() ? "" : "_") + value.label;
      if (variant.name.size() > longest_name || variant.name.starts_with('.'))
        root.problem(
            "matrix", "'" + variant.name + "' cannot be a name",
            "names have at most " + std::to_string(longest_name) + " characters, the first no dot",
            "write a map of short names and values");
      if (!names.insert(lower(variant.name)).second)
        root.problem("matrix", "makes '" + variant.name + "' twice", "case makes no difference");
      all.push_back(std::move(variant));
    }
  return all;
}

/// The study with what the variant changes.
YamlTree merged(const YamlTree& tree, const Variant& variant, YamlReading& reading) {
  YamlTree all = variant.over ? merge_yaml(tree, variant.over, appended_lists) : tree;
  for (const MatrixValue& value : variant.values)
    all = with_value(all, value, appended_lists, reading);
  return all;
}

/// How many rules the study itself has; those of variants come behind them.
std::size_t own_rules(const YamlTree& tree) {
  const YamlEntry* scene = tree->find("scene");
  const YamlEntry* assign = scene && scene->value ? scene->value->find("assign") : nullptr;
  return assign && assign->value ? assign->value->items.size() : 0;
}

/// Rules that a variant overrules are no slip of the hand.
void mark_overruled(std::size_t own, std::vector<AssignRule>& rules) {
  if (rules.size() <= own) return;
  for (std::size_t r = 0; r < own; ++r) rules[r].may_be_overruled = true;
}

/// Files of these formats carry no position on Earth.
bool is_without_crs(const std::string& path) {
  const auto format = scene_format_of_name(path);
  return format && format->kind == SceneFileKind::mesh;
}

/// What `short_intervals: together` cannot go with: wishes of single intervals.
void check_joining(YamlMap& root, const Study& study) {
  const auto refuse = [&](const char* with, const char* why, const char* hint) {
    root.reading().problem(root.where("solver"),
                           std::string("solver.short_intervals: together cannot go with ") + with,
                           why, hint);
  };
  if (study.solver.transport == Transport::shoot)
    refuse("transport: shoot", "suns of a step share what is gathered", "write transport: gather");
  if (study.output.standard_error == StandardErrors::instants)
    refuse("standard_error: instants",
           "intervals that are solved together have no errors of their own",
           "write standard_error: totals");
  if (study.solver.accuracy && study.solver.accuracy->irradiance_relative)
    refuse("accuracy.irradiance_relative", "it is of every instant", "ask for light_load_relative");
  if (study.output.series_step.is_interval() && !study.output.series.empty())
    refuse("series of intervals", "each of them is stored",
           "write output.series_step: 60 min, day or month, or output.series: none");
  if (std::holds_alternative<InstantsPeriod>(study.period.kind) ||
      std::holds_alternative<PositionsPeriod>(study.period.kind))
    refuse("instants or positions of the sun", "they are no stretches of time",
           "write days or start with end, and step_min");
}

void check_emission(YamlMap& root, const Study& study, const MaterialStudy& material) {
  const bool lux = study.light.quantity == Quantity::illuminance;
  if ((lux ? material.emission_w_m2 : material.emission_lm_m2) <= 0) return;
  root.reading().problem(
      material.where,
      fmt::format("material '{}' has emission_{} where light.quantity is {}", material.name,
                  lux ? "w_m2" : "lm_m2", lux ? "illuminance" : "irradiance"),
      "how much of its watts the eye sees is not known",
      fmt::format("write emission_{}, or light.quantity: {}", lux ? "lm_m2" : "w_m2",
                  lux ? "irradiance" : "illuminance"));
}

/// What sections have to do with each other.
void check_together(YamlMap& root, const Study& study, PlaceWritten placed) {
  const bool positions = std::holds_alternative<PositionsPeriod>(study.period.kind);
  if (positions && study.light.source != LightSource::fixed) {
    root.reading().problem(study.period.where, "positions need light.source: fixed",
                           "they have no date to compute the sun's power from",
                           "write light: {source: fixed, dni_w_m2: 800, dhi_w_m2: 100}");
  }
  const bool weather = study.light.source == LightSource::weather;
  if (std::holds_alternative<WeatherPeriod>(study.period.kind) && !weather) {
    root.reading().problem(study.period.where, "year_of: weather needs light.source: weather", "",
                           "write light: {source: weather, weather: x.epw}");
  }
  if (study.solver.bands == Bands::rgb && study.light.quantity == Quantity::illuminance)
    root.reading().problem(root.where("solver"), "solver.bands: rgb cannot go with illuminance",
                           "lux are weighted by the eye's own response to the whole spectrum",
                           "write light.quantity: irradiance, or leave solver.bands away");
  for (const MaterialStudy& material : study.scene.materials) check_emission(root, study, material);
  if (!study.scene.luminaires.empty() && study.light.quantity != Quantity::illuminance)
    root.reading().problem(study.scene.luminaires.front().where,
                           "scene.luminaires need light.quantity: illuminance",
                           "their photometry tells lumens, and watts do not follow from them",
                           "write light: {quantity: illuminance}");
  if (study.solver.year == Year::modes && study.output.standard_error == StandardErrors::instants)
    root.reading().problem(root.where("solver"),
                           "solver.year: modes cannot go with standard_error: instants",
                           "few solutions have no errors of each instant",
                           "write year: auto or each, or standard_error: totals");
  if (study.solver.short_intervals == ShortIntervals::together) check_joining(root, study);
  if (study.solver.bands == Bands::broadband && study.light.colour != LightColour::sky)
    root.reading().warn(root.where("light"), "light.colour is not used",
                        "it belongs to solver.bands: rgb");
  const auto& files = study.scene.files;
  const bool no_crs = study.scene.builtin ||
                      std::all_of(files.begin(), files.end(), [](const SceneFileStudy& file) {
                        return is_without_crs(file.path);
                      });
  // The header of a weather file may say the place.
  if (!positions && !weather && placed == PlaceWritten::no && no_crs &&
      (study.scene.builtin || !files.empty())) {
    root.reading().problem(root.where("site"), "site has no position",
                           "the scene brings none, and the sun depends on it",
                           "write latitude_deg and longitude_deg");
  }
}

/// Only a weather file tells an albedo.
void check_albedos(YamlMap& root, const Study& study) {
  if (study.light.source == LightSource::weather) return;
  const auto refuse = [&](const Where& where, const std::string& what) {
    root.reading().problem(where, what + ": weather needs light.source: weather",
                           "the albedo of each day is read from its file", "write a number");
  };
  if (study.light.far_ground_of_weather) refuse(root.where("light"), "far_ground_albedo");
  for (const MaterialStudy& material : study.scene.materials)
    if (material.diffuse_of_weather) refuse(material.where, "diffuse");
}

/// Of the file and all its variants: materials may name seasons that a variant takes away.
std::set<std::string> seasons_named_in(const std::vector<YamlTree>& variants) {
  std::set<std::string> names;
  for (const YamlTree& tree : variants) {
    const YamlEntry* seasons = tree ? tree->find("seasons") : nullptr;
    if (!seasons) continue;
    for (const YamlEntry& season : seasons->value->entries) names.insert(season.key);
  }
  return names;
}

Study read_values(YamlMap& root, const std::string& folder, const std::set<std::string>& seasons) {
  Study study;
  root.require("format", "", "write format: " + format_name);
  root.word("format", {format_name}, format_name);
  study.name = read_name(root);
  for (const char* section : {"period", "scene"}) root.require(section);
  SiteRead site;
  root.section("site", [&](YamlMap& map) { site = read_site(map, folder); });
  study.site = site.site;
  const bool describe = root.reading().purpose == YamlReading::Purpose::describe;
  if (root.has("period") || describe) {
    root.section("period", [&](YamlMap& map) { study.period = read_period(map, site); });
  }
  root.section("sun", [&](YamlMap& map) { study.sun = read_sun(map); });
  root.section("light", [&](YamlMap& map) { study.light = read_light(map, folder); });
  if (root.has("scene") || describe) {
    root.section("scene", [&](YamlMap& map) { study.scene = read_scene(map, folder); });
  }
  root.section("mesh", [&](YamlMap& map) { study.mesh = read_mesh(map); });
  root.section("solver", [&](YamlMap& map) { study.solver = read_solver(map); });
  if (root.has("sensors") || describe) {
    root.section("sensors", [&](YamlMap& map) { study.sensors = read_sensors(map, folder); });
  }
  root.section("output", [&](YamlMap& map) { study.output = read_output(map); });
  root.named("measures", [&](const std::string& name, YamlMap& map) {
    study.measures.push_back(read_measure(name, map));
  });
  study.seasons = read_seasons(root);
  study.selections = read_selections(root, folder);
  resolve_selections(root.reading(), study.selections, study.scene, study.measures);
  check_together(root, study, site.place_written);
  check_albedos(root, study);
  check_measures(root, study, site.place_written);
  settle_seasons(root, study, seasons);
  return study;
}

}  // namespace

StudyFile read_study(const std::string& path) { return study_of_text(path, read_text_of(path)); }

StudyFile study_of_text(const std::string& path, const std::string& yaml) {
  StudyFile file;
  file.path = path;
  file.yaml = yaml;
  YamlReading reading(later_keys());
  const YamlTree tree = parse_yaml(path, file.yaml, reading.parser_problems);
  const std::string folder = fs::path(path).parent_path().string();
  std::vector<Variant> variants;
  YamlMap::read_all(tree, reading, [&](YamlMap& root) {
    variants = read_all_variants(root);
    root.keep_rest();  // read with each variant's changes below
  });
  std::vector<YamlTree> trees;
  trees.reserve(variants.size());
  for (const Variant& variant : variants) trees.push_back(merged(tree, variant, reading));
  const auto seasons = seasons_named_in(trees);
  for (std::size_t v = 0; v < variants.size(); ++v)
    YamlMap::read_all(trees[v], reading, [&](YamlMap& root) {
      root.tree("variants");
      root.tree("matrix");
      file.variants.push_back(read_values(root, folder, seasons));
      file.variants.back().variant = variants[v].name;
      mark_overruled(own_rules(tree), file.variants.back().scene.assign);
    });
  reading.throw_if_any();
  warn_of_unused_seasons(reading, file.variants);
  file.name = file.variants.front().name;
  file.warnings = reading.warnings;
  return file;
}

SceneStudy scene_of_text(const std::string& yaml, const std::string& variant) {
  YamlReading reading(later_keys());
  const YamlTree tree = parse_yaml("", yaml, reading.parser_problems);
  std::vector<Variant> variants;
  YamlMap::read_all(tree, reading, [&](YamlMap& root) {
    variants = read_all_variants(root);
    root.keep_rest();
  });
  SceneStudy scene;
  for (const Variant& each : variants) {
    if (each.name != variant) continue;
    YamlMap::read_all(merged(tree, each, reading), reading, [&](YamlMap& root) {
      root.section("scene", [&](YamlMap& map) { scene = read_scene(map, ""); });
      std::vector<NamedSelection> selections = read_selections(root, "");
      resolve_selections(root.reading(), selections, scene, {});
      root.keep_rest();
    });
  }
  return scene;
}

std::vector<std::string> study_keys() {
  YamlReading reading(later_keys(), YamlReading::Purpose::describe);
  YamlMap::read_all(nullptr, reading, [](YamlMap& root) {
    read_all_variants(root);
    read_values(root, "", {});
  });
  return {reading.keys.begin(), reading.keys.end()};
}

}  // namespace sunload
