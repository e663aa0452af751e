// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

const std::string vertices =
    R"("vertices":[[0,0,0],[10,0,0],[10,10,0],[0,10,0],[2,2,0],[4,2,0],[4,4,0],[0,0,5]])";

/// A whole file of version 2.0 around its objects.
std::string city(const std::string& objects, const std::string& more = "") {
  return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.5,0.5,0.5],)"
         R"("translate":[1000000,2000000,100]},"CityObjects":{)" +
         objects + "}," + vertices + (more.empty() ? "" : "," + more) + "}";
}

std::string object(const std::string& id, const std::string& type, const std::string& geometry,
                   const std::string& more = "") {
  return "\"" + id + "\":{\"type\":\"" + type + "\",\"geometry\":[" + geometry + "]" +
         (more.empty() ? "" : "," + more) + "}";
}

std::string surfaces(const std::string& lod, const std::string& boundaries,
                     const std::string& more = "") {
  return R"({"type":"MultiSurface","lod":")" + lod + R"(","boundaries":)" + boundaries +
         (more.empty() ? "" : "," + more) + "}";
}

const std::string triangle = "[[[0,1,2]]]";

TEST(SceneCityJson, TransformHolesNamesAndCrs) {
  const auto model = read_text(
      "a.city.json",
      city(object("b", "Building", surfaces("2", "[[[0,1,2,3],[6,5,4]]]")),
           R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"})"));
  ASSERT_EQ(model.polygon_count(), 1u);
  EXPECT_EQ(ring_count(model, 0), 2);
  EXPECT_EQ(corner(model, 0, 0, 1), (Vec3{1000005, 2000000, 100}));
  EXPECT_EQ(corner(model, 0, 1, 0), (Vec3{1000002, 2000002, 100}));
  EXPECT_EQ(model.vertices.size(), 7u);  // what no polygon uses is not there
  EXPECT_EQ(model.object_names, std::vector<std::string>{"b"});
  EXPECT_EQ(model.object_kinds, std::vector<std::string>{"Building"});
  EXPECT_EQ(model.crs, "https://www.opengis.net/def/crs/EPSG/0/7415");
  EXPECT_TRUE(model.is_city_format);
  EXPECT_EQ(broken_arrays(model), "");
}

/// Degrees are no lengths; lengths in a file that says degrees are.
TEST(SceneCityJson, DegreesAreRefused) {
  const auto at = [](const std::string& first) {
    return R"({"type":"CityJSON","version":"1.1","transform":{"scale":[1e-8,1e-8,0.001],)"
           R"("translate":[)" +
           first +
           R"(,0]},"metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/4326"},)"
           R"("CityObjects":{)" +
           object("b", "Building", surfaces("2", triangle)) + "}," + vertices + "}";
  };
  for (const char* place : {"18.06,59.33", "59.33,18.06"}) {
    const std::string refused = refusal("a.city.json", at(place));
    EXPECT_NE(refused.find("is in degrees (referenceSystem EPSG:4326)"), std::string::npos)
        << refused;
    EXPECT_NE(refused.find("32634"), std::string::npos) << refused;
  }
  EXPECT_EQ(read_text("a.city.json", at("500000,6500000")).polygon_count(), 1u);
}

TEST(SceneCityJson, ByteOrderMarkAndFloatVertices) {
  const auto model =
      read_text("bom.json",
                "\xEF\xBB\xBF \n"
                R"({"type":"CityJSON","version":"1.0","CityObjects":{"t":{"type":"LandUse",
      "geometry":[{"type":"MultiSurface","lod":1,"boundaries":[[[0,1,2]]]}]}},
      "vertices":[[96714.0401,439209.3,-6.45],[1,0,0],[0,1.5e0,0]]})");
  ASSERT_EQ(model.polygon_count(), 1u);
  EXPECT_EQ(model.vertices[0], (Vec3{96714.0401, 439209.3, -6.45}));
  EXPECT_EQ(model.facts[0].surface, Surface::ground);
}

