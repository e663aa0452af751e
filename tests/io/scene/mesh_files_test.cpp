// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// PLY, OFF, STL and glTF: small files of every kind, and what must be refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

template <class Number>
std::string bytes_of(Number number, std::endian order) {
  std::string bytes(sizeof(number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(number));
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string header(const std::string& format, const std::string& number, int vertices, int faces) {
  return "ply\r\nformat " + format + " 1.0\r\ncomment a\r\nelement vertex " +
         std::to_string(vertices) + "\r\nproperty " + number +
         " x\r\nproperty uchar red\r\nproperty " + number + " y\r\nproperty " + number +
         " z\r\nelement face " + std::to_string(faces) +
         "\r\nproperty int quality\r\nproperty list uchar int vertex_indices\r\nelement edge 1\r\n"
         "property list ushort float weights\r\nend_header\r\n";
}

TEST(ScenePly, AllEncodingsGiveTheSameNumbers) {
  const std::vector<Vec3> points{{3512345.6789012345, 0.1, -7}, {1, 0, 0}, {0, 2, 0}, {9, 9, 9}};
  for (const auto order : {std::endian::little, std::endian::big}) {
    std::string body;
    for (const Vec3 p : points) {
      body += bytes_of(p.x, order) + '\x07' + bytes_of(p.y, order) + bytes_of(p.z, order);
    }
    body += bytes_of(5, order) + '\x03';
    for (const int v : {0, 1, 2}) body += bytes_of(v, order);
    body += bytes_of(std::uint16_t{2}, order) + bytes_of(1.0f, order) + bytes_of(2.0f, order);
    const std::string format =
        order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    const std::string file = header(format, "double", 4, 1) + body;
    const auto model = read_text("b.ply", file);
    ASSERT_EQ(model.polygon_count(), 1u);
    EXPECT_EQ(model.vertices[0], points[0]);
    EXPECT_EQ(model.vertices.size(), 3u);
    EXPECT_EQ(model.object_names, (std::vector<std::string>{"b"}));
    EXPECT_TRUE(has_note(model, "1 vertices used by no face"));
    EXPECT_TRUE(has_note(model, "4 colours per vertex ignored"));
    EXPECT_TRUE(has_note(model, "1 elements 'edge' left out"));
    EXPECT_EQ(broken_arrays(model), "");
    for (std::size_t cut = 1; cut < body.size(); cut += 7)
      EXPECT_NE(refusal("b.ply", file.substr(0, file.size() - cut)), "") << cut;
  }
  const auto ascii = read_text("a.ply", header("ascii", "double", 4, 1) +
                                            "3512345.6789012345 7 0.1 -7\n1 7 0 0\n0 7 2 0\n9 7 9 "
                                            "9\n5 3 0 1 2\n2 1 2\n");
  EXPECT_EQ(ascii.vertices[0], points[0]);
}

TEST(ScenePly, RefusesWhatIsBroken) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
      "float y\nproperty float z\nelement face 1\nproperty list uchar int "
      "vertex_index\nend_header\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(refusal("r.ply", head + points + "3 0 1 2\n"), "");
  EXPECT_EQ(refusal("r.ply", head + points + "3 0 1 3\n").substr(0, 6), "r.ply:");
  EXPECT_NE(refusal("r.ply", head + points + "3 0 1 -1\n").find("out of range"), std::string::npos);
  EXPECT_NE(refusal("r.ply", head + points + "3 0 1.5 2\n"), "");
  // Elements behind the faces are not to blame.
  const std::string edges = "element edge 1\nproperty int vertex1\nend_header\n";
  const std::string with_edges = head.substr(0, head.find("end_header")) + edges;
  EXPECT_EQ(refusal("r.ply", with_edges + points + "3 0 1 3\n0\n")
                .substr(0, std::string("r.ply:15:7: face 0: vertex index 3").size()),
            "r.ply:15:7: face 0: vertex index 3");
  EXPECT_NE(refusal("r.ply", head + points + "3 0 1.5e10 1\n").find("out of range"),
            std::string::npos);
  EXPECT_NE(refusal("r.ply", head + points + "-3 0 1 2\n").find("a list of -3"), std::string::npos);
  EXPECT_NE(refusal("r.ply", head + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n").find("vertex 0"),
            std::string::npos);
  EXPECT_NE(refusal("r.ply", head + points).find("ends within it"), std::string::npos);
  EXPECT_NE(refusal("r.ply",
                    "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float "
                    "x\nend_header\n")
                .find("too short"),
            std::string::npos);
  EXPECT_NE(refusal("r.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n")
                .find("no type"),
            std::string::npos);
  EXPECT_TRUE(has_note(read_text("r.ply", head + points + "2 0 1\n"), "1 faces of fewer than 3"));
}

TEST(SceneOff, HeadersCommentsAndColours) {
  const auto plain = read_text(
      "p.off", "# c\nOFF 3 1 0\n0 0 0\n1 0 0 # v\n\n0 1 3512345.678901\n3 0 1 2 255 0 0\n");
  ASSERT_EQ(plain.polygon_count(), 1u);
  EXPECT_EQ(plain.vertices[2].z, 3512345.678901);
  EXPECT_TRUE(has_note(plain, "1 colours per face ignored"));
  EXPECT_EQ(
      read_text("c.off", "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n")
          .polygon_count(),
      1u);
  EXPECT_NE(refusal("r.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find(":6:7: vertex"),
            std::string::npos);
  EXPECT_NE(refusal("r.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.9\n").find(":6:7: vertex"),
            std::string::npos);
  EXPECT_NE(refusal("r.off", "OFF\n3.5 1 0\n").find("'3.5' is no number of vertices"),
            std::string::npos);
  EXPECT_NE(refusal("r.off", "OFF\n3 1 0\n0 0 0\n1 0 x\n").find(":4:5:"), std::string::npos);
  EXPECT_NE(refusal("r.off", "OFF\n3 1 0\n0 0 0\n").find("too early"), std::string::npos);
  EXPECT_NE(refusal("r.off", "OFF\n999999999 1 0\n0 0 0\n").find("too short"), std::string::npos);
  EXPECT_NE(refusal("r.off", "4OFF\n1 0 0\n").find("dimensions"), std::string::npos);
  EXPECT_NE(refusal("r.off", "OFF BINARY\n").find("binary"), std::string::npos);
}

std::string stl_triangle(float z) {
  std::string bytes(12, '\0');
  for (const float value : {0.0f, 0.0f, z, 1.0f, 0.0f, z, -0.0f, 1.0f, z})
    bytes += bytes_of(value, std::endian::little);
  return bytes + std::string(2, '\0');
}

TEST(SceneStl, BinaryEvenWhereItBeginsWithSolid) {
  std::string file = "solid but binary";
  file.resize(80, ' ');
  file += bytes_of(std::uint32_t{2}, std::endian::little) + stl_triangle(0) + stl_triangle(0);
  const auto model = read_text("b.stl", file);
  EXPECT_EQ(model.polygon_count(), 2u);
  EXPECT_EQ(model.vertices.size(), 3u);  // equal points are one, and so are 0 and −0
  EXPECT_NE(refusal("b.stl", "x" + file.substr(1, file.size() - 3)).find("another length"),
            std::string::npos);
  std::string broken = file;
  broken.replace(96, 4, bytes_of(std::numeric_limits<float>::quiet_NaN(), std::endian::little));
  EXPECT_NE(refusal("b.stl", broken).find("triangle 0"), std::string::npos);
}

TEST(SceneStl, SolidsOfTextFilesAreObjects) {
  const auto facet = [](const std::string& x) {
    return "  FACET normal 0 0 1\n outer loop\n vertex " + x +
           " 0 0\n vertex 1 0 0\n vertex 0 1 "
           "0\n endloop\n endfacet\n";
  };
  const auto model =
      read_text("t.stl", "solid tower a\n" + facet("5812345.0123456789") +
                             "endsolid tower a\nsolid\n" + facet("0") + "endsolid\n");
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"tower a", "t"}));
  EXPECT_EQ(model.vertices[0].x, 5812345.0123456789);
  EXPECT_NE(refusal("t.stl", "solid a\n" + facet("nan") + "endsolid\n").find("t.stl:4:9: 'nan'"),
            std::string::npos);
  EXPECT_NE(refusal("t.stl", "solid a\n" + facet("0")).find("ends within a solid"),
            std::string::npos);
  EXPECT_NE(refusal("t.stl", "solid a\nhello\nendsolid").find("unknown statement"),
            std::string::npos);
}

