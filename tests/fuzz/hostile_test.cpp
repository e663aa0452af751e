// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Files of less than 1 MB that ask for all memory or all time: refused, or read in moderation.
// They are too long to be kept among the regressions, and made here.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geo/base/check.h"
#include "geo/mesh/mesh_prepare.h"
#include "io/scene/file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/refusal_of.h"

namespace sunload::fuzz {
namespace {

constexpr std::size_t largest_file = 1'000'000;

/// What the file is refused with; empty where it is read and prepared.
std::string refusal(const std::string& name, const std::string& text,
                    const PrepareRules& rules = {}) {
  EXPECT_LT(text.size(), largest_file);
  return test::refusal_of([&] { prepare(read_scene_file(file_of(text, name), {}), rules); });
}

void expect_refused(const std::string& name, const std::string& text, const std::string& why) {
  const auto message = refusal(name, text);
  EXPECT_NE(message.find(why), std::string::npos) << name << ": " << message.substr(0, 300);
}

std::string times(std::size_t count, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

TEST(HostileFiles, ElementsWithoutBytes) {
  for (const char* name : {"vertex", "face", "edge"})
    expect_refused(
        "empty.ply",
        std::string("ply\nformat ascii 1.0\nelement ") + name + " 900000000000\nend_header\n",
        "is not there");
}

TEST(HostileFiles, ManyPrototypes) {
  const auto proto = [](const std::string& name, const std::string& inner) {
    return "PROTO " + name + " [ ] { Group { children [ " + times(100, inner + " ") + "] } }\n";
  };
  expect_refused("protos.wrl",
                 "#VRML V2.0 utf8\n" + proto("A", "Shape { geometry Box { } }") +
                     proto("B", "A { }") + proto("C", "B { }") + "C { }\n",
                 "has too many nodes");
}

TEST(HostileFiles, ManyInstances) {
  expect_refused("spheres.wrl", "#VRML V2.0 utf8\n" + times(38000, "Shape{geometry Sphere{}}\n"),
                 "has too many faces");
  const std::string accessor =
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":20000,"type":"VEC3"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":240000}],"buffers":[{"byteLength":240000,)"
      R"("uri":"data:;base64,)" +
      times(20000, "AAAAAAAAAAAAAAAA") + "\"}]}";
  const std::string mesh = R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":)"
                           R"({"POSITION":0}}]}],"nodes":[)";
  expect_refused("meshes.gltf", mesh + times(3000, "{\"mesh\":0},") + "{\"mesh\":0}]," + accessor,
                 "too many");
  std::string nodes;
  for (int n = 1; n <= 40; ++n)
    nodes += "{\"children\":[" + times(29, std::to_string(n) + ",") + std::to_string(n) + "]},";
  expect_refused("nodes.gltf", mesh + nodes + "{\"mesh\":0}]," + accessor, "too many");
}

TEST(HostileFiles, ManyLinks) {
  const auto city = [](const std::string& members) {
    return "<CityModel>" + members + "</CityModel>";
  };
  // Buildings that all have the same thousands of polygons; trees that all have the same crown.
  const std::string polygon =
      "<surfaceMember><Polygon><exterior><LinearRing><posList>0 0 0 1 0 0 0 1 0</posList>"
      "</LinearRing></exterior></Polygon></surfaceMember>";
  const std::string surface = "<MultiSurface id='s'>" + times(3500, polygon) + "</MultiSurface>";
  const auto building = [](const std::string& geometry) {
    return "<cityObjectMember><Building><lod2MultiSurface" + geometry +
           "</Building></cityObjectMember>";
  };
  expect_refused(
      "walls.gml",
      city(building(">" + surface + "</lod2MultiSurface>") + times(5000, building(" href='#s'/>"))),
      "once too often");
  const std::string tree =
      "<cityObjectMember><PlantCover><lod1ImplicitRepresentation><ImplicitGeometry>"
      "<relativeGMLGeometry href='#s'/><referencePoint><Point><pos>0 0 0</pos></Point>"
      "</referencePoint></ImplicitGeometry></lod1ImplicitRepresentation></PlantCover>"
      "</cityObjectMember>";
  expect_refused("trees.gml",
                 city(building(">" + surface + "</lod2MultiSurface>") + times(2000, tree)),
                 "once too often");
  expect_refused("deep.gml", city(times(40000, "<cityObjectMember><a>")), "no well-formed XML");
  const std::string parts = "<consistsOfBuildingPart><BuildingPart>";
  expect_refused("parts.gml",
                 city("<cityObjectMember><Building>" + times(5000, parts) +
                      times(5000, "</BuildingPart></consistsOfBuildingPart>") +
                      "</Building></cityObjectMember>"),
                 "nest too deep");
}

TEST(HostileFiles, LongNames) {
  expect_refused("names.gltf",
                 R"({"asset":{"version":"2.0"},"meshes":[{"name":")" + std::string(400'000, 'n') +
                     R"(","primitives":[]}],"nodes":[)" + times(20000, "{\"mesh\":0},") +
                     "{\"mesh\":0}]}",
                 "names of objects");
}

