// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which part of the patches of two results lies in the same place.
#pragma once

#include <cstddef>
#include <vector>

#include "io/result/patch_groups.h"
#include "io/result/reader.h"

namespace sunload {

/// Area [m2] that patches have in common with those of another result: in the same plane, seen from
/// the same side, of objects of the same name. Patches that are cut otherwise share what they
/// overlap. Exact but for a thousandth of a patch, which is rounding; planes are the same within a
/// millimetre.
struct CommonArea {
  std::vector<double> base, variant;  ///< per patch
};

/// What lies on each patch of the base.
struct PatchOverlaps {
  /// A patch of the variant that shares area with one of the base.
  struct Overlap {
    std::size_t patch = 0;  ///< of the variant
    double area = 0;        ///< in common [m2]
  };
  std::vector<std::vector<Overlap>> of_base;
  std::vector<double> base_area, variant_area;  ///< of the patches
};
PatchOverlaps patch_overlaps(const ResultReader& base, const ResultReader& variant);

/// Values of the variant's patches as area-weighted means over each patch of the base; NaN where
/// patches of the variant do not cover all of it, but for rounding.
std::vector<double> means_on_base(const PatchOverlaps& overlaps,
                                  const std::vector<double>& of_variant);

/// Patches of two results that count, 1 or 0 each; empty: all.
struct CountedPatches {
  std::vector<char> base, variant;
};

/// What counts of both. Some microseconds a patch; nothing where both have the same mesh.
CommonArea common_area(const ResultReader& base, const ResultReader& variant,
                       const CountedPatches& counted = {});

/// Patches of both that overlap, with all that overlap these: the least pieces that both results
/// cut in ways of their own. Number of each patch's tile.
struct Tiles {
  std::vector<std::size_t> of_base, of_variant;
  std::size_t count = 0;
};
Tiles tiles_of(const PatchOverlaps& overlaps);

/// What counts of both and is of one name in one kind of groups, with as much area of each.
struct CommonMembers {
  PatchMembers base, variant;
};

/// The names are those that both give the place. Selections and storeys have patches by their
/// middles, and where meshes are unlike these are others: of a tile that one result cuts into fewer
/// patches, a patch of that result is of its name, whole, if any of the other's on it is, too.
CommonMembers common_members(const PatchOverlaps& overlaps, const Tiles& tiles,
                             const CountedPatches& counted, const PatchDivision& of_base,
                             const PatchDivision& of_variant);

}  // namespace sunload
