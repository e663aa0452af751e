// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Houses made higher, and bodies that are added: closed, of the volume that they should have.
#include "geo/edit/raise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/edit/solids.h"
#include "geo/mesh/mesh_prepare.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double rounding = 1e-9;  // of sums of some hundred products of numbers up to 1000

/// 10 m by 6 m, eaves at 5 m, ridge at 8 m along x; a window in its front.
constexpr double volume_of_house = 10 * 6 * 5 + 10 * 6 * 3 / 2.0;
ModelBuilder house() {
  const Vec3 a{0, 0, 0}, b{10, 0, 0}, c{10, 6, 0}, d{0, 6, 0}, e{0, 0, 5}, f{10, 0, 5}, g{10, 6, 5},
      h{0, 6, 5}, r{0, 3, 8}, s{10, 3, 8};
  const std::vector<Vec3> window{{4, 0, 1}, {6, 0, 1}, {6, 0, 3}, {4, 0, 3}};
  ModelBuilder builder;
  builder.object("house")
      .polygon({{d, c, b, a}})
      .polygon({{a, b, f, e}, {window.rbegin(), window.rend()}})
      .polygon({{b, c, g, s, f}})
      .polygon({{c, d, h, g}})
      .polygon({{d, a, e, r, h}})
      .polygon({{e, f, s, r}})
      .polygon({{g, h, r, s}})
      .with(Surface::window)
      .polygon({window});
  return builder;
}

PrepareReport report_of(const PolygonModel& model) { return prepare(model, {}).report; }

void expect_closed(const PolygonModel& model, std::size_t bodies, double volume) {
  const PrepareReport report = report_of(model);
  EXPECT_EQ(report.closed_bodies, bodies);
  EXPECT_EQ(report.open_sheets, 0u);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.nonmanifold_edges, 0u);
  EXPECT_EQ(report.triangles_flipped, 0u);
  EXPECT_NEAR(report.volume_m3, volume, rounding * volume);
}

double highest_of(const PolygonModel& model, Surface surface) {
  double highest = -1e9;
  for (const LooseFace& face : faces_of(model, make_id<ObjectId>(0)))
    if (face.facts.surface == surface)
      for (const Vec3 v : face.rings[0]) highest = std::max(highest, v.z);
  return highest;
}

/// Height ranges of an object that stands from `low` to `high` beside a body raised from 5 m on.
std::pair<double, double> lifted(ModelBuilder builder, double by_m) {
  PolygonModel model = builder.model();
  RaisedObject body;
  body.level_m = 5;
  lift_with(model, make_id<ObjectId>(0), body, by_m);
  const Box box = extents_of(model)[0].box;
  return {box.low.z, box.high.z};
}

TEST(Raise, LiftsWhatSitsOnABody) {
  using Range = std::pair<double, double>;
  const auto box = [](double low, double high) {
    ModelBuilder builder;
    builder.object("chimney").box({0, 0, low}, {1, 1, high});
    return builder;
  };
  EXPECT_EQ(lifted(box(5, 7), 3), (Range{8, 10}));
  EXPECT_EQ(lifted(box(1, 4), 3), (Range{1, 4}));
  EXPECT_EQ(lifted(box(1, 7), 3), (Range{1, 10})) << "walls are extended";
  EXPECT_EQ(lifted(box(5, 7), -2), (Range{3, 5}));
  EXPECT_EQ(lifted(box(4, 7), -4), (Range{0, 3})) << "no wall is left to be shortened";
  const auto leaning = [](double low, double high) {
    ModelBuilder builder;
    builder.object("awning").ring({{0, 0, high}, {1, 0, high}, {1, 1, low}, {0, 1, low}});
    return builder;
  };
  EXPECT_EQ(lifted(leaning(4.8, 6), 3), (Range{7.8, 9})) << "what leans is lifted whole";
  EXPECT_EQ(lifted(leaning(3, 5.5), 3), (Range{3, 5.5}));
}

