// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/export.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/export/format.h"
#include "io/export/light_map.h"
#include "io/scene/file.h"
#include "tests/support/png.h"
#include "tests/support/refusal_of.h"
#include "tests/support/small_result.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

using test::bytes_of;
using test::SmallResult;
using test::write_small_result;

std::string path_of(const std::string& name) { return test::folder_of_test() / name; }

std::string exported(const std::string& result, const ExportRules& rules) {
  const auto path = path_of("exported." + rules.format);
  export_result(ResultReader(result), rules, path);
  return bytes_of(path);
}

std::string refusal(const ExportRules& rules, const std::string& path) {
  return test::refusal_of(
      [&] { export_result(ResultReader(write_small_result({}, "export_refused")), rules, path); });
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

Vec3 corner_read(const PolygonModel& model, std::size_t polygon, std::size_t k) {
  const auto ring = static_cast<std::size_t>(model.polygon_ring[polygon]);
  const auto at = static_cast<std::size_t>(model.ring_begin[ring]) + k;
  return model.vertices[static_cast<std::size_t>(model.ring_vertex[at])];
}

/// Names that every format has its own trouble with.
SmallResult awkward_names() {
  SmallResult small;
  small.houses[0].name = "a \"b\", <c> & \\d\n#e";
  small.houses[1].name = "dům č. 2";
  return small;
}

/// Our own readers find every patch where it is, with its front where it was.
void expect_read_back(const std::string& format, const std::string& file, bool single_precision) {
  const auto path = write_small_result(awkward_names(), "export_" + format);
  const ResultReader result(path);
  const ResultPatches patches(result);
  ExportRules rules;
  rules.format = format;
  export_result(result, rules, path_of(file));
  const auto model = read_scene_file(path_of(file), {});
  ASSERT_EQ(model.polygon_count(), patches.corners.size()) << format;
  const auto rounded = [&](Vec3 p) {
    return single_precision
               ? Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}
               : p;
  };
  for (std::size_t i = 0; i < patches.corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(corner_read(model, i, k),
                rounded(patches.vertices[static_cast<std::size_t>(patches.corners[i][k])]))
          << format << " patch " << i;
}

TEST(Export, OwnReadersFindEveryPatch) {
  expect_read_back("vrml", "read_back.wrl", true);
  expect_read_back("glb", "read_back.glb", true);
  expect_read_back("ply", "read_back.ply", false);
}

TEST(Export, GltfHasANodePerObject) {
  const auto path = write_small_result(awkward_names(), "export_nodes");
  ExportRules rules;
  rules.format = "glb";
  export_result(ResultReader(path), rules, path_of("nodes.glb"));
  const auto model = read_scene_file(path_of("nodes.glb"), {});
  EXPECT_EQ(model.object_names, ResultReader(path).strings("object_name"));
}

/// The texture of a light map, as a viewer reads it.
test::Png texture_of(const LightMap& map, const std::string& name) {
  std::ofstream(path_of(name), std::ios::binary) << map.png();
  return test::read_png(path_of(name));
}

/// What a viewer shows at these weights of a patch's corners: between the four nearest texels in
/// proportion.
Colour filtered(const test::Png& texture, const LightMap& map, std::size_t patch,
                std::array<double, 3> weights) {
  double u = 0, v = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    u += weights[k] * static_cast<double>(map.place(patch, k)[0]) * texture.width;
    v += weights[k] * static_cast<double>(map.place(patch, k)[1]) * texture.height;
  }
  const double left = std::floor(u - 0.5), top = std::floor(v - 0.5);
  Colour sum;
  for (const double i : {0.0, 1.0})
    for (const double j : {0.0, 1.0}) {
      const Colour texel = texture.at(left + i, top + j);
      const double share = (1 - std::abs(u - 0.5 - left - i)) * (1 - std::abs(v - 0.5 - top - j));
      sum.red += share * texel.red;
      sum.green += share * texel.green;
      sum.blue += share * texel.blue;
    }
  return sum;
}

/// Corners, and points along edges and inside.
constexpr std::array<std::array<double, 3>, 6> points_of_patch{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0, 0.25, 0.75}, {0.3, 0.3, 0.4}}};
constexpr double half_a_byte = 0.51 / 255;

