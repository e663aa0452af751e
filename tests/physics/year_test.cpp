// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A year from few solutions against a solution for each of its intervals: patches, sensors, lamps,
/// mirrors, the ledger, and what the transport says of its own error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "solver/solver.h"
#include "solver/transport/year_gathering.h"
#include "tests/support/program.h"
#include "tests/support/small_study.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

/// The square with its mirror, lamp, awning and sensors, from winter to summer, hour by hour.
std::string half_a_year(const std::string& obj, const std::string& errors, const char* year) {
  std::string study = square_study(errors, std::string(", year: ") + year, "3");
  const auto replace = [&](const std::string& from, const std::string& to) {
    study.replace(study.find(from), from.size(), to);
  };
  replace("period: {days: [2026-03-21], from: \"06:00\", to: \"18:00\", step_min: 60}",
          "period: {days: [2026-01-01, 2026-01-21, 2026-02-10, 2026-03-02, 2026-03-22, 2026-04-11, "
          "2026-05-01, 2026-05-21, 2026-06-10], from: \"05:00\", to: \"20:00\", step_min: 15}");
  replace("square.obj", obj);
  return study +
         "sensors: {points: [{position_m: [0, 0, 1.5], normal: [0, 0, 1]}, "
         "{position_m: [-5, -4, 1.5], normal: [0, -1, 0]}, "
         "{position_m: [-5, -4, 1.5], normal: [0, 0, -1]}]}\n";
}

struct Solutions {
  SolvedPlan each, modes;
};

/// Root mean square over patches by area and rows [K][N].
double mean_square(const SolvedPlan& solved, const LargeVector<float>& a,
                   const LargeVector<float>& b) {
  const std::vector<double>& area = solved.mesh().area();
  double sum = 0, all = 0;
  for (std::size_t at = 0; at < a.size(); ++at) {
    const double difference = static_cast<double>(a[at]) - static_cast<double>(b[at]);
    sum += area[at % area.size()] * difference * difference;
    all += area[at % area.size()];
  }
  return std::sqrt(sum / all);
}

double mean_of(const std::vector<double>& load, const std::vector<double>& area) {
  return std::inner_product(load.begin(), load.end(), area.begin(), 0.0) /
         std::accumulate(area.begin(), area.end(), 0.0);
}

class YearOfTheSquare : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const WorkFolder folder;
    const std::string obj = folder.write("square.obj", square_obj);
    solutions = new Solutions{solve_study(half_a_year(obj, "instants", "each")),
                              solve_study(half_a_year(obj, "totals", "modes"))};
  }
  static void TearDownTestSuite() {
    delete solutions;
    solutions = nullptr;
  }
  static const BatchTally& each() { return solutions->each.tally; }
  static const BatchTally& modes() { return solutions->modes.tally; }
  static Solutions* solutions;

  static void is_made_of_few_solutions();
  static void direct_sun_and_sun_hours_are_the_same();
  static void instants_differ_by_less_than_a_third_of_their_errors();
  static void loads_differ_by_less_than_their_errors();
  static void loads_of_objects_differ_by_less_than_their_errors();
  static void loads_are_the_means_of_the_realizations();
  static void loads_are_the_sums_of_the_series();
  static void sums_of_parts_are_those_of_their_series();
  static void nothing_comes_from_where_there_is_nothing();
  static void sensors_see_the_same();
  static void instants_of_sensors_differ_by_less_than_a_third_of_their_errors();
  static void ledgers_agree();
};
Solutions* YearOfTheSquare::solutions = nullptr;

constexpr auto total = static_cast<std::size_t>(Part::total);

void YearOfTheSquare::is_made_of_few_solutions() {
  ASSERT_TRUE(solutions->modes.reduction);
  EXPECT_FALSE(solutions->each.reduction);
  const Reduction& reduction = *solutions->modes.reduction;
  EXPECT_LT(reduction.skies + reduction.suns, each().intervals) << reduction.skies << " skies";
  EXPECT_TRUE(reduction.is_met);
}

void YearOfTheSquare::direct_sun_and_sun_hours_are_the_same() {
  const auto direct = static_cast<std::size_t>(Part::direct);
  EXPECT_EQ(each().irradiance[direct], modes().irradiance[direct]);
  EXPECT_EQ(each().sunlit_s, modes().sunlit_s);
}

