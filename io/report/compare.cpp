// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/compare.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "io/base/name_pattern.h"
#include "io/base/statistics.h"
#include "io/report/common_groups.h"
#include "io/report/compared.h"
#include "io/report/compared_sensors.h"
#include "io/report/difference.h"
#include "io/result/common_area.h"
#include "io/result/mesh_error.h"
#include "io/result/pairing.h"
#include "io/result/patch_groups.h"

namespace sunload {
namespace {

using Place = std::map<std::pair<std::string, std::string>, std::size_t>;

/// Groups by kind and name.
Place places(const PatchGroups& groups) {
  Place place;
  for (std::size_t g = 0; g < groups.groups().size(); ++g)
    place[{groups.groups()[g].kind, groups.groups()[g].name}] = g;
  return place;
}

/// Groups of one result, of some of its area.
struct Part {
  PatchGroups groups;
  std::vector<double> load;        ///< per group, or what is compared in its place
  std::vector<double> mesh_error;  ///< per group, as far as meshes are unlike; NaN: not known
  Place place;
};

/// One of the two results, and how its patches are divided.
struct Divided {
  const ResultReader& result;
  std::vector<PatchDivision> divisions;
  std::vector<double> unlike;  ///< per patch: share of its reflected light that unlike meshes make
};

bool are_alike(const Divided& of) {
  return std::all_of(of.unlike.begin(), of.unlike.end(), [](double share) { return share == 0; });
}

Part part(const Divided& of, const std::vector<PatchMembers>& members, const std::string& dataset) {
  PatchGroups groups(of.unlike.size(), members);
  std::vector<double> reflected(groups.groups().size(), are_alike(of) ? 0 : not_known);
  if (has_mesh_error(dataset) && of.result.has("light_load_reflected")) {
    auto of_patches = of.result.doubles("light_load_reflected");
    for (std::size_t i = 0; i < of_patches.size(); ++i) of_patches[i] *= of.unlike[i];
    reflected = groups.means(of_patches.data());
  }
  return {groups, group_means(of.result, groups, dataset), mesh_errors(std::move(reflected)),
          places(groups)};
}

/// One result: what it has in common with the other, and what it has alone.
struct Side {
  const ResultReader& result;
  Part common, alone;
  std::vector<std::vector<double>> realizations;  ///< of `common`, [group][realization]
};

/// What of a division is not in common; `counted`: 1 or 0 per patch; empty: all. Of a patch that is
/// divided, parts add up to it but for rounding.
PatchMembers alone(const PatchDivision& division, const PatchMembers& common,
                   const std::vector<char>& counted, std::vector<double> area) {
  for (std::size_t i = 0; i < area.size(); ++i)
    if (!counted.empty() && counted[i] == 0) area[i] = 0;
  constexpr double rounding = 1e-9;  // of a patch
  std::vector<double> left = area;
  for (const PatchMember& member : common.members) left[member.patch] -= member.area_m2;
  for (std::size_t i = 0; i < area.size(); ++i)
    area[i] = left[i] > rounding * area[i] ? left[i] : 0;
  return members_of(division, area);
}

/// `common`: of each of its divisions.
Side side(const Divided& of, const std::vector<PatchMembers>& common,
          const std::vector<char>& counted, const std::string& dataset) {
  const auto area = of.result.doubles("patch_area");
  std::vector<PatchMembers> others;
  for (std::size_t d = 0; d < common.size(); ++d)
    others.push_back(alone(of.divisions[d], common[d], counted, area));
  Side s{of.result, part(of, common, dataset), part(of, others, dataset), {}};
  s.realizations = group_realizations(of.result, s.common.groups, realizations_of(dataset));
  return s;
}

/// Realizations that a result keeps of what is compared.
std::size_t realization_count(const ResultReader& result, const std::string& dataset) {
  const std::string rows = realizations_of(dataset);
  return !rows.empty() && result.has(rows) ? result.shape(rows).front() : 0;
}

Comparison::Errors error_kind(const Side& base, const Side& variant, const std::string& dataset) {
  if (realizations_of(dataset).empty()) return Comparison::Errors::none;
  const auto base_count = realization_count(base.result, dataset);
  const auto variant_count = realization_count(variant.result, dataset);
  if (base_count < 2 || variant_count < 2) return Comparison::Errors::unknown;
  const bool paired = base_count == variant_count && are_pairs(base.result, variant.result);
  return paired ? Comparison::Errors::paired : Comparison::Errors::independent;
}

/// Area of a group that one result has alone.
double area_alone(const Side& s, const PatchGroup& group) {
  const auto found = s.alone.place.find({group.kind, group.name});
  return found == s.alone.place.end() ? 0 : s.alone.groups.groups()[found->second].area_m2;
}

/// Group b of what the base has in common with the variant, whose group v it is.
ComparisonRow matched_row(const Side& base, std::size_t b, const Side& variant, std::size_t v,
                          const Comparison& comparison) {
  const auto& group = base.common.groups.groups()[b];
  ComparisonRow row;
  row.kind = group.kind;
  row.name = group.name;
  row.area_m2 = group.area_m2;
  row.base_kwh_m2 = base.common.load[b];
  row.variant_kwh_m2 = variant.common.load[v];
  row.unmatched_area_m2 = area_alone(base, group) + area_alone(variant, group);
  row.mesh_error_kwh_m2 = std::hypot(base.common.mesh_error[b], variant.common.mesh_error[v]);
  tell_difference(row,
                  comparison.has_errors()
                      ? std::optional(TwoSamples{base.realizations[b], variant.realizations[v],
                                                 comparison.errors})
                      : std::nullopt,
                  comparison.least_percent);
  return row;
}

enum class Present { base, variant };

ComparisonRow lonely_row(const Side& s, std::size_t g, Present where) {
  const auto& group = s.alone.groups.groups()[g];
  ComparisonRow row = row_without_difference(group.kind, group.name);
  row.area_m2 = row.unmatched_area_m2 = group.area_m2;
  (where == Present::base ? row.base_kwh_m2 : row.variant_kwh_m2) = s.alone.load[g];
  return row;
}

void correct_within_kinds(std::vector<ComparisonRow>& rows) {
  std::map<std::string, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < rows.size(); ++i) kinds[rows[i].kind].push_back(i);
  for (const auto& [kind, members] : kinds) {
    std::vector<double> p_values;
    for (const auto i : members) p_values.push_back(rows[i].p_value);
    const auto corrected = holm_corrected(p_values);
    for (std::size_t k = 0; k < members.size(); ++k) {
      rows[members[k]].p_corrected = corrected[k];
      rows[members[k]].significant = corrected[k] < significance_level;
    }
  }
}

}  // namespace

