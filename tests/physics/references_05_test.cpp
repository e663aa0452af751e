// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Reference 05 where other tests do not have it: boxes of six unknowns and of converged
/// meshes, bodies within bodies, an integrating cube, tilted planes over ground.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geo/base/units.h"
#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;
using nlohmann::json;

constexpr const char* exact_systems = "05_radiosity/exact_systems.json";

constexpr TruthCheck system_check{.fault_factor = 1.03, .standard_error = 0.005};

/// Light that is left when reflections end, as a share of all.
double left_after(int bounces, double rho) { return std::pow(rho, bounces + 1) / (1 - rho); }

int bounces_until(double negligible, double rho) {
  return static_cast<int>(std::ceil(std::log(negligible * (1 - rho)) / std::log(rho)));
}

// ---- boxes -----------------------------------------------------------------------------

constexpr std::size_t faces = 6;

/// A room whose faces are in the order of the references: x0, x1, y0, y1, z0, z1.
SceneBuilder room(const json& c) {
  const double x = number(c["size"][0]), y = number(c["size"][1]), z = number(c["size"][2]);
  SceneBuilder builder;
  const auto face = [&](std::size_t f, Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
    builder.quad(
        p, q, r, s,
        builder.material({"face", number(c["reflectance"][f]), 0, number(c["emission"][f])}));
  };
  face(0, {0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z});
  face(1, {x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0});
  face(2, {0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0});
  face(3, {0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z});
  face(4, {0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0});
  face(5, {0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z});
  return builder;
}

double most(const json& values) {
  double most = 0;
  for (const auto& v : values) most = std::max(most, number(v));
  return most;
}

using Square = std::array<std::array<double, faces>, faces>;

/// Form factors between faces: area-weighted shares of the lines of one realization.
Square face_factors(const LineSet& lines, const Hierarchy& mesh) {
  Square F{};
  std::array<double, faces> area{};
  const auto face_of = [&](std::size_t patch) {
    return static_cast<std::size_t>(mesh.patches()[patch].triangle) / 2;
  };
  for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
    area[face_of(i)] += mesh.area()[i];
  }
  for (std::size_t b = 0, i = 0; b < lines.patches.blocks.size(); ++b) {
    LinkTable::Reader read(lines.patches.blocks[b]);
    for (std::size_t row = 0; row < lines.patches.blocks[b].rows(); ++row, ++i)
      for (std::size_t left = read.next_row(); left > 0; --left) {
        const auto [target, weight] = read.next();
        F[face_of(i)][face_of(target)] += mesh.area()[i] * static_cast<double>(weight);
      }
  }
  for (std::size_t f = 0; f < faces; ++f)
    for (auto& share : F[f]) share /= area[f];
  return F;
}

/// H = F (E + rho H), one unknown per face.
std::array<double, faces> lumped_irradiance(const Square& F, const json& c) {
  std::array<double, faces> H{};
  const int enough = bounces_until(1e-9, most(c["reflectance"]));
  for (int k = 0; k < enough; ++k) {
    std::array<double, faces> next{};
    for (std::size_t i = 0; i < faces; ++i)
      for (std::size_t j = 0; j < faces; ++j)
        next[i] += F[i][j] * (number(c["emission"][j]) + number(c["reflectance"][j]) * H[j]);
    H = next;
  }
  return H;
}

// The solver has an unknown per triangle, the reference one per face: its form factors
// are put into a system of six.
TEST(BoxOfSixUnknowns, HasTheReferenceIrradiance) {
  for (const auto& c : reference_cases("05_radiosity/box_lumped_6_faces.json", "box6_")) {
    const SceneBuilder builder = room(c);
    const Scene scene = builder.scene();
    constexpr int lines = 1 << 12;
    Watch watch;
    const auto traced = trace_scene(scene, SplitRules{}, diffuse_rules(lines, 0), watch);
    std::array<std::vector<double>, faces> H;
    for (const auto& set : traced->patches.lines.realizations) {
      const auto solution = lumped_irradiance(face_factors(set, traced->hierarchy()), c);
      for (std::size_t f = 0; f < faces; ++f) H[f].push_back(solution[f]);
    }
    for (std::size_t f = 0; f < faces; ++f)
      system_check(c["id"].get<std::string>() + " " + std::to_string(f), H[f],
                   number(c["irradiance"][f]),
                   number(c["irradiance"][f]) / lines);  // reuse of lines
  }
}

