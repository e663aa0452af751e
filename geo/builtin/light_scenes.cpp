// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "geo/base/units.h"
#include "geo/builtin/scenes.h"
#include "geo/builtin/shapes.h"

namespace sunload::builtin {
namespace {

constexpr double grey = 0.5;           // reflectance of surfaces that are just there
constexpr double street_grey = 0.3;    // of walls and roads: Oke (1987), table 7.4
constexpr double mirror_glass = 0.85;  // of the historic windows

/// A level square plate with its top at z = 0, lit from above only.
void ground_plate(Builder& b, const std::string& name, Point2 low, Point2 high, MaterialId material,
                  const std::vector<Ring>& shafts = {}) {
  b.begin_object(name);
  const Finish buried{material, Surface::floor};
  prism(b, rectangle(low, high), -plate_thickness, 0,
        {buried, {material, Surface::ground}, buried, buried}, shafts);
}

/// A house-like block that stands on z = 0.
void block(Builder& b, const std::string& name, Point2 low, Point2 high, double height,
           MaterialId material) {
  b.begin_object(name);
  prism(b, rectangle(low, high), 0, height,
        {{material, Surface::wall}, {material, Surface::roof}, {material, Surface::floor}});
}

/// The shaft that a plate has where a block stands on it.
Ring shaft_of(Point2 low, Point2 high) {
  return rectangle({low.u - joint, low.v - joint}, {high.u + joint, high.v + joint});
}

/// A flat lamp: a black housing whose square underside, in `tiles` × `tiles`
/// parts around `centre`, sends light down.
void lamp(Builder& b, Vec3 centre, double side, MaterialId emitter, MaterialId housing,
          int tiles = 1) {
  constexpr double thickness_share = 0.02;
  const Vec3 up{0, 0, thickness_share * side};
  const auto at = [&](int i, int j) {
    return centre + Vec3{side * (1.0 * i / tiles - 0.5), side * (1.0 * j / tiles - 0.5), 0};
  };
  for (int i = 0; i < tiles; ++i)
    for (int j = 0; j < tiles; ++j)
      b.face({{at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)}}, {emitter});
  const int corners[4][2] = {{0, 0}, {tiles, 0}, {tiles, tiles}, {0, tiles}};
  std::vector<Vec3> top;
  for (int k = 0; k < 4; ++k) {
    const auto [i, j] = std::pair(corners[k][0], corners[k][1]);
    const auto [i_next, j_next] = std::pair(corners[(k + 1) % 4][0], corners[(k + 1) % 4][1]);
    std::vector<Vec3> ring;  // the lower edge has the corners of all tiles
    for (int step = 0; step <= tiles; ++step)
      ring.push_back(at(i + (i_next - i) / tiles * step, j + (j_next - j) / tiles * step));
    ring.push_back(at(i_next, j_next) + up);
    ring.push_back(at(i, j) + up);
    b.face({ring}, {housing});
    top.push_back(at(i, j) + up);
  }
  b.face({top}, {housing});
}

/// A square plate about the origin, its top cut so that the mesh, too, is its own mirror image
/// about x = 0.
void symmetric_plate(Builder& b, double half, MaterialId material) {
  const double h = half;
  const Ring outline{{-h, -h}, {0, -h}, {h, -h}, {h, h}, {0, h}, {-h, h}};
  const Vec3 down{0, 0, -plate_thickness};
  const auto top = [&](std::size_t k) {
    const Point2 p = outline[k % outline.size()];
    return Vec3{p.u, p.v, 0};
  };
  const Finish ground{material, Surface::ground}, buried{material, Surface::floor};
  for (const auto& [i, j, k] : {std::array{0, 1, 4}, {0, 4, 5}, {1, 2, 4}, {2, 3, 4}})
    b.face({{top(static_cast<std::size_t>(i)), top(static_cast<std::size_t>(j)),
             top(static_cast<std::size_t>(k))}},
           ground);
  std::vector<Vec3> bottom;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    b.face({{top(k) + down, top(k + 1) + down, top(k + 1), top(k)}}, buried);
    bottom.insert(bottom.begin(), top(k) + down);
  }
  b.face({bottom}, buried);
}

}  // namespace

PolygonModel box_on_plane(const BoxOnPlane& size) {
  Builder b("builtin:box_on_plane");
  const MaterialId box_material = b.material("box", street_grey);
  const MaterialId plane_material = b.material("plane", street_grey);
  const Point2 low{-size.width / 2, -size.depth / 2}, high{size.width / 2, size.depth / 2};
  block(b, "box", low, high, size.height, box_material);
  const double half = size.plane / 2;
  ground_plate(b, "plane", {-half, -half}, {half, half}, plane_material, {shaft_of(low, high)});
  return b.take();
}

