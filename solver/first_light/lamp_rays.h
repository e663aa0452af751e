// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of receivers that look at a lamp: what each brings of it, as what is on its way lets
/// pass.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/first_light/direct_sun.h"
#include "solver/light/tally.h"
#include "solver/lines/line_follower.h"
#include "solver/mesh/patch_optics.h"

namespace sunload {

class LampRays {
 public:
  /// Surfaces of the scene; null for sensors, which send nothing on and are in no ledger.
  struct Surfaces {
    const Hierarchy& hierarchy;
    const PatchOptics& optics;
    const LineFollower& follower;
  };
  /// Light that mirrors left on a patch in one realization [W].
  struct Left {
    std::size_t realization;
    std::uint32_t patch;
    double power;
  };
  /// What the samples up to now brought beside irradiance: ledgers ([R], W), light that mirrors
  /// left on patches, and the count of rays.
  struct Found {
    std::vector<Ledger> ledger;
    std::vector<Left> left;
    std::uint64_t rays = 0;
  };
  /// Samples of one packet of a receiver.
  struct Look {
    Packet origins{};
    std::uint32_t active = 0;
    Vec3 to_lamp[packet_size] = {};       ///< unit
    double way_m[packet_size] = {};       ///< to the lamp
    double irradiance[packet_size] = {};  ///< if all samples were like this one [W m-2]

    void add(std::size_t sample, Vec3 direction, double way, double E);
  };

  /// Adds to `irradiance`, [R][N].
  LampRays(const RayCaster& caster, const SunSampler& sampler, const Surfaces* surfaces,
           std::vector<std::vector<double>>& irradiance);

  const SunSampler& sampler() const { return sampler_; }
  /// `purpose`: of random numbers of what surfaces send on.
  void look(std::size_t receiver, std::size_t packet, const Look& samples, Purpose purpose);
  Found& found() { return found_; }

 private:
  void send_on(std::size_t patch, std::size_t r, const RandomKey& key, Vec3 w, Vec3 origin,
               double power);

  const RayCaster& caster_;
  const SunSampler& sampler_;
  const Surfaces* surfaces_;
  std::vector<std::vector<double>>& irradiance_;
  std::vector<LinkTable::Link> met_;
  Found found_;
};

}  // namespace sunload
