// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/mesh_prepare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geo/base/check.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

// Sums of a few dozen products of numbers up to 100: some 100 roundings of 1e-16.
constexpr double prepare_rounding = 1e-13;

TEST(MeshPrepare, ClosesACubeOfLooseFaces) {
  const auto p = ModelBuilder().object("cube").box({0, 0, 0}, {1, 2, 3}).prepared();
  EXPECT_EQ(p.mesh.vertices.size(), 8u);
  EXPECT_EQ(p.mesh.triangle_count(), 12u);
  EXPECT_EQ(p.report.vertices_read, 24u);
  EXPECT_EQ(p.report.vertices_welded, 16u);
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_EQ(p.report.open_edges, 0u);
  EXPECT_NEAR(p.report.volume_m3, 6, prepare_rounding);
  EXPECT_NEAR(area(p.mesh), 22, prepare_rounding);
  EXPECT_EQ(p.mesh.origin, Vec3{});
  EXPECT_TRUE(p.report.warnings.empty());
}

TEST(MeshPrepare, RefusesAnEmptyModel) {
  EXPECT_THROW(ModelBuilder().object("nothing").prepared(), InputError);
}

TEST(MeshPrepare, NamesFileFirstVertexAndCountOfWhatIsNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto builder = ModelBuilder("tower.obj").object("cube").box({0, 0, 0}, {1, 1, 1});
    builder.model().vertices[4].y = bad;
    builder.model().vertices[9].z = bad;
    try {
      builder.prepared();
      FAIL() << "a coordinate that is not finite passed";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("tower.obj: 2 vertex coordinates"), std::string::npos) << text;
      EXPECT_NE(text.find("first at vertex 5"), std::string::npos) << text;
    }
  }
}

TEST(MeshPrepare, RefusesAnExtentThatNoFloatResolves) {
  EXPECT_THROW(ModelBuilder().object("far").box({0, 0, 0}, {1, 1, 1.1e6}).prepared(), InputError);
  EXPECT_THROW(ModelBuilder().object("far").box({-1e308, 0, 0}, {1e308, 1, 1}).prepared(),
               InputError);
}

TEST(MeshPrepare, NothingIsLostFarFromTheOrigin) {
  // RD New with Amersfoort, LV95 with Zurich, UTM: metres of the map, file digits of 1 mm.
  for (const Vec3 corner :
       {Vec3{84983.301, 447463.664, -0.101}, Vec3{2678219.193, 1243078.721, 395.79},
        Vec3{691000.007, 5334000.003, 512.125}}) {
    const Vec3 size{12.345, 7.891, 9.013};
    const auto p = ModelBuilder().object("house").box(corner, corner + size).prepared();
    EXPECT_EQ(p.mesh.origin.x, std::round(p.mesh.origin.x));
    EXPECT_EQ(p.mesh.origin.z, std::round(corner.z));
    EXPECT_LT(norm(p.mesh.vertices[0]), 20);
    // What the file's doubles say, to the last bit: the subtraction is exact.
    for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 back = p.mesh.corner(t, k) + p.mesh.origin;
        EXPECT_TRUE(back.x == corner.x || back.x == corner.x + size.x);
        EXPECT_TRUE(back.y == corner.y || back.y == corner.y + size.y);
        EXPECT_TRUE(back.z == corner.z || back.z == corner.z + size.z);
      }
    }
    // The file's own rounding of 2.6e6 m is 2.3e-10 m on edges of 8 m.
    EXPECT_NEAR(p.report.volume_m3 / (size.x * size.y * size.z), 1, 1e-9);
    EXPECT_EQ(p.report.closed_bodies, 1u);
  }
}

TEST(MeshPrepare, ScenesNearTheOriginKeepTheirCoordinates) {
  const auto near = ModelBuilder().object("a").box({700, -800, 300}, {800, -700, 310}).prepared();
  EXPECT_EQ(near.mesh.origin, Vec3{});
  const auto far = ModelBuilder().object("a").box({0, -900, 300}, {1001, -800, 310}).prepared();
  EXPECT_EQ(far.mesh.origin, (Vec3{501, -850, 300}));
}

