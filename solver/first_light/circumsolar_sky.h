// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The bright part of a clear sky about the sun as a source of its own.
///
/// The radiance of the sky's cells is split, L = L_rest + L_circ. L_rest stays with the lines,
/// L_circ is sampled per receiver, for all suns of a block together
/// (solver/first_light/circumsolar.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/first_light/direct_sun.h"
#include "solver/light/band.h"
#include "solver/light/sun_block.h"

namespace sunload {

/// L_circ of one sun: what exceeds a multiple of the sky's mean radiance near the sun.
class CircumsolarSky {
 public:
  /// Of the light's sky. There is no L_circ where it would be less than 0.02 of the sky: overcast
  /// and uniform skies cost nothing. Where the light has bands, no band has less than its share of
  /// L_circ in any cell: what it leaves to the lines is ≥ 0.
  CircumsolarSky(const SkyGrid& grid, const IntervalLight& light);

  bool any() const { return !brightness_.empty(); }
  /// ∫ L_circ dω [W m-2].
  double strength() const { return strength_; }
  /// L_circ of a cell [W m-2 sr-1].
  double radiance(std::size_t cell) const { return any() ? circumsolar_[cell] : 0; }
  /// L_circ of a band relative to the broadband one: 1 in the mean of all bands, so that their mean
  /// is broadband light, line by line.
  double band_factor(std::size_t band) const { return band_factors_[band]; }
  /// False only if the whole of L_circ lies behind a surface of that unit normal.
  bool may_light(Vec3 normal) const { return dot(normal, axis_) > -sine_; }

 private:
  friend class CircumsolarView;
  friend class CircumsolarMixture;
  CircumsolarSky() = default;
  void add_cell(const SkyGrid& grid, int cell);
  void add_cell_of(const CircumsolarSky& other, std::size_t c, float brightness);
  void find_cone();

  double strength_ = 0;
  std::vector<double> circumsolar_;  ///< per cell of the grid
  std::array<double, band_count> band_factors_;
  // Of the cells with L_circ, neighbours near each other:
  std::vector<std::uint32_t> place_;             ///< in that order
  std::vector<float> brightness_;                ///< share of the strength
  std::vector<float> a_, b_;                     ///< lower corner in the grid's square
  std::array<std::vector<float>, 4> x_, y_, z_;  ///< directions of the corners (0, 0), (1, 0), …
  float cell_width_ = 0;
  Vec3 axis_;
  double sine_ = 1;  ///< of the half-angle of a cone about axis_ that holds L_circ; 1: no such cone
};

/// Whether a sky of the block has L_circ.
bool any_circumsolar(const std::vector<CircumsolarSky>& skies);

/// Skies of suns that follow each other in a block as one, from which samples for all of them are
/// drawn: S = Σ L_circ / ∫ L_circ dω, each weighed as the others (the balance heuristic: Veach &
/// Guibas 1995, Optimally combining sampling techniques). A direction that is drawn in proportion
/// to S stands for L_circ / S of each sky.
class CircumsolarMixture {
 public:
  /// Of `count` skies from `first` on, some of which may have no L_circ.
  CircumsolarMixture(std::span<const CircumsolarSky> skies, std::size_t first, std::size_t count);
  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }
  /// S [sr-1].
  const CircumsolarSky& sky() const { return sky_; }
  /// L_circ / S of each sky, from the first on [W m-2], in a cell of S, by its place among those
  /// that it has; 0 behind the last one.
  std::span<const float, block_width> of_skies(std::size_t place) const {
    return std::span<const float, block_width>(of_skies_.data() + place * block_width, block_width);
  }
  /// So many times the samples of one sky must be drawn: as many as leave none with a larger mean
  /// square than by samples of its own, and no fewer than a quarter of these all together: errors
  /// of hours that rest on the same samples do not average out. 0 where there is no L_circ.
  double samples_needed() const { return samples_needed_; }

 private:
  std::size_t first_, count_;
  CircumsolarSky sky_;
  std::vector<float> of_skies_;
  double samples_needed_ = 0;
};

/// All skies of a block; neighbours in one mixture where fewer samples serve them so.
std::vector<CircumsolarMixture> circumsolar_mixtures(std::span<const CircumsolarSky> skies);

/// L_circ as a surface of one normal faces it: directions are drawn in proportion to L_circ·q, with
/// q all but the cosine to the normal.
///
/// A cell is chosen by its share of ∫ L_circ q dω, a place in it by q, which is bilinear between
/// the cosines at the cell's corners (Shirley et al. 1991; PBRT 4e, 2.4). Surfaces that lie across
/// a cell's horizon have q ≥ 0.01 in it, so that no direction in front is left out.
class CircumsolarView {
 public:
  /// Cost: some operations per cell with L_circ, of which there are a few hundred.
  void look(const CircumsolarSky& sky, Vec3 normal);
  /// ∫ L_circ q dω [W m-2]: what a sample stands for.
  double irradiance() const { return irradiance_; }

  /// Up to 16 directions with the weight of each.
  struct Samples {
    PacketDirections directions;
    alignas(64) float weight[packet_size];        ///< cosθ / q, 0 behind the surface
    alignas(64) std::uint32_t cell[packet_size];  ///< place among the cells with L_circ
    std::uint32_t in_front = 0;                   ///< bits: weight > 0
  };
  /// Directions from scrambled points as fractions x / 2^32. Not where `irradiance` is 0.
  void sample(const ScrambledPoints& points, Samples& out) const;

 private:
  const CircumsolarSky* sky_ = nullptr;
  float normal_[3] = {};
  double irradiance_ = 0;
  std::vector<std::int32_t> share_;  ///< of each cell, in units of 2^-31 · strength
  /// Sums of the shares up to and with each cell, filled up to a power of two.
  std::vector<std::uint32_t> sums_;
  std::vector<float> q_[4];  ///< at the corners of each cell
};

}  // namespace sunload
