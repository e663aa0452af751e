// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/lamp_rays.h"

#include <algorithm>
#include <bit>

namespace sunload {

void LampRays::Look::add(std::size_t sample, Vec3 direction, double way, double E) {
  active |= 1u << sample;
  to_lamp[sample] = direction;
  way_m[sample] = way;
  irradiance[sample] = E;
}

LampRays::LampRays(const RayCaster& caster, const SunSampler& sampler, const Surfaces* surfaces,
                   std::vector<std::vector<double>>& irradiance)
    : caster_(caster), sampler_(sampler), surfaces_(surfaces), irradiance_(irradiance) {
  found_.ledger.resize(irradiance.size());
}

void LampRays::look(std::size_t receiver, std::size_t packet, const Look& samples,
                    Purpose purpose) {
  if (samples.active == 0) return;
  Packet ways{};
  for (auto active = samples.active; active != 0; active &= active - 1) {
    const auto l = static_cast<std::size_t>(std::countr_zero(active));
    // What bears the lamp may lie in its plane, or at its point.
    put(ways, l, samples.to_lamp[l] * std::max(0.0, samples.way_m[l] - caster_.offset_m()));
  }
  found_.rays += static_cast<std::uint64_t>(std::popcount(samples.active));
  const auto each =
      static_cast<double>(sampler_.samples()) / static_cast<double>(irradiance_.size());
  const auto shares = caster_.passed_up_to(samples.origins, ways, samples.active);
  for (auto active = samples.active; active != 0; active &= active - 1) {
    const auto l = static_cast<std::size_t>(std::countr_zero(active));
    if (shares[l] <= 0) continue;
    const std::size_t sample = packet * packet_size + l, r = sampler_.realization(sample);
    const double E = samples.irradiance[l] * static_cast<double>(shares[l]) / each;
    irradiance_[r][receiver] += E;
    if (!surfaces_) continue;
    const auto& [hierarchy, optics, follower] = *surfaces_;
    const double area = hierarchy.area()[receiver];
    // What passes a screen is met further on.
    found_.ledger[r][Term::emitted] +=
        E * area * (1 - static_cast<double>(optics.passed[receiver]));
    if (!sends_on(follower.material_of_patch(receiver))) continue;
    send_on(receiver, r,
            {.seed = sampler_.study_seed(),
             .purpose = purpose,
             .realization = static_cast<std::uint32_t>(r),
             .element = hierarchy.key()[receiver],
             .sun = static_cast<std::uint32_t>(sample)},
            samples.to_lamp[l], at(samples.origins, l), E * area);
  }
}

/// What a mirror patch got from the direction w by one sample.
void LampRays::send_on(std::size_t patch, std::size_t r, const RandomKey& key, Vec3 w, Vec3 origin,
                       double power) {
  met_.clear();
  const auto sent = surfaces_->follower.mirrored_on(origin, w, patch, key, &met_);
  found_.rays += sent.rays;
  found_.ledger[r] += scaled(booked(sent.fate), power);
  for (const auto& met : met_)
    found_.left.push_back({r, met.target, power * static_cast<double>(met.weight)});
}

}  // namespace sunload
