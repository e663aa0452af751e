// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reflectances that a study leaves to its weather file.
#include "io/plan/weather_albedo.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/plan/far_ground.h"
#include "io/plan/variant_plan.h"
#include "tests/support/refusal_of.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using test::write_text;

/// Noon and afternoon of five days; each has an albedo, or none.
std::string weather_of(const std::vector<std::string>& albedos) {
  std::string text = "time,ghi_w_m2,dhi_w_m2,albedo\n";
  for (std::size_t day = 0; day < albedos.size(); ++day)
    for (int hour = 0; hour < 24; ++hour)
      text += fmt::format("2026-01-{:02}T{:02}:00,{},50,{}\n", day + 10, hour,
                          hour == 12 ? 300 : 100, albedos[day]);
  return text;
}

std::string study_text(const std::string& lawn, const std::string& light = "",
                       const std::string& more = "") {
  write_text("lawn.obj", "usemtl lawn\nv 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
  return fmt::format(
      "format: sunload-study-1\nname: a\n"
      "site: {{latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}}\n"
      "period: {{start: 2026-01-10, end: 2026-01-15, step_min: 60}}\n"
      "light: {{source: weather, weather: a.csv, stamp: start{}}}\n"
      "scene: {{files: [lawn.obj], materials: {{lawn: {{{}}}, snow: {{diffuse: 0.8}}}}}}\n{}",
      light, lawn, more);
}

VariantPlan plan_of(const std::string& text) {
  return make_plan(read_study(write_text("a.yaml", text)).variants.front());
}

VariantPlan plan_with(const std::vector<std::string>& albedos, const std::string& text) {
  write_text("a.csv", weather_of(albedos));
  return plan_of(text);
}

TEST(WeatherAlbedo, MakesAScenePerTenth) {
  const auto plan =
      plan_with({"0.82", "0.86", "0.23", "0.14", "0.83"}, study_text("diffuse: weather"));
  ASSERT_EQ(plan.seasons.all.size(), 3u);
  const std::vector<double> means{(0.82 + 0.86 + 0.83) / 3, 0.23, 0.14};
  for (std::size_t s = 0; s < 3; ++s)
    EXPECT_NEAR(plan.seasons.all[s].materials.front().diffuse, means[s], 1e-12) << s;
  EXPECT_EQ(plan.seasons.all[0].name, "albedo 0.84");
  const std::vector<std::size_t> of_days{0, 0, 1, 2, 0};
  for (std::size_t i = 0; i < plan.intervals(); ++i)
    EXPECT_EQ(plan.seasons.of(i), of_days[i / 24]) << i;
  EXPECT_EQ(seasons_text(plan.seasons, plan.light),
            "albedo 0.84 72 h, albedo 0.23 24 h, albedo 0.14 24 h");
}

TEST(WeatherAlbedo, ThatStaysIsJustAReflectance) {
  const auto plan = plan_with(std::vector<std::string>(5, "0.23"), study_text("diffuse: weather"));
  EXPECT_TRUE(plan.seasons.all.empty());
  EXPECT_NEAR(plan.built.scene.materials.front().diffuse, 0.23, 1e-12);
}

TEST(WeatherAlbedo, GoesTogetherWithSeasons) {
  const auto plan = plan_with({"0.3", "0.3", "0.1", "0.1", "0.1"},
                              study_text("diffuse: weather, seasons: {cold: snow}", "",
                                         "seasons: {cold: [2026-01-11, 2026-01-13]}\n"));
  // Twice snow of 0.8, by whatever albedo of the file: one scene.
  ASSERT_EQ(plan.seasons.all.size(), 3u);
  EXPECT_EQ(plan.seasons.all[0].name, "albedo 0.30");
  EXPECT_EQ(plan.seasons.all[1].name, "cold, albedo 0.30");
  EXPECT_EQ(plan.seasons.of(24), plan.seasons.of(48));
}

TEST(WeatherAlbedo, OfTheFarGroundIsThatOfEachDay) {
  const auto plan = plan_with({"0.82", "0.86", "0.23", "0.14", "0.83"},
                              study_text("diffuse: 0.2", ", far_ground_albedo: weather"));
  EXPECT_TRUE(plan.seasons.all.empty());
  const FarGround far_ground(plan.study);
  EXPECT_DOUBLE_EQ(far_ground.albedo(plan.light.intervals[12]), 0.82);
  EXPECT_DOUBLE_EQ(far_ground.albedo(plan.light.intervals[3 * 24 + 12]), 0.14);
}

TEST(WeatherAlbedo, OfDaysWithoutOneIsRefusedOrTheNearest) {
  const std::vector<std::string> gaps{"0.4", "0", "999", "", "0.4"};
  const std::string refused =
      test::refusal_of([&] { plan_with(gaps, study_text("diffuse: weather")); });
  EXPECT_NE(refused.find("3 of 5 days of the period have no albedo"), std::string::npos) << refused;
  EXPECT_NE(refused.find("light.missing: interpolate"), std::string::npos) << refused;
  const auto plan = plan_with(gaps, study_text("diffuse: weather", ", missing: interpolate"));
  EXPECT_NEAR(plan.built.scene.materials.front().diffuse, 0.4, 1e-12);
  bool is_told = false;
  for (const auto& warning : plan.built.warnings)
    is_told |= warning.find("that of the nearest day is taken") != warning.npos;
  EXPECT_TRUE(is_told);
  // Who asks for none misses none.
  EXPECT_NO_THROW(plan_with(gaps, study_text("diffuse: 0.2")));
}

TEST(WeatherAlbedo, ThatTheFileDoesNotTellIsRefused) {
  for (const auto& text : {study_text("diffuse: weather"),
                           study_text("diffuse: 0.2", ", far_ground_albedo: weather")}) {
    const std::string refused = test::refusal_of([&] {
      plan_with({"0", "0", "0", "0", "0"}, text);
    });
    EXPECT_NE(refused.find("tells no albedo of the ground"), std::string::npos) << refused;
  }
}

TEST(WeatherAlbedo, NeedsAWeatherFile) {
  std::string text = study_text("diffuse: weather", ", far_ground_albedo: weather");
  const std::string source = "source: weather, weather: a.csv, stamp: start";
  text.replace(text.find(source), source.size(), "source: clear_sky");
  const std::string refused = test::refusal_of([&] { plan_of(text); });
  EXPECT_NE(refused.find("diffuse: weather needs light.source: weather"), std::string::npos);
  EXPECT_NE(refused.find("far_ground_albedo: weather needs"), std::string::npos) << refused;
}

}  // namespace
}  // namespace sunload
