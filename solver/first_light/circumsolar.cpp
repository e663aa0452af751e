// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/circumsolar.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// Σ V (L_circ/S) cosθ / q of a realization, of each sun.
using SunSums = std::array<float, block_width>;

SUNLOAD_VECTOR_CODE void add_weighed(float weight, const float* __restrict of_skies,
                                     float* __restrict sums) {
  for (std::size_t k = 0; k < block_width; ++k) sums[k] += weight * of_skies[k];
}

/// The work of one patch for all suns of a mixture.
class PatchSkies {
 public:
  PatchSkies(const RayCaster& caster, const SunSampler& sampler, const CircumsolarMixture& mixture,
             std::uint32_t number, std::size_t realizations)
      : caster_(caster),
        sampler_(sampler),
        mixture_(mixture),
        sums_(realizations),
        number_(number) {}

  void run(std::size_t patch, const RaySink& into) {
    const Vec3 normal = sampler_.normal(patch);
    if (!mixture_.sky().may_light(normal)) return;
    face(normal);
    if (view_.irradiance() <= 0 || !sum_seen(patch)) return;
    const double of_sample = view_.irradiance() * static_cast<double>(sums_.size()) /
                             static_cast<double>(sampler_.samples());
    for (std::size_t k = 0; k < mixture_.count(); ++k)
      if (std::ranges::any_of(sums_, [&](const SunSums& sums) { return sums[k] > 0; }))
        into.add_all(patch, mixture_.first() + k,
                     [&](std::size_t r) { return of_sample * static_cast<double>(sums_[r][k]); });
  }
  std::uint64_t rays() const { return rays_; }

 private:
  /// Neighbours mostly have the normal of one triangle, and share their view of the skies.
  void face(Vec3 normal) {
    if (normal == normal_) return;
    normal_ = normal;
    view_.look(mixture_.sky(), normal);
  }

  /// Puts together `sums_`; false where nothing is seen.
  bool sum_seen(std::size_t patch) {
    const auto geometry = sampler_.geometry(patch);
    std::fill(sums_.begin(), sums_.end(), SunSums{});
    sampler_.seed(patch, number_, seeds_, Purpose::circumsolar);
    bool any = false;
    for (std::size_t p = 0; p < sampler_.packets(); ++p) {
      view_.sample(sampler_.points(seeds_, p), samples_);
      const std::uint32_t active = sampler_.active(p) & samples_.in_front;
      rays_ += static_cast<std::uint64_t>(std::popcount(active));
      const auto shares =
          caster_.passed_each(sampler_.origins(geometry, seeds_, p), samples_.directions, active);
      for (auto bits = active; bits != 0; bits &= bits - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(bits));
        if (shares[l] <= 0) continue;
        any = true;
        add_weighed(shares[l] * samples_.weight[l], mixture_.of_skies(samples_.cell[l]).data(),
                    sums_[sampler_.realization(p * packet_size + l)].data());
      }
    }
    return any;
  }

  CircumsolarView::Samples samples_;
  std::uint64_t rays_ = 0;
  const RayCaster& caster_;
  const SunSampler& sampler_;
  const CircumsolarMixture& mixture_;
  Vec3 normal_;
  std::vector<SunSums> sums_;
  SunSampler::Seeds seeds_;
  CircumsolarView view_;
  std::uint32_t number_;
};

}  // namespace

std::uint64_t circumsolar_light(const RayCaster& caster, const SunSampler& sampler,
                                std::span<const IntervalLight> block,
                                const std::vector<CircumsolarSky>& skies, const RaySink& into) {
  std::uint64_t rays = 0;
  for (const CircumsolarMixture& mixture : circumsolar_mixtures(skies)) {
    if (mixture.samples_needed() <= 0) continue;
    constexpr double rounding = 1e-6;  // of what one by itself needs
    const SunSampler of_all = sampler.with_samples(
        static_cast<std::size_t>(std::ceil(mixture.samples_needed() - rounding)));
    const std::uint32_t number = block[mixture.first()].number;
    rays += ordered_sum(of_all.receivers(), receivers_per_chunk, std::uint64_t{0},
                        [&](std::size_t begin, std::size_t end) {
                          PatchSkies work(caster, of_all, mixture, number, into.realizations());
                          for (std::size_t i = begin; i < end; ++i) work.run(i, into);
                          return work.rays();
                        });
  }
  return rays;
}

}  // namespace sunload
