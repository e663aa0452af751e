// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Clear glass known by its normal transmittance: the formula against published rows and itself.

#include "solver/surface/clear_glass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "solver/surface/material.h"
#include "tests/support/quadrature.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

double cosine_deg(double angle_deg) { return std::cos(angle_deg * radians_per_degree); }

Material clear_glass(double normal_transmittance, double diffuse = 0, double mirror = 0) {
  Material m{"clear glass", diffuse, mirror};
  m.smooth = ClearGlass{normal_transmittance};
  return m;
}

TEST(ClearGlass, ReferenceCases) {
  const auto cases = reference_cases("07_cie171_bestest/cie171_style.json", "glass_rivero");
  ASSERT_EQ(cases.size(), 4u);
  int square_refused = 0;
  for (const auto& c : cases) {
    const double T0 = number(c["T0"]), angle = number(c["angle_deg"]), T = number(c["T"]);
    constexpr double last_digit = 1e-7;
    EXPECT_NEAR(clear_glass_transmittance(T0, cosine_deg(angle)), T, last_digit) << c["id"];
    // Planted faults: no factor; the square of the sine, which the normal does not notice.
    EXPECT_GT(std::abs(clear_glass_transmittance(T0, cosine_deg(angle)) / clear_glass_factor - T),
              last_digit);
    const double s = std::sin(radians(angle));
    square_refused +=
        std::abs(1.018 * T0 * cosine_deg(angle) * (1 + s * s) - T) > last_digit ? 1 : 0;
  }
  EXPECT_EQ(square_refused, 3);
}

TEST(ClearGlass, PassesMostOfLightFromTheNormalAndNothingThatGrazes) {
  double before = clear_glass_transmittance(0.9, 1);
  EXPECT_DOUBLE_EQ(before, 1.018 * 0.9);
  for (int tenth = 1; tenth <= 900; ++tenth) {
    const double T = clear_glass_transmittance(0.9, cosine_deg(tenth / 10.0));
    // At 30° the formula is level to the second order.
    EXPECT_LE(T, before) << tenth;
    before = T;
  }
  EXPECT_EQ(clear_glass_transmittance(0.9, 0), 0);
  EXPECT_NEAR(hemispherical([](double c) { return clear_glass_transmittance(1, c); }),
              1.018 * (2.0 / 3 + pi / 16), 1e-8);
}

TEST(ClearGlass, NeverSendsOnMoreThanArrives) {
  const double diffuse = 0.03, mirror = 0.1, most = largest_normal_transmittance(0.13);
  EXPECT_NEAR(1.018 * most, 0.87, 1e-15);
  const auto accepts = [](const Material& m) {
    SceneBuilder builder;
    builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, builder.material(m));
    try {
      expect_valid(builder.scene());
    } catch (const std::logic_error&) {
      return false;
    }
    return true;
  };
  EXPECT_TRUE(accepts(clear_glass(most, diffuse, mirror)));
  EXPECT_FALSE(accepts(clear_glass(most + 1e-6, diffuse, mirror)));
  EXPECT_FALSE(accepts(clear_glass(-0.1)));
  for (int degree = 0; degree <= 90; ++degree) {
    const SmoothShares shares =
        smooth_shares(clear_glass(most, diffuse, mirror), cosine_deg(degree));
    EXPECT_EQ(shares.mirror, mirror);
    EXPECT_LE(diffuse + shares.mirror + shares.transmitted, 1 + 1e-12) << degree;
  }
  for (double Material::*other : {&Material::glossy, &Material::transmittance}) {
    Material m = clear_glass(0.5);
    m.*other = 0.1;
    EXPECT_FALSE(accepts(m));
  }
}

TEST(ClearGlass, OtherMaterialsTransmitNothing) {
  const SmoothShares shares = smooth_shares({"mirror", 0.1, 0.6}, 0.5);
  EXPECT_EQ(shares.mirror, 0.6);
  EXPECT_EQ(shares.transmitted, 0);
}

}  // namespace
}  // namespace sunload::test
