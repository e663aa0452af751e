// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/glossy_sun.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geo/base/keys.h"
#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/random_blocks.h"
#include "solver/base/sampling.h"
#include "solver/base/threads.h"
#include "solver/surface/lobe.h"

namespace sunload {

namespace {

// Glimpses so far out in the lobe are not asked: what they would bring, relative to one in
// the lobe's middle, is below the rounding of the float series.
constexpr double least_glimpse = 1e-8;

}  // namespace

GlossySun::GlossySun(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                     const SunSampler& sampler, const PatchOptics& optics, const LineRules& rules)
    : scene_(scene),
      hierarchy_(hierarchy),
      caster_(caster),
      sampler_(sampler),
      optics_(optics),
      rules_(rules) {}

/// Irradiance of the receivers of one task by one sun.
class GlossySun::Chunk {
 public:
  Chunk(const GlossySun& glossy, const LobeImages& images, bool are_sensors,
        const IntervalLight& sun, std::size_t first, std::size_t receivers)
      : g_(glossy),
        images_(images),
        sun_(sun),
        points_(sun),
        are_sensors_(are_sensors),
        first_(first),
        realizations_(static_cast<std::size_t>(glossy.rules_.realizations)),
        sum_(receivers * realizations_, 0) {}

  void ask(const Glimpse& glimpse) {
    if (images_.stand_for(glimpse)) return;
    const Vec3 normal =
        g_.scene_.mesh.normal(static_cast<std::size_t>(glimpse.triangle), glimpse.front != 0);
    const double cos_s = dot(normal, sun_.direction);
    if (cos_s <= 0) return;
    const Vec3 s =
        sun_.disk_half_angle > 0 ? sun_before(normal, sun_, point_for(glimpse)) : sun_.direction;
    const double cos_a = glimpse.axis[0] * s.x + glimpse.axis[1] * s.y + glimpse.axis[2] * s.z;
    if (cos_a <= 0) return;
    const double n = g_.scene_.material_of(glimpse.triangle).glossy_exponent;
    const double lobe = lobe_value(cos_a, n);
    if (lobe < least_glimpse * lobe_value(1, n)) return;
    origins_.x[waiting_] = glimpse.at[0];
    origins_.y[waiting_] = glimpse.at[1];
    origins_.z[waiting_] = glimpse.at[2];
    put(to_sun_, waiting_, s);
    slot_[waiting_] = slot_of(glimpse);
    brings_[waiting_] = pi * static_cast<double>(glimpse.weight) * lobe * cos_s * sun_.dni;
    if (++waiting_ == packet_size) cast();
  }

  /// Casts the shadow rays that wait.
  void cast() {
    if (waiting_ == 0) return;
    const auto active = static_cast<std::uint32_t>((std::uint64_t{1} << waiting_) - 1);
    const auto shares = g_.caster_.passed_each(origins_, to_sun_, active);
    for (std::size_t l = 0; l < waiting_; ++l)
      sum_[slot_[l]] += brings_[l] * static_cast<double>(shares[l]);
    rays_ += waiting_;
    waiting_ = 0;
  }

  /// Sum over the lines of a realization.
  double sum(std::size_t receiver, std::size_t realization) const {
    return sum_[(receiver - first_) * realizations_ + realization];
  }
  std::uint64_t rays() const { return rays_; }

 private:
  /// Glimpses of a receiver in one realization take the points of the disk in their order.
  Vec3 point_for(const Glimpse& glimpse) {
    const std::size_t slot = slot_of(glimpse);
    if (taken_ == 0 || slot != slot_of_points_) {
      slot_of_points_ = slot;
      taken_ = 0;
      seeds_ = random_words({.seed = g_.rules_.seed,
                             .purpose = Purpose::sun_disk,
                             .realization = glimpse.realization,
                             .element = are_sensors_ ? g_.scene_.sensors[glimpse.receiver].key
                                                     : g_.hierarchy_.key()[glimpse.receiver],
                             .sun = sun_.number});
    }
    const std::uint32_t point = taken_++;
    return points_.at(scrambled_sobol(point, 0, seeds_), scrambled_sobol(point, 1, seeds_));
  }
  std::size_t slot_of(const Glimpse& glimpse) const {
    return (glimpse.receiver - first_) * realizations_ + glimpse.realization;
  }

