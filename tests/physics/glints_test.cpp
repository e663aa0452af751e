// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sun by way of several planar mirrors: where its light falls by the law of
/// reflection, and how much of it.

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "tests/support/glints.h"
#include "tests/support/reference.h"

namespace sunload::test {
namespace {

using nlohmann::json;

constexpr const char* mirror_cases = "05_radiosity/mirrors.json";

// Two perpendicular mirrors on a floor: near the corner every point sees the sun in
// each of them and once in both (the double image is one, not two).
TEST(Corner, EveryDepthAddsItsImages) {
  constexpr double rho = 0.9, wall = 6, floor = 1;
  SceneBuilder builder;
  const int mirror = builder.material({"mirror", 0, rho, 0}),
            black = builder.material({"black", 0, 0, 0});
  builder.quad({0, 0, 0}, {floor, 0, 0}, {floor, floor, 0}, {0, floor, 0}, black);
  builder.quad({0, 0, 0}, {0, wall, 0}, {0, wall, wall}, {0, 0, wall}, mirror);
  builder.quad({0, 0, 0}, {0, 0, wall}, {wall, 0, wall}, {wall, 0, 0}, mirror);
  const Vec3 sun = normalized({0.6, 0.4, 0.7});
  const double once = dni * sun.z;
  const auto on_floor = [](const Solved& s) {
    return [&](std::size_t i) { return s.patches[i].triangle < 2; };
  };
  for (const auto& [depth, images] :
       {std::pair{0, 0.0}, {1, 2 * rho}, {2, 2 * rho + rho * rho}, {3, 2 * rho + rho * rho}}) {
    const std::string name = "depth " + std::to_string(depth);
    const auto seen = solve_sun(builder.scene(), sun, glint_rules(By::images, depth), 0.5);
    for (std::size_t i = 0; i < seen.area.size(); ++i)
      if (seen.patches[i].triangle < 2) {
        EXPECT_NEAR(static_cast<double>(by_mirrors(seen, i)), once * images,
                    float_rounding * once * images)
            << name;
      }
    check_ledger(name, seen);
    EXPECT_EQ(seen.work[Work::mirror_shots], 0u);
    const auto shot = solve_sun(builder.scene(), sun, glint_rules(By::shooting, depth), 0.5);
    // Planted fault: the double image counted in both orders.
    check_glint(name + " by shooting", shot.means(on_floor(shot)), once * (1 + images),
                once * (1 + 2 * rho + 2 * rho * rho));
    check_ledger(name + " by shooting", shot);
    EXPECT_EQ(shot.work[Work::mirror_beams], 0u);
  }
}

// The beam of 1 m² comes down on the first mirror, leaves along +x, meets the second,
// whose back is turned to the sun, and leaves downward to a screen.
TEST(Periscope, BringsItsBeamToTheScreen) {
  SceneBuilder builder;
  const int first = builder.material({"first", 0, 0.9, 0}),
            second = builder.material({"second", 0, 0.8, 0}),
            black = builder.material({"black", 0, 0, 0});
  builder.quad({2, -1, -4}, {6, -1, -4}, {6, 2, -4}, {2, 2, -4}, black);
  builder.quad({0, 0, 0}, {1, 0, -1}, {1, 1, -1}, {0, 1, 0}, first);
  builder.quad({3, -1, 1}, {3, 2, 1}, {5, 2, -1}, {5, -1, -1}, second);
  const double H = number(reference_cases(mirror_cases, "periscope").front()["H"]);
  const Vec3 above{0, 0, 1};
  constexpr double edge = 0.2;
  for (const By by : {By::images, By::shooting}) {
    const auto solved = solve_sun(builder.scene(), above, glint_rules(by), edge);
    // The beam's height along +x, -1 … 0, is its place on the second mirror: x = 4 … 5.
    std::vector<double> power(32, 0);
    for (std::size_t i = 0; i < solved.area.size(); ++i) {
      if (solved.patches[i].triangle >= 2) continue;
      for (std::size_t r = 0; r < power.size(); ++r)
        power[r] += solved.area[i] * solved.tally.exposure_realization[r][i];
    }
    const double direct = dni * 2 * 3;  // x = 2 … 3 and 5 … 6
    check_glint("periscope", power, direct + H, direct + 0.9 * 1000, float_rounding * direct);
    check_ledger("periscope", solved);
  }
  // By images every patch within the beam has it exactly.
  const auto solved = solve_sun(builder.scene(), above, glint_rules(By::images), edge);
  Watch watch;
  const auto mesh =
      trace_scene(builder.scene(), {.max_edge_m = edge}, glint_rules(By::images), watch);
  int inside = 0;
  for (std::size_t i = 0; i < solved.area.size(); ++i) {
    if (solved.patches[i].triangle >= 2) continue;
    const Vec3 p = mesh->hierarchy().centroid(i);
    const double depth = std::min(std::min(p.x - 4, 5 - p.x), std::min(p.y, 1 - p.y));
    if (depth > edge) {
      ++inside;
      EXPECT_NEAR(static_cast<double>(by_mirrors(solved, i)), H, float_rounding * H);
    } else if (depth < -edge) {
      EXPECT_EQ(by_mirrors(solved, i), 0.0f);
    }
  }
  EXPECT_GT(inside, 10);
  for (const auto& [depth, arriving] : {std::pair{0, 0.0}, {1, 0.0}, {2, H}}) {
    const auto cut = solve_sun(builder.scene(), above, glint_rules(By::images, depth));
    EXPECT_NEAR(cut.tally.ledger[0][Term::unshot], depth == 0 ? 900 : depth == 1 ? H : 0.0, 0.01);
    double power = 0;
    for (std::size_t i = 0; i < cut.area.size(); ++i)
      if (cut.patches[i].triangle < 2)
        power += cut.area[i] * static_cast<double>(by_mirrors(cut, i));
    EXPECT_NEAR(power, arriving, 0.05 * H);  // how the samples of large patches see the outline
  }
}

// Light that enters through a hole above three perpendicular mirrors comes back
// antiparallel, to the point symmetric about the corner.
TEST(CornerCube, SendsBackAntiparallel) {
  const double factor = number(reference_cases(mirror_cases, "corner_cube").front()["factor"]);
  constexpr double rho = 0.95, size = 4, half_hole = 0.2, half_screen = 4;
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0}),
            mirror = builder.material({"m", 0, rho, 0});
  const Vec3 sun = normalized({1, 1, 1});
  const Tangents axes = tangents(sun);
  const auto on_screen = [&](double u, double v) {
    return sun * 5 + axes.tangent * u + axes.bitangent * v;
  };
  // Two-sided, black: four strips around the hole.
  constexpr double hole_u = 0.5, hole_v = 0.3, s = half_screen, h = half_hole;
  builder.sides(Sides::two);
  const auto strip = [&](double u0, double u1, double v0, double v1) {
    builder.quad(on_screen(u0, v0), on_screen(u1, v0), on_screen(u1, v1), on_screen(u0, v1), black);
  };
  strip(-s, hole_u - h, -s, s);
  strip(hole_u + h, s, -s, s);
  strip(hole_u - h, hole_u + h, -s, hole_v - h);
  strip(hole_u - h, hole_u + h, hole_v + h, s);
  builder.sides(Sides::one);
  builder.quad({0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}, mirror);
  builder.quad({0, 0, 0}, {0, size, 0}, {0, size, size}, {0, 0, size}, mirror);
  builder.quad({0, 0, 0}, {0, 0, size}, {size, 0, size}, {size, 0, 0}, mirror);
  constexpr double edge = 0.2;
  Watch watch;
  auto rules = glint_rules(By::images);
  rules.direct_samples = 32 * 4;
  const Scene& scene = builder.scene();
  const auto traced = trace_scene(scene, {.max_edge_m = edge}, rules, watch);
  const auto tally =
      sunload::solve(*transport_of(*traced), std::vector{one_second(sun, dni)}, watch)
          .bands.front();
  std::vector<double> power;
  Vec3 centre;
  for (const auto& exposure : tally.exposure_realization) {
    double of_realization = 0;
    for (std::size_t i = 0; i < traced->hierarchy().patch_count(); ++i) {
      const auto& patch = traced->hierarchy().patches()[i];
      // Sides that look away from the sun.
      if (patch.triangle >= 8 || dot(traced->hierarchy().normal(i), sun) > 0) continue;
      const double P = traced->hierarchy().area()[i] * exposure[i];
      of_realization += P;
      centre += traced->hierarchy().centroid(i) * P;
    }
    power.push_back(of_realization);
  }
  const double truth = dni * 4 * half_hole * half_hole * factor;
  check_glint("corner cube", power, truth, truth / rho);
  double all = 0;
  for (const double P : power) all += P;
  // Patches of the outline, a quarter of an edge long, lie on both sides of the centre.
  EXPECT_NEAR(dot(centre, axes.tangent) / all, -hole_u, edge / 4);
  EXPECT_NEAR(dot(centre, axes.bitangent) / all, -hole_v, edge / 4);
}

