// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/cut_faces.h"
#include "io/plan/material_assign.h"
#include "io/plan/selection.h"

namespace sunload {

namespace {

/// The same wherever faces lie: without its heights, its areas, its radius, and what it leaves out.
NamedSelection without_ends(NamedSelection selection) {
  selection.except.clear();
  SelectionStudy& of = selection.of;
  of.height_m.reset();
  of.polygon = {};
  if (of.within_m) of.near.reset();
  of.within_m.reset();
  if (!of.chooses()) of.object = "*";
  return selection;
}

/// Along the ends of one selection: what is to be cut, and where.
struct CutsOfSelection {
  std::vector<std::size_t> faces;  ///< that the selection would choose wherever they lay
  std::vector<PlaneOfFace> planes;
};

/// Above the lowest point of each object.
PlaneOfFace level_at(double height_m, const Mesh& mesh) {
  std::vector<double> z;
  for (const ObjectExtent& extent : extents_of(mesh))
    z.push_back(extent.box.low.z - mesh.origin.z + height_m);
  return [z = std::move(z), object = mesh.triangle_object](std::size_t t) {
    FacePlane plane;
    plane.offset = z[object[t].index()];
    return plane;
  };
}

PlaneOfFace wall_on(Point2 from, Point2 to, const Mesh& mesh) {
  const double length = std::hypot(to.u - from.u, to.v - from.v);
  FacePlane plane;
  plane.along = {(to.u - from.u) / length, (to.v - from.v) / length, 0};
  plane.normal = {plane.along.y, -plane.along.x, 0};
  const Vec3 begin = Vec3{from.u, from.v, 0} - mesh.origin;
  plane.offset = dot(plane.normal, begin);
  plane.from = dot(plane.along, begin);
  plane.to = plane.from + length;
  return [plane](std::size_t) { return plane; };
}

/// Leaves out what no line about the areas can meet.
void leave_out_far_from(const std::vector<PlanArea>& areas, const Mesh& mesh,
                        std::vector<std::size_t>& faces) {
  Box box;
  for (const PlanArea& area : areas)
    for (const auto& ring : area)
      for (const Point2 p : ring) include(box, Vec3{p.u, p.v, 0} - mesh.origin);
  std::erase_if(faces, [&](std::size_t t) { return !meet(upright(box_of(mesh, t)), box); });
}

std::vector<PlanArea> areas_of(const NamedSelection& selection, const SceneFrame& frame) {
  return areas_in_scene(selection.of.polygon, frame.crs, subject_of(selection), selection.where);
}

/// Of the selection and of what it leaves out.
void add_planes(const NamedSelection& selection, const Mesh& mesh, const SceneFrame& frame,
                std::vector<PlaneOfFace>& planes) {
  if (selection.of.height_m)
    for (const double height : *selection.of.height_m) planes.push_back(level_at(height, mesh));
  for (const PlanArea& area : areas_of(selection, frame))
    for (const auto& ring : area)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point2 from = ring[k], to = ring[k + 1 < ring.size() ? k + 1 : 0];
        if (from.u != to.u || from.v != to.v) planes.push_back(wall_on(from, to, mesh));
      }
  for (const NamedSelection& other : selection.except) add_planes(other, mesh, frame, planes);
}

CutsOfSelection cuts_of(const NamedSelection& selection, const Mesh& mesh,
                        const SceneFrame& frame) {
  CutsOfSelection cuts;
  const ChosenParts chosen = selected_faces(without_ends(selection), mesh, frame);
  for (std::size_t t = 0; t < chosen.size(); ++t)
    if (chosen[t] != 0) cuts.faces.push_back(t);
  const auto areas = areas_of(selection, frame);
  if (!areas.empty()) leave_out_far_from(areas, mesh, cuts.faces);
  add_planes(selection, mesh, frame, cuts.planes);
  return cuts;
}

void take_over(std::vector<std::uint8_t>& flags, const std::vector<std::size_t>& source) {
  const auto old = std::move(flags);
  flags.clear();
  flags.reserve(source.size());
  for (const auto t : source) flags.push_back(old[t]);
}

/// What a rule that gives whole triangles makes of a selection [m2].
struct WholeTriangles {
  double held = 0;     ///< by the selection, of what the rule may give
  double lacking = 0;  ///< of that, in triangles whose middle lies outside
  double beyond = 0;   ///< outside, in triangles whose middle lies inside
};

WholeTriangles whole_triangles(const AssignRule& rule, const Mesh& mesh, const SceneFrame& frame) {
  const NamedSelection& selection = *rule.selection;
  const CutsOfSelection cuts = cuts_of(selection, mesh, frame);
  const FaceParts parts = parts_of_faces(mesh, cuts.faces, cuts.planes);
  const ChosenParts whole = selected_faces(selection, mesh, frame);
  const ChosenParts exact = selected_faces(selection, parts.mesh, frame, extents_of(mesh));
  const ChosenObjects named = objects_named(rule.object, mesh);
  const auto counts = [&](std::size_t t) {
    return mesh.bears_patches(t) && matches_but_selection(rule, named, mesh, t);
  };
  WholeTriangles sum;
  for (std::size_t t = 0; t < whole.size(); ++t)
    if (whole[t] != 0 && parts.is_divided[t] == 0 && counts(t)) sum.held += mesh.area_m2(t);
  for (std::size_t p = 0; p < exact.size(); ++p) {
    const std::size_t t = parts.source[p];
    if (parts.is_divided[t] == 0 || !counts(t)) continue;
    const double area = parts.mesh.area_m2(p);
    if (exact[p] != 0) sum.held += area;
    if (exact[p] != 0 && whole[t] == 0) sum.lacking += area;
    if (exact[p] == 0 && whole[t] != 0) sum.beyond += area;
  }
  return sum;
}

}  // namespace

