// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "io/base/light_quantity.h"
#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/report/compare.h"
#include "io/result/common_area.h"
#include "io/result/netcdf_file.h"
#include "io/result/schema.h"
#include "io/result/shown_quantity.h"

namespace sunload {
namespace {

/// Patches are the same where middle, normal and area are, to the tenth of a millimetre.
using PatchKey = std::array<std::int64_t, 7>;

std::vector<PatchKey> patch_keys(const ResultReader& result) {
  constexpr double steps_per_m = 1e4;
  const auto centroid = result.doubles("patch_centroid"), normal = result.doubles("patch_normal"),
             area = result.doubles("patch_area");
  const Vec3 origin = result.origin();
  const std::array<double, 3> shift{origin.x, origin.y, origin.z};
  std::vector<PatchKey> keys(area.size());
  for (std::size_t p = 0; p < keys.size(); ++p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = centroid[3 * p + k] + shift[k];
      keys[p][k] = std::llround(at * steps_per_m);
      keys[p][3 + k] = std::llround(normal[3 * p + k] * steps_per_m);
    }
    keys[p][6] = std::llround(area[p] * steps_per_m);
  }
  return keys;
}

/// For every patch of the base that of the variant in its place, -1: none.
std::vector<std::int32_t> matched_patches(const ResultReader& base, const ResultReader& variant) {
  const auto own = patch_keys(base), theirs = patch_keys(variant);
  std::vector<std::int32_t> match(own.size(), -1);
  std::map<PatchKey, std::int32_t> places;
  if (own != theirs)
    for (std::size_t q = 0; q < theirs.size(); ++q)
      places.emplace(theirs[q], static_cast<std::int32_t>(q));
  for (std::size_t p = 0; p < own.size(); ++p) {
    if (places.empty())
      match[p] = static_cast<std::int32_t>(p);
    else if (const auto found = places.find(own[p]); found != places.end())
      match[p] = found->second;
  }
  return match;
}

std::vector<std::vector<double>> realizations(const ResultReader& result,
                                              const std::string& total) {
  std::vector<std::vector<double>> rows;
  const std::string dataset = realizations_of(total);
  if (dataset.empty() || !result.has(dataset)) return rows;
  for (std::size_t r = 0; r < result.shape(dataset).front(); ++r)
    rows.push_back(result.row(dataset, r));
  return rows;
}

std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t place) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(row[place]);
  return values;
}

/// A column of the groups' table.
template <class Get>
std::vector<double> numbers_of(const std::vector<ComparisonRow>& rows, const Get& get) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(get(row));
  return values;
}

void put_groups(NetcdfFile& file, const Comparison& comparison) {
  const auto& rows = comparison.rows;
  const std::vector<std::string> dims{"group"};
  std::vector<std::string> kinds, names;
  std::vector<std::int32_t> significant;
  for (const auto& row : rows) {
    kinds.push_back(row.kind);
    names.push_back(row.name);
    significant.push_back(row.significant ? 1 : 0);
  }
  file.dimension("group", rows.size());
  file.put("group_kind", dims, h5::Type::text, "",
           "whole, surface, object, facade, selection, orientation, storey or sensor", kinds);
  file.put("group_name", dims, h5::Type::text, "", "name of the group", names);
  const auto put = [&](const std::string& name, const std::string& units, const std::string& what,
                       const auto& get) {
    file.put(name, dims, h5::Type::float64, units, what, numbers_of(rows, get));
  };
  const auto& load = comparison.units;
  const std::string words = spaced(comparison.dataset);
  put("group_area", "m2", "area that is compared; of a group in one result alone, its area there",
      [](const ComparisonRow& r) { return r.area_m2; });
  put("group_base_" + comparison.dataset, load, "area-weighted mean " + words + " of the base",
      [](const ComparisonRow& r) { return r.base_kwh_m2.value_or(not_known); });
  put("group_variant_" + comparison.dataset, load,
      "area-weighted mean " + words + " of the variant",
      [](const ComparisonRow& r) { return r.variant_kwh_m2.value_or(not_known); });
  put("group_difference", load, "variant minus base",
      [](const ComparisonRow& r) { return r.difference_kwh_m2; });
  put("group_difference_percent", "percent", "difference as a share of the base",
      [](const ComparisonRow& r) { return r.difference_percent; });
  put("group_difference_se", load, "standard error of the difference",
      [](const ComparisonRow& r) { return r.se_kwh_m2; });
  put("group_degrees_of_freedom", "1", "of the standard error of the difference, for Student's t",
      [](const ComparisonRow& r) { return r.degrees_of_freedom; });
  put("group_mesh_error", load,
      "what unlike meshes put the difference off, beside its standard error",
      [](const ComparisonRow& r) { return r.mesh_error_kwh_m2; });
  put("group_p_value", "1", "two-sided p-value of no difference",
      [](const ComparisonRow& r) { return r.p_value; });
  put("group_p_corrected", "1", "p-value corrected for the number of groups of the kind (Holm)",
      [](const ComparisonRow& r) { return r.p_corrected; });
  file.put("group_significant", dims, h5::Type::int8, "", "1: the corrected p-value is below 0.05",
           significant);
  put("group_unmatched_area", "m2", "area without a counterpart in the other result",
      [](const ComparisonRow& r) { return r.unmatched_area_m2; });
}

