// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Form factors of reference 04 where other tests do not have them: disks, spheres,
/// cylinders and closed rooms, at a standard error of 0.2 %.
///
/// A receiver sees an emitter of exitance 1: its irradiance is the form factor. Facets stand for
/// what is curved; what they can change is bounded by the same closed form for the largest
/// curved body within them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "geo/base/units.h"
#include "tests/support/known_truth.h"
#include "tests/support/quadrature.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;
using nlohmann::json;

constexpr const char* closed_forms = "04_form_factors/closed_forms.json";

constexpr TruthCheck factor_check{.fault_factor = 1.02, .standard_error = 0.002};

/// Irradiance per realization at the origin, looking up.
std::vector<double> at_origin(const Scene& scene, int lines) {
  constexpr int lines_of_each = 4;
  return at_point(scene, {0, 0, 0}, {0, 0, 1}, static_cast<std::size_t>(lines / lines_of_each),
                  diffuse_rules(lines_of_each));
}

/// Mean irradiance per realization of the triangles that are chosen.
std::vector<double> received(const Scene& scene, int lines,
                             const std::function<bool(std::size_t triangle)>& chosen) {
  const Solved solved = solve(scene, {night}, diffuse_rules(lines));
  return solved.means(
      [&](std::size_t i) { return chosen(static_cast<std::size_t>(solved.patches[i].triangle)); });
}

// ---- disks -----------------------------------------------------------------------------

constexpr int corners = 128;
/// Radius of the circle within a polygon of that many corners on the unit circle.
const double within_polygon = std::cos(pi / corners);

/// A polygon for a disk about (x, 0, z).
void add_disk(SceneBuilder& builder, double r, double x, double z, bool up, int material) {
  const auto at = [&](int k) {
    return Vec3{x + r * std::cos(2 * pi * k / corners), r * std::sin(2 * pi * k / corners), z};
  };
  const Vec3 centre{x, 0, z};
  for (int k = 0; k < corners; ++k)
    up ? builder.triangle(centre, at(k), at(k + 1), material)
       : builder.triangle(centre, at(k + 1), at(k), material);
}

/// Howell C-41: disk of radius r1 to a coaxial one of r2 at distance h.
double coaxial_disks(double r1, double r2, double h) {
  const double R1 = r1 / h, R2 = r2 / h, X = 1 + (1 + R2 * R2) / (R1 * R1);
  return (X - std::sqrt(X * X - 4 * (R2 * R2) / (R1 * R1))) / 2;
}

TEST(Disks, SeeEachOther) {
  for (const auto& c : reference_cases(closed_forms, "coaxial_disks_")) {
    const auto& g = c["geometry"];
    const double r1 = number(g["r1"]), r2 = number(g["r2"]), h = number(g["h"]);
    LampStage stage;
    add_disk(stage.builder.object("from"), r1, 0, 0, true, stage.black);
    add_disk(stage.builder.object("to"), r2, 0, h, false, stage.lamp);
    const double F = number(c["F12"]);
    EXPECT_NEAR(coaxial_disks(r1, r2, h), F, 1e-12);
    const double bias = std::abs(coaxial_disks(r1 * within_polygon, r2, h) - F) +
                        std::abs(coaxial_disks(r1, r2 * within_polygon, h) - F) +
                        lift(std::max(r1, r2)) / h;
    factor_check(c["id"],
                 received(stage.builder.scene(), 192, [](std::size_t t) { return t < corners; }), F,
                 bias);
  }
}

TEST(Disks, AreSeenFromAPoint) {
  int cases = 0;
  for (const auto& c : reference_cases(closed_forms, "dA_to_parallel_")) {
    const auto& g = c["geometry"];
    if (!g.contains("r")) continue;
    const double r = number(g["r"]), h = number(g["h"]);
    const double offset = g.contains("offset") ? number(g["offset"]) : 0;
    LampStage stage;
    add_disk(stage.builder.object("to"), r, offset, h, false, stage.lamp);
    const double F = number(c["F12"]);
    // Light of the ring between polygon and circle: at most that of its area at its nearest.
    const double ring = pi * r * r * (1 - within_polygon * within_polygon);
    const double nearest = std::max(offset - r, 0.0), s2 = nearest * nearest + h * h;
    const double bias = ring * h * h / (pi * s2 * s2) + lift(offset + r) / h;
    factor_check(c["id"], at_origin(stage.builder.scene(), 1 << 12), F, bias);
    ++cases;
  }
  EXPECT_GE(cases, 3);
}

