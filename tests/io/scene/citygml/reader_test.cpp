// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/reader.h"

#include <gtest/gtest.h>

#include "tests/io/scene/citygml/gml_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

TEST(SceneCityGml, ABlockOfLod1) {
  const auto model = read_text(
      "block.gml",
      city_gml(building("b", element("bldg:lod1Solid", box_solid(500000, 5400000, 100, 10, 5, 3))),
               envelope("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783")));
  EXPECT_EQ(model.polygon_count(), 6u);
  EXPECT_EQ(model.vertices.size(), 8u);  // corners that polygons share are one vertex
  EXPECT_EQ(ring_size(model, 0, 0), 4);  // the last position of a ring repeats its first
  EXPECT_EQ(corner(model, 1, 0, 2), (Vec3{500010, 5400005, 103}));
  EXPECT_EQ(model.object_names, std::vector<std::string>{"b"});
  EXPECT_EQ(model.object_kinds, std::vector<std::string>{"Building"});
  EXPECT_EQ(model.crs, "EPSG:25832");
  EXPECT_TRUE(model.is_city_format);
  EXPECT_TRUE(model.notes.empty());
  EXPECT_EQ(broken_arrays(model), "");
}

/// As most of LoD2 is written: boundary surfaces hold the polygons, the solid links to them.
std::string semantic_building() {
  const auto faces = box_faces(0, 0, 0, 10, 10, 5);
  const auto boundary = [](const std::string& type, const std::string& polygons) {
    return element("bldg:boundedBy",
                   element("bldg:" + type, element("bldg:lod2MultiSurface", polygons)));
  };
  std::string links;
  for (int k = 0; k < 6; ++k) links += link("gml:surfaceMember", "p" + std::to_string(k));
  std::string text = element(
      "bldg:lod2Solid",
      element("gml:Solid", element("gml:exterior", element("gml:CompositeSurface", links))));
  text += boundary("GroundSurface", multi_surface({polygon(faces[0], "p0")}));
  text += boundary("RoofSurface",
                   multi_surface({polygon(faces[1], "p1", {"2 2 5 2 4 5 4 4 5 4 2 5 2 2 5"})}));
  text += boundary("WallSurface", multi_surface({polygon(faces[2], "p2"), polygon(faces[3], "p3"),
                                                 polygon(faces[4], "p4")}));
  return text + boundary("ClosureSurface", multi_surface({polygon(faces[5], "p5")}));
}

TEST(SceneCityGml, SolidsLinkToPolygonsOfBoundarySurfaces) {
  const auto model = read_text("lod2.gml", city_gml(building("b", semantic_building())));
  EXPECT_EQ(surfaces_of(model), (std::vector<Surface>{Surface::floor, Surface::roof, Surface::wall,
                                                      Surface::wall, Surface::wall}));
  EXPECT_EQ(ring_count(model, 1), 2);
  EXPECT_EQ(corner(model, 1, 1, 0), (Vec3{2, 2, 5}));
  EXPECT_TRUE(has_note(model, "1 closure surfaces left out"));
  EXPECT_EQ(broken_arrays(model), "");
}

TEST(SceneCityGml, SurfacesOfRoomsAreLeftOutOfHouses) {
  const auto faces = box_faces(0, 0, 0, 10, 10, 5);
  const auto boundary = [&](const std::string& type, int face) {
    return element(
        "bldg:boundedBy",
        element("bldg:" + type,
                element("bldg:lod3MultiSurface",
                        multi_surface({polygon(faces[static_cast<std::size_t>(face)])}))));
  };
  const std::string rooms = boundary("InteriorWallSurface", 3) + boundary("FloorSurface", 0) +
                            boundary("CeilingSurface", 1);
  const auto house =
      read_text("rooms.gml", city_gml(building("b", boundary("WallSurface", 2) + rooms)));
  EXPECT_EQ(surfaces_of(house), std::vector<Surface>{Surface::wall});
  EXPECT_TRUE(has_note(house, "3 surfaces of rooms left out"));
  EXPECT_EQ(read_text("alone.gml", city_gml(building("b", rooms))).polygon_count(), 3u);
}

