// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/statistics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "solver/light/tally.h"

namespace sunload::test {

namespace {

/// α of one of `tests` that together have `alpha` (Šidák).
double shared(double alpha, double tests) { return 1 - std::pow(1 - alpha, 1 / tests); }

}  // namespace

namespace {

/// Counts the tests of this process; at its end they are added to those of the others, which
/// tests/statistical/budget.py holds against the declared number.
class Budget : public testing::Environment {
 public:
  static Budget& of_process() {
    static auto* budget = new Budget;  // googletest deletes it
    return *budget;
  }
  void count_one() { ++count_; }
  void TearDown() override {
    const char* folder = std::getenv("SUNLOAD_STATISTICAL_TESTS");
    if (folder == nullptr || count_ == 0) return;
    std::ofstream(fmt::format("{}/{}", folder, ::getpid())) << count_ << "\n";
  }

 private:
  int count_ = 0;
};

const auto* const registered = testing::AddGlobalTestEnvironment(&Budget::of_process());

}  // namespace

double false_alarm_share() {
  Budget::of_process().count_one();
  return shared(suite_false_alarms, declared_statistical_tests);
}

double accepted_t(std::size_t realizations) {
  const boost::math::students_t student(static_cast<double>(realizations) - 1);
  return quantile(complement(student, false_alarm_share() / 2));
}

Verdict expect_mean(const std::vector<double>& realizations, double truth, double bias_bound) {
  constexpr std::size_t least_realizations = 16;
  if (realizations.size() < least_realizations)
    throw std::logic_error("a statistical test needs 16 realizations");
  const MeanError estimate = mean_error(realizations);
  Verdict verdict;
  verdict.mean = estimate.mean;
  verdict.standard_error = estimate.standard_error;
  verdict.limit = accepted_t(realizations.size()) * estimate.standard_error + bias_bound +
                  float_rounding * std::abs(truth);
  verdict.accepted = std::abs(estimate.mean - truth) <= verdict.limit;
  verdict.text =
      fmt::format("n {}, mean {:.8g}, truth {:.8g}, off by {:.3g}, SE {:.3g}, limit {:.3g}",
                  realizations.size(), estimate.mean, truth, estimate.mean - truth,
                  estimate.standard_error, verdict.limit);
  return verdict;
}

Verdict expect_counts(const std::vector<double>& counted, const std::vector<double>& expected) {
  constexpr double least_expected = 5;  // the rule of thumb of Cochran (1954)
  double statistic = 0, pooled = 0, pooled_expected = 0;
  int cells = 0;
  bool impossible_hit = false;
  const auto add = [&](double count, double mean) {
    statistic += (count - mean) * (count - mean) / mean;
    ++cells;
  };
  for (std::size_t c = 0; c < counted.size(); ++c) {
    if (expected[c] <= 0) {
      impossible_hit = impossible_hit || counted[c] > 0;
    } else if (expected[c] >= least_expected) {
      add(counted[c], expected[c]);
    } else {
      pooled += counted[c];
      pooled_expected += expected[c];
    }
  }
  if (pooled_expected > 0) add(pooled, pooled_expected);
  Verdict verdict;
  verdict.mean = statistic;
  verdict.limit =
      quantile(complement(boost::math::chi_squared(std::max(1, cells - 1)), false_alarm_share()));
  verdict.accepted = !impossible_hit && statistic <= verdict.limit;
  verdict.text = fmt::format("chi-squared {:.4g} of {} cells, limit {:.4g}{}", statistic, cells,
                             verdict.limit, impossible_hit ? ", impossible cell hit" : "");
  return verdict;
}

CountInterval accepted_counts(double n, double p, double tests) {
  const double alpha = shared(false_alarm_share(), tests);
  const boost::math::binomial binomial(n, p);
  return {quantile(binomial, alpha / 2), quantile(complement(binomial, alpha / 2))};
}

}  // namespace sunload::test
