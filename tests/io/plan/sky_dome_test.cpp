// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sky command's table and pictures, and the sun-path diagram's geometry.
#include "io/plan/sky_dome.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "geo/base/check.h"
#include "io/picture/dome_chart.h"
#include "io/picture/sun_diagram.h"
#include "tests/support/png.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

Study study_at_prague() {
  Study study;
  study.name = "test";
  study.site.latitude_deg = 50;
  study.site.longitude_deg = 14;
  study.site.timezone = "Europe/Prague";
  study.scene.builtin = BuiltinStudy{"box_on_plane", {}, {}};
  study.period.kind = DaysPeriod{{{2026, 3, 21, 0, 0, 0}}, 0, seconds_per_day, 60};
  return study;
}

double horizontal_irradiance(const std::vector<SkyRow>& rows) {
  double sum = 0;
  for (const auto& row : rows)
    sum += row.radiance * row.solid_angle * std::sin(radians(row.elevation_deg));
  return sum;
}

TEST(SkyDome, TableHoldsTheDiffuseLight) {
  const SkyDome dome = sky_dome(study_at_prague(), "2026-06-21T12:00");
  EXPECT_GT(dome.light.mean.dhi, 50);
  const std::optional<Subdivision> subdivisions[] = {
      {}, Subdivision::tregenza, Subdivision::reinhart_mf2, Subdivision::reinhart_mf4};
  const std::size_t counts[] = {4096, 145, 577, 2305};
  const double tolerances[] = {0.02 / 16, 0.02, 0.02 / 4, 0.02 / 16};
  for (std::size_t n = 0; n < 4; ++n) {
    const auto rows = sky_rows(dome, subdivisions[n]);
    ASSERT_EQ(rows.size(), counts[n]);
    double solid_angle = 0;
    for (const auto& row : rows) {
      solid_angle += row.solid_angle;
      EXPECT_GE(row.radiance, 0);
    }
    EXPECT_NEAR(solid_angle, 2 * pi, 1e-9);
    // Radiance times the cosine of a patch's middle is a midpoint rule: its error falls with the
    // square of the patches' size, from some 2 % for those of 12 degrees (the cells are of 1.4).
    EXPECT_NEAR(horizontal_irradiance(rows), dome.light.mean.dhi,
                tolerances[n] * dome.light.mean.dhi);
  }
  const std::string csv = sky_csv(sky_rows(dome, Subdivision::tregenza));
  EXPECT_TRUE(
      csv.starts_with("azimuth_deg,elevation_deg,radiance_w_m2_sr,solid_angle_sr,"
                      "projected_solid_angle_sr,luminance_cd_m2\n0.0"));
}

TEST(SkyDome, LuminanceGivesTheDiffuseIlluminance) {
  const SkyDome dome = sky_dome(study_at_prague(), "2026-06-21T12:00");
  double lux = 0;
  for (const auto& row : sky_rows(dome, {})) lux += row.luminance * row.projected;
  const double truth = source_means(dome.light, Quantity::illuminance).dhi;
  constexpr double rounding = 1e-9;  // of sums over some thousand cells
  EXPECT_NEAR(lux, truth, rounding * truth);
}

// Sunlight has another efficacy than the sky's.
TEST(SkyDome, HillsHaveTheLuminanceOfWhatLightsThem) {
  Study study = study_at_prague();
  study.site.horizon = Horizon({{0, 30}});
  const SkyDome dome = sky_dome(study, "2026-06-21T12:00");
  const auto rows = sky_rows(dome, Subdivision::tregenza);
  const double lux = source_means(dome.light, Quantity::illuminance).ghi;
  constexpr double albedo = 0.2, rounding = 1e-12;
  ASSERT_EQ(study.light.far_ground_albedo, albedo);
  EXPECT_NEAR(rows.front().luminance, albedo * lux / pi, rounding * lux);
  EXPECT_EQ(rows.front().luminance, dome.luminance({0, 10}));
  EXPECT_NE(rows.front().luminance, rows.front().radiance * dome.efficacy());
  EXPECT_EQ(rows.back().luminance, rows.back().radiance * dome.efficacy());
}

TEST(SkyDome, LuminanceOfTheZenithIsAsItIsGiven) {
  constexpr double given = 3000;
  Study study = study_at_prague();
  study.light.sky = SkyModel::cie_clear;
  study.light.sky_scale = SkyScale::absolute;
  study.light.zenith_luminance_cd_m2 = given;
  const auto rows = sky_rows(sky_dome(study, "2026-06-21T12:00"), Subdivision::reinhart_mf4);
  // The last patch is a cap of some degrees about the zenith: its mean differs by their square.
  EXPECT_NEAR(rows.back().luminance, given, 0.01 * given);
}