TEST(Raise, LiftsTheRoofWholeAndExtendsTheWalls) {
  PolygonModel model = house().model();
  expect_closed(model, 1, volume_of_house);
  const auto raised = raise_object(model, make_id<ObjectId>(0), 6.5, {});
  EXPECT_EQ(raised.refusal, "");
  EXPECT_NEAR(raised.cut_m, 5, rounding);
  EXPECT_EQ(raised.windows_cut, 0u);
  expect_closed(model, 1, volume_of_house + 10 * 6 * 6.5);
  EXPECT_EQ(highest_of(model, Surface::other), 14.5);
  EXPECT_EQ(highest_of(model, Surface::window), 3);  // windows stay where they are
}

TEST(Raise, CutsWhereItIsTold) {
  PolygonModel model = house().model();
  const auto raised = raise_object(model, make_id<ObjectId>(0), 2, 2);
  EXPECT_EQ(raised.windows_cut, 1u);
  EXPECT_EQ(highest_of(model, Surface::window), 5);
  expect_closed(model, 1, volume_of_house + 10 * 6 * 2);
}

TEST(Raise, LowersAsFarAsThereIsWall) {
  PolygonModel model = house().model();
  EXPECT_EQ(raise_object(model, make_id<ObjectId>(0), -1.5, {}).refusal, "");
  expect_closed(model, 1, volume_of_house - 10 * 6 * 1.5);
  const auto too_far = raise_object(model, make_id<ObjectId>(0), -0.5, {});  // onto the window
  EXPECT_NE(too_far.refusal, "");
  expect_closed(model, 1, volume_of_house - 10 * 6 * 1.5);
}

TEST(Raise, RefusesWhatHasNoWallToExtend) {
  PolygonModel model = ModelBuilder()
                           .object("tent")
                           .polygon({{{0, 6, 0}, {10, 6, 0}, {10, 0, 0}, {0, 0, 0}}})
                           .polygon({{{0, 0, 0}, {10, 0, 0}, {10, 3, 8}, {0, 3, 8}}})
                           .polygon({{{10, 6, 0}, {0, 6, 0}, {0, 3, 8}, {10, 3, 8}}})
                           .polygon({{{10, 0, 0}, {10, 6, 0}, {10, 3, 8}}})
                           .polygon({{{0, 6, 0}, {0, 0, 0}, {0, 3, 8}}})
                           .object("plate")
                           .polygon({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}})
                           .model();
  const PolygonModel before = model;
  EXPECT_EQ(raise_object(model, make_id<ObjectId>(0), 3, {}).refusal, "begins to rise at its foot");
  EXPECT_EQ(raise_object(model, make_id<ObjectId>(0), 3, 4).refusal, "has a roof that from_m cuts");
  EXPECT_EQ(raise_object(model, make_id<ObjectId>(1), 3, {}).refusal, "has no roof");
  EXPECT_EQ(model.vertices, before.vertices);
  EXPECT_EQ(model.ring_vertex, before.ring_vertex);
}

/// A box with a roof slab of 30 cm that sticks out by 1 m all around, and a balcony below.
TEST(Raise, TakesWhatHangsUnderTheRoofAlongAndLeavesBalconies) {
  ModelBuilder builder;
  const auto ring = [](double out, double z) {
    return std::vector<Vec3>{
        {-out, -out, z}, {10 + out, -out, z}, {10 + out, 10 + out, z}, {-out, 10 + out, z}};
  };
  const auto reversed = [](std::vector<Vec3> list) {
    std::reverse(list.begin(), list.end());
    return list;
  };
  builder.object("house").polygon({reversed(ring(0, 0))}).polygon({ring(1, 9.3)});
  builder.polygon({reversed(ring(1, 9)), ring(0, 9)});  // soffit
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    builder.polygon({{ring(0, 0)[i], ring(0, 0)[j], ring(0, 9)[j], ring(0, 9)[i]}});
    builder.polygon({{ring(1, 9)[i], ring(1, 9)[j], ring(1, 9.3)[j], ring(1, 9.3)[i]}});
  }
  PolygonModel model = builder.model();
  RaisedObject body;
  body.level_m = 5;
  add_prism(model, {rectangle_in_plan({5, -1.6}, 3, 1, 0)}, 3, 3.2, {"balcony", "", ""});
  expect_closed(model, 2, 10 * 10 * 9 + 12 * 12 * 0.3 + 3 * 0.2);
  const auto faces = faces_of(model, make_id<ObjectId>(0));
  EXPECT_NEAR(eaves_of(faces).value_or(0), 9, rounding);
  EXPECT_EQ(raise_object(model, make_id<ObjectId>(0), 3, {}).refusal, "");
  expect_closed(model, 2, 10 * 10 * 12 + 12 * 12 * 0.3 + 3 * 0.2);
}

