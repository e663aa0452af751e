// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Who takes and who gives light: closed forms, and the sum against a solution.
#include "solver/explain/attribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "geo/base/units.h"
#include "tests/support/court.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

class Period : public LitPeriod {
 public:
  explicit Period(std::vector<IntervalLight> lights) : lights_(std::move(lights)) {
    for (std::size_t i = 0; i < lights_.size(); ++i)
      lights_[i].number = static_cast<std::uint32_t>(i);
  }
  std::size_t intervals() const override { return lights_.size(); }
  bool is_dark(std::size_t i) const override { return lights_[i].is_dark(); }
  bool has_sun(std::size_t i) const override { return lights_[i].has_sun(); }
  Vec3 direction(std::size_t i) const override { return lights_[i].direction; }
  IntervalLight of(std::size_t i) const override { return lights_[i]; }

 private:
  std::vector<IntervalLight> lights_;
};

Attribution attribution(const Scene& scene, const std::vector<IntervalLight>& lights,
                        const SolverRules& rules, const SentLight& sent, const Place& place,
                        const SplitRules& split = {}) {
  const TracedScene traced(scene, std::make_shared<Hierarchy>(scene, split), rules);
  return attribute_light(traced, Period(lights), sent, place);
}

std::vector<double> flows(const Attribution& a, std::size_t object, Flow flow) {
  std::vector<double> values;
  for (std::size_t r = 0; r < a.realizations(); ++r) values.push_back(a.flow(object, flow, r));
  return values;
}

