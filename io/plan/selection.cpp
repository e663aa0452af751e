// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/sun/site.h"
#include "io/base/name_pattern.h"
#include "io/plan/scene_build.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

namespace {

constexpr double level_deg = 1;  // flatter surfaces of files look nowhere: they are not true
// Walls on the rim of a range are in it, as files round them: to millimetres, over some metres.
constexpr double rounding_deg = 0.01;
constexpr double rounding_m = 1e-3;  // the same of heights

[[noreturn]] void refuse(const std::string& subject, const Where& where, const std::string& what,
                         const std::string& why, const std::string& hint) {
  throw InputError(where, subject + ": " + what, why, hint);
}

bool lies_between(double azimuth_deg, const std::array<double, 2>& ends) {
  const double width = wrapped_deg(ends[1] - ends[0]);
  const double rounding = std::min(rounding_deg, width / 4);  // of narrow ranges less
  return width == 0 || wrapped_deg(azimuth_deg - ends[0] + rounding) < width;
}

SceneObjects objects_of(const Mesh& mesh, std::vector<ObjectExtent> extents) {
  return {{mesh.object_names, mesh.object_kinds, mesh.families}, std::move(extents)};
}

/// By place in the tree: it, or something that it belongs to, is named so.
ChosenParts places_named(const std::string& pattern, const FamilyTree& tree) {
  ChosenParts named(tree.size(), 0);
  for (const std::size_t place : tree.owners_first()) {
    const auto owner = tree.owner(place);
    named[place] = matches(pattern, tree.name(place)) || (owner && named[*owner] != 0) ? 1 : 0;
  }
  return named;
}

}  // namespace

std::vector<PlanArea> areas_in_scene(const AreasStudy& study, const std::string& crs,
                                     const std::string& subject, const Where& where) {
  if (!study.in_degrees || crs.empty()) return study.areas;
  std::vector<PlanArea> areas = study.areas;
  for (PlanArea& area : areas)
    for (auto& ring : area)
      for (Point2& p : ring) {
        if (std::abs(p.u) > 180 || std::abs(p.v) > 90)
          refuse(subject, where, fmt::format("[{:.10g}, {:.10g}] are no degrees", p.u, p.v),
                 "GeoJSON has longitude and latitude (RFC 7946) unless its member crs names a map "
                 "projection",
                 "write the corners in the scene's metres, or the file with its member crs");
        const Vec3 on_map = map_position(crs, p.v, p.u, 0);
        p = {on_map.x, on_map.y};
      }
  return areas;
}

void refuse_far(Point2 place, const std::vector<ObjectExtent>& extents, const std::string& subject,
                const Where& where) {
  constexpr double surroundings_m = 1000;
  const ObjectExtent whole = extent_of_all(extents);
  if (whole.is_empty()) return;
  const auto& [low, high] = whole.box;
  const double away = distance_in_plan(whole, place);
  if (away <= std::max(surroundings_m, std::hypot(high.x - low.x, high.y - low.y))) return;
  refuse(subject, where,
         fmt::format("[{:.10g}, {:.10g}] is {:.0f} m away from the model", place.u, place.v, away),
         fmt::format("that lies at x {:.10g} to {:.10g}, y {:.10g} to {:.10g} in the metres of its "
                     "files",
                     low.x, high.x, low.y, high.y),
         "write the place in these");
}

ChosenObjects objects_named(const std::string& pattern, const FamilyTree& tree) {
  ChosenObjects chosen = places_named(pattern, tree);
  chosen.resize(tree.object_count());
  return chosen;
}

ChosenObjects objects_named(const std::string& pattern, const Mesh& mesh) {
  return objects_named(pattern, FamilyTree(mesh.object_names, mesh.object_kinds, mesh.families));
}

