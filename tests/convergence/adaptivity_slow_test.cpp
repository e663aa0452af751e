// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Adaptive meshes pay: equal error of the light load with a fraction of the leaves.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>

#include "io/plan/rules_of_study.h"
#include "io/plan/variant_mesh.h"
#include "solver/base/threads.h"
#include "tests/support/paths.h"
#include "tests/support/real_models.h"
#include "tests/support/study_plan.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

/// Light load of a mesh, and the variance that its sampling leaves in it.
struct Loaded {
  std::shared_ptr<const Hierarchy> mesh;
  std::vector<double> load, variance;
};

Loaded loaded(const VariantPlan& plan, std::shared_ptr<const Hierarchy> mesh) {
  Watch watch;
  const auto traced = trace_scene(plan.built.scene, mesh, solver_rules(plan), watch);
  const auto suns = suns_of(plan, traced->grid);
  const BatchTally tally = sunload::solve(*transport_of(*traced), suns, watch).bands.front();
  Loaded result{mesh, std::vector<double>(mesh->patch_count()), {}};
  for (std::size_t i = 0; i < mesh->patch_count(); ++i) {
    std::vector<double> values;
    for (const auto& realization : tally.exposure_realization) values.push_back(realization[i]);
    const MeanError m = mean_error(values);
    result.load[i] = m.mean;
    result.variance.push_back(m.standard_error * m.standard_error);
  }
  return result;
}

/// Root mean square difference over the area between a mesh and a finer one of the same
/// triangles, without what sampling adds to it, as share of the mean load.
double error_against(const Loaded& fine, const Loaded& coarse, const Scene& scene) {
  double squares = 0, power = 0, area = 0;
  for (std::size_t i = 0; i < fine.mesh->patch_count(); ++i) {
    const auto& patch = fine.mesh->patches()[i];
    const auto t = static_cast<std::size_t>(patch.triangle);
    const Vec3 a = scene.mesh.corner(t, 0), n = scene.mesh.area_vector2(t);
    const Vec3 p = fine.mesh->centroid(i) - a;
    const double u = dot(cross(p, scene.mesh.corner(t, 2) - a), n) / dot(n, n);
    const double v = dot(cross(scene.mesh.corner(t, 1) - a, p), n) / dot(n, n);
    const auto holder =
        static_cast<std::size_t>(coarse.mesh->patch_at(patch.triangle, u, v, patch.side == 0));
    const double A = fine.mesh->area()[i], d = coarse.load[holder] - fine.load[i];
    squares += A * (d * d - coarse.variance[holder] - fine.variance[i]);
    power += A * fine.load[i];
    area += A;
  }
  return std::sqrt(std::max(0.0, squares) * area) / power;
}

struct Comparison {
  std::size_t adaptive = 0, even = 0;  ///< leaves
  double error = 0;
};

/// Leaves that an even mesh needs for the error of the adaptive one.
Comparison compare(const std::string& study, double min_area_m2, double tolerance,
                   double coarsest_edge) {
  const WorkFolder folder;
  VariantPlan plan = make_plan(read_study(folder.write("study.yaml", study)).variants.front());
  plan.study.mesh.min_area_m2 = min_area_m2;
  plan.study.mesh.light_tolerance = tolerance;
  const Scene& scene = plan.built.scene;
  Watch watch;
  // Halving a triangle's area twice halves its edges.
  const double finest_edge = std::sqrt(min_area_m2 / 4 * 4 / std::sqrt(3.0));
  const Loaded truth = loaded(
      plan, std::make_shared<const Hierarchy>(
                scene, SplitRules{.max_edge_m = finest_edge, .min_area_m2 = min_area_m2 / 8}));
  const Loaded adaptive = loaded(plan, make_mesh(plan, watch).mesh);
  Comparison c;
  c.adaptive = adaptive.mesh->patch_count();
  c.error = error_against(truth, adaptive, scene);
  for (double edge = coarsest_edge;; edge /= std::pow(2, 0.25)) {
    const Loaded even =
        loaded(plan, std::make_shared<const Hierarchy>(
                         scene, SplitRules{.max_edge_m = edge, .min_area_m2 = min_area_m2}));
    c.even = even.mesh->patch_count();
    const double error = error_against(truth, even, scene);
    std::cout << "  even, " << edge << " m: " << c.even << " leaves, error " << error << "\n";
    if (error <= c.error || edge < finest_edge) break;
  }
  std::cout << "reference " << truth.mesh->patch_count() << " leaves; adaptive " << c.adaptive
            << " leaves, error " << c.error << "; even mesh of that error: " << c.even << "\n";
  return c;
}

constexpr const char* solver_section =
    "solver: {lines_per_patch: 64, direct_samples: 16, realizations: 8}\n";

TEST(Adaptivity, PaysOnTheStreet) {
  const Comparison c = compare(
      "format: sunload-study-1\nname: street\n"
      "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, elevation_m: 310, "
      "timezone: Europe/Prague}\n"
      "period: {days: [2026-03-08], from: \"06:30\", to: \"12:30\", step_min: 40}\n"
      "light: {source: clear_sky}\nscene: {builtin: {name: street}}\n" +
          std::string(solver_section),
      0.04, 0.08, 1.0);
  EXPECT_LE(3 * c.adaptive, c.even);
}

TEST(Adaptivity, PaysOnACityModel) {
  SUNLOAD_NEEDS_MODEL("data");
  const Comparison c = compare(
      "format: sunload-study-1\nname: city\nsite: {timezone: Europe/Berlin}\n"
      "period: {days: [2026-06-21], from: \"06:00\", to: \"20:00\", step_min: 60}\n"
      "light: {source: clear_sky}\nscene: {files: [" +
          test::shared_folder() + "/data/city/lod2_100_buildings_v11_epsg3068.city.json]}\n" +
          std::string(solver_section),
      0.8, 0.05, 8);  // patches of 8 m are within 0.06 everywhere taken together
  EXPECT_LE(2 * c.adaptive, c.even);
}

}  // namespace
}  // namespace sunload::test