  Packet origins_{};  ///< of rays that wait
  PacketDirections to_sun_{};
  const GlossySun& g_;
  const LobeImages& images_;
  const IntervalLight& sun_;
  SunPoints points_;
  RandomWords seeds_{};  ///< of the points for the glimpses of one slot
  std::size_t slot_of_points_ = 0;
  std::uint32_t taken_ = 0;
  bool are_sensors_;
  std::size_t first_, realizations_;
  std::vector<double> sum_;
  std::size_t slot_[packet_size];
  double brings_[packet_size];
  std::size_t waiting_ = 0;
  std::uint64_t rays_ = 0;
};

std::uint64_t GlossySun::add_light(const Lines& lines, const LobeImages& images, bool are_sensors,
                                   std::span<const IntervalLight> block,
                                   const RaySink& into) const {
  const auto& glimpses = lines.glimpses;
  const auto first_of = [&](std::size_t receiver) {
    return std::partition_point(glimpses.begin(), glimpses.end(),
                                [&](const Glimpse& g) { return g.receiver < receiver; });
  };
  const double R = rules_.realizations;
  return ordered_sum(
      lines.pooled.ends.size(), receivers_per_chunk, std::uint64_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::uint64_t rays = 0;
        const auto first = first_of(begin), last = first_of(end);
        if (first == last) return rays;
        for (std::size_t k = 0; k < block.size(); ++k) {
          const IntervalLight& sun = block[k];
          if (!sun.has_sun() || sun.dni <= 0) continue;
          Chunk chunk(*this, images, are_sensors, sun, begin, end - begin);
          for (auto glimpse = first; glimpse != last; ++glimpse) chunk.ask(*glimpse);
          chunk.cast();
          rays += chunk.rays();
          for (std::size_t i = begin; i < end; ++i) {
            const int lines_of = are_sensors ? rules_.lines_per_patch : rules_.lines_of(i);
            const double lines_each = lines_of / R;
            into.add_all(i, k, [&](std::size_t r) { return chunk.sum(i, r) / lines_each; });
          }
        }
        return rays;
      });
}

void GlossySun::send_on(const LineFollower& follower, const IntervalLight& sun, std::size_t k,
                        std::size_t patch, std::vector<SunFates>& fates) const {
  const auto geometry = sampler_.geometry(patch);
  const double cos_theta = dot(geometry.normal, sun.direction);
  if (cos_theta <= 0) return;
  // The mirror's part of the same surface is MirrorSun's.
  Material lobe = follower.material_of_patch(patch);
  const double mirror = lobe.mirror;
  lobe.mirror = 0;
  const double samples_each =
      static_cast<double>(sampler_.samples()) / static_cast<double>(fates.size());
  const double power_per_sample = hierarchy_.area()[patch] * sun.dni * cos_theta / samples_each;
  SunSampler::Seeds seeds;
  sampler_.seed(patch, sun.number, seeds);
  RandomKey key{.seed = rules_.seed,
                .purpose = Purpose::glossy_sun,
                .element = mixed(hierarchy_.key()[patch], sun.number)};
  for (std::size_t p = 0; p < sampler_.packets(); ++p) {
    const LitSamples samples = lit_samples(sampler_, caster_, sun, geometry, seeds, p);
    Onward on[packet_size];
    PacketDirections away{};
    std::uint32_t sent = 0;
    for (auto bits = samples.lit; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      key.realization = static_cast<std::uint32_t>(sampler_.realization(p * packet_size + l));
      key.sun = static_cast<std::uint32_t>(p * packet_size + l);
      key.block = line_blocks::of_line.first;
      const Vec3 w = sun_before(geometry.normal, sun, at(samples.to_sun, l));
      on[l] = onward(lobe, geometry.normal, w, key);
      if (on[l].weight > 0) sent |= 1u << l;
      put(away, l, on[l].direction);
    }
    const auto hits = caster_.first_hits(samples.origins, away, sent);
    for (auto bits = samples.lit; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      key.realization = static_cast<std::uint32_t>(sampler_.realization(p * packet_size + l));
      key.sun = static_cast<std::uint32_t>(p * packet_size + l);
      key.block = line_blocks::of_line.first;
      Fate<double> fate;
      if (sent >> l & 1u) fate = follower.sent_on(on[l].direction, on[l].weight, hits[l], key).fate;
      fate.absorbed += on[l].absorbed - mirror;
      fates[key.realization][k] +=
          scaled(fate, power_per_sample * static_cast<double>(samples.share[l]));
    }
  }
}

void GlossySun::follow_light(std::span<const IntervalLight> block,
                             std::vector<SunFates>& fates) const {
  const SkyGrid smallest_grid(2);  // where the light leaves is not asked
  const LineFollower follower(scene_, hierarchy_, caster_, smallest_grid, rules_.mirror_depth);
  std::vector<std::size_t> glossy;
  for (std::size_t i = 0; i < hierarchy_.patch_count(); ++i)
    if (optics_.glossy[i] > 0) glossy.push_back(i);

  constexpr std::size_t patches_each = 64;
  std::vector<std::vector<SunFates>> parts(chunk_count(glossy.size(), patches_each),
                                           std::vector<SunFates>(fates.size()));
  parallel_chunks(glossy.size(), patches_each, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < block.size(); ++k)
        if (block[k].has_sun() && block[k].dni > 0)
          send_on(follower, block[k], k, glossy[i], parts[begin / patches_each]);
  });
  for (const auto& part : parts)
    for (std::size_t r = 0; r < fates.size(); ++r) fates[r] += part[r];
}

}  // namespace sunload