// --- houses in a row, whose party walls are in no model ---------------------------------

/// 6 m along x, 10 m along y and 6 m high: floor, roof, and walls to the south and north alone.
ModelBuilder terraced() {
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {6, 10, 6});
  ModelBuilder builder;
  builder.object("b");
  for (std::size_t k = 0; k < 4; ++k) builder.ring(faces[k]);
  return builder;
}

struct Walls {
  double area_m2 = 0;  ///< of upright faces
  Vec3 sum;            ///< of their area vectors
};
Walls walls_of(const PolygonModel& model) {
  Walls walls;
  for (const LooseFace& face : faces_of(model, make_id<ObjectId>(0))) {
    const Vec3 area = area_vector2(face) / 2;
    if (std::abs(area.z) > rounding) continue;
    walls.area_m2 += norm(area);
    walls.sum += area;
  }
  return walls;
}
struct Grown {
  RaisedObject raised;
  double wall_m2;  ///< by so much the walls have grown
  Vec3 sum;
};
Grown grown(ModelBuilder builder, double by_m, std::optional<double> cut_m = {}) {
  PolygonModel model = builder.model();
  const Walls before = walls_of(model);
  const RaisedObject raised = raise_object(model, make_id<ObjectId>(0), by_m, cut_m);
  EXPECT_EQ(raised.refusal, "");
  const Walls after = walls_of(model);
  return {raised, after.area_m2 - before.area_m2, after.sum - before.sum};
}
void expect_lengths(const RaisedObject& raised, double outline, double bare, double added) {
  constexpr double in_cm = 0.02;  // joints closer than a centimetre are one
  EXPECT_NEAR(raised.outline_m, outline, in_cm);
  EXPECT_NEAR(raised.bare_m, bare, in_cm);
  EXPECT_NEAR(raised.added_m, added, in_cm);
}

TEST(RaiseInARow, AddsTheWallsThatAreInNoModel) {
  const Grown b = grown(terraced(), 6);
  expect_lengths(b.raised, 32, 20, 20);
  EXPECT_NEAR(b.wall_m2, 32 * 6, rounding);
  EXPECT_NEAR(norm(b.sum), 0, rounding) << "their fronts are outward";
  // As high as what they close, of the kind of walls, the object's own.
  PolygonModel model = terraced().model();
  raise_object(model, make_id<ObjectId>(0), 6, {});
  const auto faces = faces_of(model, make_id<ObjectId>(0));
  ASSERT_EQ(faces.size(), 6u);
  for (std::size_t f = 4; f < 6; ++f) {
    EXPECT_EQ(faces[f].facts.surface, Surface::wall);
    for (const Vec3 v : faces[f].rings[0]) EXPECT_TRUE(v.z == 6 || v.z == 12);
  }
}

