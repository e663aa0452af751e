// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "io/scene/vrml/shapes.h"
#include "tests/support/refusal_of.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

const std::string vrml97 = "#VRML V2.0 utf8\n";
const std::string triangle =
    "geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } "
    "coordIndex [0 1 2 -1] ";

/// Twice the area vector of a polygon's outer ring.
Vec3 area_vector2(const PolygonModel& model, std::size_t p) {
  Vec3 sum;
  const auto n = ring_size(model, p, 0);
  for (std::int64_t k = 1; k + 1 < n; ++k)
    sum += cross(corner(model, p, 0, k) - corner(model, p, 0, 0),
                 corner(model, p, 0, k + 1) - corner(model, p, 0, 0));
  return sum;
}

/// Volume within all polygons, positive where their fronts look out.
double volume(const PolygonModel& model) {
  double six = 0;
  for (std::size_t p = 0; p < model.polygon_count(); ++p)
    six += dot(corner(model, p, 0, 0), area_vector2(model, p));
  return six / 6;
}

std::string gzip(const std::string& text) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(6), &libdeflate_free_compressor);
  std::string packed(libdeflate_gzip_compress_bound(compressor.get(), text.size()), '\0');
  packed.resize(libdeflate_gzip_compress(compressor.get(), text.data(), text.size(), packed.data(),
                                         packed.size()));
  return packed;
}

TEST(SceneVrml, TurnsYUpAndKeepsPolygons) {
  const auto model = read_text(
      "a.wrl", vrml97 +
                   "DEF house Transform { translation 10 20 30 children Shape { geometry "
                   "IndexedFaceSet { coord Coordinate { point [0 0 0, 4 0 0, 4 3 0, 0 3 0] } "
                   "coordIndex [0 1 2 3] } } }");
  ASSERT_EQ(model.polygon_count(), 1u);
  EXPECT_EQ(ring_size(model, 0, 0), 4);
  EXPECT_EQ(corner(model, 0, 0, 0), (Vec3{10, -30, 20}));
  EXPECT_EQ(corner(model, 0, 0, 2), (Vec3{14, -30, 23}));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"house"}));
  EXPECT_FALSE(model.facts[0].material.exists());
  EXPECT_EQ(broken_arrays(model), "");
}

TEST(SceneVrml, TransformsNestInTheOrderOfTheStandard) {
  const std::string inner = "Shape { " + triangle + "} }";
  // Corner (1, 0, 0): scaled to (2, 0, 0), turned a quarter about y to (0, 0, -2), moved.
  const auto model = read_text("a.wrl",
                               vrml97 +
                                   "Transform { scale 2 1 1 rotation 0 1 0 1.5707963 "
                                   "translation 5 0 0 children " +
                                   inner + " }",
                               {'z', 1, "highest"});
  const Vec3 moved = corner(model, 0, 0, 1);
  EXPECT_NEAR(moved.x, 5, 1e-6);
  EXPECT_NEAR(moved.z, -2, 1e-6);
  // The centre stays where it is.
  const auto centred =
      read_text("b.wrl", vrml97 + "Transform { center 1 0 0 scale 3 3 3 children " + inner + " }",
                {'z', 1, "highest"});
  EXPECT_NEAR(corner(centred, 0, 0, 1).x, 1, 1e-12);
  EXPECT_NEAR(corner(centred, 0, 0, 0).x, -2, 1e-12);
}

TEST(SceneVrml, FrontAndSides) {
  const auto front = [](const std::string& fields, const std::string& scale = "1 1 1") {
    const auto model = read_text(
        "a.wrl",
        vrml97 + "Transform { scale " + scale + " children Shape { " + triangle + fields + " } } }",
        {'z', 1, "highest"});
    return std::pair(area_vector2(model, 0).z > 0, model.facts[0].sides);
  };
  EXPECT_EQ(front(""), std::pair(true, Sides::one));
  EXPECT_EQ(front("ccw FALSE"), std::pair(false, Sides::one));
  EXPECT_EQ(front("solid FALSE"), std::pair(true, Sides::two));
  // The mirrored triangle is seen from where the original one was.
  EXPECT_EQ(front("", "-1 1 1").first, true);
}

