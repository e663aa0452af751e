// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/open_below.h"
#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/slope.h"
#include "io/base/first_of_many.h"
#include "io/scene/file.h"
#include "io/study/material_table.h"

namespace sunload {

namespace {

bool is_empty(const Box& box) { return box.low.x > box.high.x; }

void include_all(Box& box, const Box& other) {
  if (is_empty(other)) return;
  include(box, other.low);
  include(box, other.high);
}

/// Of all bodies; empty ones of land.
std::vector<Box> boxes_but_of_land(const BuiltScene& prepared) {
  std::vector<Box> boxes;
  for (const Body& body : prepared.bodies.bodies) boxes.push_back(body.box);
  const Mesh& mesh = prepared.scene.mesh;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (const auto b = prepared.bodies.triangle_body[t];
        b >= 0 && mesh.triangle_surface[t] == Surface::ground)
      boxes[static_cast<std::size_t>(b)] = Box{};
  return boxes;
}

Vec3 centre_of_triangle(const Mesh& mesh, std::size_t t) {
  return (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
}

/// Area and reflectance over it, by kind of surface.
struct Reflecting {
  double area_m2 = 0, diffuse_m2 = 0, all_m2 = 0;
  double diffuse() const { return diffuse_m2 / area_m2; }
  double all() const { return all_m2 / area_m2; }
};
using OfKinds = std::array<Reflecting, surface_names.size()>;

/// Whether a triangle reflects what the appearance of its city model says.
bool shows_its_colour(const Study& study, const Scene& scene, std::size_t t) {
  const Mesh& mesh = scene.mesh;
  const auto id = mesh.triangle_material[t];
  if (!id.exists() || mesh.object_kinds[mesh.triangle_object[t].index()].empty()) return false;
  const FileMaterial& file = mesh.file_materials[id.index()];
  const Material& material = scene.material_of(t);
  return file.diffuse && material.name == file.name && material.diffuse == *file.diffuse &&
         std::none_of(study.scene.materials.begin(), study.scene.materials.end(),
                      [&](const MaterialStudy& m) { return m.name == file.name; });
}

/// What the table has for that kind of surface, a plain one.
const char* usual_material(Surface surface) {
  switch (surface) {
    case Surface::wall:
      return "brick";
    case Surface::roof:
      return "roof_tile";
    case Surface::ground:
      return "paving";
    case Surface::window:
      return "double_glazing";
    case Surface::other:
    case Surface::floor:
      break;
  }
  return nullptr;
}

void warn_of_colours(const OfKinds& shown, BuiltScene& built) {
  std::string means, offers;
  for (std::size_t s = 0; s < surface_names.size(); ++s) {
    if (shown[s].area_m2 == 0) continue;
    means +=
        fmt::format("{}{} {:.3g}", means.empty() ? "" : ", ", surface_names[s], shown[s].diffuse());
    const char* usual = usual_material(static_cast<Surface>(s));
    if (!usual) continue;
    means += fmt::format(" (table: {} {:.3g})", usual, tabled_material(usual)->diffuse.value_or(0));
    offers += fmt::format("{}{{surface: {}, material: {}}}", offers.empty() ? "" : ", ",
                          surface_names[s], usual);
  }
  if (means.empty()) return;
  built.warnings.push_back(
      message({}, "the model's appearance gives colours, which are taken as reflectances: " + means,
              "they were chosen for display and say little of sunlight",
              offers.empty() ? "give the materials by scene.materials"
                             : "scene.assign: [" + offers + "] takes the table's"));
}

}  // namespace

std::string lone_piece_warning(const Study& study, const BuiltScene& prepared) {
  constexpr double far_off = 10, little_area = 0.01;
  const auto& bodies = prepared.bodies.bodies;
  const std::vector<Box> boxes = boxes_but_of_land(prepared);
  std::vector<Box> from(bodies.size() + 1);  // all from a body on
  double area = 0;
  for (std::size_t b = bodies.size(); b > 0; --b) {
    from[b - 1] = from[b];
    include_all(from[b - 1], boxes[b - 1]);
    if (!is_empty(boxes[b - 1])) area += bodies[b - 1].area;
  }
  const double all_m = norm(from[0].high - from[0].low);
  Box before;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Box rest = before;
    include_all(rest, from[b + 1]);
    include_all(before, boxes[b]);
    if (is_empty(boxes[b]) || is_empty(rest) || bodies[b].area > little_area * area) continue;
    const double rest_m = norm(rest.high - rest.low);
    if (all_m <= far_off * rest_m) continue;
    const Mesh& mesh = prepared.scene.mesh;
    const Vec3 at = mesh.origin + centre_of(boxes[b]);
    return message(
        study.scene.where,
        fmt::format("a piece of '{}' lies at ({:.6g}, {:.6g}, {:.6g}), {:.4g} m away from all "
                    "else, which is {:.4g} m across",
                    mesh.object_names[bodies[b].object.index()], at.x, at.y, at.z, all_m - rest_m,
                    rest_m),
        "the ground reaches there, and all of it is computed",
        "is it a stray one? a step of scene.edit removes objects");
  }
  return {};
}

std::string north_warning(const SiteStudy& given, const std::string& crs, double map_north_deg) {
  constexpr double worth_telling_deg = 0.5;  // the sun's diameter: shadows of houses move by less
  constexpr double turn_deg = 360;
  if (!given.north_deg) return {};
  const double apart_deg = std::remainder(*given.north_deg - map_north_deg, turn_deg);
  if (std::abs(apart_deg) < worth_telling_deg) return {};
  return message(
      given.where,
      fmt::format("site.north_deg is {:g}, and {} puts north at {:.3f}", *given.north_deg, crs,
                  std::remainder(map_north_deg, turn_deg)),
      fmt::format("the sun stands {:.2f} degrees aside, by the study's word", std::abs(apart_deg)),
      "leave north_deg away where the model is in its map's coordinates");
}

namespace {

/// Areas of faces along each axis, to within some 8 degrees [m2, doubled].
struct AreasAlongAxes {
  std::array<double, 3> area{};  ///< both ways
  std::array<double, 3> net{};   ///< along the axis less against it, as seen along it
  double all = 0;                ///< of all faces
  Box box{};                     ///< about them

