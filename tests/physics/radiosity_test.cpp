// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Diffuse light of both transports against exact systems: rooms of twelve triangles,
/// plates, furnaces, truncated bounces, street canyons.

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;
using nlohmann::json;

constexpr const char* systems_file = "05_radiosity/exact_systems.json";

/// Both transports must have the same truth.
class Radiosity : public testing::TestWithParam<Transport> {
 protected:
  static SolverRules rules_of(int lines_per_realization, int bounces) {
    SolverRules rules = diffuse_rules(lines_per_realization, bounces, 32);
    rules.direct_samples = 32 * 16;
    rules.transport = GetParam();
    return rules;
  }
};
INSTANTIATE_TEST_SUITE_P(By, Radiosity, testing::Values(Transport::gather, Transport::shoot),
                         [](const auto& by) {
                           return by.param == Transport::gather ? "gathering" : "shooting";
                         });

constexpr TruthCheck radiosity_check{.fault_factor = 1.02, .standard_error = 0.005};

// One unknown per triangle with exact form factors: B = E + rho H.
TEST_P(Radiosity, RoomOfTwelveTrianglesHasTheExactRadiosity) {
  for (const auto& c : reference_cases("05_radiosity/box_12_triangles.json", "box12_")) {
    SceneBuilder builder;
    double rho_most = 0;
    for (std::size_t t = 0; t < 12; ++t) {
      const double rho = number(c["reflectance"][t]);
      rho_most = std::max(rho_most, rho);
      const int m = builder.material({"m" + std::to_string(t), rho, 0, number(c["emission"][t])});
      const auto& v = c["triangles"][t];
      const auto at = [&](std::size_t k) {
        return Vec3{number(v[k][0]), number(v[k][1]), number(v[k][2])};
      };
      builder.triangle(at(0), at(1), at(2), m);
    }
    constexpr int lines = 4096, bounces = 30;
    const auto solved = solve(builder.scene(), {night}, rules_of(lines, bounces));
    // Left unfollowed: rho^(n+1) of the light; reused lines: O(1/lines) (docs/developer/method.md,
    // Gathering).
    const double left = std::pow(rho_most, bounces + 1) / (1 - rho_most), reuse = 1.0 / lines;
    for (std::size_t t = 0; t < 12; ++t) {
      const double rho = number(c["reflectance"][t]), M = number(c["emission"][t]);
      const double B = number(c["radiosity"][t]);
      auto values = solved.of_patch(t);
      for (auto& H : values) H = M + rho * H;
      const std::string id = c["id"].get<std::string>() + " " + std::to_string(t);
      // Planted fault: the wrong reflectance on the way back, where anything is reflected.
      const auto fault = rho > 0 ? std::optional(M + (B - M) * 1.05) : std::nullopt;
      expect_truth(id, values, B, (left + reuse) * B, {.fault = fault, .standard_error = 0.005});
    }
  }
}

Scene cavity(double rho, double M) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {3, 2, 1}, builder.material({"wall", rho, 0, M}), Facing::inward);
  return builder.scene();
}

TEST_P(Radiosity, ClosedCavityUniformWallsAndTruncatedBounces) {
  for (const auto& c : reference_cases(systems_file, "uniform_closed_")) {
    const double rho = number(c["rho"]), M = number(c["E"]);
    constexpr double negligible = 1e-6;
    const int bounces = static_cast<int>(std::log(negligible) / std::log(rho));
    const auto solved = solve(cavity(rho, M), {night}, rules_of(64, bounces));
    // Every realization sums to exactly one per row: no spread, and rounding of each bounce.
    const double left = std::pow(rho, bounces + 1) / (1 - rho);
    radiosity_check(c["id"], solved.means(everywhere), number(c["H"]), left * M);
  }
  for (const auto& c : reference_cases(systems_file, "bounce_truncation_")) {
    const double rho = number(c["rho"]);
    // B of k reflections is M + rho · H of k - 1.
    const auto solved = solve(cavity(rho, 1), {night}, rules_of(64, c["k"].get<int>() - 1));
    auto B = solved.means(everywhere);
    for (auto& b : B) b = 1 + rho * b;
    radiosity_check(c["id"], B, number(c["B"]), 0);
  }
}

