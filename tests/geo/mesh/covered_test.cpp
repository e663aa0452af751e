// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces inside of bodies, against others and below land are found and cut out exactly.
#include "geo/mesh/covered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "geo/base/units.h"
#include "geo/mesh/slope.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double rounding = 1e-6;  // m2, of areas of some hundred

struct Cut {
  PreparedMesh p;
  CoveredCut cut;
  double covered(const std::string& object, Surface kind) const {
    double sum = 0;
    for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t)
      if (p.mesh.object_names[p.mesh.triangle_object[t].index()] == object &&
          p.mesh.triangle_surface[t] == kind && p.mesh.is_covered(t))
        sum += p.mesh.area_m2(t);
    return sum;
  }
};

Cut cut(const ModelBuilder& builder, PrepareRules rules = {},
        const std::string& transparent_object = "", Cavities cavities = Cavities::lit) {
  Cut result{builder.prepared(rules), {}};
  Mesh& mesh = result.p.mesh;
  std::vector<std::uint8_t> is_opaque;
  for (const auto object : mesh.triangle_object)
    is_opaque.push_back(mesh.object_names[object.index()] != transparent_object);
  const double before = area(mesh);
  result.cut = cut_covered(mesh, result.p.bodies, is_opaque, result.p.seals, {}, cavities);
  EXPECT_NEAR(area(mesh) + result.cut.taken.area_m2, before, rounding);  // nothing is lost
  EXPECT_EQ(result.cut.source.size(), mesh.triangle_count());
  EXPECT_EQ(result.p.bodies.triangle_body.size(), mesh.triangle_count());
  measure(mesh, result.p.report);
  return result;
}

double all_covered(const Cut& c) {
  double sum = 0;
  for (const double m2 : c.p.report.covered_m2) sum += m2;
  return sum;
}

/// Any place and direction: nothing may depend on the axes.
Vec3 turned(Vec3 v) {
  const double c = std::cos(0.37), s = std::sin(0.37);
  return {c * v.x - s * v.y + 31, s * v.x + c * v.y - 17, v.z};
}

ModelBuilder terrace(double gap) {
  auto builder = ModelBuilder().object("low").box({0, 0, 0}, {10, 10, 6});
  builder.object("high").box({10 + gap, -2, 0}, {20, 9, 11});
  builder.moved(turned);
  return builder;
}

TEST(Covered, PartyWallsAreCutWhereTheyMeet) {
  const auto c = cut(terrace(0));
  // y from 0 to 9, z from 0 to 6 of both walls.
  EXPECT_NEAR(c.covered("low", Surface::wall), 54, rounding);
  EXPECT_NEAR(c.covered("high", Surface::wall), 54, rounding);
  EXPECT_NEAR(all_covered(c), 108, rounding);
  EXPECT_GT(c.cut.cut, 0u);
}

TEST(Covered, WallsRoundedToAMillimetreTouchAndAJointIsOpen) {
  EXPECT_NEAR(all_covered(cut(terrace(0.001))), 108, 0.1);
  EXPECT_EQ(cut(terrace(0.005)).cut.covered, 0u);
}

TEST(Covered, WhereNothingIsNothingChanges) {
  const auto builder = terrace(3);
  const auto before = builder.prepared();
  const auto c = cut(builder);
  EXPECT_EQ(c.p.mesh.vertices, before.mesh.vertices);
  EXPECT_EQ(c.p.mesh.triangles, before.mesh.triangles);
  EXPECT_TRUE(c.p.mesh.triangle_covered.empty());
  EXPECT_EQ(c.cut.covered, 0u);
}

TEST(Covered, FacadesLoseWhatIsCoveredAndGoWhereNothingIsLeft) {
  auto builder = ModelBuilder().object("low").box({0, 0, 0}, {10, 10, 6});
  builder.object("high").box({10, 0, 0}, {20, 10, 11});
  const auto c = cut(builder);
  std::map<std::string, double> facades;
  for (const auto& f : c.p.mesh.facades) facades[f.name] = f.area_m2;
  EXPECT_EQ(facades.size(), 7u);
  EXPECT_EQ(facades.count("low/east_1"), 0u);
  EXPECT_NEAR(facades.at("high/west_1"), 50, rounding);
  EXPECT_NEAR(facades.at("high/east_1"), 110, rounding);
  for (const FacadeId facade : c.p.mesh.triangle_facade) {
    if (!facade.exists()) continue;
    EXPECT_LT(facade.index(), c.p.mesh.facades.size());
  }
}

TEST(Covered, ABodyInsideOfAnotherIsCoveredAsAWhole) {
  auto builder = ModelBuilder().object("outer").box({0, 0, 0}, {10, 10, 10});
  builder.object("inner").box({2, 3, 4}, {5, 6, 7});
  builder.moved(turned);
  const auto c = cut(builder);
  EXPECT_NEAR(all_covered(c), 54, rounding);
  EXPECT_EQ(c.cut.cut, 0u);
  // Behind a veil it is lit.
  EXPECT_EQ(cut(builder, {}, "outer").cut.covered, 0u);
}

