// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double orient_rounding = 1e-12;

PrepareRules repair(Repair r) { return {.repair = r, .ground = {}}; }

TEST(Orient, TurnsAClosedBodyOutwardWhateverTheFileSays) {
  // Each of the 64 choices of reversed faces.
  const auto faces = ModelBuilder::box_faces({1, 2, 3}, {3, 5, 7});
  for (unsigned choice = 0; choice < 64; ++choice) {
    auto builder = ModelBuilder().object("cube");
    std::size_t expected = 0;
    for (std::size_t f = 0; f < 6; ++f) {
      const bool is_turned = (choice >> f) & 1u;
      expected += is_turned ? 2 : 0;
      builder.ring(is_turned ? reversed(faces[f]) : faces[f]);
    }
    const auto p = builder.prepared();
    EXPECT_NEAR(volume(p.mesh), 24, orient_rounding);
    EXPECT_NEAR(p.report.volume_m3, 24, orient_rounding);
    EXPECT_EQ(p.report.triangles_flipped, expected);
    EXPECT_EQ(p.report.closed_bodies, 1u);
  }
}

TEST(Orient, NoneChangesNothingAndSaysSo) {
  auto builder = ModelBuilder().object("cube");
  for (const auto& face : ModelBuilder::box_faces({0, 0, 0}, {1, 1, 1}))
    builder.ring(reversed(face));
  const auto p = builder.prepared(repair(Repair::none));
  EXPECT_NEAR(volume(p.mesh), -1, orient_rounding);
  EXPECT_EQ(p.report.inside_out_bodies, 1u);
  EXPECT_EQ(p.report.triangles_flipped, 0u);
  ASSERT_EQ(p.report.warnings.size(), 1u);
  EXPECT_NE(p.report.warnings[0].find("absorbs"), std::string::npos);
}

TEST(Orient, ACavityStaysACavity) {
  for (const bool is_inside_out : {false, true}) {
    auto builder = ModelBuilder().object("shell");
    for (const auto& face : ModelBuilder::box_faces({0, 0, 0}, {4, 4, 4})) {
      builder.ring(is_inside_out ? reversed(face) : face);
    }
    for (const auto& face : ModelBuilder::box_faces({1, 1, 1}, {3, 3, 3})) {
      builder.ring(is_inside_out ? face : reversed(face));
    }
    const auto p = builder.prepared();
    EXPECT_EQ(p.report.closed_bodies, 2u);
    EXPECT_NEAR(p.report.volume_m3, 64 - 8, orient_rounding);
    EXPECT_NEAR(volume(p.mesh), 64 - 8, orient_rounding);
  }
}

TEST(Orient, ABodyBesideAnotherIsNoCavity) {
  // The second lies in the bounding box of the first (an L), not in the first.
  const std::vector<Vec3> l{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
  auto builder = ModelBuilder().object("both");
  const Vec3 up{0, 0, 2};
  std::vector<Vec3> top = l;
  for (auto& v : top) v = v + up;
  builder.ring(top).ring(reversed(l));
  for (std::size_t i = 0; i < l.size(); ++i) {
    const Vec3 a = l[i], b = l[(i + 1) % l.size()];
    builder.ring({a, b, b + up, a + up});
  }
  for (const auto& face : ModelBuilder::box_faces({2, 2, 0.5}, {3, 3, 1.5})) {
    builder.ring(reversed(face));
  }
  const auto p = builder.prepared();
  EXPECT_EQ(p.report.closed_bodies, 2u);
  EXPECT_NEAR(p.report.volume_m3, 7 * 2 + 1, orient_rounding);
  EXPECT_EQ(p.report.triangles_flipped, 12u);
}

TEST(Orient, ABodyThatReachesOutOfAnotherIsNoCavity) {
  // A dormer within the bounding box of its house: its floor is in the house, its roof is not.
  const Vec3 along{10, 0, 0};
  const std::vector<Vec3> gable{{0, 0, 0}, {0, 8, 0}, {0, 4, 8}};
  for (const bool is_house_inward : {false, true})
    for (const bool is_dormer_inward : {false, true})
      for (const bool is_floor_first : {false, true}) {
        auto builder = ModelBuilder().object("house");
        const auto add = [&](const std::vector<Vec3>& face, bool is_inward) {
          builder.ring(is_inward ? reversed(face) : face);
        };
        add(reversed(gable), is_house_inward);
        add({gable[0] + along, gable[1] + along, gable[2] + along}, is_house_inward);
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3 a = gable[i], b = gable[(i + 1) % 3];
          add({a, b, b + along, a + along}, is_house_inward);
        }
        auto dormer = ModelBuilder::box_faces({4, 1, 1}, {6, 3, 7});
        if (!is_floor_first) std::ranges::reverse(dormer);
        for (const auto& face : dormer) add(face, is_dormer_inward);
        const auto p = builder.prepared();
        EXPECT_EQ(p.report.closed_bodies, 2u);
        EXPECT_NEAR(volume(p.mesh), 320 + 24, orient_rounding);
      }
}

