// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/mirror_chains.h"

#include <algorithm>
#include <bit>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

MirrorChains::MirrorChains(const Hierarchy& hierarchy, const RayCaster& caster,
                           const SunSampler& sampler, const MirrorGroups& groups,
                           const ChainRules& rules)
    : hierarchy_(hierarchy),
      caster_(caster),
      sampler_(sampler),
      groups_(groups),
      rules_(rules),
      walk_(groups.scene(), hierarchy, caster, rules.mirror_depth) {
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i) {
    const Patch& patch = hierarchy.patches()[i];
    if (groups.of_side(patch.triangle, patch.side == 0) >= 0) mirrors_.push_back(i);
  }
}

/// Chains from the mirror patches of one task.
class MirrorChains::Task {
 public:
  Task(const MirrorChains& chains, std::size_t realizations) : c_(chains), fates(realizations) {}

  struct Arrival {
    std::uint32_t patch;
    std::uint16_t realization, k;
    double power;  ///< [W]
  };

  void send_on(const IntervalLight& sun, std::size_t k, const SunBeams& beams, std::size_t patch) {
    const auto geometry = c_.sampler_.geometry(patch);
    const double cos_theta = dot(geometry.normal, sun.direction);
    if (cos_theta <= 0) return;
    const Patch& mirror = c_.hierarchy_.patches()[patch];
    const Material& material = c_.walk_.material_of_patch(patch);
    const auto group =
        static_cast<std::size_t>(c_.groups_.of_side(mirror.triangle, mirror.side == 0));
    const double samples_each =
        static_cast<double>(c_.sampler_.samples()) / static_cast<double>(fates.size());
    const double power_per_sample =
        c_.hierarchy_.area()[patch] * sun.dni * cos_theta / samples_each;
    const double sent = power_per_sample * c_.groups_.reflectance(mirror.triangle, cos_theta);
    c_.sampler_.seed(patch, sun.number, seeds_);
    for (std::size_t p = 0; p < c_.sampler_.packets(); ++p) {
      LitSamples samples = lit_samples(c_.sampler_, c_.caster_, sun, geometry, seeds_, p);
      rays += count(samples.active);
      for (auto bits = samples.lit; bits != 0; bits &= bits - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(bits));
        chains_[l] = {at(samples.to_sun, l),
                      group,
                      beams.next(-1, group),
                      sent,
                      power_per_sample,
                      static_cast<std::uint16_t>(c_.sampler_.realization(p * packet_size + l))};
        // The glossy part of the sun's light is GlossySun's.
        if (is_pane_or_metal(material))
          keep(material, power_per_sample, cos_theta, fates[chains_[l].realization][k]);
      }
      if (sent > 0) follow(k, beams, samples.origins, samples.lit);
    }
  }

  const MirrorChains& c_;
  std::vector<SunFates> fates;
  std::vector<Arrival> arrivals;
  std::uint64_t rays = 0;

 private:
  static std::uint64_t count(std::uint32_t bits) {
    return static_cast<std::uint64_t>(std::popcount(bits));
  }

  /// Light on the mirror where it was reflected last.
  struct Chain {
    Vec3 from;           ///< where it came from: the sun, or its image, as seen there
    std::size_t group;   ///< of that mirror
    std::int32_t beam;   ///< that it belongs to, -1: none
    double power;        ///< that is sent on [W]
    double first_power;  ///< of the sun's light that it began with
    std::uint16_t realization;
  };

  void follow(std::size_t k, const SunBeams& beams, Packet& points, std::uint32_t active) {
    for (int reflections = 1; active != 0; ++reflections) {
      if (reflections > c_.rules_.mirror_depth) {
        for (; active != 0; active &= active - 1) cut(k, chains_[std::countr_zero(active)]);
        return;
      }
      PacketDirections away{};
      for (auto bits = active; bits != 0; bits &= bits - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(bits));
        chains_[l].from = image(chains_[l].from, c_.groups_[chains_[l].group].normal);
        put(away, l, -chains_[l].from);
      }
      rays += count(active);
      const auto hits = c_.caster_.first_hits(points, away, active, RayCaster::Coherence::parallel);
      std::uint32_t further = 0;
      for (; active != 0; active &= active - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(active));
        if (!arrive(k, beams, hits[l], chains_[l])) continue;
        further |= 1u << l;
        const Hit hit = hits[l];
        put(points, l, c_.walk_.point(hit, c_.groups_[chains_[l].group].normal));
      }
      active = further;
    }
  }

  /// Books what a surface that depends on the angle does with light that arrives at it,
  /// but for what it reflects as a mirror. Its lobe is not followed.
  static void keep(const Material& m, double power, double cos_theta, Fate<double>& fate) {
    if (!depends_on_angle(m)) return;
    const SmoothShares shares = smooth_shares(m, cos_theta);
    fate.transmitted += power * shares.transmitted;
    fate.cut += power * m.glossy;
    fate.absorbed += power * left_over(1 - m.diffuse - shares.mirror - shares.transmitted -
                                       m.glossy - m.transmittance);
  }

  /// Books what a chain meets; false where it ends there.
  bool arrive(std::size_t k, const SunBeams& beams, const Hit& hit, Chain& chain) {
    Fate<double>& fate = fates[chain.realization][k];
    const auto met = c_.walk_.meet(hit, chain.power, fate);
    if (!met) return false;
    const auto& [patch, material] = *met;
    if (chain.beam < 0)
      arrivals.push_back({static_cast<std::uint32_t>(patch), chain.realization,
                          static_cast<std::uint16_t>(k), chain.power});
    const auto group = c_.groups_.of_side(hit.triangle, hit.front);
    if (group < 0) {
      keep(material, chain.power, 1, fate);
      return false;
    }
    chain.group = static_cast<std::size_t>(group);
    const double cos_theta = dot(chain.from, c_.groups_[chain.group].normal);
    keep(material, chain.power, cos_theta, fate);
    chain.power *= c_.groups_.reflectance(hit.triangle, cos_theta);
    if (chain.power <= 0) return false;
    chain.beam = chain.beam < 0 ? -1 : beams.next(chain.beam, chain.group);
    if (chain.beam < 0 && chain.power < c_.rules_.negligible * chain.first_power) {
      cut(k, chain);
      return false;
    }
    return true;
  }

  void cut(std::size_t k, const Chain& chain) { fates[chain.realization][k].cut += chain.power; }

  SunSampler::Seeds seeds_;
  Chain chains_[packet_size];
};