TEST(Covered, ACavityIsNotCovered) {
  auto builder = ModelBuilder().object("shell").box({0, 0, 0}, {10, 10, 10});
  for (auto face : ModelBuilder::box_faces({2, 2, 2}, {8, 8, 8})) {
    std::reverse(face.begin(), face.end());
    builder.ring(face);
  }
  builder.object("lamp").box({4, 4, 4}, {5, 5, 5});
  EXPECT_EQ(cut(builder).cut.covered, 0u);
  // Where no lamp is, nothing lights it, nor what stands in it.
  EXPECT_NEAR(all_covered(cut(builder, {}, "", Cavities::dark)), 216 + 6, rounding);
}

using Boxes = std::vector<std::array<Vec3, 2>>;

ModelBuilder boxes_of_objects(const Boxes& boxes, bool are_one) {
  ModelBuilder builder;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i == 0 || !are_one) builder.object("box " + std::to_string(i));
    builder.box(boxes[i][0], boxes[i][1]);
  }
  return builder.moved(turned);
}

double visible(const Cut& c, Surface kind) {
  return area_of(c.p, kind) - c.p.report.covered_m2[static_cast<std::size_t>(kind)];
}

TEST(Covered, SolidsOfOneObjectThatShareAnEdgeAreSeenAsThoseOfSeveral) {
  const Boxes row{{{{0, 0, 0}, {10, 8, 6}}},
                  {{{10, 0, 0}, {16, 8, 4}}},
                  {{{16, 0, 0}, {21, 8, 9}}},
                  {{{21, 0, 0}, {28, 8, 5}}}};
  const Boxes penthouse{{{{0, 0, 0}, {10, 12, 6}}}, {{{2, 0, 6}, {8, 5, 9}}}};
  const Boxes corner{{{{0, 0, 0}, {10, 12, 6}}}, {{{0, 0, 6}, {4, 5, 9}}}};
  for (Boxes boxes : {row, penthouse, corner})
    for (int order = 0; order < 2; ++order) {
      std::ranges::reverse(boxes);
      const auto apart = cut(boxes_of_objects(boxes, false)),
                 one = cut(boxes_of_objects(boxes, true));
      EXPECT_EQ(one.p.report.open_sheets, 0u);
      EXPECT_EQ(one.p.report.triangles_flipped, 0u);
      for (const Surface kind : {Surface::wall, Surface::roof})
        EXPECT_NEAR(visible(one, kind), visible(apart, kind), rounding);
    }
}

TEST(Covered, TheSidesOfASheetOnABodyAreOpen) {
  auto builder = ModelBuilder().object("house");
  const auto box = ModelBuilder::box_faces({0, 0, 0}, {10, 10, 4});
  for (const std::size_t face : {0u, 4u, 5u}) builder.ring(box[face]);
  for (const double x : {0.0, 5.0}) {
    const auto half = ModelBuilder::box_faces({x, 0, 0}, {x + 5, 10, 4});
    for (const std::size_t face : {1u, 2u, 3u}) builder.ring(half[face]);
  }
  // A parapet without thickness, its sides divided in different ways.
  builder.ring({{5, 0, 4}, {5, 10, 4}, {5, 10, 5.5}, {5, 0, 5.5}});
  builder.ring({{5, 0, 5.5}, {5, 10, 5.5}, {5, 10, 7}, {5, 0, 7}});
  builder.ring({{5, 0, 4}, {5, 0, 5.5}, {5, 0, 7}, {5, 10, 7}, {5, 10, 5.5}, {5, 10, 4}});
  EXPECT_EQ(cut(builder).cut.covered, 0u);
}

TEST(Covered, WhatTwoBodiesCoverMeetsAtALineInTheMiddle) {
  // Half of a wall is against one body and half inside of another.
  for (int tens = 0; tens < 9; ++tens) {
    const double angle = tens * pi / 18, c = std::cos(angle), s = std::sin(angle);
    auto builder = ModelBuilder().object("h").box({4, 5, 0}, {8, 7, 2});
    builder.object("w").box({0, 3, 0}, {4, 6, 2});
    builder.object("n").box({2, 6, 0}, {6, 9, 1});
    builder.moved([&](Vec3 v) { return Vec3{c * v.x - s * v.y, s * v.x + c * v.y, v.z}; });
    const auto found = cut(builder);
    EXPECT_NEAR(visible(found, Surface::wall) + visible(found, Surface::roof), 82, rounding)
        << tens;
  }
}

TEST(Covered, OverlappingBodiesLoseWhatIsInTheOther) {
  auto builder = ModelBuilder().object("a").box({0, 0, 0}, {10, 10, 10});
  builder.object("b").box({6, -3, 2}, {14, 4, 20});
  builder.moved(turned);
  const auto c = cut(builder);
  // In b of a: roof 4 × 4, sides x = 10 and y = 0. In a of b: bottom 4 × 4 and two sides.
  EXPECT_NEAR(c.covered("a", Surface::roof), 16, rounding);
  EXPECT_NEAR(c.covered("a", Surface::wall), 32 + 32, rounding);
  EXPECT_NEAR(c.covered("b", Surface::wall), 32 + 32, rounding);
  EXPECT_NEAR(c.covered("b", Surface::other), 16, rounding);
}