TEST(SceneCityGml, PolygonsThatAreWrittenTwiceAreReadOnce) {
  const auto faces = box_faces(0, 0, 0, 1, 1, 1);
  std::vector<std::string> polygons;
  for (const auto& face : faces) polygons.push_back(polygon(face));
  const auto model = read_text(
      "twice.gml",
      city_gml(building(
          "b", element("bldg:lod2Solid", solid(polygons)) +
                   element("bldg:boundedBy",
                           element("bldg:RoofSurface", element("bldg:lod2MultiSurface",
                                                               multi_surface({polygons[1]})))))));
  EXPECT_EQ(model.polygon_count(), 6u);
  EXPECT_EQ(model.facts[0].surface, Surface::roof);
  EXPECT_TRUE(has_note(model, "1 polygons that repeat those of boundary surfaces"));
  EXPECT_EQ(broken_arrays(model), "");
}

TEST(SceneCityGml, OpeningsLieInTheirWalls) {
  const auto opening = [](const std::string& type, const std::string& positions) {
    return element("bldg:opening",
                   element("bldg:" + type,
                           element("bldg:lod3MultiSurface", multi_surface({polygon(positions)}))));
  };
  const auto model = read_text(
      "lod3.gml",
      city_gml(building(
          "b", element("bldg:boundedBy",
                       element("bldg:WallSurface",
                               element("bldg:lod3MultiSurface",
                                       multi_surface({polygon("0 0 0 9 0 0 9 0 9 0 0 9 0 0 0", "",
                                                              {"1 0 1 1 0 2 2 0 2 1 0 1"})})) +
                                   opening("Window", "1 0 1 2 0 2 1 0 2 1 0 1") +
                                   opening("Door", "5 0 0 6 0 0 6 0 2 5 0 0"))) +
                   element("bldg:boundedBy",
                           element("bldg:SolarSurface",
                                   element("bldg:lod3MultiSurface",
                                           multi_surface({polygon(other_triangle)})))))));
  EXPECT_EQ(surfaces_of(model),
            (std::vector<Surface>{Surface::wall, Surface::window, Surface::wall, Surface::other}));
  EXPECT_TRUE(has_note(model, "1 semantic surfaces of unknown type"));
}

TEST(SceneCityGml, GeometriesOfEveryKind) {
  const std::string shell = surface_members({polygon(triangle)});
  const auto patches = [](const std::string& name, const std::string& property,
                          const std::string& patch) {
    return element("gml:" + name,
                   element("gml:" + property,
                           element("gml:" + patch, element("gml:exterior", ring(triangle)))));
  };
  const std::vector<std::string> all{
      multi_surface({polygon(triangle), polygon(other_triangle)}),
      element("gml:MultiSurface",
              element("gml:surfaceMembers", polygon(triangle) + polygon(other_triangle))),
      element("gml:CompositeSurface", shell),
      element("gml:Solid", element("gml:exterior", element("gml:Shell", shell)) +
                               element("gml:interior", element("gml:Shell", shell))),
      element("gml:MultiSolid", element("gml:solidMember", solid({polygon(triangle)}))),
      element("gml:CompositeSolid", element("gml:solidMember", solid({polygon(triangle)}))),
      patches("TriangulatedSurface", "trianglePatches", "Triangle"),
      patches("Tin", "patches", "Triangle"),
      patches("PolyhedralSurface", "polygonPatches", "PolygonPatch"),
      patches("Surface", "patches", "PolygonPatch"),
      element("gml:MultiGeometry", element("gml:geometryMember", polygon(triangle)))};
  std::vector<std::size_t> counts;
  for (const auto& geometry : all) {
    const auto model =
        read_text("g.gml", city_gml(building("b", element("bldg:lod2Geometry", geometry))));
    counts.push_back(model.polygon_count());
    EXPECT_EQ(broken_arrays(model), "") << geometry;
  }
  EXPECT_EQ(counts, (std::vector<std::size_t>{2, 2, 1, 2, 1, 1, 1, 1, 1, 1, 1}));
  const auto thin = read_text(
      "thin.gml",
      city_gml(building(
          "b", element("bldg:lod2Geometry", multi_surface({polygon(triangle)})) +
                   element("bldg:lod2TerrainIntersection", element("gml:MultiCurve", "")))));
  EXPECT_EQ(thin.polygon_count(), 1u);
  EXPECT_TRUE(has_note(thin, "1 geometries of points or lines ignored"));
}

