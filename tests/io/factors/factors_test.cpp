// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/factors/factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "geo/base/check.h"
#include "io/plan/variant_mesh.h"
#include "io/result/h5.h"
#include "tests/support/refusal_of.h"
#include "tests/support/study_plan.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

using test::folder_of_test;

/// A street canyon, coarse enough for a matrix of its patches, or not.
std::string canyon(const std::string& edge) {
  return "format: sunload-study-1\n"
         "name: canyon\n"
         "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "period: {days: [2026-03-21], from: \"11:00\", to: \"12:00\", step_min: 60}\n"
         "light: {source: clear_sky}\n"
         "scene: {builtin: {name: canyon}}\n"
         "mesh: {oracle: none, max_edge_m: " +
         edge +
         "}\n"
         "solver: {realizations: 4}\n"
         "output: {folder: results}\n";
}

FactorTable table_of(FactorsBetween between, const std::string& edge = "20") {
  const VariantPlan plan = test::plan_of(canyon(edge));
  Watch watch;
  return form_factor_table(plan, *unrefined_mesh(plan).mesh, between, watch);
}

double row_sum(const FactorTable& table, std::size_t row) {
  double sum = table.elsewhere[row];
  for (std::size_t j = 0; j < table.size(); ++j) sum += table.factor[row * table.size() + j];
  return sum;
}

std::vector<std::vector<std::string>> cells_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST(FactorTable, AddsUpToOneInEveryRowAndIsReciprocal) {
  for (const auto between : {FactorsBetween::patches, FactorsBetween::facades,
                             FactorsBetween::objects, FactorsBetween::surfaces}) {
    const FactorTable table = table_of(between);
    ASSERT_GT(table.size(), 1u) << factor_word(between);
    for (std::size_t i = 0; i < table.size(); ++i) {
      EXPECT_NEAR(row_sum(table, i), 1, 1e-12);
      // The canyon is open.
      EXPECT_GT(table.elsewhere[i], 0) << table.name[i];
      EXPECT_LE(table.elsewhere[i], 1);
      for (std::size_t j = 0; j < table.size(); ++j)
        EXPECT_NEAR(table.area_m2[i] * table.factor[i * table.size() + j],
                    table.area_m2[j] * table.factor[j * table.size() + i],
                    1e-6 * table.area_m2[i]);  // factors of pairs are floats
    }
  }
}

TEST(FactorTable, OfGroupsIsTheSumOfItsPatches) {
  const FactorTable patches = table_of(FactorsBetween::patches),
                    objects = table_of(FactorsBetween::objects);
  const std::size_t n = patches.size();
  for (std::size_t g = 0; g < objects.size(); ++g)
    for (std::size_t h = 0; h < objects.size(); ++h) {
      double exchanged = 0;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          if (patches.patch[i].object == objects.name[g] &&
              patches.patch[j].object == objects.name[h])
            exchanged += patches.area_m2[i] * patches.factor[i * n + j];
      EXPECT_NEAR(objects.factor[g * objects.size() + h], exchanged / objects.area_m2[g], 1e-6);
    }
}

TEST(FactorTable, NamesWhatIsTooManyAndWhatToChoose) {
  const std::string refusal = test::refusal_of([] { table_of(FactorsBetween::patches, "0.8"); });
  EXPECT_NE(refusal.find("2000 at most"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("write --of facade, object or surface"), std::string::npos) << refusal;
  EXPECT_NE(test::refusal_of([] { factors_between("sensor"); }).find("patch, facade, object"),
            std::string::npos);
  EXPECT_NE(test::refusal_of([] { expect_factor_file("f.vtk"); }).find(".h5 or .csv"),
            std::string::npos);
}

TEST(FactorTable, IsWrittenAsCsv) {
  const FactorTable table = table_of(FactorsBetween::objects);
  const std::string path = folder_of_test() / "factors.csv";
  write_form_factors(table, path);
  const auto rows = cells_of(test::bytes_of(path));
  ASSERT_EQ(rows.size(), table.size() + 1);
  EXPECT_EQ(rows[0][0], "name");
  EXPECT_EQ(rows[0][2], table.name[0]);
  EXPECT_EQ(rows[0].back(), "elsewhere");
  for (std::size_t i = 0; i < table.size(); ++i) {
    ASSERT_EQ(rows[i + 1].size(), table.size() + 3);
    EXPECT_EQ(rows[i + 1][0], table.name[i]);
    double sum = 0;
    for (std::size_t k = 2; k < rows[i + 1].size(); ++k) sum += std::stod(rows[i + 1][k]);
    EXPECT_NEAR(sum, 1, 1e-8 * static_cast<double>(table.size()));  // nine digits
  }
  const std::string of_patches = folder_of_test() / "patches.csv";
  write_form_factors(table_of(FactorsBetween::patches), of_patches);
  EXPECT_EQ(test::bytes_of(of_patches).rfind("index,object,facade,surface,side,area_m2,0,1,", 0),
            0u);
}

TEST(FactorTable, IsWrittenAsHdf5) {
  for (const auto between : {FactorsBetween::patches, FactorsBetween::objects}) {
    const FactorTable table = table_of(between);
    const std::string path = folder_of_test() / (factor_word(between) + ".h5");
    write_form_factors(table, path);
    const h5::File file = h5::File::open(path);
    EXPECT_EQ(file.text("sunload_format"), "sunload-form-factors-1");
    EXPECT_EQ(file.dataset("form_factor").doubles(), table.factor);
    EXPECT_EQ(file.dataset("form_factor").shape(),
              (std::vector<std::size_t>{table.size(), table.size()}));
    EXPECT_EQ(file.dataset("elsewhere").doubles(), table.elsewhere);
    EXPECT_EQ(file.dataset("row_area").doubles(), table.area_m2);
    EXPECT_EQ(file.dataset("row_area").text("units"), "m2");
    if (between == FactorsBetween::objects)
      EXPECT_EQ(file.dataset("column").strings(), table.name);
    else
      EXPECT_EQ(file.dataset("row_object").strings().front(), table.patch.front().object);
  }
}

}  // namespace
}  // namespace sunload