TEST(SceneStl, WhiteSpaceOfTextIsFree) {
  const std::string facet =
      "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
  for (const std::string& text :
       {"solid\n" + facet + "endsolid\n", "solid\n" + facet + "\nendsolid",
        "solid " + facet + "endsolid", "\n  solid t\n" + facet + "\n  endsolid t\n",
        std::string(
            "solid\nfacet\nnormal\n0 0\n1\nouter\nloop\nvertex\n0 0\n0\nvertex 1\n0 0 vertex 0 1 "
            "0\nendloop endfacet\nendsolid")}) {
    const auto model = read_text("t.stl", text);
    EXPECT_EQ(model.polygon_count(), 1u) << text;
    EXPECT_EQ(model.vertices[1], (Vec3{1, 0, 0})) << text;
    EXPECT_EQ(model.object_names, (std::vector<std::string>{"t"})) << text;
  }
  const auto two = read_text("t.stl", "solid my solid " + facet + facet +
                                          "endsolid my solid solid b " + facet + "endsolid b");
  EXPECT_EQ(two.object_names, (std::vector<std::string>{"my solid", "b"}));
  EXPECT_EQ(two.polygon_count(), 3u);
  // Words behind those of a line had no meaning.
  EXPECT_EQ(read_text("t.stl",
                      "solid\nfacet normal nan nan nan of\nouter loop\nvertex 0 0 0 5\nvertex "
                      "1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n")
                .polygon_count(),
            1u);
  EXPECT_NE(refusal("t.stl", "solid a " + facet).find("ends within a solid"), std::string::npos);
  EXPECT_NE(refusal("t.stl", "solid\nfacet normal 0 0 1 outer loop vertex 0 0 endloop")
                .find("'endloop' is no finite number"),
            std::string::npos);
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = (bits << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[(bits >> shift) & 63];
  }
  return text;
}