// Two facing mirrors above a floor, open at the top.
TEST(LightPipe, TransmitsWhatItsReflectionsLeave) {
  for (const auto& c : reference_cases(mirror_cases, "light_pipe"))
    for (const By by : {By::images, By::shooting}) {
      const double gap = number(c["gap"]), length = number(c["length"]), rho = number(c["rm"]);
      const double t = number(c["angle_deg"]) * radians_per_degree;
      constexpr double half = 2;
      SceneBuilder builder;
      const int black = builder.material({"black", 0, 0, 0});
      const int mirror = builder.material({"mirror", 0, rho, 0});
      builder.quad({0, -half, 0}, {gap, -half, 0}, {gap, half, 0}, {0, half, 0}, black);
      builder.quad({0, -half, 0}, {0, half, 0}, {0, half, length}, {0, -half, length}, mirror);
      builder.quad({gap, half, 0}, {gap, -half, 0}, {gap, -half, length}, {gap, half, length},
                   mirror);
      auto rules = glint_rules(by);
      rules.direct_samples = 32 * 8;
      const auto solved = solve_sun(builder.scene(), {std::sin(t), 0, std::cos(t)}, rules, 0.5);
      const double E = dni * std::cos(t), transmitted = number(c["transmitted"]);
      const std::string name =
          c["id"].get<std::string>() + (by == By::images ? " by images" : " by shooting");
      check_glint(name, solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; }),
                  E * transmitted, E * std::pow(rho, number(c["n"])));
      check_ledger(name, solved);
      if (by == By::images) {
        EXPECT_EQ(solved.work[Work::mirror_shots], 0u);
      }
    }
}

