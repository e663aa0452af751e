// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Study → scene: files read and put together, prepared, materials assigned.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "geo/mesh/covered.h"
#include "geo/mesh/mesh_prepare.h"
#include "geo/sun/site.h"
#include "io/plan/material_assign.h"
#include "io/study/study.h"
#include "solver/surface/material.h"

namespace sunload {

/// A scene that light can be computed in, with what is told of its making.
struct BuiltScene {
  Scene scene;
  PrepareReport report;
  Site site;                          ///< position and north, from study or CRS
  std::string site_source;            ///< in words: where position and north come from
  std::string crs;                    ///< of the scene's coordinates; empty: none is known
  double crs_unit_m = 1;              ///< length of its unit, where metres were made of it
  std::vector<std::string> files;     ///< of the scene, with those that they draw in
  std::vector<std::string> notes;     ///< what readers counted
  std::vector<std::string> warnings;  ///< each states its consequence
  std::set<std::string> placed;       ///< names of objects that steps added, moved or turned
  std::vector<RuleUse> rules;         ///< of scene.assign, in their order
  std::vector<Sides> sides_of_files;  ///< per triangle, before materials decided
  /// Per triangle 1 where its back is in a house, and is no patch whatever its material says;
  /// empty: nowhere (geo/mesh/dark_backs).
  std::vector<std::uint8_t> dark_backs;
  std::vector<FoundFacade> facades;  ///< that north may give other names
  Bodies bodies;                     ///< with `seals`: of the mesh, until what is covered is cut
  std::vector<std::uint8_t> seals;
};

/// Length of the unit of a map [m], where `scene.unit_m` makes metres of its coordinates; else 1:
/// of maps in metres, and where files are taken as they are.
double crs_unit_m(const SceneStudy& scene, const std::string& crs);

/// Throws InputError with every problem found.
BuiltScene build_scene(const Study& study);

/// The first of its steps: reads and prepares. Materials and their rules have no part in this.
BuiltScene scene_before_materials(const Study& study);
/// Names of materials in the file of `scene.parallel_sources`, where there is one. Throws
/// InputError where it cannot be read.
std::vector<std::string> materials_of_parallel_sources(const SceneStudy& scene);
/// Turns a prepared scene to the north that `study` gives; in a scene without CRS nothing else
/// depends on north.
void turn_to_north(const Study& study, BuiltScene& built);
/// What materials will say of a triangle, as far as it decides what is covered.
struct SurfaceFacts {
  bool is_opaque = false;     ///< light does not pass it: panes cover as walls do
  bool is_two_sided = false;  ///< lit on both sides
  bool emits = false;
  bool has_dark_back = false;  ///< its back is in a house (geo/mesh/dark_backs): lit from one side
};
/// Of a whole scene; without triangles where nothing is to be covered (`repair: none`).
struct FactsOfScene {
  std::vector<SurfaceFacts> of_triangle;
  Cavities cavities = Cavities::dark;  ///< lit where lamps may be in closed rooms

  /// Tells scenes apart that are covered otherwise.
  std::string key() const;
};
FactsOfScene surface_facts(const Study& study, const BuiltScene& prepared);
/// The second step: the scene without what is covered. Of materials it depends on `facts` alone.
BuiltScene scene_uncovered(const Study& study, const BuiltScene& prepared,
                           const FactsOfScene& facts);
/// Materials' sides, where a back is not dark.
void take_dark_backs(const BuiltScene& built, Mesh& mesh);
/// The last step: gives materials, parallel sources, luminaires and sensors.
void give_materials(const Study& study, BuiltScene& built);

}  // namespace sunload
