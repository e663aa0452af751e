// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of `solve_arrays`: tests/end_to_end/solve_test.py.
#include "io/python/array_solver.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geo/base/check.h"
#include "solver/base/threads.h"

namespace sunload {
namespace {

/// A box that stands on a plate.
ArrayScene box_on_a_plate() {
  ArrayScene scene;
  scene.vertices = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0},   {-9, 9, 0}, {-2, -2, 0}, {2, -2, 0},
                    {2, 2, 0},   {-2, 2, 0}, {-2, -2, 5}, {2, -2, 5}, {2, 2, 5},   {-2, 2, 5}};
  scene.triangles = {{0, 1, 2},   {0, 2, 3},   {4, 6, 5}, {4, 7, 6},  {8, 9, 10},
                     {8, 10, 11}, {4, 5, 9},   {4, 9, 8}, {5, 6, 10}, {5, 10, 9},
                     {6, 7, 11},  {6, 11, 10}, {7, 4, 8}, {7, 8, 11}};
  scene.material.assign(scene.triangles.size(), 0);
  scene.materials = {{.name = "plaster", .diffuse = 0.5}};
  scene.sides = {Sides::one};
  return scene;
}

ArrayLight afternoon() {
  ArrayLight light;
  for (const double azimuth_deg : {180.0, 220.0, 260.0})
    light.suns.push_back({.direction = enu_direction({azimuth_deg, 35}),
                          .elevation_deg = 35,
                          .dni = 600,
                          .dhi = 120,
                          .hours = 1});
  return light;
}

ArrayRules rules(int threads = 0) {
  ArrayRules rules{.max_edge_m = 2, .solver = {}, .threads = threads};
  rules.solver.lines_per_patch = 64;
  return rules;
}

bool never() { return false; }

TEST(ArraySolver, HasPatchesOfEveryTriangleInTheirOrder) {
  ArrayRules whole = rules();
  whole.max_edge_m = 1e9;
  const ArrayScene scene = box_on_a_plate();
  const ArrayResult result = solve_arrays(scene, afternoon(), whole, never);
  ASSERT_EQ(result.mesh->patch_count(), scene.triangles.size());  // the underside, too
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    EXPECT_EQ(result.mesh->patches()[t].triangle, static_cast<std::int32_t>(t));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(result.mesh->corner(t, k) + result.origin,
                scene.vertices[static_cast<std::size_t>(scene.triangles[t][k])]);
  }
  EXPECT_EQ(result.irradiance[0].size(), 3 * scene.triangles.size());
}

TEST(ArraySolver, HasTheSameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  const ArrayResult one = solve_arrays(box_on_a_plate(), afternoon(), rules(1), never);
  for (const int threads : {2, 5}) {
    const ArrayResult more = solve_arrays(box_on_a_plate(), afternoon(), rules(threads), never);
    EXPECT_EQ(one.irradiance, more.irradiance);
    EXPECT_EQ(one.light_load.mean, more.light_load.mean);
    EXPECT_EQ(one.light_load.standard_error, more.light_load.standard_error);
  }
  EXPECT_EQ(thread_count(), before);
  EXPECT_EQ(chosen_thread_count(), 0) << "they follow the processors as before";
}

TEST(ArraySolver, EndsWhereItIsStoppedAndLeavesNothingBehind) {
  const ArrayResult whole = solve_arrays(box_on_a_plate(), afternoon(), rules(), never);
  std::atomic<int> asked = 0;
  const auto soon = [&] { return ++asked > 3; };
  EXPECT_THROW(solve_arrays(box_on_a_plate(), afternoon(), rules(3), soon), Interrupted);
  const int asked_at_the_end = asked;
  EXPECT_EQ(solve_arrays(box_on_a_plate(), afternoon(), rules(), never).irradiance,
            whole.irradiance);
  EXPECT_EQ(asked, asked_at_the_end);
}

TEST(ArraySolver, RefusesWhatIsNoMesh) {
  const auto solve = [](const ArrayScene& scene) {
    return solve_arrays(scene, afternoon(), rules(), never);
  };
  ArrayScene scene = box_on_a_plate();
  scene.triangles[3][1] = 12;
  EXPECT_THROW(solve(scene), std::logic_error);
  scene.triangles[3][1] = -1;
  EXPECT_THROW(solve(scene), std::logic_error);
  scene = box_on_a_plate();
  scene.material[5] = 1;
  EXPECT_THROW(solve(scene), std::logic_error);
  scene = box_on_a_plate();
  scene.materials[0].mirror = 0.6;  // beside diffuse 0.5
  EXPECT_THROW(solve(scene), std::logic_error);
  scene = box_on_a_plate();
  scene.triangles[3] = {4, 7, 7};
  EXPECT_THROW(solve(scene), InputError);
  scene = box_on_a_plate();
  scene.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solve(scene), InputError);
  ArrayLight light = afternoon();
  light.radiance.assign(145 * 2, 1);  // of three suns
  light.subdivision = Subdivision::tregenza;
  EXPECT_THROW(solve_arrays(box_on_a_plate(), light, rules(), never), std::logic_error);
}

}  // namespace
}  // namespace sunload