TEST(RaiseInARow, AddsNothingToClosedHouses) {
  expect_lengths(grown(house(), 3).raised, 0, 0, 0);
  ModelBuilder in_parts;  // corners of the roof in the middle of the walls' edges
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {6, 10, 6});
  in_parts.object("a");
  for (std::size_t k = 0; k < 6; ++k)
    if (k != 1) in_parts.ring(faces[k]);
  in_parts.ring({{0, 0, 6}, {6, 0, 6}, {6, 4, 6}, {0, 4, 6}});
  in_parts.ring({{0, 4, 6}, {6, 4, 6}, {6, 10, 6}, {0, 10, 6}});
  const Grown a = grown(in_parts, 6);
  expect_lengths(a.raised, 32, 0, 0);
  EXPECT_NEAR(a.wall_m2, 32 * 6, rounding);
}

TEST(RaiseInARow, LeavesOutWhatHasAWall) {
  // A neighbour that is less deep and 4 m high: the wall above and beside it.
  ModelBuilder builder = terraced();
  builder.ring({{6, 4, 0}, {6, 10, 0}, {6, 10, 6}, {6, 4, 6}});
  expect_lengths(grown(builder, 6).raised, 32, 14, 14);
  builder.ring({{6, 0, 4}, {6, 4, 4}, {6, 4, 6}, {6, 0, 6}});
  const Grown b = grown(builder, 6);
  expect_lengths(b.raised, 32, 10, 10);
  EXPECT_NEAR(b.wall_m2, 32 * 6, rounding);
}

TEST(RaiseInARow, FollowsTheRoofOfTheNeighbour) {
  // The neighbour's roof rises from 4 m in the south to 8 m in the north; the house has 8 m.
  ModelBuilder builder;
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {6, 10, 9});
  builder.object("b");
  for (std::size_t k = 0; k < 5; ++k) builder.ring(faces[k]);
  builder.ring({{6, 0, 4}, {6, 10, 8}, {6, 10, 9}, {6, 0, 9}});
  const Grown b = grown(builder, 6, 6);
  EXPECT_NEAR(b.wall_m2, 32 * 6, rounding);
  EXPECT_NEAR(norm(b.sum), 0, rounding);
}

TEST(RaiseInARow, ClosesBelowGablesAndSlopesOfRoofs) {
  // Eaves at 5 m, ridge at 8 m; to the east what a neighbour of 6 m leaves free of the gable.
  ModelBuilder builder;
  builder.object("b")
      .ring({{0, 6, 0}, {10, 6, 0}, {10, 0, 0}, {0, 0, 0}})
      .ring({{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}})
      .ring({{10, 6, 0}, {0, 6, 0}, {0, 6, 5}, {10, 6, 5}})
      .ring({{0, 0, 5}, {10, 0, 5}, {10, 3, 8}, {0, 3, 8}})
      .ring({{10, 6, 5}, {0, 6, 5}, {0, 3, 8}, {10, 3, 8}})
      .ring({{10, 1, 6}, {10, 5, 6}, {10, 3, 8}});
  const Grown b = grown(builder, 3);
  expect_lengths(b.raised, 32, 12, 12);
  EXPECT_NEAR(b.wall_m2, 32 * 3, rounding);
  EXPECT_NEAR(norm(b.sum), 0, rounding);
}

TEST(RaiseInARow, AddsNothingAtStepsOfTheRoofNorAboveHolesThatOthersFill) {
  // Two roofs, 2 m apart in height, with no wall between them; a hole for a dormer.
  ModelBuilder builder;
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {6, 10, 6});
  builder.object("b");
  for (std::size_t k = 0; k < 4; ++k)
    if (k != 1) builder.ring(faces[k]);
  builder.polygon(
      {{{0, 0, 6}, {6, 0, 6}, {6, 5, 6}, {0, 5, 6}}, {{2, 2, 6}, {2, 3, 6}, {4, 3, 6}, {4, 2, 6}}});
  builder.ring({{0, 5, 8}, {6, 5, 8}, {6, 10, 8}, {0, 10, 8}});
  // The northern wall ends below its roof, and so does what is added there: it hung in the air.
  const Grown b = grown(builder, 3);
  expect_lengths(b.raised, 32, 20, 20);
  EXPECT_NEAR(b.wall_m2, 32 * 3, rounding);
}