TEST(SceneCityGml, OrientableSurfacesTurn) {
  // The second is of CityGML 1.
  for (const std::string name : {"gml:OrientableSurface", "tex:TexturedSurface"}) {
    const auto of = [&](const std::string& sign) {
      return read_text(
          "turned.gml",
          city_gml(building("b", element("bldg:lod2MultiSurface",
                                         multi_surface({element(
                                             name, element("gml:baseSurface", polygon(triangle)),
                                             "xmlns:tex=\"http://www.opengis.net/citygml/"
                                             "texturedsurface/1.0\" orientation=\"" +
                                                 sign + "\"")})))));
    };
    const auto kept = of("+"), turned = of("-");
    ASSERT_EQ(kept.polygon_count(), 1u) << name;
    EXPECT_EQ(corner(kept, 0, 0, 1), (Vec3{1, 0, 0}));
    EXPECT_EQ(corner(turned, 0, 0, 1), (Vec3{1, 0, 0}));  // the second of three either way …
    EXPECT_EQ(corner(turned, 0, 0, 0), corner(kept, 0, 0, 2));
    EXPECT_EQ(corner(turned, 0, 0, 2), corner(kept, 0, 0, 0));
  }
}

TEST(SceneCityGml, SurfacesThatAreNotReadAreWarnedOf) {
  const auto model = read_text(
      "odd.gml", city_gml(building(
                     "b", element("bldg:lod2MultiSurface",
                                  multi_surface({polygon(triangle), element("gml:Sphere", "")})))));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("1 geometries of unknown type 'Sphere' ignored"),
            std::string::npos);
}

TEST(SceneCityGml, PositionsInEveryForm) {
  const std::vector<std::string> rings{
      "<gml:LinearRing><gml:pos>0 0 0</gml:pos><gml:pos>1.5 0 0</gml:pos><gml:pos>0 1 0</gml:pos>"
      "<gml:pos>0 0 0</gml:pos></gml:LinearRing>",
      "<gml:LinearRing><gml:posList>\n 0 0\t0 1.5e0 +0 0\n0 1 <!-- a remark --> 0 0 0 0 "
      "</gml:posList></gml:LinearRing>",
      "<gml:LinearRing><gml:coordinates>0,0,0 1.5,0,0 0,1,0 0,0,0</gml:coordinates>"
      "</gml:LinearRing>",
      "<gml:LinearRing><gml:coordinates decimal=\",\" cs=\";\" ts=\"|\">0;0;0|1,5;0;0|0;1;0|0;0;0"
      "</gml:coordinates></gml:LinearRing>",
      "<gml:LinearRing><gml:coord><gml:X>0</gml:X><gml:Y>0</gml:Y><gml:Z>0</gml:Z></gml:coord>"
      "<gml:coord><gml:X>1.5</gml:X><gml:Y>0</gml:Y><gml:Z>0</gml:Z></gml:coord>"
      "<gml:coord><gml:X>0</gml:X><gml:Y>1</gml:Y><gml:Z>0</gml:Z></gml:coord></gml:LinearRing>",
      "<gml:Ring><gml:curveMember><gml:LineString><gml:posList>0 0 0 1.5 0 0</gml:posList>"
      "</gml:LineString></gml:curveMember><gml:curveMember><gml:LineString><gml:posList>1.5 0 0 0 "
      "1 0 0 0 0</gml:posList></gml:LineString></gml:curveMember></gml:Ring>",
      "<gml:Ring><gml:curveMember><gml:LineString><gml:posList>0 0 0 1.5 0 0</gml:posList>"
      "</gml:LineString></gml:curveMember><gml:curveMember><gml:OrientableCurve "
      "orientation=\"-\"><gml:baseCurve><gml:LineString><gml:posList>0 0 0 0 1 0 1.5 0 0"
      "</gml:posList></gml:LineString></gml:baseCurve></gml:OrientableCurve></gml:curveMember>"
      "</gml:Ring>"};
  for (const auto& each : rings) {
    const auto model = read_text(
        "ring.gml",
        city_gml(building(
            "b", element("bldg:lod1MultiSurface",
                         multi_surface({element("gml:Polygon", element("gml:exterior", each))})))));
    ASSERT_EQ(model.polygon_count(), 1u) << each;
    EXPECT_EQ(ring_size(model, 0, 0), 3) << each;
    EXPECT_EQ(corner(model, 0, 0, 1), (Vec3{1.5, 0, 0})) << each;
  }
}

