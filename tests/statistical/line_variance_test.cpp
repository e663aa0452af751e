// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Owen-scrambled Sobol lines against independent random ones: what they are for.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "solver/base/sampling.h"
#include "solver/lines/lines.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;
constexpr int line_realizations = 64, lines_each = 64;

SolverRules line_rules() {
  SolverRules rules = test_rules();
  rules.realizations = line_realizations;
  rules.lines_per_patch = line_realizations * lines_each;
  rules.direct_samples = line_realizations;
  return rules;
}

/// Sum over patches of the variance over realizations of the sky's share.
struct Variances {
  double lines = 0, random = 0;
};

Variances variances(const Scene& scene, const SplitRules& split) {
  Watch watch;
  const auto traced = trace_scene(scene, split, line_rules(), watch);
  const Hierarchy& h = traced->hierarchy();
  Variances sum;
  for (std::size_t i = 0; i < h.patch_count(); ++i) {
    std::vector<double> by_lines, by_random;
    const Tangents axes = tangents(h.normal(i));
    for (std::uint32_t r = 0; r < line_realizations; ++r) {
      by_lines.push_back(static_cast<double>(traced->patches.lines.realizations[r].ends[i].sky));
      int sky = 0;
      for (std::uint32_t l = 0; l < lines_each; ++l) {
        const RandomWords x =
            random_words({.seed = 21, .realization = r, .element = h.key()[i], .block = l});
        const Vec3 local = sample_cosine(x[0] * 0x1p-32, x[1] * 0x1p-32);
        const Barycentric b = sample_triangle(x[2] * 0x1p-32, x[3] * 0x1p-32);
        const Vec3 w = axes.tangent * local.x + axes.bitangent * local.y + h.normal(i) * local.z;
        const Vec3 p = h.corner(i, 0) * b.w0 + h.corner(i, 1) * b.w1 + h.corner(i, 2) * b.w2;
        sky +=
            w.z > 0 &&
            traced->caster.first_hit(p + h.normal(i) * traced->caster.offset_m(), w).left_scene();
      }
      by_random.push_back(static_cast<double>(sky) / lines_each);
    }
    sum.lines += std::pow(mean_error(by_lines).standard_error, 2) * line_realizations;
    sum.random += std::pow(mean_error(by_random).standard_error, 2) * line_realizations;
  }
  return sum;
}

/// Walls along the axes would let the strata of the lines meet the horizon exactly (0.04
/// instead of 0.09 to 0.12): no scene here is aligned.
Scene turned(Scene scene, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (auto& p : scene.mesh.vertices) p = {p.x * c - p.y * s, p.x * s + p.y * c, p.z};
  return scene;
}

TEST(LineVariance, InAStreetIsWellBelowThatOfRandomLines) {
  SceneBuilder builder;
  const int m = builder.material({"m", 0.3, 0, 0});
  builder.object("ground").quad({-6, -6, 0}, {6, -6, 0}, {6, 6, 0}, {-6, 6, 0}, m);
  builder.object("north").box({-5, 3, 0}, {5, 6, 5}, m, Facing::outward);
  builder.object("south").box({-5, -6, 0}, {5, -3, 7}, m, Facing::outward);
  const Variances v = variances(turned(builder.scene(), 0.7), {.max_edge_m = 3});
  std::cout << "street: variance of Sobol lines / random lines = " << v.lines / v.random << "\n";
  // The figure wanted of the lines.
  EXPECT_LE(v.lines / v.random, 0.65);
}

// One patch of 64 realizations knows its ratio to a quarter only (0.09 to 0.22 were seen):
// many patches, of all azimuths and tilts, are put together.
TEST(LineVariance, OfUnobstructedTiltedPatchesIsSmall) {
  constexpr int patches = 96;
  Variances sum;
  for (int k = 0; k < patches; ++k) {
    const double tilt = 0.3 + 1.2 * (k % 8) / 8, azimuth = 2 * pi * (k + 0.4) / patches;
    SceneBuilder builder;
    builder.object("patch_" + std::to_string(k))
        .triangle({0, 0, 0}, {1, 0, 0}, {0, std::cos(tilt), std::sin(tilt)},
                  builder.material({"m", 0.3, 0, 0}));
    const Variances v = variances(turned(builder.scene(), azimuth), {});
    sum.lines += v.lines;
    sum.random += v.random;
  }
  std::cout << "tilted patches: variance of Sobol lines / random lines = " << sum.lines / sum.random
            << "\n";
  EXPECT_LE(sum.lines / sum.random, 0.2);
}

}  // namespace
}  // namespace sunload::test
