// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/patch_lines.h"

#include "geo/base/vector_code.h"

namespace sunload {

namespace {

using Coordinates = std::uint32_t[sobol_dimensions][packet_size];

/// Lines as columns.
struct LineColumns {
  alignas(64) double origin[3][packet_size];
  alignas(64) double w[3][packet_size];
};

// In the shape that compilers turn into vector code; `lines` by value, so that stores cannot
// change it.
SUNLOAD_VECTOR_CODE void place_lines(const PatchLines lines, const Coordinates& x,
                                     LineColumns& out) {
  for (std::size_t l = 0; l < packet_size; ++l) {
    const PatchLines::Line line = lines.line(x[0][l], x[1][l], x[2][l], x[3][l]);
    out.origin[0][l] = line.origin.x;
    out.origin[1][l] = line.origin.y;
    out.origin[2][l] = line.origin.z;
    out.w[0][l] = line.w.x;
    out.w[1][l] = line.w.y;
    out.w[2][l] = line.w.z;
  }
}

}  // namespace

void PatchLines::packet(std::size_t first, Line (&lines)[packet_size]) const {
  alignas(64) Coordinates x;
  for (int d = 0; d < sobol_dimensions; ++d)
    sobol_points(static_cast<std::uint32_t>(first), d, x[d]);
  LineColumns columns;
  place_lines(*this, x, columns);
  const auto& [origin, w] = columns;
  for (std::size_t l = 0; l < packet_size; ++l)
    lines[l] = {{origin[0][l], origin[1][l], origin[2][l]}, {w[0][l], w[1][l], w[2][l]}};
}

}  // namespace sunload
