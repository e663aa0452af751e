// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/seasons_of_plan.h"

#include "geo/base/units.h"

namespace sunload {

std::vector<MaterialsOfScene> materials_by_season(const VariantPlan& plan) {
  const Scene& scene = plan.built.scene;
  if (plan.seasons.all.empty()) return {{scene.materials, scene.material}};
  std::vector<MaterialsOfScene> all;
  all.reserve(plan.seasons.all.size());
  for (const SceneSeason& season : plan.seasons.all)
    all.push_back({season.materials, season.material});
  return all;
}

std::vector<double> season_hours(const SceneSeasons& seasons, const LightSeries& light) {
  std::vector<double> hours(seasons.all.size(), 0);
  for (std::size_t i = 0; i < seasons.of_interval.size(); ++i)
    hours[seasons.of_interval[i]] += light.intervals[i].when.length_s() / seconds_per_hour;
  return hours;
}

std::string words_of(const SceneSeason& season) {
  return season.name.empty() ? "else" : season.name;
}

std::vector<std::int32_t> study_seasons(const Study& study, const LightSeries& light) {
  std::vector<std::int32_t> flags;
  if (study.seasons.empty() || light.times_are_synthetic) return flags;
  const TimeZone zone(study.site.timezone);
  flags.reserve(light.intervals.size());
  for (const LitInterval& interval : light.intervals) {
    const CivilTime middle = zone.civil_from_utc((interval.when.begin + interval.when.end) / 2);
    std::uint32_t all = 0;
    for (std::size_t s = 0; s < study.seasons.size(); ++s)
      if (is_in(study.seasons[s], middle)) all |= 1U << s;
    flags.push_back(static_cast<std::int32_t>(all));
  }
  return flags;
}

}  // namespace sunload
