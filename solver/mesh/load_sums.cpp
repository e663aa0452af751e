// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/load_sums.h"

#include <algorithm>
#include <cmath>

namespace sunload {

namespace {

/// Share of the squared error whose leaves are split in one pass (Dörfler's parameter).
constexpr double marked_share = 0.5;
/// Where the tolerance is out of reach because leaves of the least area hold too much of the error,
/// the others are split until they hold this share of it: more would hardly lower the sum.
constexpr double worth_splitting = 0.2;
/// Of kinds that receive next to nothing the error is a share of this part of the mean of all.
constexpr double least_share_of_mean = 0.1;
/// Of glints a tolerance is so many times as wide: at five per cent of the mean, a quarter of their
/// own root mean square, where an eighth of their area lies at an edge.
constexpr double glint_width = 5;
constexpr std::size_t glints = mesh_kind_glints;

/// Sums over the leaves of one kind.
struct KindSum {
  double squares = 0, power = 0, area = 0;
};

bool has_visible_glints(const LoadEstimate& e, double visible) {
  return e.glint_squares > visible * visible * e.area_m2;
}

/// The estimate's part in the error of a kind, of glints only where they can be seen.
double squares_of(const LoadEstimate& e, std::size_t kind, double visible) {
  if (kind != glints) return e.squared_error;
  return has_visible_glints(e, visible) ? e.glint_squared_error : 0;
}

}  // namespace

/// What light load is seen against the mean of all.
double LoadSums::visible_load(std::span<const std::size_t> leaves) const {
  double power = 0, area = 0;
  for (const auto leaf : leaves) {
    power += estimates_[leaf].power;
    area += estimates_[leaf].area_m2;
  }
  return area > 0 ? tolerance_ * power / area : 0;
}

KindErrors LoadSums::errors(std::span<const std::size_t> leaves) const {
  std::array<KindSum, mesh_kinds> sums;
  KindSum all;
  const double visible = visible_load(leaves);
  for (const auto leaf : leaves) {
    const LoadEstimate& e = estimates_[leaf];
    KindSum& sum = sums[places_[leaf].kind];
    for (KindSum* each : {&sum, &all}) {
      each->power += e.power;
      each->area += e.area_m2;
    }
    sum.squares += e.squared_error;
    sums[glints].squares += squares_of(e, glints, visible);
    if (has_visible_glints(e, visible)) sums[glints].power += e.glint_squares;
  }
  KindErrors errors{};
  if (all.power <= 0) return errors;
  for (std::size_t k = 0; k < glints; ++k) {
    if (sums[k].area <= 0) continue;
    const double mean =
        std::max(sums[k].power / sums[k].area, least_share_of_mean * all.power / all.area);
    errors[k] = std::sqrt(std::max(0.0, sums[k].squares) / sums[k].area) / mean;
  }
  if (sums[glints].power > 0)
    errors[glints] =
        std::sqrt(std::max(0.0, sums[glints].squares) / sums[glints].power) / glint_width;
  return errors;
}

void LoadSums::mark(std::size_t kind, std::span<const std::size_t> leaves,
                    std::vector<std::size_t>& marked) const {
  struct Candidate {
    std::size_t leaf;
    double squares;
  };
  std::vector<Candidate> candidates;
  double total = 0, of_all = 0;
  const double visible = visible_load(leaves);
  for (const auto leaf : leaves) {
    if (kind != glints && places_[leaf].kind != kind) continue;
    const double squares = squares_of(estimates_[leaf], kind, visible);
    of_all += squares;
    if (squares <= 0 || !places_[leaf].can_be_split) continue;
    candidates.push_back({leaf, squares});
    total += squares;
  }
  if (total <= worth_splitting * of_all) return;
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.squares != b.squares ? a.squares > b.squares : a.leaf < b.leaf;
  });
  double sum = 0;
  for (const auto& candidate : candidates) {
    if (sum >= marked_share * total) break;
    sum += candidate.squares;
    marked.push_back(candidate.leaf);
  }
}

}  // namespace sunload
