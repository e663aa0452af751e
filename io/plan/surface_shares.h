// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How much of a scene's surfaces has a property, in each season: what estimates go by.
#pragma once

#include "io/plan/seasons_of_plan.h"

namespace sunload {

/// Of the surfaces' area, of what materials have the property.
template <class Property>
double share_of_surfaces(const Mesh& mesh, const MaterialsOfScene& of_season,
                         const Property& property) {
  double area = 0, with_it = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double of_triangle = norm(mesh.area_vector2(t));
    area += of_triangle;
    if (property(of_season.of(t))) with_it += of_triangle;
  }
  return area > 0 ? with_it / area : 0;
}

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