TEST(Orient, HousesOfOneObjectThatShareAnEdgeAreTurnedOutward) {
  for (const bool is_first_inward : {false, true})
    for (const bool is_second_inward : {false, true}) {
      auto builder = ModelBuilder().object("row");
      for (const auto& face : ModelBuilder::box_faces({0, 0, 0}, {10, 8, 6}))
        builder.ring(is_first_inward ? reversed(face) : face);
      for (const auto& face : ModelBuilder::box_faces({10, 0, 0}, {16, 8, 4}))
        builder.ring(is_second_inward ? reversed(face) : face);
      const auto p = builder.prepared();
      EXPECT_EQ(p.report.open_sheets + p.report.unorientable, 0u);
      EXPECT_NEAR(volume(p.mesh), 480 + 192, orient_rounding);
    }
}

TEST(Orient, BodiesOfDifferentObjectsThatTouchBothClose) {
  const auto p = ModelBuilder()
                     .object("a")
                     .box({0, 0, 0}, {1, 1, 1})
                     .object("b")
                     .box({1, 0, 0}, {2, 1, 1})
                     .prepared();
  EXPECT_EQ(p.report.closed_bodies, 2u);
  EXPECT_EQ(p.report.duplicates_dropped, 0u);
  EXPECT_EQ(p.report.nonmanifold_edges, 0u);
  EXPECT_NEAR(p.report.volume_m3, 2, orient_rounding);
}

TEST(Orient, CellsOfOneObjectThatShareAWallCloseTogether) {
  for (const bool is_mixed : {false, true}) {
    auto builder = ModelBuilder().object("a").box({0, 0, 0}, {1, 1, 1});
    const auto faces = ModelBuilder::box_faces({1, 0, 0}, {2, 1, 1});
    for (std::size_t f = 0; f < 6; ++f) {
      const bool is_shared_wall = f == 4;
      builder.ring(is_mixed && !is_shared_wall ? reversed(faces[f]) : faces[f]);
    }
    const auto p = builder.prepared();
    EXPECT_NEAR(p.report.volume_m3, 2, orient_rounding) << is_mixed;
    EXPECT_EQ(p.report.closed_bodies, 1u);
    EXPECT_EQ(p.report.duplicates_dropped, 2u);
  }
}

TEST(Orient, CubesThatShareAnEdgeCloseInAnyWinding) {
  const auto faces_a = ModelBuilder::box_faces({0, 0, 0}, {1, 1, 1});
  const auto faces_b = ModelBuilder::box_faces({1, 1, 0}, {2, 2, 1});
  for (unsigned choice = 0; choice < 256; ++choice) {
    auto builder = ModelBuilder().object("pair");
    for (std::size_t f = 0; f < 12; ++f) {
      const auto& face = f < 6 ? faces_a[f] : faces_b[f - 6];
      builder.ring((choice >> (f % 8)) & 1u ? reversed(face) : face);
    }
    const auto p = builder.prepared();
    EXPECT_EQ(p.report.nonmanifold_edges, 1u);
    EXPECT_NEAR(p.report.volume_m3, 2, orient_rounding);
    EXPECT_EQ(p.report.unorientable, 0u);
  }
}

TEST(Orient, AFinOnABodyIsASheetOfItsOwn) {
  const auto p = ModelBuilder()
                     .object("a")
                     .box({0, 0, 0}, {1, 1, 1})
                     .ring({{1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}})
                     .prepared();
  EXPECT_EQ(p.report.nonmanifold_edges, 0u);
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_EQ(p.report.open_sheets, 1u);
  EXPECT_NEAR(p.report.volume_m3, 1, orient_rounding);
  EXPECT_EQ(p.report.triangles_flipped, 0u);
}

TEST(Orient, AFinOnAnOpenBodyIsCounted) {
  auto builder = ModelBuilder().object("a");
  const auto box = ModelBuilder::box_faces({0, 0, 0}, {1, 1, 1});
  for (std::size_t k = 0; k < box.size(); ++k)
    if (k != 1) builder.ring(box[k]);
  const auto p = builder.ring({{1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}}).prepared();
  EXPECT_EQ(p.report.nonmanifold_edges, 1u);
  EXPECT_EQ(p.report.closed_bodies, 0u);
  EXPECT_EQ(p.report.volume_m3, 0);
  EXPECT_FALSE(p.report.warnings.empty());
}

