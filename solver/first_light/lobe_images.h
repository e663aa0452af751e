// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sun's images in glossy surfaces of narrow lobes, looked for from points of patches and from
/// sensors: in place of what their lines bring (solver/first_light/glossy_sun.h), few of which meet
/// such lobes.
///
/// A surface of normal n is seen brightest along the image direction m = s - 2 (s·n) n of the sun,
/// and along w its lobe is proportional to (w·m)^e. So M directions are drawn with the density
/// p = (e+1)/(2π) (w·m)^e; where one first meets a surface of that orientation and material, a
/// shadow ray asks for the sun:
///
///     E = 1/M Σ f_r (s·n) cosθ dni visible / p
///
/// which is the same for all of them but for cosθ and (s·n). Lobes are narrow where such directions
/// are denser about m than the L lines can be: M (e+1)/(2π) > L/π. Light that reaches a receiver by
/// way of another mirror or lobe is the lines', as is all of it where narrow lobes face in more
/// than 4096 directions, for patches 512. Each sample of a sun with a disk has an s of its own;
/// (s·n) stays that of the centre. Cost: up to 2 M rays for each receiver, sun and orientation in
/// sight.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "solver/base/orientation_index.h"
#include "solver/first_light/mirror_sun.h"
#include "solver/lines/lines.h"

namespace sunload {

class LobeImages {
 public:
  /// For receivers with lines by these rules. Everything must outlive it.
  LobeImages(const Scene& scene, const RayCaster& caster, const SunSampler& receivers,
             const LineRules& rules);

  /// Whether images bring what the glimpse would.
  bool stand_for(const Glimpse& glimpse) const;
  /// As MirrorSun::add_light.
  std::uint64_t add_light(std::span<const IntervalLight> block, const RaySink& into) const;

 private:
  class Receiver;
  /// Surfaces of one material that share their images.
  struct Orientation {
    Vec3 normal;
    MaterialId material;
    double exponent;
    double reach;    ///< angle from an image beyond which the lobe is not looked for
    double apart;    ///< sine of the angle by which normals of its surfaces may differ from its own
    Vec3 low, high;  ///< box about them
  };
  /// `of_material`: the orientations of each material that has any.
  void add_side(std::size_t triangle, bool front,
                std::map<std::size_t, OrientationIndex>& of_material);
  bool is_narrow(const Material& m) const {
    return m.glossy > 0 && m.glossy_exponent >= least_exponent_;
  }

  const Scene& scene_;
  const RayCaster& caster_;
  const SunSampler& receivers_;
  double least_exponent_, samples_each_;
  std::vector<Orientation> orientations_;
  std::vector<std::int32_t> of_side_;  ///< [2·triangle + back]; -1: no narrow lobe
};

}  // namespace sunload
