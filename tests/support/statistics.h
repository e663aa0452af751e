// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Statistical acceptance (docs/developer/design.md, Tests): no tolerance is typed in.
#pragma once

#include <string>
#include <vector>

namespace sunload::test {

/// False alarms of the whole suite that are accepted per run, shared by its
/// statistical tests (Šidák).
inline constexpr double suite_false_alarms = 1e-3;
/// At most: counted when tests run (tests/statistical/budget.py).
inline constexpr int declared_statistical_tests = 2500;

/// One test's share α' of the budget: every call is counted as a test.
double false_alarm_share();

/// Quantile 1 - α'/2 of Student's t.
double accepted_t(std::size_t realizations);

struct Verdict {
  bool accepted = false;
  double mean = 0, standard_error = 0, limit = 0;
  std::string text;  ///< n, mean, truth, SE, limit: for the failure message
  explicit operator bool() const { return accepted; }
};

/// |mean - truth| <= t·SE + bias_bound + rounding, at least 16 realizations.
/// `bias_bound` is the model's own bias, from a formula or from halving a mesh.
Verdict expect_mean(const std::vector<double>& realizations, double truth, double bias_bound = 0);

/// Pearson's chi-squared of counts against expected counts; cells of less than 5
/// are pooled, and cells that cannot be hit must be empty.
Verdict expect_counts(const std::vector<double>& counted, const std::vector<double>& expected);

/// The interval that holds a Binomial(n, p) count but for a share α' of cases, divided
/// by Šidák among `tests` such counts.
struct CountInterval {
  double low = 0, high = 0;
  bool contains(double count) const { return low <= count && count <= high; }
};
CountInterval accepted_counts(double n, double p, double tests = 1);

/// Float series carry about this relative rounding (docs/developer/design.md, Tests).
inline constexpr double float_rounding = 1e-5;

}  // namespace sunload::test