TEST(LightMap, EveryPatchHasItsOwnColourRightUpToItsEdges) {
  ExportColours colours;
  for (int i = 0; i < 23; ++i) colours.patch_step.push_back(i % 2 == 0 ? 0 : 1023);
  colours.patch_step.back() = -1;
  const LightMap map(colours, "result.h5");
  const auto texture = texture_of(map, "constant.png");
  ASSERT_EQ(texture.width, map.width());
  ASSERT_EQ(texture.height, map.height());
  for (std::size_t i = 0; i < colours.patch_step.size(); ++i)
    for (const auto& weights : points_of_patch)
      EXPECT_LE(test::difference(filtered(texture, map, i, weights),
                                 export_colour(colours.palette, colours.patch_step[i])),
                half_a_byte)
          << i;
}

TEST(LightMap, StepsRunEvenlyBetweenCorners) {
  ExportColours colours;
  colours.patch_step = {0, 0, 0, 0, 0};
  colours.corner_step = {{0, 1023, 512}, {1023, 0, 0}, {700, 700, 700}, {-1, 300, 900}, {5, 4, 3}};
  const LightMap map(colours, "result.h5");
  const auto texture = texture_of(map, "interpolated.png");
  for (const std::size_t patch : {0u, 1u, 2u, 4u})
    for (const auto& weights : points_of_patch) {
      const auto& steps = colours.corner_step[patch];
      const double step = weights[0] * steps[0] + weights[1] * steps[1] + weights[2] * steps[2];
      // Texels are flat and steps end at those of the corners: half a texel of the slope.
      EXPECT_LE(test::difference(
                    filtered(texture, map, patch, weights),
                    export_colour(colours.palette, static_cast<std::int32_t>(std::lround(step)))),
                0.13)
          << patch << " " << step;
    }
  // Colours in the middle are those of the scale, not mixed ones: half-way from first to last.
  EXPECT_LE(test::difference(filtered(texture, map, 1, {0.5, 0.25, 0.25}),
                             export_colour(colours.palette, 512)),
            0.03);
  // A corner of which nothing is known is grey; the others are as they are.
  EXPECT_LE(test::difference(filtered(texture, map, 3, {1, 0, 0}), back_colour), half_a_byte);
  EXPECT_LE(
      test::difference(filtered(texture, map, 3, {0, 1, 0}), export_colour(colours.palette, 300)),
      half_a_byte);
}

TEST(LightMap, PlacesAreTheSameWhateverItShows) {
  ExportColours some, others;
  some.patch_step.assign(1000, 1);
  others.patch_step.assign(1000, 900);
  const LightMap one(some, "a.h5"), other(others, "b.h5");
  for (const std::size_t i : {0u, 31u, 32u, 999u})
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(one.place(i, k), other.place(i, k));
      EXPECT_GT(one.place(i, k)[0], 0);
      EXPECT_LT(one.place(i, k)[1], 1);
    }
}

TEST(LightMap, RefusesMorePatchesThanATextureHolds) {
  ExportColours colours;
  colours.patch_step.assign(2048 * 2048 + 1, 0);
  EXPECT_NE(test::refusal_of([&] { LightMap(colours, "big.h5"); }).find("4194304"),
            std::string::npos);
  colours.patch_step.assign(2048 * 2048, 0);
  EXPECT_EQ(LightMap(colours, "big.h5").width(), 8192);
}

