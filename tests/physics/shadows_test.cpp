// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Direct sun against closed forms: shadows of boxes and a sphere, courtyards, overhangs,
/// facing walls, angles of incidence. Penumbrae have no counterpart: the sun is a point here.

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;
using nlohmann::json;

constexpr const char* shadows = "06_direct_sun/shadows.json";
constexpr double dni = 1000;

Vec3 sun_of(const json& c) {
  return enu_direction({number(c["sun_azimuth_deg"]), number(c["sun_elevation_deg"])});
}

SolverRules sun_rules() {
  SolverRules rules = test_rules();
  rules.realizations = 32;
  rules.lines_per_patch = rules.realizations;
  rules.direct_samples = 32 * 16;
  rules.bounces = 0;
  return rules;
}

struct Ground {
  SceneBuilder builder;
  int black = builder.material({"black", 0, 0, 0});
};

/// Sunlit share per realization of the first named object's triangles, which all face one way.
std::vector<double> sunlit_share(const Scene& scene, Vec3 sun, double max_edge) {
  const auto solved = solve(scene, {one_second(sun, dni)}, sun_rules(), {.max_edge_m = max_edge});
  const double cosine = dot(normalized(scene.mesh.area_vector2(0)), sun);
  auto share = solved.means([&](std::size_t i) {
    return scene.mesh.triangle_object[static_cast<std::size_t>(solved.patches[i].triangle)]
               .index() == 1;
  });
  for (auto& s : share) s /= dni * cosine;
  return share;
}

/// Accepted; a truth off by 2 % of `scale` refused. Points start a little above their
/// surface, which moves a shadow's edge by at most `bias`.
void expect_share(const std::string& id, const std::vector<double>& values, double truth,
                  double scale, double bias) {
  const Verdict verdict = expect_mean(values, truth, bias);
  EXPECT_TRUE(verdict) << id << ": " << verdict.text;
  constexpr double demanded_error = 0.005;
  EXPECT_LE(verdict.standard_error, demanded_error * scale) << id << ": " << verdict.text;
  EXPECT_FALSE(expect_mean(values, truth + 0.02 * scale, bias))
      << id << ": planted fault unnoticed: " << verdict.text;
}

/// Shadow edges move by the lift (16 roundings to float) over the tangent of the elevation.
double edge_shift(double coordinate, Vec3 sun) {
  return 16 * coordinate / (1 << 24) * std::hypot(sun.x, sun.y) / sun.z;
}

TEST(Shadows, OfABoxOnTheGround) {
  for (const auto& c : reference_cases(shadows, "box_shadow_")) {
    const Vec3 sun = sun_of(c), size{number(c["box"][0]), number(c["box"][1]), number(c["box"][2])};
    double x0 = 0, x1 = size.x, y0 = 0, y1 = size.y;
    for (const auto& p : c["polygon"]) {
      x0 = std::min(x0, number(p[0])), x1 = std::max(x1, number(p[0]));
      y0 = std::min(y0, number(p[1])), y1 = std::max(y1, number(p[1]));
    }
    const double margin = 0.1 * std::max(x1 - x0, y1 - y0);
    x0 -= margin, x1 += margin, y0 -= margin, y1 += margin;
    Ground g;
    g.builder.object("ground").quad({x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}, g.black);
    g.builder.object("box").box({0, 0, 0}, size, g.black, Facing::outward);
    const double whole = (x1 - x0) * (y1 - y0);
    auto dark = sunlit_share(g.builder.scene(), sun, margin);
    for (auto& s : dark) s = (1 - s) * whole;
    const double truth = number(c["shadow_plus_footprint_area"]);
    const double rim = 2 * (x1 - x0 + y1 - y0);
    expect_share(c["id"], dark, truth, truth, rim * edge_shift(std::max(x1 - x0, y1 - y0), sun));
  }
}

