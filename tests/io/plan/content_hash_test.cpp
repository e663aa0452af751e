// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The hash of what a variant computes sees all of it.
#include "io/plan/content_hash.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace sunload {
namespace {

/// A triangle with all that a scene can have.
struct Content {
  Study study;
  BuiltScene built;
  LightSeries light;

  Content() {
    Scene& scene = built.scene;
    scene.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.mesh.triangles = {{0, 1, 2}};
    scene.mesh.triangle_object = {make_id<ObjectId>(0)};
    scene.mesh.triangle_facade = {make_id<FacadeId>(0)};
    scene.mesh.triangle_surface = {Surface::wall};
    scene.mesh.triangle_sides = {Sides::one};
    scene.mesh.object_names = {"house"};
    scene.mesh.facades.push_back({"house/north_1", make_id<ObjectId>(0)});
    scene.materials.resize(1);
    scene.material = {make_id<MaterialId>(0)};
    scene.parallel_sources.mesh.vertices = scene.mesh.vertices;
    scene.parallel_sources.mesh.triangles = scene.mesh.triangles;
    scene.parallel_sources.exitance = {1};
    scene.sensors.push_back({{0, 0, 1}, {0, 0, 1}, 1});
    light.intervals.resize(1);
  }
  std::string hash() const { return content_hash(study, built, light, "avx2"); }
};

TEST(ContentHash, SeesWhatFilesAndTablesBring) {
  using Change = std::function<void(Content&)>;
  const auto material = [](auto member, auto value) -> Change {
    return [=](Content& c) { c.built.scene.materials[0].*member = value; };
  };
  const std::vector<Change> changes{
      [](Content& c) { c.built.scene.mesh.vertices[1].x = 2; },
      [](Content& c) {
        c.built.scene.mesh.triangles[0] = {1, 2, 0};
      },
      [](Content& c) { c.built.scene.mesh.triangle_object[0] = make_id<ObjectId>(1); },
      [](Content& c) { c.built.scene.mesh.triangle_facade[0] = FacadeId::none(); },
      [](Content& c) { c.built.scene.mesh.triangle_surface[0] = Surface::roof; },
      [](Content& c) { c.built.scene.mesh.triangle_sides[0] = Sides::two; },
      [](Content& c) { c.built.scene.mesh.object_names[0] = "home"; },
      [](Content& c) { c.built.scene.mesh.facades[0].name = "house/south_1"; },
      [](Content& c) { c.built.scene.mesh.origin.z = 1; },
      [](Content& c) { c.built.scene.mesh.object_kinds = {"Building"}; },
      [](Content& c) {
        c.built.scene.mesh.families.of_object = {{ObjectId::none(), make_id<BareId>(0)}};
      },
      [](Content& c) {
        c.built.scene.mesh.families.bare = {{"terrace", "Building"}};
      },
      [](Content& c) { c.built.scene.material[0] = make_id<MaterialId>(1); },
      [](Content& c) { c.built.scene.parallel_sources.mesh.vertices[1].x = 2; },
      [](Content& c) { c.built.scene.parallel_sources.exitance[0] = 2; },
      [](Content& c) { c.built.scene.sensors[0].stands_at.x = 1; },
      [](Content& c) {
        c.built.scene.sensors[0].normal = {1, 0, 0};
      },
      [](Content& c) { c.built.scene.sensors[0].key = 2; },
      [](Content& c) { c.built.site.north_deg = 1; },
      [](Content& c) { c.light.weather_sha256 = "x"; },
      [](Content& c) { c.light.intervals[0].when.end = 1; },
      [](Content& c) { c.study.output.standard_error = StandardErrors::instants; },
      [](Content& c) { c.study.output.significant_bits = 9; },
      [](Content& c) { c.study.output.significant_bits = 10; },
      [](Content& c) { c.study.output.series_step.unit = SeriesStepStudy::Unit::day; },
      [](Content& c) { c.study.output.series_step.unit = SeriesStepStudy::Unit::month; },
      material(&Material::name, "glass"),
      material(&Material::diffuse, 0.1),
      material(&Material::mirror, 0.1),
      material(&Material::emission_w_m2, 0.1),
      material(&Material::smooth, Panes{1.5}),
      material(&Material::smooth, Panes{1.6}),
      material(&Material::smooth, Panes{.refractive_index = 1.5, .thickness_m = 0.1}),
      material(&Material::smooth, Panes{.refractive_index = 1.5, .absorption_per_m = 0.1}),
      material(&Material::smooth, Panes{.refractive_index = 1.5, .count = 2}),
      material(&Material::smooth, ClearGlass{0.1}),
      material(&Material::smooth, ClearGlass{0.2}),
      material(&Material::smooth, Metal{1.5, 0.1}),
      material(&Material::smooth, Metal{1.5, 0.2}),
      material(&Material::smooth, Metal{1.6, 0.1}),
      material(&Material::glossy, 0.1),
      material(&Material::glossy_exponent, 0.1),
      material(&Material::transmittance, 0.1),
      material(&Material::diffuse_in_band, BandShares{0.1, 0.1, 0.1})};
  std::set<std::string> hashes{Content().hash()};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    Content changed;
    changes[k](changed);
    EXPECT_TRUE(hashes.insert(changed.hash()).second) << "change " << k;
  }
}