// ---- spheres ---------------------------------------------------------------------------

/// Triangles of a sphere of radius R, fronts outward, and the radius of the sphere within them.
double add_sphere(SceneBuilder& builder, Vec3 centre, double R, int subdivisions, int material) {
  const Scene unit = inward_sphere(subdivisions, {{"m", 0, 0, 0}}, [](Vec3) { return 0; });
  double inner = 1;
  for (std::size_t t = 0; t < unit.mesh.triangle_count(); ++t) {
    const Vec3 p = unit.mesh.corner(t, 0), q = unit.mesh.corner(t, 1), r = unit.mesh.corner(t, 2);
    builder.triangle(centre + p * R, centre + r * R, centre + q * R, material);
    inner = std::min(inner, std::abs(dot(p, normalized(unit.mesh.area_vector2(t)))));
  }
  return R * inner;
}

/// ∫ max(0, cosθ) dω / π over the cap that a sphere of radius R fills at distance d, its centre
/// at an angle from the normal.
double sphere_form_factor(double R, double d, double angle) {
  const double half = std::asin(R / d);
  constexpr int steps = 400;
  return integral(0, half, steps, [&](double a) {
    return std::sin(a) *
           integral(0, 2 * pi, steps,
                    [&](double phi) {
                      return std::max(0.0, std::cos(angle) * std::cos(a) +
                                               std::sin(angle) * std::sin(a) * std::cos(phi));
                    }) /
           pi;
  });
}

TEST(Spheres, AreSeenFromAPoint) {
  int cases = 0;
  for (const auto& c : reference_cases(closed_forms, "dA_to_sphere_")) {
    const auto& g = c["geometry"];
    const double R = number(g["R"]), d = number(g["distance_to_centre"]);
    const double angle = radians(number(g["angle_deg"])), F = number(c["F12"]);
    LampStage stage;
    const Vec3 centre{d * std::sin(angle), 0, d * std::cos(angle)};
    const double inner = add_sphere(stage.builder.object("to"), centre, R, 4, stage.lamp);
    EXPECT_NEAR(sphere_form_factor(R, d, angle), F, 1e-4 * F) << c["id"];
    const double bias = F - sphere_form_factor(inner, d, angle) + 1e-4 * F + lift(d) / (d - R);
    const int lines = F < 0.01 ? 1 << 16 : 1 << 15;
    factor_check(c["id"], at_origin(stage.builder.scene(), lines), F, bias);
    ++cases;
  }
  EXPECT_GE(cases, 4);
}

TEST(Spheres, SeeACoaxialDisk) {
  for (const auto& c : reference_cases(closed_forms, "sphere_to_coaxial_disk_")) {
    const auto& g = c["geometry"];
    const double r = number(g["disk_radius"]), h = number(g["distance_centre_to_disk"]);
    const double R = h / 4;
    LampStage stage;
    const double inner = add_sphere(stage.builder.object("from"), {0, 0, 0}, R, 4, stage.black);
    const std::size_t facets = stage.builder.scene().mesh.triangle_count();
    add_disk(stage.builder.object("to"), r, 0, h, false, stage.lamp);
    const double F = number(c["F12"]);
    // Light caught and area both lie between those of the spheres within and about the facets.
    const auto of_radius = [&](double radius) { return (1 - 1 / std::hypot(1, radius / h)) / 2; };
    const double bias = F * (R * R / (inner * inner) - 1) + F - of_radius(r * within_polygon) +
                        lift(std::max(r, h)) / (h - R);
    factor_check(c["id"],
                 received(stage.builder.scene(), 4, [&](std::size_t t) { return t < facets; }), F,
                 bias);
  }
}