TEST(ConvergedBox, MeansOfFacesAndTheirCentres) {
  for (const auto& c : reference_cases("05_radiosity/box_converged.json", "box_converged_")) {
    Scene scene = room(c).scene();
    const double x = number(c["size"][0]), y = number(c["size"][1]), z = number(c["size"][2]);
    const std::array<std::pair<Vec3, Vec3>, faces> centre{{{{0, y / 2, z / 2}, {1, 0, 0}},
                                                           {{x, y / 2, z / 2}, {-1, 0, 0}},
                                                           {{x / 2, 0, z / 2}, {0, 1, 0}},
                                                           {{x / 2, y, z / 2}, {0, -1, 0}},
                                                           {{x / 2, y / 2, 0}, {0, 0, 1}},
                                                           {{x / 2, y / 2, z}, {0, 0, -1}}}};
    for (const auto& [p, n] : centre) scene.sensors.push_back({p, n, key_of_place(p, n)});
    const int bounces = bounces_until(1e-3, most(c["reflectance"]));
    const auto with = [&](double edges) {
      return solve(scene, {night}, diffuse_rules(64, bounces),
                   {.max_edge_m = std::max({x, y, z}) / edges});
    };
    const Solved coarse = with(3), fine = with(6);
    for (std::size_t f = 0; f < faces; ++f) {
      const std::string id = c["id"].get<std::string>() + " " + std::to_string(f);
      const auto mean_of = [&](const Solved& s) {
        return s.means([&](std::size_t i) {
          return static_cast<std::size_t>(s.patches[i].triangle) / 2 == f;
        });
      };
      const auto at_centre = [&](const Solved& s) { return of_sensor(s.tally, f); };
      const auto halving = [&](const auto& of) {
        return std::abs(mean_error(of(coarse)).mean - mean_error(of(fine)).mean);
      };
      const double left = left_after(bounces, most(c["reflectance"]));
      const double mean = number(c["face_mean_irradiance"][f]);
      const double point = number(c["face_centre_irradiance"][f]);
      system_check(id + " mean", mean_of(fine), mean,
                   halving(mean_of) + left * mean + number(c["estimated_error_mean"]));
      system_check(id + " centre", at_centre(fine), point,
                   halving(at_centre) + left * point + number(c["estimated_error_centre"]), 1.05);
    }
  }
}

// ---- bodies within bodies --------------------------------------------------------------

/// Polygon of n corners about the axis y.
Vec3 on_circle(double r, int k, int n, double y) {
  return {r * std::cos(2 * pi * k / n), y, r * std::sin(2 * pi * k / n)};
}

/// Inner body outside, outer body inside; both materials from the case.
SceneBuilder concentric(const json& c) {
  SceneBuilder builder;
  for (std::size_t s = 0; s < 2; ++s)
    builder.material({s == 0 ? "inner" : "outer", number(c["rho"][s]), 0, number(c["E"][s])});
  return builder;
}

Scene concentric_spheres(const json& c, int subdivisions) {
  SceneBuilder builder = concentric(c);
  const Scene unit = inward_sphere(subdivisions, {{"m", 0, 0, 0}}, [](Vec3) { return 0; });
  for (std::size_t t = 0; t < unit.mesh.triangle_count(); ++t) {
    const Vec3 p = unit.mesh.corner(t, 0), q = unit.mesh.corner(t, 1), r = unit.mesh.corner(t, 2);
    const double inner = number(c["r"][0]), outer = number(c["r"][1]);
    builder.triangle(p * inner, r * inner, q * inner, 0);
    builder.triangle(p * outer, q * outer, r * outer, 1);
  }
  return builder.scene();
}

/// Prisms between perfect mirrors: infinitely long cylinders.
Scene concentric_cylinders(const json& c, int corners) {
  SceneBuilder builder = concentric(c);
  const double inner = number(c["r"][0]), outer = number(c["r"][1]);
  for (int k = 0; k < corners; ++k) {
    const auto at = [&](double r, int i, double y) { return on_circle(r, i, corners, y); };
    builder.quad(at(outer, k, 0), at(outer, k + 1, 0), at(outer, k + 1, 1), at(outer, k, 1), 1);
    builder.quad(at(inner, k, 0), at(inner, k, 1), at(inner, k + 1, 1), at(inner, k + 1, 0), 0);
  }
  const int mirror = builder.material({"mirror", 0, 1, 0});
  const double R = outer;
  builder.quad({-R, 0, -R}, {-R, 0, R}, {R, 0, R}, {R, 0, -R}, mirror);
  builder.quad({-R, 1, -R}, {R, 1, -R}, {R, 1, R}, {-R, 1, R}, mirror);
  return builder.scene();
}

