// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The ground beyond the scene, which shines back below the horizon: how much, and when.
#pragma once

#include <vector>

#include "geo/time/time.h"
#include "io/plan/light_series.h"
#include "io/study/study.h"

namespace sunload {

/// Albedo of the far ground as a study has it, with its seasons in civil time of the site.
class FarGround {
 public:
  explicit FarGround(const Study& study);

  /// Albedo of the last season that holds in the middle of the interval and has one; else the
  /// constant one of the study, or that of the weather, which must tell it
  /// (io/plan/weather_albedo.h).
  double albedo(const LitInterval& interval) const;

 private:
  struct Season {
    SeasonStudy when;
    double albedo;
  };
  double always_;
  bool is_of_weather_;
  std::vector<Season> seasons_;  ///< in the order of the study's seasons
  TimeZone zone_;
};

}  // namespace sunload
