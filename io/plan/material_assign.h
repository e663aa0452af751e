// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which material every triangle has.
#pragma once

#include <string>
#include <vector>

#include "io/study/study.h"
#include "solver/surface/material.h"

namespace sunload {

/// Fills `scene.materials` and `scene.material`, and lets materials decide the sides of triangles.
///
/// The material of a triangle is that of the last rule of `scene.assign` that matches, else the
/// study's material with the name that the file gives, else the file's own reflectance, else the
/// default, with a warning. What a name means: a material of the study, else one of the files,
/// else one of the table (io/study/material_table). A material of the study that says nothing of
/// reflection takes that from the file's or the table's of its name.
///
/// `warnings` gets rules that match nothing and the area left to the default.
/// Throws InputError for unknown names and for more light reflected than received.
void assign_materials(const Study& study, Scene& scene, std::vector<std::string>& warnings);

/// Reflectance of a surface that neither file nor study says anything about:
/// a mean of European facades and streets (Oke 1987, Boundary Layer Climates,
/// table 8.2: urban areas 0.10 … 0.27, mean of the range's upper half).
inline constexpr double default_reflectance = 0.2;

/// Whether `text` matches a pattern with `*` and `?`.
bool matches(const std::string& pattern, const std::string& text);

}  // namespace sunload
