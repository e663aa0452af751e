// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors fall as they should: with lines, and with the size of patches.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

/// Line through (x, y) whose y have the standard errors `error`: slope and its error.
struct Slope {
  double value = 0, error = 0;
};
Slope fitted(const std::vector<double>& x, const std::vector<double>& y, double error) {
  double mx = 0, my = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return {xy / xx, error / std::sqrt(xx)};
}

constexpr int realizations = 64;

/// Root mean square error of the form factor of unit squares face to face
/// (F = 0.19982489569839, Howell C-11), one realization of n lines per patch.
double form_factor_error(int lines, double added_bias) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0}),
            lamp = builder.material({"lamp", 0, 0, 1});
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, black);
  builder.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, lamp);
  SolverRules rules = test_rules();
  rules.realizations = realizations;
  rules.lines_per_patch = realizations * lines;
  rules.direct_samples = realizations;
  rules.bounces = 0;
  const auto solved = solve(builder.scene(), {one_second({0, 0, -1}, 0)}, rules);
  constexpr double F = 0.19982489569839;
  double squares = 0;
  for (const double v : solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; }))
    squares += (v + added_bias - F) * (v + added_bias - F);
  return std::sqrt(squares / realizations);
}

TEST(Convergence, ErrorFallsWithLinesAtLeastAsTheirRoot) {
  std::vector<double> log_lines, log_error, log_faulty;
  constexpr double planted_bias = 0.02 * 0.2;
  for (int lines = 16; lines <= 16384; lines *= 4) {
    log_lines.push_back(std::log(lines));
    log_error.push_back(std::log(form_factor_error(lines, 0)));
    log_faulty.push_back(std::log(form_factor_error(lines, planted_bias)));
    std::cout << lines << " lines: " << std::exp(log_error.back()) << "\n";
  }
  // The logarithm of a root mean square of n normal errors is known to 1 / sqrt(2 n).
  const double error = 1 / std::sqrt(2.0 * realizations);
  const Slope slope = fitted(log_lines, log_error, error);
  const Slope faulty = fitted(log_lines, log_faulty, error);
  const double t = accepted_t(1000);  // errors of the points are known, not estimated
  std::cout << "slope " << slope.value << " +- " << slope.error << ", with a bias of 2 % "
            << faulty.value << "\n";
  EXPECT_LE(slope.value + t * slope.error, -0.5) << "lines that are no better than random ones";
  // Of one sample in each of n cells the error falls with n^-(1/2 + 1/d), where the integrand is
  // smooth in its d dimensions, here 4. Faster, and realizations would not be independent.
  EXPECT_GE(slope.value + t * slope.error, -0.75);
  EXPECT_GT(faulty.value - t * faulty.error, -0.5) << "planted fault: a bias of 2 %";
}

// Canyon of the reference with the steepest light: constant radiosity per patch errs most.
TEST(Convergence, ErrorFallsWithTheSizeOfPatches) {
  const auto c = reference_cases("05_radiosity/street_canyon_2d.json", "canyon_7").at(0);
  const double W = number(c["W"]), H = number(c["H"]), y = H;
  const auto& rho = c["rho_floor_wallSunlit_wallOther"];
  SceneBuilder builder;
  const int floor = builder.material({"floor", number(rho[0]), 0, 0});
  const int lit = builder.material({"lit", number(rho[1]), 0, 0});
  const int other = builder.material({"other", number(rho[2]), 0, 0});
  const int mirror = builder.material({"mirror", 0, 1, 0});
  builder.quad({0, 0, 0}, {W, 0, 0}, {W, y, 0}, {0, y, 0}, floor);
  builder.quad({0, 0, 0}, {0, y, 0}, {0, y, H}, {0, 0, H}, lit);
  builder.quad({W, 0, 0}, {W, 0, H}, {W, y, H}, {W, y, 0}, other);
  builder.quad({0, 0, 0}, {0, 0, H}, {W, 0, H}, {W, 0, 0}, mirror);
  builder.quad({0, y, 0}, {W, y, 0}, {W, y, H}, {0, y, H}, mirror);
  const double a = std::atan(number(c["tan_sun_elevation"]));
  const auto light = one_second({std::cos(a), 0, std::sin(a)}, number(c["DNI"]));
  const double truth = number(c["converged_mean_irradiance"]["floor"]);
  const auto error_at = [&](double edge, int lines) {
    SolverRules rules = test_rules();
    rules.realizations = 16;
    rules.lines_per_patch = 16 * lines;
    rules.direct_samples = 16 * lines;
    rules.bounces = 25;
    rules.mirror_depth = 1000;
    const auto solved = solve(builder.scene(), {light}, rules, {.max_edge_m = edge});
    const auto values =
        solved.means([&](std::size_t i) { return solved.patches[i].triangle / 2 == 0; });
    const MeanError mean = mean_error(values);
    std::cout << "edge " << edge << " m: error " << mean.mean - truth << " +- "
              << mean.standard_error << "\n";
    return MeanError{std::abs(mean.mean - truth), mean.standard_error};
  };
  const MeanError coarse = error_at(100, 16384), middle = error_at(H, 8192),
                  fine = error_at(H / 4, 256);
  const double t = accepted_t(16);
  // Planted fault of the other cases: a mesh that does not matter would not fall at all.
  EXPECT_GT(coarse.mean - middle.mean,
            t * std::hypot(coarse.standard_error, middle.standard_error));
  // At least in proportion to the edge, a quarter of the middle one.
  EXPECT_LE(fine.mean,
            middle.mean / 4 + t * std::hypot(fine.standard_error, middle.standard_error / 4));
  EXPECT_GT(coarse.mean - fine.mean, t * std::hypot(coarse.standard_error, fine.standard_error));
}

}  // namespace
}  // namespace sunload::test
