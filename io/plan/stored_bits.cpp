// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/stored_bits.h"

#include <algorithm>
#include <cmath>

namespace sunload {

namespace {

constexpr double share_of_error = 0.1;
constexpr double order_of_stratified_lines = 0.75;

}  // namespace

int stored_bits(const Study& study) {
  if (study.output.significant_bits) return *study.output.significant_bits;
  const SolverStudy& solver = study.solver;
  const int lines = solver.accuracy ? solver.max_lines_per_patch : solver.lines_per_patch;
  const double bound = share_of_error * std::pow(lines, -order_of_stratified_lines);
  // The error of b bits is at most 2^-(b + 1) of the value.
  const double bits = std::ceil(-std::log2(bound) - 1);
  return static_cast<int>(std::clamp<double>(bits, 1, float_mantissa_bits));
}

}  // namespace sunload