void YearOfTheSquare::instants_differ_by_less_than_a_third_of_their_errors() {
  const LargeVector<float> none(each().irradiance_se.size(), 0);
  const double error = mean_square(solutions->each, each().irradiance_se, none);
  const double difference =
      mean_square(solutions->each, each().irradiance[total], modes().irradiance[total]);
  EXPECT_LT(difference, error / 3);
  // What it says of itself, from few intervals, is of that size.
  EXPECT_LT(difference, 2 * solutions->modes.reduction->error_w_m2 + error / 10);
}

void YearOfTheSquare::loads_differ_by_less_than_their_errors() {
  const auto& of_each = each().exposure_realization;
  double square = 0, errors = 0;
  for (std::size_t i = 0; i < each().exposure[total].size(); ++i) {
    std::vector<double> values;
    for (const auto& realization : of_each) values.push_back(realization[i]);
    const double se = mean_error(values).standard_error;
    const double difference = modes().exposure[total][i] - each().exposure[total][i];
    square += difference * difference;
    errors += se * se;
  }
  EXPECT_LT(square, errors / 9);
}

/// Errors of lines average out over the patches of an object; what few solutions are off by does
/// not.
void YearOfTheSquare::loads_of_objects_differ_by_less_than_their_errors() {
  const std::vector<double>& area = solutions->each.mesh().area();
  const auto of_objects = [&](const std::vector<double>& load) {
    std::map<std::string, double> sums;
    for (std::size_t i = 0; i < load.size(); ++i)
      sums[solutions->each.object(i)] += area[i] * load[i];
    return sums;
  };
  std::map<std::string, std::vector<double>> realizations;
  for (const auto& realization : each().exposure_realization)
    for (const auto& [object, load] : of_objects(realization)) realizations[object].push_back(load);
  auto of_modes = of_objects(modes().exposure[total]);
  double square = 0;
  for (const auto& [object, load] : of_objects(each().exposure[total])) {
    const double share =
        (of_modes[object] - load) / mean_error(realizations[object]).standard_error;
    square += share * share / static_cast<double>(realizations.size());
  }
  ASSERT_GT(realizations.size(), 2u);
  EXPECT_LT(std::sqrt(square), 1.0 / 3);
}

/// Whose sources are exact.
void YearOfTheSquare::loads_are_the_means_of_the_realizations() {
  constexpr double most = 1e-4;  // of a load: 1/65535 of the largest light of each block, scaled
  // Of the mean load of all: where it is nearly dark, what is not reflected may be too much.
  const double of_all = 1e-5 * mean_of(modes().exposure[total], solutions->modes.mesh().area());
  for (const ReceiverTally* of : {static_cast<const ReceiverTally*>(&modes()), &modes().sensors})
    for (std::size_t i = 0; i < of->exposure[total].size(); ++i) {
      double mean = 0;
      for (const auto& realization : of->exposure_realization)
        mean += realization[i] / static_cast<double>(of->exposure_realization.size());
      EXPECT_NEAR(of->exposure[total][i], mean, most * mean + of_all) << i;
    }
}

void YearOfTheSquare::loads_are_the_sums_of_the_series() {
  constexpr double roundings = 1e-6;  // of single precision, and of sums
  const auto& intervals = solutions->modes.plan.light.intervals;
  for (const ReceiverTally* of : {static_cast<const ReceiverTally*>(&modes()), &modes().sensors}) {
    const std::size_t count = of->exposure[total].size();
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 0;
      float most = 0;
      for (std::size_t k = 0; k < intervals.size(); ++k) {
        const float E = of->irradiance[total][k * count + i];
        sum += static_cast<double>(E) * intervals[k].when.length_s();
        most = std::max(most, E);
      }
      EXPECT_NEAR(of->exposure[total][i], sum, roundings * sum) << i;
      EXPECT_EQ(of->irradiance_max[i], most) << i;
    }
  }
}

void YearOfTheSquare::sums_of_parts_are_those_of_their_series() {
  constexpr double roundings = 1e-5;  // of single precision, of changes that are added to it
  const auto& intervals = solutions->modes.plan.light.intervals;
  const std::vector<double>& area = solutions->modes.mesh().area();
  for (const Part part : {Part::sky, Part::reflected}) {
    const auto p = static_cast<std::size_t>(part);
    const double mean = mean_of(modes().exposure[p], area);
    for (std::size_t i = 0; i < area.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < intervals.size(); ++k)
        sum += static_cast<double>(modes().irradiance[p][k * area.size() + i]) *
               intervals[k].when.length_s();
      EXPECT_NEAR(modes().exposure[p][i], sum, roundings * mean) << part_names[p] << " " << i;
    }
  }
}