PolygonModel canyon(const Canyon& size) {
  constexpr double block_depth = 10;
  Builder b("builtin:canyon");
  const MaterialId wall = b.material("wall", street_grey), road = b.material("road", street_grey);
  const double end = size.length / 2, front = size.width / 2;
  block(b, "row_north", {-end, front}, {end, front + block_depth}, size.height, wall);
  block(b, "row_south", {-end, -front - block_depth}, {end, -front}, size.height, wall);
  ground_plate(b, "road", {-end, -front + joint}, {end, front - joint}, road);
  return b.take();
}

PolygonModel room(const Room& size) {
  constexpr double shell = 0.3, lamp_share = 0.25, lamp_drop = 0.05, lamp_power_w = 100;
  constexpr double table_height = 0.75;
  Builder b("builtin:room");
  const MaterialId wall = b.material("wall", grey), ceiling = b.material("ceiling", 0.8);
  const MaterialId floor = b.material("floor", street_grey);
  const MaterialId lamp = b.material("lamp", 0, 0, lamp_power_w);
  const MaterialId furniture = b.material("furniture", 0.4);
  const double x = size.width, y = size.depth, z = size.height;
  b.begin_object("room");
  box(b, {-shell, -shell, -shell}, {x + shell, y + shell, z + shell}, {wall, Surface::floor});
  const Finish inside{wall, Surface::wall};
  sheet(b, {0, 0, 0}, {0, 0, z}, {x, 0, 0}, inside);
  sheet(b, {0, y, 0}, {x, 0, 0}, {0, 0, z}, inside);
  sheet(b, {0, 0, 0}, {0, y, 0}, {0, 0, z}, inside);
  sheet(b, {x, 0, 0}, {0, 0, z}, {0, y, 0}, inside);
  sheet(b, {0, 0, 0}, {x, 0, 0}, {0, y, 0}, {floor, Surface::ground});
  Face top(b, {{0, 0, z}, {0, 1, 0}, {1, 0, 0}}, rectangle({0, 0}, {y, x}),
           {ceiling, Surface::other});
  const double low = (1 - lamp_share) / 2, high = (1 + lamp_share) / 2;
  top.step(rectangle({low * y, low * x}, {high * y, high * x}), lamp_drop,
           {ceiling, Surface::other}, {lamp, Surface::other})
      .emit();
  top.emit();
  b.begin_object("table");  // on no feet: one with feet would only add triangles
  box(b, {0.25 * x, 0.3 * y, table_height}, {0.6 * x, 0.6 * y, table_height + 0.05},
      {furniture, Surface::other});
  return b.take();
}

PolygonModel windows() {
  constexpr double half_length = 20, half_street = 7, depth = 8, left_height = 11, right_height = 5;
  constexpr double storey = 3.4, sill = 1.0, height = 1.6, width = 2, recess = 0.1;
  constexpr int storeys = 3, axes = 8;
  Builder b("builtin:windows");
  const MaterialId wall = b.material("wall", street_grey), road = b.material("ground", street_grey);
  const MaterialId glass = b.material("glass", 0.05, mirror_glass);
  b.begin_object("building_left", {{0, half_street, 0}});
  const Finish plain{wall, Surface::wall};
  const double x = half_length, z = left_height;
  sheet(b, {x, 0, 0}, {0, depth, 0}, {0, 0, z}, plain);
  sheet(b, {x, depth, 0}, {-2 * x, 0, 0}, {0, 0, z}, plain);
  sheet(b, {-x, depth, 0}, {0, -depth, 0}, {0, 0, z}, plain);
  sheet(b, {-x, 0, z}, {2 * x, 0, 0}, {0, depth, 0}, {wall, Surface::roof});
  sheet(b, {-x, 0, 0}, {0, depth, 0}, {2 * x, 0, 0}, {wall, Surface::floor});
  Face front(b, {{-x, 0, 0}, {1, 0, 0}, {0, 0, 1}}, rectangle({0, 0}, {2 * x, z}), plain);
  for (int i = 0; i < axes; ++i)
    for (int j = 0; j < storeys; ++j) {
      const Point2 low{2 * x * (i + 0.5) / axes - width / 2, j * storey + sill};
      front
          .step(rectangle(low, {low.u + width, low.v + height}), -recess, plain,
                {glass, Surface::window})
          .emit();
    }
  front.emit();
  block(b, "building_right", {-x, -half_street - depth}, {x, -half_street}, right_height, wall);
  ground_plate(b, "ground", {-x, -half_street + joint}, {x, half_street - joint}, road);
  return b.take();
}

