// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Uniformly distributed lines of one patch: origin uniform on it, direction
/// with density cosθ/π, both from one Owen-scrambled Sobol sequence.
#pragma once

#include <algorithm>

#include "solver/base/rng.h"
#include "solver/base/sampling.h"
#include "solver/mesh/hierarchy.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// A line's beginning, and its direction: unit, away from the patch.
struct PatchLine {
  Vec3 origin, w;
};

/// Lines side by side.
template <std::size_t lanes>
struct LineColumns {
  alignas(64) double origin[3][lanes];
  alignas(64) double w[3][lanes];

  void put(std::size_t l, const PatchLine& line) {
    origin[0][l] = line.origin.x;
    origin[1][l] = line.origin.y;
    origin[2][l] = line.origin.z;
    w[0][l] = line.w.x;
    w[1][l] = line.w.y;
    w[2][l] = line.w.z;
  }
  PatchLine operator[](std::size_t l) const {
    return {{origin[0][l], origin[1][l], origin[2][l]}, {w[0][l], w[1][l], w[2][l]}};
  }
};
using PacketLines = LineColumns<packet_size>;

/// Lines by their number in the sequence: any of them can be had alone, with the same bits.
class PatchLines {
 public:
  /// Origins keep `offset_m` from the patch; `seeds` scramble the sequence.
  PatchLines(const Hierarchy& h, std::size_t patch, double offset_m, const RandomWords& seeds)
      : a_(h.corner(patch, 0)),
        b_(h.corner(patch, 1)),
        c_(h.corner(patch, 2)),
        n_(h.normal(patch)),
        axes_(tangents(n_)),
        lift_(n_ * offset_m),
        seeds_(seeds) {}

  using Line = PatchLine;
  Line operator[](std::uint32_t index) const {
    return line(sobol(index, 0), sobol(index, 1), sobol(index, 2), sobol(index, 3));
  }
  /// Lines first … first + 15, the same bits, several times as fast; `first` is a multiple of 16.
  void packet(std::size_t first, PacketLines& lines) const;
  /// The line of a Sobol point's coordinates, which are scrambled here.
  Line line(std::uint32_t x0, std::uint32_t x1, std::uint32_t x2, std::uint32_t x3) const {
    return at(scrambled(x0, seeds_[0]), scrambled(x1, seeds_[1]), scrambled(x2, seeds_[2]),
              scrambled(x3, seeds_[3]));
  }
  /// The line of a point of the unit cube: u0 and u1 give the direction, u2 and u3 the origin.
  Line at(double u0, double u1, double u2, double u3) const {
    const Vec3 local = sample_cosine(u0, u1);
    const Barycentric at = sample_triangle(u2, u3);
    return {a_ * at.w0 + b_ * at.w1 + c_ * at.w2 + lift_,
            axes_.tangent * local.x + axes_.bitangent * local.y + n_ * local.z};
  }

 private:
  Vec3 a_, b_, c_, n_;
  Tangents axes_;
  Vec3 lift_;
  RandomWords seeds_;
};

/// Up to 16 consecutive lines of a patch, as rays.
struct LinePacket {
  /// Lines [first, end) or the first 16 of them; `first` is a multiple of 16.
  LinePacket(const PatchLines& lines, std::size_t first, std::size_t end)
      : count(std::min(packet_size, end - first)) {
    PacketLines columns;
    lines.packet(first, columns);
    for (std::size_t l = 0; l < packet_size; ++l) {
      line[l] = columns[l];
      put(origins, l, line[l].origin);
      put(directions, l, line[l].w);
    }
  }
  PacketHits first_hits(const RayCaster& caster) const {
    return caster.first_hits(origins, directions, (1u << count) - 1u);
  }

  std::size_t count;
  PatchLines::Line line[packet_size];
  Packet origins{};
  PacketDirections directions{};
};

/// Seeds of PatchLines by which they are the lines that `trace_lines` casts from a patch.
inline RandomWords line_seeds(const Hierarchy& hierarchy, std::size_t patch,
                              std::size_t realization, std::uint64_t seed) {
  return random_words({.seed = seed,
                       .purpose = Purpose::lines,
                       .realization = static_cast<std::uint32_t>(realization),
                       .element = hierarchy.key()[patch]});
}

}  // namespace sunload