/// A patch that sees no sky has none by what corrects totals, nor has any in the dark. Below the
/// house, a centimetre above the ground, one sample of thousands may find its way out.
void YearOfTheSquare::nothing_comes_from_where_there_is_nothing() {
  const auto sky = static_cast<std::size_t>(Part::sky);
  const std::size_t patches = each().exposure[sky].size();
  std::size_t dark = 0;
  for (std::size_t at = 0; at < each().irradiance[sky].size(); ++at) {
    const bool sees_none = each().exposure[sky][at % patches] == 0;
    const bool is_night = solutions->each.plan.light.intervals[at / patches].mean.dhi == 0;
    if (!sees_none && !is_night) continue;
    ++dark;
    constexpr float one_sample = 1e-3f;
    ASSERT_LE(modes().irradiance[sky][at], is_night ? 0 : one_sample)
        << at / patches << " " << at % patches;
  }
  EXPECT_GT(dark, 0u);
}

void YearOfTheSquare::sensors_see_the_same() {
  ASSERT_FALSE(each().sensors.exposure[total].empty());
  for (std::size_t s = 0; s < each().sensors.exposure[total].size(); ++s) {
    std::vector<double> values;
    for (const auto& realization : each().sensors.exposure_realization)
      values.push_back(realization[s]);
    EXPECT_NEAR(modes().sensors.exposure[total][s], each().sensors.exposure[total][s],
                mean_error(values).standard_error)
        << s;
  }
}

// One looks down: the shadows that pass below it no node knows.
void YearOfTheSquare::instants_of_sensors_differ_by_less_than_a_third_of_their_errors() {
  const ReceiverTally &exact = each().sensors, &made = modes().sensors;
  const std::size_t sensors = exact.exposure[total].size();
  ASSERT_EQ(sensors, 3u);
  for (std::size_t s = 0; s < sensors; ++s) {
    double difference = 0, error = 0;
    for (std::size_t at = s; at < exact.irradiance_se.size(); at += sensors) {
      const auto se = static_cast<double>(exact.irradiance_se[at]);
      const double off = static_cast<double>(made.irradiance[total][at]) -
                         static_cast<double>(exact.irradiance[total][at]);
      difference += off * off;
      error += se * se;
    }
    EXPECT_LT(difference, error / 9) << s;
  }
}

void YearOfTheSquare::ledgers_agree() {
  // Each term may differ by what the irradiance of all surfaces differs by, were it all one way.
  double area = 0, seconds = 0;
  for (const double a : solutions->each.mesh().area()) area += a;
  for (const auto& interval : solutions->each.plan.light.intervals)
    seconds += interval.when.length_s();
  const double most = solutions->modes.reduction->error_w_m2 * area * seconds;
  for (std::size_t t = 0; t < term_count; ++t)
    EXPECT_NEAR(modes().energy.terms[t], each().energy.terms[t], most) << ledger_line_names[t];
  EXPECT_NEAR(modes().energy.residual(), each().energy.residual(), most);
}

// One test: each would solve the year for itself.
TEST_F(YearOfTheSquare, AgreesWithASolutionForEachInterval) {
  is_made_of_few_solutions();
  direct_sun_and_sun_hours_are_the_same();
  instants_differ_by_less_than_a_third_of_their_errors();
  loads_differ_by_less_than_their_errors();
  loads_of_objects_differ_by_less_than_their_errors();
  loads_are_the_means_of_the_realizations();
  loads_are_the_sums_of_the_series();
  sums_of_parts_are_those_of_their_series();
  nothing_comes_from_where_there_is_nothing();
  sensors_see_the_same();
  instants_of_sensors_differ_by_less_than_a_third_of_their_errors();
  ledgers_agree();
}

