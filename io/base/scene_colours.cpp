// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/scene_colours.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "geo/base/check.h"

namespace sunload {
namespace {

constexpr Colour of_rgb(std::uint32_t rgb) {
  constexpr double largest = 255;
  return {((rgb >> 16U) & 0xffU) / largest, ((rgb >> 8U) & 0xffU) / largest,
          (rgb & 0xffU) / largest};
}

// What plans and models mostly give them: plaster, tiles, grass, glass, concrete.
constexpr std::array<Colour, surface_colour_count> surfaces{of_rgb(0xc9b3d6), of_rgb(0xeadfc6),
                                                            of_rgb(0xc46a50), of_rgb(0xb5c49c),
                                                            of_rgb(0x6fa9d8), of_rgb(0x9b9ba1)};
constexpr std::array<Colour, 7> basic{of_rgb(0xd9a441), of_rgb(0x7cc4ea), of_rgb(0x45b592),
                                      of_rgb(0xe5dc6a), of_rgb(0x4a90c4), of_rgb(0xdc8b55),
                                      of_rgb(0xd79bbf)};
constexpr std::array<double, 3> shares{1, 0.72, 0.5};
static_assert(basic.size() * shares.size() == material_colour_count);

/// A hash of the name (Fowler, Noll & Vo 1991, FNV-1a).
std::size_t claim_of(const std::string& name) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return static_cast<std::size_t>(hash % material_colour_count);
}

}  // namespace

Colour surface_colour(std::size_t kind) {
  SUNLOAD_EXPECT(kind < surfaces.size(), "a kind of surface");
  return surfaces[kind];
}

std::vector<std::size_t> material_colours(const std::vector<std::string>& names) {
  std::vector<std::size_t> by_name(names.size()), of(names.size());
  std::iota(by_name.begin(), by_name.end(), std::size_t{0});
  std::ranges::stable_sort(by_name, {}, [&](std::size_t i) { return names[i]; });
  std::array<std::size_t, material_colour_count> taken{};
  for (std::size_t n = 0; n < by_name.size(); ++n) {
    const std::size_t rounds = n / material_colour_count;
    std::size_t at = claim_of(names[by_name[n]]);
    while (taken[at] > rounds) at = (at + 1) % material_colour_count;
    ++taken[at];
    of[by_name[n]] = at;
  }
  return of;
}

Colour material_colour(std::size_t number) {
  const std::size_t k = number % material_colour_count;
  const Colour colour = basic[k % basic.size()];
  const double share = shares[k / basic.size()];
  return {share * colour.red, share * colour.green, share * colour.blue};
}

}  // namespace sunload