TEST(SceneCityGml, LevelsOfDetailAreNotStacked) {
  const auto text = city_gml(
      building("b", element("bldg:lod0FootPrint", multi_surface({polygon(triangle)})) +
                        element("bldg:lod0RoofEdge", multi_surface({polygon(other_triangle)})) +
                        element("bldg:lod1Solid", box_solid(0, 0, 0, 1, 1, 1)) +
                        element("bldg:lod2MultiSurface",
                                multi_surface({polygon(triangle), polygon(other_triangle)}))));
  const auto read = [&](const std::string& lod) { return read_text("l.gml", text, {0, 1, lod}); };
  EXPECT_EQ(read("highest").polygon_count(), 2u);
  EXPECT_EQ(read("2").polygon_count(), 2u);
  EXPECT_EQ(read("1").polygon_count(), 6u);
  EXPECT_EQ(read("0").polygon_count(), 1u);
  EXPECT_EQ(corner(read("0"), 0, 0, 0), (Vec3{0, 0, 0}));  // the footprint
  EXPECT_TRUE(has_note(read("0"), "1 edges of roofs (lod0RoofEdge)"));
  EXPECT_TRUE(has_note(read("highest"), "3 geometries of other levels"));
  EXPECT_EQ(read("3").polygon_count(), 2u);
  EXPECT_TRUE(has_note(read("3"), "1 objects without LoD 3"));
}

TEST(SceneCityGml, WholesAndPartsAreNotStacked) {
  const auto part = [](const std::string& id, const std::string& inside) {
    return element("bldg:consistsOfBuildingPart",
                   element("bldg:BuildingPart", inside, "gml:id=\"" + id + "\""));
  };
  const auto block = element("bldg:lod1Solid", box_solid(0, 0, 0, 1, 1, 1));
  const auto detailed = element("bldg:lod2Solid", box_solid(0, 0, 0, 1, 1, 1));
  const auto names = [](const std::string& inside) {
    return read_text("parts.gml", city_gml(building("b", inside))).object_names;
  };
  EXPECT_EQ(names(block + part("p", detailed) + part("q", detailed)),
            (std::vector<std::string>{"p", "q"}));
  EXPECT_EQ(names(detailed + part("p", block)), std::vector<std::string>{"b"});
  EXPECT_EQ(names(detailed + part("p", detailed)), (std::vector<std::string>{"p", "b"}));
  // A whole whose solid is made of the polygons of its parts.
  const auto shared = read_text(
      "shared.gml",
      city_gml(building("b", element("bldg:lod2MultiSurface",
                                     element("gml:MultiSurface", link("gml:surfaceMember", "s"))) +
                                 part("p", element("bldg:lod2MultiSurface",
                                                   multi_surface({polygon(triangle, "s")}))))));
  EXPECT_EQ(shared.object_names, std::vector<std::string>{"p"});
  EXPECT_EQ(shared.polygon_count(), 1u);
}

