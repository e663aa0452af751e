#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/reference.h"
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

TEST(SceneRaster, GothenburgsModels) {
  if (shared_missing("data/studies")) return;
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