TEST(Street, SecondGlintLandsWhereTheLawOfReflectionSays) {
  constexpr double rho_window = 0.85, rho_wall = 0.7, edge = 0.2;
  const TwoMirrorStreet street;
  const Scene scene = street.scene(rho_window, rho_wall);
  const Vec3 low = street.on_ground(street.y0, street.z0),
             high = street.on_ground(street.y1, street.z1);
  ASSERT_GT(low.x, 1);
  ASSERT_LT(low.x, street.width);
  Watch watch;
  const auto traced = trace_scene(scene, {.max_edge_m = edge}, glint_rules(By::images), watch);
  const auto tally =
      sunload::solve(*transport_of(*traced), std::vector{one_second(street.sun, dni)}, watch)
          .bands.front();
  const auto& glint = tally.irradiance[static_cast<std::size_t>(Part::mirror)];
  const double E = dni * street.sun.z * rho_window * rho_wall;
  // The image of the upright rectangle on level ground is a parallelogram: x from z, y from both.
  const auto inside = [&](Vec3 p) {
    const double a = (p.x - low.x) / (high.x - low.x);
    const Vec3 start = street.on_ground(street.y0, street.z0 + a * (street.z1 - street.z0));
    const Vec3 end = street.on_ground(street.y1, street.z0 + a * (street.z1 - street.z0));
    const double across = std::min(p.x - std::min(low.x, high.x), std::max(low.x, high.x) - p.x);
    const double along = std::min(p.y - std::min(start.y, end.y), std::max(start.y, end.y) - p.y);
    return std::min(across, 0.5 * along);  // sides slanted by less than 60°
  };
  double power = 0;
  Vec3 centre;
  int within = 0, without = 0;
  for (std::size_t i = 0; i < traced->hierarchy().patch_count(); ++i) {
    if (traced->hierarchy().patches()[i].triangle >= 2) continue;
    const Vec3 p = traced->hierarchy().centroid(i);
    const double value = static_cast<double>(glint[i]);
    if (inside(p) > edge) {
      ++within;
      EXPECT_NEAR(value, E, float_rounding * E);
    } else if (inside(p) < -2 * edge) {
      ++without;
      EXPECT_EQ(value, 0);
    }
    power += traced->hierarchy().area()[i] * value;
    centre += p * (traced->hierarchy().area()[i] * value);
  }
  EXPECT_GT(within, 10);
  EXPECT_GT(without, 1000);
  // Area and centroid of the lit region; the outline's patches are known to their samples.
  const double area = std::abs((high.x - low.x) * (street.y1 - street.y0));
  EXPECT_NEAR(power / E, area, 0.01 * area);
  const Vec3 middle = (low + high) / 2;
  EXPECT_NEAR(norm(centre / power - middle), 0, 0.1 * edge);
}

