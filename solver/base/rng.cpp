// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/rng.h"

#include <Random123/philox.h>

#include "geo/base/keys.h"
#include "geo/base/vector_code.h"

namespace sunload {

namespace {

// Key of Philox: the study's seed and what the number is for; counter: where it
// is used. The realization sits in the key so that realizations are unrelated.
struct Address {
  std::uint32_t key[2];
  std::uint32_t counter[4];
};

Address address(const RandomKey& key) {
  const std::uint64_t stream = mixed(key.seed, static_cast<std::uint64_t>(key.purpose));
  return {{static_cast<std::uint32_t>(stream) + key.realization,
           static_cast<std::uint32_t>(stream >> 32)},
          {static_cast<std::uint32_t>(key.element), static_cast<std::uint32_t>(key.element >> 32),
           key.sun, key.block}};
}

}  // namespace

RandomWords random_words(const RandomKey& key) {
  const Address a = address(key);
  const r123::Philox4x32 philox;
  const auto words =
      philox({{a.counter[0], a.counter[1], a.counter[2], a.counter[3]}}, {{a.key[0], a.key[1]}});
  return {words[0], words[1], words[2], words[3]};
}

// The same rounds for 16 keys side by side, in the shape that compilers turn
// into vector code; a test holds it against random_words.
SUNLOAD_VECTOR_CODE RandomLanes random_lanes(const RandomKey& key_of_first) {
  constexpr std::uint32_t multiplier_0 = 0xd2511f53, multiplier_1 = 0xcd9e8d57;
  constexpr std::uint32_t weyl_0 = 0x9e3779b9, weyl_1 = 0xbb67ae85;
  const Address a = address(key_of_first);
  RandomLanes lanes;
  alignas(64) std::uint32_t key_0[16];
  std::uint32_t key_1 = a.key[1];
  for (std::uint32_t r = 0; r < 16; ++r) {
    key_0[r] = a.key[0] + r;
    for (int w = 0; w < 4; ++w) lanes.word[w][r] = a.counter[w];
  }
  for (int round = 0; round < 10; ++round) {
    for (int r = 0; r < 16; ++r) {
      const std::uint64_t p0 = std::uint64_t{multiplier_0} * lanes.word[0][r];
      const std::uint64_t p1 = std::uint64_t{multiplier_1} * lanes.word[2][r];
      const auto w1 = lanes.word[1][r], w3 = lanes.word[3][r];
      lanes.word[0][r] = static_cast<std::uint32_t>(p1 >> 32) ^ w1 ^ key_0[r];
      lanes.word[1][r] = static_cast<std::uint32_t>(p1);
      lanes.word[2][r] = static_cast<std::uint32_t>(p0 >> 32) ^ w3 ^ key_1;
      lanes.word[3][r] = static_cast<std::uint32_t>(p0);
      key_0[r] += weyl_0;
    }
    key_1 += weyl_1;
  }
  return lanes;
}

}  // namespace sunload
