// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "io/scene/raster/raster.h"
#include "tests/support/plan_file.h"
#include "tests/support/real_models.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

std::string grid(const std::string& rows) {
  return "ncols 3\nnrows 3\nxllcorner 1000\nyllcorner 2000\ncellsize 2\nnodata_value -9999\n" +
         rows;
}

double up(const PolygonModel& model, std::size_t p) {
  const Vec3 a = corner(model, p, 0, 0);
  return cross(corner(model, p, 0, 1) - a, corner(model, p, 0, 2) - a).z;
}

TEST(SceneRaster, VerticesAreMiddlesOfCells) {
  const auto model = read_text("t.asc", grid("1 2 3\n4 5 6\n7 8 9\n"));
  ASSERT_EQ(model.polygon_count(), 8u);
  ASSERT_EQ(model.vertices.size(), 9u);
  EXPECT_EQ(model.vertices[0], (Vec3{1001, 2005, 1}));  // the first row is the northern one
  EXPECT_EQ(model.vertices[8], (Vec3{1005, 2001, 9}));
  for (std::size_t p = 0; p < 8; ++p) EXPECT_EQ(up(model, p), 4) << p;  // twice the area
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"t"}));
  EXPECT_EQ(model.object_kinds, (std::vector<std::string>{"TINRelief"}));
  EXPECT_EQ(model.crs, "");
  EXPECT_TRUE(has_note(model, "names no CRS"));
  EXPECT_EQ(broken_arrays(model), "");
}

TEST(SceneRaster, DividesAlongTheDiagonalThatClimbsLess) {
  // A ridge from the north-west to the south-east, then one the other way.
  for (const auto* rows : {"9 0 0\n3 9 0\n0 3 9\n", "0 0 9\n0 9 3\n9 3 0\n"}) {
    const auto model = read_text("r.asc", grid(rows));
    std::size_t on_ridge = 0;
    for (std::size_t p = 0; p < model.polygon_count(); ++p) {
      double high = 0;
      for (int k = 0; k < 3; ++k) high += corner(model, p, 0, k).z == 9;
      on_ridge += high == 2;
    }
    EXPECT_EQ(on_ridge, 4u) << rows;  // two cells on it, two triangles each
  }
}

TEST(SceneRaster, CellsWithoutDataAreLeftOut) {
  const auto model = read_text("n.asc", grid("-9999 2 3\n4 5 6\n7 8 -9999\n"));
  EXPECT_EQ(model.polygon_count(), 2u * 1 + 2u * 2);
  EXPECT_EQ(model.vertices.size(), 7u);
  EXPECT_TRUE(has_note(model, "2 cells of the raster have no data"));
  for (std::size_t p = 0; p < model.polygon_count(); ++p) EXPECT_EQ(up(model, p), 4);
}

TEST(SceneRaster, RefusesWhatIsBroken) {
  EXPECT_NE(refusal("b.asc", grid("1 2 3\n4 -32768 6\n7 8 9\n")).find("row 2, column 2"),
            std::string::npos);
  EXPECT_NE(refusal("b.asc", "ncols 99999\nnrows 99999\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n"),
            "");
  EXPECT_NE(refusal("b.tif", std::string("II*\0\x08\0\0\0", 8)), "");
}

/// Appends integers of the lowest byte first.
void append(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
}

/// A TIFF of 32-bit floats whose tag 34264 (GeoTIFF 1.1: ModelTransformation) takes column and row
/// of cells' corners to x = x0 + a·column + b·row and y = y0 + d·column + e·row; `keys` (number,
/// value) of GeoTIFF beside the one that cells are areas, above 1025 in ascending order.
std::string tiff(std::uint32_t columns, std::uint32_t rows, const std::vector<float>& heights,
                 const std::array<double, 6>& x0_a_b_y0_d_e,
                 const std::vector<std::array<std::uint64_t, 2>>& more_keys = {}) {
  const auto& [x0, a, b, y0, d, e] = x0_a_b_y0_d_e;
  const std::array<double, 16> matrix{a, b, 0, x0, d, e, 0, y0, 0, 0, 0, 0, 0, 0, 0, 1};
  struct Field {
    std::uint64_t tag, type, count, value;
  };
  constexpr std::uint64_t is_short = 3, is_long = 4, is_double = 12;
  constexpr std::uint64_t directory = 8, field_count = 13;
  constexpr std::uint64_t keys_at = directory + 2 + 12 * field_count + 4;
  // Version 1.1.0, keys; 1025 (raster type), 1: cells are areas.
  std::vector<std::uint64_t> keys{1, 1, 0, 1 + more_keys.size(), 1025, 0, 1, 1};
  for (const auto& [key, value] : more_keys) keys.insert(keys.end(), {key, 0, 1, value});
  const std::uint64_t key_count = keys.size();
  const std::uint64_t matrix_at = keys_at + 2 * key_count, heights_at = matrix_at + 8 * 16;
  const std::array<Field, field_count> fields{{
      {256, is_long, 1, columns},
      {257, is_long, 1, rows},
      {258, is_short, 1, 32},         // bits of a sample
      {259, is_short, 1, 1},          // not compressed
      {262, is_short, 1, 1},          // 0 is black
      {273, is_long, 1, heights_at},  // one strip
      {277, is_short, 1, 1},          // samples per cell
      {278, is_long, 1, rows},        // rows of the strip
      {279, is_long, 1, 4 * heights.size()},
      {284, is_short, 1, 1},  // contiguous
      {339, is_short, 1, 3},  // IEEE floats
      {34264, is_double, 16, matrix_at},
      {34735, is_short, key_count, keys_at},
  }};
  std::string bytes("II*\0", 4);
  append(bytes, directory, 4);
  append(bytes, field_count, 2);
  for (const auto& field : fields) {
    append(bytes, field.tag, 2);
    append(bytes, field.type, 2);
    append(bytes, field.count, 4);
    append(bytes, field.value, 4);
  }
  append(bytes, 0, 4);
  for (const auto key : keys) append(bytes, key, 2);
  for (const double number : matrix) append(bytes, std::bit_cast<std::uint64_t>(number), 8);
  for (const float height : heights) append(bytes, std::bit_cast<std::uint32_t>(height), 4);
  return bytes;
}

