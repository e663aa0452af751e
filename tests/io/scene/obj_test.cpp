// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;
using testing::TempDir;

TEST(SceneObj, KeepsEveryDigitOfNationalGrids) {
  const auto model = read_text("far.obj",
                               "v 3512345.6789012345 5812345.0123456789 123.4567890123\n"
                               "v +3512346.1 5812345 1e2\nv 3512346 5812346 -.5\nf 1 2 3\n");
  ASSERT_EQ(model.polygon_count(), 1u);
  EXPECT_EQ(model.vertices[0], (Vec3{3512345.6789012345, 5812345.0123456789, 123.4567890123}));
  EXPECT_EQ(model.vertices[1], (Vec3{3512346.1, 5812345, 100}));
  EXPECT_EQ(model.vertices[2], (Vec3{3512346, 5812346, -0.5}));
  EXPECT_EQ(broken_arrays(model), "");
  EXPECT_FALSE(model.is_city_format);
}

TEST(SceneObj, AxisAndUnit) {
  const std::string text = "v 1 2 3\nv 2 2 3\nv 1 5 3\nf 1 2 3\n";
  EXPECT_EQ(read_text("a.obj", text, {'y', 1, "highest"}).vertices[0], (Vec3{1, -3, 2}));
  EXPECT_EQ(read_text("a.obj", text, {'x', 1, "highest"}).vertices[0], (Vec3{2, 3, 1}));
  EXPECT_EQ(read_text("a.obj", text, {'z', 0.5, "highest"}).vertices[0], (Vec3{0.5, 1, 1.5}));
  EXPECT_NE(refusal("a.obj", text, {'w', 1, "highest"}), "");
  EXPECT_NE(refusal("a.obj", text, {0, 0, "highest"}), "");
  EXPECT_NE(refusal("a.obj", text, {0, std::nan(""), "highest"}), "");
}

TEST(SceneObj, ObjectsByNameNotByPlace) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  auto model = read_text("house.obj", vertices +
                                          "f 1 2 3\ng roof\nf 1 2 3\no tower a \ng ignored\n"
                                          "f 1 2 3\no second\nf 1 2 3\no tower a\nf 1 2 3\n");
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"house", "roof", "tower a", "second"}));
  EXPECT_EQ(model.object_kinds.size(), 4u);
  EXPECT_EQ(model.facts[4].object, model.facts[2].object);
}

TEST(SceneObj, PolygonsOfAnySizeAndAllKindsOfIndices) {
  std::string text;
  std::string face = "f";
  constexpr int corners = 300;  // more than a byte can count
  for (int i = 0; i < corners; ++i) {
    text += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
    face += " " + std::to_string(i + 1) + "/1/1";
  }
  const auto model = read_text("n.obj", text + face + "\nf -1//2 -2/7 -300\n");
  ASSERT_EQ(model.polygon_count(), 2u);
  EXPECT_EQ(ring_size(model, 0, 0), corners);
  EXPECT_EQ(corner(model, 1, 0, 0), (Vec3{299, 299 * 299, 0}));
  EXPECT_EQ(corner(model, 1, 0, 2), (Vec3{0, 0, 0}));
}

TEST(SceneObj, LineEndingsCommentsContinuations) {
  const auto model = read_text("crlf.obj",
                               "# head\r\n\r\n  v 0 0 0 # origin\r\nv 1 0\\\r\n 0\r\nv\t0 1 0\r\n"
                               "v 9 9 9\r\nf 1 \\\r\n2 3 # face\r\nl 1 2\r\np 1\r\nfrobnicate 7\r\n"
                               "f 3 2 1");
  EXPECT_EQ(model.polygon_count(), 2u);
  EXPECT_EQ(model.vertices.size(), 3u);
  EXPECT_TRUE(has_note(model, "1 vertices used by no face"));
  EXPECT_TRUE(has_note(model, "2 statements of lines"));
  EXPECT_TRUE(has_note(model, "1 statements of unknown kind"));
}

TEST(SceneObj, MaterialsAreWhatTheLibraryStates) {
  write_text("m.mtl",
             "newmtl brick\nKd 0.3 0.2 0.1\nKs 1 1 1\nillum 2\r\nnewmtl glass\nKd 0\nKs 0.8 0.9 "
             "1\nillum 3\nnewmtl open\nmap_Kd a.png\nnewmtl loud\nKd 2 2 2\nnewmtl unused\n");
  const auto model =
      read_text("m.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl brick\nf 1 2 3\nusemtl glass\nf 1 2 "
                "3\nusemtl open\nusemtl loud\nusemtl nowhere\nf 1 2 3\nmtllib m.mtl lost.mtl\n");
  ASSERT_EQ(model.materials.size(), 5u);
  EXPECT_FALSE(model.facts[0].material.exists());
  EXPECT_EQ(model.facts[1].material.index(), 0u);
  EXPECT_EQ(model.materials[0].name, "brick");
  EXPECT_DOUBLE_EQ(*model.materials[0].diffuse, 0.2);
  EXPECT_FALSE(model.materials[0].mirror.has_value());
  EXPECT_EQ(*model.materials[1].diffuse, 0);
  EXPECT_DOUBLE_EQ(*model.materials[1].mirror, 0.9);
  EXPECT_FALSE(model.materials[2].diffuse.has_value());
  EXPECT_FALSE(model.materials[3].diffuse.has_value());
  EXPECT_EQ(model.materials[4].name, "nowhere");
  EXPECT_TRUE(has_note(model, "1 materials whose Ks is a highlight"));
  EXPECT_TRUE(has_note(model, "1 colours outside"));
  EXPECT_TRUE(has_note(model, "'m.mtl lost.mtl' is not there"));
  EXPECT_TRUE(has_note(model, "1 materials without a definition"));
}

