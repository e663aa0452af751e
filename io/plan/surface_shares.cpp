// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/surface_shares.h"

#include "io/plan/cost.h"
#include "solver/sight/lit_shares.h"

namespace sunload {

double share_of_screens(const Mesh& mesh, const MaterialsOfScene& of_season) {
  return share_of_surfaces(mesh, of_season, [](const Material& m) { return m.transmittance > 0; });
}

double share_that_sends_on_by_rays(const Mesh& mesh, const MaterialsOfScene& of_season,
                                   Transport transport) {
  const double share = share_of_surfaces(mesh, of_season, sends_on);
  return asked_for_the_sun(share, transport) == SendsOn::by_rays ? share : 0;
}

double rays_per_line(const Mesh& mesh, const MaterialsOfScene& of_season, int mirror_depth) {
  const double again = cost::share_that_meets * share_of_surfaces(mesh, of_season, sends_on);
  double rays = 1, of_depth = 1;
  for (int depth = 0; depth < mirror_depth; ++depth) rays += of_depth *= again;
  return rays;
}

}  // namespace sunload
