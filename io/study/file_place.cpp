// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/file_place.h"

#include "geo/sun/site.h"

namespace sunload {

namespace {

/// Where the file's origin stands in the scene.
Vec3 position_in(const SceneFileStudy& file, const std::string& crs) {
  if (!file.earth_position) return file.position.value_or(Vec3{});
  if (crs.empty())
    throw InputError(file.where, "scene.files: a position in degrees needs the scene's CRS",
                     "neither site.crs nor a file of the scene names one",
                     "write site.crs, or position_m in the scene's own metres");
  const auto& earth = *file.earth_position;
  return map_position(crs, earth.latitude_deg, earth.longitude_deg, earth.height_m);
}

}  // namespace

SceneFileRules rules_of(const SceneFileStudy& file, const SceneStudy& scene) {
  SceneFileRules rules{file.up == 0 ? scene.up : file.up,
                       file.unit_m.value_or(scene.unit_m),
                       file.lod.empty() ? scene.lod : file.lod,
                       scene.vrml_colour,
                       scene.emission_scale_w,
                       file.footprints};
  rules.footprints.terrain = file.terrain;
  return rules;
}

FilePlace file_place(Vec3 position, double turn_deg) {
  // As north by east, so the file's +y axis by its turn.
  return {position, scene_from_enu({.north_deg = -turn_deg})};
}

FilePlace place_of(const SceneFileStudy& file, const std::string& crs) {
  return file_place(position_in(file, crs), file.turn_deg);
}

}  // namespace sunload
