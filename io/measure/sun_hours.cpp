// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hours of sun by limits that the study writes.
#include "io/measure/all_rules.h"
#include "io/measure/sun_day.h"

namespace sunload::rules {

MeasureRule sun_hours() {
  return {.word = "sun_hours",
          .definition =
              "hours of possible sun on a day, of spans that are long enough, or the "
              "longest one alone",
          .source = "the study's own limits",
          .units = "h",
          .keys = {{"least_elevation_deg", 0},
                   {"least_angle_deg", 0},
                   {"least_plan_angle_deg", 0},
                   {"least_span_min", 0},
                   {"least_h", 0}},
          .words = {{"count", {"all", "longest"}}},
          .day = std::pair{0, 0},
          .needs = MeasureRule::Needs::sun_path,
          .levels = [](const MeasureParameters& of) -> std::vector<MeasureLevel> {
            if (of.number("least_h") == 0) return {};
            return {{"pass", of.number("least_h")}};
          },
          .start = start_sun_day};
}

}  // namespace sunload::rules