Selector::ChosenFamilies Selector::families_of(const SceneObjects& all) const {
  const FamilyTree& tree = all.tree;
  const ChosenParts named = places_named(wanted_.object, tree);
  ChosenFamilies families{std::vector<std::optional<std::size_t>>(tree.size()),
                          std::vector<ObjectExtent>(tree.size()), ChosenParts(tree.size(), 0)};
  ChosenParts chosen(tree.size(), 0);
  for (const std::size_t place : tree.owners_first()) {
    const auto owner = tree.owner(place);
    const bool stands_apart = owner && holds_others_apart(tree.kind(*owner));
    chosen[place] = named[place] != 0 && matches(wanted_.kind, tree.kind(place)) ? 1 : 0;
    if (stands_apart && chosen[*owner] != 0) chosen[place] = 1;
    if (owner && !stands_apart) families.head[place] = families.head[*owner];
    if (!families.head[place] && chosen[place] != 0) families.head[place] = place;
  }
  for (std::size_t o = 0; o < tree.object_count(); ++o) {
    if (!families.head[o] || all.extents[o].is_empty()) continue;
    const std::size_t head = *families.head[o];
    include(families.extents[head].box, all.extents[o].box.low);
    include(families.extents[head].box, all.extents[o].box.high);
    families.kept[head] = 1;
  }
  return families;
}

void Selector::keep_nearest(ChosenFamilies& families) const {
  // Of several above the place the smallest in plan: a house, not the ground that it stands on.
  const auto nearness = [&](std::size_t head) {
    const ObjectExtent& extent = families.extents[head];
    const Vec3 size = extent.box.high - extent.box.low;
    return std::pair(distance_in_plan(extent, *wanted_.near), size.x * size.y);
  };
  std::optional<std::size_t> taken;
  for (std::size_t head = 0; head < families.kept.size(); ++head) {
    if (families.kept[head] == 0) continue;
    if (!taken || nearness(head) < nearness(*taken)) taken = head;
    families.kept[head] = 0;
  }
  if (taken) families.kept[*taken] = 1;
}

ChosenObjects Selector::members_of_kept(const ChosenFamilies& families, const SceneObjects& all) {
  ChosenObjects members(all.tree.object_count(), 0);
  for (std::size_t o = 0; o < members.size(); ++o)
    if (families.head[o] && families.kept[*families.head[o]] != 0 && !all.extents[o].is_empty())
      members[o] = 1;
  return members;
}

ChosenObjects Selector::objects(const SceneObjects& all) const {
  ChosenFamilies families = families_of(all);
  const auto keep_if = [&](const auto& holds) {
    for (std::size_t head = 0; head < families.kept.size(); ++head)
      if (families.kept[head] != 0 && !holds(families.extents[head])) families.kept[head] = 0;
  };
  const auto areas = areas_in_scene(wanted_.polygon, frame_.crs, subject_, where_);
  if (!areas.empty())
    keep_if([&](const ObjectExtent& of) { return lies_in(areas, plan_point(of.middle())); });
  if (wanted_.near) {
    refuse_far(*wanted_.near, all.extents, subject_, where_);
    if (wanted_.within_m)
      keep_if([&](const ObjectExtent& of) {
        return distance_in_plan(of, *wanted_.near) <= *wanted_.within_m;
      });
    else
      keep_nearest(families);
  }
  return members_of_kept(families, all);
}

Selector::Sight Selector::sight_of(const SceneObjects& all) const {
  Sight sight{areas_in_scene(wanted_.polygon, frame_.crs, subject_, where_), {}};
  ChosenFamilies families = families_of(all);
  if (wanted_.near) {
    refuse_far(*wanted_.near, all.extents, subject_, where_);
    if (!wanted_.within_m) keep_nearest(families);
  }
  sight.objects = members_of_kept(families, all);
  // A face is of its own object's type.
  for (std::size_t o = 0; o < sight.objects.size(); ++o)
    if (!matches(wanted_.kind, all.tree.kind(o))) sight.objects[o] = 0;
  return sight;
}

