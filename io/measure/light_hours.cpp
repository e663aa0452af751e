// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/measure/light_hours.h"

#include <algorithm>

#include "geo/base/units.h"
#include "io/measure/all_rules.h"

namespace sunload {

namespace {

class LightHours : public Measure {
 public:
  LightHours(std::string series, double above, const MeasuredScene& scene)
      : series_(std::move(series)), above_(above), scene_(scene), hours_(scene.points.size(), 0) {}

  std::string series() const override { return series_; }

  void watch(const SeriesRows& rows) override {
    for (std::size_t row = 0; row < rows.rows; ++row) {
      const MeasuredInterval& interval = scene_.intervals[rows.first + row];
      add(rows.patch, row, 0, scene_.patches, interval.end - interval.begin);
      add(rows.sensor, row, scene_.patches, scene_.points.size() - scene_.patches,
          interval.end - interval.begin);
    }
  }

  MeasureValues values() override {
    MeasureValues found{hours_, {}, {}};
    for (double& value : found.value) value /= seconds_per_hour;
    return found;
  }

 private:
  void add(const std::vector<double>& values, std::size_t row, std::size_t first, std::size_t n,
           double length_s) {
    for (std::size_t i = 0; i < n; ++i)
      if (values[row * n + i] > above_) hours_[first + i] += length_s;
  }

  std::string series_;
  double above_;
  const MeasuredScene& scene_;
  std::vector<double> hours_;  ///< in seconds until the end
};

}  // namespace

std::unique_ptr<Measure> start_light_hours(const std::string& light,
                                           const MeasureParameters& parameters,
                                           const MeasuredScene& scene) {
  return std::make_unique<LightHours>(
      light == "total" ? "irradiance" : "irradiance_" + light,
      std::max(parameters.number("above_w_m2"), parameters.number("above_lx")), scene);
}

namespace rules {

MeasureRule light_hours() {
  return {.word = "light_hours",
          .definition =
              "hours of the period with more irradiance (illuminance) than a threshold, "
              "by the means of its intervals",
          .source = "the study's own limits",
          .units = "h",
          .keys = {{"above_w_m2", 0}, {"above_lx", 0}, {"least_h", 0}},
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
