// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shoot/first_mirrored.h"

#include <bit>

#include "geo/base/keys.h"
#include "solver/base/random_blocks.h"
#include "solver/base/threads.h"
#include "solver/light/sun_samples.h"
#include "solver/lines/patch_lines.h"

namespace sunload {

namespace {

constexpr std::size_t mirrors_per_task = 256;

std::size_t tasks(std::size_t mirrors) {
  return (mirrors + mirrors_per_task - 1) / mirrors_per_task;
}

}  // namespace

/// The lines of mirror patches in one task and realization.
class FirstMirrored::LineTask {
 public:
  LineTask(const FirstMirrored& mirrored, std::size_t realization)
      : sky_fates(static_cast<std::size_t>(mirrored.grid_.cell_count())),
        m_(mirrored),
        realization_(realization) {}

  void run(std::size_t patch) {
    const PatchLines lines(m_.hierarchy_, patch, m_.caster_.offset_m(),
                           line_seeds(m_.hierarchy_, patch, realization_, m_.rules_.seed));
    const auto count = static_cast<std::size_t>(m_.rules_.lines_of(patch) / m_.rules_.realizations);
    const double share = m_.hierarchy_.area()[patch] / static_cast<double>(count);
    // Packets as in trace_lines, so that the same lines are found to leave.
    for (std::size_t first = 0; first < count; first += packet_size)
      run_packet(LinePacket(lines, first, count), patch, first, share);
  }

  std::vector<Deposit> sky, ground;
  std::vector<Fate<double>> sky_fates;
  Fate<double> ground_fate;
  std::uint64_t rays = 0;

 private:
  void run_packet(const LinePacket& lines, std::size_t patch, std::size_t first, double share) {
    const auto hits = lines.first_hits(m_.caster_);
    rays += lines.count;
    for (std::size_t l = 0; l < lines.count; ++l) {
      if (!hits[l].left_scene()) continue;
      const auto& [origin, w] = lines.line[l];
      const bool up = w.z > 0;
      const auto source = up ? static_cast<std::uint32_t>(m_.grid_.cell(w)) : 0u;
      const Followed sent = m_.chain_.mirror_on(origin, w, patch, source, share,
                                                key(patch, first + l), up ? sky : ground);
      (up ? sky_fates[source] : ground_fate) += sent.fate;
      rays += sent.rays;
    }
  }

  RandomKey key(std::size_t patch, std::size_t line) const {
    return {.seed = m_.rules_.seed,
            .purpose = Purpose::shooting,
            .realization = static_cast<std::uint32_t>(realization_),
            .element = m_.hierarchy_.key()[patch],
            .sun = static_cast<std::uint32_t>(line),
            .block = shot_blocks::of_mirrored_sky.first};
  }

  const FirstMirrored& m_;
  std::size_t realization_;
};

FirstMirrored::FirstMirrored(const Scene& scene, const Hierarchy& hierarchy,
                             const RayCaster& caster, const SunSampler& sampler,
                             const SkyGrid& grid, const LineRules& rules)
    : hierarchy_(hierarchy),
      caster_(caster),
      sampler_(sampler),
      grid_(grid),
      chain_(scene, hierarchy, caster, rules.mirror_depth, 0),
      rules_(rules) {
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i)
    if (sends_on(scene.material_of(hierarchy.patches()[i].triangle))) mirrors_.push_back(i);
  if (!any()) return;
  const auto cells = static_cast<std::size_t>(grid.cell_count());
  const std::size_t chunks = tasks(mirrors_.size());
  for (std::size_t r = 0; r < static_cast<std::size_t>(rules.realizations); ++r) {
    OfRealization& light = of_realization_.emplace_back();
    light.sky = {Deposits(chunks), std::vector<Fate<double>>(cells)};
    light.ground = {Deposits(chunks), std::vector<Fate<double>>(1)};
    std::vector<LineTask> traced(chunks, LineTask(*this, r));
    parallel_chunks(mirrors_.size(), mirrors_per_task, [&](std::size_t begin, std::size_t end) {
      const std::size_t chunk = begin / mirrors_per_task;
      LineTask& task = traced[chunk];
      for (std::size_t m = begin; m < end; ++m) task.run(mirrors_[m]);
      light.sky.deposits.put(chunk, std::move(task.sky));
      light.ground.deposits.put(chunk, std::move(task.ground));
    });
    for (const LineTask& task : traced) {
      for (std::size_t c = 0; c < cells; ++c) light.sky.fates[c] += task.sky_fates[c];
      light.ground.fates[0] += task.ground_fate;
      rays_ += task.rays;
    }
  }
}

FirstMirrored::Light FirstMirrored::light_of(const OfSource& source,
                                             const DoubleColumns& exitance) const {
  Light light{double_columns(hierarchy_.patch_count()), {}};
  source.deposits.add_to(light.irradiance, exitance, hierarchy_.area());
  for (std::size_t c = 0; c < source.fates.size(); ++c)
    light.fates.add(source.fates[c], &exitance[c * block_width]);
  return light;
}

