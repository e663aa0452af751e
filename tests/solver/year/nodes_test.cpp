// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Skies and suns that stand for those of a period.
#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "solver/year/sky_nodes.h"
#include "solver/year/sun_nodes.h"

namespace sunload {
namespace {

/// Days from winter to summer solstice, hour by hour, under a Perez sky of some clearness.
class HalfAYear : public LitPeriod {
 public:
  explicit HalfAYear(const SkyGrid& grid) : grid_(grid) {}
  static constexpr std::size_t days = 26, hours = 24;

  std::size_t intervals() const override { return days * hours; }
  Vec3 direction(std::size_t k) const override {
    const double declination =
        -23.4 * radians_per_degree * std::cos(pi * static_cast<double>(k / hours) / (days - 1));
    const double hour = (static_cast<double>(k % hours) - 11.5) * 15 * radians_per_degree;
    const double latitude = 50 * radians_per_degree;
    const double x = -std::cos(declination) * std::sin(hour);
    const double to_south = std::cos(declination) * std::cos(hour) * std::sin(latitude) -
                            std::sin(declination) * std::cos(latitude);
    const double z = std::cos(declination) * std::cos(hour) * std::cos(latitude) +
                     std::sin(declination) * std::sin(latitude);
    return {x, -to_south, z};
  }
  bool has_sun(std::size_t k) const override { return direction(k).z > 0; }
  bool is_dark(std::size_t k) const override { return !has_sun(k); }
  IntervalLight of(std::size_t k) const override {
    IntervalLight light;
    light.number = static_cast<std::uint32_t>(k);
    light.direction = direction(k);
    if (!has_sun(k)) return light;
    const double z = light.direction.z;
    light.dni = 900 * z * static_cast<double>(k % 7) / 6;
    light.dhi = 50 + 100 * z;
    light.sunlit_s = light.length_s = 3600;
    const SkyInput input{.dhi = light.dhi,
                         .dni = light.dni,
                         .sun_zenith_deg = std::acos(z) / radians_per_degree,
                         .sun_direction = light.direction};
    light.sky = grid_.mean_radiance(relative_sky(input), light.dhi);
    return light;
  }

