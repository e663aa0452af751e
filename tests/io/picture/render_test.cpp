// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "geo/sky/sky_colour.h"
#include "io/base/scene_colours.h"
#include "io/batch/chunk.h"
#include "io/picture/camera.h"
#include "io/picture/render_frame.h"
#include "io/picture/render_scene.h"
#include "io/picture/viewpoint.h"
#include "solver/base/threads.h"
#include "tests/support/png.h"
#include "tests/support/refusal_of.h"
#include "tests/support/small_result.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

using test::bytes_of;
using test::SmallResult;
using test::write_small_result;

std::string picture_path(const std::string& name) {
  return test::folder_of_test() / (name + ".png");
}

double colour_difference(Colour a, Colour b) {
  const Lab p = lab_from_srgb(a), q = lab_from_srgb(b);
  return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b);
}

TEST(ColourMap, LabAndSrgbAreInverse) {
  for (const Colour c : {Colour{0, 0, 0}, Colour{1, 1, 1}, Colour{0.2, 0.7, 0.4}}) {
    const Colour back = srgb_from_lab(lab_from_srgb(c));
    // The two matrices of the standard are inverse to seven digits.
    EXPECT_NEAR(back.red, c.red, 1e-5);
    EXPECT_NEAR(back.green, c.green, 1e-5);
    EXPECT_NEAR(back.blue, c.blue, 1e-5);
  }
  EXPECT_NEAR(lab_from_srgb({1, 1, 1}).lightness, 100, 1e-4);
  // Red of sRGB in CIELAB, as tabulated for D65: L* 53.24, a* 80.09, b* 67.20.
  const Lab red = lab_from_srgb({1, 0, 0});
  EXPECT_NEAR(red.lightness, 53.24, 0.005);
  EXPECT_NEAR(red.a, 80.09, 0.01);
  EXPECT_NEAR(red.b, 67.20, 0.01);
}

TEST(ColourMap, EqualStepsLookEqual) {
  constexpr int steps = 64;
  for (const auto palette : {Palette::false_colour, Palette::grey}) {
    double least = 1e300, largest = 0;
    for (int k = 0; k < steps; ++k) {
      const double step = colour_difference(map_colour(palette, 1.0 * k / steps),
                                            map_colour(palette, (k + 1.0) / steps));
      least = std::min(least, step);
      largest = std::max(largest, step);
    }
    // A helix is uniform but for clipping at the gamut, of which there is none.
    EXPECT_LT(largest / least, 1.001);
  }
}

/// Lightness as dichromats see it: Viénot, Brettel & Mollon (1999), Digital
/// Video Colourmaps for Checking the Legibility of Displays by Dichromats.
double lightness_without_red_cones(Colour c) {
  const double r = linear_from_srgb(c.red), g = linear_from_srgb(c.green),
               b = linear_from_srgb(c.blue);
  const double mixed = 0.11238 * r + 0.88762 * g;
  return lab_from_srgb({srgb_from_linear(mixed), srgb_from_linear(mixed),
                        srgb_from_linear(std::max(0.0, 0.00401 * (r - g) + b))})
      .lightness;
}
double lightness_without_green_cones(Colour c) {
  const double r = linear_from_srgb(c.red), g = linear_from_srgb(c.green),
               b = linear_from_srgb(c.blue);
  const double mixed = 0.29275 * r + 0.70725 * g;
  return lab_from_srgb({srgb_from_linear(mixed), srgb_from_linear(mixed),
                        srgb_from_linear(std::max(0.0, -0.02234 * (r - g) + b))})
      .lightness;
}

TEST(ColourMap, LightnessGrowsForEveryColourVision) {
  constexpr int steps = 64;
  for (int k = 0; k < steps; ++k) {
    const Colour a = map_colour(Palette::false_colour, 1.0 * k / steps),
                 b = map_colour(Palette::false_colour, (k + 1.0) / steps);
    EXPECT_LT(lab_from_srgb(a).lightness, lab_from_srgb(b).lightness) << k;
    EXPECT_LT(lightness_without_red_cones(a), lightness_without_red_cones(b)) << k;
    EXPECT_LT(lightness_without_green_cones(a), lightness_without_green_cones(b)) << k;
  }
}