TEST(SceneVrml, ShapesAreClosedAndFaceOutward) {
  const auto shape = [](const std::string& node) {
    return read_text("s.wrl", vrml97 + "Shape { geometry " + node + " }");
  };
  EXPECT_NEAR(volume(shape("Box { size 2 3 4 }")), 24, 1e-12);
  // A regular prism and pyramid over the n-gon of the corners.
  const double n = turn_segments;
  const double gon = n / 2 * std::sin(2 * std::numbers::pi / n);
  EXPECT_NEAR(volume(shape("Cylinder { radius 1 height 2 }")), 2 * gon, 1e-12);
  EXPECT_NEAR(volume(shape("Cone { bottomRadius 1 height 3 }")), gon, 1e-12);
  const double ball = volume(shape("Sphere { radius 1 }"));
  EXPECT_LT(ball, 4 * std::numbers::pi / 3);
  EXPECT_GT(ball, 4 * std::numbers::pi / 3 * 0.98);  // corners on the sphere, 32 × 16
  EXPECT_EQ(shape("Cylinder { side FALSE }").polygon_count(), 2u);
  EXPECT_EQ(shape("Cone { bottom FALSE }").polygon_count(), 32u);
  const auto prism = shape(
      "Extrusion { crossSection [1 1, 1 -1, -1 -1, -1 1, 1 1] "
      "spine [0 0 0, 0 5 0] }");
  EXPECT_NEAR(std::abs(volume(prism)), 20, 1e-4);
  const auto text = shape("Text { string \"x\" }");
  EXPECT_EQ(text.polygon_count(), 0u);
  EXPECT_TRUE(has_note(text, "Text shapes left out"));
}

TEST(SceneVrml, ElevationGridLooksUp) {
  const std::string grid =
      "Shape { geometry ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 zSpacing 3 "
      "height [0 0 0, 1 1 1] ";
  const auto model = read_text("g.wrl", vrml97 + grid + "} }");
  ASSERT_EQ(model.polygon_count(), 4u);
  for (std::size_t p = 0; p < 4; ++p) EXPECT_GT(area_vector2(model, p).z, 0);
  EXPECT_NE(refusal("g.wrl", vrml97 + "Shape { geometry ElevationGrid { xDimension 3 zDimension 2 "
                                      "height [0 0 0] } }")
                .find("3 × 2 points, 3 heights"),
            std::string::npos);
}

TEST(SceneVrml, TransparenciesAreTold) {
  const auto shape = [](const std::string& material) {
    return "Shape { appearance Appearance { material " + material + " } " + triangle + "} }\n";
  };
  const auto model = read_text("t.wrl", vrml97 + shape("DEF pane Material { transparency 0.5 }") +
                                            shape("USE pane") + shape("Material { }"));
  EXPECT_TRUE(has_note(model, "1 transparencies of materials ignored"));
}

TEST(SceneVrml, MaterialsByNode) {
  const std::string text =
      vrml97 +
      "Shape { appearance Appearance { material DEF brick Material { diffuseColor 0.6 0.3 "
      "0 specularColor 0.1 0.1 0.1 } } " +
      triangle + "} }\nShape { appearance Appearance { material USE brick } " + triangle +
      "} }\nShape { appearance Appearance { material Material { diffuseColor 0 0 0 emissiveColor 1 "
      "0.5 0 } } " +
      triangle + "} }\n";
  const auto model = read_text("m.wrl", text);
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[0].name, "brick");
  EXPECT_NEAR(*model.materials[0].diffuse, 0.3, 1e-7);
  EXPECT_NEAR(*model.materials[0].mirror, 0.1, 1e-7);
  EXPECT_EQ(model.facts[0].material, model.facts[1].material);
  EXPECT_NEAR(model.materials[1].emitted_power_w, 0.5, 1e-7);

  SceneFileRules rules;
  rules.vrml_colour = VrmlColour::norm;
  rules.emission_scale_w = 100;
  const auto scaled = read_text("m.wrl", text, rules);
  EXPECT_NEAR(*scaled.materials[0].diffuse, std::sqrt(0.45), 1e-7);
  EXPECT_NEAR(scaled.materials[1].emitted_power_w, 100 * std::sqrt(1.25), 1e-5);
}