void cut_at_selections(const SceneStudy& study, BuiltScene& built) {
  if (study.cut.empty()) return;
  Mesh& mesh = built.scene.mesh;
  for (const NamedSelection& selection : study.cut) {
    const std::size_t before = mesh.triangle_count();
    const CutsOfSelection cuts = cuts_of(selection, mesh, {built.crs, built.site.north_deg});
    const auto source = cut_faces(mesh, built.bodies, cuts.faces, cuts.planes);
    if (!built.seals.empty()) take_over(built.seals, source);
    built.notes.push_back(
        fmt::format("faces are cut along the ends of selection '{}': {} "
                    "triangles became {}",
                    selection.name, before, mesh.triangle_count()));
  }
  measure(mesh, built.report);
}

bool are_cut_by_north(const SceneStudy& study) {
  return std::any_of(study.cut.begin(), study.cut.end(), [](const NamedSelection& selection) {
    return selection.of.azimuth_deg || !selection.of.facade.empty();
  });
}

std::string uncut_warning(const SceneStudy& study, const BuiltScene& built) {
  constexpr double worth_telling = 0.02;  // of the selection's area
  const SceneFrame frame{built.crs, built.site.north_deg};
  for (const AssignRule& rule : study.assign) {
    if (!rule.selection || !rule.selection->has_ends()) continue;
    const std::string& name = rule.selection->name;
    if (std::any_of(study.cut.begin(), study.cut.end(),
                    [&](const NamedSelection& cut) { return cut.name == name; }))
      continue;
    const auto [held, lacking, beyond] = whole_triangles(rule, built.scene.mesh, frame);
    if (lacking + beyond <= worth_telling * held) continue;
    return message(
        rule.where,
        fmt::format(
            "of {:.4g} m2 that selection '{}' holds {:.4g} m2 do not get material '{}', and "
            "{:.4g} m2 beside them do",
            held, name, lacking, rule.material, beyond),
        "a rule gives its material to whole triangles, by their middle",
        "scene.cut: [" + name + "] cuts faces along its ends");
  }
  return {};
}

}  // namespace sunload