TEST(SceneCityGml, FamiliesOfWhatStandsInside) {
  const auto block = element("bldg:lod2Solid", box_solid(0, 0, 0, 1, 1, 1));
  const auto inside = [](const std::string& property, const std::string& type,
                         const std::string& more, const std::string& id = {}) {
    return element("bldg:" + property,
                   element("bldg:" + type, more, id.empty() ? "" : "gml:id=\"" + id + "\""));
  };
  const auto model = read_text(
      "families.gml",
      city_gml(building("b", inside("consistsOfBuildingPart", "BuildingPart",
                                    block + inside("outerBuildingInstallation",
                                                   "BuildingInstallation", block, "i"),
                                    "p")) +
               building("", inside("consistsOfBuildingPart", "BuildingPart", block, "q")) +
               building("", block) + building("alone", "")));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"i", "p", "q", "Building_1"}));
  const FamilyTree tree(model.object_names, model.object_kinds, model.families);
  std::vector<std::string> owners;
  for (std::size_t place = 0; place < tree.size(); ++place)
    owners.push_back(tree.owner(place) ? tree.name(*tree.owner(place)) : "");
  EXPECT_EQ(owners, (std::vector<std::string>{"p", "b", "Building_2", "", "", "", ""}));
  EXPECT_EQ(tree.name(6), "alone");
}

TEST(SceneCityGml, TypesOfObjects) {
  const auto of = [](const std::string& type, const std::string& property = "lod1MultiSurface",
                     const std::string& geometry = multi_surface({polygon(triangle)})) {
    return member(element("x:" + type, element("x:" + property, geometry)));
  };
  const auto model =
      read_text("types.gml",
                city_gml(of("Road") + of("LandUse") + of("WaterBody") +
                         of("WaterBody", "lod1Solid", solid({polygon(triangle)})) + of("Square") +
                         of("Track") + of("Bridge") + of("Tunnel") + of("CityFurniture") +
                         of("SolitaryVegetationObject", "lod1Geometry") + of("GenericCityObject") +
                         of("PlantCover") + of("Windmill") + of("BuildingFurniture")));
  EXPECT_EQ(model.object_kinds,
            (std::vector<std::string>{"Road", "LandUse", "WaterBody", "WaterBody",
                                      "TransportSquare", "Road", "Bridge", "Tunnel",
                                      "CityFurniture", "SolitaryVegetationObject",
                                      "GenericCityObject", "PlantCover", "Windmill"}));
  EXPECT_EQ(model.object_names.front(), "Road_1");
  EXPECT_EQ(model.object_names[3], "WaterBody_2");
  using enum Surface;
  EXPECT_EQ(surfaces_of(model),
            (std::vector<Surface>{ground, ground, ground, other, ground, ground, other, other,
                                  other, other, other, ground, other}));
  EXPECT_TRUE(has_note(model, "1 objects of unknown type 'Windmill'"));
  EXPECT_TRUE(has_note(model, "1 interior objects (BuildingFurniture)"));
}

TEST(SceneCityGml, ReliefOfTriangles) {
  const auto relief = [](const std::string& lod, const std::string& more = {}) {
    return element(
        "dem:reliefComponent",
        element("dem:TINRelief",
                element("dem:lod", lod) + more +
                    element("dem:tin",
                            element("gml:TriangulatedSurface",
                                    element("gml:trianglePatches",
                                            element("gml:Triangle",
                                                    element("gml:exterior", ring(triangle)))))),
                "gml:id=\"tin_" + lod + "\""));
  };
  const auto names = [&](const std::string& components) {
    return read_text(
               "relief.gml",
               city_gml(member(element("dem:ReliefFeature", element("dem:lod", "2") + components))))
        .object_names;
  };
  const auto model =
      read_text("relief.gml", city_gml(member(element("dem:ReliefFeature", relief("2")))));
  EXPECT_EQ(model.object_kinds, std::vector<std::string>{"TINRelief"});
  EXPECT_EQ(model.facts[0].surface, Surface::ground);
  EXPECT_EQ(names(relief("1") + relief("2")), std::vector<std::string>{"tin_2"});
  const auto extent = element("dem:extent", polygon(triangle));
  EXPECT_EQ(names(relief("1", extent) + relief("2")), (std::vector<std::string>{"tin_1", "tin_2"}));
}

