// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light in bands as studies ask for it: keys, colours of materials and of light, what is refused.
#include "io/base/bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/plan/interval_lights.h"
#include "io/plan/light_colour.h"
#include "io/plan/variant_plan.h"
#include "tests/support/program.h"

namespace sunload::test {
namespace {

const std::string two_faces =
    "mtllib scene.mtl\no wall\nusemtl ochre\nv 0 0 0\nv 4 0 0\nv 4 0 3\nv 0 0 3\nf 1 2 3 4\n"
    "o plain\nusemtl grey\nv 9 0 0\nv 13 0 0\nv 13 0 3\nv 9 0 3\nf 5 6 7 8\n";

std::string study_text(const std::string& solver, const std::string& materials,
                       const std::string& light = "") {
  return "format: sunload-study-1\nname: study\n"
         "period: {positions: [{azimuth_deg: 180, elevation_deg: 30}]}\n"
         "light: {source: fixed, dni_w_m2: 700, dhi_w_m2: 100" +
         light +
         "}\n"
         "scene: {files: [scene.obj], materials: {" +
         materials +
         "}}\n"
         "solver: {" +
         solver + "}\n";
}

/// A folder with a scene of one coloured and one grey material.
struct SmallScene {
  WorkFolder folder;
  explicit SmallScene(const std::string& kd = "0.6 0.4 0.2") {
    folder.write("scene.obj", two_faces);
    folder.write("scene.mtl", "newmtl ochre\nKd " + kd + "\nnewmtl grey\nKd 0.3\n");
  }
  VariantPlan plan(const std::string& solver, const std::string& materials = "",
                   const std::string& light = "") const {
    const auto path = folder.write("study.yaml", study_text(solver, materials, light));
    return make_plan(read_study(path).variants.front());
  }
  std::string refusal(const std::string& solver, const std::string& materials = "",
                      const std::string& light = "") const {
    try {
      plan(solver, materials, light);
    } catch (const InputError& error) {
      std::string text;
      for (const auto& problem : error.problems()) text += problem + "\n";
      return text;
    }
    return {};
  }
};

const Material& material(const VariantPlan& plan, const std::string& name) {
  const auto& all = plan.built.scene.materials;
  return *std::find_if(all.begin(), all.end(), [&](const Material& m) { return m.name == name; });
}

TEST(BandReflectances, ComeFromFilesAndStudies) {
  const SmallScene scene;
  const auto of_file = scene.plan("bands: rgb");
  EXPECT_EQ(*material(of_file, "ochre").diffuse_in_band, (BandShares{0.6, 0.4, 0.2}));
  EXPECT_NEAR(material(of_file, "ochre").diffuse, 0.4, 1e-15);
  EXPECT_FALSE(material(of_file, "grey").diffuse_in_band);
  const auto of_study = scene.plan("bands: rgb", "grey: {diffuse: [0.1, 0.2, 0.6]}");
  EXPECT_EQ(*material(of_study, "grey").diffuse_in_band, (BandShares{0.1, 0.2, 0.6}));
  EXPECT_NEAR(material(of_study, "grey").diffuse, 0.3, 1e-15);
  // One number of the study's is grey, whatever the file says; broadband light knows no colours.
  EXPECT_FALSE(
      material(scene.plan("bands: rgb", "ochre: {diffuse: 0.4}"), "ochre").diffuse_in_band);
  EXPECT_FALSE(material(scene.plan("bounces: 5"), "ochre").diffuse_in_band);
}

TEST(BandReflectances, AreInTheContentHashWhereTheyCount) {
  const SmallScene scene("0.75 0.25 0.5"), other("0.5 0.25 0.75");
  const auto broadband = scene.plan("seed: 1").content_hash;
  EXPECT_EQ(scene.plan("bands: broadband").content_hash, broadband);
  EXPECT_EQ(other.plan("seed: 1").content_hash, broadband);  // of the same mean
  const auto rgb = scene.plan("bands: rgb").content_hash;
  EXPECT_NE(rgb, broadband);
  EXPECT_NE(other.plan("bands: rgb").content_hash, rgb);
  EXPECT_NE(scene.plan("bands: rgb", "", ", colour: white").content_hash, rgb);
}

TEST(BandStudy, RefusesWhatBandsCannotHave) {
  const SmallScene scene;
  EXPECT_NE(scene.refusal("bands: rgb, transport: shoot").find("bands share the lines"),
            std::string::npos);
  EXPECT_NE(scene.refusal("bands: rgb", "", ", quantity: illuminance").find("eye's own response"),
            std::string::npos);
  EXPECT_NE(scene.refusal("bands: rgb", "ochre: {diffuse: [0.1, 0.2]}")
                .find("has 2 values (one value, or red, green and blue)"),
            std::string::npos);
  EXPECT_NE(scene.refusal("bands: rgb", "ochre: {diffuse: [0.1, 0.2, 0.3], refractive_index: 1.5}")
                .find("has a colour beside refractive_index"),
            std::string::npos);
  EXPECT_NE(
      scene.refusal("bands: rgb", "ochre: {diffuse: [0.1, 0.2, 0.3], normal_transmittance: 0.5}")
          .find("has a colour beside normal_transmittance"),
      std::string::npos);
  // The brightest band counts.
  EXPECT_NE(scene.refusal("bands: rgb", "ochre: {diffuse: [0.8, 0.2, 0.3], mirror: 0.3}")
                .find("diffuse + mirror = 1.1 is above 1"),
            std::string::npos);
  EXPECT_EQ(scene.refusal("bands: rgb", "ochre: {diffuse: [0.7, 0.2, 0.3], mirror: 0.3}"), "");
  EXPECT_NE(scene.refusal("bands: cmyk").find("rgb"), std::string::npos);
}

// ---- colours of light --------------------------------------------------------------------

struct Sky30 {
  LitInterval interval;
  LightStudy study;
  SkyGrid grid;
  explicit Sky30(double elevation_deg, SkyModel sky = SkyModel::cie_clear) {
    interval.when.begin = 0;
    interval.when.end = 3600;
    interval.when.sun.elevation_deg = elevation_deg;
    interval.when.direction = enu_direction({180, elevation_deg});
    interval.when.sunlit_s = 3600;
    interval.mean = interval.of_the_sky = {700, 100, 700 * std::sin(radians(elevation_deg)) + 100};
    study.sky = sky;
  }
  IntervalLight light(const Horizon& hills = {}) const {
    Study in_bands;
    in_bands.light = study;
    in_bands.solver.bands = Bands::rgb;
    return IntervalLights(in_bands, {.horizon = hills}, grid).of(interval, 0);
  }
};

double diffuse(const std::vector<double>& radiance, const SkyGrid& grid) {
  double sum = 0;
  for (std::size_t c = 0; c < radiance.size(); ++c) sum += radiance[c] * grid.projected()[c];
  return sum;
}

TEST(BandLight, MeanOfTheBandsIsTheBroadbandLightOfEverySource) {
  const Horizon hills({{0, 25}});
  for (const auto sky : {SkyModel::cie_clear, SkyModel::perez, SkyModel::uniform,
                         SkyModel::preetham, SkyModel::cie_overcast})
    for (const double elevation : {2.0, 20.0, 60.0})
      for (const auto& horizon : {Horizon(), hills}) {
        const IntervalLight light = Sky30(elevation, sky).light(horizon);
        ASSERT_EQ(light.bands.size(), band_count);
        const auto mean = [&](auto&& of) {
          return (of(light.bands[0]) + of(light.bands[1]) + of(light.bands[2])) / 3;
        };
        EXPECT_NEAR(mean([](auto& b) { return b.dni; }), light.dni, 1e-12 * light.dni);
        EXPECT_NEAR(mean([](auto& b) { return b.ground_exitance; }), light.ground_exitance,
                    1e-12 * light.ground_exitance);
        for (std::size_t c = 0; c < light.sky.size(); c += 97)
          EXPECT_NEAR(mean([&](auto& b) { return b.sky[c]; }), light.sky[c], 1e-12 * light.sky[c]);
      }
}

TEST(BandLight, LowSunIsRedHighSunWhiteAndTheSkyBlue) {
  const auto redness = [](const IntervalLight& light) {
    return light.bands[0].dni / light.bands[2].dni;
  };
  EXPECT_NEAR(redness(Sky30(45).light()), 1, 1e-12);
  EXPECT_GT(redness(Sky30(20).light()), 1.1);
  EXPECT_GT(redness(Sky30(5).light()), redness(Sky30(20).light()));
  EXPECT_NEAR(redness(Sky30(0.001).light()), 1 / 0.5, 1e-3);  // reddening 1 of sky_colour
  for (const double elevation : {60.0, 20.0}) {
    const Sky30 clear(elevation);
    const IntervalLight light = clear.light();
    EXPECT_GT(diffuse(light.bands[2].sky, clear.grid),
              1.2 * diffuse(light.bands[0].sky, clear.grid));
    EXPECT_GT(redness(light),
              diffuse(light.bands[0].sky, clear.grid) / diffuse(light.bands[2].sky, clear.grid));
  }
}

TEST(BandLight, CloudsAreWhiteAndWhiteLightIsTheSameInEveryBand) {
  for (const auto sky : {SkyModel::cie_overcast, SkyModel::uniform}) {
    const IntervalLight light = Sky30(30, sky).light();
    EXPECT_EQ(light.bands[0].sky, light.sky);
    EXPECT_EQ(light.bands[2].sky, light.sky);
  }
  Sky30 white(10);
  white.study.colour = LightColour::white;
  for (const IntervalLight light = white.light(); const auto& band : light.bands) {
    EXPECT_EQ(band.dni, light.dni);
    EXPECT_EQ(band.sky, light.sky);
    EXPECT_EQ(band.ground_exitance, light.ground_exitance);
  }
  // Perez: between the overcast and the brightest bin.
  Sky30 perez(30, SkyModel::perez);
  EXPECT_GT(blue_share(perez.interval, perez.study), 0.5);
  perez.interval.of_the_sky.dni = 0;
  EXPECT_EQ(blue_share(perez.interval, perez.study), 0);
}

// ---- names -------------------------------------------------------------------------------

TEST(BandArrays, NamesAndOrder) {
  EXPECT_EQ(band_prefixes(Bands::broadband), std::vector<std::string>{""});
  EXPECT_EQ(band_array("green/irradiance_sky").band, 1u);
  EXPECT_EQ(band_array("green/irradiance_sky").name, "irradiance_sky");
  EXPECT_FALSE(band_array("greenish").band);
  EXPECT_EQ(side_by_side({{1, 2, 3, 4}, {5, 6, 7, 8}}, 2),
            (std::vector<double>{1, 2, 5, 6, 3, 4, 7, 8}));
  EXPECT_EQ(band_by_name("blue"), 2u);
  EXPECT_THROW(band_by_name("violet"), InputError);
}

}  // namespace
}  // namespace sunload::test
