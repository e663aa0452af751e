// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/circumsolar.h"

#include <algorithm>
#include <array>
#include <bit>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// The work of one patch for all suns of a block.
class PatchSkies {
 public:
  PatchSkies(const RayCaster& caster, const SunSampler& sampler,
             std::span<const IntervalLight> block, const std::vector<CircumsolarSky>& skies,
             std::size_t realizations)
      : caster_(caster), sampler_(sampler), block_(block), skies_(skies), sum_(realizations) {}

  void run(std::size_t patch, const RaySink& into) {
    const auto geometry = sampler_.geometry(patch);
    face(sampler_.normal(patch));
    const double each = static_cast<double>(sampler_.samples()) / static_cast<double>(sum_.size());
    for (std::size_t k = 0; k < block_.size(); ++k) {
      const CircumsolarView* view = view_of(k);
      if (!view || !sum_seen(geometry, patch, block_[k].number, *view)) continue;
      into.add_all(patch, k, [&](std::size_t r) { return view->irradiance() * sum_[r] / each; });
    }
  }
  std::uint64_t rays = 0;

 private:
  /// Neighbours mostly have the normal of one triangle, and share their views of the skies.
  void face(Vec3 normal) {
    if (normal == normal_) return;
    normal_ = normal;
    looked_.fill(false);
  }
  /// Null where nothing of L_circ is in front.
  const CircumsolarView* view_of(std::size_t k) {
    if (!skies_[k].any() || !skies_[k].may_light(normal_)) return nullptr;
    if (!looked_[k]) views_[k].look(skies_[k], normal_);
    looked_[k] = true;
    return views_[k].irradiance() > 0 ? &views_[k] : nullptr;
  }

  /// Σ V cosθ / q of each realization, in sum_; false where nothing is seen.
  bool sum_seen(const SunSampler::Geometry& geometry, std::size_t patch, std::uint32_t sun,
                const CircumsolarView& view) {
    std::fill(sum_.begin(), sum_.end(), 0);
    sampler_.seed(patch, sun, seeds_, Purpose::circumsolar);
    bool any = false;
    for (std::size_t p = 0; p < sampler_.packets(); ++p) {
      view.sample(sampler_.points(seeds_, p), samples_);
      const std::uint32_t active = sampler_.active(p) & samples_.in_front;
      rays += static_cast<std::uint64_t>(std::popcount(active));
      auto seen = caster_.unoccluded_each(sampler_.origins(geometry, seeds_, p),
                                          samples_.directions, active);
      any = any || seen != 0;
      for (; seen != 0; seen &= seen - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(seen));
        sum_[sampler_.realization(p * packet_size + l)] += static_cast<double>(samples_.weight[l]);
      }
    }
    return any;
  }

  const RayCaster& caster_;
  const SunSampler& sampler_;
  std::span<const IntervalLight> block_;
  const std::vector<CircumsolarSky>& skies_;
  Vec3 normal_;
  std::array<CircumsolarView, block_width> views_;
  std::array<bool, block_width> looked_ = {};
  SunSampler::Seeds seeds_;
  CircumsolarView::Samples samples_;
  std::vector<double> sum_;
};

}  // namespace

std::uint64_t circumsolar_light(const RayCaster& caster, const SunSampler& sampler,
                                std::span<const IntervalLight> block,
                                const std::vector<CircumsolarSky>& skies, const RaySink& into) {
  return ordered_sum(sampler.receivers(), receivers_per_chunk, std::uint64_t{0},
                     [&](std::size_t begin, std::size_t end) {
                       PatchSkies work(caster, sampler, block, skies, into.realizations());
                       for (std::size_t i = begin; i < end; ++i) work.run(i, into);
                       return work.rays;
                     });
}

}  // namespace sunload
