// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/material_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/units.h"
#include "solver/surface/material.h"

namespace sunload {

namespace {

// A source with an asterisk was not at hand: its values are from memory.
constexpr const char* oke_natural = "Oke (1987), Boundary Layer Climates, table 1.1 *";
constexpr const char* oke_urban = "Oke (1987), Boundary Layer Climates, table 8.2 *";
constexpr const char* hunn =
    "Hunn & Calafell (1977), Solar Energy 19, 87-89; in Thevenard & Haddad (2006), Energy and "
    "Buildings 38, 972-980 *";
constexpr const char* roofing =
    "Cool Roofing Materials Database, Lawrence Berkeley National Laboratory (2000)";
constexpr const char* incropera =
    "Incropera & DeWitt (2002), Fundamentals of Heat and Mass Transfer, table A.12 *";
constexpr const char* solweig =
    "Parameters of SOLWEIG: Lindberg, Holmer & Thorsson (2008), Int. J. Biometeorology 52, 697-713";
constexpr const char* wood_walls = "Parameters of SOLWEIG: Wallenberg et al. (2025)";
constexpr const char* lecture =
    "Lecture notes on reflection of light, section 4.1, table of albedo";
constexpr const char* panes =
    "Duffie & Beckman (2013), Solar Engineering of Thermal Processes, section 5.1: index, middle "
    "of "
    "the range of absorption *";
constexpr const char* konarska =
    "Konarska et al. (2014), Theor. Appl. Climatology 117, 363-376 (transmission of a whole "
    "crown, here the square of a surface's); reflectance: Oke (1987), table 1.1 *";

// Of one surface: light through a crown crosses two. Whole crowns pass 3 % in leaf and 46 % bare.
constexpr double skin_in_leaf = 0.173, skin_bare = 0.678;
constexpr double glass_index = 1.526, glass_absorption_per_m = 18;  // 4 (clear) ... 32 (green edge)

constexpr std::array table{
    TabledMaterial{"aluminium", 0.86, 0.86, "anodised aluminium sheet", incropera},
    TabledMaterial{"asphalt", 0.05, 0.20, "road", oke_urban},
    TabledMaterial{"asphalt_weathered", 0.10, 0.10, "old road", hunn},
    TabledMaterial{"bitumen", 0.06, 0.06, "smooth black roofing membrane", roofing},
    TabledMaterial{"bitumen_white", 0.26, 0.26, "roofing membrane with white granules", roofing},
    TabledMaterial{"brick", 0.20, 0.40, "facing brick", oke_urban},
    TabledMaterial{"brick_red", 0.37, 0.37, "red brick", incropera},
    TabledMaterial{"clay_tile", 0.33, 0.33, "red clay roof tile", roofing},
    TabledMaterial{"concrete", 0.10, 0.35, "wall or pavement", oke_urban},
    TabledMaterial{"concrete_tile", 0.25, 0.25, "unpainted cement roof tile", roofing},
    TabledMaterial{"concrete_weathered", 0.22, 0.22, "old concrete", hunn},
    TabledMaterial{"corrugated_iron", 0.10, 0.16, "roof, rusty", oke_urban},
    TabledMaterial{"crop", 0.18, 0.25, "field crops", oke_natural},
    TabledMaterial{"crown", 0.15, 0.20, "crown of a deciduous tree in leaf", konarska, 0,
                   skin_in_leaf, 0, 0, 1, Sides::two},
    TabledMaterial{"crown_bare", 0.15, 0.15, "crown of a deciduous tree without leaves", konarska,
                   0, skin_bare, 0, 0, 1, Sides::two},
    TabledMaterial{"double_glazing", 0, 0, "two panes of clear glass of 4 mm", panes, 0, 0,
                   glass_index, glass_absorption_per_m, 2},
    TabledMaterial{"forest", 0.15, 0.20, "deciduous forest in leaf, from above", oke_natural},
    TabledMaterial{"forest_conifer", 0.05, 0.15, "coniferous forest, from above", oke_natural},
    TabledMaterial{"glass", 0, 0, "pane of clear glass of 4 mm", panes, 0, 0, glass_index,
                   glass_absorption_per_m},
    TabledMaterial{"grass", 0.16, 0.26, "long to short grass", oke_natural},
    TabledMaterial{"grass_dry", 0.20, 0.20, "dry grass", hunn},
    TabledMaterial{"gravel", 0.20, 0.20, "crushed rock", hunn},
    TabledMaterial{"gravel_roof", 0.08, 0.18, "tar and gravel", oke_urban},
    TabledMaterial{"gravel_roof_light", 0.34, 0.34, "light gravel on a built-up roof", roofing},
    TabledMaterial{"ice", 0.30, 0.45, "ice of sea and lakes", oke_natural},
    TabledMaterial{"limestone", 0.35, 0.35, "light stone: upper end of the range of stone",
                   oke_urban},
    TabledMaterial{"paint_black", 0.02, 0.15, "black paint", oke_urban},
    TabledMaterial{"paint_dark", 0.20, 0.35, "red, brown or green paint", oke_urban},
    TabledMaterial{"paint_white", 0.50, 0.90, "white paint, whitewash", oke_urban},
    TabledMaterial{"paving", 0.20, 0.20, "cobbles and paving stones", solweig},
    TabledMaterial{"plaster", 0.60, 0.60, "light plaster or paint", hunn},
    TabledMaterial{"plaster_dark", 0.27, 0.27, "dark plaster or paint", hunn},
    TabledMaterial{"roof_tile", 0.10, 0.35, "roof tile of any kind", oke_urban},
    TabledMaterial{"sand", 0.20, 0.45, "desert sand", oke_natural},
    TabledMaterial{"shingle", 0.22, 0.22, "grey asphalt shingle", roofing},
    TabledMaterial{"slate", 0.10, 0.10, "slate roof", oke_urban},
    TabledMaterial{"snow_fresh", 0.80, 0.80, "fresh snow", lecture},
    TabledMaterial{"snow_old", 0.40, 0.40, "old snow", lecture},
    TabledMaterial{"soil", 0.15, 0.15, "bare soil", lecture},
    TabledMaterial{"soil_dark", 0.05, 0.05, "dark wet soil", oke_natural},
    TabledMaterial{"steel", 0.35, 0.35, "new galvanised sheet", incropera},
    TabledMaterial{"steel_weathered", 0.20, 0.20, "old galvanised sheet", incropera},
    TabledMaterial{"stone", 0.20, 0.35, "stone wall", oke_urban},
    TabledMaterial{"thatch", 0.15, 0.20, "thatched roof", oke_urban},
    TabledMaterial{"water", 0.03, 0.10, "water under a high sun, without glint", oke_natural},
    TabledMaterial{"wood", 0.20, 0.20, "wooden wall", wood_walls},
};

std::string range_text(const TabledMaterial& m) {
  return m.low == m.high ? "" : fmt::format("{:.2f} - {:.2f}", m.low, m.high);
}

/// What the row says beyond its diffuse reflectance, in the words of a study.
std::string further_text(const TabledMaterial& m) {
  std::string text;
  const auto add = [&](const std::string& key_value) {
    text += (text.empty() ? "" : ", ") + key_value;
  };
  if (m.mirror > 0) add(fmt::format("mirror: {:g}", m.mirror));
  if (m.refractive_index > 0)
    add(fmt::format("refractive_index: {:g}, absorption_per_m: {:g}", m.refractive_index,
                    m.absorption_per_m));
  if (m.panes > 1) add(fmt::format("panes: {}", m.panes));
  if (m.transmittance > 0) add(fmt::format("transmittance: {:g}", m.transmittance));
  if (m.sides == Sides::two) add("sides: two");
  return text;
}

}  // namespace

std::span<const TabledMaterial> material_table() { return table; }

std::optional<MaterialStudy> tabled_material(std::string_view name) {
  const auto row = std::find_if(table.begin(), table.end(),
                                [&](const TabledMaterial& m) { return m.name == name; });
  if (row == table.end()) return {};
  MaterialStudy material;
  material.name = row->name;
  material.diffuse = row->diffuse();
  if (row->refractive_index > 0) {
    material.smooth = Panes{.refractive_index = row->refractive_index,
                            .absorption_per_m = row->absorption_per_m,
                            .count = row->panes};
  } else {
    material.mirror = row->mirror;
  }
  material.transmittance = row->transmittance;
  if (row->sides == Sides::two) material.sides = Sides::two;
  return material;
}

std::vector<std::string> tabled_names() {
  std::vector<std::string> names;
  for (const auto& m : table) names.emplace_back(m.name);
  return names;
}

std::string material_page() {
  std::string text = R"(# Materials known by name

A study may name these materials in `scene.assign`, `scene.ground` and `scene.files` without defining them:
`material: asphalt`. A material that the study defines under `scene.materials`, or that a scene file has, goes before
the one of this table; `scene.materials: {brick: {}}` takes the row's values for what a file calls `brick` and gives no
reflectance. The values are part of the content that a result is known by.

Reflectances are shares of sunlight, broadband over the solar spectrum (0.3 to 3 µm). Where the source gives a range
the value is its middle; all reflect diffusely unless stated. Eyes see half of the spectrum only: a colour says little.
Light crosses the surface of a crown twice: its transmittance is the square root of the whole crown's. Rows whose source
ends with an asterisk are from memory and were not compared with it: read it before a result rests on them. This page
is what `sunload materials --markdown` writes.

| name | diffuse | range | further | what | source |
|---|---|---|---|---|---|
)";
  for (const auto& m : table)
    text += fmt::format("| `{}` | {:.3g} | {} | {} | {} | {} |\n", m.name, m.diffuse(),
                        range_text(m), further_text(m), m.what, m.source);
  return text;
}

