// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What every result must hold, and whether two results are the same.
#pragma once

#include <string>
#include <vector>

namespace sunload::test {

/// Names of the datasets that are not in both files with the same shape and the
/// same bits.
std::vector<std::string> different_data(const std::string& a, const std::string& b);

/// Time sums of the energy ledger [kWh].
struct Energy {
  double in = 0, out = 0;
  double residual = 0, residual_se = 0;
  double reuse_bias = 0;  ///< part of the residual that the lines' reuse makes
  std::size_t realizations = 0;
};
Energy energy_of(const std::string& result);

/// Empty, or why the energy of a result does not add up: in = out within t
/// standard errors of the residual (docs/developer/design.md, Result and ledger). `lost_share` of
/// what is absorbed can be left out, to see that the check would notice.
std::string ledger_problem(const std::string& result, double lost_share = 0);

/// Empty, or which of the promises of docs/developer/design.md, Result and ledger, that tie
/// datasets together are broken: light_load = Σ irradiance · length = Σ of its parts; largest value
/// of the series; sun hours within the daylight; facades = area-weighted patches; what is sent is
/// what is reflected and emitted.
std::string sums_problem(const std::string& result);

}  // namespace sunload::test
