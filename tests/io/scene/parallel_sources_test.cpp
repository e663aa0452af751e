// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Study key `scene.parallel_sources`: from the file to the emitters of the scene.

#include <gtest/gtest.h>

#include "io/plan/variant_plan.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

/// A plate, and above it a square that shines down.
std::string study_text(const std::string& scene) {
  return "format: sunload-study-1\nname: beam\nsite: {timezone: UTC}\n"
         "period: {positions: [{azimuth_deg: 180, elevation_deg: 45}]}\n"
         "light: {source: fixed, dni_w_m2: 100, dhi_w_m2: 10}\n"
         "scene: {files: [plate.obj], " +
         scene + "}\n";
}

constexpr const char* with_lamp =
    "parallel_sources: lamps.obj, materials: {m: {diffuse: 0.3}, lamp: {emission_w_m2: 250}}";

void write_models(const WorkFolder& folder, const std::string& height = "5") {
  folder.write("plate.obj",
               "o plate\nusemtl m\nv 5000 0 0\nv 5004 0 0\nv 5004 4 0\nv 5000 4 0\nf 1 2 3 4\n");
  folder.write("lamps.obj", "o lamp\nusemtl lamp\nv 5001 1 " + height + "\nv 5001 3 " + height +
                                "\nv 5003 3 " + height + "\nv 5003 1 " + height + "\nf 1 2 3 4\n");
}

VariantPlan plan_of(const WorkFolder& folder, const std::string& scene) {
  return make_plan(read_study(folder.write("beam.yaml", study_text(scene))).variants.front());
}

std::string study_refusal(const WorkFolder& folder, const std::string& scene) {
  return refusal_of([&] { plan_of(folder, scene); });
}

TEST(ParallelSources, StandInTheFrameOfTheScene) {
  const WorkFolder folder;
  write_models(folder);
  const VariantPlan plan = plan_of(folder, with_lamp);
  const ParallelSources& sources = plan.built.scene.parallel_sources;
  ASSERT_EQ(sources.exitance, (std::vector<double>{250, 250}));
  EXPECT_EQ(plan.built.scene.mesh.triangle_count(), 2u);
  const Vec3 origin = plan.built.scene.mesh.origin;
  EXPECT_NE(origin, (Vec3{}));
  double area = 0;
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_LT(sources.mesh.area_vector2(t).z, 0);
    area += sources.mesh.area_m2(t);
    EXPECT_EQ((sources.mesh.corner(t, 0) + origin).z, 5);
    EXPECT_GE((sources.mesh.corner(t, 0) + origin).x, 5001);
  }
  EXPECT_EQ(area, 4);
}

TEST(ParallelSources, AreInTheContentHash) {
  const WorkFolder folder;
  write_models(folder);
  const auto hash = plan_of(folder, with_lamp).content_hash;
  EXPECT_EQ(plan_of(folder, with_lamp).content_hash, hash);
  EXPECT_NE(
      plan_of(folder, "materials: {m: {diffuse: 0.3}, lamp: {emission_w_m2: 250}}").content_hash,
      hash);
  write_models(folder, "6");
  EXPECT_NE(plan_of(folder, with_lamp).content_hash, hash);
}

TEST(ParallelSources, AreRefusedByName) {
  const WorkFolder folder;
  write_models(folder);
  EXPECT_NE(study_refusal(folder, "parallel_sources: none.obj")
                .find("scene.parallel_sources: 'none.obj' is not there"),
            std::string::npos);
  EXPECT_NE(study_refusal(folder, "parallel_sources: lamps.obj").find("emits"), std::string::npos);
}

}  // namespace
}  // namespace sunload::test