TEST(RaiseInARow, ClosesCourts) {
  ModelBuilder builder;
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {10, 10, 6});
  builder.object("b");
  for (std::size_t k = 2; k < 6; ++k) builder.ring(faces[k]);
  const std::vector<Vec3> court{{3, 3, 0}, {7, 3, 0}, {7, 7, 0}, {3, 7, 0}};
  std::vector<Vec3> above = court;
  for (Vec3& v : above) v.z = 6;
  builder.polygon({faces[0], court});
  builder.polygon({faces[1], {above.rbegin(), above.rend()}});
  const Grown b = grown(builder, 3);
  expect_lengths(b.raised, 40 + 16, 16, 16);
  EXPECT_NEAR(b.wall_m2, (40 + 16) * 3, rounding);
}

TEST(RaiseInARow, AddsNothingWhereHousesAreLowered) {
  const Grown b = grown(terraced(), -2);
  expect_lengths(b.raised, 32, 20, 0);
  EXPECT_NEAR(b.wall_m2, -12 * 2, rounding);
}

TEST(RaiseInARow, TellsOfHousesWithoutAFloorAndKnowsEaves) {
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {6, 10, 6});
  const std::vector<Vec3> wide{{-1, -1, 6}, {7, -1, 6}, {7, 11, 6}, {-1, 11, 6}};
  ModelBuilder open, eaves, on_a_floor;
  open.object("open").with(Surface::wall).ring(faces[2]).ring(faces[3]);
  open.with(Surface::roof).ring(faces[1]);
  expect_lengths(grown(open, 6).raised, 32, 20, 0);
  eaves.object("eaves").with(Surface::wall);
  on_a_floor.object("on_a_floor").with(Surface::wall);
  for (std::size_t k = 2; k < 6; ++k) {
    eaves.ring(faces[k]);
    on_a_floor.ring(faces[k]);
  }
  eaves.with(Surface::roof).ring(wide);
  on_a_floor.with(Surface::floor).ring(faces[0]).with(Surface::roof).ring(wide);
  const Grown of_eaves = grown(eaves, 6), of_both = grown(on_a_floor, 6);
  expect_lengths(of_eaves.raised, 40, 0, 0);
  expect_lengths(of_both.raised, 0, 0, 0);
  EXPECT_NEAR(of_both.wall_m2, 32 * 6, rounding);
}

TEST(Solids, PrismsWithCourtsAreClosed) {
  PolygonModel model;
  PlanArea area = rectangle_in_plan({0, 0}, 20, 10, 0);
  area.push_back(rectangle_in_plan({2, 0}, 6, 4, 30)[0]);
  add_prism(model, {area}, 2, 8, {"block", "Building", "brick"});
  expect_closed(model, 1, (20 * 10 - 6 * 4) * 6);
  EXPECT_EQ(model.object_kinds.front(), "Building");
  EXPECT_TRUE(lies_in({area}, {-8, 0}));
  EXPECT_FALSE(lies_in({area}, {2, 0}));
  // Windings of the file do not matter, nor corners written twice.
  for (auto& ring : area) std::reverse(ring.begin(), ring.end());
  area[0].push_back(area[0].front());
  PolygonModel other;
  add_prism(other, {area}, 2, 8, {"block", "Building", "brick"});
  expect_closed(other, 1, (20 * 10 - 6 * 4) * 6);
}

TEST(Solids, TurnsAreClockwise) {
  const PlanArea area = rectangle_in_plan({1, 2}, 4, 2, 90);
  EXPECT_NEAR(area[0][0].u, 1 - 1, rounding);  // (-2, -1) goes to (-1, 2)
  EXPECT_NEAR(area[0][0].v, 2 + 2, rounding);
}