TEST(SceneCityJson, AllGeometryTypes) {
  const auto of = [](const std::string& type, const std::string& boundaries) {
    return "{\"type\":\"" + type + "\",\"lod\":\"1\",\"boundaries\":" + boundaries + "}";
  };
  const std::string shell = "[[[0,1,2]],[[0,2,3]]]";
  const auto model = read_text(
      "types.json",
      city(object("a", "Building", of("CompositeSurface", shell)) + "," +
           object("b", "Building", of("Solid", "[" + shell + ",[[[4,5,6]]]]")) + "," +
           object("c", "Building", of("MultiSolid", "[[" + shell + "],[" + shell + "]]")) + "," +
           object("d", "Building", of("CompositeSolid", "[[" + shell + "]]")) + "," +
           object("e", "Building",
                  of("MultiPoint", "[0,1]") + "," + of("MultiLineString", "[[0,1]]") + "," +
                      of("+Mesh", "1"))));
  EXPECT_EQ(model.polygon_count(), 2u + 3u + 4u + 2u);
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_TRUE(has_note(model, "2 geometries of points or lines"));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("1 geometries of unknown type '+Mesh' ignored"),
            std::string::npos);
}

TEST(SceneCityJson, SemanticSurfaces) {
  const auto model = read_text(
      "semantics.json",
      city(object("b", "Building",
                  R"({"type":"Solid","lod":"2","boundaries":[[[[0,1,2]],[[0,1,2]],[[0,1,2]],
                  [[0,1,2]],[[0,1,2]],[[0,1,2]],[[0,1,2]]],[[[4,5,6]]]],"semantics":{"surfaces":[
                  {"type":"WallSurface"},{"type":"RoofSurface"},{"type":"GroundSurface"},
                  {"type":"Window","parent":0},{"type":"ClosureSurface"},{"type":"+PatioDoor"}],
                  "values":[[0,1,2,3,4,5,null],[null]]}})") +
           "," + object("w", "WaterBody", surfaces("1", triangle)) + "," +
           object("v", "PlantCover", R"({"type":"Solid","lod":"1","boundaries":[[[[0,1,2]]]]})")));
  std::vector<Surface> kinds;
  for (const auto& facts : model.facts) kinds.push_back(facts.surface);
  EXPECT_EQ(kinds, (std::vector<Surface>{Surface::wall, Surface::roof, Surface::floor,
                                         Surface::window, Surface::other, Surface::other,
                                         Surface::other, Surface::other, Surface::ground}));
  EXPECT_TRUE(has_note(model, "1 closure surfaces left out"));
  EXPECT_TRUE(has_note(model, "1 semantic surfaces of unknown type"));
}

TEST(SceneCityJson, SurfacesOfRoomsAreLeftOutOfHouses) {
  const auto read_kinds = [](const std::string& types) {
    return read_text(
        "rooms.json",
        city(object("b", "Building",
                    R"({"type":"MultiSurface","lod":"3","boundaries":[[[0,1,2]],[[0,2,3]],[[0,1,3]],
                    [[4,5,6]]],"semantics":{"surfaces":[)" +
                        types + R"(],"values":[0,1,2,3]}})")));
  };
  const auto house = read_kinds(
      R"({"type":"WallSurface"},{"type":"InteriorWallSurface"},{"type":"FloorSurface"},
         {"type":"CeilingSurface"})");
  EXPECT_EQ(house.polygon_count(), 1u);
  EXPECT_TRUE(has_note(house, "3 surfaces of rooms left out"));
  // Terraces and undersides; and rooms without a house.
  EXPECT_EQ(read_kinds(R"({"type":"WallSurface"},{"type":"RoofSurface"},{"type":"FloorSurface"},
                          {"type":"CeilingSurface"})")
                .polygon_count(),
            4u);
  EXPECT_EQ(read_kinds(R"({"type":"InteriorWallSurface"},{"type":"InteriorWallSurface"},
                          {"type":"FloorSurface"},{"type":"CeilingSurface"})")
                .polygon_count(),
            4u);
}

