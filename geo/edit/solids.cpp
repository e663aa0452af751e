// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/edit/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "geo/base/units.h"
#include "geo/edit/objects.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/feet.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr int crown_meridians = 12, crown_zones = 6, trunk_sides = 6;

/// Positive where counter-clockwise.
double signed_area(const std::vector<Point2>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 a = ring[i], b = ring[(i + 1) % ring.size()];
    twice += (a.u - ring[0].u) * (b.v - ring[0].v) - (b.u - ring[0].u) * (a.v - ring[0].v);
  }
  return twice / 2;
}

PolygonModel::Facts begin_object(PolygonModel& model, const SolidFacts& facts) {
  model.object_names.push_back(facts.name);
  model.object_kinds.resize(model.object_names.size() - 1);
  model.object_kinds.push_back(facts.kind);
  PolygonModel::Facts of_faces;
  of_faces.object = make_id<ObjectId>(model.object_names.size() - 1);
  return of_faces;
}

MaterialId add_reference(PolygonModel& model, const std::string& name) {
  if (name.empty()) return MaterialId::none();
  FileMaterial material;
  material.name = name;
  material.is_reference = true;
  model.materials.push_back(material);
  return make_id<MaterialId>(model.materials.size() - 1);
}

std::vector<std::int32_t> add_ring(PolygonModel& model, const std::vector<Point2>& ring, double z) {
  std::vector<std::int32_t> corners;
  for (const Point2 p : ring) {
    corners.push_back(static_cast<std::int32_t>(model.vertices.size()));
    model.vertices.push_back({p.u, p.v, z});
  }
  return corners;
}

/// Outer rings counter-clockwise, holes clockwise, without repeated ends.
PlanArea ordered(PlanArea area) {
  for (std::size_t r = 0; r < area.size(); ++r) {
    auto& ring = area[r];
    const auto is_same = [](Point2 a, Point2 b) { return a.u == b.u && a.v == b.v; };
    ring.erase(std::unique(ring.begin(), ring.end(), is_same), ring.end());
    while (ring.size() > 1 && is_same(ring.front(), ring.back())) ring.pop_back();
    if ((signed_area(ring) > 0) != (r == 0)) std::reverse(ring.begin(), ring.end());
  }
  return area;
}

using Rings = std::vector<std::vector<std::int32_t>>;

void add_area(PolygonModel& model, const PlanArea& area, double low_m, double high_m,
              const PolygonModel::Facts& facts) {
  Rings bottom, top;
  for (const auto& ring : ordered(area)) {
    bottom.push_back(add_ring(model, ring, low_m));
    top.push_back(add_ring(model, ring, high_m));
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t j = (i + 1) % ring.size();
      model.add_polygon({{bottom.back()[i], bottom.back()[j], top.back()[j], top.back()[i]}},
                        facts);
    }
  }
  model.add_polygon(top, facts);
  for (auto& ring : bottom) std::reverse(ring.begin(), ring.end());
  model.add_polygon(bottom, facts);
}

std::vector<Point2> circle(Point2 middle, double radius, int corners) {
  std::vector<Point2> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    ring.push_back({middle.u + radius * std::cos(angle), middle.v + radius * std::sin(angle)});
  }
  return ring;
}

void add_crown(PolygonModel& model, Vec3 foot, const TreeShape& shape,
               const PolygonModel::Facts& facts) {
  const double half = (shape.height_m - shape.trunk_m) / 2, middle = foot.z + shape.trunk_m + half;
  std::vector<std::vector<std::int32_t>> circles;
  for (int zone = 1; zone < crown_zones; ++zone) {
    const double angle = std::numbers::pi * zone / crown_zones;  // from the lower end
    circles.push_back(add_ring(
        model, circle({foot.x, foot.y}, shape.crown_m / 2 * std::sin(angle), crown_meridians),
        middle - half * std::cos(angle)));
  }
  const auto end = [&](double z) {
    model.vertices.push_back({foot.x, foot.y, z});
    return static_cast<std::int32_t>(model.vertices.size() - 1);
  };
  const std::int32_t low = end(middle - half), high = end(middle + half);
  for (std::size_t i = 0; i < crown_meridians; ++i) {
    const std::size_t j = (i + 1) % crown_meridians;
    model.add_triangle(low, circles.front()[j], circles.front()[i], facts);
    for (std::size_t z = 0; z + 1 < circles.size(); ++z)
      model.add_polygon({{circles[z][i], circles[z][j], circles[z + 1][j], circles[z + 1][i]}},
                        facts);
    model.add_triangle(high, circles.back()[i], circles.back()[j], facts);
  }
}

}  // namespace

bool lies_in(const std::vector<PlanArea>& areas, Point2 point) {
  return std::any_of(areas.begin(), areas.end(), [&](const PlanArea& area) {
    return holds_in_plan(area, point, [](Point2 p) { return p; });
  });
}

PlanArea rectangle_in_plan(Point2 middle, double width_m, double depth_m, double turn_deg) {
  const double turn = radians(turn_deg), cos = std::cos(turn), sin = std::sin(turn);
  const auto corner = [&](double x, double y) {
    return Point2{middle.u + x * cos + y * sin, middle.v - x * sin + y * cos};
  };
  const double w = width_m / 2, d = depth_m / 2;
  return {{corner(-w, -d), corner(w, -d), corner(w, d), corner(-w, d)}};
}

void add_prism(PolygonModel& model, const std::vector<PlanArea>& areas, double low_m, double high_m,
               const SolidFacts& facts) {
  auto of_faces = begin_object(model, facts);
  of_faces.material = add_reference(model, facts.material);
  for (const PlanArea& area : areas) add_area(model, area, low_m, high_m, of_faces);
}

