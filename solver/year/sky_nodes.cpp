// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/year/sky_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/base/check.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// Cells of the sky are joined by two in each direction, where skies are compared: 4.4°.
constexpr std::size_t joined = 2;

/// A sky made up of others has their errors, times the length of c: the samples about the sun err
/// by up to this share of a node's sky where edges cut it.
constexpr double error_of_nodes = 0.005;

double sum_of(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0,
                         [](double sum, float x) { return sum + static_cast<double>(x); });
}

double square_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float x : values) sum += static_cast<double>(x) * static_cast<double>(x);
  return sum;
}

double product(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sum;
}

/// Every interval that has a sky, or evenly spread ones of them.
std::vector<std::size_t> candidates(const LitPeriod& period, std::size_t most,
                                    const std::vector<std::size_t>& left_out) {
  std::vector<std::size_t> lit;
  for (std::size_t k = 0; k < period.intervals(); ++k)
    if (!period.is_dark(k) && !std::binary_search(left_out.begin(), left_out.end(), k))
      lit.push_back(k);
  if (lit.size() <= most) return lit;
  std::vector<std::size_t> some(most);
  for (std::size_t c = 0; c < most; ++c) some[c] = lit[c * lit.size() / most];
  return some;
}

}  // namespace

SkyNodes::SkyNodes(const SkyGrid& grid, const LitPeriod& period, std::size_t most,
                   const std::vector<std::size_t>& left_out)
    : side_(static_cast<std::size_t>(grid.side())) {
  const std::vector<std::size_t> intervals = candidates(period, most_candidates, left_out);
  std::vector<std::vector<float>> skies(intervals.size());
  std::vector<double> strength(intervals.size());
  parallel_for(intervals.size(), [&](std::size_t c) {
    skies[c] = coarse(period.of(intervals[c]).sky);
    strength[c] = sum_of(skies[c]);
    if (strength[c] <= 0) return skies[c].clear();
    for (float& x : skies[c]) x /= static_cast<float>(strength[c]);
  });
  // Gram-Schmidt, the largest rest first. Faint skies matter less, by the root of their strength.
  std::vector<std::vector<float>> rest = skies;
  std::vector<double> size(rest.size());
  const auto measure = [&] {
    parallel_for(
        rest.size(), [&](std::size_t c) { size[c] = square_of(rest[c]) * strength[c]; }, 8);
  };
  measure();
  double whole = 0;
  for (const double s : size) whole += s;
  while (whole > 0) {
    rest_.push_back(std::sqrt(std::accumulate(size.begin(), size.end(), 0.0) / whole));
    const auto next =
        static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    // Below this the rests are rounding alone.
    if (ranked_.size() == std::min(most, intervals.size()) || rest_.back() < 1e-5) break;
    ranked_.push_back(intervals[next]);
    skies_.push_back(skies[next]);
    strength_.push_back(strength[next]);
    std::vector<float> axis = rest[next];
    const double length = std::sqrt(square_of(axis));
    for (float& x : axis) x /= static_cast<float>(length);
    parallel_for(
        rest.size(),
        [&](std::size_t c) {
          if (rest[c].empty()) return;
          const auto along = static_cast<float>(product(rest[c], axis));
          for (std::size_t i = 0; i < axis.size(); ++i) rest[c][i] -= along * axis[i];
        },
        8);
    std::fill(rest[next].begin(), rest[next].end(), 0.0f);
    measure();
  }
}

std::vector<float> SkyNodes::coarse(const std::vector<double>& sky) const {
  const std::size_t side = side_ / joined;
  SUNLOAD_EXPECT(sky.empty() || sky.size() == side_ * side_, "a sky of all cells of the grid");
  std::vector<float> cells(side * side, 0);
  for (std::size_t c = 0; c < sky.size(); ++c)
    cells[c / side_ / joined * side + c % side_ / joined] += static_cast<float>(sky[c]);
  return cells;
}

std::size_t SkyNodes::count_for(double rest) const {
  for (std::size_t m = 0; m < rest_.size(); ++m)
    if (rest_[m] <= rest) return m;
  return ranked_.size();
}

void SkyNodes::take(std::size_t count) {
  SUNLOAD_EXPECT(count <= ranked_.size(), "skies that are ranked");
  const std::vector<std::vector<float>> taken(skies_.begin(),
                                              skies_.begin() + static_cast<std::ptrdiff_t>(count));
  double square = 0;
  for (const auto& sky : taken) square += square_of(sky) / static_cast<double>(count);
  fit_.emplace(taken, error_of_nodes * error_of_nodes * square);
}

std::vector<double> SkyNodes::weights(const std::vector<double>& sky) const {
  if (count() == 0 || sky.empty()) return {};
  const std::vector<float> cells = coarse(sky);
  std::vector<double> c = fit_->coefficients(cells);
  for (std::size_t m = 0; m < c.size(); ++m) c[m] /= strength_[m];
  return c;
}

}  // namespace sunload