TEST(ColourMap, DifferencesOfOneSizeAreEquallyLight) {
  for (const double size : {0.25, 0.5, 1.0}) {
    const Colour less = map_colour(Palette::difference, 0.5 - size / 2),
                 more = map_colour(Palette::difference, 0.5 + size / 2);
    // Nothing is clipped at the gamut: lightness is as asked for, on both sides.
    EXPECT_NEAR(lab_from_srgb(less).lightness, 94 - 59 * size, 0.05);
    EXPECT_NEAR(lab_from_srgb(more).lightness, 94 - 59 * size, 0.05);
    EXPECT_GT(less.blue, less.red);
    EXPECT_GT(more.red, more.blue);
  }
  const Lab zero = lab_from_srgb(map_colour(Palette::difference, 0.5));
  EXPECT_LT(std::hypot(zero.a, zero.b), 1e-3);
}

TEST(ColourMap, TicksAreRound) {
  const auto ticks = round_ticks(3, 6);
  EXPECT_EQ(ticks.step, 0.5);
  EXPECT_EQ(ticks.values.size(), 7u);
  EXPECT_EQ(ticks.decimals, 1);
  EXPECT_EQ(round_ticks(800, 6).step, 200);
  EXPECT_EQ(round_ticks(800, 6).decimals, 0);
  EXPECT_EQ(round_ticks(0.3, 3).values.size(), 4u);  // 3 · 0.1 is not lost
  EXPECT_EQ(rounded_up(3.2), 4);
  EXPECT_EQ(rounded_up(900), 1000);
  EXPECT_NEAR(rounded_up(0.012), 0.012, 1e-12);
}

TEST(Camera, FittedCameraHoldsItsPoints) {
  const std::vector<Vec3> points{{0, 0, 0}, {30, 0, 0}, {0, 10, 0}, {5, 5, 20}};
  constexpr int width = 600, height = 400;
  const auto camera = Camera::fitted(points, {-1, -1, 1}, 30, width, height);
  const auto centre = camera.ray(width / 2.0, height / 2.0);
  double widest = 0;
  for (const Vec3 p : points) {
    const Vec3 way = normalized(p - centre.origin);
    const auto at = camera.image_direction(way / dot(way, centre.direction));
    const double half_height = std::tan(radians(15));
    const double x = at.x / (half_height * width / height), y = at.y / half_height;
    EXPECT_LT(std::max(std::abs(x), std::abs(y)), 0.9401);
    widest = std::max({widest, std::abs(x), std::abs(y)});
  }
  EXPECT_GT(widest, 0.9399);  // tight: what touches the margin, touches it exactly
}

TEST(Render, SeenFromAboveEveryRoofHasItsColour) {
  const ResultReader result(write_small_result(SmallResult{}, "render_top"));
  const PatchScene scene(result);
  PatchColours colours;
  colours.largest = 4;
  for (std::size_t i = 0; i < scene.patch_count(); ++i) colours.values.push_back(1);
  const auto object = result.integers("patch_object");
  for (std::size_t i = 0; i < object.size(); ++i)
    if (object[i] == 1) colours.values[i] = 3;  // house_1
  constexpr int width = 400, height = 400;
  const auto camera =
      Camera::parallel({{-20, -20, 0}, {20, 20, 0}}, {0, 0, 1}, {0, 1, 0}, width, height);
  const RayCaster caster(scene.mesh());
  const auto pixels = drawn_pixels(scene, caster, camera, width, height, colours);
  const Colour bright = map_colour(Palette::false_colour, 0.75);
  std::size_t count = 0;
  double x_sum = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (colour_difference(pixels[i], bright) < 1) {
      ++count;
      x_sum += static_cast<double>(i % width);
    }
  // The plate of 40 m fills 94 % of the picture; the roof is 10 m × 8 m, less
  // the line about it, which is at most one pixel wide on its side.
  const double metre = 0.94 * width / 40;
  EXPECT_LE(static_cast<double>(count), 80 * metre * metre + 2 * 18 * metre);
  EXPECT_GE(static_cast<double>(count), (10 * metre - 2) * (8 * metre - 2) - 2 * 18 * metre);
  EXPECT_NEAR(x_sum / static_cast<double>(count), width / 2.0 - 7 * metre, 1);  // in the west
}

