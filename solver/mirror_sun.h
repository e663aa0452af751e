/// Direct sun by way of planar mirrors: image directions, noise-free in power.
///
/// A mirror with unit normal m sends the sun from direction s on so that a
/// receiver sees it in the image direction w = s - 2 (s·m) m. A ray along w
/// whose first hit is such a mirror, and from there an unhindered ray along s,
/// bring dni · rho_s · cosθ. One reflection; light that meets a second mirror is
/// received there and booked as cut.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/direct_sun.h"
#include "solver/jacobi.h"
#include "solver/line_follower.h"

namespace sunload {

/// Mirrors of one orientation.
struct MirrorGroup {
  Vec3 normal;
  std::vector<std::int32_t> triangles;
};

/// Fate of sun power that mirrors send on [W], per sun of a block.
struct MirroredSun {
  std::vector<double> escaped = std::vector<double>(block_width, 0);
  std::vector<double> backs = escaped, cut = escaped;
  MirroredSun& operator+=(const MirroredSun& other);
};

class MirrorSun {
 public:
  MirrorSun(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
            const SunSampler& sampler, const PatchOptics& optics, int mirror_depth);
  bool any() const { return !groups_.empty(); }

  /// Adds the mirrored sun of the block to irradiance ([N][block], W m-2), to
  /// `exposure` ([R][N], J m-2) and, if not null, to the columns of each
  /// realization. Returns the rays cast.
  std::uint64_t add_light(std::span<const SunLight> block, Columns& irradiance,
                          std::vector<std::vector<double>>& exposure,
                          std::vector<Columns>* of_realizations) const;

  /// Follows the direct sun that mirror patches receive to where it ends, each
  /// realization with its own samples.
  std::vector<MirroredSun> follow_light(std::span<const SunLight> block,
                                        std::size_t realizations) const;

 private:
  struct Beam;
  class PatchWork;
  const Material& material_of(std::int32_t triangle) const {
    return scene_.materials[scene_.material[static_cast<std::size_t>(triangle)].index()];
  }

  const Scene& scene_;
  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const SunSampler& sampler_;
  const PatchOptics& optics_;
  int mirror_depth_;
  std::vector<MirrorGroup> groups_;
  std::vector<std::int32_t> group_of_side_;  ///< [2·triangle + side], -1: no mirror
};

}  // namespace sunload
