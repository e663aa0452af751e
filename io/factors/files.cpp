// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Form factors as HDF5 and as CSV.
#include <cerrno>
#include <fstream>
#include <functional>
#include <iostream>

#include "geo/base/check.h"
#include "io/base/file_aside.h"
#include "io/base/file_writing.h"
#include "io/base/text.h"
#include "io/factors/factors.h"
#include "io/result/netcdf_file.h"
#include "io/result/schema.h"

namespace sunload {

namespace {

constexpr const char* factor_format = "sunload-form-factors-1";

bool is_hdf5(const std::string& path) { return path.ends_with(".h5"); }

void write_csv(const FactorTable& table, std::ostream& out) {
  const bool is_of_patches = table.between == FactorsBetween::patches;
  out << (is_of_patches ? "index,object,facade,surface,side,area_m2" : "name,area_m2");
  for (const auto& name : table.name) out << "," << csv_text(name);
  out << ",elsewhere\n";
  for (std::size_t row = 0; row < table.size(); ++row) {
    out << csv_text(table.name[row]);
    if (is_of_patches) {
      const auto& patch = table.patch[row];
      out << "," << csv_text(patch.object) << "," << csv_text(patch.facade) << "," << patch.surface
          << "," << patch.side;
    }
    out << "," << csv_number(table.area_m2[row]);
    for (std::size_t column = 0; column < table.size(); ++column)
      out << "," << csv_number(table.factor[row * table.size() + column]);
    out << "," << csv_number(table.elsewhere[row]) << "\n";
  }
}

template <class Value>
std::vector<Value> of_patches(const FactorTable& table,
                              const std::function<Value(const FactorTable::PatchFacts&)>& get) {
  std::vector<Value> values;
  values.reserve(table.patch.size());
  for (const auto& patch : table.patch) values.push_back(get(patch));
  return values;
}

std::vector<double> places(const FactorTable& table, Vec3 FactorTable::PatchFacts::*place) {
  std::vector<double> values;
  for (const auto& patch : table.patch) {
    const Vec3& at = patch.*place;
    values.insert(values.end(), {at.x, at.y, at.z});
  }
  return values;
}

/// What rows are: names, or patches with what they are of.
void put_rows(NetcdfFile& file, const FactorTable& table) {
  const std::string word = factor_word(table.between);
  if (table.between != FactorsBetween::patches) {
    file.labels("row", word + " that sends", table.name);
    file.labels("column", word + " that receives", table.name);
    return;
  }
  using Facts = FactorTable::PatchFacts;
  constexpr std::size_t axes = 3;
  const std::vector<std::string> rows{"row"};
  file.numbers("row", "patch that sends, as the result numbers it", table.size());
  file.numbers("column", "patch that receives, as the result numbers it", table.size());
  file.dimension("xyz", axes);
  const auto put_names = [&](const char* name, const char* what, std::string Facts::*words) {
    file.put(name, rows, h5::Type::text, "", what,
             of_patches<std::string>(table, [&](const Facts& p) { return p.*words; }));
  };
  put_names("row_object", "object of the patch", &Facts::object);
  put_names("row_facade", "facade of the patch, or nothing", &Facts::facade);
  put_names("row_surface", "kind of surface of the patch", &Facts::surface);
  file.put("row_side", rows, h5::Type::int32, "", "1: the back of a two-sided surface",
           of_patches<std::int32_t>(table, [](const Facts& p) { return p.side; }));
  file.put("row_centroid", {"row", "xyz"}, h5::Type::float64, "m", "centroid in the scene frame",
           places(table, &Facts::centroid));
  file.put("row_normal", {"row", "xyz"}, h5::Type::float64, "1", "unit normal of the front",
           places(table, &Facts::normal));
}

void put_factors(NetcdfFile& file, const FactorTable& table) {
  const std::vector<std::string> rows{"row"}, matrix{"row", "column"};
  const auto put = [&](const char* name, const std::vector<std::string>& dims, const char* units,
                       const char* what, const std::vector<double>& values) {
    file.put(name, dims, h5::Type::float64, units, what, values);
  };
  put("row_area", rows, "m2", "area", table.area_m2);
  put("form_factor", matrix, "1", "share of what the row sends that arrives straight at the column",
      table.factor);
  put("form_factor_se", matrix, "1", "standard error of form_factor", table.factor_se);
  put("elsewhere", rows, "1",
      "share that arrives at no column: 1 minus the sum of the row's form factors",
      table.elsewhere);
  put("elsewhere_se", rows, "1", "standard error of elsewhere", table.elsewhere_se);
}

void put_attributes(h5::File& file, const FactorTable& table) {
  file.set("title", "Form factors of " + table.study + ", variant " + table.variant);
  file.set("Conventions", std::string(result_conventions));
  file.set("sunload_format", factor_format);
  file.set("study", table.study);
  file.set("variant", table.variant);
  file.set("study_sha256", table.content_hash);
  file.set("between", factor_word(table.between));
  file.set("method", table.has_formulas
                         ? "contour integrals of pairs in full view, lines of all others"
                         : "lines");
  file.set("patches", static_cast<std::int64_t>(table.patches));
  file.set("realizations", static_cast<std::int64_t>(table.realizations));
  file.set("rays", static_cast<std::int64_t>(table.rays));
  file.set("origin", {table.origin.x, table.origin.y, table.origin.z}, h5::Type::float64);
}

void write_hdf5(const FactorTable& table, const std::string& path) {
  write_netcdf(path, [&](NetcdfFile& file) {
    put_rows(file, table);
    put_factors(file, table);
    put_attributes(file.file(), table);
  });
}

}  // namespace

void expect_factor_file(const std::string& path) {
  if (path.empty() || is_hdf5(path) || path.ends_with(".csv")) return;
  throw InputError({path}, "form factors are written as HDF5 or as CSV",
                   "the ending of the name says which", "let it end in .h5 or .csv");
}

void write_form_factors(const FactorTable& table, const std::string& path) {
  if (is_hdf5(path)) return write_hdf5(table, path);
  if (path.empty()) return write_csv(table, std::cout);
  FileAside file(path);
  errno = 0;
  std::ofstream stream(file.aside(), std::ios::binary);
  write_csv(table, stream);
  stream.close();
  if (!stream) throw_cannot_write(path, errno);
  file.publish();
}

}  // namespace sunload
