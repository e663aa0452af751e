// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How much of a scene's surfaces has a property, in each season: what estimates go by.
#pragma once

#include "geo/mesh/area_share.h"
#include "io/plan/seasons_of_plan.h"

namespace sunload {

/// Of the surfaces' area, of what materials have the property.
template <class Property>
double share_of_surfaces(const Mesh& mesh, const MaterialsOfScene& of_season,
                         const Property& property) {
  return area_share(mesh, [&](std::size_t t) { return property(of_season.of(t)); });
}

/// Of the surfaces, screens and crowns, which let light pass.
double share_of_screens(const Mesh& mesh, const MaterialsOfScene& of_season);
/// Of the surfaces, what sends light on and is asked for the sun by rays where edges of shadows
/// cross it (solver/sight/lit_shares.h).
double share_that_sends_on_by_rays(const Mesh& mesh, const MaterialsOfScene& of_season,
                                   Transport transport);

/// Rays that a line is made of where mirrors send it on: of what it meets, as much as there is
/// mirror, glass, metal and gloss among the surfaces.
double rays_per_line(const Mesh& mesh, const MaterialsOfScene& of_season, int mirror_depth);

/// `value` of the materials of each season.
template <class Value>
double mean_over_seasons(const VariantPlan& plan, const Value& value) {
  const auto seasons = materials_by_season(plan);
  double sum = 0;
  for (const MaterialsOfScene& season : seasons) sum += value(season);
  return sum / static_cast<double>(seasons.size());
}

}  // namespace sunload