TEST(Shadows, OnOnePatchByBoxes) {
  for (const auto& c : reference_cases(shadows, "sunlit_patch_")) {
    Ground g;
    std::vector<Vec3> p;
    double extent = 0;
    for (const auto& v : c["patch"]) {
      p.push_back({number(v[0]), number(v[1]), 0});
      extent = std::max({extent, std::abs(p.back().x), std::abs(p.back().y)});
    }
    g.builder.object("patch");
    for (std::size_t k = 2; k < p.size(); ++k) g.builder.triangle(p[0], p[k - 1], p[k], g.black);
    g.builder.object("boxes");
    for (const auto& b : c["boxes"]) {
      const Vec3 low{number(b[0][0]), number(b[0][1]), number(b[0][2])};
      g.builder.box(low, low + Vec3{number(b[1][0]), number(b[1][1]), number(b[1][2])}, g.black,
                    Facing::outward);
    }
    const Vec3 sun = sun_of(c);
    const auto share = sunlit_share(g.builder.scene(), sun, extent / 4);
    const double bias = edge_shift(100, sun) * 4 * extent / number(c["patch_area"]);
    expect_share(c["id"], share, number(c["sunlit_fraction"]), 1, bias);
  }
}

TEST(Shadows, InACourtyard) {
  for (const auto& c : reference_cases(shadows, "courtyard_floor_")) {
    const double W = number(c["W"]), D = number(c["D"]), H = number(c["H"]);
    Ground g;
    g.builder.object("floor").quad({0, 0, 0}, {W, 0, 0}, {W, D, 0}, {0, D, 0}, g.black);
    g.builder.object("walls");
    const Vec3 up{0, 0, H}, corner[] = {{0, 0, 0}, {W, 0, 0}, {W, D, 0}, {0, D, 0}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 a = corner[k], b = corner[(k + 1) % 4];
      g.builder.quad(b, a, a + up, b + up, g.black);
    }
    const Vec3 sun = sun_of(c);
    const double bias = edge_shift(std::max({W, D, H}), sun) * 2 * (W + D) / (W * D);
    expect_share(c["id"], sunlit_share(g.builder.scene(), sun, 2), number(c["sunlit_fraction"]), 1,
                 bias);
  }
}

// Facade to the south, the overhang wide enough that its ends' shadows miss the window.
TEST(Shadows, UnderAnOverhang) {
  for (const auto& c : reference_cases(shadows, "overhang_infinite_")) {
    ASSERT_EQ(number(c["facade_azimuth_deg"]), 180);
    const double h = number(c["h"]), out = number(c["overhang"]), top = h + number(c["offset"]);
    Ground g;
    g.builder.object("window").quad({0, 0, 0}, {1, 0, 0}, {1, 0, h}, {0, 0, h}, g.black);
    constexpr double wide = 50;
    g.builder.object("overhang")
        .quad({-wide, -out, top}, {wide, -out, top}, {wide, 0, top}, {-wide, 0, top}, g.black);
    const Vec3 sun = sun_of(c);
    auto share = sunlit_share(g.builder.scene(), sun, 0.5);
    const double bias = 16 * wide / (1 << 24) * std::hypot(sun.z, sun.x) / -sun.y / h;
    expect_share(c["id"], share, number(c["sunlit_fraction"]), 1, bias);
    for (auto& s : share) s *= dni * -sun.y;
    expect_share(c["id"], share, number(c["mean_direct"]), dni, dni * bias);
  }
}

