// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Form factors of a scene: the share of the diffuse light that a surface sends and that arrives
/// straight at another one.
///
/// Geometry alone (solver/matrix): mirrors are surfaces like others, and what lets light pass
/// counts as solid, so that A_i F_ij = A_j F_ji.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geo/base/vec.h"
#include "io/plan/variant_plan.h"
#include "solver/base/watch.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

/// What the rows and columns of a table are; surfaces: kinds of surface.
enum class FactorsBetween { patches, facades, objects, surfaces };
/// Of "patch" (or nothing), "facade", "object", "surface". Throws InputError for other words.
FactorsBetween factors_between(const std::string& word);
/// "patch", "facade" …
std::string factor_word(FactorsBetween between);

/// Rows and columns are the same things, in the order of the result: patches, or groups of them
/// that have an area.
struct FactorTable {
  FactorsBetween between = FactorsBetween::patches;
  std::string study, variant, content_hash;
  Vec3 origin;                    ///< that places are relative to [m]
  std::vector<std::string> name;  ///< of groups; of patches their index
  std::vector<double> area_m2;
  /// Of patches alone; facades may be empty.
  struct PatchFacts {
    std::string object, facade, surface;
    std::int32_t side = 0;  ///< 1: the back of a two-sided surface
    Vec3 centroid, normal;
  };
  std::vector<PatchFacts> patch;
  std::vector<double> factor, factor_se;  ///< [row × size() + column]
  /// 1 − Σ of the row: the sky, the far ground, what has no patches (floors, backs of surfaces),
  /// and patches of no group.
  std::vector<double> elsewhere, elsewhere_se;
  double area_of_none_m2 = 0;  ///< of the patches that are of no group
  std::size_t patches = 0, realizations = 0;
  std::uint64_t rays = 0;
  bool has_formulas = false;  ///< pairs in full view have theirs by formula

  std::size_t size() const { return area_m2.size(); }
};

/// Of the patches of `mesh`, which is the plan's. Throws InputError where these are too many to
/// have a matrix, Interrupted.
FactorTable form_factor_table(const VariantPlan& plan, const Hierarchy& mesh,
                              FactorsBetween between, Watch& watch);

/// What a name can end in: `.h5` or `.csv`; an empty one is the standard output, as CSV. Throws
/// InputError.
void expect_factor_file(const std::string& path);
/// Writes the file that the name's ending says. Throws MachineError.
void write_form_factors(const FactorTable& table, const std::string& path);

}  // namespace sunload
