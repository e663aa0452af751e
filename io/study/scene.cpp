// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sections `scene` and `mesh` of a study.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "io/base/key_names.h"
#include "io/scene/builtin.h"
#include "io/study/sections.h"
#include "io/study/words.h"
#include "solver/surface/clear_glass.h"

namespace sunload::study_sections {

namespace {

namespace fs = std::filesystem;

constexpr Range emissions_w_m2{0, 1e7};  // the surface of the sun has 6.3e7
constexpr Range emissions_lm_m2{0, 1e10};
constexpr Range powers_w{0, 1e15};  // of a light in a file: to the sun's on a thousand km2
constexpr Range refractive_indices{0.01, 10};  // silver has 0.05 in green, germanium 5
constexpr Range extinctions{0, 100, Range::Low::excluded,
                            "glass has no such key: it has absorption_per_m"};
constexpr Range thicknesses_m{0, 1, Range::Low::excluded};
constexpr Range absorptions_per_m{0, 1e5};
constexpr int most_panes = 10;
constexpr Range normal_transmittances{0, 1, Range::Low::excluded};  // check_clear_glass: below 1
constexpr Range exponents{0, 1e5};                                  // a lobe of some 0.4 degrees
constexpr Range margins_m{0, 1e5};
constexpr Range edges_m{1e-6, 1e9};
constexpr Range areas_m2{0, 1e6};
constexpr Range tolerances{1e-4, 1e3};
constexpr Range link_thresholds{0, 1e3};
constexpr double share_rounding = 1e-12;  // of the sum of two decimal numbers

void read_parallel_sources(YamlMap& map, const std::string& folder, SceneStudy& scene) {
  scene.parallel_sources = read_path(map, "parallel_sources", folder);
  scene.parallel_sources_where = map.where("parallel_sources");
}

BuiltinStudy read_builtin(YamlMap& map) {
  BuiltinStudy builtin;
  builtin.where = map.where();
  map.require("name");
  builtin.name = map.text("name", builtin.name);
  const auto parameters = map.other_keys();
  for (const auto& key : parameters)
    if (auto value = map.text(key)) builtin.parameters[key] = std::move(*value);
  const auto names = builtin_scene_names();
  if (builtin.name.empty()) return builtin;
  if (std::find(names.begin(), names.end(), builtin.name) == names.end()) {
    map.problem("name", "'" + builtin.name + "' is no built-in scene", "",
                key_hint(builtin.name, names));
    return builtin;
  }
  const auto known = builtin_parameters(builtin.name);
  for (const auto& key : parameters) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    map.problem(key, builtin.name + " has no such parameter", "", key_hint(key, known));
  }
  return builtin;
}

/// Which keys may stand together: panes, clear glass, metals, constant shares exclude each other.
void check_kind(YamlMap& map, const MaterialStudy& material) {
  const auto excluded = [&](const std::vector<std::string>& keys, const std::string& what,
                            const std::string& why) {
    for (const auto& key : keys)
      if (map.has(key)) map.problem(key, what, why);
  };
  const std::vector<std::string> of_panes{"thickness_m", "absorption_per_m", "panes"};
  if (map.has("normal_transmittance")) {
    excluded({"refractive_index", "extinction_coefficient"},
             "cannot stand with normal_transmittance", "the index says what is transmitted");
    excluded(of_panes, "cannot stand with normal_transmittance",
             "that is of all the glass, whatever it consists of");
    excluded({"glossy"}, "cannot stand with normal_transmittance", "clear glass is smooth");
    excluded({"transmittance"}, "cannot stand with normal_transmittance",
             "the one stays in the scene, the other leaves it");
  } else if (!map.has("refractive_index")) {
    for (const auto& key : of_panes)
      if (map.has(key)) map.warn(key, "is not used", "it belongs to panes: refractive_index");
    excluded({"extinction_coefficient"}, "stands without refractive_index",
             "a metal has both parts of its complex index");
  } else {
    excluded({"mirror", "glossy", "transmittance"}, "cannot stand with refractive_index",
             "it follows from the index, at every angle");
    if (map.has("extinction_coefficient")) {
      excluded(of_panes, "cannot stand with extinction_coefficient", "no light passes a metal");
    } else if (const auto* panes = std::get_if<Panes>(&material.smooth);
               panes && panes->refractive_index <= 1) {
      map.problem("refractive_index", fmt::format("{} is not above 1", panes->refractive_index),
                  "panes are denser than air", "metals have an extinction_coefficient, too");
    }
  }
  if (material.glossy > 0 && !map.has("glossy_exponent"))
    map.problem("glossy", "stands without glossy_exponent", "that is the width of its lobe",
                "10 is a broad lobe, 1000 a narrow one");
  if (map.has("glossy_exponent") && !map.has("glossy"))
    map.warn("glossy_exponent", "is not used", "it belongs to glossy");
}

/// No surface sends on more than it receives.
void check_sum(YamlMap& map, const MaterialStudy& material) {
  const double diffuse =
      material.diffuse_rgb ? std::ranges::max(*material.diffuse_rgb) : material.diffuse.value_or(0);
  const std::pair<const char*, double> parts[] = {{"diffuse", diffuse},
                                                  {"mirror", material.mirror.value_or(0)},
                                                  {"glossy", material.glossy},
                                                  {"transmittance", material.transmittance}};
  double sum = 0;
  std::string terms, last;
  for (const auto& [key, share] : parts) {
    if (!map.has(key)) continue;
    sum += share;
    terms += (terms.empty() ? "" : " + ") + std::string(key);
    last = key;
  }
  if (sum > 1 + share_rounding)
    map.problem(last, fmt::format("{} = {} is above 1", terms, sum),
                "no surface reflects more than it receives");
}

/// Nor does clear glass, which passes most of light from the normal.
void check_clear_glass(YamlMap& map, const MaterialStudy& material) {
  const auto* glass = std::get_if<ClearGlass>(&material.smooth);
  if (!glass) return;
  const double reflected = material.diffuse.value_or(0) + material.mirror.value_or(0);
  const double most = largest_normal_transmittance(reflected);
  if (glass->normal_transmittance <= most + share_rounding) return;
  constexpr double digits = 1e4;
  const double shown = std::max(0.0, std::floor(most * digits) / digits);
  map.problem(
      "normal_transmittance", fmt::format("{} is above {}", glass->normal_transmittance, shown),
      fmt::format("the angular formula transmits {} times that at normal incidence{}",
                  clear_glass_factor,
                  reflected > 0 ? fmt::format(", diffuse + mirror reflect {:.6g}", reflected) : ""),
      reflected > 0 ? "less diffuse or mirror leaves more" : "");
}

/// One share, or its red, green and blue.
void read_diffuse(YamlMap& map, MaterialStudy& material) {
  const std::string key = "diffuse";
  material.diffuse_of_weather = is_of_weather(map, key);
  if (material.diffuse_of_weather) return;
  if (map.kind(key) != YamlNode::Kind::list) {
    material.diffuse = map.number(key, shares);
    return;
  }
  const auto rgb = map.numbers(key, shares);
  const std::size_t written = map.tree(key)->items.size();
  if (written != band_count) {
    map.problem(key, fmt::format("has {} values", written), "one value, or red, green and blue");
  } else if (rgb.size() == written) {
    material.diffuse_rgb = {rgb[0], rgb[1], rgb[2]};
    material.diffuse = mean_of(*material.diffuse_rgb);
  }
  for (const char* other : {"refractive_index", "normal_transmittance", "glossy"})
    if (map.has(other))
      map.problem(key, fmt::format("has a colour beside {}", other),
                  "what such a surface does with light does not depend on the band",
                  "write one value");
}

/// The kind that the keys belong to; check_kind() tells of keys of several.
Smooth read_smooth(YamlMap& map) {
  const auto index = map.number("refractive_index", refractive_indices);
  const auto extinction = map.number("extinction_coefficient", extinctions);
  Panes panes;
  panes.thickness_m = map.number("thickness_m", thicknesses_m, panes.thickness_m);
  panes.absorption_per_m =
      map.number("absorption_per_m", absorptions_per_m, panes.absorption_per_m);
  panes.count = map.integer("panes", 1, most_panes, panes.count);
  const auto normal_transmittance = map.number("normal_transmittance", normal_transmittances);
  if (normal_transmittance) return ClearGlass{*normal_transmittance};
  if (!index) return ConstantShares{};
  if (extinction) return Metal{*index, *extinction};
  panes.refractive_index = *index;
  return panes;
}

MaterialStudy read_material(const std::string& name, YamlMap& map) {
  MaterialStudy material;
  material.name = name;
  material.where = map.where();
  read_diffuse(map, material);
  material.mirror = map.number("mirror", shares);
  material.emission_w_m2 = map.number("emission_w_m2", emissions_w_m2, material.emission_w_m2);
  material.emission_lm_m2 = map.number("emission_lm_m2", emissions_lm_m2, material.emission_lm_m2);
  if (map.has("emission_w_m2") && map.has("emission_lm_m2"))
    map.problem("emission_lm_m2", "stands beside emission_w_m2",
                "light.quantity decides which of them is meant", "leave one of them out");
  material.smooth = read_smooth(map);
  material.glossy = map.number("glossy", shares, material.glossy);
  material.glossy_exponent = map.number("glossy_exponent", exponents, material.glossy_exponent);
  material.transmittance = map.number("transmittance", shares, material.transmittance);
  if (map.has("sides")) {
    material.sides = map.choice("sides", Sides::one);
  }
  map.tree("sides");
  material.seasons = read_season_materials(map);
  check_kind(map, material);
  check_sum(map, material);
  check_clear_glass(map, material);
  return material;
}

AssignRule read_rule(YamlMap& map) {
  AssignRule rule;
  rule.where = map.where();
  rule.object = map.text("object", rule.object);
  rule.surface = map.word("surface", {surface_names.begin(), surface_names.end()}, rule.surface);
  rule.material_was = map.text("was", rule.material_was);
  rule.kind = map.text("type", rule.kind);
  rule.selection = read_selection_name(map);
  map.require("material", "a rule assigns one");
  rule.material = map.text("material", rule.material);
  return rule;
}

std::optional<GroundStudy> read_ground(YamlMap& map) {
  GroundStudy ground;
  if (map.kind("ground") == YamlNode::Kind::text) {
    map.word("ground", {"none"}, "none");
    ground.wanted = false;
    return ground;
  }
  map.section("ground", [&](YamlMap& section) {
    ground.margin_m = section.number("margin_m", margins_m, ground.margin_m);
    ground.material = section.text("material", ground.material);
    const std::string surface = section.word("surface", {"feet", "level", "none"}, "feet");
    ground.wanted = surface != "none";
    if (surface == "level") ground.surface = GroundSurface::level;
    ground.height_m = section.number("height_m", heights_m);
    if (ground.height_m && surface != "level")
      section.problem("height_m", "stands without surface: level",
                      "a ground through the feet has many heights",
                      "write surface: level, or leave it out");
  });
  return map.has("ground") ? std::optional(ground) : std::nullopt;
}

void check_source(YamlMap& map) {
  const bool files = map.has("files"), builtin = map.has("builtin");
  if (files == builtin && map.is_usable()) {
    map.reading().problem(
        map.where(), files ? "scene has files and builtin" : "scene has neither files nor builtin",
        "it needs one of the two",
        files ? "a variant removes a key of the base with `files: ~` or `builtin: ~`" : "");
  }
  for (const char* key :
       {"up", "unit_m", "lod", "vrml_colour", "vrml_excess", "emission_scale_w"}) {
    if (builtin && map.has(key) && !map.has("parallel_sources"))
      map.warn(key, "is not used", "it belongs to files");
  }
}

}  // namespace

