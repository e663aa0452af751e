// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which part of the patches of two results lies in the same place.
#pragma once

#include <cstddef>
#include <vector>

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

}  // namespace sunload
