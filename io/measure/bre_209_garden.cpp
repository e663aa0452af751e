// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Gardens by British practice: two hours of sun on 21 March on half of the area.
#include "io/measure/all_rules.h"
#include "io/measure/sun_day.h"

namespace sunload::rules {

MeasureRule bre_209_garden() {
  return {
      .word = "bre_209_garden",
      .definition =
          "hours of possible sun on 21 March; 2 h pass, for a garden on half of its "
          "area",
      .source = "BRE 209 (Littlefair 2022), Site layout planning for daylight and sunlight, 3.3",
      .units = "h",
      .keys = {{"least_elevation_deg", 0}, {"least_h", 2}},
      .day = std::pair{3, 21},
      .needs = MeasureRule::Needs::sun_path,
      .levels =
          [](const MeasureParameters& of) {
            return std::vector<MeasureLevel>{{"pass", of.number("least_h")}};
          },
      .start = start_sun_day};
}

}  // namespace sunload::rules
