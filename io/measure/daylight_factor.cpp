// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a place has of the light on open level ground while no sun shines.
#include <limits>

#include "io/measure/all_rules.h"
#include "io/measure/series_measure.h"

namespace sunload::rules {

namespace {

class DaylightFactor : public SeriesMeasure {
 public:
  DaylightFactor(const std::string& light, const MeasuredScene& scene)
      : SeriesMeasure(light, scene), here_(points(), 0), in_the_open_(points(), 0) {}

  MeasureValues values() override {
    constexpr double percent = 100;
    MeasureValues found{here_};
    for (std::size_t p = 0; p < found.value.size(); ++p)
      found.value[p] = in_the_open_[p] > 0 ? percent * here_[p] / in_the_open_[p]
                                           : std::numeric_limits<double>::quiet_NaN();
    return found;
  }

 protected:
  void take(std::size_t point, double value, const MeasuredInterval& interval) override {
    if (!is_without_sun(interval)) return;
    const double length_s = interval.end - interval.begin;
    here_[point] += value * length_s;
    in_the_open_[point] += interval.dhi * length_s;
  }

 private:
  std::vector<double> here_, in_the_open_;
};

}  // namespace

MeasureRule daylight_factor() {
  return {.word = "daylight_factor",
          .definition =
              "light as a share of that on open level ground, over intervals without direct sun; "
              "of an overcast sky the daylight factor",
          .source = "CIE S 017:2020, 17-29-121",
          .units = "percent",
          .keys = {{"least_percent", 0}},
          .words = {{"light", {"total", "sky", "reflected"}}},
          .needs = MeasureRule::Needs::series,
          .counts = MeasureRule::Counts::without_sun,
          .levels = [](const MeasureParameters& of) -> std::vector<MeasureLevel> {
            if (of.number("least_percent") == 0) return {};
            return {{"pass", of.number("least_percent")}};
          },
          .start = [](const MeasureParameters& of,
                      const MeasuredScene& scene) -> std::unique_ptr<Measure> {
            return std::make_unique<DaylightFactor>(of.words.at("light"), scene);
          }};
}

}  // namespace sunload::rules
