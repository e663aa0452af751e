// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/weather_albedo.h"

#include <fmt/format.h>

#include <algorithm>

#include "geo/base/check.h"

namespace sunload {

bool has_material_of_weather(const Study& study) {
  return std::any_of(study.scene.materials.begin(), study.scene.materials.end(),
                     [](const MaterialStudy& material) { return material.diffuse_of_weather; });
}

bool asks_for_albedos(const Study& study) {
  return study.light.far_ground_of_weather || has_material_of_weather(study);
}

void expect_albedos(const Study& study, const LightSeries& light,
                    std::vector<std::string>& warnings) {
  if (!asks_for_albedos(study)) return;
  if (!light.intervals.front().albedo)
    throw InputError({study.light.weather}, "tells no albedo of the ground",
                     "the study takes a reflectance from it; values of 0 and of 1 or more count "
                     "as missing",
                     "write numbers for `diffuse` and far_ground_albedo, or `seasons`");
  if (light.days_without_albedo == 0) return;
  const std::string count = fmt::format("{} of {} days of the period have no albedo of the ground",
                                        light.days_without_albedo, light.days);
  if (study.light.missing == Missing::refuse)
    throw InputError(
        {study.light.weather}, count, "the study takes a reflectance from the file",
        "write light.missing: interpolate to take that of the nearest day, or numbers");
  warnings.push_back("weather: " + count + "; that of the nearest day is taken");
}

int albedo_step(const LitInterval& interval) {
  constexpr double steps = 10;
  constexpr double rounding = 1e-6;  // of means of equal numbers
  SUNLOAD_EXPECT(interval.albedo.has_value(), "the weather tells the albedo");
  return static_cast<int>(*interval.albedo * steps + rounding);
}

}  // namespace sunload