TEST(SceneCityGml, RoomsAndWhatHasEndedAreLeftOut) {
  const auto surface = element("bldg:lod4MultiSurface", multi_surface({polygon(triangle)}));
  const auto model = read_text(
      "inside.gml",
      city_gml(building("b", surface + element("bldg:interiorRoom", element("bldg:Room", surface)) +
                                 element("bldg:outerBuildingInstallation",
                                         element("bldg:BuildingInstallation", surface,
                                                 "gml:id=\"balcony\""))) +
               building("gone", element("core:terminationDate", "2015-01-01") + surface) +
               building("here", element("core:terminationDate", "9999-12-31") + surface)));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"balcony", "b", "here"}));
  EXPECT_TRUE(has_note(model, "1 interior objects (Room)"));
  EXPECT_TRUE(has_note(model, "1 objects that have an end"));
}

TEST(SceneCityGml, ImplicitGeometriesStandWhereTheyAre) {
  const auto tree = [](const std::string& geometry, const std::string& matrix,
                       const std::string& at) {
    return member(
        element("veg:SolitaryVegetationObject",
                element("veg:lod2ImplicitRepresentation",
                        element("core:ImplicitGeometry",
                                element("core:transformationMatrix", matrix) + geometry +
                                    element("core:referencePoint",
                                            element("gml:Point", element("gml:pos", at)))))));
  };
  const auto model = read_text(
      "trees.gml", city_gml(tree(element("core:relativeGMLGeometry",
                                         element("gml:MultiSurface",
                                                 surface_members({polygon("0 0 0 1 0 0 0 1 0")}),
                                                 "gml:id=\"shape\"")),
                                 "2 0 0 0 0 2 0 0 0 0 3 1 0 0 0 1", "100 200 10") +
                            tree(link("core:relativeGMLGeometry", "shape"),
                                 "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "0 0 0") +
                            tree(element("core:libraryObject", "tree.wrl"),
                                 "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "0 0 0")));
  ASSERT_EQ(model.polygon_count(), 2u);
  EXPECT_EQ(corner(model, 0, 0, 1), (Vec3{102, 200, 11}));
  EXPECT_EQ(corner(model, 1, 0, 1), (Vec3{-1, 0, 0}));  // a mirror image, which still looks up
  EXPECT_EQ(corner(model, 1, 0, 0), (Vec3{0, 1, 0}));
  EXPECT_EQ(model.object_names,
            (std::vector<std::string>{"SolitaryVegetationObject_1", "SolitaryVegetationObject_2"}));
  EXPECT_TRUE(has_note(model, "1 implicit geometries of library files"));
  EXPECT_EQ(broken_arrays(model), "");
}

TEST(SceneCityGml, Version3) {
  const auto boundary = [](const std::string& type, const std::string& inside) {
    return element("core:boundary",
                   element(type, element("core:lod2MultiSurface", multi_surface({inside}))));
  };
  const auto model = read_text(
      "v3.gml",
      city_gml(
          building("b",
                   boundary("con:WallSurface", polygon(triangle)) +
                       element("core:boundary",
                               element("con:RoofSurface",
                                       element("core:lod2MultiSurface",
                                               multi_surface({polygon(other_triangle)})) +
                                           element("con:fillingSurface",
                                                   element("con:WindowSurface",
                                                           element("core:lod2MultiSurface",
                                                                   multi_surface({polygon(
                                                                       "3 0 5 4 0 5 3 1 5")})))))) +
                       element("core:lod1Solid", box_solid(0, 0, 0, 1, 1, 1)) +
                       element("bldg:buildingRoom", element("bldg:BuildingRoom", "")) +
                       element("bldg:buildingInstallation",
                               element("bldg:BuildingInstallation",
                                       element("con:relationToConstruction", "inside")))) +
              member(element(
                  "tran:Road",
                  element(
                      "tran:section",
                      element(
                          "tran:Section",
                          element("tran:trafficSpace",
                                  element("tran:TrafficSpace",
                                          element("core:lod2Solid", box_solid(0, 0, 0, 9, 9, 4)) +
                                              boundary("tran:TrafficArea", polygon(triangle)))))),
                  "gml:id=\"road\"")),
          "", "3.0"));
  EXPECT_EQ(surfaces_of(model),
            (std::vector<Surface>{Surface::wall, Surface::roof, Surface::window, Surface::ground}));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"b", "road"}));
  EXPECT_TRUE(has_note(model, "1 interior objects (BuildingRoom)"));
  EXPECT_TRUE(has_note(model, "1 interior objects (BuildingInstallation)"));
}

TEST(SceneCityGml, GroupsLeaveTheirMembersAlone) {
  const auto geometry = element("grp:geometry", multi_surface({polygon(triangle)}));
  const auto model = read_text(
      "groups.gml",
      city_gml(building("b", element("bldg:lod1MultiSurface", multi_surface({polygon(triangle)}))) +
               member(element("grp:CityObjectGroup", geometry + link("grp:groupMember", "b"),
                              "gml:id=\"full\"")) +
               member(element("grp:CityObjectGroup", geometry, "gml:id=\"empty\""))));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"b", "empty"}));
  EXPECT_TRUE(has_note(model, "1 geometries of groups left out"));
}

