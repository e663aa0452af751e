// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bands of light: red, green and blue.
///
/// A band is the broadband quantity as if the whole spectrum behaved as that band does: irradiances
/// of a band are W m-2 of the whole spectrum, not of its part, and the mean of the bands is the
/// broadband value of every source, in every direction.
#pragma once

#include <array>
#include <cstddef>

namespace sunload {

/// broadband: one; rgb: red, green and blue on the same lines and shadow rays.
enum class Bands { broadband, rgb };
inline constexpr std::size_t band_count = 3;
inline constexpr std::array<const char*, band_count> band_names{"red", "green", "blue"};

/// One value per band, in the order of `band_names`.
using BandShares = std::array<double, band_count>;
/// Mean of the bands: the broadband value.
inline double mean_of(const BandShares& shares) {
  return (shares[0] + shares[1] + shares[2]) / static_cast<double>(band_count);
}

}  // namespace sunload
