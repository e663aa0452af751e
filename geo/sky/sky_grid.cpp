// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The square [-1, 1]² is made of rings of squares about its centre. A point at (a, b) with
// r = max(|a|, |b|) stands at cosθ = 1 - r², and runs along its ring in proportion to the
// azimuth (Shirley & Chiu 1997). Hence everything that depends on the zenith angle alone
// is a table by ring, and ∫ cosθ dω of a cell an integral of a polynomial.
#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/fast_math.h"
#include "geo/base/vector_code.h"
#include "geo/sky/sky.h"

namespace sunload {

namespace {

// Two-point Gauss-Legendre on [0, 1].
const double gauss_low = 0.5 - 0.5 / std::sqrt(3.0), gauss_high = 0.5 + 0.5 / std::sqrt(3.0);
// Cells on a diagonal are cut by it into two triangles, where r is the larger coordinate m:
// two points at m with the right mean 2/3 and variance 1/18 of r, the smaller one at m/2.
const double diagonal_low = 2.0 / 3 - std::sqrt(1.0 / 18),
             diagonal_high = 2.0 / 3 + std::sqrt(1.0 / 18);

constexpr std::size_t samples_per_cell = 4;
constexpr std::size_t levels_per_ring = 4;  // two Gauss points, two of a diagonal cell

struct Points {
  const double *x, *y, *z;
};

/// Indicatrix at so many points: most of what a sun costs in a small scene. The same bits with any
/// width of vectors.
SUNLOAD_VECTOR_CODE void indicatrix_at(const SkyShape& shape, const Vec3& sun, const Points& points,
                                       std::size_t count, double* indicatrix) {
  const SkyShape of_sky = shape;  // not to be read anew at every point
  const double sun_x = sun.x, sun_y = sun.y, sun_z = sun.z;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = points.x[i] - sun_x, y = points.y[i] - sun_y, z = points.z[i] - sun_z;
    indicatrix[i] = of_sky.indicatrix(x * x + y * y + z * z);
  }
}

}  // namespace

SkyGrid::SkyGrid(int size) : size_(size), half_(static_cast<double>(size) / 2) {
  SUNLOAD_EXPECT(size > 0 && size % 2 == 0, "a sky grid has an even number of cells per side");
  const auto cells = static_cast<std::size_t>(cell_count());
  projected_.resize(cells);
  for (auto* plane : {&x_, &y_, &z_}) plane->resize(samples_per_cell * cells);
  level_.resize(samples_per_cell * cells);
  for (std::size_t k = 0; k < static_cast<std::size_t>(size / 2); ++k) {
    for (const double step : {gauss_low, gauss_high, diagonal_low, diagonal_high}) {
      const double r = (static_cast<double>(k) + step) / half_;
      level_cosine_.push_back(1 - r * r);
    }
  }
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) place_samples(row, column);
  }
}

// Distance in cells from the middle of the square: 0 next to it.
std::size_t SkyGrid::ring(int index) const {
  const int middle = size_ / 2;
  return static_cast<std::size_t>(index >= middle ? index - middle : middle - 1 - index);
}

void SkyGrid::place_samples(int row, int column) {
  const std::size_t ring_a = ring(column), ring_b = ring(row);
  const std::size_t k = std::max(ring_a, ring_b);
  const bool diagonal = ring_a == ring_b;
  const int number = row * size_ + column;
  const auto cell = static_cast<std::size_t>(number);

  // ∫ cosθ over the cell by the moments of r = (k + t)/half, t its place across the ring.
  const double mean = diagonal ? 2.0 / 3 : 1.0 / 2;
  const double mean_square = diagonal ? 1.0 / 2 : 1.0 / 3;
  const auto inner = static_cast<double>(k);
  projected_[cell] =
      solid_angle() * (1 - (inner * inner + 2 * inner * mean + mean_square) / (half_ * half_));

  // Places across (outward) in a and b, and the level that follows from the larger.
  struct Place {
    double a, b;
    std::size_t level;
  };
  const double low = diagonal ? diagonal_low : gauss_low;
  const double high = diagonal ? diagonal_high : gauss_high;
  std::array<Place, samples_per_cell> places;
  if (diagonal) {
    places = {{{low, low / 2, 2}, {low / 2, low, 2}, {high, high / 2, 3}, {high / 2, high, 3}}};
  } else if (ring_a > ring_b) {
    places = {{{low, low, 0}, {low, high, 0}, {high, low, 1}, {high, high, 1}}};
  } else {
    places = {{{low, low, 0}, {high, low, 0}, {low, high, 1}, {high, high, 1}}};
  }
  const auto inward = [this](int index, double outward) {
    return index >= size_ / 2 ? outward : 1 - outward;
  };
  for (std::size_t i = 0; i < samples_per_cell; ++i) {
    const Vec3 w =
        direction(static_cast<int>(cell), inward(column, places[i].a), inward(row, places[i].b));
    const std::size_t at = i * projected_.size() + cell;
    x_[at] = w.x;
    y_[at] = w.y;
    z_[at] = w.z;
    level_[at] = static_cast<std::int32_t>(levels_per_ring * k + places[i].level);
  }
}

