// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small-sample statistics of realizations (Boost.Math for Student's t).
#pragma once

#include <limits>
#include <vector>

namespace sunload {

/// Share of a family's comparisons at which one false alarm is risked, and
/// 1 minus the level of the confidence intervals that people are shown.
inline constexpr double significance_level = 0.05;

/// In place of a number that nobody knows.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Quantile of Student's t: P(T ≤ t) = `probability` in (0, 1), degrees of freedom > 0.
double student_t_quantile(double probability, double degrees_of_freedom);

/// P(|T| ≥ |t|); 1 for t = 0, 0 for an infinite t, NaN where one of both is NaN.
double student_t_two_sided_p(double t, double degrees_of_freedom);

/// Mean of independent repetitions and its standard error s/√n (NaN for n < 2).
struct SampleMean {
  double mean = 0;
  double se = 0;
};
SampleMean sample_mean(const std::vector<double>& samples);

/// A difference with its standard error and its degrees of freedom; NaN where
/// there are too few repetitions.
struct DifferenceError {
  double se = 0;
  double degrees_of_freedom = 0;
};

/// Repetitions that share their random numbers: spread of base[r] − variant[r].
DifferenceError paired_error(const std::vector<double>& base, const std::vector<double>& variant);

/// Independent repetitions of unlike spread: Welch (1947), The Generalization
/// of 'Student's' Problem, with the degrees of freedom of Satterthwaite (1946).
DifferenceError welch_error(const std::vector<double>& base, const std::vector<double>& variant);

/// p-values corrected for the number of comparisons, in the order given; NaN
/// stays NaN and is not counted. Holds whatever the dependence between them.
/// Holm (1979), A Simple Sequentially Rejective Multiple Test Procedure.
std::vector<double> holm_corrected(const std::vector<double>& p_values);

/// Value below which half of the weight lies; values of NaN are left out.
/// NaN where nothing is left. `share` in [0, 1] selects another quantile.
double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights,
                         double share);

}  // namespace sunload
