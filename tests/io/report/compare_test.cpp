// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/compare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/statistics.h"
#include "tests/support/result_change.h"
#include "tests/support/small_result.h"

namespace sunload {
namespace {

using test::SmallResult;
using test::write_small_result;

// Closed forms against Boost: a few dozen roundings of double.
constexpr double rounding = 1e-12;

const ComparisonRow& row(const Comparison& comparison, const std::string& kind,
                         const std::string& name) {
  for (const auto& r : comparison.rows)
    if (r.kind == kind && r.name == name) return r;
  throw std::out_of_range(kind + " " + name);
}

TEST(Statistics, StudentTFollowsItsClosedForms) {
  for (const double t : {0.0, 0.3, 1.0, 2.5, -4.0, 30.0}) {
    // One degree of freedom is Cauchy's distribution, two have an algebraic one.
    EXPECT_NEAR(student_t_two_sided_p(t, 1), 1 - 2 / pi * std::atan(std::abs(t)), rounding);
    EXPECT_NEAR(student_t_two_sided_p(t, 2), 1 - std::abs(t) / std::sqrt(2 + t * t), rounding);
  }
  EXPECT_NEAR(student_t_quantile(0.75, 1), 1, rounding);
  EXPECT_NEAR(student_t_two_sided_p(student_t_quantile(0.975, 7), 7), 0.05, rounding);
  EXPECT_EQ(student_t_two_sided_p(std::numeric_limits<double>::infinity(), 3), 0);
}

TEST(Statistics, HolmStepsDownAndStaysMonotone) {
  const auto nan = std::nan("");
  const auto corrected = holm_corrected({0.01, 0.04, nan, 0.03, 0.005});
  // Sorted 0.005·4, 0.01·3, 0.03·2, 0.04·1, each at least the one before.
  EXPECT_NEAR(corrected[4], 0.02, rounding);
  EXPECT_NEAR(corrected[0], 0.03, rounding);
  EXPECT_NEAR(corrected[3], 0.06, rounding);
  EXPECT_NEAR(corrected[1], 0.06, rounding);
  EXPECT_TRUE(std::isnan(corrected[2]));
  EXPECT_EQ(holm_corrected({0.6, 0.7})[1], 1);
}

TEST(Statistics, WelchOfEqualSpreadsIsTheClassicalTest) {
  const std::vector<double> a{1, 2, 3, 4}, b{3, 4, 5, 6};
  const auto error = welch_error(a, b);
  EXPECT_NEAR(error.se, std::sqrt(2 * (5.0 / 3) / 4), rounding);
  EXPECT_NEAR(error.degrees_of_freedom, 6, rounding);
}

TEST(Statistics, WeightedQuantile) {
  EXPECT_EQ(weighted_quantile({5, 1, 3}, {1, 1, 10}, 0.5), 3);
  EXPECT_EQ(weighted_quantile({5, 1, 3}, {10, 1, 1}, 0.5), 5);
  EXPECT_TRUE(std::isnan(weighted_quantile({}, {}, 0.5)));
}

enum class Fault { none, variance_for_standard_error };

/// Share of false alarms at 5 % among pairs without a difference.
double false_alarms(int trials, Fault fault) {
  constexpr int realizations = 8;
  std::mt19937_64 words(20260621);
  std::normal_distribution<double> noise;
  int alarms = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> base, variant;
    for (int r = 0; r < realizations; ++r) {
      const double common = 10 * noise(words);
      base.push_back(common + noise(words));
      variant.push_back(common + noise(words));
    }
    auto error = paired_error(base, variant);
    if (fault == Fault::variance_for_standard_error) error.se *= error.se;
    const double difference = sample_mean(variant).mean - sample_mean(base).mean;
    if (student_t_two_sided_p(difference / error.se, error.degrees_of_freedom) < significance_level)
      ++alarms;
  }
  return static_cast<double>(alarms) / trials;
}

// The share of false alarms is binomial; 4 standard deviations are left by
// chance once in 16 000 seeds (the seed is fixed).
constexpr int trials = 20000;
double distance_from_level(double share) {
  return std::abs(share - significance_level) /
         std::sqrt(significance_level * (1 - significance_level) / trials);
}

TEST(Statistics, PairedTestHoldsItsLevel) {
  EXPECT_LT(distance_from_level(false_alarms(trials, Fault::none)), 4);
}

TEST(Statistics, PairedTestHoldsItsLevelNotWithVarianceForStandardError) {
  EXPECT_GT(distance_from_level(false_alarms(trials, Fault::variance_for_standard_error)), 4);
}

/// Noise common to base and variant is large, their own noise small; the
/// variant adds 0.1 kWh/m² to the south side of house_1.
SmallResult noisy(const std::string& variant, const std::string& pairing_id) {
  SmallResult result;
  result.variant = variant;
  result.pairing_id = pairing_id;
  const double surplus = variant == "baseline" ? 0 : 0.1;
  const double phase = variant == "baseline" ? 0.3 : 1.1;
  result.load = [=](const std::string& object, Vec3 normal, std::size_t r) {
    const auto k = static_cast<double>(r);
    const double own =
        0.001 * std::sin(7 * k + phase + static_cast<double>(object.size()) + normal.x);
    const double south = object == "house_1" && normal.y < -0.5 ? surplus : 0;
    return 3 + normal.z + 0.5 * std::cos(3 * k) + own + south;
  };
  return result;
}

TEST(Compare, PairingRevealsWhatIndependentErrorsHide) {
  const ResultReader base(write_small_result(noisy("baseline", "same"), "compare_base"));
  const ResultReader paired(write_small_result(noisy("other", "same"), "compare_paired"));
  const ResultReader alone(write_small_result(noisy("other", "alone"), "compare_alone"));

  const auto with_pairs = compare_results(base, paired);
  EXPECT_EQ(with_pairs.errors, Comparison::Errors::paired);
  const auto& south = row(with_pairs, "facade", "house_1/south_1");
  EXPECT_NEAR(south.difference_kwh_m2, 0.1, 0.002);  // own noise: ± 0.001 in both
  EXPECT_TRUE(south.significant);
  EXPECT_LT(south.se_kwh_m2, 0.001);
  EXPECT_GE(south.p_corrected, south.p_value);
  EXPECT_EQ(south.unmatched_area_m2, 0);

  const auto without = compare_results(base, alone);
  EXPECT_EQ(without.errors, Comparison::Errors::independent);
  EXPECT_FALSE(row(without, "facade", "house_1/south_1").significant);
  EXPECT_GT(row(without, "facade", "house_1/south_1").se_kwh_m2, 0.1);
}

// The south facade of house_1 gains 0.1 of some 3: 3.3 %, more or less by house.
TEST(Compare, WhatMattersIsMoreThanTheLeastShare) {
  const ResultReader base(write_small_result(noisy("baseline", "same"), "compare_base"));
  const ResultReader paired(write_small_result(noisy("other", "same"), "compare_paired"));
  const auto south = [&](double least_percent) {
    return row(compare_results(base, paired, {.least_percent = least_percent}), "facade",
               "house_1/south_1");
  };
  const double percent = south(0).difference_percent;
  EXPECT_TRUE(south(0.5 * percent).significant);
  EXPECT_FALSE(south(1.1 * percent).significant);
  EXPECT_EQ(south(1.1 * percent).p_value, 1);
  // At the rim itself half of all samples lie beyond: no sure difference.
  EXPECT_GT(south(0.9999 * percent).p_value, 0.3);
  EXPECT_GE(south(0.5 * percent).p_value, south(0).p_value);

  const auto counts =
      change_counts(compare_results(base, paired, {.least_percent = 0.5 * percent}), "facade");
  EXPECT_EQ(counts.gain, 1u);
  EXPECT_EQ(counts.lose, 0u);
  EXPECT_GT(counts.others, 0u);
  const auto back =
      change_counts(compare_results(paired, base, {.least_percent = 0.5 * percent}), "facade");
  EXPECT_EQ(back.lose, 1u);
  const auto text = comparison_table(compare_results(base, paired, {.least_percent = 1}));
  EXPECT_NE(text.find("Surely more than 1 %:"), text.npos) << text;
  EXPECT_NE(text.find("facade      1 gain, 0 lose, "), text.npos) << text;
}

// All noise is the base's: at the rim, 4 % of the base, half of all differences lie beyond.
TEST(Compare, FalseAlarmsAtTheRimAreRareHoweverNoisyTheBase) {
  const auto noisy_base = [](const std::string& variant, double share) {
    SmallResult result;
    result.variant = variant;
    result.pairing_id = "same";
    result.houses.clear();
    for (int k = 0; k < 40; ++k)
      result.houses.push_back(
          {"house_" + std::to_string(k), {20. * k, 0, 0}, {20. * k + 10, 8, 9}});
    result.load = [=](const std::string& object, Vec3 normal, std::size_t r) {
      const std::string key = fmt::format("{} {:.0f} {:.0f} {}", object, normal.x, normal.y, r);
      std::seed_seq seed(key.begin(), key.end());
      std::mt19937_64 random(seed);
      std::normal_distribution<double> noise;
      const double own = 1e-4 * share * noise(random);
      return 10 * (1 + share) + noise(random) + own;
    };
    return result;
  };
  const ResultReader base(write_small_result(noisy_base("baseline", 0), "compare_rim_base"));
  const ResultReader variant(write_small_result(noisy_base("other", 0.04), "compare_rim_other"));
  std::size_t alarms = 0, facades = 0, beyond = 0;
  for (const auto& r : compare_results(base, variant, {.least_percent = 4}).rows) {
    if (r.kind != "facade") continue;
    ++facades;
    if (r.difference_percent > 4) ++beyond;
    if (r.p_value < significance_level) ++alarms;
  }
  EXPECT_GT(beyond, facades / 4);
  // Binomial at 5 %, and four standard deviations of it.
  const auto n = static_cast<double>(facades);
  EXPECT_LT(static_cast<double>(alarms), 0.05 * n + 4 * std::sqrt(0.05 * 0.95 * n));
}

TEST(Compare, EqualResultsDifferNowhere) {
  const ResultReader base(write_small_result(noisy("baseline", "same"), "compare_equal"));
  for (const auto& r : compare_results(base, base).rows) {
    EXPECT_EQ(r.difference_kwh_m2, 0) << r.name;
    EXPECT_EQ(r.p_value, 1) << r.name;
    EXPECT_FALSE(r.significant) << r.name;
  }
}

TEST(Compare, GroupMeansAreWeightedByArea) {
  const ResultReader base(write_small_result(SmallResult{}, "compare_area"));
  const auto comparison = compare_results(base, base);
  // The load is 2 + n_z - n_y: roof 3, north 1, south 3, east and west 2.
  const double walls = 2 * 10 * 9 + 2 * 8 * 9, roof = 10 * 8;
  const auto& house = row(comparison, "object", "house_1");
  EXPECT_NEAR(house.area_m2, walls + roof, 1e-9);
  EXPECT_NEAR(*house.base_kwh_m2, (2 * walls + 3 * roof) / (walls + roof), 1e-9);
  EXPECT_NEAR(*row(comparison, "surface", "wall").base_kwh_m2, 2, 1e-9);
}

TEST(Compare, HousesOfOneResultOnlyAreCountedAsUnmatched) {
  SmallResult more;
  more.houses.push_back({"tower, new", {-3, 12, 0}, {3, 16, 30}});
  const ResultReader base(write_small_result(SmallResult{}, "compare_two"));
  const ResultReader variant(write_small_result(more, "compare_three"));
  const double tower = 2 * 30 * (6 + 4) + 6 * 4;
  for (const auto& comparison : {compare_results(base, variant), compare_results(variant, base)}) {
    const auto& lonely = row(comparison, "object", "tower, new");
    EXPECT_NE(lonely.base_kwh_m2.has_value(), lonely.variant_kwh_m2.has_value());
    EXPECT_NEAR(lonely.unmatched_area_m2, tower, 1e-9);
    EXPECT_TRUE(std::isnan(lonely.p_value));
    EXPECT_NEAR(row(comparison, "whole", "whole").unmatched_area_m2, tower, 1e-9);
    EXPECT_EQ(row(comparison, "object", "house_1").unmatched_area_m2, 0);
    EXPECT_NE(comparison_table(comparison).find("no counterpart"), std::string::npos);
    EXPECT_NE(comparison_csv(comparison).find("object,\"tower, new\",624,"), std::string::npos);
  }
}

TEST(Compare, ScenesThatAreHardlyTurnedAreNotToldOf) {
  SmallResult straight;
  straight.north_deg = -180;
  const ResultReader base(write_small_result(straight, "compare_north"));
  const auto tells_of_turn = [&](double by_deg) {
    SmallResult other = straight;
    *other.north_deg += by_deg;
    const ResultReader turned(write_small_result(other, "compare_turned"));
    const auto notes = compare_results(base, turned).notes;
    return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
      return note.find("turned against each other") != std::string::npos;
    });
  };
  for (const double none : {0.0, 4e-8, -0.005, 360.0}) EXPECT_FALSE(tells_of_turn(none)) << none;
  for (const double some : {0.02, 90.0, 180.0}) EXPECT_TRUE(tells_of_turn(some)) << some;
}