TEST(Orient, AnOpenSheetKeepsTheWindingOfItsLargerPart) {
  auto builder = ModelBuilder().object("sheet");
  builder.ring({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}});            // up, 3 m2
  builder.ring(reversed({{3, 0, 0}, {5, 0, 0}, {5, 1, 0}, {3, 1, 0}}));  // down, 2 m2
  builder.object("down").ring(reversed({{0, 5, 0}, {3, 5, 0}, {3, 6, 0}, {0, 6, 0}}));
  const auto p = builder.prepared();
  EXPECT_EQ(p.report.open_sheets, 2u);
  EXPECT_EQ(p.report.triangles_flipped, 2u);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_GT(p.mesh.area_vector2(t).z, 0);
  for (std::size_t t = 4; t < 6; ++t) EXPECT_LT(p.mesh.area_vector2(t).z, 0);
  EXPECT_EQ(p.report.open_edges, 6u + 4u);
}

TEST(Orient, AFrontAndABackInOnePlaceAreATwoSidedSheet) {
  const std::vector<Vec3> pane{{0, 0, 0}, {3, 0, 0}, {3, 0, 2}, {0, 0, 2}};
  // Starting at another corner must not lead to the other diagonal.
  for (std::size_t start = 0; start < 4; ++start) {
    auto back = reversed(pane);
    std::rotate(back.begin(), back.begin() + static_cast<std::ptrdiff_t>(start), back.end());
    const auto p = ModelBuilder().object("pane").ring(pane).ring(back).prepared();
    ASSERT_EQ(p.mesh.triangle_count(), 2u);
    EXPECT_EQ(p.report.sheets_merged, 2u);
    EXPECT_EQ(p.mesh.triangle_sides[0], Sides::two);
    EXPECT_LT(p.mesh.area_vector2(0).y, 0);
  }
}

TEST(Orient, ABodyWhoseFacesAllHaveBacksIsAClosedBody) {
  auto builder = ModelBuilder().object("sketch").box({0, 0, 0}, {1, 1, 1});
  for (const auto& face : ModelBuilder::box_faces({0, 0, 0}, {1, 1, 1}))
    builder.ring(reversed(face));
  const auto p = builder.prepared();
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_NEAR(p.report.volume_m3, 1, orient_rounding);
  EXPECT_EQ(p.report.sheets_merged, 0u);
  EXPECT_EQ(p.mesh.triangle_sides[0], Sides::one);
}

TEST(Orient, AMoebiusBandIsReported) {
  auto builder = ModelBuilder().object("band");
  const int n = 12;
  const auto point = [&](int i, double side) {
    const double u = 2 * 3.14159265358979 * i / n, r = 2 + side * std::cos(u / 2);
    return Vec3{r * std::cos(u), r * std::sin(u), side * std::sin(u / 2)};
  };
  for (int i = 0; i < n; ++i) {
    const bool is_last = i == n - 1;
    const Vec3 c = is_last ? point(0, -0.5) : point(i + 1, 0.5);
    const Vec3 d = is_last ? point(0, 0.5) : point(i + 1, -0.5);
    builder.ring({point(i, -0.5), d, c}).ring({point(i, -0.5), c, point(i, 0.5)});
  }
  EXPECT_EQ(builder.prepared().report.unorientable, 1u);
}