/// Cells of 5 m, their columns along (3, 4) / 5: whole numbers in a turned raster.
TEST(SceneRaster, TurnedRastersLieWhereTheySay) {
  const std::vector<float> heights{1, 2, 3, 4, 5, 6};
  const std::array<double, 6> rows_to_the_right{1000, 3, 4, 2000, 4, -3};
  const auto model = read_text("turned.tif", tiff(3, 2, heights, rows_to_the_right));
  ASSERT_EQ(model.vertices.size(), 6u);
  for (std::size_t cell = 0; cell < 6; ++cell) {
    const double column = static_cast<double>(cell % 3) + 0.5;
    const double row = static_cast<double>(cell / 3) + 0.5;
    EXPECT_EQ(model.vertices[cell], (Vec3{1000 + 3 * column + 4 * row, 2000 + 4 * column - 3 * row,
                                          static_cast<double>(heights[cell])}))
        << cell;
  }
  ASSERT_EQ(model.polygon_count(), 4u);
  for (std::size_t p = 0; p < 4; ++p) EXPECT_EQ(up(model, p), 25) << p;  // twice the area
}

// As clouds' optimised GeoTIFFs have it, in place of a value that stands for none.
TEST(SceneRaster, CellsThatAMaskLeavesOutHaveNoData) {
  const std::string path =
      write_text("masked.tif", tiff(3, 3, {1, 2, 3, 4, 5, 6, 7, 8, 0}, {1000, 2, 0, 2006, 0, -2}));
  ASSERT_TRUE(write_mask(path, {255, 255, 255, 255, 255, 255, 255, 255, 0}));
  const auto model = read_scene_file(path, {});
  EXPECT_EQ(model.polygon_count(), 7u);  // of the last of four squares one half
  EXPECT_TRUE(has_note(model, "1 cells of the raster have no data"));
}

/// Mirrored: rows go to the left of the columns. Faces still look up.
TEST(SceneRaster, TurnedAndMirroredRastersLookUp) {
  const std::array<double, 6> rows_to_the_left{1000, 3, -4, 2000, 4, 3};
  const auto model = read_text("turned.tif", tiff(3, 2, {1, 2, 3, 4, 5, 6}, rows_to_the_left));
  ASSERT_EQ(model.polygon_count(), 4u);
  EXPECT_EQ(model.vertices[5], (Vec3{1000 + 3 * 2.5 - 4 * 1.5, 2000 + 4 * 2.5 + 3 * 1.5, 6}));
  for (std::size_t p = 0; p < 4; ++p) EXPECT_EQ(up(model, p), 25) << p;
}

TEST(SceneRaster, CellsWithoutAreaAreRefused) {
  const auto message =
      refusal("flat.tif", tiff(3, 2, {1, 2, 3, 4, 5, 6}, {1000, 3, 6, 2000, 4, 8}));
  EXPECT_NE(message.find("has cells without area"), std::string::npos) << message;
}

constexpr double foot = 0.3048, us_survey_foot = 1200.0 / 3937;
constexpr std::uint64_t projected = 3072, vertical = 4096, units_of_heights = 4099;
constexpr std::uint64_t utm_33 = 32633, long_island_in_feet = 2263;

/// The unit of heights in GeoTIFF: EPSG 9002 foot, 9003 US survey foot, or that of the vertical
/// CRS EPSG:6360 (NAVD88 in US survey feet). 9001: metre.
TEST(SceneRaster, HeightsInFeetOverMetresBecomeMetres) {
  struct File {
    std::vector<std::array<std::uint64_t, 2>> keys;
    double unit_m;
  };
  for (const auto& [keys, unit_m] :
       {File{{{projected, utm_33}, {units_of_heights, 9001}}, 1},
        {{{projected, utm_33}, {units_of_heights, 9002}}, foot},
        {{{projected, utm_33}, {units_of_heights, 9003}}, us_survey_foot},
        {{{projected, utm_33}, {vertical, 6360}}, us_survey_foot}}) {
    const auto model = read_text(
        "feet.tif", tiff(2, 2, {1000, 2000, 1000, 2000}, {1000, 5, 0, 2000, 0, -5}, keys));
    ASSERT_EQ(model.vertices.size(), 4u);
    EXPECT_EQ(model.vertices[1], (Vec3{1007.5, 1997.5, 2000 * unit_m}));
    EXPECT_EQ(has_note(model, "heights of the raster are in"), unit_m != 1);
    EXPECT_EQ(model.crs, "EPSG:32633");
  }
}

