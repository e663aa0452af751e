// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "geo/builtin/scenes.h"
#include "geo/builtin/shapes.h"

namespace sunload::builtin {
namespace {

constexpr double plaza_level = 0.15, plaza_foot = -0.5;

/// Only the cladding of tower_1 has a mirror reflectance (0.85, as the historic
/// windows). Others within the ranges of Oke (1987), table 7.4; the windows of
/// the diffuse towers are dark because the rooms behind are.
struct TowerMaterials {
  MaterialId mirror_glass, metal, stone, concrete, light_panel, red_granite, window, paving,
      asphalt, roof_gravel;

  explicit TowerMaterials(Builder& b) {
    mirror_glass = b.material("mirror_glass", 0.05, 0.85);
    metal = b.material("metal", 0.45);
    stone = b.material("stone", 0.35);
    concrete = b.material("concrete", 0.30);
    light_panel = b.material("light_panel", 0.60);
    red_granite = b.material("red_granite", 0.22);
    window = b.material("window", 0.10);
    paving = b.material("paving", 0.30);
    asphalt = b.material("asphalt", 0.12);
    roof_gravel = b.material("roof_gravel", 0.15);
  }
};

/// A part of a tower with upright sides; glass in a grid of recesses on each.
struct Tier {
  Ring outline;  ///< counter-clockwise from above, about the tower's axis
  double top;    ///< height above the plaza [m]
  int columns, rows;
};

struct Tower {
  std::string name;
  Point2 centre;
  std::vector<Tier> tiers;  ///< from below; each outline inside the one before
  Finish wall, glass, roof;
  double rib = 0.8;     ///< width of the wall between panes [m]
  double recess = 0.3;  ///< depth of the panes behind the wall [m]
  double base = 6;      ///< height of the first row above the tier's foot [m]
};

/// Glass in rows and columns on one side of a tier.
void add_side(Face& side, const Tower& tower, const Tier& tier, double foot) {
  constexpr double head = 2.5;  // wall above the highest pane [m]
  const double width = side.high().u - tower.rib;
  const double pitch = width / tier.columns;
  const double storey = (side.high().v - foot - head) / tier.rows;
  for (int i = 0; i < tier.columns; ++i)
    for (int j = 0; j < tier.rows; ++j) {
      const double left = tower.rib + i * pitch, low = foot + j * storey;
      side.step(rectangle({left, low}, {left + pitch - tower.rib, low + storey - tower.rib}),
                -tower.recess, tower.wall, tower.glass)
          .emit();
    }
  side.emit();
}

/// A deck behind a parapet, with a house for lifts and cooling.
void add_roof(Face& roof, const Ring& outline, const Tower& tower) {
  constexpr double parapet_share = 0.95, parapet_depth = 1.5;
  constexpr double plant_share = 0.45, plant_height = 6, shaft_share = 0.3, shaft_depth = 1;
  Face deck = roof.step(scaled(outline, {}, parapet_share), -parapet_depth, tower.wall, tower.roof);
  Face plant = deck.step(scaled(outline, {}, plant_share), plant_height, tower.wall, tower.roof);
  plant.step(scaled(outline, {}, shaft_share), -shaft_depth, tower.wall, tower.roof).emit();
  plant.emit();
  deck.emit();
}

void add_tower(Builder& b, const Tower& tower, MaterialId floor_material) {
  b.begin_object(tower.name, {{tower.centre.u, tower.centre.v, plaza_level}});
  double z = 0;
  for (std::size_t t = 0; t < tower.tiers.size(); ++t) {
    const Tier& tier = tower.tiers[t];
    for (std::size_t i = 0; i < tier.outline.size(); ++i) {
      const Point2 a = tier.outline[i], c = tier.outline[(i + 1) % tier.outline.size()];
      const double length = std::hypot(c.u - a.u, c.v - a.v);
      const Vec3 along{(c.u - a.u) / length, (c.v - a.v) / length, 0};
      Face side(b, {{a.u, a.v, z}, along, {0, 0, 1}}, rectangle({0, 0}, {length, tier.top - z}),
                tower.wall);
      add_side(side, tower, tier, t == 0 ? tower.base : tower.rib);
    }
    Face top(b, {{0, 0, tier.top}, {1, 0, 0}, {0, 1, 0}}, tier.outline,
             t + 1 < tower.tiers.size() ? tower.roof : tower.wall);
    if (t + 1 < tower.tiers.size())
      top.cut(tower.tiers[t + 1].outline);
    else
      add_roof(top, tier.outline, tower);
    top.emit();
    z = tier.top;
  }
  std::vector<Vec3> foot;
  for (const auto p : tower.tiers[0].outline) foot.insert(foot.begin(), {p.u, p.v, 0});
  b.face({foot}, {floor_material, Surface::floor});
}

Ring block(double width, double depth) {
  return rectangle({-width / 2, -depth / 2}, {width / 2, depth / 2});
}

std::vector<Tower> all_towers(const TowerMaterials& m) {
  const auto wall = [](MaterialId material) { return Finish{material, Surface::wall}; };
  const Finish window{m.window, Surface::window}, roof{m.roof_gravel, Surface::roof};
  // Seen from the south: tower_1 front left, tower_2 front right, three behind.
  return {
      {.name = "tower_1",
       .centre = {-48, -38},
       .tiers = {{block(34, 34), 150, 5, 4}},
       .wall = wall(m.metal),
       .glass = {m.mirror_glass, Surface::window},
       .roof = roof,
       .rib = 0.3,
       .recess = 0.1},
      {.name = "tower_2",
       .centre = {44, -42},
       .tiers = {{block(40, 36), 45, 5, 1}, {block(30, 26), 90, 4, 1}, {block(18, 16), 125, 2, 1}},
       .wall = wall(m.stone),
       .glass = window,
       .roof = roof,
       .rib = 1.8},
      {.name = "tower_3",
       .centre = {-58, 52},
       .tiers = {{block(56, 20), 110, 1, 10}},
       .wall = wall(m.light_panel),
       .glass = window,
       .roof = roof,
       .rib = 2.5},
      {.name = "tower_4",
       .centre = {8, 48},
       .tiers = {{regular_polygon(8, 20), 170, 1, 4}},
       .wall = wall(m.concrete),
       .glass = window,
       .roof = roof,
       .rib = 3},
      {.name = "tower_5",
       .centre = {66, 40},
       .tiers = {{regular_polygon(12, 19), 30, 1, 1}, {regular_polygon(12, 15), 95, 1, 2}},
       .wall = wall(m.red_granite),
       .glass = window,
       .roof = roof,
       .rib = 2},
  };
}

void add_ground(Builder& b, const TowerMaterials& m, const std::vector<Tower>& towers) {
  constexpr double half_width = 105, half_depth = 95, road_width = 16, kerb_width = 0.3;
  std::vector<Ring> shafts;
  for (const auto& tower : towers) {
    Ring shaft = tower.tiers[0].outline;
    const double reach = std::hypot(shaft[0].u, shaft[0].v);
    shafts.push_back(moved(scaled(shaft, {}, 1 + joint / reach), tower.centre));
  }
  const auto ring = [](double margin) {
    return rectangle({-half_width - margin, -half_depth - margin},
                     {half_width + margin, half_depth + margin});
  };
  const auto finish = [](MaterialId material) {  // all but the top is in the soil
    const Finish buried{material, Surface::floor};
    return PrismFinish{buried, {material, Surface::ground}, buried, buried};
  };
  b.begin_object("plaza");
  prism(b, ring(0), plaza_foot, plaza_level, finish(m.paving), shafts);
  b.begin_object("kerb");
  PrismFinish kerb = finish(m.stone);
  kerb.side.surface = Surface::ground;  // seen from the road
  prism(b, ring(kerb_width), 0, plaza_level, kerb, {ring(joint)});
  b.begin_object("road");
  prism(b, ring(kerb_width + road_width), plaza_foot, 0, finish(m.asphalt),
        {ring(kerb_width + joint)});
}

}  // namespace

PolygonModel skyscrapers() {
  Builder b("builtin:skyscrapers");
  const TowerMaterials m(b);
  const auto towers = all_towers(m);
  for (const auto& tower : towers) add_tower(b, tower, m.concrete);
  add_ground(b, m, towers);
  return b.take();
}

}  // namespace sunload::builtin