TEST(SceneVrml, ObjectsByDef) {
  const auto model = read_text(
      "street.wrl",
      vrml97 + "DEF a Transform { children [ DEF wall Shape { " + triangle + "} } Shape { " +
          triangle + "} } ] }\nTransform { children USE a }\nShape { " + triangle +
          "} }\nShape { geometry DEF lone IndexedFaceSet { coord Coordinate { point [0 "
          "0 0, 1 0 0, 0 1 0] } coordIndex [0 1 2] } }");
  EXPECT_EQ(model.object_names,
            (std::vector<std::string>{"a/wall", "a", "a/wall_2", "a_2", "street", "lone"}));
}

TEST(SceneVrml, SwitchLodAndProto) {
  const auto model = read_text(
      "p.wrl", vrml97 +
                   "PROTO Hut [ field SFVec3f size 1 1 1 field SFVec3f at 0 0 0 "
                   "eventIn SFVec3f grow ] { Transform { translation IS at scale IS grow "
                   "children Shape { geometry Box { size IS size } } } }\n"
                   "Hut { size 2 2 2 at 5 0 0 }\nHut { }\n"
                   "Switch { whichChoice 1 choice [ Shape { geometry Sphere {} } Shape { "
                   "geometry Box { } } ] }\nSwitch { choice [ Shape { geometry Box {} } ] }\n"
                   "LOD { range [1] level [ Shape { geometry Box {} } Shape { geometry Sphere "
                   "{} } ] }\n");
  EXPECT_EQ(model.polygon_count(), 4u * 6);
  EXPECT_NEAR(bounding_box(model.vertices).high.x, 6, 1e-12);
}

TEST(SceneVrml, GzipByContentInlineAndExternProto) {
  write_text("part.wrl", gzip(vrml97 + "DEF box Shape { geometry Box { } }"));
  write_text("protos.wrl", vrml97 +
                               "PROTO A [ field SFFloat r 1 ] { Shape { geometry Sphere { "
                               "radius IS r } } }\nPROTO B [ ] { Shape { geometry Box { } } }");
  const auto model = read_text(
      "whole.wrl", vrml97 +
                       "Inline { url [\"lost.wrl\" \"part.wrl\"] }\nTransform { translation 3 0 "
                       "0 children Inline { url \"part.wrl\" } }\nInline { url \"gone.wrl\" }\n"
                       "EXTERNPROTO A [ field SFFloat r ] \"protos.wrl#A\"\nA { r 2 }\n");
  EXPECT_EQ(model.polygon_count(), 6u + 6 + 512);
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"box", "box_2", "whole"}));
  EXPECT_TRUE(has_note(model, "'gone.wrl' is not there"));
  EXPECT_NEAR(bounding_box(model.vertices).high.z, 2, 1e-12);
}

/// ISO/IEC 14772-1, 4.8.3: a url without a name means the first PROTO of its file.
TEST(SceneVrml, AnExternProtoWithoutNameIsTheFirstOfItsFile) {
  write_text("protos.wrl", vrml97 +
                               "PROTO Ball [ ] { Shape { geometry Sphere { } } }\n"
                               "PROTO Box2 [ ] { Shape { geometry Box { } } }");
  const auto model = read_text("whole.wrl", vrml97 + "EXTERNPROTO A [ ] \"protos.wrl\"\nA { }\n");
  EXPECT_EQ(model.polygon_count(), 512u);
}

/// Who is to change a colour must find it: where a PROTO comes from, not where it is used.
TEST(SceneVrml, WhatAnExternProtoBringsIsOfItsFile) {
  const std::string appearance =
      "appearance Appearance { material DEF pink Material { diffuseColor 1 0.9 0.9 } }";
  write_text("parts.wrl", vrml97 + "Shape { geometry Box { } }");
  write_text("protos.wrl",
             vrml97 + "PROTO Ball [ ] { Shape { " + appearance + " geometry Sphere { } } }\n" +
                 "PROTO Coat [ ] { A" + appearance.substr(appearance.find("Appearance {") + 1) +
                 " }\nPROTO Part [ field MFString url [ ] ] { Inline { url IS url } }");
  const auto source = [](const std::string& text) {
    const auto model = read_text("whole.wrl", vrml97 + text);
    EXPECT_EQ(model.materials.size(), 1u) << text;
    return std::filesystem::path(model.materials.front().source).filename().string();
  };
  const std::string own = "Shape { " + appearance + " geometry Box { } }\n";
  EXPECT_EQ(source(own), "whole.wrl");
  EXPECT_EQ(source("EXTERNPROTO Ball [ ] \"protos.wrl#Ball\"\nBall { }\n"), "protos.wrl");
  EXPECT_EQ(source("EXTERNPROTO Coat [ ] \"protos.wrl#Coat\"\n"
                   "Shape { appearance Coat { } geometry Box { } }\n"),
            "protos.wrl");
  const auto both = read_text("whole.wrl", vrml97 +
                                               "EXTERNPROTO Ball [ ] \"protos.wrl#Ball\"\n"
                                               "Ball { }\n" +
                                               own);
  ASSERT_EQ(both.materials.size(), 2u);
  EXPECT_NE(both.materials[0].source, both.materials[1].source);
  EXPECT_EQ(read_text("whole.wrl", vrml97 + "EXTERNPROTO Part [ field MFString url ] "
                                            "\"protos.wrl#Part\"\nPart { url \"parts.wrl\" }\n")
                .polygon_count(),
            6u);
}

