// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh, suns and skies in memory in, irradiance out: what `sunload.solve` of Python computes.
///
/// The mesh stays as it is: every triangle has patches, in its own order, and its front is where
/// its corners run counter-clockwise. A study of the same triangles as one object called `mesh`,
/// with `scene: {repair: none, orient: keep}`, `mesh: {oracle: none, min_area_m2: 0}` and the same
/// counts has the same bits. Ranges are checked by who calls; sizes and indices are contracts here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "geo/sky/sky.h"
#include "geo/sky/sky_subdivision.h"
#include "solver/light/tally.h"
#include "solver/mesh/hierarchy.h"
#include "solver/surface/material.h"
#include "solver/traced/rules.h"
#include "solver/transport/light_transport.h"

namespace sunload {

/// Triangles, and what they are made of.
struct ArrayScene {
  std::vector<Vec3> vertices;                          ///< m, z up
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< into `vertices`
  std::vector<std::int32_t> material;                  ///< of each triangle, into `materials`
  std::vector<Material> materials;
  std::vector<Sides> sides;  ///< of each material
};

/// Light of K suns.
struct ArrayLight {
  /// One sun with its sky, and the time that they last.
  struct Sun {
    Vec3 direction;            ///< to the sun, unit; at or below the horizon it brings nothing
    double elevation_deg = 0;  ///< of it
    double dni = 0;            ///< W m-2
    double dhi = 0;            ///< W m-2, met by `sky`; where there is `radiance`, its own counts
    double hours = 1;          ///< that sun and sky stand for, above 0
  };
  std::vector<Sun> suns;
  SkyInput sky;  ///< model and its parameters; sun and irradiances are those of each sun
  /// [K][n] radiances in place of the model's [W m-2 sr-1]: of the patches of a subdivision, or
  /// without one of the cells of `SkyGrid`; empty: none.
  std::vector<double> radiance;
  std::optional<Subdivision> subdivision;
  double far_ground_albedo = 0;
};

/// How fine the mesh is, and how it is solved.
struct ArrayRules {
  double max_edge_m = 1e9;
  SolverRules solver;  ///< with the series of all parts
  int threads = 0;     ///< 0: the processors that this process may use
};

/// Of N patches; parts that the scene cannot have are empty.
struct ArrayLoad {
  std::array<std::vector<double>, part_count> mean, standard_error;  ///< [N] kWh m-2
};
/// Light on the N patches of the mesh under K suns.
struct ArrayResult {
  std::shared_ptr<const Hierarchy> mesh;  ///< relative to `origin`
  Vec3 origin;
  std::array<LargeVector<float>, part_count> irradiance;  ///< [K][N] W m-2
  LargeVector<float> irradiance_se;                       ///< [K][N], with Errors::instants
  ArrayLoad light_load;                                   ///< sum over suns of irradiance x hours
  std::vector<double> sun_hours;                          ///< [N] regardless of DNI
  std::optional<Reduction> reduction;  ///< where few solutions serve all suns (SolverRules::year)
};

/// Same bits for any number of threads. Calls of several threads wait for each other. `is_stopped`
/// is asked often, from any thread; then Interrupted is thrown. Throws InputError for triangles
/// without area, a scene that is too wide, or too many patches.
ArrayResult solve_arrays(const ArrayScene& scene, const ArrayLight& light, const ArrayRules& rules,
                         std::function<bool()> is_stopped);

}  // namespace sunload
