// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which material every triangle has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/plan/selection.h"
#include "io/study/study.h"
#include "solver/surface/material.h"

namespace sunload {

/// What a rule of `scene.assign` did.
struct RuleUse {
  std::string rule;         ///< in words: "surface wall, object house_*: brick"
  std::size_t matched = 0;  ///< triangles
  std::size_t given = 0;    ///< of these, those that have their material from it
  double given_m2 = 0;
};

/// Reflectance of a surface that neither file nor study says anything about:
/// a mean of European facades and streets (Oke 1987, Boundary Layer Climates,
/// table 8.2: urban areas 0.10 … 0.27, mean of the range's upper half).
inline constexpr double default_reflectance = 0.2;

/// What is called so that no file and no rule gives a material; a study may say what it reflects.
inline const std::string nameless_material = "default";

/// What materials depend on besides the scene: when it is.
struct MaterialsWhen {
  std::vector<std::string> seasons = {};  ///< in force (`scene.materials.NAME.seasons`)
  /// Of materials that reflect as the weather says; absent: the default reflectance.
  std::optional<double> albedo = {};
};

/// Whether a rule matches a triangle, its selection left out of account. `named`: the objects that
/// its `object` names.
bool matches_but_selection(const AssignRule& rule, const ChosenObjects& named, const Mesh& mesh,
                           std::size_t triangle);

/// Fills `scene.materials` and `scene.material`, and lets materials decide the sides of triangles.
///
/// What is more specific goes first. The material of a triangle is that of the last rule of
/// `scene.assign` that matches and names objects, selections or materials of files; else the one
/// that the study gives its file (`scene.files[].material`, crowns of rasters); else that of the
/// last rule that matches and goes by kinds alone (surface, type, or nothing); else the study's
/// material with the name that the file gives, else the file's own reflectance, else the default,
/// with a warning. What a name means: a material of the study, else one of the files, else one of
/// the table (io/study/material_table). A material of the study that says nothing of reflection
/// takes that from the file's or the table's of its name.
///
/// `warnings` gets rules that match nothing, or everything though they choose, or whose faces all
/// have their material from elsewhere, and the area left to the default.
/// Returns what every rule did. Throws InputError for unknown names and for more light reflected
/// than received.
std::vector<RuleUse> assign_materials(const Study& study, const SceneFrame& frame, Scene& scene,
                                      std::vector<std::string>& warnings,
                                      const MaterialsWhen& when = {});

}  // namespace sunload