/// Floor and ceiling 1 m apart between perfect mirrors: infinite plates.
Scene plates(const json& rho, const json& M) {
  SceneBuilder builder;
  const int lower = builder.material({"lower", number(rho[0]), 0, number(M[0])});
  const int upper = builder.material({"upper", number(rho[1]), 0, number(M[1])});
  const int mirror = builder.material({"mirror", 0, 1, 0});
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, lower);
  builder.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, upper);
  const Vec3 up{0, 0, 1}, corner[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 a = corner[k], b = corner[(k + 1) % 4];
    builder.quad(b, a, a + up, b + up, mirror);
  }
  return builder.scene();
}

// B1 = M1 + rho1 B2, B2 = M2 + rho2 B1. Mirrors are taken as perfect and as many.
TEST_P(Radiosity, InfinitePlatesBetweenMirrors) {
  for (const auto& c : reference_cases(systems_file, "infinite_parallel_plates_")) {
    const Scene scene = plates(c["rho"], c["E"]);
    constexpr int bounces = 200;
    const auto solved = solve(scene, {night}, rules_of(256, bounces));
    for (const int plate : {0, 1}) {
      const auto side = static_cast<std::size_t>(plate);
      auto B = solved.means([&](std::size_t i) { return solved.patches[i].triangle / 2 == plate; });
      for (auto& b : B) b = number(c["E"][side]) + number(c["rho"][side]) * b;
      radiosity_check(c["id"], B, number(c["B"][side]), 0);
    }
  }
}

// Two facing rectangles in a black void, one unknown each: the radiosity of each is taken
// as uniform in the reference, hence by the solver only where one patch is one rectangle.
// Two triangles per rectangle differ from that by what halving the mesh changes.
TEST_P(Radiosity, OpenRectanglesSeeEachOther) {
  for (const auto& c : reference_cases(systems_file, "two_open_rectangles_")) {
    const double x = number(c["size"][0]), y = number(c["size"][1]), d = number(c["distance"]);
    const auto solved_with = [&](double max_edge) {
      SceneBuilder builder;
      const int lower = builder.material({"l", number(c["rho"][0]), 0, number(c["E"][0])});
      const int upper = builder.material({"u", number(c["rho"][1]), 0, number(c["E"][1])});
      builder.quad({0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}, lower);
      builder.quad({0, 0, d}, {0, y, d}, {x, y, d}, {x, 0, d}, upper);
      return solve(builder.scene(), {night}, rules_of(2048, 60), {.max_edge_m = max_edge});
    };
    const auto solved = solved_with(1e9), halved = solved_with(std::hypot(x, y) / 2);
    for (const int plate : {0, 1}) {
      const auto side = static_cast<std::size_t>(plate);
      const auto B_of = [&](const Solved& s) {
        auto B = s.means([&](std::size_t i) { return s.patches[i].triangle / 2 == plate; });
        for (auto& b : B) b = number(c["E"][side]) + number(c["rho"][side]) * b;
        return B;
      };
      const auto B = B_of(solved);
      const double bias = std::abs(mean_error(B).mean - mean_error(B_of(halved)).mean);
      radiosity_check(c["id"], B, number(c["B"][side]), bias, 1.05);
    }
  }
}

// Radiance L from everywhere, every surface sending (1 - rho) pi L of its own: B = pi L.
TEST_P(Radiosity, FurnaceOfAnOpenScene) {
  for (const auto& c : reference_cases(systems_file, "furnace_open_")) {
    const double rho = number(c["rho"]), glow = pi * number(c["L"]);
    SceneBuilder builder;
    const int m = builder.material({"m", rho, 0, (1 - rho) * glow});
    builder.box({0, 0, 0}, {4, 1, 1}, m, Facing::outward);
    builder.object("tower").box({0, 0, 1.5}, {1, 1, 4}, m, Facing::outward);
    builder.object("beside").box({0, 1.7, -1}, {3, 3, 3}, m, Facing::outward);
    auto light = with_uniform_sky(night, glow);
    light.ground_exitance = glow;
    auto rules = rules_of(64, 150);
    const auto solved = solve(builder.scene(), {light}, rules, {.max_edge_m = 1});
    double area = 0;
    for (const double a : solved.area) area += a;
    radiosity_check(c["id"], solved.means(everywhere), number(c["B"]),
                    std::abs(solved.tally.ledger[0][Term::unshot]) / area);
  }
}