TEST(Render, BacksOfTwoSidedPatchesHaveTheirOwnValue) {
  const ResultReader result(write_small_result(SmallResult{}, "render_sides"));
  const PatchScene scene(result);
  const auto awning = result.strings("object_name").size() - 1;
  const auto object = result.integers("patch_object"), side = result.integers("patch_side");
  std::size_t twins = 0;
  for (std::size_t t = 0; t < scene.mesh().triangle_count(); ++t) {
    const auto triangle = static_cast<std::int32_t>(t);
    const auto front = scene.patch_met(triangle, true), back = scene.patch_met(triangle, false);
    const bool is_awning =
        object[static_cast<std::size_t>(front)] == static_cast<std::int32_t>(awning);
    EXPECT_EQ(back >= 0, is_awning);
    if (back < 0) continue;
    EXPECT_EQ(back, front + 1);
    EXPECT_EQ(side[static_cast<std::size_t>(back)], 1);
    ++twins;
  }
  EXPECT_EQ(twins, 8u);
}

TEST(Render, WritesTheSamePngForAnyNumberOfThreads) {
  const ResultReader result(write_small_result(SmallResult{}, "render_threads"));
  RenderRules rules;
  rules.width = 640;
  rules.height = 400;
  rules.mesh = MeshLines::patches;
  const int threads = thread_count();
  std::vector<std::string> files;
  for (const int n : {1, 2, 7}) {
    set_thread_count(n);
    render_png(result, rules, picture_path("render_threads"));
    files.push_back(bytes_of(picture_path("render_threads")));
  }
  set_thread_count(threads);
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(files[0], files[2]);
  // PNG's signature, then width and height as 32-bit numbers in its first chunk.
  EXPECT_EQ(files[0].substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(files[0].substr(16, 8), std::string("\0\0\x02\x80\0\0\x01\x90", 8));
}

// Ground and houses have the colours of their values, in every view.
TEST(Render, EveryViewAndQuantityHasItsColours) {
  SmallResult small;
  small.load = [](const std::string& object, Vec3, std::size_t) {
    return object == "ground" ? 1 : 3;
  };
  const ResultReader result(write_small_result(small, "render_views"));
  RenderRules rules;
  rules.width = 480;
  rules.height = 320;
  const Colour of_ground = map_colour(Palette::false_colour, 0.25),
               of_houses = map_colour(Palette::false_colour, 0.75);
  const auto expect_colours = [&](double ground_share, double house_share) {
    const auto path = picture_path("render_views");
    render_png(result, rules, path);
    const auto png = test::read_png(path);
    ASSERT_EQ(png.pixels.size(), 480u * 320);
    const double pixels = static_cast<double>(png.pixels.size());
    EXPECT_GE(static_cast<double>(test::count_of(png, of_ground)), ground_share * pixels);
    EXPECT_GE(static_cast<double>(test::count_of(png, of_houses)), house_share * pixels);
  };
  for (const auto view : {View::overview, View::sun, View::top})
    for (const char* quantity : {"light_load", "irradiance", "sun_hours"}) {
      SCOPED_TRACE(quantity);
      rules.view = view;
      rules.quantity = quantity;
      // The brightest interval has 300 times the load; hours of sun are 3 everywhere.
      rules.largest = rules.quantity == "irradiance" ? 1200 : 4;
      const bool has_ground = rules.quantity != "sun_hours";
      expect_colours(has_ground ? 0.05 : 0, 0.03);
    }
  // In absolute coordinates: the origin of the result lies at (1000, 2000, 0).
  rules.quantity = "light_load";
  rules.largest = 4;
  rules.eye = "1000,1985,2";
  rules.look = "1000,2000,4";
  expect_colours(0.05, 0.03);
}

TEST(ColourMap, HueRunsFromBlueToRed) {
  const auto expect = [](double share, double red, double green, double blue) {
    const Colour c = map_colour(Palette::hue, share);
    EXPECT_NEAR(c.red, red, 1e-12) << share;
    EXPECT_NEAR(c.green, green, 1e-12) << share;
    EXPECT_NEAR(c.blue, blue, 1e-12) << share;
  };
  // Lightness and saturation 1/2: the largest channel is 3/4, the smallest 1/4.
  expect(0, 0.25, 0.25, 0.75);
  expect(0.25, 0.25, 0.75, 0.75);
  expect(0.5, 0.25, 0.75, 0.25);
  expect(0.75, 0.75, 0.75, 0.25);
  expect(1, 0.75, 0.25, 0.25);
}

/// Pixels of a result seen from above, one colour for every patch but by `values`.
std::vector<Colour> seen_from_above(const ResultReader& result, const PatchColours& colours,
                                    int size) {
  const PatchScene scene(result);
  const auto camera =
      Camera::parallel({{-20, -20, 0}, {20, 20, 0}}, {0, 0, 1}, {0, 1, 0}, size, size);
  const RayCaster caster(scene.mesh());
  return drawn_pixels(scene, caster, camera, size, size, colours);
}

TEST(Render, InterpolatedColoursRunBetweenCorners) {
  const ResultReader result(write_small_result(SmallResult{}, "render_smooth"));
  constexpr int size = 200;
  // The load grows with x as corners have it: colours of the ground are those of the place.
  PatchColours colours;
  colours.largest = 40;
  const auto vertices = result.doubles("vertex_position");
  const auto corners = result.integers("patch_vertices"), side = result.integers("patch_side");
  for (std::size_t p = 0; p < side.size(); ++p) {
    colours.values.push_back(0);
    auto& values = colours.corner_values.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      values[k] = 20 + vertices[3 * static_cast<std::size_t>(corners[3 * p + k])];
  }
  const auto pixels = seen_from_above(result, colours, size);
  const double metre = 0.94 * size / 40;
  std::size_t wrong = 0, count = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double east = (x + 0.5 - size / 2.0) / metre, north = (size / 2.0 - y - 0.5) / metre;
      // The open ground south of the houses and of the awning.
      if (std::abs(east) > 19 || north < -19 || north > -12) continue;
      ++count;
      wrong += colour_difference(pixels[static_cast<std::size_t>(y * size + x)],
                                 map_colour(Palette::false_colour, (20 + east) / 40)) > 1;
    }
  EXPECT_GT(count, 1000u);
  EXPECT_EQ(wrong, 0u);
  // Constant patches are another picture.
  colours.corner_values.clear();
  EXPECT_GT(colour_difference(pixels[180 * size + 150],
                              seen_from_above(result, colours, size)[180 * size + 150]),
            10);
}