TEST(YearInBands, AgreesWithASolutionForEachInterval) {
  const WorkFolder folder;
  const std::string obj = folder.write("square.obj", square_obj);
  const Solutions solutions{solve_study(half_a_year(obj, "instants", "each, bands: rgb")),
                            solve_study(half_a_year(obj, "totals", "modes, bands: rgb"))};
  const BatchTally &each = solutions.each.tally, &modes = solutions.modes.tally;  // red
  ASSERT_TRUE(solutions.modes.reduction && solutions.modes.reduction->is_met);
  const auto direct = static_cast<std::size_t>(Part::direct);
  EXPECT_EQ(each.irradiance[direct], modes.irradiance[direct]);
  const LargeVector<float> none(each.irradiance_se.size(), 0);
  const double error = mean_square(solutions.each, each.irradiance_se, none);
  EXPECT_LT(mean_square(solutions.each, each.irradiance[total], modes.irradiance[total]),
            error / 3);
  const std::vector<double>& area = solutions.each.mesh().area();
  std::vector<double> means;
  for (const auto& realization : each.exposure_realization)
    means.push_back(mean_of(realization, area));
  EXPECT_NEAR(mean_of(modes.exposure[total], area), mean_of(each.exposure[total], area),
              mean_error(means).standard_error);
}

/// Suns stand for each other as if morning were evening.
class Mirrored : public LitPeriod {
 public:
  explicit Mirrored(const LitPeriod& period) : period_(period) {}
  std::size_t intervals() const override { return period_.intervals(); }
  bool is_dark(std::size_t k) const override { return period_.is_dark(k); }
  bool has_sun(std::size_t k) const override { return period_.has_sun(k); }
  Vec3 direction(std::size_t k) const override {
    const Vec3 w = period_.direction(k);
    return {-w.x, w.y, w.z};
  }
  IntervalLight of(std::size_t k) const override { return period_.of(k); }

 private:
  const LitPeriod& period_;
};

/// The scene of a solution, traced for totals, and the light of its period.
struct TracedSquare {
  explicit TracedSquare(const SolvedPlan& solved)
      : plan(solved.plan),
        traced(trace_scene(plan.built.scene, solved.made.mesh, rules(plan), watch)),
        lights(plan.study, plan.built.site, traced->grid),
        period(lights, plan.light) {}
  static SolverRules rules(const VariantPlan& plan) {
    SolverRules rules = solver_rules(plan);
    rules.errors = Errors::totals;
    return rules;
  }

  const VariantPlan& plan;
  Watch watch;
  std::unique_ptr<TracedScene> traced;
  IntervalLights lights;
  SeriesLight period;
};

// The twin: nodes in the wrong places are noticed by the error that is measured.
TEST_F(YearOfTheSquare, WrongNodesAreNoticed) {
  const TracedSquare square(solutions->each);
  const Mirrored mirrored(square.period);
  Watch watch;
  const YearGathering wrong(*square.traced, mirrored, watch);
  EXPECT_GT(wrong.reduction()->error_w_m2, 3 * solutions->modes.reduction->error_w_m2);
}

/// What is told of skies and suns while they are solved.
class SharesOfNodes : public Watch {
 public:
  void advance(Stage stage, double share) override {
    if (stage == Stage::nodes) told.push_back(share);
  }
  std::vector<double> told;
};

TEST_F(YearOfTheSquare, TellsHowFarItsNodesAre) {
  const TracedSquare square(solutions->each);
  SharesOfNodes shares;
  const YearGathering year(*square.traced, square.period, shares);
  ASSERT_GT(shares.told.size(), 5u);
  EXPECT_EQ(shares.told.front(), 0.0);
  EXPECT_EQ(shares.told.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(shares.told.begin(), shares.told.end()));
}

/// Variants of which rays tell the same share what is traced: but rays of a year, whose sky about
/// the sun its nodes have, are none of solutions of each interval, nor the other way.
TEST_F(YearOfTheSquare, SharesNoRaysWithSolutionsOfEachInterval) {
  const TracedSquare square(solutions->each);
  Watch unwatched;
  const YearGathering year(*square.traced, square.period, unwatched);
  const auto each = transport_of(*square.traced);
  std::vector<IntervalLight> day = suns_of(square.plan, square.traced->grid);
  std::erase_if(day, [](const IntervalLight& light) { return !light.has_sun(); });
  day.resize(20);
  const auto loads = [&](const LightTransport& transport, RayRecord* record) {
    Watch watch;
    return solve(transport, day, watch, {}, record).bands.front().exposure_realization;
  };
  const LightTransport* const both[] = {&year, each.get()};
  for (const LightTransport* writer : both) {
    RayRecord record;
    record.most_bytes = 1e9;
    loads(*writer, &record);
    ASSERT_EQ(record.state, RayRecord::State::whole);
    for (const LightTransport* taker : both)
      EXPECT_EQ(loads(*taker, &record), loads(*taker, nullptr));
    EXPECT_EQ(record.state, RayRecord::State::whole);
  }
}

}  // namespace
}  // namespace sunload::test