  /// The level axis that has more.
  std::size_t wider() const { return area[0] > area[1] ? 0 : 1; }
};

AreasAlongAxes areas_along_axes(const Mesh& mesh) {
  constexpr double along = 0.99;
  AreasAlongAxes sums;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto id = mesh.triangle_material[t];
    if (id.exists() && mesh.file_materials[id.index()].name == "ground") continue;  // ours
    const Vec3 n = mesh.area_vector2(t);
    const double own = norm(n);
    sums.all += own;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double c = component(n, static_cast<int>(axis));
      sums.net[axis] += c;
      if (std::abs(c) >= along * own) sums.area[axis] += own;
    }
    for (int corner = 0; corner < 3; ++corner) include(sums.box, mesh.corner(t, corner));
  }
  return sums;
}

/// The largest share of bodies that end at one level of the axis: at the lowest, or the highest.
double share_with_common_foot(const std::vector<Body>& bodies, int axis) {
  constexpr double same_foot = 0.01;  // of the scene's extent
  double least = infinity, most = -infinity;
  for (const Body& body : bodies) {
    least = std::min(least, component(body.box.low, axis));
    most = std::max(most, component(body.box.high, axis));
  }
  const double near = same_foot * (most - least);
  double low = 0, high = 0;
  for (const Body& body : bodies) {
    low += component(body.box.low, axis) <= least + near;
    high += component(body.box.high, axis) >= most - near;
  }
  return bodies.empty() ? 0 : std::max(low, high) / static_cast<double>(bodies.size());
}

