// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/circumsolar.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

// Measured on the built-in street under clear skies, suns from 12° to 40°: with less the samples
// of half-hidden skies have the larger part of the error, with more the lines.
constexpr double cap_by_mean = 3;
constexpr double reach =
    30 * radians_per_degree;          ///< about the sun: a clear horizon is bright, too
constexpr double least_share = 0.02;  ///< of the sky, for its samples to be worth it
constexpr double slots = 4096;

/// SkyGrid::direction in single precision and without branches, in the shape that compilers turn
/// into vector code: sine and cosine by their series, which end below 1e-6 at π/4.
__attribute__((target_clones("default", "avx2", "avx512f"))) void aim(
    const float* a, const float* b, const float* normal, CircumsolarSky::Samples& out) {
  constexpr float quarter_pi = 0.78539816f, least = 1e-20f;
  for (std::size_t s = 0; s < packet_size; ++s) {
    const float size_a = std::fabs(a[s]), size_b = std::fabs(b[s]);
    const float r = size_a > size_b ? size_a : size_b, less = size_a > size_b ? size_b : size_a;
    const float angle = quarter_pi * less / (r + least), square = angle * angle;
    const float sine = angle * (1 - square / 6 * (1 - square / 20 * (1 - square / 42)));
    const float cosine = 1 - square / 2 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56)));
    const float sine_of_zenith = r * std::sqrt(2 - r * r);
    const float across = sine_of_zenith * cosine, along = sine_of_zenith * sine;
    const float x = std::copysign(size_a > size_b ? across : along, a[s]);
    const float y = std::copysign(size_a > size_b ? along : across, b[s]);
    const float z = 1 - r * r;
    out.directions.x[s] = x;
    out.directions.y[s] = y;
    out.directions.z[s] = z;
    out.cos_theta[s] = x * normal[0] + y * normal[1] + z * normal[2];
  }
}

/// Mean of w over a cell: two triangles, since the grid's map has a kink along the square's
/// diagonals, with the three-point rule of degree 2 (Strang & Fix 1973).
Vec3 mean_direction(const SkyGrid& grid, int cell) {
  constexpr double near = 1.0 / 6, far = 2.0 / 3;
  const int middle = grid.side() / 2;
  const bool rising = (cell % grid.side() < middle) == (cell / grid.side() < middle);
  Vec3 sum;
  for (const auto& [u, v] : {std::pair{near, near}, {near, far}, {far, near}}) {
    // The points of the triangle at the origin and of its counterpart, about the other diagonal
    // where the kink is the one from corner to corner through the origin.
    sum += grid.direction(cell, rising ? 1 - u : u, v);
    sum += grid.direction(cell, rising ? u : 1 - u, 1 - v);
  }
  return sum / 6;
}

}  // namespace

CircumsolarSky::CircumsolarSky(const SkyGrid& grid, const std::vector<double>& radiance,
                               Vec3 to_sun) {
  if (radiance.empty()) return;
  double horizontal = 0, projected = 0;
  for (std::size_t c = 0; c < radiance.size(); ++c) {
    horizontal += radiance[c] * grid.projected()[c];
    projected += grid.projected()[c];
  }
  const double cap = cap_by_mean * horizontal / projected;
  std::vector<double> above(radiance.size(), 0);
  const double least_cosine_to_sun = std::cos(reach);
  for (std::size_t c = 0; c < radiance.size(); ++c)
    if (radiance[c] > cap &&
        dot(grid.direction(static_cast<int>(c), 0.5, 0.5), to_sun) > least_cosine_to_sun)
      above[c] = radiance[c] - cap;
  const double excess = std::accumulate(above.begin(), above.end(), 0.0);
  const double all = std::accumulate(radiance.begin(), radiance.end(), 0.0);
  if (excess <= least_share * all) return;

  const double quantum = excess / slots;
  const int size = grid.side();
  cell_width_ = 2.0f / static_cast<float>(size);
  circumsolar_.resize(radiance.size());
  std::vector<Vec3> directions;
  for (int c = 0; c < grid.cell_count(); ++c) {
    const auto at = static_cast<std::size_t>(c);
    const auto count = static_cast<int>(above[at] / quantum);
    circumsolar_[at] = count * quantum;
    strength_ += circumsolar_[at] * grid.solid_angle();
    if (count == 0) continue;
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0}) directions.push_back(grid.direction(c, u, v));
    flux_ += circumsolar_[at] * grid.solid_angle() * mean_direction(grid, c);
    slot_a_.insert(slot_a_.end(), static_cast<std::size_t>(count),
                   static_cast<float>(c % size) * cell_width_ - 1);
    slot_b_.insert(slot_b_.end(), static_cast<std::size_t>(count),
                   static_cast<float>(c / size) * cell_width_ - 1);
  }
  axis_ = normalized(flux_);
  double least_cosine = 1;
  for (const Vec3 w : directions) least_cosine = std::min(least_cosine, dot(w, axis_));
  if (least_cosine > 0) sine_ = std::sqrt(1 - least_cosine * least_cosine);
}