// Rays resolve a share of the largest coordinate, which must not be much more than what the scene
// measures: a room of 2 m at 100 m, a model of a millimetre.
TEST(MeshPrepare, SmallScenesHaveTheirOriginAmongThem) {
  const auto room = ModelBuilder().object("a").box({100, 100, 0}, {102, 102, 2}).prepared();
  EXPECT_EQ(room.mesh.origin, (Vec3{101, 101, 0}));
  // A lamp of 2 cm that lights a sensor 3 m away.
  const auto lamp = ModelBuilder().object("a").box({0, 0, 3}, {0.02, 0.02, 3.02});
  EXPECT_NE(lamp.prepared().mesh.origin, Vec3{});
  EXPECT_EQ(lamp.prepared({.ground = {}, .beside = {{0, 0, 0}}}).mesh.origin, Vec3{});
  const Vec3 corner{100.0003, -7.0001, 3.0002}, size{0.001, 0.001, 0.001};
  const auto tiny = ModelBuilder().object("a").box(corner, corner + size).prepared();
  for (std::size_t t = 0; t < tiny.mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(norm(tiny.mesh.corner(t, k)), 2 * size.x);
      const Vec3 back = tiny.mesh.corner(t, k) + tiny.mesh.origin;  // to the last bit
      EXPECT_TRUE(back.x == corner.x || back.x == corner.x + size.x);
      EXPECT_TRUE(back.z == corner.z || back.z == corner.z + size.z);
    }
}

TEST(MeshPrepare, WeldsWithinToleranceUnlessNone) {
  auto builder = ModelBuilder().object("cube").box({0, 0, 0}, {100, 100, 100});
  for (std::size_t v = 0; v < builder.model().vertices.size(); ++v) {
    builder.model().vertices[v].x += 1e-5 * static_cast<double>(v % 5);
  }
  EXPECT_EQ(builder.prepared().report.closed_bodies, 1u);
  const auto none = builder.prepared({.repair = Repair::none, .ground = {}});
  EXPECT_EQ(none.report.closed_bodies, 0u);
  EXPECT_GT(none.report.open_edges, 0u);
}

// Points are looked for in cells of sixteen tolerances: their borders must not show.
TEST(MeshPrepare, WeldsWhereverTheModelStands) {
  constexpr double step = 2e-5, cell = 16 * weld_tolerance_m;
  for (int k = 0; k * step < cell; ++k) {
    auto builder = ModelBuilder().object("cube").box({0, 0, 0}, {100, 100, 100});
    std::size_t v = 0;
    builder.moved([&](Vec3 p) {
      const auto off = [&](std::size_t of) {
        return k * step + 1e-5 * static_cast<double>(of % 5);
      };
      ++v;
      return p + Vec3{off(v), off(2 * v), off(3 * v)};
    });
    const auto report = builder.prepared().report;
    EXPECT_EQ(report.closed_bodies, 1u) << k;
    EXPECT_EQ(report.vertices_welded, 16u) << k;
  }
}

TEST(MeshPrepare, SmallModelsAreNotWeldedAway) {
  const auto p = ModelBuilder().object("bead").box({0, 0, 0}, {1e-4, 1e-4, 1e-4}).prepared();
  EXPECT_EQ(p.mesh.vertices.size(), 8u);
  EXPECT_NEAR(p.report.volume_m3 / 1e-12, 1, prepare_rounding);
}

TEST(MeshPrepare, NegativeZeroIsZero) {
  const auto p = ModelBuilder()
                     .object("quad")
                     .ring({{0.0, 0, 0}, {1, 0, 0}, {1, 1, 0}})
                     .ring({{-0.0, -0.0, 0}, {1, 1, 0}, {0, 1, 0}})
                     .prepared({.repair = Repair::none, .ground = {}});
  EXPECT_EQ(p.mesh.vertices.size(), 4u);
}

TEST(MeshPrepare, CountsWhatWeldingCollapses) {
  const auto p = ModelBuilder()
                     .object("a")
                     .box({0, 0, 0}, {100, 100, 100})
                     .ring({{200, 0, 0}, {200.00001, 0, 0}, {200, 1, 0}})  // thinner than 1e-4 m
                     .prepared();
  EXPECT_EQ(p.report.degenerates_dropped, 1u);
  EXPECT_EQ(p.mesh.triangle_count(), 12u);
}