TEST(Shadows, OnAWallAcrossTheStreet) {
  for (const auto& c : reference_cases(shadows, "street_facing_wall_")) {
    const double H1 = number(c["H1"]), W = number(c["W"]), H2 = number(c["H2"]);
    const double angle = radians(number(c["profile_angle_deg"]));
    Ground g;
    // The facade at x = 0 faces the sun in +x; the building in its way begins at x = W.
    g.builder.object("facade").quad({0, 0, 0}, {0, 1, 0}, {0, 1, H2}, {0, 0, H2}, g.black);
    constexpr double wide = 50;
    g.builder.object("house").box({W, -wide, 0}, {W + 10, wide, H1}, g.black, Facing::outward);
    const Vec3 sun{std::cos(angle), 0, std::sin(angle)};
    const double bias = 16 * wide / (1 << 24) * std::tan(angle) / H2;
    // The far edge of the flat roof lies lower in the sun's view than the near one.
    expect_share(c["id"], sunlit_share(g.builder.scene(), sun, 2), number(c["sunlit_fraction"]), 1,
                 bias);
  }
}

TEST(Shadows, OfASphere) {
  for (const auto& c : reference_cases(shadows, "sphere_shadow_")) {
    const double R = number(c["R"]);
    const Vec3 sun = enu_direction({180, number(c["sun_elevation_deg"])});
    const auto shadow = [&](int subdivisions) {
      const double reach = 2 * R / sun.z, away = 2 * R * std::hypot(sun.x, sun.y) / sun.z;
      Ground g;
      g.builder.object("ground").quad({-reach, away - reach, 0}, {reach, away - reach, 0},
                                      {reach, away + reach, 0}, {-reach, away + reach, 0}, g.black);
      Scene scene = g.builder.scene();
      const Scene ball = inward_sphere(subdivisions, {{"m", 0, 0, 0}}, [](Vec3) { return 0; });
      const auto first = static_cast<std::int32_t>(scene.mesh.vertices.size());
      for (const Vec3 p : ball.mesh.vertices)
        scene.mesh.vertices.push_back(p * R + Vec3{0, 0, 2 * R});
      for (auto t : ball.mesh.triangles) {
        for (auto& v : t) v += first;
        scene.mesh.triangles.push_back(t);
        scene.mesh.triangle_object.push_back(make_id<ObjectId>(scene.mesh.object_names.size()));
        scene.mesh.triangle_material.push_back(MaterialId::none());
        scene.mesh.triangle_facade.push_back(FacadeId::none());
        scene.mesh.triangle_surface.push_back(Surface::floor);  // casts a shadow only
        scene.mesh.triangle_sides.push_back(Sides::one);
        scene.material.push_back(scene.material[0]);
      }
      scene.mesh.object_names.push_back("ball");
      scene.mesh.object_kinds.emplace_back();
      auto dark = sunlit_share(scene, sun, R / 4);
      for (auto& s : dark) s = (1 - s) * 4 * reach * reach;
      return dark;
    };
    const auto coarse = shadow(2), fine = shadow(3);
    const double truth = number(c["shadow_area"]);
    const double bias = std::abs(mean_error(coarse).mean - mean_error(fine).mean);
    EXPECT_LT(mean_error(fine).mean, truth) << "chords lie inside";
    expect_share(c["id"], fine, truth, truth, bias);
  }
}

TEST(Shadows, IncidenceIsTheCosine) {
  for (const auto& c : reference_cases(shadows, "incidence_")) {
    Ground g;
    std::vector<Vec3> p;
    for (const auto& v : c["triangle"]) p.push_back({number(v[0]), number(v[1]), number(v[2])});
    g.builder.triangle(p[0], p[1], p[2], g.black);
    const auto solved = solve(g.builder.scene(), {one_second(sun_of(c), dni)}, sun_rules());
    const double truth = number(c["direct_irradiance"]);
    EXPECT_NEAR(solved.area[0], number(c["area"]), 1e-11);
    EXPECT_NEAR(mean_error(solved.of_patch(0)).mean, truth, 1e-9 * truth) << c["id"];
    EXPECT_FLOAT_EQ(solved.tally.irradiance[0][0], static_cast<float>(truth));
    const auto behind =
        solve(g.builder.scene(), {one_second(Vec3{} - sun_of(c), dni)}, sun_rules());
    EXPECT_EQ(behind.of_patch(0)[0], 0);
  }
}

}  // namespace
}  // namespace sunload::test