TEST(Covered, BelowLandIsCovered) {
  auto builder = ModelBuilder().city().object("hill", "TINRelief");
  const auto land = [](double x, double y) { return Vec3{x, y, 1 + 0.2 * x}; };
  builder.ring({land(-50, -50), land(50, -50), land(50, 50), land(-50, 50)});
  builder.object("house", "Building").box({0, 0, 0}, {10, 10, 8});
  builder.object("deck", "Road").ring({{-20, -20, 7}, {-10, -20, 7}, {-10, 20, 7}, {-20, 20, 7}});
  builder.object("under the deck", "Building").box({-18, 0, 2}, {-12, 4, 5});
  const auto c = cut(builder);
  // Land beside the house is 1 to 3 m high: walls x = 0, x = 10, and two of a mean of 2 m.
  EXPECT_NEAR(c.covered("house", Surface::wall), 10 * (1 + 3 + 2 + 2), rounding);
  // Of the land what is in the house: all, since its roof is above.
  EXPECT_NEAR(c.covered("hill", Surface::ground), 100 * std::sqrt(1.04), rounding);
  EXPECT_EQ(c.covered("under the deck", Surface::wall), 0);
}

// Tiles of land end at the walls, or up to 3 mm before or behind them, and go on below the house or
// not.
TEST(Covered, BelowLandThatEndsAtTheWallIsCovered) {
  for (const double beside : {0.0, 0.001, -0.001, 0.003})
    for (const bool has_hole : {false, true}) {
      auto builder = ModelBuilder().city().object("land", "LandUse");
      const std::array ends{-50.0, -beside, 10 + beside, 60.0};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          if (!has_hole || i != 1 || j != 1)
            builder.ring({{ends[i], ends[j], 0},
                          {ends[i + 1], ends[j], 0},
                          {ends[i + 1], ends[j + 1], 0},
                          {ends[i], ends[j + 1], 0}});
      builder.object("house", "Building").box({0, 0, -8}, {10, 10, 6});
      const auto c = cut(builder);
      EXPECT_NEAR(c.covered("house", Surface::wall), 4 * 10 * 8, rounding)
          << beside << " " << has_hole;
      EXPECT_NEAR(c.covered("land", Surface::ground), has_hole ? 0 : 100, 0.1);
    }
}

// Houses without a floor, and such as do not close, have no inside; what they stand on is dark.
TEST(Covered, LandInHousesWithoutAFloorIsCovered) {
  for (const double foot : {0.0, -1.0})
    for (const double apart : {0.0, 0.003}) {
      auto builder = ModelBuilder().object("terrain", "TINRelief");
      builder.ring({{-50, -50, 0}, {60, -50, 0}, {60, 60, 0}, {-50, 60, 0}});
      builder.object("house").walls_and_roof({0, 0, foot}, {10, 10, 6}, apart);
      builder.object("carport").ring({{20, 0, 3}, {25, 0, 3}, {25, 5, 3}, {20, 5, 3}});
      builder.ring({{20, 0, 0}, {20, 0, 3}, {20, 5, 3}, {20, 5, 0}});
      builder.ring({{20, 5, 0}, {20, 5, 3}, {25, 5, 3}, {25, 5, 0}});
      const auto c = cut(builder);
      EXPECT_NEAR(c.covered("terrain", Surface::ground), 100, rounding) << foot << " " << apart;
      EXPECT_NEAR(c.covered("house", Surface::wall), -40 * foot, rounding);
    }
}

// A dormer of the same object whose front ends 2.5 cm above the roof: neither is in the other, but
// the house holds what of its roof lies below the dormer.
TEST(Covered, OfARoofOnlyWhatLiesBelowADormerIsCovered) {
  auto builder = ModelBuilder().object("terrain", "TINRelief");
  builder.ring({{-50, -50, 0}, {60, -50, 0}, {60, 60, 0}, {-50, 60, 0}});
  const std::array<Vec3, 5> gable{Vec3{0, 0, 0}, Vec3{0, 0, 6}, Vec3{0, 4, 9}, Vec3{0, 8, 6},
                                  Vec3{0, 8, 0}};
  const Vec3 along{12, 0, 0};
  builder.object("house").ring({gable[4], gable[3], gable[2], gable[1], gable[0]});
  builder.ring(
      {gable[0] + along, gable[4] + along, gable[3] + along, gable[2] + along, gable[1] + along});
  for (std::size_t k = 0; k + 1 < gable.size(); ++k)
    builder.ring({gable[k], gable[k] + along, gable[k + 1] + along, gable[k + 1]});
  builder.walls_and_roof({4, 0.5, 6.4}, {6, 2.5, 8});
  const auto c = cut(builder);
  const double below = 2 * (2.5 - 4 * 0.4 / 3) * 1.25;  // m2: the roof rises by 3 m in 4 m
  EXPECT_NEAR(c.covered("house", Surface::roof), below, 0.02 * below);  // some mm at its rim
}

