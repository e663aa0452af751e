// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/year/sun_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geo/base/check.h"

namespace sunload {

namespace {

/// Neighbours lie within so many times the distance that no sun exceeds: six to ten of them.
constexpr double reach = 2.2;
/// Below it a fit extrapolates from suns that lie nearly on a line; then the mean of the
/// neighbours is taken.
constexpr double least_weight = -0.3;
/// Determinant of the moments, as a share of its bound: less, and the suns lie on a line.
constexpr double least_spread = 1e-6;

struct Near {
  std::size_t node;
  double x, y;      ///< tangent plane, from the sun that is looked for
  double nearness;  ///< weight of the fit
};

}  // namespace

SunNodes::SunNodes(const LitPeriod& period, std::size_t most,
                   const std::vector<std::size_t>& left_out) {
  std::vector<std::size_t> up;
  for (std::size_t k = 0; k < period.intervals(); ++k)
    if (period.has_sun(k) && !std::binary_search(left_out.begin(), left_out.end(), k))
      up.push_back(k);
  const std::size_t count = std::min(up.size(), most_candidates);
  std::vector<std::size_t> intervals(count);
  std::vector<Vec3> directions(count);
  for (std::size_t c = 0; c < count; ++c) {
    intervals[c] = up[c * up.size() / count];
    directions[c] = period.direction(intervals[c]);
  }
  distance_.push_back(std::numeric_limits<double>::infinity());
  if (count == 0) return;
  // The highest sun first; then always the one furthest from those that are chosen.
  std::vector<double> left(count, std::numeric_limits<double>::infinity());
  const auto highest = std::max_element(directions.begin(), directions.end(),
                                        [](Vec3 a, Vec3 b) { return a.z < b.z; });
  auto next = static_cast<std::size_t>(highest - directions.begin());
  while (ranked_.size() < std::min(most, count)) {
    ranked_.push_back(intervals[next]);
    directions_.push_back(directions[next]);
    for (std::size_t c = 0; c < count; ++c)
      left[c] = std::min(left[c], norm(directions[c] - directions[next]));
    const auto furthest = std::max_element(left.begin(), left.end());
    distance_.push_back(*furthest);
    next = static_cast<std::size_t>(furthest - left.begin());
    if (*furthest <= 0) break;
  }
}

std::size_t SunNodes::count_for(double distance) const {
  for (std::size_t m = 1; m < distance_.size(); ++m)
    if (distance_[m] <= distance) return m;
  return ranked_.size();
}

void SunNodes::take(std::size_t count) {
  SUNLOAD_EXPECT(count <= ranked_.size(), "suns that are ranked");
  taken_ = count;
}

std::vector<SunNodes::Weight> SunNodes::weights(Vec3 to_sun) const {
  const Tangents axes = tangents(to_sun);
  // A single sun has no spacing; all of the others have.
  const double spacing = distance_[taken_] > 0 ? distance_[taken_] : 1e-6;
  std::vector<Near> near;
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < taken_; ++m) {
    const Vec3 d = directions_[m] - to_sun;
    const double distance = norm(d);
    if (distance < least) {
      least = distance;
      nearest = m;
    }
    const double share = distance / (reach * spacing);
    if (share >= 1) continue;
    const double w = (1 - share * share) * (1 - share * share);
    near.push_back({m, dot(d, axes.tangent), dot(d, axes.bitangent), w});
  }
  if (near.empty()) return {{nearest, 1.0}};
  // The moments of 1, x, y are symmetric: rows and columns are the same.
  std::array<Vec3, 3> moments{};
  for (const Near& n : near) {
    const Vec3 p{1, n.x, n.y};
    moments[0] += n.nearness * p;
    moments[1] += n.nearness * n.x * p;
    moments[2] += n.nearness * n.y * p;
  }
  // The fit at the origin: the first column of their inverse.
  const Vec3 column = cross(moments[1], moments[2]);
  const double determinant = dot(moments[0], column);
  bool is_sound = determinant > least_spread * moments[0].x * moments[1].y * moments[2].z;
  Vec3 fit = is_sound ? column / determinant : Vec3{};
  for (const Near& n : near)
    is_sound = is_sound && n.nearness * dot(fit, {1, n.x, n.y}) >= least_weight;
  if (!is_sound) fit = {1 / moments[0].x, 0, 0};
  std::vector<Weight> weights;
  for (const Near& n : near) weights.push_back({n.node, n.nearness * dot(fit, {1, n.x, n.y})});
  return weights;
}

}  // namespace sunload
