// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How a file of a study's scene is to be read, and where it stands.
#pragma once

#include <string>

#include "geo/base/vec.h"
#include "io/scene/base/file_rules.h"
#include "io/study/study.h"

namespace sunload {

/// The file's own rules where it has some, else those of the scene.
SceneFileRules rules_of(const SceneFileStudy& file, const SceneStudy& scene);

/// A place in the scene is position + turn · (the file's place in metres with z up).
struct FilePlace {
  Vec3 position;
  Rotation turn;
  Vec3 operator()(Vec3 p) const { return position + turn(p); }
};

/// Turns about the file's origin are clockwise seen from above.
FilePlace file_place(Vec3 position, double turn_deg);

/// Where the study puts the file, in a scene with that CRS. Throws InputError where the position
/// is on Earth and there is none.
FilePlace place_of(const SceneFileStudy& file, const std::string& crs);

}  // namespace sunload