// Of rooms, and of passages through houses, which are open at their ends.
TEST(Covered, FloorsAndPassagesAreOpen) {
  auto room = ModelBuilder().object("room").with(Surface::ground);
  room.ring({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}).with(Surface::other);
  room.walls_and_roof({0, 0, 0}, {10, 10, 3});
  EXPECT_EQ(cut(room).covered("room", Surface::ground), 0);
  auto passage = ModelBuilder().object("terrain", "TINRelief");
  passage.ring({{-50, -50, 0}, {60, -50, 0}, {60, 60, 0}, {-50, 60, 0}});
  passage.object("house").ring({{0, 0, 6}, {10, 0, 6}, {10, 10, 6}, {0, 10, 6}});
  for (const double x : {0.0, 10.0}) passage.ring({{x, 0, 0}, {x, 0, 6}, {x, 10, 6}, {x, 10, 0}});
  EXPECT_EQ(cut(passage).covered("terrain", Surface::ground), 0);
}

// A tower in a podium whose roof is divided along the tower's walls.
TEST(Covered, WallsInABodyThatIsDividedAtThemAreCovered) {
  auto builder = ModelBuilder().object("podium");
  builder.ring({{0, 0, 0},
                {0, 10, 0},
                {0, 20, 0},
                {10, 20, 0},
                {20, 20, 0},
                {20, 10, 0},
                {20, 0, 0},
                {10, 0, 0}});
  for (const double x : {0.0, 10.0})
    for (const double y : {0.0, 10.0})
      builder.ring({{x, y, 3}, {x + 10, y, 3}, {x + 10, y + 10, 3}, {x, y + 10, 3}});
  const std::array<Vec3, 5> round{Vec3{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}, {0, 0, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 a = round[k], b = round[k + 1], m = 0.5 * (a + b), up{0, 0, 3};
    builder.ring({a, m, m + up, a + up});
    builder.ring({m, b, b + up, m + up});
  }
  builder.object("tower").box({0.5, 10, 0}, {10, 19.5, 9});
  const auto c = cut(builder);
  EXPECT_EQ(c.p.report.closed_bodies, 2u);
  EXPECT_NEAR(c.covered("tower", Surface::wall), 4 * 9.5 * 3, rounding);
}

// Floors are where land ends, but not those of a garage.
TEST(Covered, LandOverACellarIsOpen) {
  auto builder = ModelBuilder().city().object("terrain", "TINRelief").with(Surface::ground);
  builder.ring({{0, 0, 0}, {60, 0, 0}, {60, 60, 0}, {0, 60, 0}}).with(Surface::other);
  builder.object("garage", "Building").box({5, 5, -6}, {15, 15, -3});
  builder.object("house", "Building").box({25, 25, -1}, {35, 35, 9});
  builder.object("above its cellar", "Building").box({5, 25, 0}, {15, 35, 9});
  builder.object("cellar", "Building").box({5, 25, -3}, {15, 35, -0.5});
  builder.object("hovers", "Building").box({40, 5, 0.3}, {50, 15, 9});
  const auto c = cut(builder, {.ground = GroundRules{5}});
  EXPECT_NEAR(c.covered("terrain", Surface::ground), 3 * 100, rounding);
}

TEST(Covered, RandomBoxesAgreeWithPointsTried) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(0, 10), size(1, 5);
  std::vector<std::array<Vec3, 2>> boxes;
  auto builder = ModelBuilder();
  for (int i = 0; i < 12; ++i) {
    const Vec3 low{at(random), at(random), at(random)};
    boxes.push_back({low, low + Vec3{size(random), size(random), size(random)}});
    builder.object("box_" + std::to_string(i)).box(boxes.back()[0], boxes.back()[1]);
  }
  builder.moved(turned);
  const auto c = cut(builder, {.repair = Repair::safe, .ground = {}});
  EXPECT_GT(c.cut.cut, 10u);
  const double cosine = std::cos(0.37), sine = std::sin(0.37);
  std::uniform_real_distribution<double> share(0, 1);
  std::size_t tried = 0, wrong = 0;
  for (std::size_t t = 0; t < c.p.mesh.triangle_count(); ++t) {
    if (c.p.mesh.triangle_surface[t] == Surface::floor) continue;
    for (int i = 0; i < 20; ++i) {
      double u = share(random), v = share(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 q = c.p.mesh.point(t, u, v) + 1e-3 * c.p.mesh.normal(t) - Vec3{31, -17, 0};
      const Vec3 p{cosine * q.x + sine * q.y, -sine * q.x + cosine * q.y, q.z};
      const bool is_inside = std::any_of(boxes.begin(), boxes.end(), [&](const auto& b) {
        return p.x > b[0].x && p.y > b[0].y && p.z > b[0].z && p.x < b[1].x && p.y < b[1].y &&
               p.z < b[1].z;
      });
      ++tried;
      wrong += is_inside != c.p.mesh.is_covered(t);
    }
  }
  // Points within the millimetre that they are set off by may be on the other side.
  EXPECT_LT(static_cast<double>(wrong), 0.005 * static_cast<double>(tried));
}

/// Of the open triangles that face along `normal`.
double open_area(const Cut& c, Vec3 normal) {
  double sum = 0;
  for (std::size_t t = 0; t < c.p.mesh.triangle_count(); ++t)
    if (c.p.mesh.bears_patches(t) && dot(c.p.mesh.normal(t), normal) > 0.999)
      sum += c.p.mesh.area_m2(t);
  return sum;
}

TEST(Covered, WallsOfTwoBodiesInOnePlaceAreThereOnce) {
  auto builder = ModelBuilder().object("a").box({0, 0, 0}, {10, 10, 6});
  builder.object("b").box({4, 0, 0}, {14, 8, 6});
  builder.moved(turned);
  const auto c = cut(builder);
  // Of y = 0 a has 10 × 6, b the same, and 6 × 6 are of both; of roofs and undersides 100, 80
  // and 48.
  EXPECT_NEAR(c.cut.taken.area_m2, 36 + 48 + 48, rounding);
  EXPECT_NEAR(open_area(c, turned({0, -1, 0}) - turned({0, 0, 0})), 84, rounding);
  EXPECT_NEAR(open_area(c, {0, 0, 1}), 132, rounding);
  for (const auto& f : c.p.mesh.facades) {
    if (f.name.rfind("a/", 0) == 0) continue;
    EXPECT_TRUE(std::abs(f.area_m2 - 24) < rounding || std::abs(f.area_m2 - 48) < rounding ||
                std::abs(f.area_m2 - 36) < rounding)
        << f.name << " " << f.area_m2;  // south, east, north: 10 × 6 less the 6 × 6 inside of a
  }
  EXPECT_EQ(find_doubled(c.p.mesh).area_m2, 0);
}

Cut plates(double z, bool up, Sides sides_of_second, const std::string& transparent = "") {
  auto builder = ModelBuilder().object("first").with(Surface::other);
  builder.ring({{0, 0, 3}, {10, 0, 3}, {10, 10, 3}, {0, 10, 3}});
  builder.object("second").with(Surface::other, sides_of_second);
  std::vector<Vec3> ring{{2, 2, 3 + z}, {5, 2, 3 + z}, {5, 6, 3 + z}, {2, 6, 3 + z}};
  if (!up) std::reverse(ring.begin(), ring.end());
  builder.ring(ring);
  return cut(builder, {.repair = Repair::safe, .ground = {}}, transparent);
}

double cut_area_of(const Cut& c, const std::string& object) {
  double sum = 0;
  for (std::size_t t = 0; t < c.p.mesh.triangle_count(); ++t)
    if (c.p.mesh.object_names[c.p.mesh.triangle_object[t].index()] == object)
      sum += c.p.mesh.area_m2(t);
  return sum;
}

TEST(Covered, OfPlatesInOnePlaceTheFirstStays) {
  const auto c = plates(0, true, Sides::one);
  EXPECT_NEAR(c.cut.taken.area_m2, 12, rounding);
  EXPECT_EQ(cut_area_of(c, "second"), 0);
  EXPECT_NEAR(cut_area_of(c, "first"), 100, rounding);
  EXPECT_LT(c.cut.taken.first[0], 2u);  // the two of "first"
  EXPECT_GE(c.cut.taken.first[1], 2u);
}

TEST(Covered, WhatFacesBothWaysStays) {
  const auto c = plates(0, true, Sides::two);
  EXPECT_NEAR(cut_area_of(c, "second"), 12, rounding);
  EXPECT_NEAR(cut_area_of(c, "first"), 88, rounding);
}

TEST(Covered, LampsInAWallStay) {
  auto builder = ModelBuilder().object("wall").with(Surface::other);
  builder.ring({{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}});
  builder.object("lamp").ring({{2, 0, 2}, {4, 0, 2}, {4, 0, 3}, {2, 0, 3}});
  auto p = builder.prepared({.repair = Repair::safe, .ground = {}});
  const std::vector<std::uint8_t> opaque(p.mesh.triangle_count(), 1);
  std::vector<std::uint8_t> emits;
  for (const auto object : p.mesh.triangle_object)
    emits.push_back(p.mesh.object_names[object.index()] == "lamp");
  const CoveredCut found = cut_covered(p.mesh, p.bodies, opaque, {}, emits);
  EXPECT_NEAR(found.taken.area_m2, 2, rounding);
  const Cut c{std::move(p), found};
  EXPECT_NEAR(cut_area_of(c, "lamp"), 2, rounding);
  EXPECT_NEAR(cut_area_of(c, "wall"), 48, rounding);
}

TEST(Covered, BackToBackVeilsAndAMillimetreAboveStay) {
  EXPECT_EQ(plates(0, false, Sides::one).cut.taken.area_m2, 0);
  EXPECT_EQ(plates(0, true, Sides::one, "first").cut.taken.area_m2, 0);
  EXPECT_EQ(plates(1e-3, true, Sides::one).cut.taken.area_m2, 0);
}

/// Of kind `surface`, neither covered nor left out.
double lit(const Cut& c, const std::string& object, Surface surface) {
  double sum = 0;
  for (std::size_t t = 0; t < c.p.mesh.triangle_count(); ++t)
    if (c.p.mesh.object_names[c.p.mesh.triangle_object[t].index()] == object &&
        c.p.mesh.triangle_surface[t] == surface && !c.p.mesh.is_covered(t))
      sum += c.p.mesh.area_m2(t);
  return sum;
}

TEST(Covered, SheetsBackToBackAreOpenAndFrontsAreNot) {
  for (const double gap : {5e-4, 1e-3, 1.9e-3})
    for (const bool are_fronts : {false, true}) {
      auto builder = ModelBuilder().object("sheets");
      std::vector<Vec3> south{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 0, 2}}, north;
      for (const Vec3 p : south) north.insert(north.begin(), p + Vec3{0, gap, 0});
      if (are_fronts)
        for (auto* ring : {&south, &north}) std::reverse(ring->begin(), ring->end());
      builder.ring(south).ring(north);
      builder.object("far").box({90, 90, 0}, {91, 91, 1}).moved(turned);
      // Not nearer than the gap along their rims.
      EXPECT_NEAR(all_covered(cut(builder)), are_fronts ? 16 : 0, 12 * gap) << gap;
    }
}

