/// Uniformly distributed lines of one patch: origin uniform on it, direction
/// with density cosθ/π, both from one Owen-scrambled Sobol sequence.
#pragma once

#include <algorithm>

#include "solver/hierarchy.h"
#include "solver/ray_caster.h"
#include "solver/rng.h"
#include "solver/sampling.h"

namespace sunload {

class PatchLines {
 public:
  /// Origins keep `offset_m` from the patch; `seeds` scramble the sequence.
  PatchLines(const Hierarchy& h, std::size_t patch, double offset_m, const RandomWords& seeds)
      : a_(h.corner(patch, 0)), b_(h.corner(patch, 1)), c_(h.corner(patch, 2)),
        n_(h.normal(patch)), axes_(tangents(n_)), lift_(n_ * offset_m), seeds_(seeds) {}

  struct Line {
    Vec3 origin, w;  ///< w: unit, away from the patch
  };
  Line operator[](std::uint32_t index) const {
    double x[sobol_dimensions];
    for (int d = 0; d < sobol_dimensions; ++d)
      x[d] = scrambled_sobol(index, d, seeds_);
    const Vec3 local = sample_cosine(x[0], x[1]);
    const Barycentric at = sample_triangle(x[2], x[3]);
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
  /// Lines [first, end) or the first 16 of them.
  LinePacket(const PatchLines& lines, std::size_t first, std::size_t end)
      : count(std::min(packet_size, end - first)) {
    for (std::size_t l = 0; l < count; ++l) {
      line[l] = lines[static_cast<std::uint32_t>(first + l)];
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

/// Scrambling that makes them the lines that `trace_lines` casts from a patch.
inline RandomWords line_seeds(const Hierarchy& hierarchy, std::size_t patch,
                              std::size_t realization, std::uint64_t seed) {
  return random_words({.seed = seed,
                       .purpose = Purpose::lines,
                       .realization = static_cast<std::uint32_t>(realization),
                       .element = hierarchy.key()[patch]});
}

}  // namespace sunload
