// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/cut_faces.h"
#include "io/plan/selection.h"

namespace sunload {

namespace {

/// The same but for where faces lie: within its heights, its areas, and its radius.
NamedSelection without_ends(NamedSelection selection) {
  SelectionStudy& of = selection.of;
  of.height_m.reset();
  of.polygon = {};
  if (of.within_m) of.near.reset();
  of.within_m.reset();
  if (!of.chooses()) of.object = "*";
  return selection;
}

/// Cuts one mesh along the ends of one selection after the other.
class FaceCutter {
 public:
  FaceCutter(Mesh& mesh, Bodies& bodies, std::vector<std::uint8_t>& seals, const SceneFrame& frame)
      : mesh_(mesh), bodies_(bodies), seals_(seals), frame_(frame) {}

  void cut_at(const NamedSelection& selection) {
    chosen_ = selected_faces(without_ends(selection), mesh_, frame_);
    if (selection.of.height_m)
      for (const double height : *selection.of.height_m) cut_at_height(height);
    const auto areas = areas_in_scene(selection.of.polygon, frame_.crs,
                                      "selections." + selection.name, selection.where);
    if (!areas.empty()) leave_out_far_from(areas);
    for (const PlanArea& area : areas)
      for (const auto& ring : area)
        for (std::size_t k = 0; k < ring.size(); ++k)
          cut_along(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
  }

 private:
  /// Above the lowest point of each object.
  void cut_at_height(double height_m) {
    std::vector<double> z;
    for (const ObjectExtent& extent : extents_of(mesh_))
      z.push_back(extent.box.low.z - mesh_.origin.z + height_m);
    const auto objects = mesh_.triangle_object;
    cut([&](std::size_t t) {
      FacePlane plane;
      plane.offset = z[objects[t].index()];
      return plane;
    });
  }
  /// What no line can meet.
  void leave_out_far_from(const std::vector<PlanArea>& areas) {
    Box box;
    for (const PlanArea& area : areas)
      for (const auto& ring : area)
        for (const Point2 p : ring) include(box, Vec3{p.u, p.v, 0} - mesh_.origin);
    for (std::size_t t = 0; t < chosen_.size(); ++t) {
      const Box of = box_around({mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)});
      if (of.low.x > box.high.x || of.high.x < box.low.x || of.low.y > box.high.y ||
          of.high.y < box.low.y)
        chosen_[t] = 0;
    }
  }
  void cut_along(Point2 from, Point2 to) {
    const double length = std::hypot(to.u - from.u, to.v - from.v);
    if (length == 0) return;
    FacePlane plane;
    plane.along = {(to.u - from.u) / length, (to.v - from.v) / length, 0};
    plane.normal = {plane.along.y, -plane.along.x, 0};
    const Vec3 begin = Vec3{from.u, from.v, 0} - mesh_.origin;
    plane.offset = dot(plane.normal, begin);
    plane.from = dot(plane.along, begin);
    plane.to = plane.from + length;
    cut([&](std::size_t) { return plane; });
  }
  template <class PlaneOf>
  void cut(const PlaneOf& plane_of) {
    const auto source = cut_faces(mesh_, bodies_, [&](std::size_t t) {
      return chosen_[t] != 0 ? std::optional<FacePlane>(plane_of(t)) : std::nullopt;
    });
    take_over(chosen_, source);
    if (!seals_.empty()) take_over(seals_, source);
  }
  static void take_over(std::vector<std::uint8_t>& flags, const std::vector<std::size_t>& source) {
    const auto old = std::move(flags);
    flags.clear();
    flags.reserve(source.size());
    for (const auto t : source) flags.push_back(old[t]);
  }

  Mesh& mesh_;
  Bodies& bodies_;
  std::vector<std::uint8_t>& seals_;
  SceneFrame frame_;
  ChosenParts chosen_;  ///< faces that the selection at hand would choose wherever they lay
};

double area_of(const ChosenParts& chosen, const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < chosen.size(); ++t)
    if (chosen[t] != 0 && mesh.bears_patches(t)) sum += norm(mesh.area_vector2(t)) / 2;
  return sum;
}

bool has_ends(const SelectionStudy& selection) {
  return selection.height_m || !selection.polygon.areas.empty();
}

}  // namespace

void cut_at_selections(const SceneStudy& study, BuiltScene& built) {
  if (study.cut.empty()) return;
  Mesh& mesh = built.scene.mesh;
  FaceCutter cutter(mesh, built.bodies, built.seals, {built.crs, built.site.north_deg});
  for (const NamedSelection& selection : study.cut) {
    const std::size_t before = mesh.triangle_count();
    cutter.cut_at(selection);
    built.notes.push_back(
        fmt::format("faces are cut along the ends of selection '{}': {} "
                    "triangles became {}",
                    selection.name, before, mesh.triangle_count()));
  }
  measure(mesh, built.report);
}

std::string uncut_warning(const SceneStudy& study, const BuiltScene& built) {
  constexpr double worth_telling = 0.02;  // of the selection's area
  const SceneFrame frame{built.crs, built.site.north_deg};
  for (const AssignRule& rule : study.assign) {
    if (!rule.selection || !has_ends(rule.selection->of)) continue;
    const NamedSelection& selection = *rule.selection;
    if (std::any_of(study.cut.begin(), study.cut.end(),
                    [&](const NamedSelection& cut) { return cut.name == selection.name; }))
      continue;
    Mesh mesh = built.scene.mesh;
    Bodies no_bodies;
    no_bodies.triangle_body.assign(mesh.triangle_count(), -1);
    std::vector<std::uint8_t> no_seals;
    const double whole = area_of(selected_faces(selection, mesh, frame), mesh);
    FaceCutter(mesh, no_bodies, no_seals, frame).cut_at(selection);
    const double exact = area_of(selected_faces(selection, mesh, frame), mesh);
    if (std::abs(whole - exact) <= worth_telling * exact) continue;
    return message(rule.where,
                   fmt::format("selection '{}' holds {:.4g} m2, of which whole triangles by their "
                               "middle make {:.4g} m2",
                               selection.name, exact, whole),
                   "the rule gives its material to these",
                   "scene.cut: [" + selection.name + "] cuts faces along its ends");
  }
  return {};
}

}  // namespace sunload
