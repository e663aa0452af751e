// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Stable numbers for things that have numbers or names: the same over runs and machines.
#pragma once

#include <cstdint>
#include <string_view>

namespace sunload {

/// Spreads the bits of a number over all bits, one to one: the finaliser mix64 of SplitMix64
/// (Steele, Lea & Flood 2014, Fast splittable pseudorandom number generators).
constexpr std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}
/// Of two numbers one key.
constexpr std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  return mixed(a + 0x9e3779b97f4a7c15u * (b + 1));
}

/// FNV-1a of a name, stable over runs and machines.
constexpr std::uint64_t text_key(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace sunload