TEST(SceneCityJson, LevelsOfDetailAreNotStacked) {
  const auto text =
      city(object("b", "Building",
                  surfaces("1.2", triangle) + "," + surfaces("2.2", "[[[0,1,2]],[[0,2,3]]]") + "," +
                      surfaces("1.3", "[[[0,1,2]],[[0,2,3]],[[4,5,6]]]") + "," +
                      surfaces("2.2", "[[[4,5,6]]]")));
  const auto count = [&](const std::string& lod) {
    return read_text("lod.json", text, {0, 1, lod}).polygon_count();
  };
  EXPECT_EQ(count("highest"), 3u);  // both geometries of 2.2
  EXPECT_EQ(count("1.2"), 1u);
  EXPECT_EQ(count("1.3"), 3u);
  EXPECT_EQ(count("1"), 3u);  // any 1.x, the highest of them
  EXPECT_EQ(count("2"), 3u);
  EXPECT_EQ(count("2.1"), 3u);  // nearest below: 1.3
  EXPECT_EQ(count("0"), 1u);    // nearest above: 1.2
  EXPECT_TRUE(has_note(read_text("lod.json", text, {0, 1, "3"}), "1 objects without LoD 3"));
  EXPECT_TRUE(has_note(read_text("lod.json", text), "2 geometries of other levels"));
  EXPECT_NE(refusal("lod.json", text, {0, 1, "finest"}), "");
  EXPECT_NE(refusal("lod.json", text, {0, 1, "2."}), "");
}

TEST(SceneCityJson, WholesAndPartsAreNotStacked) {
  const auto text = city(
      object("b", "Building", surfaces("0", "[[[0,1,2,3]]]"), R"("children":["p","q","i"])") + "," +
      object("p", "BuildingPart", surfaces("1.2", triangle) + "," + surfaces("2.2", triangle),
             R"("parents":["b"])") +
      "," + object("q", "BuildingPart", surfaces("1.2", triangle), R"("parents":["b"])") + "," +
      object("i", "BuildingInstallation", surfaces("3", triangle), R"("parents":["b"])"));
  EXPECT_EQ(read_text("f.json", text).object_names, (std::vector<std::string>{"i", "p", "q"}));
  EXPECT_EQ(read_text("f.json", text, {0, 1, "0"}).object_names,
            (std::vector<std::string>{"b", "i"}));
  const auto equal = city(object("b", "Building", surfaces("2", triangle), R"("children":["p"])") +
                          "," + object("p", "BuildingPart", surfaces("2", triangle)));
  EXPECT_EQ(read_text("f.json", equal).object_names, (std::vector<std::string>{"b", "p"}));
}

TEST(SceneCityJson, GroupsAndInteriorsAreNotStacked) {
  const auto model = read_text(
      "g.json",
      city(object("b", "Building", surfaces("2", triangle)) + "," +
           object("g", "CityObjectGroup", surfaces("2", triangle), R"("children":["b"])") + "," +
           object("h", "CityObjectGroup", surfaces("2", triangle)) + "," +
           object("r", "BuildingRoom", surfaces("3", triangle)) + "," +
           object("x", "+Noise", surfaces("3", triangle)) + ",\"y\":{\"type\":\"Road\"}"));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"b", "h", "x"}));
  EXPECT_TRUE(has_note(model, "1 geometries of groups left out"));
  EXPECT_TRUE(has_note(model, "1 interior objects (BuildingRoom)"));
  EXPECT_TRUE(has_note(model, "1 objects of unknown type '+Noise'"));
}

TEST(SceneCityJson, FamiliesByEitherList) {
  const auto model =
      read_text("families.json",
                city(object("g", "CityObjectGroup", "", R"("children":["b","i","t"])") + "," +
                     object("b", "Building", "", R"("children":["p"],"parents":["g"])") + "," +
                     object("p", "BuildingPart", surfaces("2", triangle)) + "," +
                     object("i", "BuildingInstallation", surfaces("2", triangle),
                            R"("parents":["g","p","lost"])") +
                     "," + object("t", "CityFurniture", surfaces("2", triangle)) + "," +
                     object("x", "Building", surfaces("2", triangle), R"("parents":["y"])") + "," +
                     object("y", "Building", surfaces("2", triangle), R"("parents":["x","y"])")));
  const FamilyTree tree(model.object_names, model.object_kinds, model.families);
  const auto owner_of = [&](const std::string& name) -> std::string {
    for (std::size_t place = 0; place < tree.size(); ++place)
      if (tree.name(place) == name)
        return tree.owner(place) ? tree.name(*tree.owner(place)) : "nothing";
    return "no such name";
  };
  EXPECT_EQ(owner_of("p"), "b");
  EXPECT_EQ(owner_of("i"), "p") << "a building goes before a group";
  EXPECT_EQ(owner_of("b"), "g");
  EXPECT_EQ(owner_of("t"), "g");
  EXPECT_EQ(owner_of("g"), "nothing");
  EXPECT_TRUE(owner_of("x") == "nothing" || owner_of("y") == "nothing") << "circles are cut";
  EXPECT_EQ(tree.owners_first().size(), tree.size());
}

