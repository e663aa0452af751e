// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches of a result by facade, object, surface and as a whole: area-weighted
/// means of what they receive.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/result/reader.h"

namespace sunload {

/// One named set of patches.
struct PatchGroup {
  std::string kind;  ///< whole | surface | object | facade
  std::string name;
  double area_m2 = 0;
};

/// Every group of a result, and the groups of each patch.
class PatchGroups {
 public:
  /// Order: the whole, then surfaces, objects and facades as the file lists
  /// them; groups without patches are left out.
  /// Throws InputError for a result without patches.
  explicit PatchGroups(const ResultReader& result);
  /// The same with so much of each patch's area; groups of which nothing is left are left out.
  PatchGroups(const ResultReader& result, std::vector<double> area);

  const std::vector<PatchGroup>& groups() const { return groups_; }
  std::size_t patch_count() const { return area_.size(); }
  const std::vector<double>& patch_area() const { return area_; }
  /// Area-weighted mean of one value per patch, for every group.
  std::vector<double> means(const double* patch_values) const;

 private:
  static constexpr std::size_t kinds = 4;
  std::vector<PatchGroup> groups_;
  std::vector<double> area_;
  /// Group of a patch for each kind, -1 for none: [patch × kinds + kind].
  std::vector<std::int32_t> group_of_;
};

/// Area-weighted group means of a dataset [patch]: one value per group.
std::vector<double> group_means(const ResultReader& result, const PatchGroups& groups,
                                const std::string& dataset);

/// As above for every realization of light_load_realization: [group][realization];
/// no realizations where the file keeps none.
std::vector<std::vector<double>> group_realizations(const ResultReader& result,
                                                    const PatchGroups& groups);

}  // namespace sunload