SceneStudy read_scene(YamlMap& map, const std::string& folder) {
  SceneStudy scene;
  scene.where = map.where();
  scene.files = read_scene_files(map, folder);
  read_parallel_sources(map, folder, scene);
  scene.luminaires = read_luminaires(map, folder);
  const bool describe = map.reading().purpose == YamlReading::Purpose::describe;
  map.tree("builtin");
  if (map.has("builtin") || describe) {
    map.section("builtin", [&](YamlMap& section) { scene.builtin = read_builtin(section); });
  }
  check_source(map);
  scene.up = map.choice<char>("up", {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}}, scene.up);
  scene.unit_m = map.number("unit_m", units_m, scene.unit_m);
  scene.lod = map.text("lod", scene.lod);
  check_lod(map, scene.lod);
  scene.vrml_colour = map.choice("vrml_colour", scene.vrml_colour);
  scene.vrml_excess = map.choice("vrml_excess", scene.vrml_excess);
  scene.emission_scale_w = map.number("emission_scale_w", powers_w, scene.emission_scale_w);
  scene.repair = map.choice("repair", scene.repair);
  scene.orient = map.choice("orient", scene.orient);
  map.named("materials", [&](const std::string& name, YamlMap& material) {
    scene.materials.push_back(read_material(name, material));
  });
  map.each("assign", [&](YamlMap& rule) { scene.assign.push_back(read_rule(rule)); });
  for (auto& [text, where] : map.texts("land"))
    scene.land.push_back({std::move(text), std::move(where)});
  for (auto& [name, where] : map.texts("cut"))
    scene.cut.push_back({std::move(name), {}, std::move(where)});
  scene.ground = read_ground(map);
  scene.edit = read_scene_edit(map, folder);
  return scene;
}

