#include "tests/support/statistics.h"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <stdexcept>

#include "solver/tally.h"

namespace sunload::test {

double accepted_t(std::size_t realizations) {
  const double alpha =
      1 - std::pow(1 - suite_false_alarms, 1.0 / declared_statistical_tests);
  const boost::math::students_t student(static_cast<double>(realizations) - 1);
  return quantile(complement(student, alpha / 2));
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
  verdict.text = fmt::format("n {}, mean {:.8g}, truth {:.8g}, off by {:.3g}, SE {:.3g}, limit {:.3g}",
                             realizations.size(), estimate.mean, truth, estimate.mean - truth,
                             estimate.standard_error, verdict.limit);
  return verdict;
}

}  // namespace sunload::test
