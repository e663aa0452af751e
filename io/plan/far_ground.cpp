// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/far_ground.h"

#include "geo/base/check.h"

namespace sunload {

FarGround::FarGround(const Study& study)
    : always_(study.light.far_ground_albedo),
      is_of_weather_(study.light.far_ground_of_weather),
      zone_(study.site.timezone) {
  for (const SeasonStudy& season : study.seasons)
    for (const SeasonAlbedo& in : study.light.far_ground_seasons)
      if (in.season == season.name) seasons_.push_back({season, in.albedo});
}

double FarGround::albedo(const LitInterval& interval) const {
  double albedo = always_;
  if (is_of_weather_) {
    SUNLOAD_EXPECT(interval.albedo.has_value(), "the weather tells the albedo");
    albedo = *interval.albedo;
  }
  if (seasons_.empty()) return albedo;
  const CivilTime civil = zone_.civil_from_utc((interval.when.begin + interval.when.end) / 2);
  for (const Season& season : seasons_)
    if (is_in(season.when, civil)) albedo = season.albedo;
  return albedo;
}

}  // namespace sunload