/// A square of two triangles: 4 points, then 6 indices of 2 bytes.
std::string square() {
  std::string bytes;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
    bytes += bytes_of(value, std::endian::little);
  for (const auto index : {u'\0', u'\1', u'\2', u'\0', u'\2', u'\3'})
    bytes += bytes_of(index, std::endian::little);
  return bytes;
}

std::string gltf(const std::string& nodes, const std::string& primitive = "\"indices\": 1",
                 const std::string& count = "6") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" +
         nodes + R"(], "meshes": [{"name": "square", "primitives": [{"attributes": {"POSITION": 0},
         "material": 0, )" +
         primitive + R"(}]}],
         "materials": [{"name": "brick", "doubleSided": true,
           "pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.3, 0, 1]}}],
         "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
           {"bufferView": 1, "componentType": 5123, "count": )" +
         count + R"(, "type": "SCALAR"}],
         "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48,
           "byteLength": 12}],
         "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,)" +
         base64(square()) + "\"}]}";
}

TEST(SceneGltf, NodesMaterialsAndAxes) {
  const auto model = read_text(
      "g.gltf", gltf(R"({"name": "house", "translation": [10, 20, 30], "children": [1, 2]},
                        {"mesh": 0}, {"mesh": 0, "name": "shed", "scale": [-1, 2, 1]})"));
  ASSERT_EQ(model.polygon_count(), 4u);
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"house", "shed"}));
  EXPECT_EQ(corner(model, 0, 0, 0), (Vec3{10, -30, 20}));
  EXPECT_EQ(corner(model, 2, 0, 0), (Vec3{10, -30, 20}));
  EXPECT_EQ(bounding_box(model.vertices).low.x, 9);
  EXPECT_EQ(model.materials.at(0).name, "brick");
  EXPECT_NEAR(*model.materials[0].diffuse, 0.3, 1e-12);
  EXPECT_EQ(model.facts[0].sides, Sides::two);
  // Front towards +z of the file, −y of the scene; the mirrored one keeps it.
  for (std::size_t p = 0; p < 4; ++p) {
    const Vec3 a = corner(model, p, 0, 0);
    EXPECT_LT(cross(corner(model, p, 0, 1) - a, corner(model, p, 0, 2) - a).y, 0) << p;
  }
  EXPECT_EQ(broken_arrays(model), "");
}

TEST(SceneGltf, RotationsAreOfUnitLength) {
  const auto with = [](const std::string& quaternion) {
    return gltf(R"({"mesh": 0, "rotation": [)" + quaternion + "]}");
  };
  // A quarter about z, written with three digits: the corner (1, 1, 0) goes to (-1, 1, 0).
  const auto turned = read_text("q.gltf", with("0, 0, 0.707, 0.707"));
  const Vec3 corner_of = corner(turned, 0, 0, 2);
  EXPECT_NEAR(corner_of.x, -1, 1e-12);
  EXPECT_NEAR(corner_of.z, 1, 1e-12);
  // A third about the diagonal, in bytes: (1, 1, 0) goes to (0, 1, 1).
  const auto bytes = read_text("q.gltf", with("0.5039, 0.5039, 0.5039, 0.5039"));
  const Vec3 of_bytes = corner(bytes, 0, 0, 2);
  EXPECT_LT(norm(of_bytes - Vec3{0, -1, 1}), 1e-12) << of_bytes.x << " " << of_bytes.y;
  const auto said = refusal("q.gltf", with("0, 0, 1, 1"));
  EXPECT_NE(said.find("broken 'rotation' (a rotation is a quaternion of length 1"),
            std::string::npos)
      << said;
}

