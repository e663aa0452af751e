// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <utility>
#include <vector>

#include "geo/builtin/scenes.h"
#include "geo/builtin/tenement.h"

namespace sunload::builtin {
namespace {

// Ground plan [m]: y = 0 is the middle of the street, fronts stand at ±8.
constexpr double party_joint = 0.05;  // expansion joint between houses
constexpr double front_line = 8;
constexpr double kerb_line = 4.5;  // half the carriageway: two lanes and parking
constexpr double kerb_width = 0.2;
constexpr double pavement_level = 0.12;
constexpr double plate_foot = -0.3;
constexpr double yard_depth = 24;  // from the front line to the end of the yards
constexpr double west_end = -30, east_end = 29;

/// Typical reflectances: Oke (1987), Boundary Layer Climates, 2nd edition,
/// table 7.4 (asphalt 0.05–0.20, concrete 0.10–0.35, brick 0.20–0.40, tile
/// 0.10–0.35, stone 0.20–0.35, light paint 0.50–0.90, red and green paint
/// 0.20–0.35, grass 0.16–0.26 in table 1.1); values within these ranges.
struct StreetMaterials {
  MaterialId plaster_light, plaster_ochre, plaster_green, brick, stone, stucco, roof_tile, asphalt,
      pavement_stone, concrete, metal, frame_paint, door_paint, window, glass, grass;

