// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Mean, variance and standard error of independent realizations.
///
/// Of a single realization no spread is known: its variance and its error are 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sunload {

/// Mean of value(r) over the realizations r = 0 … n - 1.
template <class Value>
double mean_of(std::size_t n, Value&& value) {
  double mean = 0;
  for (std::size_t r = 0; r < n; ++r) mean += value(r) / static_cast<double>(n);
  return mean;
}

/// Variance of the same about their mean, which may be large.
template <class Value>
double variance_about(double mean, std::size_t n, Value&& value) {
  if (n < 2) return 0;
  double squares = 0;
  for (std::size_t r = 0; r < n; ++r) squares += (value(r) - mean) * (value(r) - mean);
  return squares / (static_cast<double>(n) - 1);
}
/// Variance of the same, about the mean that it computes itself.
template <class Value>
double variance_of(std::size_t n, Value&& value) {
  return variance_about(mean_of(n, value), n, value);
}

/// The same where only the sums of the values and of their squares were kept: it loses the digits
/// by which the mean exceeds the spread.
inline double variance_by_sums(std::size_t n, double sum, double sum_of_squares) {
  if (n < 2) return 0;
  const auto count = static_cast<double>(n);
  return std::max(0.0, sum_of_squares - sum * sum / count) / (count - 1);
}

/// s / √n: of the mean of n values of this variance.
inline double standard_error(double variance, std::size_t n) {
  return n < 2 ? 0 : std::sqrt(variance / static_cast<double>(n));
}

}  // namespace sunload
