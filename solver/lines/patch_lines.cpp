// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/patch_lines.h"

#include "geo/base/vector_code.h"

namespace sunload {

namespace {

using Coordinates = std::uint32_t[sobol_dimensions][packet_size];

// In the shape that compilers turn into vector code; `lines` by value, so that stores cannot
// change it.
SUNLOAD_VECTOR_CODE void place_lines(const PatchLines lines, const Coordinates& x,
                                     PacketLines& out) {
  for (std::size_t l = 0; l < packet_size; ++l)
    out.put(l, lines.line(x[0][l], x[1][l], x[2][l], x[3][l]));
}

}  // namespace

void PatchLines::packet(std::size_t first, PacketLines& lines) const {
  alignas(64) Coordinates x;
  for (int d = 0; d < sobol_dimensions; ++d)
    sobol_points(static_cast<std::uint32_t>(first), d, x[d]);
  place_lines(*this, x, lines);
}

}  // namespace sunload