/// A section of a street canyon between perfect mirrors: infinitely long.
struct Canyon {
  explicit Canyon(const json& c) {
    const double W = number(c["W"]), H = number(c["H"]), y = H / 2;
    const auto& rho = c["rho_floor_wallSunlit_wallOther"];
    const int floor = builder.material({"floor", number(rho[0]), 0, 0});
    const int lit = builder.material({"lit", number(rho[1]), 0, 0});
    const int other = builder.material({"other", number(rho[2]), 0, 0});
    const int mirror = builder.material({"mirror", 0, 1, 0});
    builder.object("floor").quad({0, 0, 0}, {W, 0, 0}, {W, y, 0}, {0, y, 0}, floor);
    builder.object("lit").quad({0, 0, 0}, {0, y, 0}, {0, y, H}, {0, 0, H}, lit);
    builder.object("other").quad({W, 0, 0}, {W, 0, H}, {W, y, H}, {W, y, 0}, other);
    builder.object("ends").quad({0, 0, 0}, {0, 0, H}, {W, 0, H}, {W, 0, 0}, mirror);
    builder.quad({0, y, 0}, {W, y, 0}, {W, y, H}, {0, y, H}, mirror);
    const double a = std::atan(number(c["tan_sun_elevation"])), L = number(c["sky_radiance"]);
    light = one_second({std::cos(a), 0, std::sin(a)}, number(c["DNI"]));
    if (L > 0) light = with_uniform_sky(light, pi * L);
  }
  SceneBuilder builder;
  IntervalLight light;
};

TEST_P(Radiosity, StreetCanyonWithSunAndSky) {
  for (const auto& c : reference_cases("05_radiosity/street_canyon_2d.json", "canyon_")) {
    const Canyon canyon(c);
    // Every reflection is shot anew: as exact as demanded with fewer samples than lines.
    const int lines = GetParam() == Transport::shoot ? 12 : 32;
    const auto with = [&](double edge) {
      return solve(canyon.builder.scene(), {canyon.light}, rules_of(lines, 25),
                   {.max_edge_m = edge});
    };
    const double H = number(c["H"]);
    const auto coarse = with(H / 4), fine = with(H / 8);
    const auto check_surface = [&](const char* name, int surface) {
      const auto of = [&](const Solved& s) {
        return s.means([&](std::size_t i) { return s.patches[i].triangle / 2 == surface; });
      };
      // Constant radiosity per patch errs by at most what the last halving changed.
      const auto values = of(fine);
      const double bias = std::abs(mean_error(of(coarse)).mean - mean_error(values).mean);
      const std::string id = c["id"].get<std::string>() + " " + name;
      radiosity_check(id, values, number(c["converged_mean_irradiance"][name]), bias, 1.05);
    };
    check_surface("floor", 0);
    check_surface("sunlit_wall", 1);
    check_surface("other_wall", 2);
    // What leaves after reflection, as a share of the light of sun and sky.
    const auto escaping = fine.ledger([](const Ledger& l) { return l[Term::escaped] / l.in(); });
    const auto before = coarse.ledger([](const Ledger& l) { return l[Term::escaped] / l.in(); });
    const double bias = std::abs(mean_error(escaping).mean - mean_error(before).mean);
    if (number(c["DNI"]) > 0 && number(c["sky_radiance"]) == 0)
      radiosity_check(c["id"].get<std::string>() + " escaping", escaping,
                      number(c["escaping_fraction"]), bias, 1.05);
  }
}

}  // namespace
}  // namespace sunload::test
