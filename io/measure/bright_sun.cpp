// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hours of sunshine as weather stations count them, where nothing stands before the sun.
#include <optional>
#include <utility>

#include "geo/base/units.h"
#include "io/measure/all_rules.h"
#include "io/measure/bright_intervals.h"

namespace sunload {

namespace {

/// From the equinox of autumn to that of spring, as British practice takes them, both days
/// included, by the site's clock.
class Winter {
 public:
  explicit Winter(const Site& site) : zone_(site.timezone), is_south_(site.latitude_deg < 0) {}
  bool has(const MeasuredInterval& interval) const {
    constexpr std::pair march{3, 21}, september{9, 21};
    const UnixTime middle = interval.begin + (interval.end - interval.begin) / 2;
    const CivilTime date = zone_.civil_from_utc(middle);
    const auto place = std::pair(date.month, date.day);
    return is_south_ ? place >= march && place <= september : place <= march || place >= september;
  }

 private:
  TimeZone zone_;
  bool is_south_;
};

}  // namespace

std::vector<SunStretch> bright_stretches(const MeasuredScene& scene, double least_dni,
                                         InSeason season) {
  std::optional<Winter> winter;
  if (season == InSeason::winter) winter.emplace(scene.site);
  std::vector<SunStretch> suns;
  for (const MeasuredInterval& interval : scene.intervals)
    if (interval.dni >= least_dni && (!winter || winter->has(interval)))
      suns.insert(suns.end(), interval.suns.begin(), interval.suns.end());
  return suns;
}

namespace rules {

namespace {

class BrightSun : public Measure {
 public:
  BrightSun(double least_dni, const MeasuredScene& scene) : least_dni_(least_dni), scene_(scene) {}
  MeasureValues values() override {
    MeasureValues found{
        seen_sun_s(scene_.points, scene_.caster, bright_stretches(scene_, least_dni_))};
    for (double& value : found.value) value /= seconds_per_hour;
    return found;
  }

 private:
  double least_dni_;
  const MeasuredScene& scene_;
};

}  // namespace

MeasureRule bright_sun() {
  return {
      .word = "bright_sun",
      .definition = "hours of the period with sun on the surface and a beam of 120 W/m² or more",
      .source = "WMO-No. 8, Guide to Instruments and Methods of Observation, I.8.1: sunshine",
      .units = "h",
      .keys = {{"least_dni_w_m2", sunshine_w_m2}, {"least_h", 0}},
      .needs = MeasureRule::Needs::intervals,
      .levels = [](const MeasureParameters& of) -> std::vector<MeasureLevel> {
        if (of.number("least_h") == 0) return {};
        return {{"pass", of.number("least_h")}};
      },
      .start = [](const MeasureParameters& of,
                  const MeasuredScene& scene) -> std::unique_ptr<Measure> {
        return std::make_unique<BrightSun>(of.number("least_dni_w_m2"), scene);
      }};
}

}  // namespace rules

}  // namespace sunload