/// A sheet that covers the box about it once as seen along the axis, and shows along z about as
/// much of one side as of the other: land with its houses in one piece. A facade with its reveals
/// is flatter.
bool is_sheet_of_land(const AreasAlongAxes& sums, std::size_t axis) {
  constexpr double once = 0.9, little = 0.1, least_depth = 0.15;
  const Vec3 size = sums.box.high - sums.box.low;
  const double depth = component(size, static_cast<int>(axis));
  const double width = axis == 0 ? size.y : size.x;
  const double net = std::abs(sums.net[axis]);
  return net / 2 > once * width * size.z && std::abs(sums.net[2]) < little * net &&
         sums.area[2] > little * sums.all && depth > least_depth * std::min(width, size.z);
}

/// A town has much that is level, as open sheet or as roofs of bodies whose feet are level, and its
/// walls face all sides.
bool lies_on_its_side(const AreasAlongAxes& sums, const std::vector<Body>& bodies) {
  constexpr double much = 3, most_of_bodies = 0.8, some_walls = 0.05;
  constexpr std::size_t some_bodies = 3;
  const std::size_t wide = sums.wider();
  if (sums.all <= 0) return false;
  if (is_sheet_of_land(sums, wide)) return true;
  if (sums.area[wide] < much * sums.area[2]) return false;
  const bool bears_walls = sums.all - sums.area[wide] > some_walls * sums.all;  // or is one itself
  const double net = std::abs(sums.net[wide]);
  const bool is_open_land =
      bears_walls && net > sums.all / much && net > much * std::abs(sums.net[2]);
  const bool is_town = bodies.size() >= some_bodies &&
                       share_with_common_foot(bodies, static_cast<int>(wide)) >= most_of_bodies &&
                       share_with_common_foot(bodies, 2) < most_of_bodies;
  return is_open_land || is_town;
}

/// The axis that points up in a file, as the study says or else its format.
char up_of(const SceneStudy& scene, const SceneFileStudy& file) {
  const char said = file.up != 0 ? file.up : scene.up;
  if (said != 0) return said;
  const auto format = scene_format_of_name(file.path);
  return format && format->says_up && format->kind == SceneFileKind::mesh ? 'y' : 'z';
}

/// What files call a level axis of the scene, 0 or 1; nothing where not all point up alike.
std::optional<char> axis_of_files(const SceneStudy& scene, std::size_t axis) {
  if (scene.files.empty()) return {};
  const char up = up_of(scene, scene.files.front());
  for (const auto& file : scene.files)
    if (up_of(scene, file) != up) return {};
  if (axis == 0) return up == 'x' ? 'y' : 'x';
  return up == 'z' ? 'y' : 'z';
}

}  // namespace

std::string on_its_side_warning(const Study& study, const BuiltScene& prepared,
                                bool is_city_format) {
  if (is_city_format) return {};
  const AreasAlongAxes sums = areas_along_axes(prepared.scene.mesh);
  if (!lies_on_its_side(sums, prepared.bodies.bodies)) return {};
  constexpr double percent = 100;
  const auto axis = axis_of_files(study.scene, sums.wider());
  return message(
      study.scene.where,
      fmt::format("the scene seems to lie on its side: {:.0f} % of its area faces along {}, {:.0f} "
                  "% is level",
                  percent * sums.area[sums.wider()] / sums.all,
                  axis ? fmt::format("{} of its files", *axis) : "one level axis",
                  percent * sums.area[2] / sums.all),
      "its walls are taken for level land and the other way round",
      axis ? fmt::format("write scene.up: {} where that axis of the file points to the zenith",
                         *axis)
           : "write the axis that points to the zenith as up of each of scene.files");
}