// A land, and a house without floor, wound the wrong way round: nothing else would tell that they
// receive nothing.
TEST(Orient, OpenSurfacesThatLookDownAreTold) {
  const auto model_of = [](bool is_down, bool is_city) {
    auto builder = ModelBuilder().object("land");
    const auto add = [&](const std::vector<Vec3>& ring) {
      builder.ring(is_down ? reversed(ring) : ring);
    };
    add({{0, 0, 0}, {50, 0, 0}, {50, 40, 1}, {0, 40, 0}});
    builder.object("house");
    const auto faces = ModelBuilder::box_faces({10, 10, 2}, {20, 20, 9});
    for (std::size_t f = 1; f < 6; ++f) add(faces[f]);  // all but the lowest
    builder.object("ceiling").ring({{30, 10, 5}, {30, 20, 5}, {40, 20, 5}, {40, 10, 5}});
    PolygonModel model = builder.model();
    model.is_city_format = is_city;
    return model;
  };
  const auto looks_down = [&](bool is_down, bool is_city, Orientation orientation) {
    return prepare(model_of(is_down, is_city), {.ground = {}, .orientation = orientation}).report;
  };
  const auto city = looks_down(true, true, Orientation::outward);
  EXPECT_EQ(city.looks_down.objects, 3u);
  EXPECT_NEAR(city.looks_down.area_m2, 50 * 40 + 10 * 10 + 10 * 10, orient_rounding * 2200);
  EXPECT_EQ(city.looks_down.largest, "land");
  EXPECT_NE(city.warnings.back().find("3 objects with open surfaces that look down (2.2e+03 m2"),
            std::string::npos)
      << city.warnings.back();
  EXPECT_EQ(looks_down(false, true, Orientation::outward).looks_down.largest, "ceiling");
  EXPECT_EQ(looks_down(true, false, Orientation::outward).looks_down.objects, 3u);
  // Ceilings of rooms.
  EXPECT_EQ(looks_down(false, false, Orientation::outward).looks_down.objects, 0u);
  EXPECT_EQ(looks_down(true, true, Orientation::keep).looks_down.objects, 0u);
}

// The ground looks up and is larger; walls tell a house from a ceiling.
TEST(Orient, AHouseThatLooksDownIsToldBesideGroundThatLooksUp) {
  auto builder = ModelBuilder().object("ground");
  builder.ring({{0, 0, 0}, {50, 0, 0}, {50, 40, 0}, {0, 40, 0}});
  builder.object("house");
  const auto faces = ModelBuilder::box_faces({10, 10, 0}, {20, 20, 9});
  for (std::size_t f = 1; f < 6; ++f) builder.ring(reversed(faces[f]));  // all but the lowest
  const PrepareReport report = builder.prepared().report;
  EXPECT_EQ(report.looks_down.objects, 1u);
  EXPECT_EQ(report.looks_down.largest, "house");
}

TEST(Orient, TJointsAreSplitSoThatTheBodyCloses) {
  // Walls in one piece, the top in four with corners in the middle of the walls' edges.
  auto builder = ModelBuilder().object("block");
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {4, 2, 3});
  for (std::size_t f = 0; f < 6; ++f) {
    if (f != 1) builder.ring(faces[f]);
  }
  for (int i = 0; i < 4; ++i) {
    builder.ring({{i * 1.0, 0, 3}, {i + 1.0, 0, 3}, {i + 1.0, 2, 3}, {i * 1.0, 2, 3}});
  }
  EXPECT_EQ(builder.prepared(repair(Repair::none)).report.closed_bodies, 0u);
  for (const Repair how : {Repair::safe, Repair::all}) {
    const auto p = builder.prepared(repair(how));
    EXPECT_EQ(p.report.t_joints_split, 6u);
    EXPECT_EQ(p.report.closed_bodies, 1u);
    EXPECT_EQ(p.report.open_edges, 0u);
    EXPECT_NEAR(p.report.volume_m3, 24, orient_rounding);
    EXPECT_NEAR(area(p.mesh), 2 * (8 + 12 + 6), orient_rounding);
  }
}

/// A closed room from a file, its faces inward: kept so, it is lit inside.
TEST(Orient, RoomsStayRoomsWhereTheStudyKeepsThem) {
  ModelBuilder builder;
  builder.object("room");
  for (auto face : ModelBuilder::box_faces({0, 0, 0}, {4, 5, 3})) {
    std::reverse(face.begin(), face.end());
    builder.ring(face);
  }
  builder.object("table").box({1, 1, 0.5}, {2, 2, 1});
  const PrepareRules keep{.ground = {}, .orientation = Orientation::keep};
  const auto p = builder.prepared(keep);
  EXPECT_EQ(p.report.inside_out_bodies, 1u);
  EXPECT_EQ(p.report.triangles_flipped, 0u);
  EXPECT_NEAR(p.report.volume_m3, 0.5, 1e-12);  // of the table
  EXPECT_TRUE(p.report.warnings.empty());
  EXPECT_NEAR(volume(p.mesh), 0.5 - 60, 1e-9);
  EXPECT_EQ(p.report.floors, 0u);  // the room's floor is lit, and the table hovers above it
  EXPECT_NEAR(area_of(p, Surface::wall), 2 * 3 * (4 + 5) + 4 * 0.5, 1e-9);
  const auto turned = builder.prepared();
  EXPECT_EQ(turned.report.triangles_flipped, 12u);
  EXPECT_NEAR(volume(turned.mesh), 60.5, 1e-9);
}

}  // namespace
}  // namespace sunload::test
