// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whose the blocks of random words at one address are (RandomKey::block): uses that share a
/// purpose and may share an element never share a block.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sunload {

/// The most that a study may ask for: diffuse reflections, and reflections of a chain of mirrors.
inline constexpr int most_reflections = 1000;

/// A range of blocks.
struct RandomBlocks {
  std::uint32_t first, count;

  constexpr std::uint32_t end() const { return first + count; }
};

/// Whether no two of them have a block in common, and none goes beyond the last.
template <std::size_t N>
constexpr bool are_disjoint(const std::array<RandomBlocks, N>& ranges) {
  for (std::size_t a = 0; a < N; ++a) {
    if (ranges[a].end() < ranges[a].first) return false;
    for (std::size_t b = 0; b < a; ++b)
      if (ranges[a].first < ranges[b].end() && ranges[b].first < ranges[a].end()) return false;
  }
  return true;
}

/// One block for every surface that a chain meets, the one where it is cut included.
inline constexpr std::uint32_t blocks_of_chain = 1024;
static_assert(blocks_of_chain > most_reflections);

/// Of a line, or of a sample that a mirror receives: Purpose::glossy, parallel_light, luminaires,
/// glossy_sun.
namespace line_blocks {
inline constexpr RandomBlocks of_line{0, blocks_of_chain};
/// What the surface that it leaves sends on, where the line says from where light arrives.
inline constexpr RandomBlocks of_mirrored_light{1u << 16, blocks_of_chain};

static_assert(are_disjoint(std::array{of_line, of_mirrored_light}));
}  // namespace line_blocks

/// Of Purpose::shooting.
namespace shot_blocks {
/// Points of samples: the emitters' (iteration 0), then one for every diffuse reflection.
inline constexpr RandomBlocks of_iterations{0, 1u << 11};
static_assert(of_iterations.count > most_reflections);
inline constexpr RandomBlocks of_all_chains{of_iterations.end(),
                                            of_iterations.count* blocks_of_chain};
/// The chain of a sample of this iteration.
constexpr RandomBlocks of_chain(std::uint32_t iteration) {
  return {of_all_chains.first + iteration * blocks_of_chain, blocks_of_chain};
}
/// Light of sky and far ground, and of the sun, that meets mirrors first.
inline constexpr RandomBlocks of_mirrored_sky{1u << 22, blocks_of_chain};
inline constexpr RandomBlocks of_mirrored_sun{1u << 23, blocks_of_chain};

static_assert(are_disjoint(std::array{of_iterations, of_all_chains, of_mirrored_sky,
                                      of_mirrored_sun}));
static_assert(of_chain(of_iterations.count - 1).end() == of_all_chains.end());
}  // namespace shot_blocks

}  // namespace sunload