FirstMirrored::Light FirstMirrored::sky(std::size_t realization, const DoubleColumns& sky) const {
  return light_of(of_realization_[realization].sky, sky);
}

FirstMirrored::Light FirstMirrored::ground(std::size_t realization,
                                           const DoubleColumns& exitance) const {
  return light_of(of_realization_[realization].ground, exitance);
}

/// The sun on mirror patches in one task; its sources are the suns of the block.
class FirstMirrored::SunTask {
 public:
  explicit SunTask(const FirstMirrored& mirrored)
      : deposits(static_cast<std::size_t>(mirrored.rules_.realizations)),
        fates(deposits.size()),
        m_(mirrored) {}

  void run(std::size_t patch, std::span<const IntervalLight> block) {
    const auto geometry = m_.sampler_.geometry(patch);
    const double samples_each =
        static_cast<double>(m_.sampler_.samples()) / static_cast<double>(deposits.size());
    for (std::size_t k = 0; k < block.size(); ++k) {
      const IntervalLight& sun = block[k];
      const double cos_theta = dot(geometry.normal, sun.direction);
      if (!sun.has_sun() || sun.dni <= 0 || cos_theta <= 0) continue;
      const double power = m_.hierarchy_.area()[patch] * sun.dni * cos_theta / samples_each;
      m_.sampler_.seed(patch, sun.number, seeds_);
      for (std::size_t p = 0; p < m_.sampler_.packets(); ++p)
        send_packet(lit_samples(m_.sampler_, m_.caster_, sun, geometry, seeds_, p), p, patch, sun,
                    k, power);
    }
  }

  std::vector<std::vector<Deposit>> deposits;  ///< per realization [W]
  std::vector<SunFates> fates;                 ///< per realization [W]
  std::uint64_t rays = 0;

 private:
  void send_packet(const LitSamples& samples, std::size_t packet, std::size_t patch,
                   const IntervalLight& sun, std::size_t k, double power) {
    const Vec3 n = m_.hierarchy_.normal(patch);
    rays += static_cast<std::uint64_t>(std::popcount(samples.active));
    for (auto lit = samples.lit; lit != 0; lit &= lit - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(lit));
      const std::size_t sample = packet * packet_size + l, r = m_.sampler_.realization(sample);
      const RandomKey key{.seed = m_.rules_.seed,
                          .purpose = Purpose::shooting,
                          .realization = static_cast<std::uint32_t>(r),
                          .element = mixed(m_.hierarchy_.key()[patch], sample),
                          .sun = sun.number,
                          .block = shot_blocks::of_mirrored_sun.first};
      const Followed sent =
          m_.chain_.mirror_on(at(samples.origins, l), sun_before(n, sun, at(samples.to_sun, l)),
                              patch, static_cast<std::uint32_t>(k),
                              power * static_cast<double>(samples.share[l]), key, deposits[r]);
      fates[r][k] += sent.fate;
      rays += sent.rays;
    }
  }

  const FirstMirrored& m_;
  SunSampler::Seeds seeds_;
};

namespace {

/// Row k sends to sun k alone: power 1.
DoubleColumns one_watt_per_sun() {
  DoubleColumns power = double_columns(block_width);
  for (std::size_t k = 0; k < block_width; ++k) power[k * block_width + k] = 1;
  return power;
}

}  // namespace

FirstMirrored::SentSuns FirstMirrored::send(std::span<const IntervalLight> block) const {
  SentSuns sent;
  if (!any()) return sent;
  const std::size_t chunks = tasks(mirrors_.size());
  sent.of_realization.resize(static_cast<std::size_t>(rules_.realizations), {Deposits(chunks), {}});
  const auto suns = suns_one_by_one(block);
  std::vector<SunTask> parts(chunks, SunTask(*this));
  parallel_chunks(mirrors_.size(), mirrors_per_task, [&](std::size_t begin, std::size_t end) {
    const std::size_t chunk = begin / mirrors_per_task;
    for (std::size_t m = begin; m < end; ++m)
      for (const auto& of_intervals : suns) parts[chunk].run(mirrors_[m], of_intervals);
    for (std::size_t r = 0; r < sent.of_realization.size(); ++r)
      sent.of_realization[r].deposits.put(chunk, std::move(parts[chunk].deposits[r]));
  });
  for (const SunTask& part : parts) {
    sent.rays += part.rays;
    for (std::size_t r = 0; r < sent.of_realization.size(); ++r)
      sent.of_realization[r].fates += part.fates[r];
  }
  return sent;
}

FirstMirrored::Light FirstMirrored::sun(const SentSun& sent) const {
  Light light{double_columns(hierarchy_.patch_count()), sent.fates};
  sent.deposits.add_to(light.irradiance, one_watt_per_sun(), hierarchy_.area());
  return light;
}

}  // namespace sunload
