// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/far_ground.h"

namespace sunload {

FarGround::FarGround(const Study& study)
    : always_(study.light.far_ground_albedo), zone_(study.site.timezone) {
  for (const SeasonStudy& season : study.seasons)
    for (const SeasonAlbedo& in : study.light.far_ground_seasons)
      if (in.season == season.name) seasons_.push_back({season, in.albedo});
}

double FarGround::albedo(UnixTime time) const {
  if (seasons_.empty()) return always_;
  const CivilTime civil = zone_.civil_from_utc(time);
  double albedo = always_;
  for (const Season& season : seasons_)
    if (is_in(season.when, civil)) albedo = season.albedo;
  return albedo;
}

}  // namespace sunload
