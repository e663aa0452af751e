// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "geo/base/units.h"
#include "io/measure/all_rules.h"
#include "io/measure/series_measure.h"

namespace sunload {

namespace {

class LightHours : public SeriesMeasure {
 public:
  LightHours(const std::string& light, double above, const MeasuredScene& scene)
      : SeriesMeasure(light, scene), above_(above), lit_s_(points(), 0) {}

  MeasureValues values() override {
    MeasureValues found{lit_s_};
    for (double& value : found.value) value /= seconds_per_hour;
    return found;
  }

 protected:
  void take(std::size_t point, double value, const MeasuredInterval& interval) override {
    if (value > above_) lit_s_[point] += interval.end - interval.begin;
  }

 private:
  double above_;
  std::vector<double> lit_s_;
};

}  // namespace

std::unique_ptr<Measure> start_light_hours(const std::string& light,
                                           const MeasureParameters& parameters,
                                           const MeasuredScene& scene) {
  return std::make_unique<LightHours>(
      light, std::max(parameters.number("above_w_m2"), parameters.number("above_lx")), scene);
}

namespace rules {

MeasureRule light_hours() {
  return {.word = "light_hours",
          .definition =
              "hours of the period with more irradiance (illuminance) than a threshold, "
              "by the means of its intervals",
          .source = "the study's own limits",
          .units = "h",
          .keys = {{"above_w_m2", 0, true}, {"above_lx", 0, true}, {"least_h", 0}},
          .words = {{"light", {"total", "direct", "sky", "mirror", "lamps", "reflected"}}},
          .needs = MeasureRule::Needs::series,
          .levels = [](const MeasureParameters& of) -> std::vector<MeasureLevel> {
            if (of.number("least_h") == 0) return {};
            return {{"pass", of.number("least_h")}};
          },
          .start =
              [](const MeasureParameters& of, const MeasuredScene& scene) {
                return start_light_hours(of.words.at("light"), of, scene);
              }};
}

}  // namespace rules

}  // namespace sunload