TEST(Export, GltfWithALightMapIsTheSameModel) {
  const auto path = write_small_result(awkward_names(), "export_lightmap");
  ExportRules rules;
  rules.format = "glb";
  export_result(ResultReader(path), rules, path_of("plain.glb"));
  for (const bool interpolate : {false, true}) {
    rules.light_map = true;
    rules.interpolate = interpolate;
    export_result(ResultReader(path), rules, path_of("lightmap.glb"));
    const auto plain = read_scene_file(path_of("plain.glb"), {});
    const auto mapped = read_scene_file(path_of("lightmap.glb"), {});
    EXPECT_EQ(mapped.object_names, plain.object_names);
    ASSERT_EQ(mapped.polygon_count(), plain.polygon_count());
    for (std::size_t i = 0; i < plain.polygon_count(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(corner_read(mapped, i, k), corner_read(plain, i, k));
    EXPECT_EQ(count_of(bytes_of(path_of("lightmap.glb")), "COLOR_0"), 0u);
  }
  ExportRules as_vrml;
  as_vrml.format = "vrml";
  as_vrml.light_map = true;
  EXPECT_NE(refusal(as_vrml, path_of("a.wrl")).find("--to glb"), std::string::npos);
}

TEST(Export, TablesHaveARowPerPatchOrTime) {
  const auto path = write_small_result(awkward_names(), "export_csv");
  const ResultReader result(path);
  const auto loads = result.doubles("light_load"), area = result.doubles("patch_area");
  ExportRules rules;
  rules.format = "csv";
  // One object's name has a line end, which is written out where the result is read.
  EXPECT_EQ(lines_of(exported(path, rules)).size(), 1 + loads.size());
  EXPECT_NE(exported(path, rules).find("\"a \"\"b\"\", <c>"), std::string::npos);

  rules.quantity = "irradiance";
  rules.time = "2026-06-21T09:30Z";
  const auto rows = lines_of(exported(path, rules));
  EXPECT_EQ(rows.front(), "index,object,facade,surface,side,area_m2,irradiance_w_m2,time_utc");
  // The ground, 2 + 1 kWh/m²; a hundredfold in the first hour.
  EXPECT_EQ(rows.at(1), "0,ground,,ground,0,12.5,300,2026-06-21T09:30:00Z");

  SmallResult seen;
  seen.diffuse_reflectance = 0.5;
  const auto reflecting = write_small_result(seen, "export_radiance");
  rules.quantity = "radiance";
  const auto radiances = lines_of(exported(reflecting, rules));
  EXPECT_EQ(radiances.front(),
            "index,object,facade,surface,side,area_m2,radiance_w_m2_sr1,time_utc");
  EXPECT_EQ(radiances.at(1),
            fmt::format("0,ground,,ground,0,12.5,{:.9g},2026-06-21T09:30:00Z", 150 / pi));

  rules.quantity = "series";
  rules.time = "";
  // The header's names with their line ends, then the intervals.
  const auto series = lines_of(exported(path, rules));
  double sum = 0, whole = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    sum += area[i] * loads[i];
    whole += area[i];
  }
  const auto last = series.back();
  EXPECT_EQ(last.find("2026-06-21T11:00:00Z,2026-06-21T12:00:00Z,2026-06-21T11:30:00Z,180,60,"),
            0u);
  EXPECT_NE(last.find(fmt::format(",{:.9g},", 200 * sum / whole)), std::string::npos)
      << last << " " << 200 * sum / whole;
}

// The file's are means of values that are not rounded.
TEST(Export, SeriesOfFacadesAreThoseOfTheFile) {
  SmallResult with;
  with.facade_share = 1.01;
  ExportRules rules;
  rules.format = "csv";
  rules.quantity = "series";
  rules.of = "facade";
  rules.parts.facades = {"house_1/south_1", "house_2/north_1"};
  // 3 and 1 kWh/m², two hundredfold in the last hour.
  const auto last = [&](const SmallResult& result, const std::string& name) {
    return lines_of(exported(write_small_result(result, name), rules)).back();
  };
  const auto own = last(with, "export_stored_facades"), means = last({}, "export_facades");
  const auto ends_with = [](const std::string& line, const std::string& end) {
    return line.size() > end.size() && line.compare(line.size() - end.size(), end.size(), end) == 0;
  };
  EXPECT_TRUE(ends_with(own, ",606,202")) << own;
  EXPECT_TRUE(ends_with(means, ",600,200")) << means;
  // Other groups are not in the file.
  rules.of = "object";
  rules.parts.facades.clear();
  rules.parts.objects = {"ground"};
  const auto ground = last(with, "export_stored_ground");
  EXPECT_TRUE(ends_with(ground, ",600")) << ground;
}

TEST(Export, SeriesOfPartsAreThoseThatAreStored) {
  SmallResult with;
  with.facade_share = 1.01;
  with.mirror_share = 0.25;
  const auto path = write_small_result(with, "export_mirrored");
  ExportRules rules;
  rules.format = "csv";
  rules.quantity = "irradiance_mirror";
  rules.of = "facade";
  rules.parts.facades = {"house_1/south_1"};
  const auto lines = lines_of(exported(path, rules));
  EXPECT_TRUE(lines.front().ends_with(",irradiance_mirror_w_m2 facade house_1/south_1"))
      << lines.front();
  EXPECT_TRUE(lines.back().ends_with(",150")) << lines.back();  // a quarter of 3 times 200
  const auto said = [&](const std::string& quantity) {
    rules.quantity = quantity;
    return test::refusal_of([&] { exported(path, rules); });
  };
  EXPECT_NE(said("irradiance_sky")
                .find("(none is stored); write series, or one of irradiance, "
                      "irradiance_mirror"),
            std::string::npos);
  EXPECT_NE(said("light_load").find("(totals have no intervals)"), std::string::npos);
  rules.of = "sensor";
  EXPECT_NE(said("series").find("--facade house_1/south_1 with --of sensor"), std::string::npos);
  rules.parts = {};
  EXPECT_NE(said("series").find("the study has no sensors); write the section sensors"),
            std::string::npos);
  rules.of = "facade";
  rules.time = "2026-06-21T09:30Z";
  EXPECT_NE(said("irradiance").find("has all intervals"), std::string::npos);
}

TEST(Export, TablesAreOfWhatIsNamed) {
  const auto path = write_small_result({}, "export_named");
  ExportRules rules;
  rules.format = "csv";
  rules.parts.facades = {"house_1/*"};
  const auto patches = exported(path, rules);
  EXPECT_EQ(std::count(patches.begin(), patches.end(), '\n'), 1 + 4 * 8);
  rules.of = "facade";
  const auto facades = exported(path, rules);
  EXPECT_EQ(facades.rfind("name,azimuth_deg,area_m2,light_load_kwh_m2,", 0), 0u) << facades;
  EXPECT_EQ(std::count(facades.begin(), facades.end(), '\n'), 1 + 4);
  rules.quantity = "series";
  const auto series = exported(path, rules);
  EXPECT_NE(series.find("facade house_1/north_1,"), std::string::npos) << series;
  EXPECT_EQ(series.find("whole"), std::string::npos) << series;
  EXPECT_EQ(series.find("house_2"), std::string::npos) << series;
  rules.of = "roof";
  EXPECT_NE(refusal(rules, "a.csv").find("--of roof (no such table)"), std::string::npos);
  rules.of = "facade";
  rules.quantity = "light_load";
  EXPECT_NE(refusal(rules, "a.csv")
                .find("no series light_load of groups of patches (totals have "
                      "no intervals)"),
            std::string::npos);
  rules = {};
  rules.format = "glb";
  rules.of = "facade";
  rules.parts.objects = {"house_1"};
  const auto both = refusal(rules, "a.glb");
  EXPECT_NE(both.find("use --to csv"), std::string::npos) << both;
  EXPECT_NE(both.find("it holds the whole scene"), std::string::npos) << both;
}

TEST(Export, CornersAreMeansWithinTheCreaseAngle) {
  const ResultReader result(write_small_result({}, "export_crease"));
  const ResultPatches patches(result);
  std::vector<double> values;
  for (std::size_t i = 0; i < patches.area.size(); ++i)
    values.push_back(static_cast<double>(i % 7));
  // By definition, over all pairs.
  for (const double crease_deg : {20.0, 100.0}) {
    const auto means = corner_values(patches, values, crease_deg);
    const double least = std::cos(crease_deg * std::acos(-1.0) / 180);
    for (std::size_t p = 0; p < means.size(); ++p)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto vertex = [&](std::size_t q, std::size_t j) {
          return patches.vertices[static_cast<std::size_t>(patches.corners[q][j])];
        };
        double sum = 0, area = 0;
        for (std::size_t q = 0; q < means.size(); ++q)
          for (std::size_t j = 0; j < 3; ++j)
            if (vertex(q, j) == vertex(p, k) && dot(patches.normal[p], patches.normal[q]) > least) {
              sum += patches.area[q] * values[q];
              area += patches.area[q];
            }
        EXPECT_NEAR(means[p][k], sum / area, 1e-12) << p << " " << crease_deg;
      }
  }
  // The crease parts: a wider angle joins walls and roof, and the corners differ.
  EXPECT_NE(corner_values(patches, values, 20), corner_values(patches, values, 100));
}

