// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What one side of an element sees in a first look (solver/mesh/mesh_pilot.h), as far as it is the
/// same whatever the surfaces are made of: suns, sky and far ground, and which elements stand
/// before them. Pilots that have one light and one ray caster share it.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/base/rng.h"
#include "solver/base/sampling.h"
#include "solver/mesh/element_forest.h"
#include "solver/mesh/period_light.h"
#include "solver/mesh/sun_images.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// Halves of the light, sampled independently: the covariance of what both bring to the points has
/// no part of the sampling in it.
inline constexpr std::size_t halves_of_light = 2;

/// Where light is asked for on one side of an element: packets of points, off the surface, and the
/// random numbers of what they ask.
struct PilotPoints {
  std::size_t element;
  Vec3 normal;
  Tangents axes;
  double area_m2;
  RandomWords direction_seeds[halves_of_light];
  RandomWords emitter_seeds[halves_of_light];
  RandomWords beam_seeds;
  RayCorners corners;  ///< of the element, off the surface as well
  std::vector<Packet> packets;

  /// `side`: 0 front, 1 back. A packet for every 256 areas of `min_area_m2`, eight at most.
  PilotPoints(const ElementForest& forest, std::size_t on, std::uint8_t side, double offset_m,
              double min_area_m2, std::uint64_t seed);
  std::size_t count() const { return packets.size() * packet_size; }
};

/// What is seen from there.
class PilotSight {
 public:
  /// Which element, and its side: 2·element + side of the forest; none: nothing that reflects.
  using SideOfElement = std::int32_t;
  static constexpr SideOfElement none = -1;
  /// Directions per half in which surroundings are seen, and points of a packet that see them: the
  /// first in each quarter of the element, for all others there. Shadows have edges, but what the
  /// sky and other surfaces send hardly bends inside of an element: of light that rises evenly,
  /// four such points have the variance that sixteen have.
  static constexpr std::uint32_t directions_per_half = 8, quarters = 4;
  /// Of point r of a packet the first in its quarter.
  static constexpr std::size_t first_in_quarter_of(std::size_t r);

  /// Cost: 16 rays for every packet and sun that the side faces, and 64 for the surroundings.
  PilotSight(const ElementForest& forest, const RayCaster& caster, const PeriodLight& light,
             const SkyGrid& grid, PilotPoints from);

  const PilotPoints& points() const { return points_; }
  bool sees_sun() const { return sees_sun_; }
  double largest_cosine() const { return largest_cosine_; }  ///< of the suns that some point sees
  /// Straight from suns, sky and far ground, at each point [J m-2].
  const std::vector<double>& straight(std::size_t half) const { return straight_[half]; }
  /// Of each point the mean of what `radiosity` tells of the sides of elements that it sees, over
  /// all directions.
  template <class Radiosity>
  void add_reflected(std::size_t half, const Radiosity& radiosity, double* at_point) const;

 private:
  static constexpr std::uint32_t rays_per_packet = directions_per_half * quarters;

  void add_suns(const RayCaster& caster, const std::vector<PeriodSun>& suns, std::size_t packet,
                double* sum);
  void see_surroundings(const ElementForest& forest, const RayCaster& caster,
                        const PeriodLight& light, const SkyGrid& grid, std::size_t packet,
                        std::size_t half);

  PilotPoints points_;
  bool sees_sun_ = false;
  double largest_cosine_ = 0;
  std::array<std::vector<double>, halves_of_light> straight_;
  std::array<std::vector<SideOfElement>, halves_of_light> seen_;  ///< by packet, direction, quarter
};

/// The bits of its index and of the index' sum of digits tell in which half of the first two
/// coordinates a point of Sobol's lies, whatever the scrambling (Sobol 1967): the first four lie in
/// a quarter each.
constexpr std::size_t PilotSight::first_in_quarter_of(std::size_t r) {
  const auto half = [](std::size_t of) { return std::popcount(of) % 2; };
  std::size_t first = 0;
  while (first % 2 != r % 2 || half(first) != half(r)) ++first;
  return first;
}

template <class Radiosity>
void PilotSight::add_reflected(std::size_t half, const Radiosity& radiosity,
                               double* at_point) const {
  for (std::size_t p = 0; p < points_.packets.size(); ++p) {
    std::array<double, quarters> of_quarter{};
    for (std::size_t ray = 0; ray < rays_per_packet; ++ray)
      if (const auto seen = seen_[half][p * rays_per_packet + ray]; seen != none)
        of_quarter[ray % quarters] += radiosity(seen) / directions_per_half;
    for (std::size_t r = 0; r < packet_size; ++r)
      at_point[p * packet_size + r] += of_quarter[first_in_quarter_of(r)];
  }
}

}  // namespace sunload