// By the exact projection no light is lost or won at the horizon, of a low sun either; what is
// left is that radiance and cosine vary together inside of a patch.
TEST(SkyDome, ProjectionsOfPatchesKeepTheDiffuseLight) {
  const SkyDome dome = sky_dome(study_at_prague(), "2026-06-21T05:30");
  const auto error = [&](std::optional<Subdivision> subdivision, auto cosine_weight) {
    double sum = 0;
    for (const auto& row : sky_rows(dome, subdivision)) sum += row.radiance * cosine_weight(row);
    return std::abs(sum / dome.light.mean.dhi - 1);
  };
  const auto exact = [](const SkyRow& row) { return row.projected; };
  const auto middle = [](const SkyRow& row) {
    return row.solid_angle * std::sin(radians(row.elevation_deg));
  };
  EXPECT_LT(error({}, exact), 1e-9);
  for (const auto kind : {Subdivision::reinhart_mf2, Subdivision::reinhart_mf4})
    EXPECT_LT(error(kind, exact), error(kind, middle));
  double projected = 0;
  for (const auto& row : sky_rows(dome, Subdivision::tregenza)) projected += row.projected;
  EXPECT_NEAR(projected, pi, 1e-9);
}

TEST(SkyDome, SaysWhatHappensToItsTime) {
  const SkyDome skipped = sky_dome(study_at_prague(), "2024-03-31T02:30");
  ASSERT_FALSE(skipped.notes.empty());
  EXPECT_NE(skipped.notes.front().find("02:30 is skipped"), std::string::npos);
  EXPECT_TRUE(sky_dome(study_at_prague(), "2024-03-31T12:30").notes.empty());
  EXPECT_EQ(skipped.model, "Perez all-weather sky");
}

TEST(SkyDome, BrightestPatchIsAtTheSun) {
  Study study = study_at_prague();
  study.site.north_deg = 70;  // turns the scene, not the sky
  const SkyDome dome = sky_dome(study, "2026-06-21T09:00");
  SkyRow brightest;
  for (const auto& row : sky_rows(dome, {}))
    if (row.radiance > brightest.radiance) brightest = row;
  const Vec3 sun =
      enu_direction({dome.light.when.sun.azimuth_deg, dome.light.when.sun.elevation_deg});
  const Vec3 found = enu_direction({brightest.azimuth_deg, brightest.elevation_deg});
  constexpr double cell_deg = 2;  // cells are 90°/64 wide, and the gradation shifts the maximum
  EXPECT_LT(degrees(std::acos(dot(sun, found))), cell_deg);
}

TEST(SkyDome, HillsShineAsTheGround) {
  Study study = study_at_prague();
  study.site.horizon = Horizon({{0, 30}});
  const SkyDome dome = sky_dome(study, "2026-06-21T12:00");
  EXPECT_EQ(dome.radiance({10, 29}), dome.ground_radiance);
  EXPECT_NE(dome.radiance({10, 31}), dome.ground_radiance);
  for (const auto& row : sky_rows(dome, Subdivision::reinhart_mf4)) {
    if (row.elevation_deg >= 25) continue;
    EXPECT_EQ(row.radiance, dome.ground_radiance);
  }
}

TEST(SkyDome, TimesAreThoseOfAStudy) {
  const Study study = study_at_prague();
  const auto sun_time = [&](const std::string& time) {
    return sky_dome(study, time).light.when.sun_time;
  };
  EXPECT_EQ(iso_utc(sun_time("2026-06-21T12:00")), "2026-06-21T10:00:00Z");
  EXPECT_EQ(sun_time("2026-06-21T12:00"), sun_time("2026-06-21T10:00Z"));
  EXPECT_EQ(sun_time("2026-06-21 12:00"), sun_time("2026-06-21T11:00+01:00"));
  EXPECT_THROW(sun_time("2026-06-21"), InputError);
  EXPECT_THROW(sun_time("noon"), InputError);
  Study positions = study;
  positions.period.kind = PositionsPeriod{{{90, 20, 60}, {180, 50, 60}}};
  positions.light.source = LightSource::fixed;
  positions.light.dhi_w_m2 = 100;
  EXPECT_EQ(sky_dome(positions, "2000-01-01T13:30Z").light.when.sun.azimuth_deg, 180);
  EXPECT_THROW(sky_dome(positions, "2026-01-01T12:00Z"), InputError);
}

TEST(DomeChart, IsAMapWithNorthUpAndEastRight) {
  const Picture picture(400, 400);
  for (const auto projection : {DomeProjection::stereographic, DomeProjection::equidistant}) {
    const DomeChart chart(picture, projection, 0);
    const auto centre = chart.centre();
    const double R = chart.radius();
    const auto expect_at = [&](Horizontal place, double x, double y) {
      const PicturePoint p = chart.at(place);
      EXPECT_NEAR(p.x, centre.x + x * R, 1e-9);
      EXPECT_NEAR(p.y, centre.y + y * R, 1e-9);
    };
    expect_at({0, 90}, 0, 0);
    expect_at({0, 0}, 0, -1);
    expect_at({90, 0}, 1, 0);
    expect_at({180, 0}, 0, 1);
    expect_at({270, 0}, -1, 0);
    const bool is_stereographic = projection == DomeProjection::stereographic;
    expect_at({90, 45}, is_stereographic ? std::tan(pi / 8) : 0.5, 0);
    const auto back = chart.place(chart.at({123, 34}));
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->azimuth_deg, 123, 1e-9);
    EXPECT_NEAR(back->elevation_deg, 34, 1e-9);
    EXPECT_FALSE(chart.place({centre.x + R * 1.001, centre.y}));
  }
}

