// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What groups of two results have in common.
#pragma once

#include <vector>

#include "io/result/common_area.h"
#include "io/result/patch_groups.h"

namespace sunload {

/// Per division of either result what it has in common with that of the other; nothing where the
/// other has no such division.
struct CommonGroups {
  std::vector<PatchMembers> base, variant;
};

/// By kind and name; each selection is a division of its own.
CommonGroups common_groups(const PatchOverlaps& overlaps, const CountedPatches& counted,
                           const std::vector<PatchDivision>& of_base,
                           const std::vector<PatchDivision>& of_variant);

}  // namespace sunload