namespace {

/// A threshold of the other oracle would be without effect.
void check_oracle_keys(YamlMap& map, Oracle oracle) {
  if (oracle != Oracle::light_load && map.has("light_tolerance"))
    map.warn("light_tolerance", "is not used", "it belongs to oracle: default");
  if (oracle != Oracle::historic && map.has("light_threshold_m2"))
    map.warn("light_threshold_m2", "is not used", "it belongs to oracle: historic");
}

}  // namespace

MeshStudy read_mesh(YamlMap& map) {
  MeshStudy mesh;
  mesh.max_edge_m = map.number("max_edge_m", edges_m, mesh.max_edge_m);
  mesh.min_area_m2 = map.number("min_area_m2", areas_m2, mesh.min_area_m2);
  mesh.oracle = map.choice("oracle", mesh.oracle);
  mesh.light_tolerance = map.number("light_tolerance", tolerances, mesh.light_tolerance);
  mesh.light_threshold_m2 = map.number("light_threshold_m2", areas_m2, mesh.light_threshold_m2);
  mesh.t_vertices = map.choice("t_vertices", mesh.t_vertices);
  mesh.link_threshold = map.number("link_threshold", link_thresholds, mesh.link_threshold);
  check_oracle_keys(map, mesh.oracle);
  return mesh;
}

}  // namespace sunload::study_sections