// The image of the sun's disk: a glint's edge is blurred like a shadow's edge.
TEST(SunDiskInAMirror, BlursTheEdgeOfTheGlint) {
  // A high mirror wall whose lower edge, in this height, bounds its glint on the ground.
  constexpr double height = 50, half_angle = 0.2666 * radians_per_degree;
  const double elevation = radians(30);
  const Vec3 sun{0, -std::cos(elevation), std::sin(elevation)};
  const auto ground_y = [&](double radii) {
    return -height / std::tan(elevation - std::atan(radii * std::tan(half_angle)));
  };
  const double radius_m = std::abs(ground_y(1) - ground_y(-1)) / 2;
  for (const double x : {-0.5, 0.0, 0.5}) {
    SceneBuilder b;
    const int black = b.material({"black", 0, 0, 0}), mirror = b.material({"mirror", 0, 0.8, 0});
    const double low = ground_y(x) - 0.01 * radius_m, high = ground_y(x) + 0.01 * radius_m;
    b.quad({-0.5, low, 0}, {0.5, low, 0}, {0.5, high, 0}, {-0.5, high, 0}, black);
    b.quad({-20, 0, height}, {20, 0, height}, {20, 0, 3 * height}, {-20, 0, 3 * height}, mirror);
    auto light = one_second(sun, dni);
    light.disk_half_angle = half_angle;
    const auto solved = solve(b.scene(), {light}, glint_rules(By::images));
    // Part of the image's disk above the edge, which is seen x radii below its centre.
    const double share = 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
    const auto E = solved.means([](std::size_t i) { return i < 2; });
    const double direct = dni * sun.z, full = 0.8 * dni * sun.z;
    // Curvature of the share over a strip of a fiftieth of a radius (sun_disk_test).
    const double bias = full * 0.02 * 0.02 / 24;
    check_glint("disk at " + std::to_string(x), E, direct + full * share,
                direct + (x < 0 ? 0 : full), bias);
  }
}

/// A mirror of which half is in the shade, and a ground that ends before it.
struct HalfInTheShade {
  static constexpr double width = 8, low = 2, high = 6, length = 5;
  const Vec3 sun = normalized({1, 0, 1});
  Scene scene(const Material& mirror) const {
    SceneBuilder b;
    const int black = b.material({"black", 0, 0, 0}), of_mirror = b.material(mirror);
    b.quad({0, -60, 0}, {length, -60, 0}, {length, 60, 0}, {0, 60, 0}, black);
    b.quad({0, 0, low}, {0, width, low}, {0, width, high}, {0, 0, high}, of_mirror);
    // Before the sun of the mirror's half, above what this sends on.
    b.quad({8, width / 2, low + 8}, {8, width, low + 8}, {8, width, high + 8},
           {8, width / 2, high + 8}, black);
    return b.scene();
  }
  /// What falls on the mirror from a height on [W].
  double falls_above(double z) const { return dni * sun.x * width / 2 * (high - z); }
};

// Where mirrors are few, samples of the sun on all of them tell where their light ends: of a mirror
// that is half in the shade, what passes over the ground escapes.
TEST(FewMirrors, EndsAreToldBySomeSamples) {
  constexpr double rho = 0.8;
  const HalfInTheShade half;
  const double escapes = rho * half.falls_above(HalfInTheShade::length);
  double rays[2];
  for (const By by : {By::images, By::shooting}) {
    SCOPED_TRACE(by == By::images ? "some samples" : "every sample");
    const Solved solved =
        solve_sun(half.scene({"mirror", 0, rho, 0}), half.sun, glint_rules(by, 8), 0.5);
    rays[by == By::images ? 0 : 1] = solved.work[Work::mirror_rays];
    // Its lower edge is known to the offset of rays.
    check_glint("escaped", solved.ledger([](const Ledger& l) { return l[Term::escaped]; }), escapes,
                1.3 * escapes, 0.001 * escapes);
    check_ledger("few mirrors", solved);
  }
  EXPECT_LT(10 * rays[0], rays[1]);
}

// What stays on a pane is told by the share of it that sees the sun: no realization differs.
TEST(FewMirrors, WhatPanesTransmitHasNoNoise) {
  const HalfInTheShade half;
  Material pane{"pane"};
  pane.smooth = Panes{1.52};
  const double passes =
      smooth_shares(pane, half.sun.x).transmitted * half.falls_above(HalfInTheShade::low);
  for (const double max_edge_m : {0.5, 1e9}) {
    const Solved solved =
        solve_sun(half.scene(pane), half.sun, glint_rules(By::images, 8), max_edge_m);
    for (const double W : solved.ledger([](const Ledger& l) { return l[Term::transmitted]; }))
      EXPECT_NEAR(W, passes, 0.001 * passes);  // of the offset of rays
    check_ledger("pane", solved);
  }
}

}  // namespace
}  // namespace sunload::test
