// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/info.h"
#include "io/result/patches_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geo/base/check.h"
#include "io/base/text.h"
#include "io/result/shown_quantity.h"
#include "io/result/time.h"
#include "tests/support/refusal_of.h"
#include "tests/support/small_result.h"

namespace sunload {
namespace {

using test::SmallResult;
using test::write_small_result;

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << "\nis missing in\n" << text;
}

TEST(Info, OneScreenSaysWhatWhenAndHowGood) {
  SmallResult small;
  small.load = [](const std::string&, Vec3 normal, std::size_t r) {
    return (2 + normal.z - normal.y) * (1 + (r % 2 ? 0.01 : -0.01));
  };
  const ResultReader result(write_small_result(small, "info"));
  const auto text = info_text(result);
  expect_in(text, "small, variant baseline");
  expect_in(text, "3 intervals, 3 h in all");
  expect_in(text, "2026-06-21T09:30:00Z");
  expect_in(text, "2026-06-21 11:30 +02:00");
  expect_in(text, "8 facades");
  // s/√8 of ± 1 % is 0.01·√(8/7)/√8 = 0.378 %
  expect_in(text, "0.38 % (median by area)");
  // least load 1 (north and the awning's back), largest 3, both × 300 in the brightest interval
  expect_in(text, "0.333");
  expect_in(text, "2026-06-21T10:30:00Z");
  expect_in(text, "house_1/south_1 3");
  expect_in(text, "house_1/north_1 1");
  expect_in(text, "in 15 = sun 15");
  expect_in(text, "out 14.97 = absorbed 14.97");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 24);  // a screen
}

TEST(Info, TellsWhatConstantReflectedLightPutsOff) {
  const auto text = [](double reflected_share) {
    SmallResult small;
    small.reflected_share = reflected_share;
    return info_text(ResultReader(write_small_result(small, "info_mesh")));
  };
  expect_in(text(0.25), "2.5 % of a facade's load (median), below 2.5 % on 95 %");
  expect_in(text(0.5), "5 % of a facade's load (median), below 5 % on 95 %");
  EXPECT_EQ(text(0).find("one value per patch"), std::string::npos);
}