TEST(SceneCityJson, Materials) {
  const std::string appearance =
      R"("appearance":{"materials":[{"name":"brick","diffuseColor":[0.3,0.2,0.1],
      "specularColor":[1,1,1]},{"name":"red"},{"diffuseColor":[2,2,2]}]DEFAULT})";
  const auto read = [&](const std::string& more, const std::string& theme) {
    auto text = appearance;
    text.replace(text.find("DEFAULT"), 7, theme);
    return read_text(
        "m.json",
        city(object("b", "Building", surfaces("2", "[[[0,1,2]],[[0,2,3]]]", more)), text));
  };
  auto model = read(R"("material":{"b":{"value":1},"a":{"values":[0,null]}})", "");
  ASSERT_EQ(model.materials.size(), 3u);
  EXPECT_DOUBLE_EQ(*model.materials[0].diffuse, 0.2);
  EXPECT_FALSE(model.materials[0].mirror.has_value());
  EXPECT_FALSE(model.materials[1].diffuse.has_value());
  EXPECT_FALSE(model.materials[2].diffuse.has_value());
  EXPECT_EQ(model.facts[0].material.index(), 0u);
  EXPECT_FALSE(model.facts[1].material.exists());
  EXPECT_TRUE(has_note(model, "theme 'a' taken"));
  model = read(R"("material":{"b":{"value":1},"a":{"values":[0,null]}})",
               R"(,"default-theme-material":"b")");
  EXPECT_EQ(model.facts[0].material.index(), 1u);
  EXPECT_EQ(model.facts[1].material.index(), 1u);
  EXPECT_TRUE(has_note(model, "theme 'b' taken"));
  model = read(R"("material":{"b":{"values":[3,0]}})", "");
  EXPECT_FALSE(model.facts[0].material.exists());
  EXPECT_EQ(model.facts[1].material.index(), 0u);
  EXPECT_TRUE(has_note(model, "1 surfaces name a material that is not there"));
}

TEST(SceneCityJson, TransparenciesAreTold) {
  const auto read = [&](const std::string& values) {
    return read_text("t.json",
                     city(object("b", "Building",
                                 surfaces("2", "[[[0,1,2]],[[0,2,3]]]",
                                          R"("material":{"a":{"values":)" + values + "}}")),
                          R"("appearance":{"materials":[{"name":"pane","transparency":0.5},
                          {"name":"wall","transparency":0.0},{"name":"veil","transparency":1}]})"));
  };
  EXPECT_TRUE(has_note(read("[0,1]"), "1 transparencies of materials ignored"));
  EXPECT_TRUE(has_note(read("[0,2]"), "2 transparencies of materials ignored"));
  EXPECT_FALSE(has_note(read("[1,1]"), "transparencies"));
}

const std::string templates =
    R"("geometry-templates":{"templates":[{"type":"MultiPoint","lod":"1","boundaries":[0]},
    {"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]},
    {"type":"MultiSurface","lod":"3","boundaries":[[[0,1,2]],[[0,2,1]]]}],
    "vertices-templates":[[0,0,0],[1,0,0],[0,1,0.25]]})";

std::string instance(int shape, const std::string& matrix, const std::string& more = "[1]") {
  return R"({"type":"GeometryInstance","template":)" + std::to_string(shape) + R"(,"boundaries":)" +
         more + R"(,"transformationMatrix":)" + matrix + "}";
}

