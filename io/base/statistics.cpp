// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "geo/base/check.h"
#include "solver/base/spread.h"

namespace sunload {
namespace {

double square(double x) { return x * x; }

/// Indices of `values` that are numbers, in ascending order of value.
std::vector<std::size_t> ascending(const std::vector<double>& values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

double student_t_quantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), probability);
}

double student_t_two_sided_p(double t, double degrees_of_freedom) {
  if (std::isnan(t) || std::isnan(degrees_of_freedom)) return not_known;
  if (std::isinf(t)) return 0;
  const boost::math::students_t distribution(degrees_of_freedom);
  return 2 * boost::math::cdf(boost::math::complement(distribution, std::abs(t)));
}

SampleMean sample_mean(const std::vector<double>& samples) {
  const std::size_t n = samples.size();
  if (n == 0) return {not_known, not_known};
  const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(n);
  if (n < 2) return {mean, not_known};
  const auto value = [&](std::size_t r) { return samples[r]; };
  return {mean, standard_error(variance_about(mean, n, value), n)};
}

DifferenceError paired_error(const std::vector<double>& base, const std::vector<double>& variant) {
  SUNLOAD_EXPECT(base.size() == variant.size(), "pairs of realizations");
  std::vector<double> differences(base.size());
  for (std::size_t r = 0; r < base.size(); ++r) differences[r] = variant[r] - base[r];
  return {sample_mean(differences).se, static_cast<double>(base.size()) - 1};
}

DifferenceError welch_error(const std::vector<double>& base, const std::vector<double>& variant) {
  const double base_squared = square(sample_mean(base).se);
  const double variant_squared = square(sample_mean(variant).se);
  const double squared = base_squared + variant_squared;
  const double spread = square(base_squared) / (static_cast<double>(base.size()) - 1) +
                        square(variant_squared) / (static_cast<double>(variant.size()) - 1);
  const double degrees_if_exact =
      static_cast<double>(base.size()) + static_cast<double>(variant.size()) - 2;
  return {std::sqrt(squared), spread == 0 ? degrees_if_exact : square(squared) / spread};
}

std::vector<double> holm_corrected(const std::vector<double>& p_values) {
  std::vector<double> corrected(p_values.size(), not_known);
  const auto order = ascending(p_values);
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto comparisons_left = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, comparisons_left * p_values[order[rank]]));
    corrected[order[rank]] = largest;
  }
  return corrected;
}

double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights,
                         double share) {
  SUNLOAD_EXPECT(values.size() == weights.size(), "one weight per value");
  struct Weighted {
    double value, weight;
  };
  std::vector<Weighted> known;
  known.reserve(values.size());
  double wanted = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    known.push_back({values[i], weights[i]});
    wanted += share * weights[i];
  }
  if (known.empty()) return not_known;
  // By halves, each time the one that holds the quantile (Hoare 1961, Algorithm 65, with weights).
  auto begin = known.begin(), end = known.end();
  while (end - begin > 1) {
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end,
                     [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double lower = 0;
    for (auto i = begin; i < middle; ++i) lower += i->weight;
    if (lower >= wanted) {
      end = middle;
    } else {
      wanted -= lower;
      begin = middle;
    }
  }
  return begin->value;
}

}  // namespace sunload
