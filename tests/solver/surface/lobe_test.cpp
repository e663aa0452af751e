// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The glossy lobe: reciprocity, energy, sampling.

#include "solver/surface/lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "solver/surface/onward.h"
#include "tests/support/quadrature.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr Vec3 up{0, 0, 1};

Vec3 towards(double cos_theta, double turn) {
  const double s = std::sqrt(1 - cos_theta * cos_theta);
  return {s * std::cos(turn), s * std::sin(turn), cos_theta};
}

TEST(Lobe, IsReciprocal) {
  for (const double n : {1.0, 10.0, 300.0})
    for (const Vec3 a : {towards(0.9, 0.1), towards(0.4, 2), towards(0.05, 5)})
      for (const Vec3 b : {towards(0.85, 3.2), towards(0.3, 5.2), towards(0.1, 1.9)})
        EXPECT_NEAR(lobe_value(dot(mirrored(a, up), b), n), lobe_value(dot(mirrored(b, up), a), n),
                    1e-12 * lobe_value(1, n));
}

TEST(Lobe, NeverReflectsMoreThanItsShare) {
  for (const double n : {0.0, 1.0, 10.0, 300.0, 5000.0}) {
    EXPECT_NEAR(lobe_albedo(1, n), 1, 1e-4) << n;
    for (const double c : {0.95, 0.7, 0.3, 0.05}) EXPECT_LE(lobe_albedo(c, n), 1 + 1e-4) << n;
  }
  EXPECT_LT(lobe_albedo(0.05, 10), 0.7);  // the horizon cuts the lobe
}

TEST(Lobe, InvertsItsSamples) {
  for (const double n : {0.0, 3.0, 200.0})
    for (const double u : {0.1, 0.5, 0.99})
      for (const double v : {0.05, 0.45, 0.95}) {
        const UnitSquare back = invert_power_cosine(sample_power_cosine(u, v, n), n);
        EXPECT_NEAR(back.u, u, 1e-10);
        EXPECT_NEAR(back.v, v, 1e-10);
      }
}

// Counts in rings and sectors against the pdf's integral; the twin has the wrong exponent.
TEST(Lobe, SamplesFollowTheirDensity) {
  constexpr int rings = 12, sectors = 8, samples = 400000;
  constexpr double n = 20;
  std::vector<double> counted(rings * sectors, 0), expected = counted, faulty = counted;
  for (int i = 0; i < samples; ++i) {
    const auto words =
        random_words({.seed = 7, .purpose = Purpose::glossy, .sun = static_cast<std::uint32_t>(i)});
    const Vec3 w = sample_power_cosine(static_cast<double>(uniform(words[0])),
                                       static_cast<double>(uniform(words[1])), n);
    const double turn = std::atan2(w.y, w.x) / (2 * pi);
    const int sector =
        std::min(sectors - 1, static_cast<int>(sectors * (turn < 0 ? turn + 1 : turn)));
    const int ring = std::min(rings - 1, static_cast<int>(rings * w.z));
    ++counted[static_cast<std::size_t>(ring * sectors + sector)];
  }
  for (int ring = 0; ring < rings; ++ring) {
    const auto share = [&](double exponent) {
      return 2 * pi / sectors * samples *
             integral(double(ring) / rings, (ring + 1.0) / rings, 2000,
                      [&](double c) { return power_cosine_pdf(c, exponent); });
    };
    for (int sector = 0; sector < sectors; ++sector) {
      expected[static_cast<std::size_t>(ring * sectors + sector)] = share(n);
      faulty[static_cast<std::size_t>(ring * sectors + sector)] = share(n + 1);
    }
  }
  const Verdict verdict = expect_counts(counted, expected);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_counts(counted, faulty));
}

// White furnace of one surface: what it sends on and absorbs of light at an angle.
TEST(Lobe, SurfaceSendsOnItsAlbedo) {
  Material m{"m", 0.1, 0.2};
  m.glossy = 0.6;
  m.glossy_exponent = 8;
  for (const double c : {1.0, 0.6, 0.15}) {
    std::vector<double> sent, kept;
    for (std::uint32_t r = 0; r < 32; ++r) {
      double weight = 0, absorbed = 0;
      constexpr std::uint32_t each = 2000;
      for (std::uint32_t i = 0; i < each; ++i) {
        const auto on = onward(m, up, towards(c, 1),
                               {.seed = 3, .purpose = Purpose::glossy, .realization = r, .sun = i});
        weight += on.weight / each;
        absorbed += on.absorbed / each;
        EXPECT_TRUE(on.weight == 0 || on.direction.z > 0);
      }
      sent.push_back(weight);
      kept.push_back(absorbed);
    }
    const double truth = 0.2 + 0.6 * lobe_albedo(c, 8);
    constexpr double quadrature_error = 1e-4;
    const Verdict verdict = expect_mean(sent, truth, quadrature_error);
    EXPECT_TRUE(verdict) << c << ": " << verdict.text;
    EXPECT_FALSE(expect_mean(sent, 1.03 * truth, quadrature_error)) << c;
    EXPECT_TRUE(expect_mean(kept, 0.9 - truth, quadrature_error)) << c;
  }
}

}  // namespace
}  // namespace sunload::test