TEST(Render, ThePlaneBehindIsTheSkysColour) {
  const ResultReader result(write_small_result(SmallResult{}, "render_sky"));
  const PatchScene scene(result);
  const RayCaster caster(scene.mesh());
  constexpr int size = 64;
  // From the ground straight up between the houses, past the awning.
  const auto camera = Camera::perspective({0, -15, 1}, {0, -15.1, 20}, 20, size, size);
  const TracedPicture traced(scene, caster, camera, size, size, MeshLines::none);
  PatchColours colours;
  colours.values.assign(scene.patch_count(), 1);
  const Vec3 sun = normalized({0, -1, 1});
  for (const auto& [kind, model] : {std::pair{SkyBackground::first, SkyColourModel::first},
                                    std::pair{SkyBackground::second, SkyColourModel::second}}) {
    const auto pixels = traced.pixels(colours, {kind, sun});
    const auto expected =
        sky_colour(model, camera.ray(size / 2.0, size / 2.0).direction, sun, picture_gain);
    const Colour encoded{expected.red, expected.green, expected.blue};  // values of a display
    EXPECT_LT(colour_difference(pixels[size / 2 * size + size / 2], encoded), 0.5);
    EXPECT_GT(colour_difference(plain_sky, encoded), 5);
  }
  // A sun below the horizon paints no sky.
  EXPECT_LT(colour_difference(
                traced.pixels(colours, {SkyBackground::second, {0, -1, -0.1}}).front(), plain_sky),
            0.1);
}

TEST(Render, AFacadeIsSeenFromBeforeIt) {
  const ResultReader result(write_small_result(SmallResult{}, "render_facade"));
  const PatchScene scene(result);
  const auto place = scene_place(result, {{"house_1/south_1"}, {}, {}});
  ASSERT_TRUE(place.normal);
  EXPECT_NEAR(place.normal->y, -1, 1e-9);
  constexpr int size = 100;
  const auto camera = Camera::parallel(place.points, *place.normal, {0, 0, 1}, size, size, 2);
  const RayCaster caster(scene.mesh());
  PatchColours colours;
  colours.largest = 4;
  const auto facade = result.integers("patch_facade");
  const auto names = result.strings("facade_name");
  for (const auto f : facade)
    colours.values.push_back(f >= 0 && names[static_cast<std::size_t>(f)] == "house_1/south_1" ? 3
                                                                                               : 0);
  const auto pixels = drawn_pixels(scene, caster, camera, size, size, colours);
  EXPECT_LT(colour_difference(pixels[50 * size + 50], map_colour(Palette::false_colour, 0.75)), 1);
  EXPECT_THROW(scene_place(result, {{"house_9/south_1"}, {}, {}}), InputError);
  EXPECT_FALSE(scene_place(result, {{"house_1/*"}, {}, {}}).normal);  // they look all ways
  EXPECT_TRUE(scene_place(result, {{"*/south_1"}, {}, {}}).normal);
}

