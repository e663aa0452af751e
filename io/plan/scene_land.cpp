// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_land.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geo/mesh/delaunay.h"
#include "geo/mesh/slope.h"
#include "io/base/name_pattern.h"
#include "io/plan/selection.h"

namespace sunload {

namespace {

constexpr const char* type_of_land = "TINRelief";  // CityJSON 2.0.1, section 2.2.9

std::string offer(const std::vector<std::string>& names) {
  return names.empty() ? "sunload check without scene.land lists what is there"
                       : fmt::format("did you mean '{}'?", fmt::join(names, "', '"));
}

/// Calls `visit` with the first and last corner, in ring_vertex, of each ring of a polygon.
template <class Visit>
void visit_rings(const PolygonModel& model, std::size_t polygon, const Visit& visit) {
  for (auto r = model.polygon_ring[polygon]; r < model.polygon_ring[polygon + 1]; ++r)
    visit(model.ring_begin[static_cast<std::size_t>(r)],
          model.ring_begin[static_cast<std::size_t>(r) + 1]);
}

/// Twice the area of a polygon in plan, below 0 where it looks down.
double upward_area2(const PolygonModel& model, std::size_t polygon) {
  double sum = 0;
  visit_rings(model, polygon, [&](auto begin, auto end) {
    const auto corners = model.ring_vertex.begin();
    sum += newell(model.vertices, Ring(corners + begin, corners + end)).z;
  });
  return sum;
}

/// Turns over the faces of land that all in all looks down: light comes from above.
void turn_upward(const ChosenObjects& is_land, PolygonModel& model) {
  constexpr double most = 0.5;  // of its plan, net: a terrain has no undersides, a plate both
  std::vector<double> net(is_land.size(), 0), all(is_land.size(), 0);
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const std::size_t object = model.facts[p].object.index();
    if (!is_land[object]) continue;
    const double area2 = upward_area2(model, p);
    net[object] += area2;
    all[object] += std::abs(area2);
  }
  const auto looks_down = [&](std::size_t o) { return is_land[o] && -net[o] > most * all[o]; };
  for (std::size_t p = 0; p < model.polygon_count(); ++p)
    if (looks_down(model.facts[p].object.index()))
      visit_rings(model, p, [&](auto begin, auto end) {
        std::reverse(model.ring_vertex.begin() + begin + 1, model.ring_vertex.begin() + end);
      });
  for (std::size_t o = 0; o < is_land.size(); ++o)
    if (looks_down(o))
      model.notes.push_back(model.object_names[o] +
                            ": land that looked down, its faces are turned over");
}

}  // namespace

void call_land(const SceneStudy& scene, PolygonModel& model) {
  const FamilyTree tree(model.object_names, model.object_kinds, model.families);
  Problems problems;
  std::vector<std::string> kinds = model.object_kinds;
  kinds.resize(model.object_names.size());
  ChosenObjects lands(kinds.size(), 0);
  std::ranges::transform(kinds, lands.begin(), is_land);  // as city formats say
  for (const auto& [pattern, where] : scene.land) {
    const ChosenObjects named = objects_named(pattern, tree);
    bool any = false;
    for (std::size_t o = 0; o < kinds.size(); ++o) {
      if (!named[o]) continue;
      any = true;
      kinds[o] = type_of_land;
      lands[o] = 1;
    }
    if (!any)
      problems.add(where, fmt::format("scene.land: no object is called '{}'", pattern),
                   "what it names is the terrain", offer(near_names(pattern, model.object_names)));
  }
  problems.throw_if_any();
  if (!scene.land.empty()) model.object_kinds = std::move(kinds);
  if (scene.orient == Orientation::outward && scene.repair != Repair::none)
    turn_upward(lands, model);
}

namespace {

/// Ground of each object [m2].
struct GroundAreas {
  std::vector<double> all, upright;
  explicit GroundAreas(const Mesh& mesh)
      : all(mesh.object_names.size(), 0), upright(mesh.object_names.size(), 0) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.triangle_surface[t] != Surface::ground) continue;
      const std::size_t object = mesh.triangle_object[t].index();
      all[object] += mesh.area_m2(t);
      if (slope_of(mesh, t) == Slope::upright) upright[object] += mesh.area_m2(t);
    }
  }
};

/// Walls of quays and terraces are less.
bool may_hold_houses(const GroundAreas& areas, std::size_t object) {
  constexpr double telling_share = 0.05, telling_m2 = 10;
  return areas.upright[object] > std::max(telling_share * areas.all[object], telling_m2);
}

/// Objects that hold the land and houses on it: walls are ground then.
void warn_of_upright_land(const SceneStudy& scene, const Mesh& mesh,
                          std::vector<std::string>& warnings) {
  const GroundAreas areas(mesh);
  for (const auto& [pattern, where] : scene.land) {
    const ChosenObjects named = objects_named(pattern, mesh);
    double upright_m2 = 0;
    std::string first;
    for (std::size_t o = 0; o < named.size(); ++o) {
      if (!named[o] || !may_hold_houses(areas, o)) continue;
      upright_m2 += areas.upright[o];
      if (first.empty()) first = mesh.object_names[o];
    }
    if (upright_m2 == 0) continue;
    warnings.push_back(message(
        where,
        fmt::format("scene.land: {:.4g} m2 of '{}' are upright (first in {})", upright_m2, pattern,
                    first),
        "all of it is ground: it has no walls and no facades",
        "does it hold houses, too? Name the land's sheet alone, or make it an object of its own"));
  }
}

}  // namespace

void warn_of_no_land(const SceneStudy& scene, const Mesh& mesh,
                     std::vector<std::string>& warnings) {
  if (scene.land.empty()) return;
  warn_of_upright_land(scene, mesh, warnings);
  std::vector<std::uint8_t> has_ground(mesh.object_names.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.triangle_surface[t] == Surface::ground)
      has_ground[mesh.triangle_object[t].index()] = 1;
  for (const auto& [pattern, where] : scene.land) {
    const ChosenObjects named = objects_named(pattern, mesh);
    bool any = false;
    for (std::size_t o = 0; o < named.size(); ++o) any |= named[o] && has_ground[o];
    if (!any)
      warnings.push_back(
          message(where, fmt::format("scene.land: '{}' has no open surface that looks up", pattern),
                  "nothing of it became ground, and only the inside of closed bodies is covered",
                  "name the terrain's sheet"));
  }
}

}  // namespace sunload