std::string unit_warning(const Study& study, const BuiltScene& prepared, bool is_city_format) {
  constexpr double highest_house_m = 1000;
  if (is_city_format) return {};
  const Mesh& mesh = prepared.scene.mesh;
  const OpenBelow open_below(mesh, prepared.bodies);
  const Body* highest = nullptr;
  const auto height = [](const Body& body) { return body.box.high.z - body.box.low.z; };
  for (std::size_t b = 0; b < prepared.bodies.bodies.size(); ++b) {
    const Body& body = prepared.bodies.bodies[b];
    if (!body.is_closed && !open_below.has(static_cast<std::int32_t>(b))) continue;
    if (is_land(mesh.object_kinds[body.object.index()])) continue;
    if (!(height(body) > highest_house_m)) continue;
    if (highest == nullptr || height(body) > height(*highest)) highest = &body;
  }
  if (highest == nullptr) return {};
  return message(study.scene.where,
                 fmt::format("{} is {:.0f} m high, higher than any house",
                             mesh.object_names[highest->object.index()], height(*highest)),
                 "a number of its file is taken for a metre, or for what unit_m says",
                 "of a model in millimetres write unit_m: 0.001");
}

namespace {

constexpr std::size_t no_triangle = static_cast<std::size_t>(-1);

/// Of objects with walls or roofs that are all covered the triangle whose middle is highest; of all
/// others none.
std::vector<std::size_t> tops_of_covered(const Mesh& mesh) {
  std::vector<std::size_t> top(mesh.object_names.size(), no_triangle);
  std::vector<std::uint8_t> is_lit(mesh.object_names.size(), 0);
  const auto height = [&](std::size_t t) { return centre_of_triangle(mesh, t).z; };
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Surface kind = mesh.triangle_surface[t];
    if (kind == Surface::floor || kind == Surface::ground) continue;
    const std::size_t object = mesh.triangle_object[t].index();
    if (!mesh.is_covered(t)) is_lit[object] = 1;
    if (top[object] == no_triangle || height(t) > height(top[object])) top[object] = t;
  }
  for (std::size_t o = 0; o < top.size(); ++o)
    if (is_lit[o]) top[o] = no_triangle;
  return top;
}

/// `3 objects lie wholly inside others: a, b, c`.
std::string lie(const FirstOfMany& names, const std::string& where) {
  return fmt::format("{} object{} wholly {}: {}", names.count(),
                     names.count() == 1 ? " lies" : "s lie", where, names.text());
}

/// How far the land is above a point [m]; 0 where it is not.
double depth_below(const PlanTriangles& land, Vec3 point) {
  double deepest = 0;
  land.visit_heights(point.x, point.y,
                     [&](std::size_t, double z) { deepest = std::max(deepest, z - point.z); });
  return deepest;
}

}  // namespace

void tell_of_hidden(const Study& study, BuiltScene& built) {
  constexpr double deep_m = 0.3;  // less lies under a terrain that is drawn to decimetres
  const Mesh& mesh = built.scene.mesh;
  const PlanTriangles land(mesh, land_triangles(mesh));
  const std::vector<std::size_t> tops = tops_of_covered(mesh);
  FirstOfMany buried, placed_inside, inside;
  for (std::size_t o = 0; o < tops.size(); ++o) {
    if (tops[o] == no_triangle) continue;
    const std::string& name = mesh.object_names[o];
    const double depth_m = depth_below(land, centre_of_triangle(mesh, tops[o]));
    if (depth_m >= deep_m)
      buried.add(fmt::format("{} by {:.2f} m", name, depth_m));
    else if (depth_m <= 0)
      (built.placed.contains(name) ? placed_inside : inside).add(name);
  }
  const char* const unseen = "no light comes there, and no result tells of it";
  if (buried.count() > 0)
    built.warnings.push_back(
        message(study.scene.where, lie(buried, "below the land"), unseen,
                "are cellars meant, or have the files heights of two systems?"));
  if (placed_inside.count() > 0)
    built.warnings.push_back(message(study.scene.where, lie(placed_inside, "inside others"), unseen,
                                     "are the places of scene.edit right?"));
  if (inside.count() > 0) built.notes.push_back(lie(inside, "inside others") + "; " + unseen);
}

