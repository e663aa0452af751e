// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/realizations.h"

#include "geo/base/check.h"
#include "solver/base/chunks.h"
#include "solver/base/large_memory.h"
#include "solver/base/threads.h"
#include "solver/gather/jacobi.h"
#include "solver/gather/ledger.h"
#include "solver/gather/unfollowed.h"
#include "solver/mesh/push_pull.h"

namespace sunload {

namespace {

/// What came by direct samples of the sun; from here on gloss counts as mirrors.
std::vector<double> by_sun(std::size_t r, RaySums& sums) {
  std::vector<double> sun = sums.direct[r];
  parallel_for(
      sun.size(),
      [&](std::size_t i) {
        sun[i] += sums.mirror[r][i] + sums.circumsolar[r][i];
        if (!sums.gloss.empty()) sums.mirror[r][i] += sums.gloss[r][i];
      },
      receivers_per_chunk);
  return sun;
}

/// Keeps the parts of a realization that the tally has room for; `first` is used up.
void keep_parts(const std::vector<double>& direct, FirstExposure& first,
                std::vector<double> reflected, std::size_t r, ReceiverTally& tally) {
  const auto keep = [&](Part part, std::vector<double> exposure) {
    if (auto* to = part_of_realization(tally, part, r)) *to = std::move(exposure);
  };
  keep(Part::direct, direct);
  keep(Part::sky, std::move(first.sky));
  keep(Part::mirror, std::move(first.mirror));
  keep(Part::lamps, std::move(first.lamps));
  keep(Part::reflected, std::move(reflected));
}

/// Returns the radiosity that sensors see, if there are any.
std::vector<double> solve_patches(const TracedScene& traced, std::size_t band, std::size_t r,
                                  const TimeSums& sums, BatchTally& tally) {
  const PatchOptics& optics = traced.optics_of_band[band];
  const LineSet& lines = traced.patches.lines.realizations[r];
  const RaySums& rays = sums.on_patches;
  FirstExposure first = first_exposure(
      lines, optics, sums,
      {rays.direct[r], rays.mirror[r], rays.circumsolar[r], traced.patches.lamps.of(r)});
  auto reflected =
      reflect(traced.hierarchy(), lines, optics, first.base, first.ground, traced.bounces);
  const std::vector<double> estimated = unfollowed(reflected, traced.beyond_of_band[band]);
  std::vector<double>& exposure = tally.exposure_realization[r];
  exposure.resize(traced.patches.count());
  const auto add_patch = [&](std::size_t i, Ledger& ledger) {
    const double beyond = estimated.empty() ? 0 : estimated[i];
    const double total = first.base[i] + reflected.irradiance[i];
    exposure[i] = total + beyond;
    SUNLOAD_EXPECT(total + beyond >= 0, "light that is a number and not below 0");
    ledger += ledger_of_patch(
        {.area = traced.hierarchy().area()[i],
         .diffuse = static_cast<double>(optics.diffuse[i]),
         .absorbed = optics.absorbed(i),
         .passed = static_cast<double>(optics.passed[i]),
         .emission = static_cast<double>(optics.emission[i]) * sums.length_s,
         .direct = rays.direct[r][i],
         .sky = first.sky[i],
         .ground_exitance = sums.ground,
         .total = total,
         .gathered_radiosity = reflected.gathered_radiosity[i],
         .last = reflected.before.empty() ? total : reflected.irradiance[i] - reflected.before[i],
         .estimated = beyond},
        lines.ends[i]);
    reflected.irradiance[i] += beyond;
  };
  tally.ledger_realization[r] += ordered_sum(exposure.size(), receivers_per_chunk, Ledger{},
                                             [&](std::size_t begin, std::size_t end) {
                                               Ledger ledger;
                                               for (std::size_t i = begin; i < end; ++i)
                                                 add_patch(i, ledger);
                                               return ledger;
                                             });
  keep_parts(rays.direct[r], first, std::move(reflected.irradiance), r, tally);
  if (estimated.empty() || traced.sensors.count() == 0)
    return std::move(reflected.gathered_radiosity);
  std::vector<double> radiosity(traced.hierarchy().element_count());
  parallel_for(
      exposure.size(),
      [&](std::size_t i) { radiosity[i] = static_cast<double>(optics.diffuse[i]) * exposure[i]; },
      receivers_per_chunk);
  pull_up(traced.hierarchy(), radiosity);
  return radiosity;
}

/// What a realization was solved from gives room to what it got.
void forget(std::size_t r, RaySums& sums) {
  for (auto* kind : {&sums.direct, &sums.mirror, &sums.circumsolar, &sums.gloss})
    if (!kind->empty()) (*kind)[r] = {};
}

void book_mirrored(const TracedScene& traced, std::size_t r, const TimeSums& sums, Ledger& ledger) {
  ledger += ledger_of_mirrored(
      traced.patches.lines.realizations[r].mirrored_fates,
      [&](std::size_t c) { return sums.sky[c]; }, sums.ground);
  ledger += sums.sent_on[r];
  const auto& of_lamps = traced.patches.lamps.ledger;
  if (!of_lamps.empty()) ledger += scaled(of_lamps[r], sums.length_s);
}

void solve_sensors(const TracedScene& traced, const PatchOptics& optics, std::size_t r,
                   const TimeSums& sums, const std::vector<double>& radiosity,
                   ReceiverTally& tally) {
  const LineSet& lines = traced.sensors.lines.realizations[r];
  const std::vector<double> whole_sky;  // sensors see all of it by their lines
  FirstExposure first = first_exposure(lines, optics, sums,
                                       {sums.on_sensors.direct[r], sums.on_sensors.mirror[r],
                                        whole_sky, traced.sensors.lamps.of(r)});
  std::vector<double> reflected;
  gather_onto(lines.patches, radiosity, first.ground, reflected);
  tally.exposure_realization[r].resize(reflected.size());
  for (std::size_t s = 0; s < reflected.size(); ++s)
    tally.exposure_realization[r][s] = first.base[s] + reflected[s];
  keep_parts(sums.on_sensors.direct[r], first, std::move(reflected), r, tally);
}

}  // namespace

void solve_realizations(const TracedScene& traced, std::size_t band, TimeSums& sums,
                        BatchTally& tally) {
  // Columns of blocks, of which there are no more; the next batch wants series as large as these.
  return_large_memory(traced.hierarchy().element_count() * block_width * sizeof(float));
  for (std::size_t r = 0; r < sums.on_patches.direct.size(); ++r) {
    tally.by_source.sun.push_back(by_sun(r, sums.on_patches));
    const auto radiosity = solve_patches(traced, band, r, sums, tally);
    book_mirrored(traced, r, sums, tally.ledger_realization[r]);
    solve_sensors(traced, traced.optics_of_band[band], r, sums, radiosity, tally.sensors);
    forget(r, sums.on_patches);
    if (!traced.rules.by_source) continue;
    std::vector<double> parallel = traced.patches.lamps.of(r);
    for (double& E : parallel) E *= sums.length_s;
    tally.by_source.parallel.push_back(std::move(parallel));
  }
}

}  // namespace sunload
