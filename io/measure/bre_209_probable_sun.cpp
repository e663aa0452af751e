// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Annual and winter probable sunlight hours of British practice.
#include <limits>

#include "io/measure/all_rules.h"
#include "io/measure/bright_intervals.h"

namespace sunload::rules {

namespace {

constexpr double least_of_year_percent = 25, least_of_winter_percent = 5;

bool is_of_winter(const MeasureParameters& of) { return of.words.at("season") == "winter"; }

class ProbableSun : public Measure {
 public:
  ProbableSun(InSeason season, const MeasuredScene& scene) : season_(season), scene_(scene) {}
  MeasureValues values() override {
    constexpr double percent = 100;
    const auto suns = bright_stretches(scene_, sunshine_w_m2);
    const auto counted = bright_stretches(scene_, sunshine_w_m2, season_);
    double all_s = 0;
    for (const SunStretch& sun : suns) all_s += sun.length_s;
    MeasureValues found{seen_sun_s(scene_.points, scene_.caster, counted)};
    for (double& value : found.value)
      value = all_s > 0 ? percent * value / all_s : std::numeric_limits<double>::quiet_NaN();
    return found;
  }

 private:
  InSeason season_;
  const MeasuredScene& scene_;
};

}  // namespace

MeasureRule bre_209_probable_sun() {
  return {.word = "bre_209_probable_sun",
          .definition =
              "probable sunlight hours: share of the year's sunshine that the surface sees; 25 % "
              "pass, and 5 % in winter (21 September to 21 March, in the south half a year "
              "later, days included)",
          .source = "BRE 209 (Littlefair 2022), 3.2; sunshine as of WMO",
          .units = "percent",
          .words = {{"season", {"year", "winter"}}},
          .needs = MeasureRule::Needs::intervals,
          .spans = MeasureRule::Spans::year_of_weather,
          .levels =
              [](const MeasureParameters& of) {
                return std::vector<MeasureLevel>{
                    {"pass", is_of_winter(of) ? least_of_winter_percent : least_of_year_percent}};
              },
          .start = [](const MeasureParameters& of,
                      const MeasuredScene& scene) -> std::unique_ptr<Measure> {
            return std::make_unique<ProbableSun>(
                is_of_winter(of) ? InSeason::winter : InSeason::year, scene);
          }};
}

}  // namespace sunload::rules