TEST(SceneVrml, WhatIsWrongWithAnIncludedFileNamesWhoWantsIt) {
  write_text("broken.wrl", vrml97 + "Shape { geometry Box {");
  write_text("middle.wrl", vrml97 + "Inline { url \"broken.wrl\" }");
  const auto said_of = [](const std::string& text) {
    return test::refusal_of([&] { read_text("outer.wrl", vrml97 + text); });
  };
  const auto included = said_of("Inline { url \"middle.wrl\" }");
  EXPECT_NE(included.find("broken.wrl:2:"), std::string::npos) << included;
  EXPECT_NE(included.find("Inline of"), std::string::npos) << included;
  EXPECT_NE(included.find("middle.wrl"), std::string::npos) << included;
  const auto proto = said_of("EXTERNPROTO A [ ] \"broken.wrl#A\"\nA { }");
  EXPECT_NE(proto.find("broken.wrl:2:"), std::string::npos) << proto;
  EXPECT_NE(proto.find("EXTERNPROTO of"), std::string::npos) << proto;
  EXPECT_NE(proto.find("outer.wrl"), std::string::npos) << proto;
}

TEST(SceneVrml, CirclesOfFilesAreRefused) {
  write_text("b.wrl", vrml97 + "Inline { url \"a.wrl\" }");
  EXPECT_NE(refusal("a.wrl", vrml97 + "Inline { url \"b.wrl\" }").find("leads back to it"),
            std::string::npos);
  EXPECT_NE(
      refusal("c.wrl", vrml97 + "EXTERNPROTO A [ ] \"c.wrl#A\"\nA { }").find("contains itself"),
      std::string::npos);
}

TEST(SceneVrml, Vrml1) {
  const auto model =
      read_text("one.wrl",
                "#VRML V1.0 ascii\nSeparator {\n Material { diffuseColor [0.2 0.2 0.2, 0.4 0.4 "
                "0.4] }\n MaterialBinding { value PER_FACE }\n Coordinate3 { point [0 0 0, 1 0 0, "
                "0 1 0, 0 0 1] }\n ShapeHints { vertexOrdering CLOCKWISE shapeType SOLID }\n "
                "IndexedFaceSet { coordIndex [0 1 2 -1 0 1 3 -1] }\n}\nSeparator { Translation { "
                "translation 5 0 0 } Cube { } }\nCube { width 4 }\n",
                {'z', 1, "highest"});
  ASSERT_EQ(model.polygon_count(), 2u + 6 + 6);
  EXPECT_LT(area_vector2(model, 0).z, 0);
  EXPECT_EQ(model.facts[0].sides, Sides::one);
  EXPECT_NEAR(*model.materials[model.facts[0].material.index()].diffuse, 0.2, 1e-7);
  EXPECT_NEAR(*model.materials[model.facts[1].material.index()].diffuse, 0.4, 1e-7);
  EXPECT_FALSE(model.facts[8].material.exists());  // the Separator ended before it
  EXPECT_NEAR(bounding_box(model.vertices).high.x, 6, 1e-12);
}

