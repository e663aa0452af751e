// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The historic system's scenes (docs/developer/method.md, The historic system) with what was
/// published about each.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "geo/base/units.h"
#include "io/plan/expected_error.h"
#include "tests/support/paths.h"
#include "tests/support/statistics.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

constexpr const char* few_lines =
    "solver: {lines_per_patch: 64, direct_samples: 16, realizations: 16}\n";

std::string day_study(const std::string& builtin, const std::string& period,
                      const std::string& sections) {
  return "format: sunload-study-1\nname: scene\n"
         "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "light: {source: clear_sky}\nperiod: " +
         period + "\nscene: {builtin: {name: " + builtin + "}}\n" + sections;
}

/// Light load [J m-2], area-weighted over the patches that are chosen.
template <class Chosen>
double mean_load(const SolvedPlan& s, Chosen&& chosen) {
  double energy = 0, area = 0;
  for (std::size_t i = 0; i < s.mesh().patch_count(); ++i) {
    if (!chosen(i)) continue;
    energy += s.mesh().area()[i] * s.tally.exposure[static_cast<std::size_t>(Part::total)][i];
    area += s.mesh().area()[i];
  }
  return energy / area;
}

TEST(HistoricScenes, ABlackCylinderIsBlackInPowerNotInLightLoad) {
  const SolvedPlan s = solve_study(
      day_study("cylinder", "{days: [2026-06-21], from: \"08:00\", to: \"18:00\", step_min: 60}",
                "mesh: {oracle: none, max_edge_m: 2}\n" + std::string(few_lines)));
  double load = 0, outgoing = 0, outgoing_of_others = 0;
  for (std::size_t i = 0; i < s.mesh().patch_count(); ++i) {
    if (s.object(i) == "cylinder") {
      load += s.tally.exposure[static_cast<std::size_t>(Part::total)][i];
      outgoing += s.tally.outgoing[i];
    } else {
      outgoing_of_others += s.tally.outgoing[i];
    }
  }
  EXPECT_GT(load, 0);
  EXPECT_EQ(outgoing, 0);
  EXPECT_GT(outgoing_of_others, 0);
}

TEST(HistoricScenes, TheCeilingOfARoomGetsBrighterWithEveryReflection) {
  double before = 0;
  for (int bounces = 0; bounces <= 3; ++bounces) {
    const SolvedPlan s = solve_study(
        night_study("room",
                    "mesh: {oracle: none, max_edge_m: 1}\nsolver: {lines_per_patch: 64, "
                    "direct_samples: 16, realizations: 16, unshot: 0, "
                    "unfollowed: leave, bounces: " +
                        std::to_string(bounces) + "}\n"));
    // Level faces of the room that look down from above: the ceiling but for the lamp itself.
    const double ceiling = mean_load(s, [&](std::size_t i) {
      const auto t = static_cast<std::size_t>(s.mesh().patches()[i].triangle);
      const auto& scene = s.plan.built.scene;
      return s.object(i) == "room" && s.mesh().normal(i).z < -0.5 &&
             scene.materials[scene.material[t].index()].name == "ceiling";
    });
    std::cout << bounces << " reflections: ceiling " << ceiling / 3600 << " W/m2\n";
    if (bounces == 0) {
      EXPECT_EQ(ceiling, 0);
    } else {
      EXPECT_GT(ceiling, before * 1.01);
    }
    before = ceiling;
  }
}

/// Leaves' edges that have another leaf's corner in their middle.
std::size_t t_vertices(const Hierarchy& mesh) {
  const auto point = [](Vec3 p) { return std::array{p.x, p.y, p.z}; };
  std::set<std::array<double, 3>> corners;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    for (std::size_t k = 0; k < 3; ++k) corners.insert(point(mesh.corner(i, k)));
  std::size_t found = 0;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      found += corners.count(point((mesh.corner(i, k) + mesh.corner(i, (k + 1) % 3)) / 2));
  return found;
}

TEST(HistoricScenes, LitRegionsAreMeshedFinerAndNoTVertexIsLeft) {
  const auto study = [](const std::string& mesh) {
    return day_study("box_on_plane", "{instants: [\"2026-06-21 10:00\"]}",
                     "mesh: {" + mesh + "}\n" + few_lines);
  };
  Watch watch;
  for (const std::string oracle :
       {"oracle: historic, light_threshold_m2: 0.05, min_area_m2: 0.02", "light_tolerance: 0.02"}) {
    const VariantPlan plan = plan_of(study(oracle));
    const VariantMesh made = make_mesh(plan, watch);
    EXPECT_GT(made.report.patches, 4 * made.report.patches_before) << oracle;
    EXPECT_EQ(t_vertices(*made.mesh), 0u) << oracle;
    const VariantMesh kept = make_mesh(plan_of(study(oracle + ", t_vertices: keep")), watch);
    EXPECT_GT(t_vertices(*kept.mesh), 0u) << "planted fault: neighbours are left as they are";
    if (oracle.find("historic") == std::string::npos) continue;
    // The north wall of the box sees no sun in the morning, the east wall does.
    double finest_lit = 1e9, coarsest_shaded = 0;
    for (std::size_t i = 0; i < made.mesh->patch_count(); ++i) {
      const double area = made.mesh->area()[i];
      if (made.mesh->normal(i).x > 0.9) finest_lit = std::min(finest_lit, area);
      if (made.mesh->normal(i).y > 0.9) coarsest_shaded = std::max(coarsest_shaded, area);
    }
    EXPECT_GT(coarsest_shaded, 4 * finest_lit) << "lit regions are finer than shaded ones";
  }
}