std::size_t object_named(const Scene& scene, const std::string& name) {
  const auto& names = scene.mesh.object_names;
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// What is so long looks endless from a distance of 10 m, to within distance / length.
constexpr double half_length = 10000, distance = 10, bias = distance / half_length;
constexpr double dhi = 100, sent_by_all = 30;

SolverRules fine_rules() {
  SolverRules rules = test_rules();
  rules.lines_per_patch = rules.realizations * 4096;
  return rules;
}

/// The light of one sensor, when all surfaces send alike.
Attribution of_sensor_in(Scene scene, Vec3 position, Vec3 normal, const IntervalLight& light) {
  scene.sensors = {sensor_at(position, normal)};
  const auto patches = Hierarchy(scene, SplitRules{}).patch_count();
  return attribution(scene, {with_uniform_sky(light, dhi)}, fine_rules(),
                     SentLight(patches, sent_by_all), {{0}, {1}, true});
}

/// A wall at x = 10 m whose upper edge stands at that angle.
Scene wall_of(double angle, const Material& material) {
  const double h = distance * std::tan(angle);
  SceneBuilder builder;
  const int wall = builder.material(material);
  builder.object("wall").quad({distance, half_length, 0}, {distance, -half_length, 0},
                              {distance, -half_length, h}, {distance, half_length, h}, wall);
  return builder.scene();
}

/// A truth that holds, and would not were it 2 % another.
void expect_sharp(const std::vector<double>& values, double truth) {
  const double bound = bias * truth;
  const Verdict holds = expect_mean(values, truth, bound);
  EXPECT_TRUE(holds) << holds.text;
  const Verdict planted = expect_mean(values, 1.02 * truth, bound);
  EXPECT_FALSE(planted) << planted.text;
}

TEST(Attribution, AWallTakesAndGivesWhatItsAngleSays) {
  const double angle = radians(50.0);
  const Scene scene = wall_of(angle, {"wall", 0.4});
  const Attribution a = of_sensor_in(scene, {0, 0, 0}, {0, 0, 1}, one_second({0, 0, -1}, 0));
  const double share = (1 - std::cos(angle)) / 2;  // of the hemisphere above level ground
  const std::size_t wall = object_named(scene, "wall");
  expect_sharp(flows(a, wall, Flow::takes_sky), share * dhi);
  expect_sharp(flows(a, wall, Flow::reflects), share * sent_by_all);
  for (std::size_t r = 0; r < a.realizations(); ++r) {
    EXPECT_EQ(a.flow(wall, Flow::takes_sun, r), 0);
    EXPECT_EQ(a.flow(wall, Flow::mirrors, r), 0);
  }
}

TEST(Attribution, WhiteGroundTakesTheFarGroundAndGivesHalfOfWhatItSends) {
  SceneBuilder builder;
  const int white = builder.material({"white", 1});
  builder.object("ground").quad({-half_length, -half_length, 0}, {half_length, -half_length, 0},
                                {half_length, half_length, 0}, {-half_length, half_length, 0},
                                white);
  IntervalLight light = one_second({0, 0, -1}, 0);
  light.ground_exitance = 20;
  const Attribution a = of_sensor_in(builder.scene(), {0, 0, distance / 4}, {1, 0, 0}, light);
  const std::size_t ground = object_named(builder.scene(), "ground");
  expect_sharp(flows(a, ground, Flow::takes_far_ground), light.ground_exitance / 2);
  expect_sharp(flows(a, ground, Flow::reflects), sent_by_all / 2);
}

TEST(Attribution, ShadowsAndImagesOfTheSunNameTheirObjects) {
  const double rho_s = 0.7, dni = 800;
  const Scene scene = wall_of(radians(60.0), {"wall", 0, rho_s});
  const auto light = [&](Vec3 to_sun) { return one_second(normalized(to_sun), dni); };
  const auto sun_of = [&](const IntervalLight& sun) {
    return of_sensor_in(scene, {0, 0, 0}, {0, 0, 1}, sun);
  };
  // Behind the wall the sun is taken; before it, it is seen twice.
  const IntervalLight behind = light({1, 0, 1}), before = light({-1, 0, 1});
  const Attribution taken = sun_of(behind), twice = sun_of(before);
  const std::size_t wall = object_named(scene, "wall");
  const double level = dni * before.direction.z, rounding = float_rounding * level;
  for (std::size_t r = 0; r < taken.realizations(); ++r) {
    EXPECT_NEAR(taken.open(Attribution::Open::sun, r), level, rounding);
    EXPECT_NEAR(taken.flow(wall, Flow::takes_sun, r), level, rounding);
    EXPECT_EQ(twice.flow(wall, Flow::takes_sun, r), 0);
    // By the mirror sky comes, too: as much at any place of the sun.
    const double by_sun = twice.flow(wall, Flow::mirrors, r) - taken.flow(wall, Flow::mirrors, r);
    EXPECT_NEAR(by_sun, rho_s * level, rounding);
  }
}

// Two crowns, of which the nearer one's triangles meet where the sun is seen.
TEST(Attribution, OfSensorsCrownsTakeTheirShareOfTheSun) {
  SceneBuilder builder;
  Material leaves{"leaves"};
  leaves.transmittance = 0.3;
  const int crown = builder.material(leaves);
  builder.sides(Sides::two)
      .object("near")
      .quad({-9, -9, 5}, {9, -9, 5}, {9, 9, 5}, {-9, 9, 5}, crown);
  builder.object("far").quad({-9, -9, 8}, {9, -9, 8}, {9, 9, 8}, {-9, 9, 8}, crown);
  const Scene scene = builder.scene();
  const IntervalLight sun = one_second({0, 0, 1}, 800);
  const Attribution taken = of_sensor_in(scene, {0, 0, 0}, {0, 0, 1}, sun);
  for (std::size_t r = 0; r < taken.realizations(); ++r) {
    EXPECT_NEAR(taken.flow(object_named(scene, "near"), Flow::takes_sun, r), 800 * 0.7, 1e-3);
    EXPECT_NEAR(taken.flow(object_named(scene, "far"), Flow::takes_sun, r), 800 * 0.3 * 0.7, 1e-3);
  }
}

// The same of patches, at a ray of each realization; and what is left is what they have.
TEST(Attribution, OfPatchesCrownsTakeTheirShareOfTheSun) {
  SceneBuilder builder;
  Material leaves{"leaves"};
  leaves.transmittance = 0.3;
  const int crown = builder.material(leaves);
  builder.object("ground").quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0},
                                builder.material({"black"}));
  builder.sides(Sides::two)
      .object("near")
      .quad({-9, -9, 5}, {9, -9, 5}, {9, 9, 5}, {-9, 9, 5}, crown);
  builder.object("far").quad({-9, -9, 8}, {9, -9, 8}, {9, 9, 8}, {-9, 9, 8}, crown);
  builder.object("lid").quad({-9, -9, 9}, {0, -9, 9}, {0, 9, 9}, {-9, 9, 9},
                             builder.material({"lid"}));
  const Scene scene = builder.scene();
  const std::vector<IntervalLight> lights = {one_second({0, 0, 1}, 800)};
  SolverRules rules = test_rules();
  rules.direct_samples = rules.lines_per_patch = rules.realizations;
  const Solved solved = solve(scene, lights, rules, {});
  Place place;
  for (std::size_t i = 0; i < solved.patches.size(); ++i)
    if (solved.patches[i].triangle < 2) place.receivers.push_back(i);
  place.weight.assign(place.receivers.size(), 1 / static_cast<double>(place.receivers.size()));
  const Attribution taken =
      attribution(scene, lights, rules, SentLight(solved.patches.size(), 0), place);
  const auto has = solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; });
  double taken_by_lid = 0;
  for (std::size_t r = 0; r < taken.realizations(); ++r) {
    const auto takes = [&](const char* object) {
      return taken.flow(object_named(scene, object), Flow::takes_sun, r);
    };
    EXPECT_NEAR(takes("near"), 800 * 0.7, 1e-3);
    EXPECT_NEAR(takes("far"), 800 * 0.3 * 0.7, 1e-3);
    EXPECT_NEAR(taken.total(r), has[r], 1e-3);
    taken_by_lid += takes("lid");
  }
  EXPECT_GT(taken_by_lid, 1e-3);
}