void CircumsolarSky::sample(const ScrambledPoints& points, Vec3 normal, Samples& out) const {
  alignas(64) float a[packet_size], b[packet_size];
  for (std::size_t s = 0; s < packet_size; ++s) {
    // What is left of u after the choice of a slot is uniform again.
    const auto chosen = std::uint64_t{points.u[s]} * slot_a_.size();
    const auto slot = static_cast<std::size_t>(chosen >> 32);
    a[s] = slot_a_[slot] + cell_width_ * uniform(static_cast<std::uint32_t>(chosen));
    b[s] = slot_b_[slot] + cell_width_ * uniform(points.v[s]);
  }
  const float n[3] = {static_cast<float>(normal.x), static_cast<float>(normal.y),
                      static_cast<float>(normal.z)};
  aim(a, b, n, out);
  out.in_front = 0;
  for (std::size_t s = 0; s < packet_size; ++s)
    if (out.cos_theta[s] > 0) out.in_front |= 1u << s;
}

namespace {

/// The work of one patch for all suns of a block.
class PatchSkies {
 public:
  PatchSkies(const RayCaster& caster, const SunSampler& sampler,
             std::span<const IntervalLight> block, const std::vector<CircumsolarSky>& skies,
             const Columns& sunlit, std::size_t realizations)
      : caster_(caster),
        sampler_(sampler),
        block_(block),
        skies_(skies),
        sunlit_(sunlit),
        sum_(realizations) {}

  void run(std::size_t patch, const RaySink& into) {
    const auto geometry = sampler_.geometry(patch);
    const auto R = static_cast<double>(sum_.size());
    const double each = static_cast<double>(sampler_.samples()) / R;
    for (std::size_t k = 0; k < block_.size(); ++k) {
      const CircumsolarSky& sky = skies_[k];
      if (!sky.any() || !sky.may_light(geometry.normal)) continue;
      const double lit = sunlit_[patch * block_width + k] >= 1 ? 1 : 0;
      sum_cosines(geometry, patch, block_[k].number, sky, lit);
      const double unshaded = dot(geometry.normal, sky.flux());
      into.add_all(patch, k, block_[k].length_s,
                   [&](std::size_t r) { return lit * unshaded + sky.strength() * sum_[r] / each; });
    }
  }
  std::uint64_t rays = 0;

 private:
  /// Σ (max(0, n·w) V - lit n·w) of each realization, in sum_.
  void sum_cosines(const SunSampler::Geometry& geometry, std::size_t patch, std::uint32_t sun,
                   const CircumsolarSky& sky, double lit) {
    std::fill(sum_.begin(), sum_.end(), 0);
    sampler_.seed(patch, sun, seeds_, Purpose::circumsolar);
    for (std::size_t p = 0; p < sampler_.packets(); ++p) {
      sky.sample(sampler_.points(seeds_, p), geometry.normal, samples_);
      const auto all = sampler_.active(p), active = all & samples_.in_front;
      const auto realization = [&](std::size_t l) {
        return sampler_.realization(p * packet_size + l);
      };
      if (lit > 0)
        for (std::size_t l = 0; l < static_cast<std::size_t>(std::popcount(all)); ++l)
          sum_[realization(l)] -= lit * static_cast<double>(samples_.cos_theta[l]);
      if (active == 0) continue;
      rays += static_cast<std::uint64_t>(std::popcount(active));
      auto bits = caster_.unoccluded_each(sampler_.origins(geometry, seeds_, p),
                                          samples_.directions, active);
      for (; bits != 0; bits &= bits - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(bits));
        sum_[realization(l)] += static_cast<double>(samples_.cos_theta[l]);
      }
    }
  }

  const RayCaster& caster_;
  const SunSampler& sampler_;
  std::span<const IntervalLight> block_;
  const std::vector<CircumsolarSky>& skies_;
  const Columns& sunlit_;
  SunSampler::Seeds seeds_;
  CircumsolarSky::Samples samples_;
  std::vector<double> sum_;
};

}  // namespace

bool any_circumsolar(const std::vector<CircumsolarSky>& skies) {
  return std::any_of(skies.begin(), skies.end(), [](const CircumsolarSky& s) { return s.any(); });
}

std::uint64_t circumsolar_light(const RayCaster& caster, const SunSampler& sampler,
                                std::span<const IntervalLight> block,
                                const std::vector<CircumsolarSky>& skies, const Columns& sunlit,
                                const RaySink& into) {
  return ordered_sum(sampler.receivers(), receivers_per_chunk, std::uint64_t{0},
                     [&](std::size_t begin, std::size_t end) {
                       PatchSkies work(caster, sampler, block, skies, sunlit, into.realizations());
                       for (std::size_t i = begin; i < end; ++i) work.run(i, into);
                       return work.rays;
                     });
}

}  // namespace sunload