TEST(Solids, TreesAreClosedAndAsHighAsTheyShould) {
  PolygonModel model;
  add_tree(model, {3, 4, 100},
           {.height_m = 12, .crown_m = 6, .trunk_m = 4, .leaves = "crown", .trunk = "wood"},
           {"tree", "SolitaryVegetationObject", ""});
  const PrepareReport report = report_of(model);
  EXPECT_EQ(report.closed_bodies, 2u);
  EXPECT_EQ(report.open_edges, 0u);
  const ObjectExtent extent = extents_of(model)[0];
  EXPECT_NEAR(extent.box.low.z, 100, rounding);
  EXPECT_NEAR(extent.box.high.z, 112, rounding);
  EXPECT_NEAR(extent.box.high.x - extent.box.low.x, 6, rounding);
  // Its corners lie on the ellipsoid: less volume, by what is between chords and arcs.
  const double ellipsoid = 4.0 / 3 * std::numbers::pi * 3 * 3 * 4;
  EXPECT_LT(report.volume_m3, ellipsoid);
  EXPECT_GT(report.volume_m3, 0.8 * ellipsoid);  // 12 meridians: 0.955, 6 zones: 0.93 at least
  // What is added stands on land where there is some, and else on what is near.
  EXPECT_EQ(standing_height(model, {50, 50}), 100);
  EXPECT_FALSE(standing_height({}, {0, 0}));
}

/// An OBJ file: a sheet of land that rises by a tenth to the east, from x = -50 to 50, and a house
/// on it; nobody says what is what.
PolygonModel unnamed_slope() {
  ModelBuilder builder;
  builder.object("sheet").polygon({{{-50, -50, -5}, {50, -50, 5}, {50, 50, 5}, {-50, 50, -5}}});
  builder.object("house").box({20, 0, 1}, {30, 10, 9});
  return builder.model();
}

TEST(Solids, StandOnLandThatNobodyCallsSo) {
  const PolygonModel model = unnamed_slope();
  EXPECT_NEAR(*standing_height(model, {10, 20}), 1, rounding);
  EXPECT_NEAR(*standing_height(model, {-30, -20}), -3, rounding);
  EXPECT_NEAR(*standing_height(model, {25, 5}), 2.5, rounding);  // below the house
}

TEST(Solids, BesideLandStandAtItsEdgeAndBesideAHouseAtItsFoot) {
  EXPECT_NEAR(*standing_height(unnamed_slope(), {60, 50}), 5, rounding);
  EXPECT_NEAR(*standing_height(unnamed_slope(), {-60, -50}), -5, rounding);
  const PolygonModel house = ModelBuilder().object("house").box({20, 0, 1}, {30, 10, 9}).model();
  EXPECT_NEAR(*standing_height(house, {40, 5}), 1, rounding);
}

TEST(Objects, AreTakenOutWithoutATraceInTheOthers) {
  PolygonModel model = house().model();
  const PolygonModel alone = model;
  add_prism(model, {rectangle_in_plan({30, 0}, 4, 2, 10)}, 0, 3, {"shed", "", "wood"});
  const PolygonModel rest = without_objects(model, {0, 1});
  EXPECT_EQ(rest.object_names, alone.object_names);
  EXPECT_EQ(rest.polygon_count(), alone.polygon_count());
  expect_closed(rest, 1, volume_of_house);
  expect_closed(without_objects(model, {1, 0}), 1, 4 * 2 * 3);
}

TEST(Objects, ArePartedFromWhatTheyTouch) {
  // Two triangles of two objects that share an edge in the file.
  PolygonModel model;
  model.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  model.object_names = {"a", "b"};
  model.add_triangle(0, 1, 2, {.object = make_id<ObjectId>(0)});
  model.add_triangle(0, 2, 3, {.object = make_id<ObjectId>(1)});
  displace_objects(model, {0, 1}, [](Vec3 p) { return p + Vec3{0, 5, 0}; });
  const auto a = faces_of(model, make_id<ObjectId>(0)), b = faces_of(model, make_id<ObjectId>(1));
  EXPECT_EQ(a[0].rings[0][2], (Vec3{1, 1, 0}));
  EXPECT_EQ(b[0].rings[0][1], (Vec3{1, 6, 0}));
}

}  // namespace
}  // namespace sunload::test
