// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What no light can reach: inside of bodies, against other surfaces, below the land; and what is
/// there twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/mesh/covers.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"
#include "geo/mesh/overlap.h"

namespace sunload {

/// Surfaces this near to each other touch: or 1e-4 of the scene's diagonal, where that is less.
inline constexpr double contact_m = 2e-3;  // city models are written in whole millimetres

/// What cut_covered did to a mesh.
struct CoveredCut {
  std::vector<std::size_t> source;  ///< per triangle that there is now: what it is (a part) of
  std::size_t cut = 0;              ///< triangles that were divided
  std::size_t covered = 0;          ///< triangles that are covered now, parts and whole ones
  Doubled taken;                    ///< what is left out, and its first two triangles as they were
};

/// Marks covered triangles in `mesh.triangle_covered`; those that are covered in part are divided
/// along the line where that begins, in their place in the order. Facades lose what is covered of
/// them, and go where nothing is left; the names of the others stay.
///
/// Covered is what has its front inside of a closed body, or in a hollow of one where these are
/// dark, against the front of another surface (also of solids that are one body since they share an
/// edge), hidden by one that faces the same way at twice that distance, or below land (open
/// surfaces of kind ground but roads and railways, which may be bridges; of land also where another
/// body of a type of land lies above it, and roads within half a metre). Surfaces for which
/// `is_opaque` is 0 cover nothing, nor do bodies that have some. Two-sided surfaces are covered
/// inside of bodies and below land only. Land is covered below floors that are closed at their rim,
/// and above such a floor where more of its object is above the land: `seals` are these floors and
/// the walls at their rim (geo/mesh/ground).
///
/// Left out is what lies in the place of another opaque surface and faces where that does: the
/// first of them stays, but before others what `emits` (empty: nothing), then windows, also before
/// or behind their wall by as much as surfaces touch, then two-sided surfaces; last bare terrain.
/// No ray could tell which of the two it meets.
///
/// Where nothing is covered or left out, nothing changes. Throws InputError where too many
/// triangles overlap.
CoveredCut cut_covered(Mesh& mesh, Bodies& bodies, const std::vector<std::uint8_t>& is_opaque,
                       const std::vector<std::uint8_t>& seals = {},
                       const std::vector<std::uint8_t>& emits = {},
                       Cavities cavities = Cavities::lit);

}  // namespace sunload
