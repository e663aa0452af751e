// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/mirror_chains.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "solver/base/chunks.h"
#include "solver/base/sampling.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// Of one sun, over all realizations, where chains only book ends: each realization of 8 then knows
/// the shares of what mirrors send on to 0.03 (0.5 / √256), all of them together to 0.01.
constexpr std::size_t samples_of_ends = 2048;

/// Books what a surface that depends on the angle does with light that arrives at it,
/// but for what it reflects as a mirror. Its lobe is not followed.
void keep(const Material& m, double power, double cos_theta, Fate<double>& fate) {
  if (!depends_on_angle(m)) return;
  const SmoothShares shares = smooth_shares(m, cos_theta);
  fate.transmitted += power * shares.transmitted;
  fate.cut += power * m.glossy;
  fate.absorbed += power * left_over(1 - m.diffuse - shares.mirror - shares.transmitted - m.glossy -
                                     m.transmittance);
}

}  // namespace

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

void MirrorChains::PoweredMirrors::add(const Mirror& mirror) {
  if (mirror.power <= 0) return;
  end_.push_back(power() + mirror.power);
  mirrors_.push_back(mirror);
}

const MirrorChains::Mirror& MirrorChains::PoweredMirrors::at(double power) const {
  const auto found = std::upper_bound(end_.begin(), end_.end(), power);
  const auto last = end_.end() - 1;  // where rounding leads beyond it
  return mirrors_[static_cast<std::size_t>(std::min(found, last) - end_.begin())];
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

  /// The samples of one patch.
  void send_on(const IntervalLight& sun, std::size_t k, const SunBeams& beams, std::size_t patch) {
    const double samples_each =
        static_cast<double>(c_.sampler_.samples()) / static_cast<double>(fates.size());
    const Mirror mirror = c_.mirror(patch, sun);
    if (mirror.power <= 0) return;
    const auto geometry = c_.sampler_.geometry(patch);
    c_.sampler_.seed(patch, sun.number, seeds_);
    for (std::size_t p = 0; p < c_.sampler_.packets(); ++p) {
      LitSamples samples = lit_samples(c_.sampler_, c_.caster_, sun, geometry, seeds_, p);
      for (std::size_t l = 0; l < packet_size; ++l)
        if ((samples.lit >> l & 1u) != 0)
          begin(k, beams, mirror, arriving(mirror.power / samples_each, samples, l),
                c_.sampler_.realization(p * packet_size + l), at(samples.to_sun, l), chains_[l]);
      follow(k, beams, samples);
    }
  }

  /// Those of one realization, `count` of the same power, wherever mirrors receive it.
  void send_on(const IntervalLight& sun, std::size_t k, const SunBeams& beams,
               const PoweredMirrors& mirrors, std::size_t realization, std::size_t count) {
    RandomKey key{.seed = c_.sampler_.study_seed(),
                  .purpose = Purpose::mirror_sun,
                  .realization = static_cast<std::uint32_t>(realization),
                  .sun = sun.number};
    const double step = mirrors.power() / static_cast<double>(count);
    const double offset = random_words(key)[0] * 0x1p-32;
    const SunPoints disk(sun);
    for (std::size_t first = 0; first < count; first += packet_size) {
      const std::size_t lanes = std::min(packet_size, count - first);
      Packet origins{};
      PacketDirections to_sun{};
      std::array<const Mirror*, packet_size> of_lane{};
      for (std::size_t l = 0; l < lanes; ++l) {
        of_lane[l] = &mirrors.at(step * (static_cast<double>(first + l) + offset));
        key.block = static_cast<std::uint32_t>(1 + first + l);
        const RandomWords words = random_words(key);
        put(origins, l, c_.point(*of_lane[l], words));
        put(to_sun, l, disk.at(words[2] * 0x1p-32, words[3] * 0x1p-32));
      }
      LitSamples samples = lit_samples(c_.caster_, origins, to_sun,
                                       static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1));
      for (std::size_t l = 0; l < lanes; ++l)
        if ((samples.lit >> l & 1u) != 0)
          begin(k, beams, *of_lane[l], arriving(step, samples, l), realization, at(to_sun, l),
                chains_[l]);
      follow(k, beams, samples);
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
  /// Of a sample's power.
  static double arriving(double power, const LitSamples& samples, std::size_t sample) {
    return power * static_cast<double>(samples.share[sample]);
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

  /// A chain where the sun meets its first mirror with that power [W]; books what stays there.
  void begin(std::size_t k, const SunBeams& beams, const Mirror& mirror, double power,
             std::size_t realization, Vec3 to_sun, Chain& chain) {
    const Material& material = c_.walk_.material_of_patch(mirror.patch);
    chain = {to_sun,
             mirror.group,
             beams.next(-1, mirror.group),
             power * mirror.reflectance,
             power,
             static_cast<std::uint16_t>(realization)};
    // The glossy part of the sun's light is GlossySun's.
    if (is_pane_or_metal(material) && mirror.share < 0)
      keep(material, power, mirror.cos_theta, fates[realization][k]);
  }

  /// Samples that are lit, as far as their mirrors send on anything.
  void follow(std::size_t k, const SunBeams& beams, LitSamples& samples) {
    rays += count(samples.active);
    for (std::size_t l = 0; l < packet_size; ++l)
      if ((samples.lit >> l & 1u) != 0 && chains_[l].power <= 0) samples.lit &= ~(1u << l);
    follow(k, beams, samples.origins, samples.lit);
  }

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

MirrorChains::Mirror MirrorChains::mirror(std::size_t patch, const IntervalLight& sun) const {
  const Patch& place = hierarchy_.patches()[patch];
  const double cos_theta = dot(hierarchy_.normal(patch), sun.direction);
  if (cos_theta <= 0) return {.patch = patch};
  return {.patch = patch,
          .group = static_cast<std::size_t>(groups_.of_side(place.triangle, place.side == 0)),
          .cos_theta = cos_theta,
          .power = hierarchy_.area()[patch] * sun.dni * cos_theta,
          .reflectance = groups_.reflectance(place.triangle, cos_theta)};
}

MirrorChains::PoweredMirrors MirrorChains::mirrors_before(const IntervalLight& sun, std::size_t k,
                                                          const Columns& shares) const {
  PoweredMirrors mirrors;
  for (const std::size_t patch : mirrors_) {
    const float share = shares[patch * block_width + k];
    if (share == 0) continue;
    Mirror before = mirror(patch, sun);
    before.share = static_cast<double>(share);
    mirrors.add(before);
  }
  return mirrors;
}

Vec3 MirrorChains::point(const Mirror& mirror, const RandomWords& words) const {
  const auto [w0, w1, w2] = sample_triangle(words[0] * 0x1p-32, words[1] * 0x1p-32);
  const auto [a, b, c] = sampler_.corners(mirror.patch);
  return w0 * a + w1 * b + w2 * c + hierarchy_.normal(mirror.patch) * sampler_.offset_m();
}

void MirrorChains::gather(std::span<const Task> tasks, const RaySink& into, SentOn& sent) const {
  for (const Task& task : tasks) {
    sent.rays += task.rays;
    sent.shots += task.arrivals.size();
    for (std::size_t r = 0; r < task.fates.size(); ++r) sent.fates[r] += task.fates[r];
    for (const auto& [patch, realization, k, power] : task.arrivals) {
      const double E = power / hierarchy_.area()[patch];
      into.add(realization, patch, k, E);
      into.add_pooled(patch, k, E / static_cast<double>(task.fates.size()));
    }
  }
}

void MirrorChains::follow_each(std::span<const IntervalLight> block,
                               std::span<const SunBeams> beams, const Columns& shares,
                               std::span<const std::size_t> suns, const RaySink& into,
                               SentOn& sent) const {
  if (suns.empty()) return;
  // Arrivals are added in rounds, so that no more of them wait than these mirrors make.
  constexpr std::size_t mirrors_per_task = 16, mirrors_per_round = 1024 * mirrors_per_task;
  for (std::size_t round = 0; round < mirrors_.size(); round += mirrors_per_round) {
    const std::size_t mirrors = std::min(mirrors_per_round, mirrors_.size() - round);
    std::vector<Task> tasks(chunk_count(mirrors, mirrors_per_task),
                            Task(*this, into.realizations()));
    parallel_chunks(mirrors, mirrors_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (const std::size_t k : suns)
          if (shares[mirrors_[round + i] * block_width + k] != 0)
            tasks[begin / mirrors_per_task].send_on(block[k], k, beams[k], mirrors_[round + i]);
    });
    gather(tasks, into, sent);
  }
}

void MirrorChains::follow_some(std::span<const IntervalLight> block,
                               std::span<const SunBeams> beams, std::span<const SunOnMirrors> suns,
                               const RaySink& into, SentOn& sent) const {
  const std::size_t realizations = into.realizations();
  std::vector<Task> tasks(suns.size() * realizations, Task(*this, realizations));
  parallel_for(tasks.size(), [&](std::size_t i) {
    const auto& [k, mirrors] = suns[i / realizations];
    const std::size_t samples =
        std::min(samples_of_ends, mirrors.all().size() * sampler_.samples()) / realizations;
    tasks[i].send_on(block[k], k, beams[k], mirrors, i % realizations,
                     std::max<std::size_t>(1, samples));
  });
  gather(tasks, into, sent);
  for (const auto& [k, mirrors] : suns) {
    const Fate<double> stays = stays_on(mirrors.all());
    for (SunFates& fates : sent.fates) fates[k] += stays;
  }
}

Fate<double> MirrorChains::stays_on(std::span<const Mirror> mirrors) const {
  Fate<double> stays;
  for (const Mirror& mirror : mirrors)
    if (const Material& material = walk_.material_of_patch(mirror.patch);
        mirror.share > 0 && is_pane_or_metal(material))
      keep(material, mirror.power * mirror.share, mirror.cos_theta, stays);
  return stays;
}

MirrorChains::SentOn MirrorChains::follow(std::span<const IntervalLight> block,
                                          std::span<const SunBeams> beams, const Columns& shares,
                                          const RaySink& into) const {
  std::vector<std::size_t> each;
  std::vector<SunOnMirrors> some;
  for (std::size_t k = 0; k < block.size(); ++k) {
    if (!block[k].has_sun() || block[k].dni <= 0) continue;
    if (!rules_.books_samples || !beams[k].are_all(rules_.negligible))
      each.push_back(k);
    else if (PoweredMirrors mirrors = mirrors_before(block[k], k, shares); !mirrors.all().empty())
      some.push_back({k, std::move(mirrors)});
  }
  SentOn sent;
  sent.fates.resize(into.realizations());
  follow_each(block, beams, shares, each, into, sent);
  follow_some(block, beams, some, into, sent);
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
