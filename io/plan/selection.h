// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What selections of a study choose: whole objects, faces, patches.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geo/edit/objects.h"
#include "geo/mesh/mesh.h"
#include "io/study/study.h"

namespace sunload {

class Hierarchy;
struct BuiltScene;

/// How places and directions of a study are understood.
struct SceneFrame {
  std::string crs;       ///< of the coordinates of its files; empty: none is known
  double north_deg = 0;  ///< azimuth, clockwise from true north, of +y
};

/// One flag per thing: 1 is chosen.
using ChosenParts = std::vector<std::uint8_t>;

/// Objects by name and type, and where they are in the metres of the scene's files.
struct SceneObjects {
  const std::vector<std::string>& names;
  const std::vector<std::string>& kinds;  ///< may be fewer than names: of no type
  std::vector<ObjectExtent> extents;
};

class Selector {
 public:
  /// `subject` and `where` are for messages: "scene.edit[2]". All must outlive it.
  Selector(const SelectionStudy& wanted, const SceneFrame& frame, std::string subject, Where where)
      : wanted_(wanted), frame_(frame), subject_(std::move(subject)), where_(std::move(where)) {}

  /// Whole objects: the middle of their bounding boxes lies in the polygon, the boxes come as near
  /// in plan as asked for. What chooses parts has no say. Throws InputError for places of another
  /// frame: degrees that are none, and farther away than the scene is wide.
  ChosenObjects objects(const SceneObjects& all) const;

  /// A face or a patch.
  struct Part {
    ObjectId object;
    FacadeId facade;
    Surface surface;
    Vec3 middle, normal;  ///< in the metres of the scene's files
  };
  /// Of `part(i)` for i < count; throws as above. `facades`: their names.
  template <class PartOf>
  ChosenParts parts(const SceneObjects& all, const std::vector<Facade>& facades, std::size_t count,
                    const PartOf& part) const {
    const Sight sight = sight_of(all);
    ChosenParts chosen(count, 0);
    for (std::size_t i = 0; i < count; ++i) chosen[i] = holds(sight, all, facades, part(i)) ? 1 : 0;
    return chosen;
  }

 private:
  /// What all parts have in common.
  struct Sight {
    std::vector<PlanArea> areas;
    ChosenObjects objects;
  };
  Sight sight_of(const SceneObjects& all) const;
  bool holds(const Sight& sight, const SceneObjects& all, const std::vector<Facade>& facades,
             const Part& part) const;
  ChosenObjects named_objects(const SceneObjects& all) const;
  void keep_nearest(const SceneObjects& all, ChosenObjects& chosen) const;

  const SelectionStudy& wanted_;
  const SceneFrame& frame_;
  std::string subject_;
  Where where_;
};

/// The areas in the scene's metres. Throws InputError for degrees that are none.
std::vector<PlanArea> areas_in_scene(const AreasStudy& study, const std::string& crs,
                                     const std::string& subject, const Where& where);
/// Throws InputError for a place that is another frame's, or a slip: farther from the scene than
/// that is wide.
void refuse_far(Point2 place, const std::vector<ObjectExtent>& extents, const std::string& subject,
                const Where& where);

/// Of a selection without patches.
std::string empty_selection_warning(const std::string& name);

/// Faces of a mesh by their centroids.
ChosenParts selected_faces(const NamedSelection& selection, const Mesh& mesh,
                           const SceneFrame& frame);
/// Patches of a mesh by their centroids, both sides of what has two.
ChosenParts selected_patches(const NamedSelection& selection, const BuiltScene& built,
                             const Hierarchy& hierarchy);

}  // namespace sunload