TEST(Render, PlacesAreNamedOrRelativeToNames) {
  // house_1: x −12 … −2, y 0 … 8, z 0 … 9, relative to (1000, 2000, 0).
  const ResultReader result(write_small_result(SmallResult{}, "render_places"));
  const auto at = [&](const char* text, ViewpointOf of) { return viewpoint(result, text, of).at; };
  const auto expect = [](Vec3 found, Vec3 wanted) { EXPECT_LT(norm(found - wanted), 1e-9); };
  expect(at("1001, 2002,3", ViewpointOf::eye), {1, 2, 3});
  expect(at("house_1", ViewpointOf::look), {-7, 4, 4.5});
  expect(at("house_1", ViewpointOf::eye), {-7, 4, 9 + 1.7});
  expect(at("house_1+0,-30,1.7", ViewpointOf::eye), {-7, -26, 1.7});
  expect(at("house_1+-3,0,2", ViewpointOf::look), {-10, 4, 2});
  expect(at("house_1/south_1", ViewpointOf::eye), {-7, -0.5, 4.5});
  EXPECT_NEAR(viewpoint(result, "house_1/south_1", ViewpointOf::eye).towards->y, -1, 1e-9);
  const auto refusal =
      test::refusal_of([&] { viewpoint(result, "hause_1+0,1,2", ViewpointOf::eye); });
  EXPECT_NE(refusal.find("did you mean 'house_1'"), std::string::npos) << refusal;
  EXPECT_THROW(viewpoint(result, "house_1+0,1", ViewpointOf::eye), InputError);
  EXPECT_THROW(viewpoint(result, "1,2,nan", ViewpointOf::eye), InputError);
}

TEST(Render, TheCameraHoldsBuildingsAndNotWhatLiesFlat) {
  SmallResult small;
  // A plate that is modelled as a thin body.
  small.houses.push_back({"slab", {-200, -200, -0.4}, {200, 200, -0.1}});
  const ResultReader result(write_small_result(small, "render_focus"));
  for (const Vec3 p : PatchScene(result).focus_points()) {
    EXPECT_LE(std::abs(p.x), 12);
    EXPECT_LE(std::abs(p.y), 8);
  }
}

TEST(Render, KindsNeedNoLight) {
  const ResultReader result(write_small_result(SmallResult{}, "render_kinds"));
  RenderRules rules;
  rules.width = 480;
  rules.height = 320;
  rules.view = View::top;
  const auto path = picture_path("render_kinds");
  rules.colours = PictureColours::of_surfaces;
  render_png(result, rules, path);
  auto png = test::read_png(path);
  for (const auto kind : {Surface::roof, Surface::ground})
    EXPECT_GT(test::count_of(png, surface_colour(static_cast<std::size_t>(kind))), 1000u);
  rules.colours = PictureColours::of_materials;
  render_png(result, rules, path);
  png = test::read_png(path);
  const auto colours = material_colours(result.strings("material_name"));
  EXPECT_GT(test::count_of(png, material_colour(colours.front())), 10000u);
  rules.largest = 3;
  EXPECT_THROW(render_png(result, rules, path), InputError);
  rules.largest = {};
  rules.time = "2026-06-21T11:30";
  EXPECT_THROW(render_png(result, rules, path), InputError);
  rules.view = View::sun;
  EXPECT_NO_THROW(render_png(result, rules, path));
}

