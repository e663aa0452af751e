// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geo/base/check.h"
#include "io/base/name_pattern.h"
#include "io/base/statistics.h"
#include "io/report/compared.h"
#include "io/result/common_area.h"
#include "io/result/mesh_error.h"
#include "io/result/pairing.h"
#include "io/result/patch_groups.h"

namespace sunload {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
// Loads may be stored as float: below its spacing a difference is rounding.
constexpr double rounding_share = std::numeric_limits<float>::epsilon();

using Place = std::map<std::pair<std::string, std::string>, std::size_t>;

/// Groups by kind and name.
Place places(const PatchGroups& groups) {
  Place place;
  for (std::size_t g = 0; g < groups.groups().size(); ++g)
    place[{groups.groups()[g].kind, groups.groups()[g].name}] = g;
  return place;
}

/// What is asked for of both results alike.
struct Asked {
  std::string dataset;
  MoreGroups groups;
};

/// Groups of one result, of some of its area.
struct Part {
  PatchGroups groups;
  std::vector<double> load;        ///< per group, or what is compared in its place
  std::vector<double> mesh_error;  ///< per group, of unlike patches; NaN where it is not known
  Place place;
};

Part part(const ResultReader& result, std::vector<double> area, const Asked& asked,
          const std::vector<double>& unlike) {
  PatchGroups groups(result, std::move(area), asked.groups);
  std::vector<double> reflected(groups.groups().size(), not_known);
  if (has_mesh_error(asked.dataset) && result.has("light_load_reflected")) {
    auto of_patches = result.doubles("light_load_reflected");
    for (std::size_t i = 0; i < of_patches.size(); ++i) of_patches[i] *= unlike[i];
    reflected = groups.means(of_patches.data());
  }
  return {groups, group_means(result, groups, asked.dataset), mesh_errors(std::move(reflected)),
          places(groups)};
}

/// One result: what it has in common with the other, and what it has alone.
struct Side {
  const ResultReader& result;
  Part common, alone;
  std::vector<std::vector<double>> realizations;  ///< of `common`, [group][realization]
};

/// `counted`: 1 or 0 per patch; empty: all.
Side side(const ResultReader& result, const std::vector<double>& common,
          const std::vector<char>& counted, const Asked& asked, const std::vector<double>& unlike) {
  std::vector<double> alone = result.doubles("patch_area");
  for (std::size_t i = 0; i < alone.size(); ++i)
    alone[i] = counted.empty() || counted[i] != 0 ? alone[i] - common[i] : 0;
  Side s{result,
         part(result, common, asked, unlike),
         part(result, std::move(alone), asked, unlike),
         {}};
  s.realizations = group_realizations(result, s.common.groups, realizations_of(asked.dataset));
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

/// Differences of group means that are no larger, either way, are none.
double least_difference(double base_load, double variant_load, double least_percent) {
  const double rounding = rounding_share * std::max(std::abs(base_load), std::abs(variant_load));
  return std::max(rounding, std::abs(base_load) * least_percent / 100);
}

/// Two-sided p-value of a true difference at the rim of what does not matter, which is the largest
/// of all that do not (Hodges & Lehmann 1954, Testing the approximate validity of statistical
/// hypotheses); without a rim that of no difference. For differences beyond it.
template <class Error>
double p_beyond(const ComparisonRow& row, double least_percent, const Error& error) {
  const auto p = [&](double t) { return student_t_two_sided_p(t, error.degrees_of_freedom); };
  const double difference = std::abs(row.difference_kwh_m2);
  if (least_percent == 0) return p(difference / error.se);
  const double rim = std::abs(*row.base_kwh_m2) * least_percent / 100;
  return (p((difference - rim) / error.se) + p((difference + rim) / error.se)) / 2;
}

/// Group b of what the base has in common with the variant, whose group v it is.
ComparisonRow matched_row(const Side& base, std::size_t b, const Side& variant, std::size_t v,
                          Comparison::Errors errors, double least_percent) {
  const auto& group = base.common.groups.groups()[b];
  const double base_load = base.common.load[b], variant_load = variant.common.load[v];
  ComparisonRow row;
  row.kind = group.kind;
  row.name = group.name;
  row.area_m2 = group.area_m2;
  row.base_kwh_m2 = base_load;
  row.variant_kwh_m2 = variant_load;
  row.difference_kwh_m2 = variant_load - base_load;
  row.difference_percent = base_load == 0 ? not_known : row.difference_kwh_m2 / base_load * 100;
  row.unmatched_area_m2 = area_alone(base, group) + area_alone(variant, group);
  row.se_kwh_m2 = row.p_value = row.p_corrected = not_known;
  if (errors == Comparison::Errors::unknown || errors == Comparison::Errors::none) return row;
  const auto error = errors == Comparison::Errors::paired
                         ? paired_error(base.realizations[b], variant.realizations[v])
                         : welch_error(base.realizations[b], variant.realizations[v]);
  row.se_kwh_m2 = error.se;
  const double least = least_difference(base_load, variant_load, least_percent);
  row.p_value = std::abs(row.difference_kwh_m2) <= least ? 1 : p_beyond(row, least_percent, error);
  return row;
}

enum class Present { base, variant };

ComparisonRow lonely_row(const Side& s, std::size_t g, Present where) {
  const auto& group = s.alone.groups.groups()[g];
  ComparisonRow row;
  row.kind = group.kind;
  row.name = group.name;
  row.area_m2 = row.unmatched_area_m2 = group.area_m2;
  (where == Present::base ? row.base_kwh_m2 : row.variant_kwh_m2) = s.alone.load[g];
  row.difference_kwh_m2 = row.difference_percent = not_known;
  row.se_kwh_m2 = row.p_value = row.p_corrected = row.mesh_error_kwh_m2 = not_known;
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
  const CommonArea common = common_area(base, variant, counted);
  const Asked asked{dataset, {true, rules.storey_m}};
  const auto unlike_of_base = unlike_patches(base, variant);
  const Side b = side(base, common.base, counted.base, asked, unlike_of_base),
             v = side(variant, common.variant, counted.variant, asked,
                      unlike_patches(variant, base));
  comparison.base = base.text_attribute("variant");
  comparison.variant = variant.text_attribute("variant");
  comparison.base_realizations = realization_count(base, dataset);
  comparison.variant_realizations = realization_count(variant, dataset);
  comparison.errors = error_kind(b, v, dataset);
  comparison.least_percent = rules.least_percent;
  comparison.notes = notes_on(base, variant, dataset);
  const auto& groups = b.common.groups.groups();
  const auto unlike = b.common.groups.means(unlike_of_base.data());
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (const auto found = v.common.place.find({groups[g].kind, groups[g].name});
        found != v.common.place.end()) {
      comparison.rows.push_back(
          matched_row(b, g, v, found->second, comparison.errors, rules.least_percent));
      if (unlike[g] == 0) continue;
      comparison.have_same_mesh = false;
      comparison.rows.back().mesh_error_kwh_m2 =
          std::hypot(b.common.mesh_error[g], v.common.mesh_error[found->second]);
    }
  for (std::size_t g = 0; g < b.alone.groups.groups().size(); ++g)
    comparison.rows.push_back(lonely_row(b, g, Present::base));
  for (std::size_t g = 0; g < v.alone.groups.groups().size(); ++g)
    comparison.rows.push_back(lonely_row(v, g, Present::variant));
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
  if (!parts.choose_patches()) return;
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
  problems.throw_if_any();
  std::vector<ComparisonRow> rows;
  for (std::size_t i = 0; i < is_kept.size(); ++i)
    if (is_kept[i]) rows.push_back(std::move(comparison.rows[i]));
  comparison.rows = std::move(rows);
}

}  // namespace sunload