TEST(MeshPrepare, DropsDegeneratesAndDuplicates) {
  auto builder = ModelBuilder().object("cube").box({0, 0, 0}, {1, 1, 1});
  builder.ring({{3, 0, 0}, {4, 0, 0}, {5, 0, 0}});             // a line
  builder.ring({{3, 0, 0}, {3, 0, 0}, {4, 0, 0}});             // two corners
  builder.ring({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});  // the top again
  const auto p = builder.prepared();
  EXPECT_EQ(p.report.degenerates_dropped, 2u);
  EXPECT_EQ(p.report.duplicates_dropped, 2u);
  EXPECT_EQ(p.mesh.triangle_count(), 12u);
  EXPECT_NEAR(p.report.volume_m3, 1, prepare_rounding);
  EXPECT_FALSE(p.report.warnings.empty());
  EXPECT_THROW(builder.prepared({.repair = Repair::none, .ground = {}}), InputError);
}

TEST(MeshPrepare, RefusesASceneOfWhichNothingIsLeft) {
  EXPECT_THROW(ModelBuilder().object("line").ring({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).prepared(),
               InputError);
}

TEST(MeshPrepare, ATriangleWithoutAreaDoesNotOpenItsBody) {
  // The top is cut along y = 0 with a corner that only one side has; a sliver joins them.
  const Vec3 a{0, 0, 1}, b{2, 0, 1}, m{1, 0, 1};
  auto builder = ModelBuilder().object("wedge");
  builder.ring({a, m, b});                                    // the sliver
  builder.ring({a, b, {1, 1, 1}});                            // north of it, long edge
  builder.ring({m, a, {1, -1, 0}}).ring({b, m, {1, -1, 0}});  // south of it, two short edges
  builder.ring({a, {1, 1, 1}, {1, -1, 0}}).ring({{1, 1, 1}, b, {1, -1, 0}});
  const auto p = builder.prepared();
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_EQ(p.report.degenerates_dropped, 1u);
  EXPECT_EQ(p.mesh.triangle_count(), 5u);
  // Tetrahedron a, b, (1,1,1), (1,-1,0): base area 1, height 1.
  EXPECT_NEAR(p.report.volume_m3, 1.0 / 3, prepare_rounding);
}

TEST(MeshPrepare, OrdersTrianglesByObject) {
  auto builder = ModelBuilder().object("a").object("b").box({0, 0, 0}, {1, 1, 1});
  for (std::size_t f = 0; f < 6; f += 2) builder.model().facts[f].object = make_id<ObjectId>(0);
  const auto p = builder.prepared();
  for (std::size_t t = 0; t < 12; ++t) EXPECT_EQ(p.mesh.triangle_object[t].value, t < 6 ? 0 : 1);
}

TEST(MeshPrepare, GroundPlateLiesAtTheLowestPoint) {
  auto builder = ModelBuilder().object("ground").box({0, 0, 2}, {10, 20, 5});
  const auto p = builder.prepared({.repair = Repair::safe, .ground = GroundRules{5}});
  ASSERT_GT(p.mesh.triangle_count(), 14u);  // what lies under the box is apart
  EXPECT_EQ(p.mesh.object_names.back(), "ground_2");
  EXPECT_NEAR(area_of(p, Surface::ground), 20 * 30, prepare_rounding * 600);
  for (std::size_t t = 12; t < p.mesh.triangle_count(); ++t) {
    EXPECT_EQ(p.mesh.triangle_surface[t], Surface::ground);
    EXPECT_GT(p.mesh.area_vector2(t).z, 0);
    EXPECT_EQ(p.mesh.corner(t, 0).z, 2);
    EXPECT_EQ(p.mesh.file_materials[p.mesh.triangle_material[t].index()].name, "ground");
  }
  EXPECT_EQ(p.report.bounds.low, (Vec3{-5, -5, 2}));
  EXPECT_THROW(builder.prepared({.repair = Repair::safe, .ground = GroundRules{-1}}), InputError);
}

TEST(MeshPrepare, EqualInputGivesEqualBits) {
  auto builder = ModelBuilder().object("a");
  for (int i = 0; i < 20; ++i) {
    const double x = 3.1 * i;
    builder.box({x, 0, 0}, {x + 2, 2.3, 1.0 + i % 7});
    builder.polygon({{{x, 9, 0}, {x + 3, 9, 0}, {x + 3, 12, 0}, {x, 12, 0}},
                     {{x + 1, 10, 0}, {x + 1, 11, 0}, {x + 2, 11, 0}, {x + 2, 10, 0}}});
  }
  const auto p = builder.prepared(), q = builder.prepared();
  EXPECT_EQ(p.mesh.vertices, q.mesh.vertices);
  EXPECT_EQ(p.mesh.triangles, q.mesh.triangles);
  EXPECT_EQ(p.mesh.triangle_facade, q.mesh.triangle_facade);
}

}  // namespace
}  // namespace sunload::test
