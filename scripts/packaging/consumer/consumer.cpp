// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh in, irradiance out: a wall on a plane, an hour of sun under a uniform sky.
#include <cstdio>

#include "geo/mesh/mesh_prepare.h"
#include "geo/sky/sky.h"
#include "solver/solver.h"

using namespace sunload;

int main() {
  PolygonModel model;  // metres, z up; corners counter-clockwise seen from the front
  model.object_names = {"court"};
  model.vertices = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, {0, 8, 4}, {8, 8, 4}};
  const PolygonModel::Facts court{.object = ObjectId{0}, .sides = Sides::two};
  model.add_polygon({{0, 1, 2, 3}}, court);
  model.add_polygon({{3, 2, 5, 4}}, court);

  Scene scene{.mesh = prepare(model, {}).mesh, .materials = {{"plaster", 0.5}}, .material = {}};
  scene.material.assign(scene.mesh.triangle_count(), MaterialId{0});

  IntervalLight noon{.direction = normalized(Vec3{0, -1, 1}), .dni = 800, .dhi = 100};
  noon.length_s = noon.sunlit_s = 3600;
  noon.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), noon.dhi / pi);

  Watch watch;
  const auto traced = trace_scene(scene, SplitRules{.max_edge_m = 1}, SolverRules{}, watch);
  const Solved solved = solve(*transport_of(*traced), {&noon, 1}, watch);

  std::printf("patch,area_m2,irradiance_w_m2,standard_error_w_m2\n");
  const std::vector<double>& area = traced->hierarchy().area();
  for (std::size_t p = 0; p < area.size(); ++p) {
    std::vector<double> of_patch;
    for (const auto& realization : solved.bands.front().exposure_realization)
      of_patch.push_back(realization[p] / noon.length_s);
    const MeanError irradiance = mean_error(of_patch);
    std::printf("%zu,%.4f,%.2f,%.2f\n", p, area[p], irradiance.mean, irradiance.standard_error);
  }
}