// Of open houses, too, which have no inside to ask for.
TEST(Covered, WallsThatOverlapByAMillimetreTouch) {
  auto builder = ModelBuilder().object("a").walls_and_roof({0, 0, 0}, {10, 10, 6});
  builder.object("b").walls_and_roof({10 - 1e-3, 0, 0}, {20, 10, 6});
  builder.moved(turned);
  const auto c = cut(builder);
  EXPECT_NEAR(c.covered("a", Surface::wall), 60, 0.1);  // roofs' edges: a millimetre
  EXPECT_NEAR(c.covered("b", Surface::wall), 60, 0.1);
}

// As two files may have it: each face is there once, that of the house which it lies further out
// of.
TEST(Covered, AHouseThatIsThereTwiceAMillimetreApartIsLitOnce) {
  for (const double shift : {2e-4, 1e-3, 3e-3}) {
    auto builder = ModelBuilder().object("once").box({0, 0, 0}, {10, 8, 6});
    builder.object("again").box({shift, shift, 0}, {10 + shift, 8 + shift, 6 + shift});
    builder.object("wide").box({900, 900, 0}, {910, 908, 6});
    const auto c = cut(builder);
    for (const Surface kind : {Surface::wall, Surface::roof})
      EXPECT_NEAR(lit(c, "once", kind) + lit(c, "again", kind), kind == Surface::wall ? 216 : 80,
                  36 * 2 * shift)
          << shift;
  }
}

