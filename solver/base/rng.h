// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers by address: a key names every number, no state is shared, any
/// sample can be replayed alone. Philox 4×32 with 10 rounds (Salmon et al. 2011,
/// Parallel Random Numbers: As Easy as 1, 2, 3), from the Random123 library.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sunload {

/// What a number is for: uses never share numbers.
enum class Purpose : std::uint32_t {
  lines = 1,
  direct_sun = 2,
  mirror_sun = 3,
  mesh_pilot = 4,
  glossy = 5,
  glossy_sun = 6,
  lamps = 8,
  circumsolar = 9,
  parallel_light = 10,
  bright_surfaces = 11,
  sun_disk = 12,  ///< points of it that glossy surfaces ask
  form_factors = 13,
  clouded_sun = 14,  ///< of which only is asked how much of a patch would see it
  luminaires = 15,
  shooting = 16,
  glossy_disk = 17,  ///< points of the sun's disk whose images patches look for in lobes
};

/// Address of a block of random words.
struct RandomKey {
  std::uint64_t seed = 1;  ///< of the study
  Purpose purpose = Purpose::lines;
  std::uint32_t realization = 0;
  std::uint64_t element = 0;  ///< stable key of a patch (object, input triangle, path, side)
  std::uint32_t sun = 0;      ///< number of the interval in the period, 0 for lines
  std::uint32_t block = 0;    ///< further words for the same address
};

using RandomWords = std::array<std::uint32_t, 4>;

/// Four uniform words of 32 bits; the same key gives the same words on any machine.
RandomWords random_words(const RandomKey& key);

/// random_words for the realizations 0 … 15 at once, as lanes [word][realization].
struct alignas(64) RandomLanes {
  std::uint32_t word[4][16];
};
RandomLanes random_lanes(const RandomKey& key_of_first);

/// Uniform number in [0, 1) of 24 bits, exact in float.
constexpr float uniform(std::uint32_t word) {
  return static_cast<float>(word >> 8) * (1.0f / 16777216.0f);
}

}  // namespace sunload
