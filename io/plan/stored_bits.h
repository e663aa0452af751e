// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How many bits of a series' values are worth storing.
#pragma once

#include "io/study/study.h"

namespace sunload {

/// Bits of the mantissa that stored series of patches and sensors keep: 1 … 23, all of a float.
/// With `output.significant_bits: auto` the fewest whose rounding changes no value by more than a
/// tenth of the least error that lines leave.
///
/// n stratified lines leave an error of at least n^-3/4 where their light has edges (Mitchell
/// 1996, SIGGRAPH, Consequences of stratified sampling in graphics), n being the most that the
/// study lets a patch cast: so rounding adds less than 1 % of its square to an error.
int stored_bits(const Study& study);

}  // namespace sunload
