// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers by address: published vectors, lanes, independence of keys.

#include "solver/base/rng.h"
#include "geo/base/keys.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

/// Inverse of an odd number modulo 2^64, by Newton's iteration (each step doubles the bits).
constexpr std::uint64_t inverse(std::uint64_t odd) {
  std::uint64_t x = odd;
  for (int step = 0; step < 6; ++step) x *= 2 - odd * x;
  return x;
}

/// The x with x ^ (x >> shift) = y.
constexpr std::uint64_t unshifted(std::uint64_t y, int shift) {
  std::uint64_t x = y;
  for (int done = shift; done < 64; done += shift) x = y ^ (x >> shift);
  return x;
}

/// The a with mixed(a, b) = z: the finalizer is a bijection.
constexpr std::uint64_t unmixed(std::uint64_t z, std::uint64_t b) {
  z = unshifted(z, 31) * inverse(0x94d049bb133111ebu);
  z = unshifted(z, 27) * inverse(0xbf58476d1ce4e5b9u);
  return unshifted(z, 30) - 0x9e3779b97f4a7c15u * (b + 1);
}

/// The address that Philox sees with this counter and key.
RandomKey key_for(const RandomWords& counter, std::uint32_t key_0, std::uint32_t key_1) {
  const std::uint64_t stream = std::uint64_t{key_1} << 32 | key_0;
  return {.seed = unmixed(stream, static_cast<std::uint64_t>(Purpose::lines)),
          .purpose = Purpose::lines,
          .realization = 0,
          .element = std::uint64_t{counter[1]} << 32 | counter[0],
          .sun = counter[2],
          .block = counter[3]};
}

// Known answers of Philox4x32-10, published with Random123 (kat_vectors).
TEST(RandomWords, AreThePublishedOnesOfPhilox) {
  constexpr std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(random_words(key_for({0, 0, 0, 0}, 0, 0)),
            (RandomWords{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(random_words(key_for({ones, ones, ones, ones}, ones, ones)),
            (RandomWords{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(random_words(
                key_for({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0xa4093822, 0x299f31d0)),
            (RandomWords{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomLanes, AreTheWordsOfSixteenRealizations) {
  // The last key ends just below 2^32, where the realization makes it wrap.
  for (const auto& first : {RandomKey{},
                            RandomKey{.seed = 77,
                            .purpose = Purpose::direct_sun,
                            .realization = 16,
                            .element = 0x123456789abcdefu,
                            .sun = 4399,
                            .block = 3},
                            key_for({1, 2, 3, 4}, 0xfffffff8, 5)}) {
    const RandomLanes lanes = random_lanes(first);
    for (std::uint32_t r = 0; r < 16; ++r) {
      RandomKey key = first;
      key.realization += r;
      const RandomWords words = random_words(key);
      for (std::size_t w = 0; w < 4; ++w) EXPECT_EQ(lanes.word[w][r], words[w]) << r << " " << w;
    }
  }
}

/// Bits in which the words of two addresses differ, over many elements.
template <class Change>
double differing_bits(int elements, Change&& change) {
  int bits = 0;
  for (int e = 0; e < elements; ++e) {
    RandomKey key{.seed = 5, .realization = 2, .element = static_cast<std::uint64_t>(e), .sun = 7};
    const RandomWords a = random_words(key);
    change(key);
    const RandomWords b = random_words(key);
    for (std::size_t w = 0; w < 4; ++w) bits += std::popcount(a[w] ^ b[w]);
  }
  return bits;
}

// Words of unrelated addresses differ in half of their bits.
TEST(RandomWords, OfDifferentAddressesAreUnrelated) {
  constexpr int elements = 4096;
  constexpr double bits = 128.0 * elements;
  const CountInterval half = accepted_counts(bits, 0.5, 6);
  EXPECT_TRUE(half.contains(differing_bits(elements, [](RandomKey& k) { ++k.seed; })));
  EXPECT_TRUE(half.contains(
      differing_bits(elements, [](RandomKey& k) { k.purpose = Purpose::mesh_pilot; })));
  EXPECT_TRUE(half.contains(differing_bits(elements, [](RandomKey& k) { ++k.realization; })));
  EXPECT_TRUE(half.contains(differing_bits(elements, [](RandomKey& k) { k.element += 1u << 20; })));
  EXPECT_TRUE(half.contains(differing_bits(elements, [](RandomKey& k) { ++k.sun; })));
  EXPECT_TRUE(half.contains(differing_bits(elements, [](RandomKey& k) { ++k.block; })));
  // Planted fault: the sun is left out of every second address.
  EXPECT_FALSE(
      half.contains(differing_bits(elements, [](RandomKey& k) { k.sun += k.element % 2; })));
}

TEST(RandomWords, NeverMeetAgain) {
  std::set<RandomWords> seen;
  std::size_t addresses = 0;
  for (const auto purpose :
       {Purpose::lines, Purpose::direct_sun, Purpose::mirror_sun, Purpose::mesh_pilot})
    for (std::uint32_t r = 0; r < 16; ++r)
      for (std::uint64_t e = 0; e < 16; ++e)
        for (std::uint32_t sun = 0; sun < 16; ++sun, ++addresses)
          seen.insert(random_words(
              {.seed = 1, .purpose = purpose, .realization = r, .element = e, .sun = sun}));
  EXPECT_EQ(seen.size(), addresses);
}

/// Cells (input bit, output bit) whose rate of change is not one half.
template <class Mix>
int uneven_cells(Mix&& mix) {
  constexpr int inputs = 4096;
  const CountInterval half = accepted_counts(inputs, 0.5, 64 * 64);
  std::vector<int> changes(64 * 64, 0);
  for (int i = 0; i < inputs; ++i) {
    const RandomWords words = random_words({.seed = 9, .element = static_cast<std::uint64_t>(i)});
    const std::uint64_t x = std::uint64_t{words[0]} << 32 | words[1];
    for (std::size_t in = 0; in < 64; ++in) {
      const std::uint64_t difference = mix(x) ^ mix(x ^ (std::uint64_t{1} << in));
      for (std::size_t out = 0; out < 64; ++out)
        changes[in * 64 + out] += static_cast<int>(difference >> out & 1u);
    }
  }
  int uneven = 0;
  for (const int c : changes) uneven += half.contains(c) ? 0 : 1;
  return uneven;
}

TEST(Mixed, EveryInputBitChangesHalfOfTheOutputBits) {
  EXPECT_EQ(uneven_cells([](std::uint64_t x) { return mixed(x, 3); }), 0);
  EXPECT_EQ(uneven_cells([](std::uint64_t x) { return mixed(3, x); }), 0);
  // Planted fault: one multiplication alone never carries to lower bits.
  EXPECT_GT(uneven_cells([](std::uint64_t x) { return x * 0xbf58476d1ce4e5b9u; }), 0);
}

TEST(Mixed, InverseOfTheTestIsRight) {
  for (std::uint64_t a : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}})
    EXPECT_EQ(unmixed(mixed(a, 2), 2), a);
}

TEST(Uniform, LiesInZeroToBelowOne) {
  EXPECT_EQ(uniform(0), 0.0f);
  EXPECT_EQ(uniform(0x80000000), 0.5f);
  EXPECT_EQ(uniform(0xffffffff), 1.0f - 1.0f / (1 << 24));
}

}  // namespace
}  // namespace sunload::test