TEST(Render, APictureOfNothingIsRefusedWithThePlaceOfTheScene) {
  const ResultReader result(write_small_result(SmallResult{}, "render_nothing"));
  const auto refusal = [&](const auto& change) {
    RenderRules rules;
    rules.width = rules.height = 320;
    change(rules);
    return test::refusal_of([&] { render_png(result, rules, picture_path("render_nothing")); });
  };
  const auto past = refusal([](RenderRules& r) {
    r.eye = "1000,1900,2";
    r.look = "1000,1800,2";
  });
  EXPECT_NE(past.find("the scene lies in x 980.0 … 1020.0, y 1980.0 … 2020.0, z 0.0 … 9.0 m"),
            std::string::npos)
      << past;
  const auto inside = refusal([](RenderRules& r) {
    r.eye = "993,2004,4";
    r.look = "994,2004,4";
  });
  EXPECT_NE(inside.find("inside of a body"), std::string::npos) << inside;
  // Asked for, but on the far side.
  const auto hidden = refusal([](RenderRules& r) {
    r.parts.objects = {"house_1"};
    r.eye = "1001,2004,3";
    r.look = "1015,2004,3";
  });
  EXPECT_FALSE(hidden.empty());
  EXPECT_EQ(refusal([](RenderRules& r) { r.look = "house_1"; }), "");
  EXPECT_EQ(refusal([](RenderRules& r) { r.parts.facades = {"house_1/*"}; }), "");
  EXPECT_EQ(refusal([](RenderRules& r) { r.eye = "house_1/south_1"; }), "");
  EXPECT_NE(refusal([](RenderRules& r) { r.eye = "house_1"; }), "");
  EXPECT_NE(refusal([](RenderRules& r) { r.look = "1,2,3"; }), "");
  // A total has no time, but for a camera or a sky that has.
  const auto timed = refusal([](RenderRules& r) { r.time = "2026-06-21T11:30"; });
  EXPECT_NE(timed.find("is a total of the whole period"), std::string::npos) << timed;
  EXPECT_EQ(refusal([](RenderRules& r) {
              r.time = "2026-06-21T11:30";
              r.view = View::sun;
            }),
            "");
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t k = 0; k < 4; ++k)
    number = number << 8 | static_cast<unsigned char>(bytes.at(at + k));
  return number;
}

/// Names of the chunks of a PNG with the check of each.
std::vector<std::string> chunks_of(const std::string& png) {
  std::vector<std::string> names;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t length = big_endian(png, at);
    names.push_back(png.substr(at + 4, 4));
    EXPECT_EQ(big_endian(png, at + 8 + length), crc32(png.data() + at + 4, length + 4))
        << names.back();
    at += length + 12;
  }
  return names;
}