// Between the sun and the mirror that the sensor sees it in.
TEST(Attribution, OfSensorsCrownsTakeTheirShareOfTheMirroredSun) {
  const double rho_s = 0.5, dni = 800;
  SceneBuilder builder;
  Material leaves{"leaves"};
  leaves.transmittance = 0.3;
  builder.object("wall").quad({10, 9, 0}, {10, -9, 0}, {10, -9, 30}, {10, 9, 30},
                              builder.material({"mirror", 0, rho_s}));
  builder.sides(Sides::two)
      .object("crown")
      .quad({-1, -9, 20}, {1, -9, 20}, {1, 9, 20}, {-1, 9, 20}, builder.material(leaves));
  const Scene scene = builder.scene();
  const auto by_mirror = [&](Vec3 to_sun) {
    const IntervalLight sun = one_second(normalized(to_sun), dni);
    return flows(of_sensor_in(scene, {0, 0, 0}, {0, 0, 1}, sun), object_named(scene, "wall"),
                 Flow::mirrors);
  };
  // What the mirror shows besides the sun is the same where it stands behind the wall.
  const auto before = by_mirror({-1, 0, 1}), behind = by_mirror({1, 0, 1});
  for (std::size_t r = 0; r < before.size(); ++r)
    EXPECT_NEAR(before[r] - behind[r], rho_s * 0.3 * dni * std::sqrt(0.5), 1e-3);
}