test::Png drawn(const std::function<void(const std::string&)>& draw) {
  const auto path = test::folder_of_test() / "dome.png";
  draw(path);
  return test::read_png(path);
}

// Between the grid's circles (every 10 degrees) and rays (every 30), and away from the sun.
constexpr std::array<Horizontal, 5> beside_lines{
    {{15, 45}, {75, 15}, {75, 75}, {255, 35}, {315, 5}}};
constexpr double of_bytes = 1.01 / 255;

/// Share of the scale that a colour of the palette stands for: its lightness grows evenly.
double share_of(Colour colour) {
  const double dark = lab_from_srgb(map_colour(Palette::false_colour, 0)).lightness,
               light = lab_from_srgb(map_colour(Palette::false_colour, 1)).lightness;
  return (lab_from_srgb(colour).lightness - dark) / (light - dark);
}

TEST(SkyPicture, LuminancesAreThoseOfTheDome) {
  for (const char* time : {"2026-06-21T12:00", "2026-06-21T20:30", "2026-06-21T01:00"}) {
    const SkyDome dome = sky_dome(study_at_prague(), time);
    const auto png = drawn(
        [&](const std::string& path) { draw_sky(dome, {.kind = SkyPicture::luminance}, path); });
    constexpr double legend_width = 150;
    const Picture paper(png.width, png.height);
    const DomeChart chart(paper, DomeProjection::equidistant, legend_width);
    // One scale: shares are radiances times one factor.
    double factor = 0;
    for (const Horizontal place : beside_lines) {
      const auto p = chart.at(place);
      const double share = share_of(png.at(p.x, p.y)), radiance = dome.radiance(place);
      SCOPED_TRACE(fmt::format("{}: {} {}", time, place.azimuth_deg, place.elevation_deg));
      if (radiance == 0) {
        EXPECT_NEAR(share, 0, 0.01);
        continue;
      }
      if (factor == 0) factor = share / radiance;
      EXPECT_NEAR(share, std::min(1.0, factor * radiance), 0.03);
    }
    EXPECT_EQ(factor > 0, dome.light.mean.dhi > 0);
  }
}

TEST(SkyPicture, ColoursAreThoseOfTheModel) {
  const SkyDome dome = sky_dome(study_at_prague(), "2026-06-21T12:00");
  const auto png =
      drawn([&](const std::string& path) { draw_sky(dome, {.kind = SkyPicture::colour}, path); });
  const Picture paper(png.width, png.height);
  const DomeChart chart(paper, DomeProjection::equidistant, 0);
  for (const Horizontal place : beside_lines) {
    const auto p = chart.at(place);
    const Rgb model = sky_colour(SkyColourModel::second, enu_direction(place),
                                 dome.light.when.direction, picture_gain);
    // Half a pixel is a twentieth of a degree.
    EXPECT_LT(test::difference(png.at(p.x, p.y), {model.red, model.green, model.blue}),
              0.01 + of_bytes)
        << place.azimuth_deg;
  }
}

TEST(SunDiagram, HasHillsAndSunsFromPoleToPole) {
  constexpr Colour hills{0.87, 0.85, 0.80}, dot{0.95, 0.62, 0.05};
  std::size_t all_dots = 0;
  for (const double latitude_deg : {90.0, 78.0, 50.0, 0.0, -34.0, -90.0}) {
    Study study = study_at_prague();
    study.site.latitude_deg = latitude_deg;
    study.site.horizon = Horizon({{0, 5}, {90, 20}});
    const Site site{.latitude_deg = latitude_deg,
                    .longitude_deg = 14,
                    .north_deg = 20,
                    .timezone = "Europe/Prague",
                    .horizon = study.site.horizon};
    const auto light = light_series(study, site);
    const auto png =
        drawn([&](const std::string& path) { draw_sun_diagram(study, site, light, path); });
    const Picture paper(png.width, png.height);
    constexpr double room_for_days = 0.11;
    const DomeChart chart(paper, DomeProjection::stereographic, 0, room_for_days);
    // Hills of 5 to 20 degrees fill a tenth of the disc and more; lines and dots are thin.
    EXPECT_GT(static_cast<double>(test::count_of(png, hills)),
              0.1 * pi * chart.radius() * chart.radius())
        << latitude_deg;
    std::size_t dots = 0, seen = 0;
    for (const auto& interval : light.intervals) {
      if (interval.when.sunlit_s <= 0 || interval.when.sun.elevation_deg < 0) continue;
      const auto p = chart.at({interval.when.sun.azimuth_deg, interval.when.sun.elevation_deg});
      ++dots;
      seen += test::difference(png.at(p.x, p.y), dot) <= of_bytes ? 1U : 0U;
    }
    // Labels of hours lie over some.
    EXPECT_GE(2 * seen, dots) << latitude_deg;
    all_dots += dots;
  }
  EXPECT_GT(all_dots, 20u);
}

}  // namespace
}  // namespace sunload
