// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials and times of a plan by season, for texts, counts and results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/plan/variant_plan.h"

namespace sunload {

/// What a scene is made of, as in `Scene`.
struct MaterialsOfScene {
  const std::vector<Material>& materials;
  const std::vector<MaterialId>& material;
  const Material& of(std::size_t triangle) const { return materials[material[triangle].index()]; }
};
/// In each season of the period; the scene's own where there are none.
std::vector<MaterialsOfScene> materials_by_season(const VariantPlan& plan);

/// Hours of each season of the period, in their order.
std::vector<double> season_hours(const SceneSeasons& seasons, const LightSeries& light);
/// "leafless, snow"; "else" of materials as written.
std::string words_of(const SceneSeason& season);

/// Which seasons of the study hold in every interval: a bit each, in its order, whether they change
/// anything or not. Empty where it has none, or its suns no dates.
std::vector<std::int32_t> study_seasons(const Study& study, const LightSeries& light);

}  // namespace sunload