TEST(SceneObj, TransparenciesAreTold) {
  write_text("t.mtl",
             "newmtl pane\nd 0.3\nnewmtl halo\nd -halo 0.5\nnewmtl veil\nTr 0.2\nnewmtl wall\nd "
             "1.0\nTr 1.0\nnewmtl open\nTr 0\nd nothing\nnewmtl unused\nd 0\n");
  std::string text = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const std::string name : {"pane", "halo", "veil", "wall", "open", "pane"})
    text += "usemtl " + name + "\nf 1 2 3\n";
  EXPECT_TRUE(has_note(read_text("t.obj", text + "usemtl unused\n"),
                       "3 transparencies of materials ignored"));
  EXPECT_FALSE(has_note(read_text("t.obj", text.substr(0, text.find("usemtl")) +
                                               "usemtl wall\nf 1 2 3\nusemtl open\nf 1 2 3\n"),
                        "transparencies"));
}

TEST(SceneObj, RefusesWhatIsBrokenAndNamesThePlace) {
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(refusal("b.obj", head + "f 1 2 4\n").substr(0, 12), "b.obj:4:7: v");
  EXPECT_EQ(refusal("b.obj", head + "f 1 2 -4\n").substr(0, 11), "b.obj:4:7: ");
  EXPECT_EQ(refusal("b.obj", head + "f 1 2 0\n").substr(0, 11), "b.obj:4:7: ");
  EXPECT_EQ(refusal("b.obj", head + "f 1 2 99999999999\n").substr(0, 11), "b.obj:4:7: ");
  EXPECT_EQ(refusal("b.obj", head + "f 1 x 3\n").substr(0, 11), "b.obj:4:5: ");
  EXPECT_EQ(refusal("b.obj", head + "f 1 /2 3\n").substr(0, 11), "b.obj:4:5: ");
  EXPECT_EQ(refusal("b.obj", head + "f 1 2").substr(0, 11), "b.obj:4:6: ");
  EXPECT_EQ(refusal("b.obj", head + "v 1 nan 2\n").substr(0, 11), "b.obj:4:5: ");
  EXPECT_EQ(refusal("b.obj", head + "v 1 inf 2\n").substr(0, 11), "b.obj:4:5: ");
  EXPECT_EQ(refusal("b.obj", head + "v 1 1e999 2\n").substr(0, 11), "b.obj:4:5: ");
  EXPECT_EQ(refusal("b.obj", head + "v 1 1,5 2\n").substr(0, 11), "b.obj:4:5: ");
  EXPECT_EQ(refusal("b.obj", head + "v 1 2\n").substr(0, 10), "b.obj:4:6:");
  EXPECT_EQ(refusal("b.obj", head + "v 1 2 1e12\n").substr(0, 8), "b.obj:4:");
  EXPECT_NE(refusal("b.obj", std::string("v 0 0 0\0", 8)), "");
  EXPECT_NE(refusal("b.obj", "hello world\n"), "");
  EXPECT_NE(refusal("b.obj", ""), "");
}

TEST(SceneObj, TinyNumbersAreZeroNotAnError) {
  EXPECT_EQ(read_text("t.obj", "v 1e-999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").vertices[0],
            (Vec3{0, 0, 0}));
}

TEST(SceneObj, BrokenMaterialNamesThePlace) {
  write_text("bad.mtl", "newmtl a\nKd 0.1 oops 0.2\n");
  EXPECT_NE(refusal("bad.obj", "mtllib bad.mtl\n").find("bad.mtl:2:8: "), std::string::npos);
}

TEST(SceneFile, FormatsByContentThenByName) {
  EXPECT_NE(refusal("a.obj", "#VRML V2.0 utf8\n}").find("closes nothing"), std::string::npos);
  EXPECT_NE(refusal("a.dat", "\x1F\x8B\x08").find("gzip"), std::string::npos);
  EXPECT_NE(refusal("a.dat", "ply\nformat ascii 1.0\n").find("PLY"), std::string::npos);
  EXPECT_NE(refusal("a.STL", "binary").find("STL"), std::string::npos);
  EXPECT_NE(refusal("a.off", "# OFF later\n").find("too early"), std::string::npos);
  EXPECT_NE(refusal("a.gltf", "{\"asset\":{}}").find("glTF"), std::string::npos);
  EXPECT_NE(refusal("a.dat", "glTF").find("header states"), std::string::npos);
  EXPECT_NE(refusal("a.dat", std::string("II*\0", 4)).find("raster"), std::string::npos);
  EXPECT_NE(refusal("a.asc", "ncols 3\n").find("raster"), std::string::npos);
  EXPECT_NE(refusal("a.txt", "hello").find("no known scene format"), std::string::npos);
  EXPECT_NE(refusal("a.obj", "{}").find("CityJSON"), std::string::npos);
  EXPECT_THROW(read_scene_file("/no/such/file.obj", {}), InputError);
  EXPECT_THROW(read_scene_file(TempDir(), {}), InputError);
}

// Editors put it before a text, and the first statement is lost with it.
TEST(SceneObj, AByteOrderMarkIsNoPartOfTheText) {
  const std::string mark = "\xEF\xBB\xBF";
  write_text("marked.mtl", mark + "newmtl red\nKd 0.6 0.6 0.6\n");
  const auto model = read_text("marked.obj", mark +
                                                 "mtllib marked.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                                 "usemtl red\nf 1 2 3\n");
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_TRUE(model.materials[0].diffuse.has_value());
}

}  // namespace
}  // namespace sunload
