// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What contracts ask of light, times and shares.
#pragma once

#include <cmath>

namespace sunload {

/// A finite number that is not below 0.
inline bool is_amount(double value) { return std::isfinite(value) && value >= 0; }

}  // namespace sunload