PolygonModel cylinder(const Cylinder& size) {
  constexpr int sides = 32;  // within 0.5 % of the circle's radius everywhere
  constexpr double low_reflectance = 0.1, box_size = 3, margin = 8;
  Builder b("builtin:cylinder");
  const MaterialId black = b.material("black", 0), dark = b.material("dark", low_reflectance);
  const Ring foot = regular_polygon(sides, size.radius);
  b.begin_object("cylinder");
  prism(b, foot, 0, size.height,
        {{black, Surface::wall}, {black, Surface::roof}, {black, Surface::floor}});
  std::vector<Ring> shafts{scaled(foot, {}, 1 + joint / size.radius)};
  int number = 0;
  for (const double side : {-1.0, 1.0}) {
    const Point2 low{side * (size.radius + box_size) - box_size / 2, -box_size / 2};
    const Point2 high{low.u + box_size, low.v + box_size};
    block(b, "box_" + std::to_string(++number), low, high, box_size, dark);
    shafts.push_back(shaft_of(low, high));
  }
  const double half = size.radius + 2 * box_size + margin;
  ground_plate(b, "plane", {-half, -half}, {half, half}, dark, shafts);
  return b.take();
}

PolygonModel emission() {
  constexpr double side = 2, height = 3, distance = 4, half_plane = 12, power_w = 100;
  constexpr int tiles = 10;
  Builder b("builtin:emission");
  const MaterialId plane = b.material("plane", grey), housing = b.material("housing", 0);
  const MaterialId one = b.material("emitter_one", 0, 0, power_w);
  const MaterialId tiled = b.material("emitter_tiled", 0, 0, power_w);
  b.begin_object("emitter_one");
  lamp(b, {-distance, 0, height}, side, one, housing);
  b.begin_object("emitter_tiled");
  lamp(b, {distance, 0, height}, side, tiled, housing, tiles);
  b.begin_object("plane");
  symmetric_plate(b, half_plane, plane);
  return b.take();
}

PolygonModel shadow() {
  constexpr double half_plane = 10, emitter_height = 12, emitter_side = 1, power_w = 1000;
  constexpr double length = 14, thickness = 0.4, spacing = 1.6, centre_height = 2.6, tilt_deg = 18;
  constexpr int boxes = 8;
  Builder b("builtin:shadow");
  const MaterialId plane = b.material("plane", grey), bar = b.material("bar", grey);
  const MaterialId emitter = b.material("emitter", 0, 0, power_w);
  const MaterialId housing = b.material("housing", 0);
  b.begin_object("emitter");
  lamp(b, {0, 0, emitter_height}, emitter_side, emitter, housing);
  for (int k = 0; k < boxes; ++k) {
    b.begin_object("bar_" + std::to_string(k + 1));
    const double y = spacing * (k - (boxes - 1) / 2.0);
    turned_box(b, {0, y, centre_height}, {length, thickness, thickness}, {0, 1, 0},
               radians(tilt_deg), {bar});
  }
  ground_plate(b, "plane", {-half_plane, -half_plane}, {half_plane, half_plane}, plane);
  return b.take();
}

PolygonModel large_extent() {
  constexpr double half_plane = 100, side = 20, emitter_height = 60, shield_height = 30;
  constexpr double total_power_w = 1e4, large_share = 0.99, copy_scale = 0.1;
  constexpr double shield_thickness = 0.4;
  Builder b("builtin:large_extent");
  const MaterialId plane = b.material("plane", grey), shield = b.material("shield", grey);
  const MaterialId housing = b.material("housing", 0);
  const auto pair = [&](const std::string& name, double scale, double power_w) {
    const MaterialId emitter = b.material("emitter_" + name, 0, 0, power_w);
    b.begin_object("emitter_" + name);
    lamp(b, {0, 0, scale * emitter_height}, scale * side, emitter, housing);
    b.begin_object("shield_" + name);
    const double half = scale * side / 2, z = scale * shield_height;
    box(b, {-half, -half, z}, {half, half, z + scale * shield_thickness}, {shield});
  };
  pair("large", 1, large_share * total_power_w);
  pair("small", copy_scale, (1 - large_share) * total_power_w);
  ground_plate(b, "plane", {-half_plane, -half_plane}, {half_plane, half_plane}, plane);
  return b.take();
}

