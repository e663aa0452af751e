// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shoot/shooting.h"

#include <algorithm>
#include <numeric>

#include "geo/base/check.h"
#include "geo/base/keys.h"
#include "solver/base/chunks.h"
#include "solver/base/random_blocks.h"
#include "solver/base/threads.h"
#include "solver/lines/patch_lines.h"
#include "solver/mesh/push_pull.h"

namespace sunload {

namespace {

constexpr std::uint32_t shot_of_emitters = 0;  // iterations of reflection follow

/// Random offset of the stratified rounding; no patch has this key.
constexpr std::uint64_t rounding_key = 0;

void add(DoubleColumns& to, const DoubleColumns& from) {
  parallel_for(
      to.size() / block_width,
      [&](std::size_t i) {
        for (std::size_t k = i * block_width; k < (i + 1) * block_width; ++k) to[k] += from[k];
      },
      receivers_per_chunk);
}

void gather(const LinkTable& links, const DoubleColumns& source, DoubleColumns& out) {
  parallel_for(links.blocks.size(), [&](std::size_t b) {
    LinkTable::Reader read(links.blocks[b]);
    for (std::size_t row = 0; row < links.blocks[b].rows(); ++row) {
      double* E = &out[(b * LinkTable::rows_per_block + row) * block_width];
      for (std::size_t left = read.next_row(); left > 0; --left) {
        const auto [target, weight] = read.next();
        const double* L = &source[static_cast<std::size_t>(target) * block_width];
        for (std::size_t k = 0; k < block_width; ++k) E[k] += static_cast<double>(weight) * L[k];
      }
    }
  });
}

DoubleColumns in_double(const Columns& values) { return {values.begin(), values.end()}; }

DoubleColumns ground_exitance(const BlockSources& sources) {
  return {std::begin(sources.ground_exitance), std::end(sources.ground_exitance)};
}

}  // namespace

Shooter::Shooter(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                 const SunSampler& sampler, const SkyGrid& grid, const PatchOptics& optics,
                 const Lines& lines, const LampLight& lamps, const std::vector<float>& beyond,
                 const LineRules& line_rules, const ShootingRules& rules)
    : hierarchy_(hierarchy),
      caster_(caster),
      lines_(lines),
      beyond_(beyond),
      line_rules_(line_rules),
      rules_(rules),
      chain_(scene, hierarchy, caster, line_rules.mirror_depth, line_rules.largest_link),
      first_mirrored_(scene, hierarchy, caster, sampler, grid, line_rules),
      receiver_area_(hierarchy.area()),
      rays_(first_mirrored_.rays()) {
  SUNLOAD_EXPECT(static_cast<std::uint32_t>(rules.bounces) < shot_blocks::of_iterations.count,
                 "iterations have random numbers for so many");
  if (line_rules.largest_link > 0)
    for (std::size_t i = 0; hierarchy.patch_count() + i < hierarchy.element_count(); ++i) {
      const auto [a, b] = hierarchy.halves_of(i);
      receiver_area_.push_back(receiver_area_[a] + receiver_area_[b]);
    }
  for (const Patch& patch : hierarchy.patches()) {
    const Material& m = scene.material_of(patch.triangle);
    diffuse_.push_back(m.diffuse);
    emission_.push_back(m.emission_w_m2);
    passed_.push_back(m.transmittance);
    sends_on_.push_back(sends_on(m));
  }
  shoot_emitters();
  if (!lamps.ledger.empty()) add_lamps(lamps, optics);
}

FirstMirrored::SentSuns Shooter::send_sun(std::span<const IntervalLight> block) const {
  return first_mirrored_.send(block);
}

/// The samples of one chunk of patches, traced in packets that patches share.
class Shooter::Task {
  Packet origins_{}, directions_{};  ///< first, where their alignment leaves no gaps

 public:
  Task(const Shooter& shooter, const Address& address, std::size_t begin, std::size_t end)
      : s_(shooter), address_(address), begin_(begin), fates_(end - begin) {}

