// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geo/base/check.h"
#include "io/base/statistics.h"
#include "io/result/patch_groups.h"

namespace sunload {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
// Loads may be stored as float: below its spacing a difference is rounding.
constexpr double rounding_share = std::numeric_limits<float>::epsilon();

/// One result, divided into groups.
struct Side {
  const ResultReader& result;
  PatchGroups groups;
  std::vector<double> load;                       ///< per group
  std::vector<std::vector<double>> realizations;  ///< [group][realization]
  std::vector<std::string> object_name;
  std::map<std::pair<std::string, std::string>, std::size_t> place;  ///< of (kind, name)
};

Side side(const ResultReader& result) {
  if (!result.has("light_load"))
    throw InputError({result.path()}, "no dataset light_load", "there is nothing to compare",
                     "compare finished results of sunload run");
  PatchGroups groups(result);
  Side s{result,
         groups,
         group_means(result, groups, "light_load"),
         group_realizations(result, groups),
         result.strings("object_name"),
         {}};
  for (std::size_t g = 0; g < groups.groups().size(); ++g)
    s.place[{groups.groups()[g].kind, groups.groups()[g].name}] = g;
  return s;
}

Comparison::Errors error_kind(const Side& base, const Side& variant) {
  const auto base_count = base.realizations.front().size();
  const auto variant_count = variant.realizations.front().size();
  if (base_count < 2 || variant_count < 2) return Comparison::Errors::unknown;
  const auto pairing = base.result.text_attribute("pairing_id");
  const bool paired = !pairing.empty() && base_count == variant_count &&
                      pairing == variant.result.text_attribute("pairing_id");
  return paired ? Comparison::Errors::paired : Comparison::Errors::independent;
}

std::map<std::string, double> area_by_object(const Side& s, const PatchGroup& group) {
  std::map<std::string, double> areas;
  for (const auto& [object, area] : group.object_area_m2)
    areas[s.object_name.at(static_cast<std::size_t>(object))] += area;
  return areas;
}

double unmatched_area(const Side& base, const PatchGroup& base_group, const Side& variant,
                      const PatchGroup& variant_group) {
  auto surplus = area_by_object(base, base_group);
  for (const auto& [object, area] : area_by_object(variant, variant_group)) surplus[object] -= area;
  double sum = 0;
  for (const auto& [object, area] : surplus) sum += std::abs(area);
  // Areas of equal walls cut differently agree to rounding only.
  return sum <= rounding_share * (base_group.area_m2 + variant_group.area_m2) ? 0 : sum;
}

ComparisonRow matched_row(const Side& base, std::size_t b, const Side& variant, std::size_t v,
                          Comparison::Errors errors) {
  const auto& group = base.groups.groups()[b];
  ComparisonRow row;
  row.kind = group.kind;
  row.name = group.name;
  row.area_m2 = group.area_m2;
  row.base_kwh_m2 = base.load[b];
  row.variant_kwh_m2 = variant.load[v];
  row.difference_kwh_m2 = variant.load[v] - base.load[b];
  row.difference_percent =
      base.load[b] == 0 ? not_known : row.difference_kwh_m2 / base.load[b] * 100;
  row.unmatched_area_m2 = unmatched_area(base, group, variant, variant.groups.groups()[v]);
  row.se_kwh_m2 = row.p_value = row.p_corrected = not_known;
  if (errors == Comparison::Errors::unknown) return row;
  const auto error = errors == Comparison::Errors::paired
                         ? paired_error(base.realizations[b], variant.realizations[v])
                         : welch_error(base.realizations[b], variant.realizations[v]);
  row.se_kwh_m2 = error.se;
  const double rounding =
      rounding_share * std::max(std::abs(base.load[b]), std::abs(variant.load[v]));
  row.p_value =
      std::abs(row.difference_kwh_m2) <= rounding
          ? 1
          : student_t_two_sided_p(row.difference_kwh_m2 / error.se, error.degrees_of_freedom);
  return row;
}

enum class Present { base, variant };

ComparisonRow lonely_row(const Side& s, std::size_t g, Present where) {
  const auto& group = s.groups.groups()[g];
  ComparisonRow row;
  row.kind = group.kind;
  row.name = group.name;
  row.area_m2 = row.unmatched_area_m2 = group.area_m2;
  (where == Present::base ? row.base_kwh_m2 : row.variant_kwh_m2) = s.load[g];
  row.difference_kwh_m2 = row.difference_percent = not_known;
  row.se_kwh_m2 = row.p_value = row.p_corrected = not_known;
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

std::vector<std::string> notes_on(const Side& base, const Side& variant) {
  std::vector<std::string> notes;
  if (base.result.doubles("time_bounds") != variant.result.doubles("time_bounds"))
    notes.emplace_back("the two results cover different intervals of time");
  const auto version = [](const Side& s) { return s.result.text_attribute("source"); };
  if (version(base) != version(variant))
    notes.push_back("the two results come from different versions: " + version(base) + " and " +
                    version(variant));
  return notes;
}

}  // namespace

Comparison compare_results(const ResultReader& base, const ResultReader& variant) {
  const Side b = side(base), v = side(variant);
  Comparison comparison;
  comparison.units = base.units("light_load");
  comparison.quantity = base.quantity();
  if (comparison.units != variant.units("light_load"))
    throw InputError({variant.path()}, "light_load is in " + variant.units("light_load"),
                     "the base has it in " + comparison.units,
                     "compare results of one light.quantity");
  comparison.base = base.text_attribute("variant");
  comparison.variant = variant.text_attribute("variant");
  comparison.base_realizations = b.realizations.front().size();
  comparison.variant_realizations = v.realizations.front().size();
  comparison.errors = error_kind(b, v);
  comparison.notes = notes_on(b, v);
  for (std::size_t g = 0; g < b.groups.groups().size(); ++g) {
    const auto& group = b.groups.groups()[g];
    const auto found = v.place.find({group.kind, group.name});
    comparison.rows.push_back(found == v.place.end()
                                  ? lonely_row(b, g, Present::base)
                                  : matched_row(b, g, v, found->second, comparison.errors));
  }
  for (std::size_t g = 0; g < v.groups.groups().size(); ++g) {
    const auto& group = v.groups.groups()[g];
    if (!b.place.count({group.kind, group.name}))
      comparison.rows.push_back(lonely_row(v, g, Present::variant));
  }
  correct_within_kinds(comparison.rows);
  return comparison;
}

}  // namespace sunload