PolygonModel complex_paths() {
  // Section along x, all within |y| ≤ 5. The emitter looks down on the tray; the tray is seen by
  // the wall and not by the screen; the wall stands above the emitter's plane, and too low to be
  // seen from the cube past the edge of the plane. emitter → tray → wall → screen → cube.
  constexpr double half_plane = 5, cube = 2, power_w = 1000, white = 0.8;
  constexpr double emitter_z = -3.6, emitter_side = 1, emitter_x = -2, tray_z = -4;
  constexpr double wall_x = 8, wall_low = -3.4, wall_high = -1.7, half_width = 3;
  constexpr double screen_z = 6, screen_low = 6, screen_high = 10, thin = 0.1;
  Builder b("builtin:complex_paths");
  const MaterialId plane = b.material("plane", grey), reflector = b.material("reflector", white);
  const MaterialId emitter = b.material("emitter", 0, 0, power_w);
  const MaterialId housing = b.material("housing", 0);
  b.begin_object("plane");
  prism(b, rectangle({-half_plane, -half_plane}, {half_plane, half_plane}), -plate_thickness, 0,
        {{plane}, {plane, Surface::ground}, {plane}});
  b.begin_object("cube");
  box(b, {-cube / 2, -cube / 2, joint}, {cube / 2, cube / 2, cube}, {plane},
      Finish{plane, Surface::floor});
  b.begin_object("emitter");
  lamp(b, {emitter_x, 0, emitter_z}, emitter_side, emitter, housing);
  b.begin_object("tray");
  box(b, {2 * emitter_x, -half_width, tray_z - thin}, {0, half_width, tray_z}, {reflector});
  b.begin_object("wall");
  box(b, {wall_x, -half_width, wall_low}, {wall_x + thin, half_width, wall_high}, {reflector});
  b.begin_object("screen");
  // A roof on all sides: with nothing below it, its underside would be taken for a floor.
  box(b, {screen_low, -half_width, screen_z}, {screen_high, half_width, screen_z + thin},
      {reflector, Surface::roof});
  return b.take();
}

PolygonModel geometric_accuracy() {
  constexpr double cube = 2, offset = 0.01 * cube, half_plane = 10, spacing = 4, power_w = 1000;
  constexpr double emitter_height = 9, emitter_side = 1, corner_depth = 0.1;
  constexpr double wedge_length = 3, wedge_height = 2, wedge_foot = 0.4;
  Builder b("builtin:geometric_accuracy");
  const MaterialId plane = b.material("plane", grey), solid = b.material("solid", grey);
  const MaterialId emitter = b.material("emitter", 0, 0, power_w);
  const MaterialId housing = b.material("housing", 0);
  b.begin_object("emitter");
  lamp(b, {-spacing, -spacing, emitter_height}, emitter_side, emitter, housing);
  const Vec3 size{cube, cube, cube};
  const Finish finish{solid};
  b.begin_object("cube_sunk");
  turned_box(b, {-spacing, 0, cube / 2 - offset}, size, {0, 0, 1}, 0, finish);
  b.begin_object("cube_lifted");
  turned_box(b, {spacing, 0, cube / 2 + offset}, size, {0, 0, 1}, 0, finish);
  b.begin_object("cube_on_corner");  // its diagonal upright, the lowest corner below the plane
  const double half_diagonal = cube * std::sqrt(3.0) / 2;
  turned_box(b, {0, 0, half_diagonal - corner_depth}, size, normalized({1, -1, 0}),
             std::acos(1 / std::sqrt(3.0)), finish);
  b.begin_object("wedge", {{0, spacing, joint}});  // seen from the south: its narrow side
  const double foot = wedge_foot / 2, y = wedge_length, top = wedge_height;
  b.face({{{-foot, 0, 0}, {foot, 0, 0}, {0, 0, top}}}, finish);
  b.face({{{foot, y, 0}, {-foot, y, 0}, {0, y, top}}}, finish);
  b.face({{{foot, 0, 0}, {foot, y, 0}, {0, y, top}, {0, 0, top}}}, finish);
  b.face({{{-foot, y, 0}, {-foot, 0, 0}, {0, 0, top}, {0, y, top}}}, finish);
  b.face({{{-foot, 0, 0}, {-foot, y, 0}, {foot, y, 0}, {foot, 0, 0}}}, finish);
  ground_plate(b, "plane", {-half_plane, -half_plane}, {half_plane, half_plane}, plane);
  return b.take();
}

}  // namespace sunload::builtin
