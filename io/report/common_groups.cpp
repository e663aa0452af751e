// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/common_groups.h"

#include <algorithm>
#include <utility>

namespace sunload {
namespace {

/// nullptr: the other result has none like it.
const PatchDivision* counterpart(const PatchDivision& of,
                                 const std::vector<PatchDivision>& others) {
  const auto found = std::find_if(others.begin(), others.end(), [&](const PatchDivision& other) {
    return other.kind == of.kind && (of.kind != "selection" || other.names == of.names);
  });
  return found == others.end() ? nullptr : &*found;
}

}  // namespace

CommonGroups common_groups(const PatchOverlaps& overlaps, const CountedPatches& counted,
                           const std::vector<PatchDivision>& of_base,
                           const std::vector<PatchDivision>& of_variant) {
  const Tiles tiles = tiles_of(overlaps);
  CommonGroups common;
  for (const PatchDivision& division : of_variant)
    common.variant.push_back({division.kind, {}, {}});
  for (const PatchDivision& division : of_base) {
    const PatchDivision* other = counterpart(division, of_variant);
    if (!other) {
      common.base.push_back({division.kind, {}, {}});
      continue;
    }
    auto [base, variant] = common_members(overlaps, tiles, counted, division, *other);
    common.base.push_back(std::move(base));
    common.variant[static_cast<std::size_t>(other - of_variant.data())] = std::move(variant);
  }
  return common;
}

}  // namespace sunload
