// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A plan that shares with the one before is the plan that is made alone.
#include "io/plan/planner.h"

#include <gtest/gtest.h>

#include "solver/solver.h"
#include "tests/support/small_study.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

TEST(Planner, LongPeriodsHaveLargeBatches) {
  EXPECT_EQ(batch_suns_for(96), 64);
  EXPECT_EQ(batch_suns_for(720), 128);
  EXPECT_EQ(batch_suns_for(8760), 256);
}

TEST(Planner, PlansAreThoseMadeAlone) {
  const test::WorkFolder folder;
  folder.write("square.obj", test::square_obj);
  std::string taller = test::square_obj;
  taller.replace(taller.find("v -4 3 7"), 8, "v -4 3 8");
  folder.write("taller.obj", taller);
  const auto file = read_study(folder.write(
      "square.yaml",
      test::square_study() +
          "variants:\n"
          "  - {name: base}\n"
          "  - {name: dull, scene: {materials: {glass: {diffuse: 0.3, mirror: 0}}}}\n"
          "  - {name: two, scene: {materials: {plaster: {diffuse: 0.6, sides: two}}}}\n"
          "  - {name: veil, scene: {materials: {plaster: {diffuse: 0.3, transmittance: 0.5}}}}\n"
          "  - {name: rule, scene: {assign: [{object: house, material: paving}]}}\n"
          "  - {name: seed, solver: {seed: 2}}\n"
          "  - {name: scaled, scene: {unit_m: 2}}\n"
          "  - {name: other, scene: {files: [taller.obj]}}\n"
          "  - {name: again}\n"));
  auto studies = file.variants;
  // What variants of one file may not differ in, and studies may.
  const auto add = [&](auto change) {
    studies.push_back(file.variants.front());
    change(studies.back());
  };
  for (const double north_deg : {20, 200, 20, 0})
    add([&](Study& s) { s.site.north_deg = north_deg; });
  // Where faces are cut may depend on where north is.
  NamedSelection south;
  south.name = "south";
  south.of.surface = "wall";
  south.of.height_m = {0, 2};
  for (const auto of_north : {true, false})
    for (const double north_deg : {0, 90, 0}) {
      south.of.azimuth_deg.reset();
      if (of_north) south.of.azimuth_deg = {135, 225};
      south.of.facade = of_north ? "" : "*/south*";
      add([&](Study& s) {
        s.scene.cut = {south};
        s.site.north_deg = north_deg;
      });
    }
  add([](Study& s) { s.solver.sun_samples_per_interval = 3; });
  add([](Study& s) { s.site.latitude_deg = 60; });
  add([](Study& s) { s.light.linke_turbidity.monthly.fill(5); });
  add([](Study& s) { s.sun.refraction = Refraction::none; });
  add([](Study& s) { std::get<DaysPeriod>(s.period.kind).step_min = 30; });
  add([](Study& s) { s.sensors.points.emplace_back().normal = {0, 0, 1}; });
  add([](Study&) {});
  Planner planner;
  for (const auto& study : studies) {
    SCOPED_TRACE(study.variant);
    const VariantPlan shared = planner.plan(study), alone = make_plan(study);
    EXPECT_EQ(shared.content_hash, alone.content_hash);
    EXPECT_EQ(shared.pairing_id, alone.pairing_id);
    EXPECT_EQ(shared.built.scene.mesh.triangles, alone.built.scene.mesh.triangles);
    EXPECT_EQ(shared.built.warnings, alone.built.warnings);
    EXPECT_EQ(shared.built.notes, alone.built.notes);
    EXPECT_EQ(shared.light.notes, alone.light.notes);
    ASSERT_EQ(shared.light.intervals.size(), alone.light.intervals.size());
    for (std::size_t i = 0; i < alone.light.intervals.size(); ++i) {
      EXPECT_EQ(shared.light.intervals[i].mean.dni, alone.light.intervals[i].mean.dni);
      EXPECT_EQ(shared.light.intervals[i].when.sun_time, alone.light.intervals[i].when.sun_time);
    }
  }
}

}  // namespace
}  // namespace sunload
