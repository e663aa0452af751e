// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Shooting stochastic Jacobi: samples of light carry power from patch to patch.
///
/// An iteration carries the power P_i of every patch one reflection further,
///
///     E_j = (1/A_j) Σ_i F_ij P_i
///
/// F_ij is never formed: a uniformly distributed line from i first meets j with
/// that probability; where j is small as seen from i, it is an element of which patches are parts
/// and which receives as a whole (linked_element). Incremental: P_i = A_i rho_i E_i of what was
/// received last, results are added. Regular: P_i = A_i rho_i (E_0 + E_reflected) of all of it
/// again, with new samples. E_0 is what arrives without diffuse reflection:
/// direct sun and sky as when gathering, what mirrors send on (first_mirrored),
/// the light of lamps that are no surfaces, and the emitters' power, which is shot once.
///
/// Samples are independent from iteration to iteration and from realization to
/// realization: unbiased but for the light that is not followed. All suns of a
/// block share them (shot_power). Same key, same bits, for any number of threads.
/// Bekaert (1999), Hierarchical and stochastic algorithms for radiosity, PhD
/// thesis, K.U. Leuven; docs/developer/method.md, Shooting.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/first_light/lamp_light.h"
#include "solver/gather/block_light.h"
#include "solver/light/tally.h"
#include "solver/light/transport.h"
#include "solver/shoot/first_mirrored.h"
#include "solver/shoot/shot_power.h"

namespace sunload {

/// How much is shot, and how often it is reflected.
struct ShootingRules {
  int bounces = 5;
  Jacobi jacobi = Jacobi::incremental;
  /// Power of a sample [W] where all realizations are taken together. Absent:
  /// `samples_per_patch` for the first reflection and for the emitters, and samples of the same
  /// power from there on.
  std::optional<double> power_per_sample_w;
  int samples_per_patch =
      256;                 ///< over all realizations, in the mean of patches; of no power given
  bool by_source = false;  ///< keep ShotLight::by_source
};

/// Light of one realization of a block, [N][block] W m-2.
struct ShotLight {
  DoubleColumns direct, sky, mirror, reflected;
  DoubleColumns shot_radiosity;  ///< radiosity that was shot
  DoubleColumns estimated;       ///< part of `reflected` that bounces do not follow; empty: none
  const std::vector<double>* lamps = nullptr;  ///< [N], the same for all suns
  std::array<Ledger, block_width> ledger;      ///< W
  std::uint64_t samples = 0, rays = 0;         ///< shot; cast for them, chains included
  double wanted = 0;                           ///< samples, WorkDone
  /// What direct samples of the sun bring, mirrored included, and what samples of patches bring.
  struct BySource {
    DoubleColumns sun, shot;
  };
  std::optional<BySource> by_source;
  double total(std::size_t patch, std::size_t k) const {
    const std::size_t at = patch * block_width + k;
    return direct[at] + sky[at] + mirror[at] + (*lamps)[patch] + reflected[at];
  }
};

/// Solves realizations of a block. Scene, mesh, caster, sampler, grid, `lines` and `beyond` must
/// outlive it.
class Shooter {
 public:
  /// Sends on what mirrors receive from sky and ground, and shoots the emitters.
  /// `lines` are those of trace_lines by `line_rules`; `lamps` is with what mirrors send on;
  /// `beyond`: light_beyond, or empty.
  Shooter(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
          const SunSampler& sampler, const SkyGrid& grid, const PatchOptics& optics,
          const Lines& lines, const LampLight& lamps, const std::vector<float>& beyond,
          const LineRules& line_rules, const ShootingRules& rules);

  /// The sun's light that mirrors send on, for all realizations of a block at once.
  FirstMirrored::SentSuns send_sun(std::span<const IntervalLight> block) const;

  /// Solves one realization; `direct` is its direct sun.
  ShotLight light(std::size_t realization, const BlockSources& sources, const Columns& direct,
                  const FirstMirrored::SentSuns& sent) const;

  /// Of the constructor: samples shot by emitters, and wanted; rays cast, chains included.
  std::uint64_t samples() const { return samples_; }
  double wanted() const { return wanted_; }
  std::uint64_t rays() const { return rays_; }

 private:
  struct Address {
    std::uint32_t realization, sun, iteration;
  };
  struct Shot {
    DoubleColumns irradiance;
    SunFates fates;
    std::uint64_t samples = 0, rays = 0;
  };
  struct OfEmitters {
    std::vector<double> irradiance;  ///< lamps that are no surfaces included
    Fate<double> fate;               ///< of diffuse emitters' power [W]
    Ledger lamps;                    ///< that are no surfaces [W]
  };
  struct Reflected {
    DoubleColumns irradiance;
    DoubleColumns shot_radiosity;  ///< radiosity that was shot
    DoubleColumns estimated;       ///< irradiance beyond the last bounce; empty: none
    SunFates fates;
    SunTotals unshot{};
    std::uint64_t samples = 0, rays = 0;
    double wanted = 0;
  };
  class Task;
  Shot shoot(const DoubleColumns& power, double samples, const Address& address) const;
  void shoot_emitters();
  void add_lamps(const LampLight& lamps, const PatchOptics& optics);
  Reflected reflect(const DoubleColumns& first, std::size_t realization, std::uint32_t sun) const;
  DoubleColumns light_beyond_last(const DoubleColumns& last) const;
  DoubleColumns reflected_power(const DoubleColumns& received) const;
  double wanted_samples(const SunTotals& power, const SunTotals& first) const;
  SunFates add_first_light(ShotLight& light, DoubleColumns& ground, std::size_t realization,
                           const BlockSources& sources, const FirstMirrored::SentSuns& sent) const;
  void book_first_light(ShotLight& light, std::size_t realization,
                        const BlockSources& sources) const;

  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const Lines& lines_;
  const std::vector<float>& beyond_;
  LineRules line_rules_;
  ShootingRules rules_;
  LightChain chain_;
  FirstMirrored first_mirrored_;
  std::vector<double> receiver_area_;       ///< of patches, and of elements that receive as a whole
  std::vector<double> diffuse_, emission_;  ///< of patches
  std::vector<double> passed_;              ///< straight through
  std::vector<bool> sends_on_;
  std::vector<OfEmitters> emitters_;  ///< per realization
  std::uint64_t samples_ = 0, rays_ = 0;
  double wanted_ = 0;
};

}  // namespace sunload