/// Rows of the facades of the base, in its order.
void put_facades(NetcdfFile& file, const Comparison& comparison, const ResultReader& base) {
  const auto names = base.strings("facade_name");
  if (names.empty()) return;
  std::map<std::string, const ComparisonRow*> rows;
  for (const auto& row : comparison.rows)
    if (row.kind == "facade" && row.base_kwh_m2 && row.variant_kwh_m2) rows[row.name] = &row;
  const auto values = [&](const auto& get) {
    std::vector<double> list;
    list.reserve(names.size());
    for (const auto& name : names)
      list.push_back(rows.contains(name) ? get(*rows[name]) : not_known);
    return list;
  };
  const std::vector<std::string> dims{"facade"};
  file.labels("facade", std::string(find_result_variable("facade")->long_name), names);
  file.put("facade_name", dims, h5::Type::text, "", "name of the facade", names);
  const std::string difference = "facade_" + difference_dataset(comparison.dataset);
  file.put(difference, dims, h5::Type::float64, comparison.units,
           "variant minus base, area-weighted means",
           values([](const ComparisonRow& r) { return r.difference_kwh_m2; }));
  file.put(difference + "_se", dims, h5::Type::float64, comparison.units,
           "standard error of the difference",
           values([](const ComparisonRow& r) { return r.se_kwh_m2; }));
}

void put_patches(NetcdfFile& file, const Comparison& comparison, const ResultReader& base,
                 const ResultReader& variant) {
  const auto match = matched_patches(base, variant);
  const auto overlaps = patch_overlaps(base, variant);
  const std::string& dataset = comparison.dataset;
  const auto own = base.doubles(dataset);
  const auto of_variant = means_on_base(overlaps, variant.doubles(dataset));
  const auto own_rows = realizations(base, dataset);
  auto their_rows = realizations(variant, dataset);
  for (auto& row : their_rows) row = means_on_base(overlaps, row);
  std::vector<double> difference(own.size(), not_known), se(own.size(), not_known);
  for (std::size_t p = 0; p < own.size(); ++p) {
    if (std::isnan(of_variant[p])) continue;
    difference[p] = of_variant[p] - own[p];
    if (!comparison.has_errors()) continue;
    const auto a = column(own_rows, p), b = column(their_rows, p);
    se[p] =
        (comparison.errors == Comparison::Errors::paired ? paired_error(a, b) : welch_error(a, b))
            .se;
  }
  const std::vector<std::string> dims{"patch"};
  file.put("variant_patch", dims, h5::Type::int32, "",
           "index of the same patch in the variant, -1: none", match);
  const auto put = [&](const std::string& name, const std::string& what,
                       const std::vector<double>& values) {
    put_of_patches(file, name, comparison.units, what, values);
  };
  const std::string words = spaced(dataset), name = difference_dataset(dataset);
  put("base_" + dataset, words + " of the base", own);
  put("variant_" + dataset, words + " of the variant", of_variant);
  put(name, "variant minus base", difference);
  put(name + "_se", "standard error of the difference", se);
}

void put_attributes(h5::File& file, const Comparison& comparison, const ResultReader& base,
                    const ResultReader& variant) {
  constexpr std::array errors{"paired", "independent", "unknown", "none"};
  std::string notes;
  for (const auto& note : comparison.notes) notes += note + "\n";
  file.set("title", capitalized(spaced(comparison.dataset)) + ": variant " + comparison.variant +
                        " minus base " + comparison.base);
  file.set("Conventions", std::string(result_conventions));
  file.set("sunload_format", std::string(comparison_format));
  file.set("base", comparison.base);
  file.set("variant", comparison.variant);
  file.set("base_study_sha256", base.text_attribute("study_sha256"));
  file.set("variant_study_sha256", variant.text_attribute("study_sha256"));
  file.set("errors", errors[static_cast<std::size_t>(comparison.errors)]);
  file.set("base_realizations", static_cast<std::int64_t>(comparison.base_realizations));
  file.set("variant_realizations", static_cast<std::int64_t>(comparison.variant_realizations));
  if (comparison.least_percent > 0)
    file.set("least_percent", comparison.least_percent, h5::Type::float64);
  if (comparison.quantity == Quantity::illuminance) file.set("quantity", "illuminance");
  if (!comparison.is_of_light_load()) file.set("compared", comparison.dataset);
  put_site(file, base);
  if (!notes.empty()) file.set("notes", notes);
}

}  // namespace

void write_comparison_hdf5(const Comparison& comparison, const ResultReader& base,
                           const ResultReader& variant, const std::string& path) {
  write_netcdf(path, [&](NetcdfFile& file) {
    put_groups(file, comparison);
    put_facades(file, comparison, base);
    put_mesh(file, base);
    put_patches(file, comparison, base, variant);
    put_attributes(file.file(), comparison, base, variant);
  });
}

}  // namespace sunload