  /// Casts the samples of a patch, each with an equal share of its power.
  void shoot(std::size_t patch, std::uint32_t count) {
    const PatchLines lines(s_.hierarchy_, patch, s_.caster_.offset_m(),
                           random_words(key(s_.hierarchy_.key()[patch], address_.iteration)));
    for (std::uint32_t l = 0; l < count; ++l) {
      const auto line = lines[l];
      put(origins_, waiting_, line.origin);
      put(directions_, waiting_, line.w);
      w_[waiting_] = line.w;
      patch_[waiting_] = static_cast<std::uint32_t>(patch);
      share_[waiting_] = 1.0 / count;
      line_[waiting_] = l;
      if (++waiting_ == packet_size) flush();
    }
  }
  void flush() {
    if (waiting_ == 0) return;
    const auto hits = s_.caster_.first_hits(origins_, directions_, (1u << waiting_) - 1u);
    rays += waiting_;
    for (std::size_t l = 0; l < waiting_; ++l) {
      const std::uint64_t sample = mixed(s_.hierarchy_.key()[patch_[l]], line_[l]);
      const Followed sent =
          s_.chain_.follow(w_[l], hits[l], patch_[l], share_[l],
                           key(sample, shot_blocks::of_chain(address_.iteration).first), deposits);
      rays += sent.rays;
      fates_[patch_[l] - begin_] += sent.fate;
    }
    waiting_ = 0;
  }
  SunFates fates(const DoubleColumns& power) const {
    SunFates sum;
    for (std::size_t i = 0; i < fates_.size(); ++i)
      sum.add(fates_[i], &power[(begin_ + i) * block_width]);
    return sum;
  }
  std::vector<Deposit> deposits;
  std::uint64_t rays = 0;

 private:
  RandomKey key(std::uint64_t element, std::uint32_t block) const {
    return {.seed = s_.line_rules_.seed,
            .purpose = Purpose::shooting,
            .realization = address_.realization,
            .element = element,
            .sun = address_.sun,
            .block = block};
  }

  const Shooter& s_;
  Address address_;
  std::size_t begin_;
  std::vector<Fate<double>> fates_;  ///< per patch of the chunk
  Vec3 w_[packet_size];
  std::uint32_t patch_[packet_size];
  double share_[packet_size];
  std::uint32_t line_[packet_size];
  std::size_t waiting_ = 0;
};

Shooter::Shot Shooter::shoot(const DoubleColumns& power, double samples,
                             const Address& address) const {
  const std::size_t patches = hierarchy_.patch_count();
  const auto words = random_words({.seed = line_rules_.seed,
                                   .purpose = Purpose::shooting,
                                   .realization = address.realization,
                                   .element = rounding_key,
                                   .sun = address.sun,
                                   .block = address.iteration});
  const auto counts = sample_counts(power, total_power(power), samples, words[0] * 0x1p-32);

  const std::size_t chunks = chunk_count(patches, receivers_per_chunk);
  Deposits deposits(chunks);
  std::vector<SunFates> fates(chunks);
  std::vector<std::uint64_t> rays(chunks, 0);
  parallel_chunks(patches, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    const std::size_t chunk = begin / receivers_per_chunk;
    Task task(*this, address, begin, end);
    for (std::size_t i = begin; i < end; ++i) task.shoot(i, counts[i]);
    task.flush();
    fates[chunk] = task.fates(power);
    rays[chunk] = task.rays;
    deposits.put(chunk, std::move(task.deposits));
  });

  Shot shot{double_columns(receiver_area_.size()), {}};
  deposits.add_to(shot.irradiance, power, receiver_area_);
  push_down(hierarchy_, shot.irradiance);
  for (const SunFates& of_chunk : fates) shot.fates += of_chunk;
  shot.samples = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  shot.rays = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  return shot;
}

double Shooter::wanted_samples(const SunTotals& power, const SunTotals& first) const {
  const double R = line_rules_.realizations;
  const double by_auto = static_cast<double>(hierarchy_.patch_count()) * rules_.samples_per_patch;
  double samples = 0;  // as many as the sun that needs most
  for (std::size_t k = 0; k < block_width; ++k) {
    if (power[k] <= 0) continue;
    const double per_sample = rules_.power_per_sample_w.value_or(first[k] / by_auto);
    samples = std::max(samples, power[k] / (per_sample * R));
  }
  return samples;
}

void Shooter::shoot_emitters() {
  const std::size_t patches = emission_.size();
  DoubleColumns power = double_columns(patches);
  for (std::size_t i = 0; i < patches; ++i)
    power[i * block_width] = hierarchy_.area()[i] * emission_[i];
  const SunTotals total = total_power(power);
  for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(line_rules_.realizations); ++r) {
    OfEmitters& of = emitters_.emplace_back();
    of.irradiance.assign(patches, 0);
    if (total[0] <= 0) continue;
    const double wanted = wanted_samples(total, total);
    const Shot shot = shoot(power, wanted, {r, 0, shot_of_emitters});
    for (std::size_t i = 0; i < patches; ++i) of.irradiance[i] = shot.irradiance[i * block_width];
    of.fate = shot.fates[0];
    samples_ += shot.samples;
    wanted_ += wanted;
    rays_ += shot.rays;
  }
}

