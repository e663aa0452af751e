// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where light ends that surfaces send on: one struct for single lines, for whole sources and for
/// the suns of a block.
#pragma once

#include <array>
#include <cstddef>

#include "solver/light/sun_block.h"

namespace sunload {

/// Shares of what was sent, or power [W].
template <class T>
struct Fate {
  T escaped = 0;      ///< left the scene
  T backs = 0;        ///< met the back of a one-sided surface
  T cut = 0;          ///< would go on, but is not followed
  T transmitted = 0;  ///< left through panes
  T absorbed = 0;     ///< by surfaces; which of them, the follower tells

  Fate& operator+=(const Fate& other) {
    escaped += other.escaped;
    backs += other.backs;
    cut += other.cut;
    transmitted += other.transmitted;
    absorbed += other.absorbed;
    return *this;
  }
};

/// Every end of the light times the factor.
template <class T>
Fate<T> scaled(const Fate<T>& fate, T factor) {
  return {.escaped = factor * fate.escaped,
          .backs = factor * fate.backs,
          .cut = factor * fate.cut,
          .transmitted = factor * fate.transmitted,
          .absorbed = factor * fate.absorbed};
}

inline Fate<double> in_double(const Fate<float>& fate) {
  return {.escaped = static_cast<double>(fate.escaped),
          .backs = static_cast<double>(fate.backs),
          .cut = static_cast<double>(fate.cut),
          .transmitted = static_cast<double>(fate.transmitted),
          .absorbed = static_cast<double>(fate.absorbed)};
}

/// Of the light of every sun of a block [W].
struct SunFates {
  std::array<Fate<double>, block_width> of_sun{};

  Fate<double>& operator[](std::size_t k) { return of_sun[k]; }
  const Fate<double>& operator[](std::size_t k) const { return of_sun[k]; }
  SunFates& operator+=(const SunFates& other) {
    for (std::size_t k = 0; k < block_width; ++k) of_sun[k] += other.of_sun[k];
    return *this;
  }
  /// Adds the fate of what a source of these powers sent ([block_width]).
  void add(const Fate<double>& fate, const double* power) {
    for (std::size_t k = 0; k < block_width; ++k) of_sun[k] += scaled(fate, power[k]);
  }
};

}  // namespace sunload