namespace {

/// Opaque triangles that are lit from one side, without upright ones and land that is covered, as
/// below a house: their backs are dark.
std::vector<std::size_t> triangles_with_dark_backs(const Scene& scene) {
  std::vector<std::size_t> all;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const Material& material = scene.material_of(t);
    const bool is_opaque = material.transmittance == 0 && normal_transmittance(material) == 0;
    const bool is_covered_land =
        scene.mesh.is_covered(t) && scene.mesh.triangle_surface[t] == Surface::ground;
    if (is_opaque && !is_covered_land && scene.mesh.triangle_sides[t] == Sides::one &&
        slope_of(scene.mesh, t) != Slope::upright)
      all.push_back(t);
  }
  return all;
}

/// The nearest face above looks up, and the nearest one below looks down.
bool is_in_body(const PlanTriangles& faces, const Mesh& mesh, Vec3 point) {
  double above = infinity, below = -infinity;
  std::optional<Slope> of_above, of_below;
  faces.visit_heights(point.x, point.y, [&](std::size_t t, double z) {
    if (z > point.z && z < above) above = z, of_above = slope_of(mesh, t);
    if (z < point.z && z > below) below = z, of_below = slope_of(mesh, t);
  });
  return of_above == Slope::upward && of_below == Slope::downward;
}

}  // namespace

std::string sensors_in_bodies_warning(const SensorsStudy& study, const Scene& scene) {
  if (scene.sensors.empty()) return {};
  const PlanTriangles faces(scene.mesh, triangles_with_dark_backs(scene));
  std::size_t count = 0, first = 0;
  for (std::size_t s = scene.sensors.size(); s-- > 0;)
    if (is_in_body(faces, scene.mesh, scene.sensors[s].position)) {
      ++count;
      first = s;
    }
  if (count == 0) return {};
  const Vec3 at = scene.mesh.origin + scene.sensors[first].stands_at;
  return message(study.where,
                 fmt::format("{} of {} sensors lie within bodies, the first of them sensor {} at "
                             "({:.10g}, {:.10g}, {:.10g})",
                             count, scene.sensors.size(), first, at.x, at.y, at.z),
                 "no light comes there", "points before walls and above roofs receive light");
}

std::string open_panes_note(const Scene& scene) {
  constexpr double least_transmitted = 0.05;
  double area_m2 = 0;
  std::string name;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const Material& material = scene.material_of(t);
    if (scene.mesh.triangle_sides[t] != Sides::two || !scene.mesh.bears_patches(t) ||
        smooth_shares(material, 1).transmitted < least_transmitted)
      continue;
    area_m2 += scene.mesh.area_m2(t);
    name = material.name;
  }
  if (area_m2 == 0) return {};
  return fmt::format(
      "panes ({}) of {:.4g} m2 are lit from both sides: what passes leaves the outdoor scene, as "
      "into a room, and it is dark behind them; a canopy has transmittance and mirror, sides: two",
      name, area_m2);
}

void warn_of_reflectances(const Study& study, BuiltScene& built) {
  constexpr double brightest = 0.8;  // fresh snow
  const Scene& scene = built.scene;
  OfKinds shown, all;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    if (!scene.mesh.bears_patches(t)) continue;
    const auto s = static_cast<std::size_t>(scene.mesh.triangle_surface[t]);
    const Material& material = scene.material_of(t);
    const double area = scene.mesh.area_m2(t);
    const auto add = [&](Reflecting& sum) {
      sum.area_m2 += area;
      sum.diffuse_m2 += area * material.diffuse;
      sum.all_m2 += area * (material.diffuse + mirror_reflectance(material, 1) + material.glossy);
    };
    add(all[s]);
    if (shows_its_colour(study, scene, t)) add(shown[s]);
  }
  warn_of_colours(shown, built);
  const Reflecting& walls = all[static_cast<std::size_t>(Surface::wall)];
  if (walls.area_m2 > 0 && walls.all() > brightest)
    built.warnings.push_back(
        message({}, fmt::format("walls reflect {:.3g} of the light in the mean", walls.all()),
                "that is more than fresh snow does; facades of cities reflect 0.2 to 0.5",
                "scene.assign: [{surface: wall, material: brick}] takes the table's"));
}

}  // namespace sunload