void add_tree(PolygonModel& model, Vec3 foot, const TreeShape& shape, const SolidFacts& facts) {
  auto of_faces = begin_object(model, facts);
  of_faces.surface = Surface::other;
  if (shape.trunk_m > 0) {
    of_faces.material = add_reference(model, shape.trunk);
    const double radius = shape.height_m * trunk_width_ratio / 2;
    add_area(model, {circle({foot.x, foot.y}, radius, trunk_sides)}, foot.z, foot.z + shape.trunk_m,
             of_faces);
  }
  of_faces.material = add_reference(model, shape.leaves);
  of_faces.sides = Sides::two;
  add_crown(model, foot, shape, of_faces);
}

namespace {

const std::string& kind_of(const PolygonModel& model, std::size_t object) {
  static const std::string none;
  return object < model.object_kinds.size() ? model.object_kinds[object] : none;
}

/// Height of a face over a place in plan; nothing of upright ones and of others.
std::optional<double> height_at(const LooseFace& face, Point2 place) {
  const Vec3 normal = area_vector2(face);
  if (normal.z == 0 || !holds_in_plan(face.rings, place, plan_point)) return {};
  const Vec3 through = face.rings[0][0];
  return through.z -
         (normal.x * (place.u - through.x) + normal.y * (place.v - through.y)) / normal.z;
}

/// Of the model's ground faces below the place the highest.
std::optional<double> ground_height(const PolygonModel& model, Point2 place) {
  std::optional<double> ground;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const bool is_of_land = is_land(kind_of(model, model.facts[p].object.index()));
    if (!is_of_land && model.facts[p].surface != Surface::ground) continue;
    const auto z = height_at(face_of(model, p), place);
    if (z && (!ground || *z > *ground)) ground = z;
  }
  return ground;
}

/// Of the objects of which nobody says what they are, the lowest top over the place: land, where it
/// is one of them or part of one.
std::optional<double> lowest_top(const PolygonModel& model, Point2 place) {
  std::map<std::size_t, double> tops;  // by object
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const std::size_t object = model.facts[p].object.index();
    if (!kind_of(model, object).empty() || model.facts[p].surface != Surface::other) continue;
    const auto z = height_at(face_of(model, p), place);
    if (!z) continue;
    const auto [top, is_first] = tops.try_emplace(object, *z);
    if (!is_first) top->second = std::max(top->second, *z);
  }
  std::optional<double> lowest;
  for (const auto& [object, top] : tops)
    if (!lowest || top < *lowest) lowest = top;
  return lowest;
}

/// Where a thing beside an object has its foot: the object's lowest point, and of land, which may
/// lie lower elsewhere, its height at the corner nearest in plan.
double foot_beside(const PolygonModel& model, std::size_t object, const ObjectExtent& extent,
                   Point2 place) {
  constexpr double steep = 0.2;  // cosine to the vertical
  bool is_level_enough = true;
  double nearest = std::numeric_limits<double>::infinity(), height = extent.box.low.z;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    if (model.facts[p].object.index() != object) continue;
    const LooseFace face = face_of(model, p);
    const Vec3 normal = area_vector2(face);
    if (std::abs(normal.z) <= steep * norm(normal)) is_level_enough = false;
    for (const Vec3 corner : face.rings[0]) {
      const double away = std::hypot(corner.x - place.u, corner.y - place.v);
      if (away >= nearest) continue;
      nearest = away;
      height = corner.z;
    }
  }
  const bool is_of_land =
      is_land(kind_of(model, object)) || (kind_of(model, object).empty() && is_level_enough);
  return is_of_land ? height : extent.box.low.z;
}

/// Crowns, and what was put into the air.
bool may_hover(const std::string& kind) { return is_plant(kind) || kind == hanging_kind; }

/// The foot of the object nearest in plan, of what may hover or of all others.
std::optional<double> nearest_foot(const PolygonModel& model, Point2 place, bool of_hovering) {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto extents = extents_of(model);
  for (std::size_t o = 0; o < extents.size(); ++o) {
    if (extents[o].is_empty() || may_hover(kind_of(model, o)) != of_hovering) continue;
    const double away = distance_in_plan(extents[o], place);
    if (away >= least) continue;
    least = away;
    nearest = o;
  }
  if (!nearest) return {};
  return foot_beside(model, *nearest, extents[*nearest], place);
}

}  // namespace

std::optional<double> standing_height(const PolygonModel& model, Point2 place) {
  if (const auto ground = ground_height(model, place)) return ground;
  if (const auto land = lowest_top(model, place)) return land;
  if (const auto foot = nearest_foot(model, place, false)) return foot;
  return nearest_foot(model, place, true);
}

std::optional<double> height_in_the_air(const PolygonModel& model, const Box& lower_face) {
  constexpr double gap_m = 0.5;  // files leave gaps between bodies that stand on each other
  const Vec3 middle = centre_of(lower_face);
  const auto land = standing_height(model, {middle.x, middle.y});
  if (!land || lower_face.low.z - *land <= highest_step_m) return {};
  Box there = upright(lower_face);
  there.low.z = lower_face.low.z - gap_m;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const std::string& kind = kind_of(model, model.facts[p].object.index());
    if (is_land(kind) || may_hover(kind) || model.facts[p].surface == Surface::ground) continue;
    const LooseFace face = face_of(model, p);
    Box box;
    for (const Vec3 corner : face.rings[0]) include(box, corner);
    if (meet(box, there)) return {};
  }
  return lower_face.low.z - *land;
}

}  // namespace sunload
