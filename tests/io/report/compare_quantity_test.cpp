// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparisons of other totals than the light load, and of who passes a rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geo/base/check.h"
#include "io/report/compare.h"
#include "io/result/patches_csv.h"
#include "io/result/shown_quantity.h"
#include "tests/support/refusal_of.h"
#include "tests/support/result_change.h"
#include "tests/support/small_result.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

using nlohmann::json;
using test::SmallResult;
using test::write_small_result;

constexpr double quantity_rounding = 1e-12;
const double not_measured = std::nan("");
// Of write_small_result: houses of 10 m × 8 m, 9 and 6 m high.
constexpr double south_of_1 = 10 * 9, roof_of_2 = 10 * 8;

const ComparisonRow& quantity_row(const Comparison& comparison, const std::string& kind,
                                  const std::string& name) {
  for (const auto& r : comparison.rows)
    if (r.kind == kind && r.name == name) return r;
  throw std::out_of_range(kind + " " + name);
}

/// An hour less on the south side of house_1, an hour more on the roof of house_2.
SmallResult with_other_hours() {
  SmallResult result;
  result.variant = "other";
  result.hours = [](const std::string& object, Vec3 normal) {
    if (object == "house_1" && normal.y < -0.5) return 2.0;
    return object == "house_2" && normal.z > 0.5 ? 4.0 : 3.0;
  };
  return result;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string refusal(const ResultReader& base, const ResultReader& variant,
                    const std::string& dataset) {
  try {
    compare_results(base, variant, {.dataset = dataset});
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(CompareQuantity, GroupsHaveTheirMeansByArea) {
  const ResultReader base(write_small_result({}, "hours_base"));
  const ResultReader variant(write_small_result(with_other_hours(), "hours_other"));
  const auto comparison = compare_results(base, variant, {.dataset = "sun_hours"});
  EXPECT_EQ(comparison.units, "h");
  EXPECT_NEAR(quantity_row(comparison, "facade", "house_1/south_1").difference_kwh_m2, -1,
              quantity_rounding);
  const auto& house = quantity_row(comparison, "object", "house_1");
  EXPECT_NEAR(house.difference_kwh_m2, -south_of_1 / house.area_m2, quantity_rounding);
  const auto& whole = quantity_row(comparison, "whole", "whole");
  EXPECT_NEAR(whole.difference_kwh_m2, (roof_of_2 - south_of_1) / whole.area_m2, quantity_rounding);
  EXPECT_EQ(quantity_row(comparison, "object", "ground").difference_kwh_m2, 0);
}

TEST(CompareQuantity, WithoutRealizationsThereAreNoErrors) {
  const ResultReader base(write_small_result({}, "errors_base"));
  const ResultReader variant(write_small_result(with_other_hours(), "errors_other"));
  const auto comparison = compare_results(base, variant, {.dataset = "sun_hours"});
  EXPECT_EQ(comparison.errors, Comparison::Errors::none);
  for (const auto& r : comparison.rows) {
    EXPECT_TRUE(std::isnan(r.se_kwh_m2)) << r.name;
    EXPECT_TRUE(std::isnan(r.p_corrected)) << r.name;
    EXPECT_FALSE(r.significant) << r.name;
  }
  const auto text = comparison_table(comparison);
  EXPECT_EQ(text.rfind("Sun hours of other (variant) against baseline (base) [h]\n"
                       "no standard errors: results keep no realizations of it\n",
                       0),
            0u)
      << text;
  for (const char* of_errors : {"std.err.", "*", "Surely", "0 others"})
    EXPECT_FALSE(has(text, of_errors)) << of_errors << "\n" << text;
  EXPECT_TRUE(json::parse(comparison_json(comparison))["counts"].is_null());
  // The light load of the same results has them.
  EXPECT_TRUE(has(comparison_table(compare_results(base, variant)), "std.err."));
}

TEST(CompareQuantity, GainsAndLossesAreThoseBeyondTheLeastShare) {
  const ResultReader base(write_small_result({}, "least_base"));
  const ResultReader variant(write_small_result(with_other_hours(), "least_other"));
  const auto counts = [&](double least_percent, const char* kind) {
    const auto comparison =
        compare_results(base, variant, {.dataset = "sun_hours", .least_percent = least_percent});
    return change_counts(comparison, kind);
  };
  // The south side loses a third.
  EXPECT_EQ(counts(33, "facade").lose, 1u);
  EXPECT_EQ(counts(33, "facade").gain, 0u);
  EXPECT_EQ(counts(33, "facade").others, 7u);
  EXPECT_EQ(counts(34, "facade").lose, 0u);
  EXPECT_EQ(counts(1, "object").gain, 1u);
  EXPECT_EQ(counts(1, "object").lose, 1u);
  const auto text = comparison_table(
      compare_results(base, variant, {.dataset = "sun_hours", .least_percent = 33}));
  EXPECT_TRUE(has(text, "\nMore than 33 %:\n")) << text;
  EXPECT_TRUE(has(text, "facade      0 gain, 1 lose, 7 others")) << text;
}

TEST(CompareQuantity, ListingsNameTheUnitApart) {
  const ResultReader base(write_small_result({}, "csv_base"));
  const ResultReader variant(write_small_result(with_other_hours(), "csv_other"));
  const auto comparison =
      compare_results(base, variant, {.dataset = "sun_hours", .least_percent = 1});
  const auto csv = comparison_csv(comparison);
  EXPECT_EQ(csv.rfind("group,name,area_m2,base,variant,difference,difference_percent,se,paired,"
                      "p_value,p_corrected,significant,unmatched_area_m2,units\n",
                      0),
            0u);
  EXPECT_TRUE(has(csv, "facade,house_1/south_1,90,3,2,-1,-33.3333333,,false,,,false,0,h\n")) << csv;
  const auto document = json::parse(comparison_json(comparison));
  EXPECT_EQ(document["quantity"], "sun_hours");
  EXPECT_EQ(document["units"], "h");
  EXPECT_EQ(document["counts"]["facade"]["lose"], 1);
  EXPECT_EQ(document["rows"][0]["base"], 3.0);
  EXPECT_FALSE(document.contains("measures"));
}

TEST(CompareQuantity, WhatIsNoneIsRefusedWithWhatThereIs) {
  const auto path = write_small_result(with_other_hours(), "refused_other");
  const ResultReader base(write_small_result({}, "refused_base"));
  EXPECT_TRUE(has(refusal(base, ResultReader(path), "sun_hour"),
                  "no quantity sun_hour per patch; choose one of light_load, sun_hours"));
  // Areas and errors have no mean, series no one value.
  for (const char* other : {"patch_area", "light_load_se", "irradiance", "light_load_realization"})
    EXPECT_TRUE(
        has(refusal(base, ResultReader(path), other), "choose one of light_load, sun_hours"))
        << other;
  SmallResult with_reflected;
  with_reflected.reflected_share = 0.5;
  const ResultReader richer(write_small_result(with_reflected, "refused_richer"));
  EXPECT_TRUE(has(refusal(richer, ResultReader(path), "light_load_reflected"), path));
  test::ChangedResult(path).set({"sun_hours", "units", {}, true}, "min");
  EXPECT_TRUE(has(refusal(base, ResultReader(path), "sun_hours"),
                  "sun_hours is in min (the base has it in h)"));
}

TEST(CompareQuantity, APartOfThePeriodHasWhatIsKnownOfIt) {
  ResultReader base(write_small_result({}, "part_base"));
  ResultReader variant(write_small_result(with_other_hours(), "part_other"));
  PeriodChoice choice;
  choice.hours = "11-12";  // one of three intervals, of which there are series alone
  base.choose(choice);
  variant.choose(choice);
  EXPECT_EQ(compare_results(base, variant).rows.front().difference_kwh_m2, 0);
  EXPECT_TRUE(has(refusal(base, variant, "sun_hours"),
                  "(it is not known of hours 11-12); choose one of light_load"));
  const std::string shown = test::refusal_of([&] { shown_quantity(base, "sun_hours", ""); });
  EXPECT_TRUE(has(shown, "(it is not known of hours 11-12); choose one of")) << shown;
}

/// Hours by the measure: the house's walls have them, house_1 fewer in the variant.
SmallResult measured(const std::string& variant, const std::string& not_of, double of_house_1) {
  SmallResult result;
  result.variant = variant;
  result.measure = [=](const std::string& object, Vec3 normal) {
    if (object == "ground" || object == "awning" || object == not_of) return not_measured;
    if (normal.z > 0.5) return not_measured;
    return object == "house_1" ? of_house_1 : 4 - normal.y;
  };
  return result;
}

TEST(CompareQuantity, MeasuresAreComparedWhereBothHaveThem) {
  SmallResult finer = measured("finer", "house_2", 1);
  finer.cells = 3;
  const ResultReader base(write_small_result(measured("base", "", 3), "measure_base"));
  for (const auto& other : {measured("other", "house_2", 1), finer}) {
    const ResultReader variant(write_small_result(other, "measure_" + other.variant));
    const auto comparison = compare_results(base, variant, {.dataset = "measure_sun"});
    const double walls = 2 * (10 + 8) * 9, walls_of_2 = 2 * (10 + 8) * 6;
    // Were what is not measured taken as 0, or left out on one side alone, these would be others.
    for (const auto& [kind, name] : {std::pair("whole", "whole"), {"object", "house_1"}}) {
      const auto& r = quantity_row(comparison, kind, name);
      EXPECT_NEAR(r.area_m2, walls, 1e-6) << other.variant;
      EXPECT_NEAR(*r.base_kwh_m2, 3, quantity_rounding) << other.variant;
      EXPECT_NEAR(*r.variant_kwh_m2, 1, quantity_rounding) << other.variant;
    }
    const auto& alone = quantity_row(comparison, "object", "house_2");
    EXPECT_FALSE(alone.variant_kwh_m2) << other.variant;
    EXPECT_NEAR(alone.area_m2, walls_of_2, 1e-6) << other.variant;
    EXPECT_EQ(comparison.notes.size(), other.cells == 2 ? 0u : 1u);
    EXPECT_THROW(quantity_row(comparison, "object", "ground"), std::out_of_range);
  }
}

TEST(CompareQuantity, RulesOfOneNameThatDifferAreNoted) {
  SmallResult other = measured("other", "", 1);
  other.measure_parameters = R"({"least_h": 2})";
  const ResultReader base(write_small_result(measured("base", "", 3), "rule_base"));
  const ResultReader variant(write_small_result(other, "rule_other"));
  const auto notes = compare_results(base, variant, {.dataset = "measure_sun"}).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(has(notes.front(), "different rules"));
  EXPECT_TRUE(measure_changes(verdicts_of_both(base, variant), {}).empty());
  const auto verdicts = notes_on_verdicts(verdicts_of_both(base, variant));
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_TRUE(has(verdicts.front(), "verdicts of measure sun are not compared"))
      << verdicts.front();
  EXPECT_TRUE(has(verdicts.front(), "sun_hours (least_h 2) in the variant")) << verdicts.front();
}

TEST(CompareQuantity, VerdictsOfTheSameDayInOtherYearsAreComparedWithANote) {
  const auto on = [](const char* name, const char* parameters) {
    SmallResult result = measured(name, "", 3);
    result.measure_parameters = parameters;
    return ResultReader(write_small_result(result, std::string("year_") + name));
  };
  const ResultReader base = on("base", R"({"date": [2026, 3, 21], "least_h": 2})"),
                     next = on("next", R"({"date": [2027, 3, 21], "least_h": 2})"),
                     other = on("other", R"({"date": [2026, 3, 22], "least_h": 2})");
  EXPECT_EQ(measure_changes(verdicts_of_both(base, next), {}).size(),
            measure_changes(verdicts_of_both(base, base), {}).size());
  const auto notes = notes_on_verdicts(verdicts_of_both(base, next));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(has(notes.front(), "same day of different years")) << notes.front();
  EXPECT_TRUE(notes_on_verdicts(verdicts_of_both(base, base)).empty());
  EXPECT_TRUE(measure_changes(verdicts_of_both(base, other), {}).empty());
  const auto refused = notes_on_verdicts(verdicts_of_both(base, other));
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_TRUE(has(refused.front(), "2026-03-22, least_h 2) in the variant")) << refused.front();
}

TEST(CompareQuantity, VerdictsOverOtherSurfacesAreTold) {
  const ResultReader base(write_small_result(measured("base", "", 3), "verdict_area_base"));
  SmallResult larger = measured("variant", "", 3);
  larger.houses.back().high = {12, 8, 30};
  const ResultReader variant(write_small_result(larger, "verdict_area_variant"));
  EXPECT_TRUE(notes_on_verdicts(verdicts_of_both(base, base)).empty());
  const auto notes = notes_on_verdicts(verdicts_of_both(base, variant));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(has(notes.front(),
                  "5 verdicts are over other surfaces in the variant than in the "
                  "base: object house_2 of sun ("))
      << notes.front();
}

// Numbers of facades follow their areas: a wall that grows takes its neighbour's.
TEST(CompareQuantity, VerdictsOfOtherWallsOfOneNameArePartedAsRowsAre) {
  const ResultReader base(write_small_result(measured("base", "", 3), "other_walls_base"));
  SmallResult moved = measured("moved", "", 0.5);
  for (Vec3* corner : {&moved.houses.front().low, &moved.houses.front().high})
    corner->x -= 3;  // the walls of south and north overlap those of before
  const ResultReader variant(write_small_result(moved, "other_walls_moved"));
  const Verdicts verdicts = verdicts_of_both(base, variant);
  const auto changes = measure_changes(verdicts, {{"house_1/*"}, {}, {}});
  std::size_t alone = 0;
  for (const auto& change : changes) {
    const bool is_across =
        has(change.name, "/east_") || has(change.name, "/west_");  // of where they stood
    if (is_across) ++alone;
    EXPECT_EQ(change.to == MeasureChange::To::only_in_base ||
                  change.to == MeasureChange::To::only_in_variant,
              is_across)
        << change.name;
  }
  EXPECT_EQ(alone, 4u);
  const auto text = measure_changes_text(changes);
  for (const char* part : {"2 → 0 of 2 facades\n", "house_1/south_1: high → fail",
                           "facade house_1/east_1: only in the base, high (3.00 h)\n",
                           "facade house_1/east_1: only in the variant, fail (0.50 h)\n"})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  // The load table has the same rows.
  const auto rows = compare_results(base, variant);
  EXPECT_FALSE(quantity_row(rows, "facade", "house_1/east_1").variant_kwh_m2);
  EXPECT_TRUE(quantity_row(rows, "facade", "house_1/south_1").variant_kwh_m2);
  const auto notes = notes_on_verdicts(verdicts);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(has(notes.front(), "house_1/south_1 of sun (90 → 90 m2, 63 in common)"))
      << notes.front();
  auto comparison = compare_results(base, variant);
  comparison.measures = changes;
  bool is_told = false;
  const auto list = json::parse(comparison_json(comparison))["measures"];
  for (const auto& row : list)
    is_told = is_told || (row["change"] == "only_in_base" && row["variant_level"].is_null() &&
                          row["variant_reached"].is_null() && row["base_level"] == "high");
  EXPECT_TRUE(is_told);
}

TEST(CompareQuantity, CountsOfARuleTellWhatTheyAreOf) {
  const ResultReader base(write_small_result(measured("base", "", 3), "counts_base"));
  const ResultReader variant(write_small_result(measured("other", "", 0.5), "counts_other"));
  const auto text = measure_changes_text(measure_changes(verdicts_of_both(base, variant), {}));
  EXPECT_EQ(text.rfind("\nsun: pass in the base → in the variant: 2 → 1 of 2 objects, "
                       "8 → 4 of 8 facades\n  object house_1: high → fail (3.00 → 0.50 h)\n",
                       0),
            0u)
      << text;
  const auto some = measure_changes_text(
      measure_changes(verdicts_of_both(base, variant), {{"house_1/south_*"}, {}, {}}));
  EXPECT_EQ(some,
            "\nsun: pass in the base → in the variant: 1 → 0 of 1 facade\n"
            "  facade house_1/south_1: high → fail (3.00 → 0.50 h)\n");
  // What only the variant has is not judged twice, and no error.
  EXPECT_TRUE(measure_changes(verdicts_of_both(base, variant), {{"tower/*"}, {}, {}}).empty());

  SmallResult of_ground;
  of_ground.measure = [](const std::string& object, Vec3) {
    return object == "ground" ? 2 : not_measured;
  };
  const ResultReader ground(write_small_result(of_ground, "counts_ground"));
  EXPECT_EQ(measure_changes_text(measure_changes(verdicts_of_both(ground, ground), {})),
            "\nsun: pass in the base → in the variant: 1 → 1 of 1 object\n");
}

TEST(CompareQuantity, JsonListsWhoPassesBeforeAndAfter) {
  const ResultReader base(write_small_result(measured("base", "", 0.5), "json_base"));
  const ResultReader variant(write_small_result(measured("other", "", 3), "json_other"));
  auto comparison = compare_results(base, variant);
  comparison.measures = measure_changes(verdicts_of_both(base, variant), {});
  const auto list = json::parse(comparison_json(comparison))["measures"];
  ASSERT_EQ(list.size(), 10u);  // 2 objects, 8 facades
  EXPECT_EQ(list[0], json::parse(R"({"measure": "sun", "group": "object", "name": "house_1",
    "units": "h", "base_reached": 0.5, "variant_reached": 3.0, "base_level": "fail",
    "variant_level": "high", "change": "better"})"));
  EXPECT_EQ(list[1]["change"], "same");
  EXPECT_EQ(measure_changes(verdicts_of_both(variant, base), {}).front().to,
            MeasureChange::To::worse);
}

TEST(CompareQuantity, FilesHoldTheDifferencesOfItsPatches) {
  const ResultReader base(write_small_result({}, "file_base"));
  const ResultReader variant(write_small_result(with_other_hours(), "file_other"));
  const std::string path = test::folder_of_test() / "hours.h5";
  write_comparison_hdf5(compare_results(base, variant, {.dataset = "sun_hours"}), base, variant,
                        path);
  const ResultReader file(path, {}, Opens::derived_too);
  EXPECT_EQ(file.compared(), "sun_hours");
  const auto shown = shown_quantity(file, usual_quantity(file), {});
  EXPECT_EQ(shown.name, "sun hours difference");
  EXPECT_EQ(shown.units, "h");
  EXPECT_TRUE(shown.is_difference);
  EXPECT_EQ(*std::min_element(shown.values.begin(), shown.values.end()), -1);
  EXPECT_EQ(*std::max_element(shown.values.begin(), shown.values.end()), 1);
  EXPECT_EQ(file.units("group_base_sun_hours"), "h");
  const auto facades = file.strings("facade_name");
  const auto south = std::find(facades.begin(), facades.end(), "house_1/south_1");
  ASSERT_NE(south, facades.end());
  EXPECT_NEAR(file.doubles(
                  "facade_sun_hours_difference")[static_cast<std::size_t>(south - facades.begin())],
              -1, quantity_rounding);
  EXPECT_TRUE(has(patches_csv(file, {}), ",base_h,variant_h,difference_h,se_h\n"));
}

}  // namespace
}  // namespace sunload