Comparison compare_results(const ResultReader& base, const ResultReader& variant,
                           const CompareRules& rules) {
  SUNLOAD_EXPECT(rules.least_percent >= 0, "a share of the base");
  const std::string& dataset = rules.dataset;
  expect_comparable(base, variant, dataset);
  Comparison comparison;
  comparison.dataset = dataset;
  comparison.units = base.units(dataset);
  comparison.quantity = base.quantity();
  const CountedPatches counted = counted_patches(base, variant, dataset);
  const MoreGroups more{true, rules.storey_m};
  const Divided of_base{base, patch_divisions(base, more), unlike_reflections(base, variant)},
      of_variant{variant, patch_divisions(variant, more), unlike_reflections(variant, base)};
  const PatchOverlaps overlaps = patch_overlaps(base, variant);
  const CommonGroups common =
      common_groups(overlaps, counted, of_base.divisions, of_variant.divisions);
  const Side b = side(of_base, common.base, counted.base, dataset),
             v = side(of_variant, common.variant, counted.variant, dataset);
  comparison.base = base.text_attribute("variant");
  comparison.variant = variant.text_attribute("variant");
  comparison.base_realizations = realization_count(base, dataset);
  comparison.variant_realizations = realization_count(variant, dataset);
  comparison.errors = error_kind(b, v, dataset);
  comparison.least_percent = rules.least_percent;
  comparison.notes = notes_on(base, variant, dataset);
  comparison.have_same_mesh = are_alike(of_base) && are_alike(of_variant);
  const auto& groups = b.common.groups.groups();
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (const auto found = v.common.place.find({groups[g].kind, groups[g].name});
        found != v.common.place.end())
      comparison.rows.push_back(matched_row(b, g, v, found->second, comparison));
  for (std::size_t g = 0; g < b.alone.groups.groups().size(); ++g)
    comparison.rows.push_back(lonely_row(b, g, Present::base));
  for (std::size_t g = 0; g < v.alone.groups.groups().size(); ++g)
    comparison.rows.push_back(lonely_row(v, g, Present::variant));
  for (ComparisonRow& row : compared_sensors(base, variant, comparison))
    comparison.rows.push_back(std::move(row));
  correct_within_kinds(comparison.rows);
  return comparison;
}

ChangeCounts change_counts(const Comparison& comparison, const std::string& kind) {
  const auto changes = [&](const ComparisonRow& row) {
    if (comparison.errors != Comparison::Errors::none) return row.significant;
    return std::abs(row.difference_kwh_m2) >
           least_difference(*row.base_kwh_m2, *row.variant_kwh_m2, comparison.least_percent);
  };
  ChangeCounts counts;
  for (const auto& row : comparison.rows)
    if (row.kind == kind && row.base_kwh_m2 && row.variant_kwh_m2)
      ++(!changes(row) ? counts.others : row.difference_kwh_m2 > 0 ? counts.gain : counts.lose);
  return counts;
}

void keep_named(Comparison& comparison, const NamedParts& parts, const std::string& path) {
  if (parts.empty()) return;
  std::vector<char> is_kept(comparison.rows.size(), 0);
  Problems problems;
  const auto keep = [&](const std::string& kind, const std::vector<std::string>& patterns) {
    if (patterns.empty()) return;
    std::vector<std::size_t> rows;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
      if (comparison.rows[i].kind != kind) continue;
      rows.push_back(i);
      names.push_back(comparison.rows[i].name);
    }
    try {
      for (const auto k : matching_names(patterns, names, kind, path)) is_kept[rows[k]] = 1;
    } catch (const InputError& error) {
      problems.add(error);
    }
  };
  keep("facade", parts.facades);
  keep("object", parts.objects);
  keep("selection", parts.selections);
  const bool has_sensors =
      std::ranges::any_of(comparison.rows, [](const auto& row) { return row.kind == "sensor"; });
  if (!parts.sensors.empty() && !has_sensors)
    problems.add({path}, "no sensors to compare",
                 "the results have none, or no " + comparison.dataset + " of them",
                 "compare light_load, sun_hours or sky_view_factor of studies with sensors");
  else
    keep("sensor", parts.sensors);
  problems.throw_if_any();
  std::vector<ComparisonRow> rows;
  for (std::size_t i = 0; i < is_kept.size(); ++i)
    if (is_kept[i]) rows.push_back(std::move(comparison.rows[i]));
  comparison.rows = std::move(rows);
}

}  // namespace sunload
