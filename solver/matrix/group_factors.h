// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Form factors between groups of patches, in scenes of any size.
///
///     A_G F_GH = Σ_{i in G, j in H} A_i F_ij
///
/// Of a scene that is small enough the factors of all pairs are summed
/// (solver/matrix/form_factors); of any other the same lines tell of all pairs, fewer of each
/// patch, from both ends.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/matrix/form_factors.h"

namespace sunload {

/// Their factors take 32 MB for each realization.
inline constexpr std::size_t most_factor_groups = 2000;

/// Which group each patch is of; -1: of none. Each patch by itself, too, is a grouping.
struct PatchGrouping {
  std::vector<std::int32_t> group_of;  ///< [patch]
  std::size_t groups = 0;
};

/// Form factors between the groups; they keep their numbers.
struct GroupFactors {
  std::size_t groups = 0;
  std::vector<double> area;                       ///< [group], m2
  std::vector<std::vector<double>> realizations;  ///< [R][group × group] F_GH, from row G to H
  std::uint64_t rays = 0;
  bool has_formulas = false;  ///< of pairs in full view
};

/// A_G F_GH = A_H F_HG within rounding. What a row lacks to 1 goes to the sky, to patches of no
/// group, to backs or floors; where none of these is seen it may be below 0, by its error. The same
/// bits for any number of threads. Throws Interrupted.
GroupFactors group_factors(const Mesh& mesh, const Hierarchy& hierarchy, const RayCaster& caster,
                           const PatchGrouping& grouping, const FormFactorRules& rules,
                           Watch& watch);

}  // namespace sunload