Vec3 in_millimetres(Vec3 v) {
  const auto rounded = [](double x) { return std::round(x * 1000) / 1000; };
  return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

/// Share of the area of patches before which, within 5 mm, there is any other surface: of points
/// tried on each.
double share_behind_something(const Mesh& mesh) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  double tried = 0, behind = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.bears_patches(t)) continue;
    const Vec3 normal = normalized(mesh.area_vector2(t));
    const double of_point = norm(mesh.area_vector2(t));
    for (int i = 0; i < 200; ++i) {
      tried += of_point;
      double u = uniform(random), v = uniform(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 p = mesh.corner(t, 0) + u * (mesh.corner(t, 1) - mesh.corner(t, 0)) +
                     v * (mesh.corner(t, 2) - mesh.corner(t, 0));
      for (std::size_t other = 0; other < mesh.triangle_count(); ++other) {
        const Vec3 a = mesh.corner(other, 0), area = mesh.area_vector2(other);
        const double facing = dot(area, normal);
        if (other == t || facing <= 0) continue;
        const double before = dot(area, a - p) / facing;
        const Vec3 q = p + before * normal;
        bool is_in = before > 1e-6 && before < 5e-3;
        for (int k = 0; k < 3; ++k)
          is_in = is_in && dot(area, cross(mesh.corner(other, (k + 1) % 3) - mesh.corner(other, k),
                                           q - mesh.corner(other, k))) > 0;
        if (is_in) behind += of_point;
      }
    }
  }
  return behind / tried;
}

/// Rounding tilts the copy's faces by a millimetre: what is left of one must not stand before what
/// is left of the other.
TEST(Covered, AHouseThatIsThereOnceMoreInWholeMillimetresShadesNothing) {
  for (const double width : {7.3, 9.1, 10.7}) {
    ModelBuilder house;
    house.object("house").box({0, 0, 0}, {width, 9, 6.6}).moved(turned);
    house.object("copy");
    for (auto face : ModelBuilder::box_faces({0, 0, 0}, {width, 9, 6.6})) {
      for (Vec3& p : face) p = in_millimetres(turned(p));
      house.ring(face);
    }
    const auto c = cut(house);
    double open = 0;
    for (std::size_t t = 0; t < c.p.mesh.triangle_count(); ++t)
      if (c.p.mesh.bears_patches(t)) open += c.p.mesh.area_m2(t);
    const double once = 2 * (width * 9 + width * 6.6 + 9 * 6.6);
    EXPECT_NEAR(open, once, 1e-3 * once) << width;
    EXPECT_LT(share_behind_something(c.p.mesh), 1e-3) << width;
  }
}

