// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/realizations.h"

#include "solver/gather/jacobi.h"
#include "solver/gather/ledger.h"

namespace sunload {

namespace {

/// What came by direct samples of the sun; from here on gloss counts as mirrors.
std::vector<double> by_sun(std::size_t r, RaySums& sums) {
  std::vector<double> sun = sums.direct[r];
  for (std::size_t i = 0; i < sun.size(); ++i) {
    sun[i] += sums.mirror[r][i] + sums.circumsolar[r][i];
    if (!sums.gloss.empty()) sums.mirror[r][i] += sums.gloss[r][i];
  }
  return sun;
}

/// Returns the radiosity that was gathered last.
std::vector<double> solve_patches(const TracedScene& traced, const PatchOptics& optics,
                                  std::size_t r, const TimeSums& sums, BatchTally& tally) {
  const LineSet& lines = traced.patches.lines.realizations[r];
  const RaySums& rays = sums.on_patches;
  const auto [sky, base, ground] = first_exposure(
      lines, optics, sums,
      {rays.direct[r], rays.mirror[r], rays.circumsolar[r], traced.patches.lamps.of(r)});
  auto reflected = reflect(traced.hierarchy(), lines, optics, base, ground, traced.bounces);
  for (std::size_t i = 0; i < traced.patches.count(); ++i) {
    const double total = base[i] + reflected.irradiance[i];
    tally.exposure_realization[r][i] = total;
    tally.ledger_realization[r] +=
        ledger_of_patch({.area = traced.hierarchy().area()[i],
                         .diffuse = static_cast<double>(optics.diffuse[i]),
                         .absorbed = optics.absorbed(i),
                         .passed = static_cast<double>(optics.passed[i]),
                         .emission = static_cast<double>(optics.emission[i]) * sums.length_s,
                         .direct = rays.direct[r][i],
                         .sky = sky[i],
                         .ground_exitance = sums.ground,
                         .total = total,
                         .gathered_radiosity = reflected.gathered_radiosity[i]},
                        lines.ends[i]);
  }
  return std::move(reflected.gathered_radiosity);
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
                   const TimeSums& sums, const std::vector<double>& gathered_radiosity,
                   ReceiverTally& tally) {
  const LineSet& lines = traced.sensors.lines.realizations[r];
  const std::vector<double> whole_sky;  // sensors see all of it by their lines
  const auto [sky, base, ground] =
      first_exposure(lines, optics, sums,
                     {sums.on_sensors.direct[r], sums.on_sensors.mirror[r], whole_sky,
                      traced.sensors.lamps.of(r)});
  auto& received = tally.exposure_realization[r];
  gather(lines.patches, gathered_radiosity, received, Into::replace);
  for (std::size_t s = 0; s < received.size(); ++s) received[s] += base[s] + ground[s];
}

}  // namespace

void solve_realizations(const TracedScene& traced, const PatchOptics& optics, TimeSums& sums,
                        BatchTally& tally) {
  for (std::size_t r = 0; r < sums.on_patches.direct.size(); ++r) {
    tally.by_source.sun.push_back(by_sun(r, sums.on_patches));
    const auto gathered_radiosity = solve_patches(traced, optics, r, sums, tally);
    book_mirrored(traced, r, sums, tally.ledger_realization[r]);
    solve_sensors(traced, optics, r, sums, gathered_radiosity, tally.sensors);
    if (!traced.rules.by_source) continue;
    std::vector<double> parallel = traced.patches.lamps.of(r);
    for (double& E : parallel) E *= sums.length_s;
    tally.by_source.parallel.push_back(std::move(parallel));
  }
}

}  // namespace sunload