bool Selector::holds(const Sight& sight, const SceneObjects& all,
                     const std::vector<Facade>& facades, const Part& part) const {
  if (sight.objects[part.object.index()] == 0) return false;
  const Point2 at = plan_point(part.middle);
  if (!sight.areas.empty() && !lies_in(sight.areas, at)) return false;
  if (wanted_.near && wanted_.within_m &&
      std::hypot(at.u - wanted_.near->u, at.v - wanted_.near->v) > *wanted_.within_m)
    return false;
  if (!wanted_.facade.empty() &&
      (!part.facade.exists() || !matches(wanted_.facade, facades[part.facade.index()].name)))
    return false;
  if (!wanted_.surface.empty() &&
      wanted_.surface != surface_names[static_cast<std::size_t>(part.surface)])
    return false;
  if (wanted_.azimuth_deg) {
    const Vec3 n = part.normal;
    if (std::hypot(n.x, n.y) < std::sin(radians(level_deg))) return false;
    if (!lies_between(horizontal(n).azimuth_deg + frame_.north_deg, *wanted_.azimuth_deg))
      return false;
  }
  if (!wanted_.height_m) return true;
  const auto [low, high] = *wanted_.height_m;
  const double height = part.middle.z - all.extents[part.object.index()].box.low.z +
                        std::min(rounding_m, (high - low) / 4);
  return height >= low && height < high;
}

std::string subject_of(const NamedSelection& selection) { return "selections." + selection.name; }

std::string empty_selection_warning(const std::string& name) {
  return "selection '" + name +
         "' chooses no patch of this variant: nothing is told of it; sunload check tells what each "
         "chooses";
}

namespace {

/// What `chosen_by` a selection, less what it leaves out. `chosen_by`: flags of a Selector.
template <class ChosenBy>
ChosenParts less_excepted(const NamedSelection& selection, const SceneFrame& frame,
                          const ChosenBy& chosen_by) {
  const Selector selector(selection.of, frame, subject_of(selection), selection.where);
  ChosenParts chosen = chosen_by(selector);
  for (const NamedSelection& other : selection.except) {
    const ChosenParts left_out = less_excepted(other, frame, chosen_by);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (left_out[i] != 0) chosen[i] = 0;
  }
  return chosen;
}

}  // namespace

ChosenObjects selected_objects(const NamedSelection& selection, const SceneObjects& all,
                               const SceneFrame& frame) {
  return less_excepted(selection, frame,
                       [&](const Selector& selector) { return selector.objects(all); });
}

ChosenParts selected_faces(const NamedSelection& selection, const Mesh& mesh,
                           const SceneFrame& frame) {
  return selected_faces(selection, mesh, frame, extents_of(mesh));
}

ChosenParts selected_faces(const NamedSelection& selection, const Mesh& mesh,
                           const SceneFrame& frame, std::vector<ObjectExtent> extents) {
  const SceneObjects objects = objects_of(mesh, std::move(extents));
  const auto face = [&](std::size_t t) {
    Vec3 sum;
    for (const auto v : mesh.triangles[t]) sum += mesh.vertices[static_cast<std::size_t>(v)];
    return Selector::Part{mesh.triangle_object[t], mesh.triangle_facade[t],
                          mesh.triangle_surface[t], mesh.origin + sum / 3,
                          normalized(mesh.area_vector2(t))};
  };
  return less_excepted(selection, frame, [&](const Selector& selector) {
    return selector.parts(objects, mesh.facades, mesh.triangle_count(), face);
  });
}

ChosenParts selected_patches(const NamedSelection& selection, const BuiltScene& built,
                             const Hierarchy& hierarchy) {
  const Mesh& mesh = built.scene.mesh;
  const SceneFrame frame{built.crs, built.site.north_deg};
  const SceneObjects objects = objects_of(mesh, extents_of(mesh));
  const auto patch_part = [&](std::size_t i) {
    const Patch& patch = hierarchy.patches()[i];
    const auto t = static_cast<std::size_t>(patch.triangle);
    return Selector::Part{
        mesh.triangle_object[t], patch.side == 0 ? mesh.triangle_facade[t] : FacadeId::none(),
        mesh.triangle_surface[t], mesh.origin + hierarchy.centroid(i), hierarchy.normal(i)};
  };
  return less_excepted(selection, frame, [&](const Selector& selector) {
    return selector.parts(objects, mesh.facades, hierarchy.patch_count(), patch_part);
  });
}

}  // namespace sunload