 private:
  const SkyGrid& grid_;
};

/// Sums over two by two cells, as nodes compare skies.
std::vector<double> coarse(const SkyGrid& grid, const std::vector<double>& sky) {
  const auto side = static_cast<std::size_t>(grid.side());
  std::vector<double> cells(side * side / 4, 0);
  for (std::size_t c = 0; c < sky.size(); ++c)
    cells[c / side / 2 * (side / 2) + c % side / 2] += sky[c];
  return cells;
}

/// |L - Σ c L_m| / |L|.
double rest_of(const SkyGrid& grid, const HalfAYear& period, const SkyNodes& nodes,
               std::size_t interval) {
  const std::vector<double> whole = period.of(interval).sky;
  const std::vector<double> c = nodes.weights(whole);
  std::vector<double> left = whole;
  for (std::size_t m = 0; m < c.size(); ++m) {
    const std::vector<double> of_node = period.of(nodes.ranked()[m]).sky;
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= c[m] * of_node[i];
  }
  const auto square = [&](const std::vector<double>& sky) {
    double sum = 0;
    for (const double x : coarse(grid, sky)) sum += x * x;
    return sum;
  };
  return std::sqrt(square(left) / square(whole));
}

class SkyNodesOfHalfAYear : public testing::Test {
 protected:
  SkyGrid grid{32};
  HalfAYear period{grid};
  SkyNodes nodes{grid, period, 120};
};

TEST_F(SkyNodesOfHalfAYear, MakeUpEverySky) {
  const std::size_t count = nodes.count_for(0.01);
  EXPECT_LT(count, 120u);
  nodes.take(count);
  double square = 0;
  std::size_t skies = 0;
  for (std::size_t k = 0; k < period.intervals(); k += 17) {
    if (period.is_dark(k)) continue;
    const double rest = rest_of(grid, period, nodes, k);
    square += rest * rest;
    ++skies;
  }
  // The price of large coefficients adds to it, and faint skies count as much as bright ones.
  EXPECT_LT(std::sqrt(square / static_cast<double>(skies)), 0.02);
}

TEST_F(SkyNodesOfHalfAYear, MoreOfThemLeaveLess) {
  const auto rest = [&](std::size_t count) {
    nodes.take(count);
    return rest_of(grid, period, nodes, 13 * HalfAYear::hours + 9);
  };
  const double few = rest(5), some = rest(30), many = rest(100);
  EXPECT_LT(some, few);
  EXPECT_LT(many, some);
  EXPECT_LE(nodes.count_for(0.1), nodes.count_for(0.01));
}

TEST_F(SkyNodesOfHalfAYear, NodesAreMadeUpOfThemselves) {
  nodes.take(8);
  const std::vector<double> c = nodes.weights(period.of(nodes.ranked()[3]).sky);
  for (std::size_t m = 0; m < c.size(); ++m) EXPECT_NEAR(c[m], m == 3 ? 1 : 0, 0.05) << m;
}

TEST_F(SkyNodesOfHalfAYear, NoSkyNeedsNone) {
  nodes.take(8);
  EXPECT_TRUE(nodes.weights({}).empty());
}

class SunNodesOfHalfAYear : public testing::Test {
 protected:
  SkyGrid grid{16};
  HalfAYear period{grid};
  SunNodes nodes{period, 400};
};

TEST_F(SunNodesOfHalfAYear, LieNoFurtherThanAskedFor) {
  for (const double degrees : {20.0, 10.0, 5.0}) {
    const std::size_t count = nodes.count_for(degrees * radians_per_degree);
    double furthest = 0;
    for (std::size_t k = 0; k < period.intervals(); ++k) {
      if (!period.has_sun(k)) continue;
      double nearest = 2;
      for (std::size_t m = 0; m < count; ++m)
        nearest =
            std::min(nearest, norm(period.direction(k) - period.direction(nodes.ranked()[m])));
      furthest = std::max(furthest, nearest);
    }
    EXPECT_LE(furthest, degrees * radians_per_degree);
  }
}

TEST_F(SunNodesOfHalfAYear, MeetLinearFunctionsOfTheDirection) {
  nodes.take(nodes.count_for(8 * radians_per_degree));
  for (std::size_t k = 0; k < period.intervals(); ++k) {
    if (!period.has_sun(k)) continue;
    const Vec3 sun = period.direction(k);
    double sum = 0;
    Vec3 made;
    for (const auto& [node, weight] : nodes.weights(sun)) {
      sum += weight;
      made += weight * period.direction(nodes.ranked()[node]);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    // Across the tangent plane directions are met; along the sun the sphere bends by less than
    // the square of the reach, 2.2 × 8°. Where neighbours lie nearly on a line, at the rim, the
    // mean is off by less than the reach.
    EXPECT_LT(norm(made - sun), 2.2 * 8 * radians_per_degree);
  }
}

TEST_F(SunNodesOfHalfAYear, SunsInTheMiddleAreMetToTheCurvature) {
  nodes.take(nodes.count_for(8 * radians_per_degree));
  const Vec3 sun = period.direction(13 * HalfAYear::hours + 12);  // an equinox noon
  Vec3 made;
  for (const auto& [node, weight] : nodes.weights(sun))
    made += weight * period.direction(nodes.ranked()[node]);
  const double reach = 2.2 * 8 * radians_per_degree;
  EXPECT_LT(norm(made - sun), reach * reach / 2);
}

TEST_F(SunNodesOfHalfAYear, ASingleSunServesAll) {
  nodes.take(1);
  const auto weights = nodes.weights(period.direction(9));
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights.front().node, 0u);
  EXPECT_DOUBLE_EQ(weights.front().weight, 1);
}

}  // namespace
}  // namespace sunload