TEST(Export, WhatIsNotKnownIsLeftOutOfMeans) {
  const ResultReader result(write_small_result({}, "export_nan"));
  const ResultPatches patches(result);
  std::vector<double> values(patches.area.size(), 3);
  values[0] = std::nan("");
  const auto means = corner_values(patches, values, 20);
  EXPECT_EQ(means[1][0], 3) << "a corner that the unknown patch shares";
  std::fill(values.begin(), values.end(), std::nan(""));
  EXPECT_TRUE(std::isnan(corner_values(patches, values, 20)[0][0]));
  EXPECT_EQ(export_colour(Palette::false_colour, -1).red, back_colour.red);
  // Grey is a value there.
  EXPECT_NE(export_colour(Palette::grey, -1).red, export_colour(Palette::grey, -1).blue);
}

TEST(Export, ColoursFollowTheScale) {
  const ResultReader result(write_small_result({}, "export_colours"));
  const ResultPatches patches(result);
  ExportRules rules;
  rules.largest = 6;
  const auto colours = export_colours(result, rules, patches);
  // Ground of 3 kWh/m² is half of 6.
  EXPECT_EQ(colours.patch_step.at(0), std::lround(0.5 * (export_palette_steps - 1)));
  EXPECT_TRUE(colours.corner_step.empty());
  rules.largest = 1;
  EXPECT_EQ(export_colours(result, rules, patches).patch_step.at(0), export_palette_steps - 1);
  rules.interpolate = true;
  EXPECT_EQ(export_colours(result, rules, patches).corner_step.size(), patches.area.size());
}