TEST(SceneVrml, FacesOfVrml1NameTheirMaterials) {
  const auto model = read_text(
      "one.wrl",
      "#VRML V1.0 ascii\nSeparator {\n Material { diffuseColor [0.2 0.2 0.2, 0.4 0.4 0.4, 0.6 0.6 "
      "0.6] }\n MaterialBinding { value PER_FACE_INDEXED }\n Coordinate3 { point [0 0 0, 1 0 0, 0 "
      "1 "
      "0, 0 0 1] }\n IndexedFaceSet { coordIndex [0 1 2 -1 0 1 3 -1 0 1 -1 1 2 3 -1] materialIndex "
      "[2 0 0 1] }\n}\n",
      {'z', 1, "highest"});
  ASSERT_EQ(model.polygon_count(), 3u);
  const std::array<double, 3> wanted{0.6, 0.2, 0.4};  // the face of two corners has an index, too
  for (std::size_t p = 0; p < wanted.size(); ++p)
    EXPECT_NEAR(*model.materials[model.facts[p].material.index()].diffuse, wanted[p], 1e-7) << p;
}

const std::string six_points =
    "#Inventor V2.1 ascii\nSeparator { Coordinate3 { point [0 0 0, 1 0 0, 2 0 0, 0 1 0, 1 1 0, "
    "2 1 0] } ";

// Two squares side by side, as every set of Inventor has them; all look to +z.
TEST(SceneVrml, InventorSetsStripsAndMeshes) {
  for (const std::string set : {"QuadMesh { verticesPerRow 3 verticesPerColumn 2 ccw }",
                                "IndexedTriangleStripSet { coordIndex [0 1 3 4 -1 1 2 4 5] }",
                                "IndexedFaceSet { coordIndex [0 1 4 3 -1 1 2 5 4] }"}) {
    auto text = six_points + set + " }";
    if (const auto word = text.find("ccw "); word != text.npos) {
      // A mesh runs the other way around: rows first.
      text.erase(word, 4);
      const auto model = read_text("s.iv", text, {'z', 1, "highest"});
      ASSERT_EQ(model.polygon_count(), 4u);
      for (std::size_t p = 0; p < 4; ++p) EXPECT_EQ(area_vector2(model, p).z, -1);
      continue;
    }
    const auto model = read_text("s.iv", text, {'z', 1, "highest"});
    double area2 = 0;
    for (std::size_t p = 0; p < model.polygon_count(); ++p) {
      EXPECT_GT(area_vector2(model, p).z, 0) << set;
      area2 += area_vector2(model, p).z;
    }
    EXPECT_EQ(area2, 4) << set;
  }
  const auto rest = read_text("r.iv", six_points + "FaceSet { startIndex 1 numVertices [3 -1] } }",
                              {'z', 1, "highest"});
  EXPECT_EQ(rest.polygon_count(), 1u);
  EXPECT_TRUE(has_note(rest, "1 faces of fewer than 3 corners left out"));
}

// Coin would read beyond the table.
TEST(SceneVrml, InventorSetsWithoutPointsAreRefused) {
  for (const char* set : {"FaceSet { numVertices [7] }", "FaceSet { startIndex 7 }",
                          "FaceSet { startIndex -2 }", "TriangleStripSet { numVertices [3 4] }",
                          "QuadMesh { verticesPerRow 4 verticesPerColumn 2 }",
                          "QuadMesh { verticesPerRow 2147483647 verticesPerColumn 2147483647 }"})
    EXPECT_NE(refusal("s.iv", six_points + set + " }").find("has no points"), std::string::npos)
        << set;
  EXPECT_NE(refusal("s.iv", six_points + "IndexedTriangleStripSet { coordIndex [0 1 6] } }")
                .find("coordIndex 6 is out of range"),
            std::string::npos);
}

TEST(SceneVrml, UnknownFieldsAreLeftOutAndCounted) {
  const auto model = read_text(
      "u.wrl", vrml97 +
                   "Shape {\n appearance Appearance { material Material { shiny TRUE "
                   "diffuseColor 0.5 0.5 0.5\n glow [1 2 3] } }\n geometry Box { grain Wood { "
                   "rings 3 } size 2 2 2 }\n}\nUnheardOf { a 1 b [2 3] }\n");
  EXPECT_EQ(model.polygon_count(), 6u);
  EXPECT_NEAR(*model.materials.at(0).diffuse, 0.5, 1e-7);
  EXPECT_EQ(bounding_box(model.vertices).high.x, 1);
  EXPECT_TRUE(has_note(model,
                       "1 fields 'shiny' of Material are unknown and left out (first at "
                       "u.wrl:3)"));
  EXPECT_TRUE(has_note(model,
                       "1 fields 'glow' of Material are unknown and left out (first at "
                       "u.wrl:4)"));
  EXPECT_TRUE(has_note(model, "1 fields 'grain' of Box"));
  EXPECT_TRUE(has_note(model, "1 nodes 'UnheardOf' are unknown and left out (first at u.wrl:7)"));
}