TEST(HistoricScenes, HaveTheSourcesSizesByItsOracle) {
  // "About 60 000" and "some 70 000" patches are what the thesis says.
  constexpr double rounding = 0.15;
  Watch watch;
  const std::map<std::string, double> published{{"street", 60000}, {"skyscrapers", 70000}};
  for (const auto& [name, patches] : published) {
    const auto file = read_study(test::source_folder() + "/configs/mcrad/" + name + ".yaml");
    const VariantMesh made = make_mesh(make_plan(file.variants.front()), watch);
    EXPECT_NEAR(static_cast<double>(made.report.patches), patches, rounding * patches) << name;
  }
}

TEST(HistoricScenes, BadParametersAreWarnedAboutWithTheErrorToExpect) {
  const auto warnings = [](const std::string& solver, const std::string& sun = "") {
    const VariantPlan plan = plan_of(day_study(
        "box_on_plane", "{days: [2026-06-21], from: \"08:00\", to: \"18:00\", step_min: 60}",
        sun + "mesh: {oracle: none, max_edge_m: 2}\nsolver: {realizations: 2, " + solver + "}\n"));
    Watch watch;
    return expected_error_warnings(plan, *make_mesh(plan, watch).mesh);
  };
  EXPECT_TRUE(warnings("lines_per_patch: 256, direct_samples: 16").empty());
  // Geometry tells of a sun without a disk, and of few samples nothing is to be said.
  EXPECT_EQ(warnings("lines_per_patch: 8, direct_samples: 2").size(), 1u);
  const auto few = warnings("lines_per_patch: 8, direct_samples: 2", "sun: {disk: finite}\n");
  ASSERT_EQ(few.size(), 2u);
  EXPECT_NE(few[0].find("lines_per_patch 8"), std::string::npos) << few[0];
  EXPECT_NE(few[0].find("21 %"), std::string::npos) << few[0];
  EXPECT_NE(few[1].find("direct_samples 2"), std::string::npos) << few[1];
  const auto shot = warnings("transport: shoot, power_per_sample_w: 1000");
  ASSERT_EQ(shot.size(), 1u);
  EXPECT_NE(shot[0].find("power_per_sample_w"), std::string::npos) << shot[0];
}

/// Where mirrored light falls on an object in interval k: power and centre.
struct HistoricGlint {
  double power = 0;
  Vec3 centre;
};
HistoricGlint glint(const SolvedPlan& s, const std::string& object, std::size_t k) {
  const auto& mirror = s.tally.irradiance[static_cast<std::size_t>(Part::mirror)];
  const auto& sky = s.tally.irradiance[static_cast<std::size_t>(Part::sky)];
  HistoricGlint g;
  for (std::size_t i = 0; i < s.mesh().patch_count(); ++i) {
    const std::size_t at = k * s.mesh().patch_count() + i;
    // The sky by way of mirrors is everywhere: a glint outshines the sky.
    if (s.object(i) != object || mirror[at] <= sky[at]) continue;
    const double power = s.mesh().area()[i] * static_cast<double>(mirror[at]);
    g.centre = g.centre + s.mesh().centroid(i) * power;
    g.power += power;
  }
  if (g.power > 0) g.centre = g.centre / g.power;
  return g;
}

TEST(HistoricScenes, WindowsSendGlintsToGroundAndOppositeWall) {
  const SolvedPlan s = solve_study(
      day_study("windows", "{days: [2026-04-20], from: \"11:00\", to: \"15:00\", step_min: 60}",
                "mesh: {oracle: none, max_edge_m: 1}\n" + std::string(few_lines)));
  for (const std::string object : {"ground", "building_right"}) {
    double power = 0;
    for (std::size_t k = 0; k < s.tally.intervals; ++k) power += glint(s, object, k).power;
    EXPECT_GT(power, 0) << object;
  }
}

TEST(HistoricScenes, TheGlintOfTheMirrorTowerMovesWithTheSun) {
  const SolvedPlan s = solve_study(
      day_study("skyscrapers", "{days: [2026-06-21], from: \"09:00\", to: \"17:00\", step_min: 60}",
                "mesh: {oracle: none, max_edge_m: 8}\n" + std::string(few_lines)));
  std::vector<Vec3> centres;
  std::set<std::string> objects;
  for (std::size_t i = 0; i < s.mesh().patch_count(); ++i)
    if (s.mesh().normal(i).z > 0.99 && s.mesh().centroid(i).z < 1) objects.insert(s.object(i));
  for (std::size_t k = 0; k < s.tally.intervals; ++k) {
    HistoricGlint all;
    for (const auto& object : objects) {
      const HistoricGlint g = glint(s, object, k);
      all.centre = all.centre + g.centre * g.power;
      all.power += g.power;
    }
    if (all.power > 0) centres.push_back(all.centre / all.power);
  }
  ASSERT_GE(centres.size(), 4u) << "the tower's light reaches the ground for hours";
  for (std::size_t k = 1; k < centres.size(); ++k) {
    std::cout << "glint at " << centres[k].x << ", " << centres[k].y << "\n";
    EXPECT_GT(norm(centres[k] - centres[k - 1]), 1) << "metres in an hour";
  }
}

}  // namespace
}  // namespace sunload::test