TEST(SceneCityJson, TemplatesStandWhereTheyAreTold) {
  const std::string twice_and_shifted = "[2,0,0,7, 0,2,0,0, 0,0,2,-1, 0,0,0,1]";
  const std::string mirror = "[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]";
  const auto model = read_text(
      "t.json",
      city(object("a", "SolitaryVegetationObject", instance(1, twice_and_shifted)) + "," +
               object("b", "LandUse", instance(1, mirror)) + "," +
               object("c", "CityFurniture", instance(1, mirror) + "," + instance(2, mirror)),
           templates));
  ASSERT_EQ(model.polygon_count(), 4u);
  EXPECT_EQ(corner(model, 0, 0, 0), (Vec3{1000005 + 7, 2000000, 99}));
  EXPECT_EQ(corner(model, 0, 0, 2), (Vec3{1000005 + 7, 2000002, 99.5}));
  // The mirror turns the winding back, so that the front stays the front.
  EXPECT_EQ(corner(model, 1, 0, 0), (Vec3{1000005, 2000001, 100.25}));
  EXPECT_EQ(corner(model, 1, 0, 1), (Vec3{1000004, 2000000, 100}));
  EXPECT_EQ(model.facts[1].surface, Surface::ground);
  EXPECT_TRUE(has_note(model, "1 geometries of other levels"));
  EXPECT_EQ(broken_arrays(model), "");
  // y up: turned after the instance is put together
  const auto turned = read_text(
      "t.json", city(object("a", "CityFurniture", instance(1, twice_and_shifted)), templates),
      {'y', 1, "highest"});
  EXPECT_EQ(corner(turned, 0, 0, 2), (Vec3{1000012, -99.5, 2000002}));
}

TEST(SceneCityJson, BadTemplatesAreRefused) {
  const std::string unit = "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]";
  const auto with = [&](const std::string& geometry) {
    return refusal("t.json", city(object("a", "CityFurniture", geometry), templates));
  };
  EXPECT_EQ(with(instance(0, unit)), "");  // points only: nothing to read
  EXPECT_NE(with(instance(3, unit)).find("names no template"), std::string::npos);
  EXPECT_NE(with(instance(1, "[1,0]")).find("16 numbers"), std::string::npos);
  EXPECT_NE(with(instance(1, "[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1]")).find("last row"),
            std::string::npos);
  EXPECT_NE(with(instance(1, unit, "[99]")).find("reference point"), std::string::npos);
  EXPECT_NE(with(instance(1, unit, "[]")).find("reference point"), std::string::npos);
}

TEST(SceneCityJson, InstancesCannotFillTheMemory) {
  std::string shape = "[[0,1,2]]", many = shape;
  for (int i = 1; i < 2000; ++i) many += "," + shape;
  std::string places = instance(0, "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"), all = places;
  for (int i = 1; i < 1000; ++i) all += "," + places;
  const auto text =
      city(object("bomb", "CityFurniture", all),
           R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[)" +
               many + R"(]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]]})");
  // 3 corners × 2000 × 1000 may be made by this file of 150 kB only in part.
  EXPECT_NE(refusal("bomb.json", text).find("too often"), std::string::npos);
}

TEST(SceneCityJson, Sequence) {
  const std::string header =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[5,0,0]},)"
      R"("metadata":{"referenceSystem":"urn:ogc:def:crs:EPSG::28992"},"CityObjects":{},"vertices":[]})";
  const auto feature = [](const std::string& id, const std::string& z) {
    return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{")" + id +
           R"(":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}},)"
           R"("vertices":[[0,0,)" +
           z + R"(],[1,0,0],[0,1,0]]})";
  };
  const auto model =
      read_text("s.city.jsonl", header + "\r\n" + feature("z", "7") + "\n\n" + feature("a", "8"));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"z", "a"}));
  EXPECT_EQ(corner(model, 1, 0, 0), (Vec3{5, 0, 8}));
  EXPECT_EQ(model.crs, "urn:ogc:def:crs:EPSG::28992");
  // the same id again is the same object
  const auto joined =
      read_text("s.jsonl", header + "\n" + feature("a", "7") + "\n" + feature("a", "8"));
  EXPECT_EQ(joined.object_names.size(), 1u);
  EXPECT_EQ(joined.facts[1].object, joined.facts[0].object);
  EXPECT_EQ(broken_arrays(joined), "");

  const auto cut = header + "\n" + feature("a", "7") + "\n" + feature("b", "8").substr(0, 60);
  EXPECT_EQ(refusal("s.jsonl", cut).substr(0, 13), "s.jsonl:3:61:");
  EXPECT_EQ(refusal("s.jsonl", header + "\n" + header).substr(0, 10), "s.jsonl:2:");
  EXPECT_NE(refusal("s.jsonl", feature("a", "7") + "\n" + feature("b", "7")).find("begins with"),
            std::string::npos);
}