/// A vertical CRS beside a grid in text; what is told of the CRS is its plane.
TEST(SceneRaster, HeightsOfACompoundCrsInFeetBecomeMetres) {
  const std::string plane =
      R"(PROJCS["plane",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
      R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)"
      R"(PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],)"
      R"(PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)"
      R"(PARAMETER["false_northing",0],UNIT["metre",1]])";
  write_text("c.prj", R"(COMPD_CS["both",)" + plane +
                          R"(,VERT_CS["heights",VERT_DATUM["sea",2005],UNIT["foot",0.3048]]])");
  const auto model = read_text("c.asc", grid("1 2 3\n4 5 6\n7 8 1000\n"));
  EXPECT_EQ(model.vertices[8], (Vec3{1005, 2001, 1000 * foot}));
  EXPECT_TRUE(has_note(model, "heights of the raster are in foot of 0.3048 m"));
  EXPECT_EQ(model.crs.find("VERT"), std::string::npos) << model.crs;
}

/// `unit_m` is of coordinates and heights: 304.8 m over a plane in feet are 1000 of its units.
TEST(SceneRaster, UnitOfTheStudyHoldsForCoordinatesAndHeights) {
  const auto metres_over_feet =
      tiff(2, 2, {304.8F, 304.8F, 304.8F, 304.8F}, {1000, 5, 0, 2000, 0, -5},
           {{projected, long_island_in_feet}, {units_of_heights, 9001}});
  const auto scaled = read_text("plane.tif", metres_over_feet, {.unit_m = us_survey_foot});
  EXPECT_NEAR(scaled.vertices[0].z, 304.8, 304.8 * std::numeric_limits<float>::epsilon());
  EXPECT_NEAR(scaled.vertices[0].x, 1002.5 * us_survey_foot, 1e-9);
  EXPECT_TRUE(has_note(scaled, "converted to US survey foot, the unit of its coordinates"));
  // Where the study says that the plane is not in metres either, its word holds.
  const auto feet_over_metres = tiff(2, 2, {1000, 1000, 1000, 1000}, {1000, 5, 0, 2000, 0, -5},
                                     {{projected, utm_33}, {units_of_heights, 9002}});
  const auto by_study = read_text("study.tif", feet_over_metres, {.unit_m = us_survey_foot});
  EXPECT_EQ(by_study.vertices[0].z, 1000 * us_survey_foot);
  EXPECT_TRUE(has_note(by_study, "by scene.unit_m"));
}

/// The command of far hills has no study to say it.
TEST(SceneRaster, NotesNameWhatSaysTheUnit) {
  const auto path = write_text("hills.tif", tiff(2, 2, {1, 1, 1, 1}, {1000, 5, 0, 2000, 0, -5},
                                                 {{projected, long_island_in_feet}}));
  NoteCounter notes;
  read_raster(path, 1, RasterValues::elevations, notes, "--unit-m");
  ASSERT_EQ(notes.lines().size(), 1u);
  EXPECT_NE(notes.lines()[0].find("taken for metres: --unit-m says otherwise"), std::string::npos);
}

TEST(SceneRaster, GothenburgsModels) {
  SUNLOAD_NEEDS_MODEL("data/studies");
  const std::string folder = shared_path("data/studies/");
  const auto ga = read_scene_file(folder + "gothenburg_gustav_adolfs/DSM_GA.tif", {});
  // 116 × 104 cells of 2 m whose north-west corner is (319134, 6400206).
  EXPECT_EQ(ga.vertices.size(), 116u * 104);
  EXPECT_EQ(ga.polygon_count(), 2u * 115 * 103);
  EXPECT_EQ(ga.crs, "EPSG:3006");
  EXPECT_EQ(ga.vertices[0].x, 319135);
  EXPECT_EQ(ga.vertices[0].y, 6400205);
  const auto kr = read_scene_file(folder + "gothenburg_kronenhuset/DSM_KR.tif", {});
  EXPECT_EQ(kr.vertices.size(), 234u * 223);
  EXPECT_EQ(kr.crs, "EPSG:3007");
  const auto box = bounding_box(kr.vertices);
  EXPECT_EQ(box.low.x, 147720.5);
  EXPECT_EQ(box.high.y, 6398779.5);
  const auto canopy = read_scene_file(folder + "gothenburg_kronenhuset/CDSM_KR.asc", {});
  EXPECT_EQ(canopy.vertices.size(), 234u * 223);
}

}  // namespace
}  // namespace sunload