/// The sum of all rows less the solution's own load, of every realization.
std::vector<double> remainders(const Scene& scene, const std::string& object, bool with_mirrors) {
  const std::vector<IntervalLight> lights = three_suns();
  SolverRules rules = test_rules();
  rules.lines_per_patch = rules.realizations * 64;
  const SplitRules split{.max_edge_m = 5};
  const Solved solved = solve(scene, lights, rules, split);
  SentLight sent;
  Place place;
  double area = 0, seconds = 0;
  for (const auto& light : lights) seconds += light.length_s;
  const auto wanted = object_named(scene, object);
  const auto is_wanted = [&](std::size_t i) {
    const auto triangle = static_cast<std::size_t>(solved.patches[i].triangle);
    return scene.mesh.triangle_object[triangle].index() == wanted;
  };
  for (std::size_t i = 0; i < solved.patches.size(); ++i) {
    const Material& material = scene.material_of(solved.patches[i].triangle);
    double load = 0;
    for (const double of_realization : solved.of_patch(i))
      load += of_realization / rules.realizations;
    sent.push_back(material.diffuse * load + material.emission_w_m2 * seconds);
    if (is_wanted(i)) area += solved.area[i];
  }
  for (std::size_t i = 0; i < solved.patches.size(); ++i)
    if (is_wanted(i)) {
      place.receivers.push_back(i);
      place.weight.push_back(solved.area[i] / area);
    }
  const Attribution a = attribution(scene, lights, rules, sent, place, split);
  std::vector<double> rest = solved.means(is_wanted);
  for (std::size_t r = 0; r < rest.size(); ++r) {
    rest[r] -= a.total(r);
    if (!with_mirrors) rest[r] += a.flow(object_named(scene, "glass"), Flow::mirrors, r);
  }
  return rest;
}

TEST(Attribution, AddsUpToTheSolution) {
  const Scene scene = court();
  for (const char* object : {"ground", "tower", "house", "screen"}) {
    const Verdict verdict = expect_mean(remainders(scene, object, true), 0);
    EXPECT_TRUE(verdict) << object << ": " << verdict.text;
  }
  // With the light of the mirror forgotten it does not.
  const Verdict planted = expect_mean(remainders(scene, "ground", false), 0);
  EXPECT_FALSE(planted) << planted.text;
}

TEST(Attribution, OfPatchesAddsUpToThatOfTheirObjects) {
  const Scene scene = court();
  const auto mesh = std::make_shared<Hierarchy>(scene, SplitRules{.max_edge_m = 5});
  SolverRules rules = test_rules();
  rules.lines_per_patch = rules.realizations * 16;
  const TracedScene traced(scene, mesh, rules);
  const Period period(three_suns());
  // Each patch sends something else, so that a patch in the place of another is seen.
  SentLight sent;
  for (std::size_t i = 0; i < mesh->patch_count(); ++i)
    sent.push_back(10 + static_cast<double>(i % 17));
  const auto object_of = [&](std::size_t i) {
    return scene.mesh.triangle_object[static_cast<std::size_t>(mesh->patches()[i].triangle)]
        .index();
  };
  Place place;
  for (std::size_t i = 0; i < mesh->patch_count(); ++i)
    if (object_of(i) == object_named(scene, "ground")) place.receivers.push_back(i);
  place.weight.assign(place.receivers.size(), 1 / static_cast<double>(place.receivers.size()));
  const Attribution objects = attribute_light(traced, period, sent, place),
                    patches = attribute_light(traced, period, sent, place, {}, Among::patches);
  ASSERT_EQ(patches.objects(), mesh->patch_count());
  double by_mirror = 0;
  for (std::size_t r = 0; r < objects.realizations(); ++r) {
    EXPECT_EQ(patches.open(Attribution::Open::sky, r), objects.open(Attribution::Open::sky, r));
    for (std::size_t f = 0; f < flow_count; ++f) {
      const auto flow = static_cast<Flow>(f);
      std::vector<double> sums(objects.objects(), 0);
      for (std::size_t i = 0; i < patches.objects(); ++i)
        sums[object_of(i)] += patches.flow(i, flow, r);
      for (std::size_t o = 0; o < sums.size(); ++o)
        EXPECT_NEAR(sums[o], objects.flow(o, flow, r), 1e-12 * objects.total(r)) << o << " " << f;
    }
    by_mirror += objects.flow(object_named(scene, "glass"), Flow::mirrors, r);
  }
  EXPECT_GT(by_mirror, 0);
}

}  // namespace
}  // namespace sunload::test
