// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sunlight exposure of EN 17037: 1.5, 3 and 4 hours on one day from 1 February to 21 March.
#include "io/measure/all_rules.h"
#include "io/measure/sun_day.h"

namespace sunload::rules {

MeasureRule en_17037() {
  // The standard tabulates the least elevation by place: the study writes it.
  return {.word = "en_17037",
          .definition =
              "exposure to sunlight: hours of possible sun on one day from 1 February to "
              "21 March; 1.5 h minimum, 3 h medium, 4 h high",
          .source = "EN 17037:2018 Daylight in buildings, 5.3, table A.6",
          .units = "h",
          .keys = {{"least_elevation_deg", {}}},
          .day = std::pair{3, 21},
          .needs = MeasureRule::Needs::sun_path,
          .levels =
              [](const MeasureParameters&) {
                return std::vector<MeasureLevel>{{"minimum", 1.5}, {"medium", 3}, {"high", 4}};
              },
          .start = start_sun_day};
}

}  // namespace sunload::rules
