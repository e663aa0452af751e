// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hours with the glint of mirrors: on streets, windows, observers.
#include "io/measure/all_rules.h"
#include "io/measure/series_measure.h"

namespace sunload::rules {

MeasureRule glint_hours() {
  return {
      .word = "glint_hours",
      .definition =
          "hours of the period with more light by way of mirrors than a threshold, by "
          "the means of its intervals",
      .source = "the study's own limits",
      .units = "h",
      .keys = {{"above_w_m2", 0, true}, {"above_lx", 0, true}, {"most_h", 0}},
      .needs = MeasureRule::Needs::series,
      .light = "mirror",
      .better = MeasureRule::Better::less,
      .levels = [](const MeasureParameters& of) -> std::vector<MeasureLevel> {
        if (of.number("most_h") == 0) return {};
        return {{"pass", of.number("most_h")}};
      },
      .start = [](const MeasureParameters& of,
                  const MeasuredScene& scene) { return start_light_hours("mirror", of, scene); }};
}

}  // namespace sunload::rules