/// Its ledger holds what meets the scene and what mirrors send on, not what patches absorb of it.
void Shooter::add_lamps(const LampLight& lamps, const PatchOptics& optics) {
  for (std::size_t r = 0; r < emitters_.size(); ++r) {
    OfEmitters& of = emitters_[r];
    of.lamps = lamps.ledger[r];
    for (std::size_t i = 0; i < of.irradiance.size(); ++i) {
      const double E = lamps.irradiance[r][i];
      of.irradiance[i] += E;
      of.lamps[Term::absorbed] += hierarchy_.area()[i] * optics.absorbed(i) * E;
    }
  }
}

/// `last`: what the last two bounces brought, or the only one.
DoubleColumns Shooter::light_beyond_last(const DoubleColumns& last) const {
  DoubleColumns estimated(last.size());
  parallel_for(
      diffuse_.size(),
      [&](std::size_t i) {
        for (std::size_t k = i * block_width; k < (i + 1) * block_width; ++k)
          estimated[k] = last[k] * static_cast<double>(beyond_[i]);
      },
      receivers_per_chunk);
  return estimated;
}

DoubleColumns Shooter::reflected_power(const DoubleColumns& received) const {
  DoubleColumns power(received.size());
  parallel_for(
      diffuse_.size(),
      [&](std::size_t i) {
        for (std::size_t k = i * block_width; k < (i + 1) * block_width; ++k)
          power[k] = hierarchy_.area()[i] * diffuse_[i] * received[k];
      },
      receivers_per_chunk);
  return power;
}

Shooter::Reflected Shooter::reflect(const DoubleColumns& first, std::size_t realization,
                                    std::uint32_t sun) const {
  Reflected out{double_columns(diffuse_.size()), double_columns(diffuse_.size()), {}, {}};
  DoubleColumns power = reflected_power(first);
  const SunTotals first_total = total_power(power);
  SunTotals total = first_total, sent{};
  DoubleColumns last_two;  // what this bounce and the one before brought
  const auto any = [](const SunTotals& of) {
    return std::any_of(of.begin(), of.end(), [](double P) { return P > 0; });
  };
  for (int b = 1; b <= rules_.bounces && any(total); ++b) {
    const double wanted = wanted_samples(total, first_total);
    Shot shot = shoot(power, wanted,
                      {static_cast<std::uint32_t>(realization), sun,
                       shot_of_emitters + static_cast<std::uint32_t>(b)});
    out.samples += shot.samples;
    out.wanted += wanted;
    out.rays += shot.rays;
    if (rules_.jacobi == Jacobi::incremental) {
      add(out.shot_radiosity, power);
      power = reflected_power(shot.irradiance);
      add(out.irradiance, shot.irradiance);
      out.fates += shot.fates;
      if (!beyond_.empty()) {
        if (b > 1) add(last_two, shot.irradiance);
        out.estimated = light_beyond_last(b > 1 ? last_two : shot.irradiance);
        last_two = std::move(shot.irradiance);
      }
    } else {
      sent = total;
      out.shot_radiosity = std::move(power);
      out.irradiance = std::move(shot.irradiance);
      out.fates = shot.fates;
      DoubleColumns received = first;
      add(received, out.irradiance);
      power = reflected_power(received);
    }
    total = total_power(power);
  }
  for (std::size_t k = 0; k < block_width; ++k) out.unshot[k] = total[k] - sent[k];
  for (std::size_t i = 0; i < out.shot_radiosity.size(); ++i)
    out.shot_radiosity[i] /= hierarchy_.area()[i / block_width];
  return out;
}

