// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces whose reflectance a study leaves to its weather file: snow lies when it lay.
#pragma once

#include <string>
#include <vector>

#include "io/plan/light_series.h"
#include "io/study/study.h"

namespace sunload {

/// Whether a material of the study reflects as the file's ground (`diffuse: weather`).
bool has_material_of_weather(const Study& study);

/// Whether a material or the far ground does.
bool asks_for_albedos(const Study& study);

/// Where the study asks for albedos, a material or the far ground: throws InputError for a file
/// that tells none, and for days without one where light.missing refuses; else `warnings` says
/// how many take that of the nearest day.
void expect_albedos(const Study& study, const LightSeries& light,
                    std::vector<std::string>& warnings);

/// Which intervals share one reflectance: their albedos lie in the same tenth. Each step is traced
/// as a scene of its own, and none is off by more than 0.1 from what the file says of its day.
int albedo_step(const LitInterval& interval);

}  // namespace sunload