TEST(Render, LogarithmicColoursSpanThreeDecades) {
  const double least = least_of_decades(500);
  EXPECT_NEAR(least, 0.5, 1e-12);
  const auto share = [&](double value) {
    return colour_share(ColourScale::logarithmic, value, least, 500);
  };
  EXPECT_EQ(share(0), 0);
  EXPECT_EQ(share(-3), 0);
  EXPECT_EQ(share(0.1), 0);
  EXPECT_NEAR(share(5), 1.0 / 3, 1e-12);
  EXPECT_NEAR(share(50), 2.0 / 3, 1e-12);
  EXPECT_EQ(share(500), 1);
  EXPECT_EQ(share(1e4), 1);
  EXPECT_NEAR(colour_share(ColourScale::linear, 50, 0, 500), 0.1, 1e-12);
  const std::vector<double> ticks{0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500};
  const auto drawn = logarithmic_ticks(least, 500);
  ASSERT_EQ(drawn.size(), ticks.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_NEAR(drawn[i], ticks[i], 1e-9 * ticks[i]);
}

TEST(Render, AnAnimationHasAPictureForEverySun) {
  const ResultReader result(write_small_result(SmallResult{}, "render_animation"));
  RenderRules rules;
  rules.width = 480;
  rules.height = 320;
  const auto path = picture_path("animation");
  render_animation(result, rules, path);
  const auto png = bytes_of(path);
  const auto chunks = chunks_of(png);
  // Three hours of sun: the first picture is the one that all readers know.
  EXPECT_EQ(std::count(chunks.begin(), chunks.end(), "fcTL"), 3);
  EXPECT_EQ(chunks[1], "acTL");
  EXPECT_EQ(big_endian(png, 8 + 25 + 8), 3u);
  EXPECT_EQ(chunks.back(), "IEND");
  const auto before_data = [&](const char* name) {
    return std::find(chunks.begin(), chunks.end(), name);
  };
  EXPECT_LT(before_data("fcTL"), before_data("IDAT"));
  EXPECT_LT(before_data("IDAT"), before_data("fdAT"));
  // One scale for all: the second hour by itself, with the animation's limit, is its second
  // picture.
  std::vector<std::string> single;
  for (const char* name : {"animation-0001", "animation-0002", "animation-0003"})
    single.push_back(bytes_of(picture_path(name)));
  EXPECT_NE(single[0], single[1]);
  rules.quantity = "irradiance";
  render_png(result, rules, picture_path("animation_second"));  // the brightest
  EXPECT_EQ(bytes_of(picture_path("animation_second")), single[1]);
}

TEST(Render, PicturesThatAreComparedShareTheirScale) {
  SmallResult brighter;
  brighter.load = [](const std::string&, Vec3, std::size_t) { return 30; };
  const auto other = write_small_result(brighter, "render_brighter");
  const ResultReader result(write_small_result(SmallResult{}, "render_scale"));
  RenderRules rules;
  rules.width = 480;
  rules.height = 320;
  rules.same_scale = {other};
  render_png(result, rules, picture_path("shared"));
  rules.same_scale = {};
  rules.largest = 30;
  render_png(result, rules, picture_path("limit"));
  EXPECT_EQ(bytes_of(picture_path("shared")), bytes_of(picture_path("limit")));
}

TEST(Render, ScalesAreOfWhatIsDrawn) {
  SmallResult dark_house;
  dark_house.load = [](const std::string& object, Vec3, std::size_t) {
    return object == "house_1" ? 3 : 400;
  };
  const ResultReader result(write_small_result(dark_house, "render_part_scale"));
  RenderRules rules;
  rules.width = 480;
  rules.height = 320;
  rules.parts.objects = {"house_1"};
  render_png(result, rules, picture_path("part"));
  rules.largest = 3;
  render_png(result, rules, picture_path("part_limit"));
  EXPECT_EQ(bytes_of(picture_path("part")), bytes_of(picture_path("part_limit")));
}

TEST(Render, RefusesWhatTheResultDoesNotHave) {
  const ResultReader result(write_small_result(SmallResult{}, "render_refuses"));
  const auto path = picture_path("render_refuses");
  std::filesystem::remove(path);
  const auto with = [](auto change) {
    RenderRules rules;
    change(rules);
    return rules;
  };
  const std::vector<RenderRules> wrong{
      with([](RenderRules& r) { r.quantity = "glare"; }),
      with([](RenderRules& r) { r.quantity = "patch_object"; }),
      with([](RenderRules& r) { r.quantity = "time"; }),
      with([](RenderRules& r) { r.time = "2027-01-01"; }),
      with([](RenderRules& r) { r.eye = "1,2,3"; }),
      with([](RenderRules& r) { r.eye = r.look = "1,2,3"; }),
      with([](RenderRules& r) { r.largest = 0.0; }),
      with([](RenderRules& r) { r.parts.facades = {"no_facade"}; }),
      with([](RenderRules& r) { r.crease_angle_deg = 10; }),
      with([](RenderRules& r) {
        r.view = View::top;
        r.projection = Projection::perspective;
      }),
      with([](RenderRules& r) {
        r.parts.facades = {"*"};
        r.projection = Projection::parallel;
      }),
      with([](RenderRules& r) { r.width = 10; })};
  for (const auto& rules : wrong) EXPECT_THROW(render_png(result, rules, path), InputError);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_THROW(render_png(result, with([](RenderRules& r) { r.width = r.height = 400; }),
                          picture_path("no_such_folder/x")),
               MachineError);
}

TEST(Legend, HasRoomForItsNumbers) {
  EXPECT_EQ(tick_text(0, 3), "0.000");
  EXPECT_EQ(tick_text(-0.0025, 4), "-0.0025");
  EXPECT_EQ(tick_text(0.00001, 5), "0.00001");
  EXPECT_EQ(tick_text(0, 8), "0");
  EXPECT_EQ(tick_text(2.5e-8, 9), "2.5e-8");
  EXPECT_EQ(tick_text(1.2e-6, 7), "1.2e-6");
  EXPECT_EQ(tick_text(4e-11, 9), "4e-11");
}

}  // namespace
}  // namespace sunload
