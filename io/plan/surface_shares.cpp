// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/surface_shares.h"

#include "solver/base/cost.h"

namespace sunload {

double rays_per_line(const Mesh& mesh, const MaterialsOfScene& of_season, int mirror_depth) {
  const double again = cost::share_that_meets * share_of_surfaces(mesh, of_season, sends_on);
  double rays = 1, of_depth = 1;
  for (int depth = 0; depth < mirror_depth; ++depth) rays += of_depth *= again;
  return rays;
}

}  // namespace sunload
