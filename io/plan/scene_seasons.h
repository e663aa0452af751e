// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene is made of in the seasons of its period, and by the albedo of its weather: leaves
/// fall, snow lies.
///
/// Geometry, patches and suns stay; lines and light are those of a scene of its own in each of
/// them. Which season an interval lies in is decided by its middle, in civil time of the site.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/plan/light_series.h"
#include "io/plan/scene_build.h"
#include "io/study/study.h"

namespace sunload {

/// Stretches of time in which the same seasons of the study are in force.
struct SceneSeason {
  std::string name;  ///< "leafless, snow, albedo 0.31"; "" where materials are as written
  std::vector<Material> materials;   ///< as in `Scene`
  std::vector<MaterialId> material;  ///< per triangle
};

/// Consecutive intervals of one season.
struct SeasonStretch {
  std::size_t season = 0, first = 0, count = 0;
};

/// The seasons of a period, and which of them each interval lies in.
struct SceneSeasons {
  std::vector<SceneSeason> all;           ///< in the order in which they come; never just one
  std::vector<std::uint8_t> of_interval;  ///< place in `all`; empty where there are none

  /// 0 where materials stay what they are.
  std::size_t of(std::size_t interval) const {
    return of_interval.empty() ? 0 : of_interval[interval];
  }
  /// Of `count` intervals from `first` on, one after the other.
  std::vector<SeasonStretch> stretches(std::size_t first, std::size_t count) const;
};

/// The seasons of a period. Where all of it lies in one of them, `built` gets its materials, and
/// nothing is returned. Throws InputError where a season changes the sides of a surface.
SceneSeasons take_seasons(const Study& study, const LightSeries& light, BuiltScene& built);

/// The scene with the materials of a season.
Scene scene_in(const Scene& scene, const SceneSeason& season);

/// "leafless 4 032 h, else 4 728 h"; empty where nothing changes.
std::string seasons_text(const SceneSeasons& seasons, const LightSeries& light);

}  // namespace sunload
