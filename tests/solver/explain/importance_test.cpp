// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives by reflectances: the adjoint solution against finite differences.
#include "solver/explain/importance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "tests/support/court.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr double step = 0.02;
const SplitRules split{.max_edge_m = 5};

/// Followed to the end, so that differences are those of all reflections.
SolverRules complete_rules(Transport transport) {
  SolverRules rules = test_rules();
  rules.bounces = 40;
  rules.unshot = 0;
  rules.unfollowed = Unfollowed::leave;
  rules.lines_per_patch = rules.realizations * 64;
  rules.transport = transport;
  return rules;
}

/// A court whose lamp is dark (points drawn on lamps are other lines); `raised` reflects `by` more.
Scene dark_court(double mirror, const std::string& raised = {}, double by = 0) {
  CourtMaterials of;
  of.lamp.emission_w_m2 = 0;
  of.glass.mirror = mirror;
  for (Material* material : {&of.ground, &of.wall, &of.glass, &of.lamp})
    if (material->name == raised) material->diffuse += by;
  Scene scene = court(of);
  scene.sensors = {sensor_at({0, -1, 1.5}, {0, 1, 0})};
  return scene;
}

bool is_ground(const Scene& scene, const Patch& patch) {
  return scene.material_of(patch.triangle).name == "ground";
}

enum class Seen { ground, sensor };

Place place_of(const Scene& scene, const Hierarchy& mesh, Seen seen) {
  if (seen == Seen::sensor) return {{0}, {1}, true};
  Place place;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    if (is_ground(scene, mesh.patches()[i])) {
      place.receivers.push_back(i);
      place.weight.push_back(mesh.area()[i]);
    }
  const double area = std::accumulate(place.weight.begin(), place.weight.end(), 0.0);
  for (double& weight : place.weight) weight /= area;
  return place;
}

std::vector<double> loads(const Scene& scene, const Solved& solved, Seen seen) {
  if (seen == Seen::sensor) return of_sensor(solved.tally, 0);
  return solved.means([&](std::size_t i) { return is_ground(scene, solved.patches[i]); });
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// By central differences, and how sure it is of itself: that of twice the step, and rounding.
struct Derivative {
  double value, bound;
};
Derivative by_differences(double mirror, const std::string& material, const SolverRules& rules,
                          Seen seen) {
  double load = 0;
  const auto slope = [&](double by) {
    double difference = 0;
    for (const double sign : {1.0, -1.0}) {
      const Scene scene = dark_court(mirror, material, sign * by);
      const double mean = mean_of(loads(scene, solve(scene, three_suns(), rules, split), seen));
      difference += sign * mean;
      load = mean;
    }
    return difference / (2 * by);
  };
  const double value = slope(step);
  return {value, std::abs(slope(2 * step) - value) + float_rounding * load / step};
}

/// The same by the adjoint solution, of every realization; `reflections`: whether what the place
/// does not see straight counts.
std::vector<double> by_adjoint(double mirror, const std::string& material, const SolverRules& rules,
                               Seen seen, bool reflections = true, double raised_by = 0) {
  const Scene scene = dark_court(mirror, material, raised_by);
  const Solved solved = solve(scene, three_suns(), rules, split);
  const auto mesh = std::make_shared<Hierarchy>(scene, split);
  const TracedScene traced(scene, mesh, rules);
  auto reflectance = traced.optics.diffuse;
  if (!reflections) std::fill(reflectance.begin(), reflectance.end(), 0.0F);
  const auto g = importance(traced, place_of(scene, *mesh, seen), {reflectance}).front();
  std::vector<double> slopes(g.size(), 0);
  for (std::size_t i = 0; i < solved.patches.size(); ++i) {
    if (scene.material_of(solved.patches[i].triangle).name != material) continue;
    const auto load = solved.of_patch(i);
    for (std::size_t r = 0; r < slopes.size(); ++r) slopes[r] += g[r][i] * load[r];
  }
  return slopes;
}

TEST(Importance, IsTheDerivativeOfTheSolutionOnItsOwnLines) {
  const SolverRules rules = complete_rules(Transport::gather);
  constexpr double mirror = 0.7;
  for (const Seen seen : {Seen::ground, Seen::sensor})
    for (const char* material : {"ground", "wall"}) {
      const Derivative truth = by_differences(mirror, material, rules, seen);
      ASSERT_LT(truth.bound, 0.02 * truth.value);
      const double slope = mean_of(by_adjoint(mirror, material, rules, seen));
      EXPECT_NEAR(slope, truth.value, truth.bound) << material;
      const double planted = mean_of(by_adjoint(mirror, material, rules, seen, false));
      EXPECT_GT(std::abs(planted - truth.value), truth.bound) << material;
    }
}

// What reflects nothing gains by paint as what reflects next to nothing.
TEST(Importance, OfBlackSurfacesIsThatOfNearlyBlackOnes) {
  const SolverRules rules = complete_rules(Transport::gather);
  const double black = -CourtMaterials{}.wall.diffuse;
  for (const Seen seen : {Seen::ground, Seen::sensor}) {
    const double of_black = mean_of(by_adjoint(0.7, "wall", rules, seen, true, black));
    const double of_nearly_black =
        mean_of(by_adjoint(0.7, "wall", rules, seen, true, black + 1e-5));
    EXPECT_GT(of_black, 0);
    EXPECT_NEAR(of_black, of_nearly_black, 1e-4 * of_nearly_black);
  }
}

TEST(Importance, AgreesWithAnExactSolution) {
  const SolverRules rules = complete_rules(Transport::matrix);
  constexpr double no_mirror = 0;
  for (const char* material : {"ground", "wall"}) {
    const Derivative truth = by_differences(no_mirror, material, rules, Seen::ground);
    const Verdict verdict =
        expect_mean(by_adjoint(no_mirror, material, rules, Seen::ground), truth.value, truth.bound);
    EXPECT_TRUE(verdict) << material << ": " << verdict.text;
    EXPECT_LT(verdict.limit, 0.1 * truth.value) << verdict.text;
    if (material == std::string("wall")) continue;
    // A planted fault: light that comes by more than one reflection is left out.
    const Verdict planted = expect_mean(by_adjoint(no_mirror, material, rules, Seen::ground, false),
                                        truth.value, truth.bound);
    EXPECT_FALSE(planted) << planted.text;
  }
}

}  // namespace
}  // namespace sunload::test
