// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Suns of a period as they are seen in mirrors, for a first look.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "solver/mesh/period_light.h"
#include "solver/surface/mirror_groups.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// A sun as it is seen in mirrors of one orientation.
struct SunImage {
  Vec3 direction, sun;
  std::int32_t group;
  double exposure;  ///< normal to the sun, over the probability with which it was chosen
  Tangents axes;    ///< across the direction
  Box mirrors;      ///< around the group, in x and y along the axes, in z along the direction
};

/// The corners of an element, where its rays start.
using RayCorners = std::array<Vec3, 3>;

/// Images of the suns in one mirror each: light that is reflected once.
class SunImages {
 public:
  /// All must outlive it. In few mirrors every sun is looked for in all of them; of more it
  /// chooses some, each half of the light by itself.
  SunImages(const Scene& scene, const RayCaster& caster, const PeriodLight& light,
            std::uint64_t seed);

  bool any() const { return !of_both_.empty() || !of_half_[0].empty() || !of_half_[1].empty(); }
  const std::vector<SunImage>& of_both_halves() const { return of_both_; }
  const std::vector<SunImage>& of_half(std::size_t half) const { return of_half_[half]; }

  /// Adds their light on points between the corners, which face along `normal`, to `sum`, one for
  /// each point of the packet [J m-2].
  void add(const std::vector<SunImage>& images, const RayCorners& corners, const Packet& points,
           Vec3 normal, double* sum) const;

 private:
  /// What rays towards an image meet of its mirrors.
  struct OnMirrors {
    std::int32_t triangle[packet_size];
    Packet points;              ///< off the mirrors
    RayCaster::Shares share{};  ///< of each ray, by what stands before the mirrors
    std::uint32_t rays = 0;     ///< that meet one (bit r: ray r)
  };
  OnMirrors mirrors_met(const SunImage& image, const Packet& from) const;
  void add_images(const PeriodLight& light, const std::vector<PeriodSun>& suns, std::size_t half);
  SunImage image(const PeriodSun& sun, std::size_t group, double probability) const;
  /// Whether rays from between the corners could meet mirrors of the image at all.
  bool can_be_seen(const SunImage& image, const RayCorners& corners) const;

  const Scene& scene_;
  const RayCaster& caster_;
  std::uint64_t seed_;
  bool has_screens_;
  MirrorGroups mirrors_;
  std::vector<double> mirror_area_m2_;  ///< per group
  std::vector<SunImage> of_both_;
  std::array<std::vector<SunImage>, 2> of_half_;
};

}  // namespace sunload