TEST(SceneVrml, HostileFilesAreRefused) {
  std::string deep = vrml97;
  for (int i = 0; i < 100000; ++i) deep += "Group { children [";
  EXPECT_NE(refusal("h.wrl", deep).find("nested too deep"), std::string::npos);
  EXPECT_NE(refusal("h.wrl", vrml97 + "DEF A Group { children USE A }").find("contains itself"),
            std::string::npos);
  EXPECT_NE(refusal("h.wrl", vrml97 + "PROTO A [] { Group { children A { } } } A { }")
                .find("contains itself"),
            std::string::npos);
  std::string protos = vrml97 + "PROTO P0 [] { Shape { geometry Box { } } }\n";
  std::string groups = vrml97 + "DEF G0 Shape { geometry Box { } }\n";
  for (int i = 1; i < 40; ++i) {
    const auto name = std::to_string(i), inner = std::to_string(i - 1);
    protos +=
        "PROTO P" + name + " [] { Group { children [ P" + inner + " { } P" + inner + " { } ] } }\n";
    groups += "DEF G" + name + " Group { children [ USE G" + inner + " USE G" + inner + " ] }\n";
  }
  EXPECT_NE(refusal("h.wrl", protos + "P39 { }").find("too many nodes"), std::string::npos);
  EXPECT_NE(refusal("h.wrl", groups).find("too many"), std::string::npos);
  std::string chain = vrml97 + "DEF G0 Group { }\n";
  for (int i = 1; i < 100000; ++i)
    chain +=
        "DEF G" + std::to_string(i) + " Group { children USE G" + std::to_string(i - 1) + " }\n";
  EXPECT_NE(refusal("h.wrl", chain).find("nested too deep"), std::string::npos);
  EXPECT_NE(refusal("h.wrl", vrml97 + "Shape { " + std::string(1'000'000, 'a') + " 1 }")
                .find("a word of"),
            std::string::npos);
  EXPECT_NE(refusal("h.wrl", vrml97 + "Shape { geometry Box { }").find("never closed"),
            std::string::npos);
  EXPECT_NE(refusal("h.wrl", vrml97 + "Shape { geometry Box { ] }").find("closes nothing"),
            std::string::npos);
  EXPECT_NE(refusal("h.wrl", std::string("#VRML V2.0 utf8\n\0", 17)).find("zero byte"),
            std::string::npos);
  EXPECT_NE(refusal("h.wrl", "#Inventor V2.1 binary\n").find("binary Inventor"), std::string::npos);
  EXPECT_NE(refusal("h.wrl", gzip(vrml97).substr(0, 20)).find("gzip"), std::string::npos);
  EXPECT_NE(refusal("h.wrl", vrml97 + "Shape { geometry Box { size 1e38 1e38 1e38 } }")
                .find("beyond all coordinates"),
            std::string::npos);
  EXPECT_EQ(refusal("h.wrl", vrml97 + "DEF w Shape { geometry IndexedFaceSet { coord Coordinate { "
                                      "point [0 0 0] } coordIndex [0 1 2] } }")
                .substr(0, 8),
            "h.wrl:2:");
  EXPECT_EQ(refusal("h.wrl", vrml97 + "\nShape { geometry Box { size oops } }").substr(0, 8),
            "h.wrl:3:");
}

TEST(SceneVrml, DamagedBytesNeverCrash) {
  const std::string good =
      vrml97 +
      "PROTO Hut [ field SFVec3f size 1 1 1 ] { Shape { geometry Box { size IS size } } }\n"
      "DEF a Transform { children [ Hut { size 2 2 2 } DEF s Shape { appearance Appearance "
      "{ material Material { diffuseColor 0.5 0.5 0.5 } } " +
      triangle + "} } USE s ] }\n";
  std::size_t read = 0;
  for (std::size_t at = vrml97.size(); at < good.size(); ++at) {
    for (const char byte : {'}', '[', '"', '9'}) {
      std::string bad = good;
      bad[at] = byte;
      read += refusal("d.wrl", bad).empty();
    }
  }
  EXPECT_GT(read, 0u);
}

}  // namespace
}  // namespace sunload