/// A taller house_2: walls with new parts, and a roof elsewhere.
SmallResult with_a_taller_house() {
  SmallResult taller;
  taller.houses[1].high.z += 3;
  return taller;
}

TEST(Compare, MeansAreOverWhatBothHave) {
  SmallResult more;
  more.houses.push_back({"tower, new", {-3, 12, 0}, {3, 16, 30}});
  more.load = [](const std::string& object, Vec3 normal, std::size_t) {
    return object == "tower, new" ? 100 : 2 + normal.z - normal.y;
  };
  const ResultReader base(write_small_result(SmallResult{}, "common_base"));
  const ResultReader variant(write_small_result(more, "common_tower"));
  for (const auto& r : compare_results(base, variant).rows)
    if (r.base_kwh_m2 && r.variant_kwh_m2) {
      EXPECT_NEAR(r.difference_kwh_m2, 0, 1e-12) << r.kind << " " << r.name;
    } else {
      EXPECT_FALSE(r.base_kwh_m2) << r.kind << " " << r.name;
      EXPECT_NEAR(*r.variant_kwh_m2, 100, 1e-9) << r.kind << " " << r.name;
    }
}

TEST(Compare, OfAnObjectThatChangedTheAreaInCommonIsCompared) {
  const SmallResult plain, taller = with_a_taller_house();
  const ResultReader base(write_small_result(plain, "common_low"));
  const ResultReader variant(write_small_result(taller, "common_high"));
  const Vec3 size = plain.houses[1].high - plain.houses[1].low;
  const double around = 2 * (size.x + size.y), roof = size.x * size.y;
  const auto comparison = compare_results(base, variant);
  const auto rows_of_house = [&] {
    std::vector<ComparisonRow> rows;
    for (const auto& r : comparison.rows)
      if (r.kind == "object" && r.name == plain.houses[1].name) rows.push_back(r);
    return rows;
  }();
  ASSERT_EQ(rows_of_house.size(), 3u);
  EXPECT_NEAR(rows_of_house[0].area_m2, around * size.z, 1e-6);
  EXPECT_NEAR(rows_of_house[0].difference_kwh_m2, 0, 1e-9);
  EXPECT_NEAR(rows_of_house[0].unmatched_area_m2, 3 * around + 2 * roof, 1e-6);
  EXPECT_NEAR(rows_of_house[1].area_m2, roof, 1e-6);
  EXPECT_TRUE(rows_of_house[1].base_kwh_m2);
  EXPECT_NEAR(rows_of_house[2].area_m2, 3 * around + roof, 1e-6);
  EXPECT_TRUE(rows_of_house[2].variant_kwh_m2);
}