TEST(Info, ASceneInTheDarkHasNoAccuracy) {
  SmallResult dark;
  dark.load = [](const std::string&, Vec3, std::size_t) { return 0; };
  const auto text = info_text(ResultReader(write_small_result(dark, "info_dark")));
  expect_in(text, "no patch receives light");
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(Info, LightThatNoBatchBroughtIsNotKnown) {
  SmallResult without;
  without.load = [](const std::string&, Vec3, std::size_t) { return std::nan(""); };
  const auto text = info_text(ResultReader(write_small_result(without, "info_without")));
  expect_in(text, "light load   not known: no batch that was merged has light of the period");
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(Info, IntervalOfATimeIsFoundInCivilTimeAndUtc) {
  const ResultReader result(write_small_result(SmallResult{}, "info_time"));
  EXPECT_EQ(brightest_interval(result), 1u);
  EXPECT_EQ(interval_at(result, "2026-06-21T11:00"), 0u);
  EXPECT_EQ(interval_at(result, "2026-06-21T11:59:59Z"), 2u);
  EXPECT_EQ(interval_at(result, "2026-06-21T12:30+02:00"), 1u);
  EXPECT_THROW(interval_at(result, "2026-06-21T10:59"), InputError);
}

TEST(Info, PatchListHasARowPerPatchAndQuotesNames) {
  const ResultReader result(write_small_result(SmallResult{}, "info_patches"));
  std::istringstream csv(patches_csv(result));
  std::string header, first;
  std::getline(csv, header);
  std::getline(csv, first);
  EXPECT_EQ(header.rfind("index,object,facade,surface,material,side,area_m2,centroid_x_m,", 0), 0u);
  expect_in(header, ",light_load_kwh_m2,light_load_se_kwh_m2,light_load_direct_kwh_m2,");
  EXPECT_EQ(first.rfind("0,ground,,ground,\"brick, old\",0,12.5,", 0), 0u) << first;
  // load 3, error 0, no parts, sun 3 h, no power load
  expect_in(first, ",0,0,1,3,0,,,,,,3,");
  std::size_t rows = 1;
  for (std::string line; std::getline(csv, line);) ++rows;
  EXPECT_EQ(rows, result.shape("patch_area").front());
}

TEST(Info, PatchListHasAllThatAResultTellsOfEveryPatch) {
  const ResultReader result(write_small_result(SmallResult{}, "info_all_of_patches"));
  std::istringstream csv(patches_csv(result));
  std::string header;
  std::getline(csv, header);
  for (const auto& dataset : patch_datasets(result, PatchDatasets::totals))
    if (dataset != "patch_area")
      expect_in(header + ",", "," + with_units(dataset, result.units(dataset)) + ",");
}

/// A value of a table by the column's key and the row's name.
double value_of(const GroupTable& table, const std::string& key, const std::string& name) {
  const auto row = std::find(table.names.begin(), table.names.end(), name);
  for (const auto& column : table.columns)
    if (column.key == key && row != table.names.end())
      return column.values.at(static_cast<std::size_t>(row - table.names.begin()));
  ADD_FAILURE() << "no " << key << " of " << name;
  return 0;
}

SmallResult scattered() {
  SmallResult small;
  small.load = [](const std::string&, Vec3 normal, std::size_t r) {
    return (2 + normal.z - normal.y) * (1 + (r % 2 ? 0.01 : -0.01));
  };
  return small;
}

TEST(InfoTables, FacadesHaveLoadEnergyAndTheirErrors) {
  const ResultReader result(write_small_result(scattered(), "info_facades"));
  const auto table = group_table(result, TableOf::facades, {});
  EXPECT_EQ(table.names, result.strings("facade_name"));
  const std::string south = "house_1/south_1";  // 10 m × 9 m, load 3
  EXPECT_EQ(value_of(table, "azimuth_deg", south), 180);
  EXPECT_NEAR(value_of(table, "area_m2", south), 90, 1e-9);
  EXPECT_NEAR(value_of(table, "light_load_kwh_m2", south), 3, 1e-12);
  EXPECT_NEAR(value_of(table, "energy_kwh", south), 270, 1e-9);
  // s/√8 of ± 1 %: 0.01·√(8/7)/√8.
  const double se = 3 * 0.01 * std::sqrt(8.0 / 7) / std::sqrt(8.0);
  EXPECT_NEAR(value_of(table, "light_load_se_kwh_m2", south), se, 1e-12);
  EXPECT_NEAR(value_of(table, "energy_se_kwh", south), 90 * se, 1e-9);
  EXPECT_EQ(value_of(table, "sun_hours_h", south), 3);
  EXPECT_TRUE(std::isnan(value_of(table, "sky_view_factor", south)));  // the file has none
}

TEST(InfoTables, PatternsChooseRowsInTheOrderOfTheFile) {
  const ResultReader result(write_small_result(SmallResult{}, "info_chosen"));
  const NamedParts parts{{"*/south_1", "house_2/north_1"}, {}, {}};
  EXPECT_EQ(group_table(result, TableOf::facades, parts).names,
            (std::vector<std::string>{"house_1/south_1", "house_2/north_1", "house_2/south_1"}));
  EXPECT_THROW(group_table(result, TableOf::objects, parts), InputError);
  for (const auto& [table, section] :
       {std::pair{TableOf::sensors, "sensors"}, {TableOf::selections, "selections"}})
    EXPECT_NE(test::refusal_of([&] { group_table(result, table, {}); })
                  .find(std::string("no ") + section + " (its study has no section " + section +
                        "); write one"),
              std::string::npos);
  // 2 × 8 triangles of the wall, and of the patches of an object all.
  EXPECT_EQ(chosen_patches(result, {{"house_1/south_1"}, {}, {}}).size(), 8u);
  EXPECT_EQ(chosen_patches(result, {{"house_1/south_1"}, {"house_1"}, {}}).size(), 40u);
}

TEST(InfoTables, ObjectsAreOfBothTheirSides) {
  const ResultReader result(write_small_result(SmallResult{}, "info_objects"));
  const auto table = group_table(result, TableOf::objects, {});
  EXPECT_NEAR(value_of(table, "area_m2", "awning"), 32, 1e-9);
  EXPECT_NEAR(value_of(table, "light_load_kwh_m2", "awning"), 2, 1e-12);  // 3 above, 1 below
  EXPECT_TRUE(std::isnan(value_of(table, "azimuth_deg", "awning")));
}

TEST(InfoTables, OrientationsAreOfEachObject) {
  const ResultReader result(write_small_result(scattered(), "info_orientations"));
  const auto table = group_table(result, TableOf::orientations, {{}, {"house_1"}, {}});
  EXPECT_EQ(table.names, (std::vector<std::string>{"house_1/north", "house_1/east", "house_1/south",
                                                   "house_1/west", "house_1/roof"}));
  const auto facades = group_table(result, TableOf::facades, {});
  for (const char* column : {"azimuth_deg", "area_m2", "light_load_kwh_m2", "energy_se_kwh"})
    EXPECT_NEAR(value_of(table, column, "house_1/south"),
                value_of(facades, column, "house_1/south_1"), 1e-9)
        << column;
  EXPECT_NEAR(value_of(table, "area_m2", "house_1/roof"), 80, 1e-9);
  EXPECT_NEAR(value_of(table, "light_load_kwh_m2", "house_1/roof"), 3, 1e-12);
  EXPECT_TRUE(std::isnan(value_of(table, "azimuth_deg", "house_1/roof")));
  EXPECT_THROW(group_table(result, TableOf::orientations, {{"house_1/*"}, {}, {}}), InputError);
}

TEST(InfoTables, TextCsvAndJsonHaveTheSameRows) {
  SmallResult small = scattered();
  small.houses.front().name = "a, \"b\"";
  const ResultReader result(write_small_result(small, "info_formats"));
  const auto table = group_table(result, TableOf::facades, {{"a*"}, {}, {}});
  const auto csv = group_table_csv(table);
  expect_in(csv,
            "name,azimuth_deg,area_m2,light_load_kwh_m2,light_load_se_kwh_m2,energy_kwh,"
            "energy_se_kwh,sun_hours_h,sky_view_factor,irradiance_max_w_m2,mesh_error_kwh_m2\n");
  expect_in(csv, "\"a, \"\"b\"\"/south_1\",180,90,3,0.0113389342,270,1.02050408,3,,,\n");
  const auto json = nlohmann::json::parse(group_table_json(result, table));
  ASSERT_EQ(json["rows"].size(), 4u);
  EXPECT_EQ(json["table"], "facades");
  EXPECT_EQ(json["rows"][2]["name"], "a, \"b\"/south_1");
  EXPECT_NEAR(json["rows"][2]["energy_kwh"].get<double>(), 270, 1e-9);
  EXPECT_TRUE(json["rows"][2]["sky_view_factor"].is_null());
  const auto text = group_table_text(result, table);
  expect_in(text, "small, variant baseline: 4 facades\n");
  expect_in(text, "  180  90.0           3    0.011     270");
}

}  // namespace
}  // namespace sunload