TEST(Export, VrmlSaysWhereItsColoursBelong) {
  const auto path = write_small_result({}, "export_vrml_colours");
  ExportRules rules;
  rules.format = "vrml";
  const auto constant = exported(path, rules);
  EXPECT_EQ(count_of(constant, "colorPerVertex FALSE"), 1u);
  EXPECT_EQ(count_of(constant, "IndexedFaceSet"), 1u);
  rules.interpolate = true;
  const auto smooth = exported(path, rules);
  EXPECT_EQ(count_of(smooth, "colorPerVertex TRUE"), 1u);
  EXPECT_EQ(count_of(smooth, ", -1,"), 2 * count_of(constant, ", -1,"));
}

TEST(Export, XdmfPointsIntoTheResult) {
  const auto folder = std::filesystem::path(path_of("export & xdmf"));
  std::filesystem::create_directories(folder);
  ExportRules rules;
  rules.format = "xdmf";
  const auto path = write_small_result({}, "export_xdmf");
  export_result(ResultReader(path), rules, (folder / "a.xdmf").string());
  const auto text = bytes_of((folder / "a.xdmf").string());
  EXPECT_EQ(count_of(text, "<Time Value="), 3u);
  EXPECT_EQ(count_of(text, ">../export_xdmf.h5:/light_load<"), 3u);
  EXPECT_EQ(count_of(text, ">2 0 1 1 1 "), 1u);
  // From above, the folder's own name needs escaping.
  std::filesystem::copy_file(path, folder / "b.h5",
                             std::filesystem::copy_options::overwrite_existing);
  export_result(ResultReader((folder / "b.h5").string()), rules, path_of("above.xdmf"));
  EXPECT_GT(count_of(bytes_of(path_of("above.xdmf")), ">export &amp; xdmf/b.h5:/"), 0u);
}

TEST(Export, RefusesWhatItWouldNotHeed) {
  ExportRules rules;
  const auto with = [&](const char* format, auto change) {
    ExportRules changed;
    changed.format = format;
    change(changed);
    return refusal(changed, path_of("refused"));
  };
  const auto nothing = [](ExportRules&) {};
  EXPECT_NE(with("obj", nothing).find("one of: csv, vtk, xdmf, glb, vrml, ply"), std::string::npos);
  EXPECT_NE(with("vtk", [](auto& r) { r.palette = Palette::grey; }).find("no colours"),
            std::string::npos);
  EXPECT_NE(with("ply", [](auto& r) { r.interpolate = true; }).find("one value per patch"),
            std::string::npos);
  EXPECT_NE(with("glb", [](auto& r) { r.crease_angle_deg = 20; }).find("add --interpolate"),
            std::string::npos);
  EXPECT_NE(
      with("glb", [](auto& r) { r.interpolate = true, r.crease_angle_deg = 181; }).find("[0, 180]"),
      std::string::npos);
  EXPECT_NE(with("glb", [](auto& r) { r.quantity = "patch_object"; }).find("choose one of"),
            std::string::npos);
  EXPECT_NE(
      with("vtk", [](auto& r) { r.time = "2026-06-21T09:30Z"; }).find("--quantity irradiance"),
      std::string::npos);
  EXPECT_NE(with("xdmf", [](auto& r) { r.time = "2026-06-21T09:30Z"; }).find("all intervals"),
            std::string::npos);
  EXPECT_NE(with("csv",
                 [](auto& r) {
                   r.time = "2025-01-01T00:00Z";
                   r.quantity = "irradiance";
                 }),
            "");
  rules.format = "glb";
  EXPECT_NE(refusal(rules, "").find("add -o FILE.glb"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path_of("refused"))) << "nothing is left behind";
  EXPECT_THROW(export_result(ResultReader(write_small_result({}, "export_no_folder")), rules,
                             path_of("no_such_folder/a.glb")),
               MachineError);
}

}  // namespace
}  // namespace sunload
