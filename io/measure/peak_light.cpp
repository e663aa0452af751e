// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The largest light of the period and when it comes.
#include <limits>

#include "io/measure/all_rules.h"
#include "io/measure/series_measure.h"

namespace sunload::rules {

namespace {

class PeakLight : public SeriesMeasure {
 public:
  PeakLight(const std::string& light, const MeasuredScene& scene)
      : SeriesMeasure(light, scene), peak_(points(), 0), when_(points()) {}

  MeasureValues values() override {
    MeasureValues found{peak_};
    for (const SunSpan& when : when_)
      found.spans.push_back(when.length_s() > 0 ? std::vector{when} : std::vector<SunSpan>());
    return found;
  }

 protected:
  /// Of equal ones the first, in whatever order batches come.
  void take(std::size_t point, double value, const MeasuredInterval& interval) override {
    const bool is_earlier = value == peak_[point] && interval.begin < when_[point].begin;
    if (value <= 0 || (value <= peak_[point] && !is_earlier)) return;
    peak_[point] = value;
    when_[point] = {interval.begin, interval.end};
  }

 private:
  std::vector<double> peak_;
  std::vector<SunSpan> when_;
};

}  // namespace

MeasureRule peak_light() {
  return {.word = "peak_light",
          .definition =
              "the largest irradiance (illuminance) of the period; its span is the "
              "interval in which it comes",
          .source = "the study's own series",
          .units = "W m-2",
          .words = {{"light", {"total", "direct", "sky", "mirror", "lamps", "reflected"}}},
          .needs = MeasureRule::Needs::series,
          .start = [](const MeasureParameters& of,
                      const MeasuredScene& scene) -> std::unique_ptr<Measure> {
            return std::make_unique<PeakLight>(of.words.at("light"), scene);
          }};
}

}  // namespace sunload::rules
