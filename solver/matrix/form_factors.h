// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Form factors between all patches of a small scene of diffuse surfaces, and light by them.
///
/// Pairs that are proved to be in full view of each other have theirs by formula
/// (solver/matrix/polygon_exchange); of all others many lines tell, from both ends,
///
///     A_i F_ij = ½ (A_i hits_ij / lines + A_j hits_ji / lines),
///
/// which keeps A_i F_ij = A_j F_ji. Realizations have lines of their own, none of which any other
/// transport casts.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/watch.h"
#include "solver/lines/lines.h"
#include "solver/mesh/hierarchy.h"
#include "solver/mesh/patch_optics.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// Their factors take 36 MB for each realization, and some seconds.
inline constexpr std::size_t most_matrix_patches = 2000;

/// How many lines estimate the factors that no formula gives.
struct FormFactorRules {
  int realizations = 8;
  std::uint64_t seed = 1;
  int lines_per_patch = 8192;  ///< over all realizations together
};

/// Form factors between n patches, by realizations and in their mean.
struct FormFactors {
  std::size_t patches = 0;
  std::vector<std::vector<float>> realizations;  ///< [R][n][n] F_ij, from row i to column j
  std::vector<float> mean;                       ///< of them
  std::uint64_t rays = 0;
  std::size_t pairs_by_formula = 0, pairs_by_lines = 0;  ///< that see each other
};

/// The same bits for any number of threads. Throws Interrupted.
FormFactors form_factors(const Mesh& mesh, const Hierarchy& hierarchy, const RayCaster& caster,
                         const FormFactorRules& rules, Watch& watch);

/// How far diffuse reflections are followed.
enum class Reflections { all, counted };

/// Puts the factors in the place of what lines tell of patches: links, and light of emitters. With
/// Reflections::all the links stand for all reflections at once (LineSet::all_reflections).
void put_form_factors(const FormFactors& factors, const PatchOptics& optics, Reflections followed,
                      Lines& lines);

}  // namespace sunload