TEST(Compare, OneRealizationHasNoErrors) {
  SmallResult single;
  single.realizations = 1;
  const ResultReader base(write_small_result(single, "compare_single"));
  const auto comparison = compare_results(base, base);
  EXPECT_EQ(comparison.errors, Comparison::Errors::unknown);
  EXPECT_NE(comparison_csv(comparison).find(",false,,,false,"), std::string::npos);
}

/// As of a partial merge: a load that is not known makes its groups unknown, and no other.
TEST(Compare, LoadsThatAreNotKnown) {
  const auto base_path = test::write_small_result({}, "base");
  const auto path = test::write_small_result({}, "partial");
  test::change_number(path, "light_load", 0, std::nan(""));
  test::change_number(path, "light_load_realization", 0, std::nan(""));
  const ResultReader base(base_path), partial(path);
  const Comparison comparison = compare_results(base, partial);
  EXPECT_TRUE(std::isnan(comparison.rows.front().p_value));
  EXPECT_TRUE(std::isnan(comparison.rows.front().p_corrected));
  EXPECT_FALSE(comparison.rows.front().significant);
  EXPECT_EQ(comparison.rows.back().p_corrected, 1);
}

TEST(Compare, CsvHeaderIsTheContract) {
  const ResultReader base(write_small_result(SmallResult{}, "compare_csv"));
  const auto csv = comparison_csv(compare_results(base, base));
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "group,name,area_m2,base_kwh_m2,variant_kwh_m2,difference_kwh_m2,difference_percent,"
            "se_kwh_m2,paired,p_value,p_corrected,significant,unmatched_area_m2");
  // whole, 4 surfaces, 4 objects, 8 facades, 4 orientations
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 1 + 4 + 4 + 8 + 4);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
}

TEST(Compare, NamedRowsAloneWithTheCorrectionOfAll) {
  const ResultReader base(write_small_result({}, "named_base")),
      variant(write_small_result({}, "named_variant"));
  const auto all = compare_results(base, variant);
  auto some = all;
  keep_named(some, {{"house_1/*"}, {"house_2"}, {}}, "v.h5");
  ASSERT_EQ(some.rows.size(), 5u);
  for (const auto& row : some.rows)
    EXPECT_TRUE(row.kind == "object" ? row.name == "house_2" : row.name.starts_with("house_1/"));
  keep_named(some, {}, "v.h5");
  EXPECT_EQ(some.rows.size(), 5u);
  EXPECT_THROW(keep_named(some, {{"house_7/*"}, {}, {}}, "v.h5"), InputError);
}

}  // namespace
}  // namespace sunload
