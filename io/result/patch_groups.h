// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches of a result by facade, object, surface and as a whole: area-weighted
/// means of what they receive.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/result/reader.h"

namespace sunload {

/// One named set of patches.
struct PatchGroup {
  /// whole | surface | object | facade | selection | orientation | storey
  std::string kind;
  std::string name;
  double area_m2 = 0;
};

/// Groups besides those that every result has.
struct MoreGroups {
  bool orientations = false;  ///< walls and windows by eight compass points: "south"
  std::optional<double>
      storey_m;  ///< walls and windows by height above their object's foot: "0-3 m"
};

/// Patches divided into groups of one kind.
struct PatchDivision {
  std::string kind;
  std::vector<std::string> names;
  std::vector<std::int32_t> of_patch;  ///< which of the names; -1: none
};

/// Walls and windows by eight compass points from north on, clockwise: "north", "north-east", …
PatchDivision orientations(const ResultReader& result);

/// Order: the whole, then surfaces, objects, facades and selections (each one of its own) as the
/// file lists them, then those besides.
std::vector<PatchDivision> patch_divisions(const ResultReader& result, const MoreGroups& more = {});

/// So much of a patch belongs to one of the names.
struct PatchMember {
  std::size_t patch = 0, name = 0;
  double area_m2 = 0;
};

/// Groups of one kind, with what belongs to them.
struct PatchMembers {
  std::string kind;
  std::vector<std::string> names;
  std::vector<PatchMember> members;  ///< patches in order; none of no area
};

/// With so much of each patch's area.
PatchMembers members_of(const PatchDivision& division, const std::vector<double>& area);

/// Every group of a result, and what of each patch belongs to it.
class PatchGroups {
 public:
  /// In the order of `patch_divisions`; groups without patches are left out.
  /// Throws InputError for a result without patches.
  explicit PatchGroups(const ResultReader& result);
  /// The same in an order of one's own, of the patches of a result.
  PatchGroups(std::size_t patches, const std::vector<PatchMembers>& kinds);

  const std::vector<PatchGroup>& groups() const { return groups_; }
  std::size_t patch_count() const { return patches_; }
  /// Area-weighted mean of one value per patch, for every group.
  std::vector<double> means(const double* patch_values) const;

 private:
  struct Member {
    std::size_t patch, group;
    double area;
  };
  std::size_t patches_;
  std::vector<PatchGroup> groups_;
  std::vector<Member> members_;
};

/// Area-weighted group means of a dataset [patch]: one value per group.
std::vector<double> group_means(const ResultReader& result, const PatchGroups& groups,
                                const std::string& dataset);

/// As above for every row of a dataset [realization, patch]: [group][realization]; no realizations
/// where the file keeps none or no dataset is named.
std::vector<std::vector<double>> group_realizations(
    const ResultReader& result, const PatchGroups& groups,
    const std::string& dataset = "light_load_realization");

}  // namespace sunload
