// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Variants of one geometry share one mesh, refined by the pilots of all of them, so that their
/// patches pair one to one (docs/developer/design.md, Hash).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/plan/planner.h"
#include "io/plan/variant_mesh.h"

namespace sunload {

/// What a pilot needs beside the geometry. It is the same for all variants with the same light and
/// the same mirrors, lamps and screens.
struct MeshPilotInput {
  std::vector<Material> materials;
  std::vector<MaterialId> material;  ///< per triangle
  Luminaires luminaires;
  std::shared_ptr<const PeriodLight> light;
};

/// Refining takes no more pilots than this; of more it takes some, evenly in the order of their
/// digests.
inline constexpr std::size_t most_mesh_pilots = 8;

/// The pilots that refine one mesh, and the mesh.
struct MeshFamily {
  std::vector<MeshPilotInput> pilots;
  std::string digest;  ///< of them, part of each variant's hash; empty of a single one
  /// The mesh, once a variant has needed it.
  mutable std::optional<VariantMesh> made;
};

/// Which variants of a study share a mesh.
class MeshFamilies {
 public:
  /// Plans all variants of a study, whichever are to be computed, unless none can share a mesh.
  /// Throws InputError with every problem of any of them.
  MeshFamilies(const StudyFile& file, Planner& planner);

  /// Gives a plan of the study its family, if it has one, and the hash that follows.
  void join(VariantPlan& plan) const;

 private:
  void add(const VariantPlan& plan);
  std::shared_ptr<const PeriodLight> light_of(const VariantPlan& plan);

  struct Members {
    std::size_t variants = 0;
    std::map<std::string, MeshPilotInput> pilots;  ///< by digest
  };
  std::map<std::string, Members> members_;     ///< by what decides the mesh but light and materials
  std::map<std::string, std::string> key_of_;  ///< of `members_`, by variant
  std::map<std::string, std::shared_ptr<const MeshFamily>> families_;
  static constexpr double most_lights = 1024;  ///< 32 kB each
  RecentlyMade<std::shared_ptr<const PeriodLight>> lights_{most_lights};
};

}  // namespace sunload
