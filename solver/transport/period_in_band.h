// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A period in the light of one band.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "solver/gather/band_light.h"
#include "solver/light/lit_period.h"

namespace sunload {

class PeriodInBand : public LitPeriod {
 public:
  /// `whole`, which must outlive it, has the light of all bands.
  PeriodInBand(const LitPeriod& whole, std::size_t band) : whole_(whole), band_(band) {}

  std::size_t intervals() const override { return whole_.intervals(); }
  bool is_dark(std::size_t interval) const override { return whole_.is_dark(interval); }
  bool has_sun(std::size_t interval) const override { return whole_.has_sun(interval); }
  Vec3 direction(std::size_t interval) const override { return whole_.direction(interval); }
  std::vector<Vec3> suns(std::size_t interval) const override { return whole_.suns(interval); }
  IntervalLight of(std::size_t interval) const override {
    const IntervalLight light = whole_.of(interval);
    return std::move(suns_in_band(std::span(&light, 1), band_).front());
  }

 private:
  const LitPeriod& whole_;
  std::size_t band_;
};

}  // namespace sunload