SunFates Shooter::add_first_light(ShotLight& light, DoubleColumns& ground, std::size_t realization,
                                  const BlockSources& sources,
                                  const FirstMirrored::SentSuns& sent) const {
  const LineSet& lines = lines_.realizations[realization];
  const DoubleColumns sky = in_double(sources.sky), exitance = ground_exitance(sources);
  gather(lines.sky, sky, light.sky);
  parallel_for(
      lines.ends.size(),
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block_width; ++k)
          ground[i * block_width + k] = static_cast<double>(lines.ends[i].ground) * exitance[k];
      },
      receivers_per_chunk);
  SunFates fates;
  if (!first_mirrored_.any()) return fates;
  const auto take = [&](const FirstMirrored::Light& from, DoubleColumns& to) {
    add(to, from.irradiance);
    fates += from.fates;
  };
  take(first_mirrored_.sun(sent.of_realization[realization]), light.mirror);
  if (light.by_source) add(light.by_source->sun, light.mirror);
  take(first_mirrored_.sky(realization, sky), light.mirror);
  take(first_mirrored_.ground(realization, exitance), ground);
  return fates;
}

void Shooter::book_first_light(ShotLight& light, std::size_t realization,
                               const BlockSources& sources) const {
  struct Ledgers {
    std::array<Ledger, block_width> of;
    Ledgers& operator+=(const Ledgers& other) {
      for (std::size_t k = 0; k < block_width; ++k) of[k] += other.of[k];
      return *this;
    }
  };
  const auto& ends = lines_.realizations[realization].ends;
  const std::vector<double>& area = hierarchy_.area();
  light.ledger =
      ordered_sum(area.size(), receivers_per_chunk, Ledgers{},
                  [&](std::size_t begin, std::size_t end) {
                    Ledgers sum;
                    for (std::size_t i = begin; i < end; ++i)
                      for (std::size_t k = 0; k < block_width; ++k) {
                        Ledger& ledger = sum.of[k];
                        const double sun = area[i] * light.direct[i * block_width + k];
                        const double sky = area[i] * light.sky[i * block_width + k];
                        const double ground = area[i] * static_cast<double>(ends[i].ground) *
                                              static_cast<double>(sources.ground_exitance[k]);
                        const double stopped = 1 - passed_[i];
                        ledger[Term::sun] += stopped * sun;
                        ledger[Term::sky] += stopped * sky;
                        ledger[Term::ground] += stopped * ground;
                        ledger[Term::emitted] += area[i] * emission_[i];
                        // Samples say what mirrors absorb, which depends on the angle.
                        if (!sends_on_[i])
                          ledger[Term::absorbed] += (stopped - diffuse_[i]) * (sun + sky + ground);
                      }
                    return sum;
                  })
          .of;
}

ShotLight Shooter::light(std::size_t realization, const BlockSources& sources,
                         const Columns& direct, const FirstMirrored::SentSuns& sent) const {
  const std::size_t patches = hierarchy_.patch_count();
  const OfEmitters& emitters = emitters_[realization];
  ShotLight light;
  light.direct = in_double(direct);
  light.sky = light.mirror = double_columns(patches);
  light.lamps = &emitters.irradiance;
  if (rules_.by_source) light.by_source = {light.direct, {}};
  DoubleColumns ground = double_columns(patches);
  SunFates fates = add_first_light(light, ground, realization, sources, sent);

  DoubleColumns first = ground;
  for (const auto* part : {&light.direct, &light.sky, &light.mirror}) add(first, *part);
  parallel_for(
      patches,
      [&](std::size_t i) {
        for (std::size_t k = 0; k < sources.suns.size(); ++k)
          first[i * block_width + k] += emitters.irradiance[i];
      },
      receivers_per_chunk);
  Reflected reflected = reflect(first, realization, sources.suns.front().number);
  light.reflected = std::move(reflected.irradiance);
  light.shot_radiosity = std::move(reflected.shot_radiosity);
  light.estimated = std::move(reflected.estimated);
  if (!light.estimated.empty()) add(light.reflected, light.estimated);
  if (light.by_source) light.by_source->shot = light.reflected;
  add(light.reflected, ground);
  fates += reflected.fates;
  light.samples = reflected.samples;
  light.wanted = reflected.wanted;
  light.rays = reflected.rays;

  book_first_light(light, realization, sources);
  for (std::size_t k = 0; k < sources.suns.size(); ++k) {
    Ledger& ledger = light.ledger[k];
    ledger += emitters.lamps;
    Fate<double> fate = fates[k];
    fate.cut += reflected.unshot[k];
    fate += emitters.fate;
    ledger += booked(fate);
    for (std::size_t i = 0; i < patches && !light.estimated.empty(); ++i)
      ledger.estimated += hierarchy_.area()[i] * light.estimated[i * block_width + k];
  }
  return light;
}

}  // namespace sunload