MirrorChains::SentOn MirrorChains::follow(std::span<const IntervalLight> block,
                                          std::span<const SunBeams> beams, const Columns& shares,
                                          const RaySink& into) const {
  // Arrivals are added in rounds, so that no more of them wait than these mirrors make.
  constexpr std::size_t mirrors_per_task = 16, mirrors_per_round = 1024 * mirrors_per_task;
  const std::size_t realizations = into.realizations();
  SentOn sent;
  sent.fates.resize(realizations);
  for (std::size_t round = 0; round < mirrors_.size(); round += mirrors_per_round) {
    const std::size_t mirrors = std::min(mirrors_per_round, mirrors_.size() - round);
    std::vector<Task> tasks(chunk_count(mirrors, mirrors_per_task), Task(*this, realizations));
    parallel_chunks(mirrors, mirrors_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = 0; k < block.size(); ++k)
          if (block[k].has_sun() && block[k].dni > 0 &&
              shares[mirrors_[round + i] * block_width + k] != 0)
            tasks[begin / mirrors_per_task].send_on(block[k], k, beams[k], mirrors_[round + i]);
    });
    for (const auto& task : tasks) {
      sent.rays += task.rays;
      sent.shots += task.arrivals.size();
      for (std::size_t r = 0; r < realizations; ++r) sent.fates[r] += task.fates[r];
      for (const auto& [patch, realization, k, power] : task.arrivals) {
        const double E = power / hierarchy_.area()[patch];
        into.add(realization, patch, k, E);
        into.add_pooled(patch, k, E / static_cast<double>(realizations));
      }
    }
  }
  return sent;
}

std::vector<std::uint8_t> MirrorChains::dark_mirrors(const IntervalLight& sun, std::size_t k,
                                                     const Columns& shares) const {
  std::vector<std::uint8_t> dark(groups_.scene().mesh.triangle_count(), 0);
  const auto mark = [&](std::size_t patch, bool is_dark) {
    if (dot(hierarchy_.normal(patch), sun.direction) > 0 &&
        (shares[patch * block_width + k] == 0) == is_dark)
      dark[static_cast<std::size_t>(hierarchy_.patches()[patch].triangle)] = is_dark ? 1 : 0;
  };
  for (const auto patch : mirrors_) mark(patch, true);
  for (const auto patch : mirrors_) mark(patch, false);
  return dark;
}

}  // namespace sunload
