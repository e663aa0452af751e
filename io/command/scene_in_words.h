// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene as `sunload check` tells of it.
#pragma once

#include <string>

#include "io/plan/scene_build.h"

namespace sunload {

/// What was read and repaired, areas, extent, the ground under it and notes; where asked for, which
/// triangles cut through others (some 10 s for a million).
std::string scene_in_words(const BuiltScene& built, bool with_intersections);
/// Shares of light and areas of every material, which rules gave them, and what shines.
std::string materials_in_words(const BuiltScene& built);

}  // namespace sunload