TEST(Spheres, SeeTheirOwnInside) {
  const auto c = reference_cases(closed_forms, "sphere_interior_").front();
  const double share = number(c["F12"]);
  // A cap of that share of the sphere: z below -1 + 2·share.
  const auto in_cap = [&](Vec3 p) { return p.z < -1 + 2 * share ? 1 : 0; };
  const Scene scene = inward_sphere(3, {{"black", 0, 0, 0}, {"lamp", 0, 0, 1}}, in_cap);
  double cap = 0, all = 0, inner = 1;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const double area = scene.mesh.area_m2(t);
    all += area;
    if (scene.material[t].index() == 1) cap += area;
    inner = std::min(
        inner, std::abs(dot(scene.mesh.corner(t, 0), normalized(scene.mesh.area_vector2(t)))));
  }
  // Facets make the cap's rim a zigzag: its own share is the truth, near that of the case.
  EXPECT_NEAR(cap / all, share, 0.01);
  const double scale = share / (cap / all);
  auto everywhere = received(scene, 16, [](std::size_t) { return true; });
  auto opposite =
      received(scene, 16, [&](std::size_t t) { return scene.mesh.corner(t, 0).z > 0.6; });
  for (auto* values : {&everywhere, &opposite})
    for (auto& v : *values) v *= scale;
  factor_check("sphere_interior_0 everywhere", everywhere, share, 0);
  factor_check("sphere_interior_0 opposite", opposite, share, share * (1 - inner * inner));
}

// ---- cylinders and rooms ---------------------------------------------------------------

TEST(Cylinders, SeeThemselves) {
  for (const auto& c : reference_cases(closed_forms, "cylinder_side_to_itself_")) {
    const double r = number(c["geometry"]["r"]), h = number(c["geometry"]["h"]);
    LampStage stage;
    const auto at = [&](int k, double z) {
      return Vec3{r * std::cos(2 * pi * k / corners), r * std::sin(2 * pi * k / corners), z};
    };
    for (int k = 0; k < corners; ++k)
      stage.builder.quad(at(k + 1, 0), at(k, 0), at(k, h), at(k + 1, h), stage.lamp);
    const double F = number(c["F12"]);
    // Side to itself is 1 - (base / side) · 2 · (1 - base to base): both change by the square
    // of the angle of a facet.
    const double facet = pi / corners;
    factor_check(c["id"], received(stage.builder.scene(), 64, [](std::size_t) { return true; }), F,
                 2 * facet * facet + lift(std::max(r, h)) / r);
  }
}

TEST(Rooms, TetrahedronAndCube) {
  LampStage tetrahedron;
  const Vec3 a{1, 1, 1}, b{1, -1, -1}, c{-1, 1, -1}, d{-1, -1, 1};
  tetrahedron.builder.triangle(a, c, b, tetrahedron.lamp)
      .triangle(a, b, d, tetrahedron.black)
      .triangle(a, d, c, tetrahedron.black)
      .triangle(b, c, d, tetrahedron.black);
  const auto case_of = [](const char* prefix) {
    return reference_cases(closed_forms, prefix).front();
  };
  for (std::size_t face = 1; face < 4; ++face)
    factor_check(
        "regular_tetrahedron_inside_0 face " + std::to_string(face),
        received(tetrahedron.builder.scene(), 1 << 12, [&](std::size_t t) { return t == face; }),
        number(case_of("regular_tetrahedron_inside")["F12"]), 10 * lift(1));
  LampStage cube;
  cube.builder.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, cube.lamp);
  cube.builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, cube.black);
  cube.builder.quad({0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, cube.black);
  cube.builder.quad({1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}, cube.black);
  cube.builder.quad({0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, cube.black);
  cube.builder.quad({0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, cube.black);
  factor_check("cube_adjacent_faces_0",
               received(cube.builder.scene(), 1 << 12, [](std::size_t t) { return t >= 4; }),
               number(case_of("cube_adjacent_faces")["F12"]), 10 * lift(1));
}

}  // namespace
}  // namespace sunload::test