// Results of all versions pair by it.
TEST(PairingId, StaysWhatItWas) {
  Content content;
  content.light.intervals[0].when.end = 3600;
  EXPECT_EQ(pairing_id(content.study, content.light), "2c58d3be793e26cc");
}

TEST(RaysDigest, SeesAllButDiffuseReflectances) {
  const auto digest_of = [](const std::function<void(Content&)>& change) {
    Content content;
    content.built.scene.materials[0].diffuse = 0.3;
    change(content);
    return rays_digest(content.study, content.built, content.light, "avx2", "");
  };
  const auto material = [](auto member, auto value) {
    return [=](Content& c) { c.built.scene.materials[0].*member = value; };
  };
  const std::string digest = digest_of([](Content&) {});
  EXPECT_EQ(digest_of(material(&Material::diffuse, 0.6)), digest);
  EXPECT_EQ(digest_of(material(&Material::name, "paint")), digest);
  EXPECT_EQ(digest_of([](Content& c) { c.study.scene.builtin.emplace(); }), digest);
  const std::vector<std::function<void(Content&)>> changes{
      material(&Material::diffuse, 0.0),  // no line leads to it
      material(&Material::mirror, 0.1),
      material(&Material::glossy, 0.1),
      material(&Material::transmittance, 0.1),
      [](Content& c) { c.built.scene.materials[0].smooth = Panes{1.5}; },
      [](Content& c) { c.built.scene.mesh.vertices[1].x = 2; },
      [](Content& c) { c.built.scene.sensors[0].stands_at.x = 2; },
      [](Content& c) { c.built.site.north_deg = 5; },
      [](Content& c) { c.study.solver.seed = 2; },
      [](Content& c) { c.study.light.far_ground_albedo = 0.7; },
      [](Content& c) { c.study.mesh.min_area_m2 = 0.5; },
      [](Content& c) { c.light.intervals.emplace_back(); },
  };
  std::set<std::string> different{digest};
  for (const auto& change : changes) different.insert(digest_of(change));
  EXPECT_EQ(different.size(), changes.size() + 1);
}

TEST(RaysDigest, SeesTheCoatOfAMirror) {
  const auto digest_of = [](double diffuse, double mirror) {
    Content content;
    content.built.scene.materials[0].diffuse = diffuse;
    content.built.scene.materials[0].mirror = mirror;
    return rays_digest(content.study, content.built, content.light, "avx2", "");
  };
  EXPECT_NE(digest_of(0.1, 0.5), digest_of(0.2, 0.5));
}

}  // namespace
}  // namespace sunload
