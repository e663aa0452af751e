// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Half-precision floats (IEEE 754-2019 binary16): how series travel in a page.
#pragma once

#include <cstdint>

namespace sunload {

inline constexpr double largest_half = 65504;

/// The nearest half, ties to even. Relative error at most 2^-11 from 2^-14 on;
/// beyond `largest_half` infinity. NaN stays NaN.
std::uint16_t half_bits(float value);

}  // namespace sunload