/// The plane of a pane of 1.5 m in whole millimetres is centimetres off the end of its wall.
TEST(Covered, WindowsInWholeMillimetresOnAWideWallStay) {
  auto model = ModelBuilder().city().object("house", "Building").with(Surface::wall);
  model.ring({{0, 0, 0}, {20, 0, 0}, {20, 0, 15}, {0, 0, 15}}).with(Surface::window);
  for (const double x : {1.13, 3.5, 5.87, 8.24, 10.61, 12.98, 15.35, 17.72})
    for (const double z : {2.21, 6.08, 10.47})
      model.ring({{x, 0, z}, {x + 1.5, 0, z}, {x + 1.5, 0, z + 1.5}, {x, 0, z + 1.5}});
  model.moved(turned).moved(in_millimetres);
  const auto c = cut(model);
  double windows = 0, all = 0;
  for (std::size_t t = 0; t < c.p.mesh.triangle_count(); ++t) {
    if (!c.p.mesh.bears_patches(t)) continue;
    const double area = c.p.mesh.area_m2(t);
    all += area;
    if (c.p.mesh.triangle_surface[t] == Surface::window) windows += area;
  }
  EXPECT_NEAR(windows, 24 * 1.5 * 1.5, 0.05);  // sides in whole millimetres
  EXPECT_NEAR(all, 300, 0.05);
  EXPECT_LT(share_behind_something(c.p.mesh), 1e-3);
}

TEST(Covered, WindowsOnTheirWallStay) {
  for (const double before : {-1e-3, 0.0, 1e-3})
    for (const char* see_through : {"", "window"}) {
      auto builder = ModelBuilder().object("house").box({0, 0, 0}, {10, 8, 6});
      builder.object("window").with(Surface::window);
      builder.ring({{2, -before, 2}, {4, -before, 2}, {4, -before, 4}, {2, -before, 4}});
      builder.moved(turned);
      const auto c = cut(builder, {}, see_through);
      EXPECT_NEAR(lit(c, "window", Surface::window), 4, rounding) << before << see_through;
      EXPECT_NEAR(lit(c, "house", Surface::wall), 216 - 4, rounding) << before << see_through;
    }
}

TEST(Covered, LandBelowLandIsCovered) {
  const auto covered_below = [](const std::string& kind, double above, double slope = 0) {
    auto builder = ModelBuilder().object("terrain", "TINRelief").with(Surface::ground);
    builder.ring({{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 0}});
    builder.object("upper", kind);
    const double rise = slope * 10;
    builder.ring(
        {{10, 10, above}, {20, 10, above + rise}, {20, 20, above + rise}, {10, 20, above}});
    builder.moved(turned);
    return cut(builder).covered("terrain", Surface::ground);
  };
  for (const char* kind : {"TINRelief", "LandUse", "WaterBody"})
    for (const double above : {1e-3, 3e-3, 5e-3, 0.02, 0.3, 4.0})
      EXPECT_NEAR(covered_below(kind, above), 100, rounding) << kind << ' ' << above;
  EXPECT_NEAR(covered_below("Road", 0.02), 100, rounding);
  EXPECT_EQ(covered_below("Road", 3), 0);  // a bridge
  // A slope that goes through it half-way.
  EXPECT_NEAR(covered_below("LandUse", -1, 0.2), 50, 0.5);
}

using Rectangle = std::array<double, 4>;  // low x, low y, high x, high y

std::vector<Rectangle> random_rectangles(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> at(0, 10), size(1, 5);
  std::vector<Rectangle> rectangles;
  for (int i = 0; i < count; ++i) {
    const double x = at(random), y = at(random);
    rectangles.push_back({x, y, x + size(random), y + size(random)});
  }
  return rectangles;
}

bool is_in_any(const std::vector<Rectangle>& rectangles, double x, double y) {
  return std::any_of(rectangles.begin(), rectangles.end(), [&](const Rectangle& r) {
    return x > r[0] && y > r[1] && x < r[2] && y < r[3];
  });
}

// Every point of the union has one surface, whatever lies how often where; and it is covered where
// there is one that faces it.
TEST(Covered, RandomPlatesInOnePlaneAreTheirUnionAndCoverEachOther) {
  std::mt19937 random(3);
  const auto up = random_rectangles(random, 15), down = random_rectangles(random, 15);
  auto builder = ModelBuilder();
  const auto add = [&](const Rectangle& r, bool is_up) {
    std::vector<Vec3> ring{{r[0], r[1], 2}, {r[2], r[1], 2}, {r[2], r[3], 2}, {r[0], r[3], 2}};
    if (!is_up) std::reverse(ring.begin(), ring.end());
    builder.object("plate").with(Surface::other).ring(ring);
  };
  for (const Rectangle& r : up) add(r, true);
  for (const Rectangle& r : down) add(r, false);
  const auto c = cut(builder, {.repair = Repair::none, .ground = {}});
  const Mesh& mesh = c.p.mesh;
  std::uniform_real_distribution<double> anywhere(0, 15);
  for (int i = 0; i < 2000; ++i) {
    const double x = anywhere(random), y = anywhere(random);
    const bool is_up = is_in_any(up, x, y), is_down = is_in_any(down, x, y);
    std::array<int, 4> found{},
        expected{is_up && !is_down, is_down && !is_up, is_up && is_down, is_up && is_down};
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (height_at(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), x - mesh.origin.x,
                    y - mesh.origin.y))
        ++found[(mesh.is_covered(t) ? 2u : 0u) + (mesh.normal(t).z > 0 ? 0u : 1u)];
    EXPECT_EQ(found, expected) << x << " " << y;
  }
}