// EXT_mesh_gpu_instancing: a row of trees is one mesh and a place for each.
TEST(SceneGltf, InstancesStandWhereTheirNodeSays) {
  const auto with = [](const std::string& attributes, const std::string& accessor_type = "VEC4",
                       std::size_t count = 4) {
    std::string turns;  // none, none, half about z, none
    for (const int k : {0, 1, 2, 3})
      for (const float q : {0.f, 0.f, k == 2 ? 1.f : 0.f, k == 2 ? 0.f : 1.f})
        turns += bytes_of(q, std::endian::little);
    auto text = gltf(R"({"name": "row", "mesh": 0, "translation": [0, 0, 5], "extensions":
        {"EXT_mesh_gpu_instancing": {"attributes": {)" +
                     attributes + "}}}}");
    const auto insert = [&](const std::string& before, const std::string& what) {
      text.insert(text.find(before), what);
    };
    insert("],\n         \"bufferViews\"",
           R"(, {"bufferView": 2, "componentType": 5126, "type": ")" + accessor_type +
               R"(", "count": )" + std::to_string(count) + "}");
    insert("],\n         \"buffers\"", R"(, {"buffer": 1, "byteLength": 64})");
    text.insert(text.rfind(']'),
                R"(, {"byteLength": 64, "uri": "data:application/octet-stream;base64,)" +
                    base64(turns) + "\"}");
    return text;
  };
  const auto model = read_text("i.gltf", with(R"("TRANSLATION": 0, "ROTATION": 2)"));
  ASSERT_EQ(model.polygon_count(), 8u);
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"row", "row_2", "row_3", "row_4"}));
  // In the file: (1, 0, 5) + the far corner (1, 1, 0); turned, (1, 1, 5) - it. Scene: x, -z, y.
  EXPECT_EQ(corner(model, 2, 0, 2), (Vec3{2, -5, 1}));
  const Vec3 turned = corner(model, 4, 0, 2);
  EXPECT_NEAR(turned.x, 0, 1e-6);
  EXPECT_NEAR(turned.z, 0, 1e-6);
  const auto scaled = read_text("i.gltf", with(R"("SCALE": 0)"));
  EXPECT_EQ(corner(scaled, 4, 0, 2), (Vec3{1, -5, 1}));
  EXPECT_EQ(read_text("i.gltf", with("")).polygon_count(), 2u);
  EXPECT_NE(refusal("i.gltf", with(R"("TRANSLATION": 0, "ROTATION": 2)", "VEC4", 3))
                .find("instances of two numbers"),
            std::string::npos);
  EXPECT_NE(refusal("i.gltf", with(R"("ROTATION": 2)", "VEC3")).find("is no VEC4"),
            std::string::npos);
}

TEST(SceneGltf, TransparenciesAreTold) {
  const auto is_told = [](const std::string& alpha, const std::string& more) {
    auto text = gltf(R"({"mesh": 0})");
    const std::string opaque = "0.6, 0.3, 0, 1]}";
    text.replace(text.find(opaque), opaque.size(), "0.6, 0.3, 0, " + alpha + "]}" + more);
    return has_note(read_text("t.gltf", text), "1 transparencies of materials ignored");
  };
  EXPECT_TRUE(is_told("0.25", R"(, "alphaMode": "BLEND")"));
  EXPECT_TRUE(is_told("0.4", R"(, "alphaMode": "MASK")"));
  EXPECT_TRUE(is_told("0.6", R"(, "alphaMode": "MASK", "alphaCutoff": 0.7)"));
  const std::string transmission =
      R"(, "extensions": {"KHR_materials_transmission": {"transmissionFactor": )";
  EXPECT_TRUE(is_told("1", transmission + "0.9}}"));
  EXPECT_FALSE(is_told("1", transmission + "0}}"));
  EXPECT_FALSE(is_told("0.25", ""));  // opaque unless it says otherwise
  EXPECT_FALSE(is_told("1", R"(, "alphaMode": "BLEND")"));
  EXPECT_FALSE(is_told("0.6", R"(, "alphaMode": "MASK")"));
}