  explicit StreetMaterials(Builder& b) {
    plaster_light = b.material("plaster_light", 0.65);
    plaster_ochre = b.material("plaster_ochre", 0.50);
    plaster_green = b.material("plaster_green", 0.35);
    brick = b.material("brick", 0.35);
    stone = b.material("stone", 0.30);
    stucco = b.material("stucco", 0.70);
    roof_tile = b.material("roof_tile", 0.25);
    asphalt = b.material("asphalt", 0.12);
    pavement_stone = b.material("pavement_stone", 0.30);
    concrete = b.material("concrete", 0.30);
    metal = b.material("metal", 0.45);
    frame_paint = b.material("frame_paint", 0.70);
    door_paint = b.material("door_paint", 0.20);
    // A plain pane at normal incidence reflects 8 % (Fresnel, both faces); the room behind is dark.
    window = b.material("window", 0.05, 0.08);
    // Coated glass of the historic test scenes: mirror reflectance 0.85.
    glass = b.material("glass", 0.05, 0.85);
    grass = b.material("grass", 0.22);
  }
};

HouseFinishes house_finishes(const StreetMaterials& m, MaterialId wall, MaterialId base_wall) {
  return {.wall = {wall, Surface::wall},
          .base_wall = {base_wall, Surface::wall},
          .trim = {m.stucco, Surface::wall},
          .frame = {m.frame_paint, Surface::window},
          .window = {m.window, Surface::window},
          .door = {m.door_paint, Surface::wall},
          .roof = {m.roof_tile, Surface::roof},
          .balcony = {m.concrete, Surface::wall},
          .floor = {m.concrete, Surface::floor},
          .chimney = {m.brick, Surface::wall}};
}

/// A plate of the ground; only its top is lit, the rest is in the soil.
void plate(Builder& builder, const std::string& name, const Ring& outline, double level,
           MaterialId material) {
  builder.begin_object(name);
  const Finish buried{material, Surface::floor};
  prism(builder, outline, plate_foot, level, {buried, {material, Surface::ground}, buried, buried});
}

/// A kerb: the side towards the road is open above the road's level.
void kerb(Builder& builder, const std::string& name, Placement placement, MaterialId material) {
  builder.begin_object(name, placement);
  const double length = east_end - west_end;
  const Finish buried{material, Surface::floor}, lit{material, Surface::ground};
  Sweep body(builder,
             {{{0, plate_foot}, buried, ""},
              {{kerb_width, plate_foot}, buried, ""},
              {{kerb_width, pavement_level}, lit, ""},
              {{0, pavement_level}, lit, ""},
              {{0, 0}, buried, ""}},
             length, buried);
  body.emit();
}

void add_ground(Builder& b, const StreetMaterials& m, const std::vector<House>& north,
                const std::vector<House>& south) {
  plate(b, "road", rectangle({west_end, -kerb_line + joint}, {east_end, kerb_line - joint}), 0,
        m.asphalt);
  kerb(b, "kerb_north", {{west_end, kerb_line, 0}}, m.stone);
  kerb(b, "kerb_south", {{east_end, -kerb_line, 0}, Turn::half}, m.stone);
  const double inner = kerb_line + kerb_width + joint, outer = front_line - joint;
  plate(b, "pavement_north", rectangle({west_end, inner}, {east_end, outer}), pavement_level,
        m.pavement_stone);
  plate(b, "pavement_south", rectangle({west_end, -outer}, {east_end, -inner}), pavement_level,
        m.pavement_stone);
  // The yards go round the houses; `first` stands west of `second`.
  const auto yard = [&](const std::string& name, const House& first, const House& second,
                        double west, double middle, double east, double side) {
    Ring ring{{west_end, front_line},
              {west - joint, front_line},
              {west - joint, front_line + first.depth + joint},
              {middle, front_line + first.depth + joint},
              {middle, front_line + second.depth + joint},
              {east + joint, front_line + second.depth + joint},
              {east + joint, front_line},
              {east_end, front_line},
              {east_end, front_line + yard_depth},
              {west_end, front_line + yard_depth}};
    if (side < 0) {
      for (auto& p : ring) p.v = -p.v;
      ring = Ring(ring.rbegin(), ring.rend());
    }
    plate(b, name, ring, pavement_level, m.grass);
  };
  const auto west = [](const House& h) { return h.placement({0, 0, 0}).x; };
  const auto far = [](const House& h) { return h.placement({h.width, 0, 0}).x; };
  yard("yard_north", north[0], north[1], west(north[0]), west(north[1]) - party_joint / 2,
       far(north[1]), 1);
  yard("yard_south", south[0], south[1], far(south[0]), far(south[1]) - party_joint / 2,
       west(south[1]), -1);
}

/// Lanterns along both kerbs; outline of foot, pole, lantern and lid.
void add_lamps(Builder& b, const StreetMaterials& m) {
  const std::vector<Point2> outline{{0, 0},      {0.16, 0},   {0.16, 0.7}, {0.07, 0.9},
                                    {0.05, 4.0}, {0.12, 4.1}, {0.22, 4.7}, {0.28, 4.75},
                                    {0.10, 5.0}, {0, 5.15}};
  constexpr double from_kerb = 0.5, spacing = 18;
  constexpr int sides = 6;
  int number = 0;
  for (const double y : {kerb_line + kerb_width + from_kerb, -kerb_line - kerb_width - from_kerb})
    for (const double x : {-spacing / 2, spacing / 2}) {
      b.begin_object("lamp_" + std::to_string(++number));
      lathe(b, {x + (y < 0 ? spacing / 4 : -spacing / 4), y, pavement_level + joint}, outline,
            sides, {m.metal, Surface::other}, {m.metal, Surface::floor});
    }
}

}  // namespace

PolygonModel street(House3 variant) {
  Builder b("builtin:street");
  const StreetMaterials m(b);
  constexpr double z = pavement_level;
  const House house_1{.name = "house_1",
                      .placement = {{-22 - party_joint, front_line, z}},
                      .width = 22,
                      .depth = 12,
                      .storeys = {4.2, 3.7, 3.6, 3.5},
                      .axes = 7,
                      .rear_axes = 5,
                      .ridge = 4.6,
                      .ground_floor = GroundFloor::shops,
                      .window = {.panes = Panes::two, .hood = 0.12},
                      .balcony_axes = {3},
                      .door_axis = 3,
                      .dormers = 4,
                      .chimneys = 2,
                      .gable_axes = 1};
  const House house_2{.name = "house_2",
                      .placement = {{0, -front_line, z}, Turn::half},
                      .width = 23,
                      .depth = 11,
                      .storeys = {3.8, 3.5, 3.3},
                      .axes = 7,
                      .rear_axes = 7,
                      .ridge = 5,
                      .window = {.width = 1.05, .height = 1.7, .panes = Panes::two},
                      .door_axis = 2,
                      .dormers = 5,
                      .roof_windows = 3,
                      .chimneys = 2,
                      .gable_axes = 2};
  const House house_3{.name = "house_3",
                      .placement = {{0, front_line, z}},
                      .width = 20,
                      .depth = 13,
                      .storeys = {3.9, 3.3, 3.3, 3.3},
                      .axes = 6,
                      .rear_axes = 6,
                      .ridge = 5.4,
                      .window = {.width = 1.2, .height = 1.75, .panes = Panes::two},
                      .door_axis = 1,
                      .dormers = 3,
                      .roof_windows = 3,
                      .chimneys = 3,
                      .gable_axes = 2};
  const House house_4{.name = "house_4",
                      .placement = {{21 + party_joint, -front_line, z}, Turn::half},
                      .width = 21,
                      .depth = 12,
                      .storeys = {4.0, 3.6, 3.5},
                      .axes = 6,
                      .rear_axes = 6,
                      .roof = Roof::mansard,
                      .ridge = 4.2,
                      .ground_floor = GroundFloor::shops,
                      .window = {.width = 1.2, .panes = Panes::two, .hood = 0.1},
                      .balcony_axes = {1, 4},
                      .door_axis = 4,
                      .dormers = 6,
                      .chimneys = 2,
                      .gable_axes = 1};
  add_house(b, house_1, house_finishes(m, m.plaster_ochre, m.stone), FreeGable::low_x);
  add_house(b, house_2, house_finishes(m, m.plaster_light, m.plaster_light), FreeGable::high_x);
  if (variant == House3::brick)
    add_house(b, house_3, house_finishes(m, m.brick, m.brick), FreeGable::high_x);
  else
    add_glazed_house(
        b, house_3, house_finishes(m, m.concrete, m.concrete),
        {{m.metal, Surface::wall}, {m.glass, Surface::window}, {m.concrete, Surface::roof}},
        FreeGable::high_x);
  add_house(b, house_4, house_finishes(m, m.plaster_green, m.stone), FreeGable::low_x);
  add_ground(b, m, {house_1, house_3}, {house_2, house_4});
  add_lamps(b, m);
  return b.take();
}

}  // namespace sunload::builtin