TEST(SceneCityGml, MaterialsByTarget) {
  const auto material = [](const std::string& name, const std::string& colour,
                           const std::string& targets, const std::string& more = {}) {
    return element("app:surfaceDataMember",
                   element("app:X3DMaterial", element("gml:name", name) + more +
                                                  element("app:diffuseColor", colour) + targets));
  };
  const auto appearance = [](const std::string& theme, const std::string& data) {
    return element("core:appearanceMember",
                   element("app:Appearance", element("app:theme", theme) + data));
  };
  const auto target = [](const std::string& id) { return element("app:target", "#" + id); };
  const auto model = read_text(
      "colours.gml",
      city_gml(
          appearance("winter", material("snow", "0.9 0.9 0.9", target("a") + target("c"))) +
          appearance(
              "summer",
              material("brick", "0.4 0.2 0.3", target("a"), element("app:transparency", " 0.25 ")) +
                  material("glass", "0.4 0.4 0.4", target("nobody"),
                           element("app:transparency", "0.9")) +
                  material("paint", "0.5 0.5 0.5", target("all"),
                           element("app:transparency", "0.0")) +
                  material("back", "0.1 0.1 0.1", target("b"), element("app:isFront", "false")) +
                  element("app:surfaceDataMember", element("app:ParameterizedTexture", ""))) +
          building("b", element("bldg:lod2MultiSurface",
                                element("gml:MultiSurface",
                                        surface_members({polygon(triangle, "a"),
                                                         polygon(other_triangle, "b"),
                                                         polygon("0 0 9 1 0 9 0 1 9", "c")}),
                                        "gml:id=\"all\"")))));
  ASSERT_EQ(model.polygon_count(), 3u);
  const auto name = [&](std::size_t p) {
    return model.materials[model.facts[p].material.index()].name;
  };
  EXPECT_EQ(name(0), "brick");  // of summer, which comes first in the alphabet
  EXPECT_EQ(name(1), "paint");  // of what it is a member of
  EXPECT_EQ(name(2), "snow");
  EXPECT_NEAR(model.materials[model.facts[0].material.index()].diffuse.value_or(0), 0.3, 1e-12);
  EXPECT_TRUE(has_note(model, "material theme 'summer' taken"));
  EXPECT_TRUE(has_note(model, "1 textures ignored"));
  EXPECT_TRUE(has_note(model, "1 materials of backs"));
  EXPECT_TRUE(has_note(model, "1 transparencies of materials ignored"));
}

}  // namespace
}  // namespace sunload