/// Radiosities of inner and outer body. Facets stand for curved surfaces: what halving them
/// changes bounds what they err by.
void check_concentric(const json& c, const Scene& coarse_scene, const Scene& fine_scene,
                      int lines) {
  const double rho_most = most(c["rho"]);
  const int bounces = bounces_until(1e-4, rho_most);
  const auto solved = [&](const Scene& scene) {
    return solve(scene, {night}, diffuse_rules(lines, bounces));
  };
  const Solved coarse = solved(coarse_scene), fine = solved(fine_scene);
  for (std::size_t body = 0; body < 2; ++body) {
    const auto B_of = [&](const Solved& s, const Scene& scene) {
      auto B = s.means([&](std::size_t i) {
        return scene.material[static_cast<std::size_t>(s.patches[i].triangle)].index() == body;
      });
      for (auto& b : B) b = number(c["E"][body]) + number(c["rho"][body]) * b;
      return B;
    };
    const auto B = B_of(fine, fine_scene);
    const double bias = std::abs(mean_error(B).mean - mean_error(B_of(coarse, coarse_scene)).mean) +
                        left_after(bounces, rho_most) * number(c["B"][body]);
    system_check(c["id"].get<std::string>() + (body == 0 ? " inner" : " outer"), B,
                 number(c["B"][body]), bias);
  }
}

TEST(Concentric, Spheres) {
  for (const auto& c : reference_cases(exact_systems, "concentric_spheres_"))
    check_concentric(c, concentric_spheres(c, 2), concentric_spheres(c, 3), 16);
}

TEST(Concentric, Cylinders) {
  for (const auto& c : reference_cases(exact_systems, "concentric_cylinders_"))
    check_concentric(c, concentric_cylinders(c, 24), concentric_cylinders(c, 48), 128);
}

// ---- an integrating cube, and planes over ground -----------------------------------------

// A small cube for the point: as reflectance is the same everywhere, what is reflected is
// too, and its mean over all surfaces is exact whatever the lamp's shape.
TEST(IntegratingCube, MeanIndirectIrradiance) {
  for (const auto& c : reference_cases(exact_systems, "integrating_cube_")) {
    const double side = number(c["side"]), rho = number(c["rho"]), flux = number(c["Phi"]);
    constexpr double lamp_by_room = 0.01;
    const double half = lamp_by_room * side / 2;
    SceneBuilder builder;
    const int wall = builder.material({"wall", rho, 0, 0});
    const int lamp = builder.material({"lamp", rho, 0, flux / (24 * half * half)});
    builder.box({0, 0, 0}, {side, side, side}, wall, Facing::inward);
    const Vec3 middle{side / 2, side / 2, side / 2}, h{half, half, half};
    builder.box(middle - h, middle + h, lamp, Facing::outward);
    const int bounces = bounces_until(1e-4, rho);
    constexpr int lines = 128;  // of fewer the limit is as large as the planted fault
    const Solved solved =
        solve(builder.scene(), {night}, diffuse_rules(lines, bounces), {.max_edge_m = side / 4});
    const double surface = 6 * side * side;
    auto indirect = solved.means([&](std::size_t i) { return solved.patches[i].triangle < 12; });
    for (auto& E : indirect) E -= flux / surface;  // the lamp's own light all falls on walls
    const double truth = number(c["mean_indirect"]);
    system_check(c["id"], indirect, truth,
                 truth * (lamp_by_room * lamp_by_room + left_after(bounces, rho)));
  }
}

TEST(TiltedPlane, OverInfiniteGroundUnderAUniformSky) {
  for (const auto& c : reference_cases(exact_systems, "tilt_over_ground_")) {
    const double tilt = radians(number(c["tilt_deg"])), rho = number(c["rho"]);
    const Vec3 up_slope{0, std::cos(tilt), std::sin(tilt)}, east{1, 0, 0};
    SceneBuilder builder;
    builder.quad({0, 0, 0}, east, east + up_slope, up_slope, builder.material({"black", 0, 0, 0}));
    IntervalLight light = with_uniform_sky(night, 1);
    light.ground_exitance = rho;
    const Solved solved = solve(builder.scene(), {light}, diffuse_rules(4096, 0));
    system_check(c["id"], solved.means(everywhere), number(c["H"]), 0);
  }
}

}  // namespace
}  // namespace sunload::test