TEST(SceneGltf, StripsAndFansAndContainers) {
  const std::string node = R"({"mesh": 0})";
  EXPECT_EQ(read_text("s.gltf", gltf(node, "\"mode\": 5")).polygon_count(), 2u);
  EXPECT_EQ(read_text("s.gltf", gltf(node, "\"mode\": 6")).polygon_count(), 2u);
  EXPECT_EQ(read_text("s.gltf", gltf(node, "\"mode\": 1")).polygon_count(), 0u);
  EXPECT_EQ(read_text("s.gltf", gltf(node)).object_names.at(0), "square");
  std::string json = gltf(node);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t n) {
    return bytes_of(static_cast<std::uint32_t>(n), std::endian::little);
  };
  const std::string glb =
      "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json;
  EXPECT_EQ(read_text("s.glb", glb).polygon_count(), 2u);
  for (std::size_t cut = 1; cut < glb.size(); cut += 97)
    EXPECT_NE(refusal("s.glb", glb.substr(0, glb.size() - cut)), "") << cut;
}

TEST(SceneGltf, RefusesWhatIsBroken) {
  const std::string node = R"({"mesh": 0})";
  EXPECT_EQ(refusal("r.gltf", gltf(node)), "");
  EXPECT_NE(refusal("r.gltf", gltf(node, "\"indices\": 1", "7")).find("outside of its buffer view"),
            std::string::npos);
  EXPECT_NE(refusal("r.gltf", gltf(node, "\"indices\": 1", "99999999999999999")), "");
  EXPECT_NE(refusal("r.gltf", gltf(node, "\"indices\": 0")).find("no SCALAR"), std::string::npos);
  EXPECT_NE(refusal("r.gltf", gltf(R"({"mesh": 3})")).find("no entry 3 in 'meshes'"),
            std::string::npos);
  EXPECT_NE(refusal("r.gltf", gltf(R"({"children": [0]})")).find("nodes within nodes"),
            std::string::npos);
  EXPECT_NE(refusal("r.gltf", gltf(R"({"mesh": 0, "rotation": [1, 2]})")).find("broken 'rotation'"),
            std::string::npos);
  EXPECT_NE(refusal("r.gltf", R"({"asset": {"version": "1.0"}})").find("version 1.0"),
            std::string::npos);
  EXPECT_NE(refusal("r.gltf", R"({"asset": {"version": "2.0"}, "extensionsRequired":
                                ["KHR_draco_mesh_compression"]})")
                .find("draco"),
            std::string::npos);
  EXPECT_NE(refusal("r.gltf", R"({"asset": 3, "scenes": 7})"), "");
}

TEST(SceneGltf, DamagedTextNeverCrashes) {
  const std::string good = gltf(R"({"name": "a", "mesh": 0, "children": [1]}, {"mesh": 0})");
  std::size_t read = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const char byte : {'9', '-', '[', '"', 'n'}) {
      std::string bad = good;
      bad[at] = byte;
      read += refusal("d.gltf", bad).empty();
    }
  }
  EXPECT_GT(read, 0u);
}

// Half a metre is what single precision leaves of a northing.
TEST(ScenePly, SinglePrecisionFarFromTheOriginIsTold) {
  const auto notes_of = [](const std::string& type, const char* y) {
    const std::string end = std::string(" ") + y + " 0\n";
    std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n";
    for (const char* axis : {"x", "y", "z"}) text += "property " + type + " " + axis + "\n";
    text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n691000.5" + end +
            "691010.25" + end + "691000.5 9 0\n3 0 1 2\n";
    const auto model = read_text("far.ply", text);
    std::string notes;
    for (const auto& line : model.notes) notes += line;
    for (const auto& line : model.warnings) notes += "warning " + line;
    return notes;
  };
  const std::string far = notes_of("float", "5335000.5");
  EXPECT_NE(far.find("warning "), std::string::npos);
  EXPECT_NE(far.find("in single precision: places are rounded to 0.5 m"), std::string::npos);
  EXPECT_EQ(notes_of("float", "9.5").find("warning"), std::string::npos);
  EXPECT_NE(notes_of("float", "9.5").find("rounded to 0.062 m"), std::string::npos);
  EXPECT_EQ(notes_of("double", "5335000.5").find("single"), std::string::npos);
}

}  // namespace
}  // namespace sunload
