// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What selections of a study choose: whole objects, faces, patches.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geo/edit/objects.h"
#include "geo/mesh/families.h"
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

/// Objects by name, type and family, and where they are in the metres of the scene's files.
struct SceneObjects {
  FamilyTree tree;
  std::vector<ObjectExtent> extents;
};

/// Objects whose name, or that of something that they belong to, matches the pattern.
ChosenObjects objects_named(const std::string& pattern, const FamilyTree& tree);
ChosenObjects objects_named(const std::string& pattern, const Mesh& mesh);

/// One selection at work on a scene.
class Selector {
 public:
  /// `subject` and `where` are for messages: "scene.edit[2]". All must outlive it.
  Selector(const SelectionStudy& wanted, const SceneFrame& frame, std::string subject, Where where)
      : wanted_(wanted), frame_(frame), subject_(std::move(subject)), where_(std::move(where)) {}

  /// Whole objects, each with all that belongs to it. Places are asked of the topmost object that
  /// name and type choose, a house rather than its parts: the middle of the box about its family
  /// must lie in the polygon, and the box come as near in plan as asked for. Keys that choose parts
  /// of objects are left out of account. Throws InputError for places of another frame: degrees
  /// that are none, and places farther away than the scene is wide.
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
  /// Families of what is chosen by name and type; by place in the tree.
  struct ChosenFamilies {
    std::vector<std::optional<std::size_t>> head;  ///< none: it is not chosen
    std::vector<ObjectExtent> extents;             ///< of heads: the family's; of others empty
    ChosenParts kept;                              ///< 1: a head that place, too, chooses
  };
  ChosenFamilies families_of(const SceneObjects& all) const;
  void keep_nearest(ChosenFamilies& families) const;
  static ChosenObjects members_of_kept(const ChosenFamilies& families, const SceneObjects& all);

  const SelectionStudy& wanted_;
  const SceneFrame& frame_;
  std::string subject_;
  Where where_;
};

/// The areas in the scene's metres. Throws InputError for degrees that are none.
std::vector<PlanArea> areas_in_scene(const AreasStudy& study, const std::string& crs,
                                     const std::string& subject, const Where& where);
/// Throws InputError for a place that is farther from the scene than the scene is wide: it is of
/// another frame, or a slip.
void refuse_far(Point2 place, const std::vector<ObjectExtent>& extents, const std::string& subject,
                const Where& where);

/// For messages: "selections.south".
std::string subject_of(const NamedSelection& selection);
/// What to warn of where a selection has no patches.
std::string empty_selection_warning(const std::string& name);

// What a named selection chooses, less what it leaves out. They throw as a Selector does.
/// Whole objects.
ChosenObjects selected_objects(const NamedSelection& selection, const SceneObjects& all,
                               const SceneFrame& frame);
/// Faces of a mesh by their centroids.
ChosenParts selected_faces(const NamedSelection& selection, const Mesh& mesh,
                           const SceneFrame& frame);
/// The same of a mesh that has only some faces of objects of these extents.
ChosenParts selected_faces(const NamedSelection& selection, const Mesh& mesh,
                           const SceneFrame& frame, std::vector<ObjectExtent> extents);
/// Patches of a mesh by their centroids, both sides of what has two.
ChosenParts selected_patches(const NamedSelection& selection, const BuiltScene& built,
                             const Hierarchy& hierarchy);

}  // namespace sunload
