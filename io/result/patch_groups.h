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

/// Every group of a result, and the groups of each patch.
class PatchGroups {
 public:
  /// Order: the whole, then surfaces, objects, facades and selections as the file lists
  /// them, then those besides; groups without patches are left out.
  /// Throws InputError for a result without patches.
  explicit PatchGroups(const ResultReader& result);
  /// The same with so much of each patch's area; groups of which nothing is left are left out.
  PatchGroups(const ResultReader& result, std::vector<double> area, const MoreGroups& more = {});

  const std::vector<PatchGroup>& groups() const { return groups_; }
  std::size_t patch_count() const { return area_.size(); }
  const std::vector<double>& patch_area() const { return area_; }
  /// Area-weighted mean of one value per patch, for every group.
  std::vector<double> means(const double* patch_values) const;

 private:
  std::size_t divisions_ = 0;  ///< of the patches, each by its groups; a selection is one
  std::vector<PatchGroup> groups_;
  std::vector<double> area_;
  /// Group of a patch in each division, -1 for none: [patch × divisions + division].
  std::vector<std::int32_t> group_of_;
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