TEST(SceneCityJson, RefusesWhatIsBrokenAndNamesThePlace) {
  const auto bad = [](const std::string& geometry) {
    return refusal("b.json", city(object("house", "Building", geometry)));
  };
  const auto index = bad(surfaces("1", "[[[0,1,2]],[[0,1,77]]]"));
  EXPECT_NE(index.find("'house', geometry 0: surface 1: vertex index 77"), std::string::npos)
      << index;
  EXPECT_NE(bad(surfaces("1", "[[[0,1,-2]]]")).find("vertex index -2"), std::string::npos);
  EXPECT_NE(bad(surfaces("1", "[[[0,1,2.5]]]")).find("vertex index 2.5"), std::string::npos);
  EXPECT_NE(bad(surfaces("1", "[[0,1,2]]")), "");
  EXPECT_NE(bad(surfaces("1", "[0,1,2]")), "");
  EXPECT_NE(bad(surfaces("1", "7")), "");
  EXPECT_NE(bad(R"({"type":"Solid","lod":"1"})"), "");
  EXPECT_NE(bad(surfaces("1", triangle, R"("semantics":{"surfaces":[],"values":[3]})"))
                .find("semantic surface index 3"),
            std::string::npos);
  EXPECT_NE(refusal("b.json", city("\"x\":{\"geometry\":[]}")).find("'x' has no type"),
            std::string::npos);
  EXPECT_NE(refusal("b.json", city("\"x\":7")).find("'x' has no type"), std::string::npos);
}

TEST(SceneCityJson, RefusesWhatIsNoCityJson) {
  const auto versioned = [](const std::string& version) {
    return refusal("v.json", R"({"type":"CityJSON","version":")" + version +
                                 R"(","CityObjects":{},"vertices":[]})");
  };
  EXPECT_EQ(versioned("1.0"), "");
  EXPECT_EQ(versioned("1.1.3"), "");
  EXPECT_EQ(versioned("2.0.1"), "");
  EXPECT_NE(versioned("0.9").find("older than 1.0"), std::string::npos);
  EXPECT_NE(versioned("0.8").find("'0.8'"), std::string::npos);
  EXPECT_NE(versioned("3.0").find("can be read"), std::string::npos);
  EXPECT_NE(refusal("v.json", R"({"type":"CityJSON","CityObjects":{}})"), "");
  EXPECT_NE(refusal("v.json", R"({"version":"2.0"})").find("no \"type\""), std::string::npos);
  EXPECT_NE(refusal("v.json", R"({"type":"FeatureCollection"})").find("FeatureCollection"),
            std::string::npos);
  EXPECT_NE(refusal("v.json", "[1,2]"), "");
  EXPECT_NE(refusal("v.json", "7"), "");
}

TEST(SceneCityJson, BrokenJsonNamesThePlace) {
  const auto text = city(object("b", "Building", surfaces("1", triangle)));
  for (std::size_t length = 1; length < text.size(); ++length) {
    ASSERT_NE(refusal("cut.json", text.substr(0, length)), "") << length;
  }
  EXPECT_EQ(refusal("cut.json", "{\"type\":\n  \"CityJSON\",\n").substr(0, 11), "cut.json:3:");
  EXPECT_EQ(refusal("x.json", "{\n  \"a\": 1e999}").substr(0, 11), "x.json:2:8:");
  EXPECT_EQ(refusal("x.json", "{\"a\": NaN}").substr(0, 11), "x.json:1:7:");
  EXPECT_NE(refusal("deep.json", "{\"a\":" + std::string(1'000'000, '[')).find("too deeply"),
            std::string::npos);
  const auto huge = text;
  EXPECT_NE(refusal("huge.json", city(object("b", "Building", surfaces("1", triangle)), R"("x":0)")
                                     .replace(text.find("1000000"), 7, "1e30000")),
            "");
  EXPECT_NE(refusal("huge.json", std::string(text).replace(text.find("1000000"), 7, "1000e99"))
                .find("beyond all coordinates"),
            std::string::npos);
}

TEST(SceneCityJson, RingsThatAreNoPolygonsAreCounted) {
  const auto model = read_text(
      "r.json", city(object("b", "Building", surfaces("1", "[[[0,1]],[],[[0,1,2,3],[4,5]]]"))));
  EXPECT_EQ(model.polygon_count(), 1u);
  EXPECT_EQ(ring_count(model, 0), 1);
  EXPECT_TRUE(has_note(model, "2 surfaces of fewer than 3"));
  EXPECT_TRUE(has_note(model, "1 inner rings of fewer than 3"));
}

}  // namespace
}  // namespace sunload
