// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/scene_colours.h"

#include <array>
#include <cstdint>

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

}  // namespace

Colour surface_colour(std::size_t kind) {
  SUNLOAD_EXPECT(kind < surfaces.size(), "a kind of surface");
  return surfaces[kind];
}

Colour material_colour(std::size_t material) {
  const std::size_t k = material % material_colour_count;
  const Colour colour = basic[k % basic.size()];
  const double share = shares[k / basic.size()];
  return {share * colour.red, share * colour.green, share * colour.blue};
}

}  // namespace sunload