// More houses stand on each of the two triangles of a plane than are cut out of it at once: it is
// halved before.
TEST(Covered, ManyHousesOnOneTriangle) {
  constexpr int rows = 48;
  const double width_m = 5.3, wide_m = rows * 10.0;
  auto builder = ModelBuilder().city().object("plane", "TINRelief");
  builder.ring({{-7, -7, 0}, {wide_m, -7, 0}, {wide_m, wide_m, 0}, {-7, wide_m, 0}});
  for (int i = 0; i < rows * rows; ++i) {
    const double x = 10.0 * (i % rows), y = 10.0 * (i / rows);  // NOLINT(bugprone-integer-division)
    builder.object("house_" + std::to_string(i), "Building");
    builder.box({x, y, 0}, {x + width_m, y + width_m, 8});
  }
  builder.moved(turned);
  const auto c = cut(builder);
  const double feet_m2 = rows * rows * width_m * width_m;
  EXPECT_NEAR(c.covered("plane", Surface::ground), feet_m2, feet_m2 * 1e-6);
  EXPECT_NEAR(open_area(c, {0, 0, 1}), (wide_m + 7) * (wide_m + 7), feet_m2 * 1e-6);
}

// The lines on each of two triangles cross more often than can be looked at together.
TEST(Covered, ManyCrossingsOnOneTriangle) {
  constexpr int strips = 90;
  const double period_m = 0.2, wide_m = strips * period_m;
  auto builder = ModelBuilder();
  const auto plate = [&](double x0, double y0, double x1, double y1) {
    builder.object("plate")
        .with(Surface::other)
        .ring({{x0, y0, 2}, {x1, y0, 2}, {x1, y1, 2}, {x0, y1, 2}});
  };
  for (int i = 0; i < strips; ++i) plate(0, i * period_m, wide_m, (i + 0.5) * period_m);
  for (int i = 0; i < strips; ++i) plate(i * period_m, 0, (i + 0.5) * period_m, wide_m);
  builder.object("all").ring({{0, 0, 2}, {wide_m, 0, 2}, {wide_m, wide_m, 2}, {0, wide_m, 2}});
  const auto c = cut(builder, {.repair = Repair::none, .ground = {}});
  const double whole_m2 = wide_m * wide_m;  // strips cover three quarters of it
  EXPECT_NEAR(open_area(c, {0, 0, 1}), whole_m2, whole_m2 * 1e-6);
  EXPECT_NEAR(cut_area_of(c, "all"), whole_m2 / 4, whole_m2 * 1e-6);
}

TEST(Covered, EqualInputGivesEqualBits) {
  const auto one = cut(terrace(0)), two = cut(terrace(0));
  EXPECT_EQ(one.p.mesh.vertices, two.p.mesh.vertices);
  EXPECT_EQ(one.p.mesh.triangles, two.p.mesh.triangles);
  EXPECT_EQ(one.p.mesh.triangle_covered, two.p.mesh.triangle_covered);
}

/// Chunks of all sizes with gaps between them: what is allocated next lies in another order.
class ScatteredMemory {
 public:
  explicit ScatteredMemory(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::size_t> bytes(500, 30000);
    for (int i = 0; i < 400; ++i) chunks_.emplace_back(bytes(random));
    std::shuffle(chunks_.begin(), chunks_.end(), random);
    chunks_.resize(chunks_.size() / 2);
  }

 private:
  std::vector<std::vector<char>> chunks_;
};

TEST(Covered, EqualInputGivesEqualBitsWhereverItsMemoryLies) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-5, 5), size(2, 6), angle(0, 6);
  auto builder = ModelBuilder();
  for (int i = 0; i < 12; ++i) {
    const Vec3 low{at(random), at(random), at(random)};
    builder.object("box_" + std::to_string(i))
        .box(low, low + Vec3{size(random), size(random), size(random)});
    const double c = std::cos(angle(random)), s = std::sin(angle(random));
    const double t = std::hypot(c, s);
    builder.moved([&](Vec3 v) {
      return Vec3{(c * v.x - s * v.y) / t, (s * v.x + c * v.y) / t, v.z};
    });
  }
  const PrepareRules rules{.repair = Repair::safe, .ground = {}};
  const auto one = cut(builder, rules);
  EXPECT_GT(one.cut.cut, 10u);
  for (unsigned seed = 0; seed < 8; ++seed) {
    const ScatteredMemory scattered(seed);
    const auto two = cut(builder, rules);
    ASSERT_EQ(one.p.mesh.vertices, two.p.mesh.vertices) << seed;
    ASSERT_EQ(one.p.mesh.triangles, two.p.mesh.triangles) << seed;
    ASSERT_EQ(one.p.mesh.triangle_covered, two.p.mesh.triangle_covered) << seed;
  }
}

}  // namespace
}  // namespace sunload::test