std::string angle_listing() {
  constexpr std::array angles_deg{0, 15, 30, 45, 60, 75, 85};
  std::string text = fmt::format("{:<32}", "angle of incidence");
  for (const int angle_deg : angles_deg) text += fmt::format("{:>6}°", angle_deg);
  text += "\n";
  const auto add = [&](const std::string& name, const auto& share_of_cosine) {
    text += fmt::format("{:<32}", name);
    for (const int angle_deg : angles_deg)
      text += fmt::format("{:>7.3f}", share_of_cosine(std::cos(radians(angle_deg))));
    text += "\n";
  };
  for (const auto& row : table) {
    const MaterialStudy study = *tabled_material(row.name);
    const Material material{.name = row.name,
                            .diffuse = row.diffuse(),
                            .mirror = row.mirror,
                            .smooth = study.smooth,
                            .transmittance = row.transmittance};
    const auto passed = [&](double cosine) {
      return row.transmittance + smooth_shares(material, cosine).transmitted;
    };
    add(std::string(row.name) + ", reflected",
        [&](double cosine) { return row.diffuse() + smooth_shares(material, cosine).mirror; });
    if (passed(1) > 0) add(std::string(row.name) + ", passed", passed);
  }
  return text;
}

std::string material_listing() {
  std::string text;
  for (const auto& m : table) {
    const std::string further = further_text(m);
    text += fmt::format("{:<20} {:<6.3g} {}{}\n{:27} {}\n", m.name, m.diffuse(), m.what,
                        further.empty() ? "" : " (" + further + ")", "", m.source);
  }
  text += "* from memory, not compared with the source\n";
  return text;
}

}  // namespace sunload
