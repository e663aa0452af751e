// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The Czech rule for dwellings: 90 minutes of sun on 1 March.
#include "io/measure/all_rules.h"
#include "io/measure/sun_day.h"

namespace sunload::rules {

MeasureRule csn_73_4301() {
  constexpr double elevation_deg = 5, plan_angle_deg = 25, least_h = 1.5;
  return {.word = "csn_73_4301",
          .definition =
              "hours of possible sun on 1 March at 5° and higher, in plan at 25° or more "
              "to the window's plane; 1.5 h pass",
          .source = "ČSN 73 4301:2004 Obytné budovy, 4.3",
          .units = "h",
          .keys = {{"least_elevation_deg", elevation_deg},
                   {"least_plan_angle_deg", plan_angle_deg},
                   {"least_h", least_h}},
          .day = std::pair{3, 1},
          .needs = MeasureRule::Needs::sun_path,
          .levels =
              [](const MeasureParameters& of) {
                return std::vector<MeasureLevel>{{"pass", of.number("least_h")}};
              },
          .start = start_sun_day};
}

}  // namespace sunload::rules
