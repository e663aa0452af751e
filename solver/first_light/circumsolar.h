// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The bright part of a clear sky about the sun, sampled on its own.
///
/// A clear sky holds up to a third of its light within some degrees of the sun, where few of a
/// patch's lines end, and the same few for all suns that stand there. So the radiance of the
/// sky's cells is split,
///
///     L = L_rest + L_circ,
///
/// L_rest stays with the lines, and L_circ is sampled per patch and sun like the sun itself, with
/// density p = L_circ / T, T = ∫ L_circ dω. What it would bring unshaded is known, n·∫ L_circ w dω,
/// and serves as control variate: β is 1 where all of the patch's samples saw the sun itself (with
/// random numbers of their own, hence without bias), else 0:
///
///     E_circ = β n·∫ L_circ w dω + T/n Σ_samples (max(0, n·w) V - β n·w)
///
/// A patch that the sun lights freely has all but no error then. Light that mirrors send is left
/// to the lines alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/first_light/direct_sun.h"

namespace sunload {

/// L_circ of one sun: what exceeds a multiple of the sky's mean radiance near the sun, rounded
/// down to multiples of 1/4096 of its sum: drawing a cell is drawing one of 4096 equal slots.
class CircumsolarSky {
 public:
  /// `radiance`: per cell of the grid [W m-2 sr-1]. There is no L_circ where it would be less
  /// than 0.02 of the sky: overcast and uniform skies cost nothing.
  CircumsolarSky(const SkyGrid& grid, const std::vector<double>& radiance, Vec3 to_sun);

  bool any() const { return !slot_a_.empty(); }
  /// ∫ L_circ dω [W m-2].
  double strength() const { return strength_; }
  /// ∫ L_circ w dω [W m-2].
  Vec3 flux() const { return flux_; }
  /// L_circ of a cell [W m-2 sr-1].
  double radiance(std::size_t cell) const { return any() ? circumsolar_[cell] : 0; }
  /// False only if the whole of L_circ lies behind a surface of that unit normal.
  bool may_light(Vec3 normal) const { return dot(normal, axis_) > -sine_; }

  /// Directions with density p, from scrambled points as fractions x / 2^32.
  struct Samples {
    PacketDirections directions;
    alignas(64) float cos_theta[packet_size];  ///< n·w, of any sign
    std::uint32_t in_front = 0;                ///< bits: cos_theta > 0
  };
  void sample(const ScrambledPoints& points, Vec3 normal, Samples& out) const;

 private:
  double strength_ = 0;
  Vec3 flux_;
  std::vector<double> circumsolar_;
  std::vector<float> slot_a_, slot_b_;  ///< corner of each slot's cell in the grid's square
  float cell_width_ = 0;
  Vec3 axis_;
  double sine_ = 1;  ///< of the half-angle of a cone about axis_ that holds L_circ; 1: no such cone
};

/// Whether a sky of the block has L_circ.
bool any_circumsolar(const std::vector<CircumsolarSky>& skies);

/// Adds the irradiance by L_circ of the block to `into`, with as many samples as the sun gets.
/// `sunlit`: share of each patch that sees the sun ([N][block]). Returns the rays cast. Single
/// values may be below 0 by their error where the sky about a sun that is seen is all but hidden.
std::uint64_t circumsolar_light(const RayCaster& caster, const SunSampler& sampler,
                                std::span<const IntervalLight> block,
                                const std::vector<CircumsolarSky>& skies, const Columns& sunlit,
                                const RaySink& into);

}  // namespace sunload
