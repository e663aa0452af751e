#include "solver/patch_lines.h"

namespace sunload {

// In the shape that compilers turn into vector code.
__attribute__((target_clones("default", "avx2", "avx512f"))) void PatchLines::packet(
    std::size_t first, Line (&lines)[packet_size]) const {
  alignas(64) std::uint32_t x[sobol_dimensions][packet_size];
  for (int d = 0; d < sobol_dimensions; ++d)
    sobol_points(static_cast<std::uint32_t>(first), d, x[d]);
  alignas(64) double origin[3][packet_size], w[3][packet_size];
  const PatchLines self = *this;  // in registers: stores below cannot change it
  for (std::size_t l = 0; l < packet_size; ++l) {
    const Line one = self.line(x[0][l], x[1][l], x[2][l], x[3][l]);
    origin[0][l] = one.origin.x;
    origin[1][l] = one.origin.y;
    origin[2][l] = one.origin.z;
    w[0][l] = one.w.x;
    w[1][l] = one.w.y;
    w[2][l] = one.w.z;
  }
  for (std::size_t l = 0; l < packet_size; ++l)
    lines[l] = {{origin[0][l], origin[1][l], origin[2][l]}, {w[0][l], w[1][l], w[2][l]}};
}

}  // namespace sunload