namespace {

/// Of a grid of `size` cells along each side.
inline std::int32_t cell_of(double x, double y, double z, std::int32_t size) {
  const double half = size / 2.0;
  const double ax = std::abs(x), ay = std::abs(y);
  const double larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
  // r² = 1 - cosθ, without the cancellation near the zenith.
  const double r = std::sqrt((ax * ax + ay * ay) / (1 + (z > 0 ? z : 0)));
  const double along = r * fast_octant(smaller / (larger > 0 ? larger : 1));
  // Both ways round, so that the choice is one of integers: no branch to mispredict.
  const auto index = [half](double distance, double side) {
    return static_cast<std::int32_t>((std::copysign(distance, side) + 1) * half);
  };
  const bool x_larger = ax >= ay;
  const std::int32_t column_across = index(r, x), column_along = index(along, x);
  const std::int32_t row_across = index(r, y), row_along = index(along, y);
  const std::int32_t column = x_larger ? column_across : column_along;
  const std::int32_t row = x_larger ? row_along : row_across;
  const std::int32_t last = size - 1;
  return (row < last ? row : last) * size + (column < last ? column : last);
}

SUNLOAD_VECTOR_CODE void cells_of(const double* __restrict x, const double* __restrict y,
                                  const double* __restrict z, std::size_t count, std::int32_t size,
                                  std::int32_t* __restrict cell) {
  for (std::size_t i = 0; i < count; ++i) cell[i] = cell_of(x[i], y[i], z[i], size);
}

}  // namespace

int SkyGrid::cell(Vec3 w) const { return cell_of(w.x, w.y, w.z, size_); }

void SkyGrid::cells(const double* x, const double* y, const double* z, std::size_t count,
                    std::int32_t* cell) const {
  cells_of(x, y, z, count, size_, cell);
}

Vec3 SkyGrid::direction(int cell, double u, double v) const {
  // Further from the border than the rounding of `cell` reaches.
  constexpr double margin = 1e-9;
  const int column = cell % size_, row = cell / size_;
  const double a = (column + std::clamp(u, margin, 1 - margin)) / half_ - 1;
  const double b = (row + std::clamp(v, margin, 1 - margin)) / half_ - 1;
  const bool a_larger = std::abs(a) >= std::abs(b);
  const double r = std::max(std::abs(a), std::abs(b));
  const double angle = pi / 4 * std::min(std::abs(a), std::abs(b)) / r;
  const double sine = r * std::sqrt(2 - r * r);  // of the zenith angle
  const double across = sine * fast_cos(angle), along = sine * fast_sin(angle);
  return {std::copysign(a_larger ? across : along, a), std::copysign(a_larger ? along : across, b),
          1 - r * r};
}

double SkyGrid::near_sun_mean(const SkyShape& shape, Vec3 sun, int cell) const {
  constexpr int n = 8;  // the cusp's share of the error falls with n³
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3 w = direction(cell, (i + 0.5) / n, (j + 0.5) / n);
      const Vec3 chord = w - sun;
      sum += shape.gradation(w.z) * shape.indicatrix(dot(chord, chord));
    }
  }
  return sum / (n * n);
}

// The gradation at each level, scaled so that its mean over a ring is that of more points:
// exp(b/cosθ) bends too sharply at the horizon for two.
std::vector<double> SkyGrid::level_gradation(const SkyShape& shape) const {
  constexpr int n = 8;
  std::vector<double> value(level_cosine_.size());
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = shape.gradation(level_cosine_[i]);
  for (std::size_t k = 0; k < value.size() / levels_per_ring; ++k) {
    double across = 0, diagonal = 0;  // a diagonal cell is as wide as its larger coordinate
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n, r = (static_cast<double>(k) + t) / half_;
      const double here = shape.gradation(1 - r * r);
      across += here / n;
      diagonal += 2 * t * here / n;
    }
    double* level = &value[levels_per_ring * k];
    const auto scale_pair = [](double* pair, double mean) {
      const double sum = pair[0] + pair[1];
      if (sum <= 0) return;
      for (int i = 0; i < 2; ++i) pair[i] *= 2 * mean / sum;
    };
    scale_pair(level, across);
    scale_pair(level + 2, diagonal);
  }
  return value;
}

std::vector<double> SkyGrid::mean_radiance(const RelativeSky& sky, double dhi) const {
  const std::size_t cells = projected_.size();
  std::vector<double> mean(cells, 0.0);
  if (dhi <= 0) return mean;
  const auto& [shape, sun] = sky;
  const std::vector<double> gradation = level_gradation(shape);
  // Blocks that stay in the first-level cache; the indicatrix is vector code.
  constexpr std::size_t block = 256;
  std::array<double, block> indicatrix;
  for (std::size_t plane = 0; plane < samples_per_cell; ++plane) {
    for (std::size_t begin = 0; begin < cells; begin += block) {
      const std::size_t count = std::min(block, cells - begin);
      const std::size_t first = plane * cells + begin;
      indicatrix_at(shape, sun, {&x_[first], &y_[first], &z_[first]}, count, indicatrix.data());
      const std::int32_t* level = &level_[first];
      for (std::size_t i = 0; i < count; ++i) {
        mean[begin + i] +=
            gradation[static_cast<std::size_t>(level[i])] * indicatrix[i] / samples_per_cell;
      }
    }
  }

  // Four points miss the cusp at the sun where it lies within about two cells.
  const double reach_squared = 4 * solid_angle();
  if (shape.c != 0) {
    for (std::size_t i = 0; i < cells; ++i) {
      const Vec3 chord = Vec3{x_[i], y_[i], z_[i]} - sun;
      if (dot(chord, chord) < reach_squared)
        mean[i] = near_sun_mean(shape, sun, static_cast<int>(i));
    }
  }

  double sum = 0;
  for (std::size_t i = 0; i < cells; ++i) sum += mean[i] * projected_[i];
  for (double& value : mean) value *= dhi / sum;
  return mean;
}

}  // namespace sunload
