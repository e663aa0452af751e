// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes that are what their files say and hardly what was meant.
#pragma once

#include <string>

#include "io/plan/scene_build.h"

namespace sunload {

/// Lies on its side: level faces and feet are where walls should be. Of formats that do not say
/// which way is up. Empty where it stands.
std::string lying_warning(const Study& study, const BuiltScene& prepared, bool is_city_format);

/// `north_deg` of a study against the direction that the scene's map gives [degrees]; empty where
/// shadows are as good as the same.
std::string north_warning(const SiteStudy& given, const std::string& crs, double map_north_deg);

/// Materials have been given: colours for display that became reflectances, and walls that reflect
/// more than any do.
void warn_of_reflectances(const Study& study, BuiltScene& built);

}  // namespace sunload
