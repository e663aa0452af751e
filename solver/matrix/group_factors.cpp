// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/matrix/group_factors.h"

#include <algorithm>

#include "geo/base/check.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/lines/patch_lines.h"

namespace sunload {

namespace {

/// Exchange between groups, A_G F_GH [m2], of each realization.
using Exchanges = std::vector<std::vector<double>>;

bool is_of_group(std::int32_t group) { return group >= 0; }

std::vector<double> areas_of(const Hierarchy& hierarchy, const PatchGrouping& grouping) {
  std::vector<double> area(grouping.groups, 0);
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i)
    if (const auto g = grouping.group_of[i]; is_of_group(g))
      area[static_cast<std::size_t>(g)] += hierarchy.area()[i];
  return area;
}

/// Rows of patches into rows of their groups.
Exchanges summed(const FormFactors& factors, const Hierarchy& hierarchy,
                 const PatchGrouping& grouping) {
  const std::size_t n = factors.patches, G = grouping.groups;
  Exchanges exchanges(factors.realizations.size(), std::vector<double>(G * G, 0));
  parallel_for(exchanges.size(), [&](std::size_t r) {
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_of_group(grouping.group_of[i])) continue;
      double* row = exchanges[r].data() + static_cast<std::size_t>(grouping.group_of[i]) * G;
      const float* F = factors.realizations[r].data() + i * n;
      for (std::size_t j = 0; j < n; ++j)
        if (const auto h = grouping.group_of[j]; is_of_group(h))
          row[h] += hierarchy.area()[i] * static_cast<double>(F[j]);
    }
  });
  return exchanges;
}

/// What the lines of one patch meet.
struct Met {
  std::int32_t group;
  std::uint32_t lines;
};

/// Lines from every patch that is of a group.
class ByLines {
 public:
  ByLines(const Hierarchy& hierarchy, const RayCaster& caster, const PatchGrouping& grouping,
          const FormFactorRules& rules, Watch& watch)
      : hierarchy_(hierarchy),
        caster_(caster),
        grouping_(grouping),
        rules_(rules),
        watch_(watch),
        R_(static_cast<std::size_t>(rules.realizations)),
        lines_each_(lines_of_patch(hierarchy.patch_count(), rules) / R_) {}

  std::uint64_t rays() const { return hierarchy_.patch_count() * R_ * lines_each_; }

  /// Sums in the order of the patches, whoever cast their lines.
  Exchanges exchanges() const {
    const std::size_t n = hierarchy_.patch_count(), G = grouping_.groups;
    Exchanges sums(R_, std::vector<double>(G * G, 0));
    std::vector<std::vector<Met>> met(patches_at_a_time * R_);
    for (std::size_t first = 0; first < n; first += patches_at_a_time) {
      const std::size_t count = std::min(patches_at_a_time, n - first);
      parallel_for(count * R_, [&](std::size_t k) { met[k] = met_by(first + k / R_, k % R_); });
      for (std::size_t k = 0; k < count * R_; ++k) add(first + k / R_, met[k], sums[k % R_]);
      watch_.cast(static_cast<double>(count * R_ * lines_each_));
      watch_.advance(Stage::lines, static_cast<double>(first + count) / static_cast<double>(n));
    }
    return sums;
  }

 private:
  static constexpr std::size_t patches_at_a_time = 4096;
  /// Half a minute of two processors; as few lines of each patch as that allows, and not below 16
  /// of a realization.
  static constexpr std::size_t most_rays = 100'000'000;

  static std::size_t lines_of_patch(std::size_t patches, const FormFactorRules& rules) {
    const auto realizations = static_cast<std::size_t>(rules.realizations);
    return std::clamp(
        most_rays / patches, packet_size * realizations,
        std::max(static_cast<std::size_t>(rules.lines_per_patch), packet_size * realizations));
  }

  std::vector<Met> met_by(std::size_t i, std::size_t r) const {
    std::vector<Met> met;
    if (!is_of_group(grouping_.group_of[i])) return met;
    const PatchLines lines(hierarchy_, i, caster_.offset_m(),
                           random_words({.seed = rules_.seed,
                                         .purpose = Purpose::form_factors,
                                         .realization = static_cast<std::uint32_t>(r),
                                         .element = hierarchy_.key()[i]}));
    for (std::size_t first = 0; first < lines_each_; first += packet_size) {
      const LinePacket packet(lines, first, lines_each_);
      const PacketHits hits = packet.first_hits(caster_);
      for (std::size_t l = 0; l < packet.count; ++l) count(hits[l], i, met);
    }
    return met;
  }

  void count(const Hit& hit, std::size_t from, std::vector<Met>& met) const {
    if (hit.left_scene()) return;
    const auto j = hierarchy_.patch_at(hit.triangle, hit.u, hit.v, hit.front);
    // A rounding of rays: patches are plane.
    if (j < 0 || static_cast<std::size_t>(j) == from) return;
    const auto group = grouping_.group_of[static_cast<std::size_t>(j)];
    if (!is_of_group(group)) return;
    const auto known =
        std::find_if(met.begin(), met.end(), [&](const Met& m) { return m.group == group; });
    if (known != met.end())
      ++known->lines;
    else
      met.push_back({group, 1});
  }

  void add(std::size_t i, const std::vector<Met>& met, std::vector<double>& sums) const {
    if (met.empty()) return;
    double* row = sums.data() + static_cast<std::size_t>(grouping_.group_of[i]) * grouping_.groups;
    const double of_line = hierarchy_.area()[i] / static_cast<double>(lines_each_);
    for (const auto& [group, lines] : met) row[group] += of_line * static_cast<double>(lines);
  }

  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const PatchGrouping& grouping_;
  const FormFactorRules& rules_;
  Watch& watch_;
  std::size_t R_, lines_each_;
};

/// Both ends agree on what goes between them; then A_G F_GH becomes F_GH.
void take_factors(Exchanges& exchanges, const std::vector<double>& area) {
  const std::size_t G = area.size();
  parallel_for(exchanges.size(), [&](std::size_t r) {
    auto& F = exchanges[r];
    for (std::size_t g = 0; g < G; ++g) {
      for (std::size_t h = g + 1; h < G; ++h) {
        const double exchanged = (F[g * G + h] + F[h * G + g]) / 2;
        F[g * G + h] = exchanged / area[g];
        F[h * G + g] = exchanged / area[h];
      }
      F[g * G + g] /= area[g];
    }
  });
}

}  // namespace

GroupFactors group_factors(const Mesh& mesh, const Hierarchy& hierarchy, const RayCaster& caster,
                           const PatchGrouping& grouping, const FormFactorRules& rules,
                           Watch& watch) {
  SUNLOAD_EXPECT(grouping.group_of.size() == hierarchy.patch_count(), "a group of every patch");
  SUNLOAD_EXPECT(grouping.groups <= most_factor_groups, "not too many groups");
  GroupFactors made;
  made.groups = grouping.groups;
  made.area = areas_of(hierarchy, grouping);
  if (hierarchy.patch_count() <= most_matrix_patches) {
    const FormFactors of_patches = form_factors(mesh, hierarchy, caster, rules, watch);
    made.rays = of_patches.rays;
    made.has_formulas = true;
    made.realizations = summed(of_patches, hierarchy, grouping);
  } else {
    const ByLines by_lines(hierarchy, caster, grouping, rules, watch);
    made.rays = by_lines.rays();
    made.realizations = by_lines.exchanges();
  }
  take_factors(made.realizations, made.area);
  return made;
}

}  // namespace sunload
