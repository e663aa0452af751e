// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/glossy_sun.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geo/base/units.h"
#include "solver/base/threads.h"
#include "solver/surface/lobe.h"

namespace sunload {

namespace {

constexpr std::size_t receivers_per_task = 1024;

// Glimpses so far out in the lobe are not asked: what they would bring, relative to one in
// the lobe's middle, is below the rounding of the float series.
constexpr double least_lobe = 1e-8;

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
  Chunk(const GlossySun& glossy, const LobeImages* images, const SunLight& sun, std::size_t first,
        std::size_t receivers)
      : g_(glossy),
        images_(images),
        sun_(sun),
        first_(first),
        realizations_(static_cast<std::size_t>(glossy.rules_.realizations)),
        sum_(receivers * realizations_, 0) {}

  void ask(const Glimpse& glimpse) {
    if (images_ && images_->stand_for(glimpse)) return;
    const Vec3 s = sun_.direction;
    const double cos_s = dot(normal_of(glimpse), s);
    const double cos_a = glimpse.axis[0] * s.x + glimpse.axis[1] * s.y + glimpse.axis[2] * s.z;
    if (cos_s <= 0 || cos_a <= 0) return;
    const double n = g_.material_of(glimpse.triangle).glossy_exponent;
    const double lobe = lobe_value(cos_a, n);
    if (lobe < least_lobe * lobe_value(1, n)) return;
    origins_.x[waiting_] = glimpse.at[0];
    origins_.y[waiting_] = glimpse.at[1];
    origins_.z[waiting_] = glimpse.at[2];
    slot_[waiting_] = (glimpse.receiver - first_) * realizations_ + glimpse.realization;
    brings_[waiting_] = pi * static_cast<double>(glimpse.weight) * lobe * cos_s * sun_.dni;
    if (++waiting_ == packet_size) cast();
  }

  /// Casts the shadow rays that wait.
  void cast() {
    if (waiting_ == 0) return;
    const auto active = static_cast<std::uint32_t>((std::uint64_t{1} << waiting_) - 1);
    auto seen = g_.caster_.unoccluded(origins_, sun_.direction, active);
    for (; seen != 0; seen &= seen - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(seen));
      sum_[slot_[l]] += brings_[l];
    }
    rays += waiting_;
    waiting_ = 0;
  }

  /// Sum over the lines of a realization.
  double sum(std::size_t receiver, std::size_t realization) const {
    return sum_[(receiver - first_) * realizations_ + realization];
  }
  std::uint64_t rays = 0;

 private:
  Vec3 normal_of(const Glimpse& glimpse) const {
    const auto n =
        normalized(g_.scene_.mesh.area_vector2(static_cast<std::size_t>(glimpse.triangle)));
    return glimpse.front != 0 ? n : -n;
  }

  const GlossySun& g_;
  const LobeImages* images_;
  const SunLight& sun_;
  std::size_t first_, realizations_;
  std::vector<double> sum_;
  Packet origins_{};
  std::size_t slot_[packet_size];
  double brings_[packet_size];
  std::size_t waiting_ = 0;
};

std::uint64_t GlossySun::add_light(const Lines& lines, const LobeImages* of_sensors,
                                   std::span<const SunLight> block, MirroredIrradiance into) const {
  const auto& glimpses = lines.glimpses;
  const auto first_of = [&](std::size_t receiver) {
    return std::partition_point(glimpses.begin(), glimpses.end(),
                                [&](const Glimpse& g) { return g.receiver < receiver; });
  };
  const double R = rules_.realizations;
  return ordered_sum(lines.pooled.ends.size(), receivers_per_task, std::uint64_t{0},
                     [&](std::size_t begin, std::size_t end) {
                       std::uint64_t rays = 0;
                       const auto first = first_of(begin), last = first_of(end);
                       if (first == last) return rays;
                       for (std::size_t k = 0; k < block.size(); ++k) {
                         const SunLight& sun = block[k];
                         if (!sun.has_sun() || sun.dni <= 0) continue;
                         Chunk chunk(*this, of_sensors, sun, begin, end - begin);
                         for (auto glimpse = first; glimpse != last; ++glimpse) chunk.ask(*glimpse);
                         chunk.cast();
                         rays += chunk.rays;
                         for (std::size_t i = begin; i < end; ++i) {
                           const int lines_of =
                               of_sensors ? rules_.lines_per_patch : rules_.lines_of(i);
                           const double lines_each = lines_of / R;
                           double pooled = 0;
                           for (std::size_t r = 0; r < into.realizations(); ++r) {
                             const double E = chunk.sum(i, r) / lines_each;
                             pooled += E / R;
                             into.add(r, i, k, E, sun.length_s);
                           }
                           into.irradiance[i * block_width + k] += static_cast<float>(pooled);
                         }
                       }
                       return rays;
                     });
}

void GlossySun::send_on(const LineFollower& follower, const SunLight& sun, std::size_t k,
                        std::size_t patch, std::vector<MirroredSun>& fates) const {
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
    const Packet origins = sampler_.origins(geometry, seeds, p);
    const auto lit = caster_.unoccluded(origins, sun.direction, sampler_.active(p));
    LineFollower::Onward on[packet_size];
    PacketDirections away{};
    std::uint32_t sent = 0;
    for (auto bits = lit; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      key.realization = static_cast<std::uint32_t>(sampler_.realization(p * packet_size + l));
      key.sun = static_cast<std::uint32_t>(p * packet_size + l);
      key.block = 0;
      on[l] = LineFollower::onward(lobe, geometry.normal, sun.direction, key);
      if (on[l].weight > 0) sent |= 1u << l;
      away.x[l] = static_cast<float>(on[l].direction.x);
      away.y[l] = static_cast<float>(on[l].direction.y);
      away.z[l] = static_cast<float>(on[l].direction.z);
    }
    const auto hits = caster_.first_hits(origins, away, sent);
    for (auto bits = lit; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      LineFollower::Fate fate;
      key.realization = static_cast<std::uint32_t>(sampler_.realization(p * packet_size + l));
      key.sun = static_cast<std::uint32_t>(p * packet_size + l);
      key.block = 0;
      if (sent >> l & 1u) fate = follower.sent_on(on[l].direction, on[l].weight, hits[l], &key);
      auto& book = fates[key.realization];
      book.escaped[k] += power_per_sample * fate.escaped;
      book.backs[k] += power_per_sample * fate.backs;
      book.cut[k] += power_per_sample * fate.cut;
      book.transmitted[k] += power_per_sample * fate.transmitted;
      book.absorbed[k] += power_per_sample * (on[l].absorbed - mirror + fate.absorbed);
    }
  }
}

void GlossySun::follow_light(std::span<const SunLight> block,
                             std::vector<MirroredSun>& fates) const {
  const SkyGrid smallest_grid(2);  // where the light leaves is not asked
  const LineFollower follower(scene_, hierarchy_, caster_, smallest_grid, rules_.mirror_depth);
  std::vector<std::size_t> glossy;
  for (std::size_t i = 0; i < hierarchy_.patch_count(); ++i)
    if (optics_.glossy[i] > 0) glossy.push_back(i);

  constexpr std::size_t patches_each = 64;
  std::vector<std::vector<MirroredSun>> parts((glossy.size() + patches_each - 1) / patches_each,
                                              std::vector<MirroredSun>(fates.size()));
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
