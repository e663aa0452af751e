// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings of scenes that are as their files say, but hardly as they were meant.
#pragma once

#include <string>

#include "io/plan/scene_build.h"

namespace sunload {

/// Warns of a scene that lies on its side, with level faces and feet where walls should be; only of
/// formats that do not say which way is up. Empty where it stands.
std::string on_its_side_warning(const Study& study, const BuiltScene& prepared,
                                bool is_city_format);

/// Warns of houses higher than any real one, as of files in millimetres; only of formats that do
/// not say their unit. Empty where there are none.
std::string unit_warning(const Study& study, const BuiltScene& prepared, bool is_city_format);

/// Warns of a small piece that lies many times as far from all else as that is wide; empty where
/// there is none.
std::string lone_piece_warning(const Study& study, const BuiltScene& prepared);

/// Warns where `north_deg` of a study is not the direction that the scene's map gives [degrees];
/// empty where shadows are as good as the same.
std::string north_warning(const SiteStudy& given, const std::string& crs, double map_north_deg);

/// Warns of objects that lie wholly below the land, as where files have heights of two systems, and
/// of those that a step of `scene.edit` has put inside of others; notes others that lie so. To be
/// called after what is covered is cut.
void tell_of_hidden(const Study& study, BuiltScene& built);

/// Warns of sensors within bodies, where no light comes: straight above and below they see backs of
/// opaque faces. To be called after materials are given; empty where there are none.
std::string sensors_in_bodies_warning(const SensorsStudy& study, const Scene& scene);

/// Of panes that are lit from both sides, as canopies of glass are; empty where there are none. To
/// be called after materials are given.
std::string open_panes_note(const Scene& scene);

/// Warns of colours for display that became reflectances, and of walls that reflect more than any
/// real ones do. To be called after materials are given.
void warn_of_reflectances(const Study& study, BuiltScene& built);

}  // namespace sunload