TEST(HostileFiles, LargeRasters) {
  expect_refused("large.asc", "ncols 4900\nnrows 4900\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n",
                 "too many for its size");
}

TEST(HostileFiles, LongExtrusions) {
  std::string section, spine;
  for (int i = 0; i < 990; ++i) {
    section += std::to_string(i * i % 97) + " " + std::to_string(i * 7 % 89) + ", ";
    spine += "0 " + std::to_string(i) + " 0, ";
  }
  expect_refused("long.wrl",
                 "#VRML V2.0 utf8\nShape { geometry Extrusion { crossSection [ " + section +
                     "] spine [ " + spine + "] } }\n",
                 "too many points");
}

/// A polygon all of whose edges cross all others: n² crossings.
TEST(HostileFiles, StarsOfManyEdges) {
  constexpr int corners = 5001;
  std::string text, face = "f";
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * i * (corners / 2) / corners;
    text += "v " + std::to_string(1000 * std::cos(angle)) + " " +
            std::to_string(1000 * std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  expect_refused("star.obj", text + face + "\n",
                 "cross themselves more often than can be triangulated");
}

/// Thirty thousand walls around one edge: all pairs of them would take gigabytes.
TEST(HostileFiles, WallsAroundOneEdge) {
  constexpr int walls = 25000;
  std::string text = "v 0 0 0\nv 0 0 1\n";
  for (int i = 0; i < walls; ++i)
    text += "v " + std::to_string(std::cos(i / 40.0)).substr(0, 7) + " " +
            std::to_string(std::sin(i / 40.0)).substr(0, 7) + " .5\n";
  for (int i = 0; i < walls; ++i) text += "f 1 2 " + std::to_string(i + 3) + "\n";
  EXPECT_EQ(refusal("fan.obj", text), "");
}

std::string triangles_between(int corners, int count) {
  std::mt19937 random(3);
  const auto corner = [&] {
    return " " + std::to_string(random() % static_cast<unsigned>(corners) + 1);
  };
  std::string text;
  for (int i = 0; i < count; ++i) text += "f" + corner() + corner() + corner() + "\n";
  return text;
}

const PrepareRules splitting_t_joints{.repair = Repair::all, .ground = {}};

/// Every edge crosses the whole scene.
TEST(HostileFiles, OverlappingTriangles) {
  constexpr int corners = 20000;
  std::mt19937 random(2);
  std::string text;
  for (int i = 0; i < corners; ++i)
    text += "v " + std::to_string(random() % 1000) + " " + std::to_string(random() % 1000) + " 0\n";
  text += triangles_between(corners, 37000);
  EXPECT_EQ(refusal("overlap.obj", text, splitting_t_joints), "");
}

/// Every corner lies near every edge, on few of them: on a line but for some centimetres.
TEST(HostileFiles, TrianglesAlongOneLine) {
  constexpr int corners = 20000;
  std::mt19937 random(2);
  std::string text;
  for (int i = 0; i < corners; ++i) {
    const auto place = [&, along = random() % 899'000] {
      return " " + std::to_string(static_cast<double>(along + random() % 20) / 1000).substr(0, 7);
    };
    text += "v" + place() + place() + place() + "\n";
  }
  text += triangles_between(corners, 22000);
  const auto message = refusal("line.obj", text, splitting_t_joints);
  EXPECT_NE(message.find("too many triangles of object"), std::string::npos) << message;
}

}  // namespace
}  // namespace sunload::fuzz
