// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What roofs (or walls) are good for, by the irradiation of a year.
#include "geo/base/units.h"
#include "io/measure/all_rules.h"
#include "io/measure/series_measure.h"

namespace sunload::rules {

namespace {

class YearlyLight : public SeriesMeasure {
 public:
  explicit YearlyLight(const MeasuredScene& scene)
      : SeriesMeasure("total", scene), exposure_(points(), 0) {}

  MeasureValues values() override {
    MeasureValues found{exposure_};
    for (double& value : found.value) value /= joules_per_kwh;
    return found;
  }

 protected:
  void take(std::size_t point, double value, const MeasuredInterval& interval) override {
    exposure_[point] += value * (interval.end - interval.begin);
  }

 private:
  std::vector<double> exposure_;  ///< J m-2
};

}  // namespace

MeasureRule roof_potential() {
  return {.word = "roof_potential",
          .definition =
              "irradiation of a year; suitability for solar energy: medium from 800, good "
              "from 1000, very good from 1200, excellent from 1400 kWh/m²",
          .source = "classes of the Swiss solar cadastre (Federal Office of Energy, sonnendach.ch)",
          .units = "kWh m-2",
          .needs = MeasureRule::Needs::series,
          .spans = MeasureRule::Spans::whole_year,
          .levels =
              [](const MeasureParameters&) {
                return std::vector<MeasureLevel>{
                    {"medium", 800}, {"good", 1000}, {"very_good", 1200}, {"excellent", 1400}};
              },
          .start = [](const MeasureParameters&, const MeasuredScene& scene)
              -> std::unique_ptr<Measure> { return std::make_unique<YearlyLight>(scene); }};
}

}  // namespace sunload::rules
