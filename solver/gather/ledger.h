// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What one patch, or first light that mirrors sent on, brings into the ledger.
#pragma once

#include "solver/light/tally.h"
#include "solver/lines/lines.h"

namespace sunload {

/// What one patch receives and sends, all W m-2 (or J m-2).
struct PatchLight {
  double area = 0;
  double diffuse = 0;             ///< reflectance
  double absorbed = 0;            ///< constant share; 0 where lines book what is absorbed
  double passed = 0;              ///< share that goes straight through
  double emission = 0;            ///< exitance of an emitter
  double direct = 0, sky = 0;     ///< irradiance straight from sun and sky
  double ground_exitance = 0;     ///< of the far ground
  double total = 0;               ///< irradiance in all, but for what is estimated
  double gathered_radiosity = 0;  ///< reflected radiosity that was gathered last
  double last = 0;                ///< irradiance by the last bounce: what is not reflected
  double estimated = 0;           ///< irradiance by light that is not followed
};

/// Terms of one patch, each from an estimate of its own, none by difference. Its lines tell where
/// the light ends that it sends, and what panes transmit and absorb of that at their angles; its
/// irradiance tells what it absorbs itself. Light that passes straight through a patch is met
/// further on, or leaves the scene: it counts where it is stopped.
inline Ledger ledger_of_patch(const PatchLight& p, const LineEnds& ends) {
  const double sent = p.area * (p.gathered_radiosity + p.emission);
  const double stopped = 1 - p.passed;
  Ledger ledger;
  ledger[Term::sun] = p.area * p.direct * stopped;
  ledger[Term::sky] = p.area * p.sky * stopped;
  ledger[Term::ground] = p.area * static_cast<double>(ends.ground) * p.ground_exitance * stopped;
  ledger[Term::emitted] = p.area * p.emission;
  ledger[Term::absorbed] = p.area * p.absorbed * p.total;
  ledger[Term::unshot] = p.area * p.diffuse * p.last;
  ledger.estimated = p.area * p.estimated;
  return booked(scaled(in_double(ends.fate), sent), ledger);
}

/// First light of sky and far ground that mirrors sent on. `sky(c)` is π times
/// the radiance of cell c.
template <class SkyOfCell>
Ledger ledger_of_mirrored(const MirroredFates& fates, SkyOfCell&& sky, double ground_exitance) {
  Ledger ledger;
  for (std::size_t c = 0; c < fates.size(); ++c)
    ledger += scaled(booked(fates[c]), c + 1 < fates.size() ? sky(c) : ground_exitance);
  return ledger;
}

}  // namespace sunload
