// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/circumsolar_sky.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/vector_code.h"

namespace sunload {

namespace {

// Measured on the built-in street under clear skies, suns from 12° to 40°: with less the samples
// of half-hidden skies have the larger part of the error, with more the lines.
constexpr double cap_by_mean = 3;
constexpr double reach =
    30 * radians_per_degree;          ///< about the sun: a clear horizon is bright, too
constexpr double least_share = 0.02;  ///< of the sky, for its samples to be worth it
constexpr double shares = 1u << 31;   ///< of the strength

constexpr double corner_u[4] = {0, 1, 0, 1}, corner_v[4] = {0, 0, 1, 1};

/// What exceeds a multiple of the mean radiance near the sun; empty where it is not worth it.
std::vector<double> excess(const SkyGrid& grid, const std::vector<double>& radiance, Vec3 to_sun) {
  double horizontal = 0, projected = 0;
  for (std::size_t c = 0; c < radiance.size(); ++c) {
    horizontal += radiance[c] * grid.projected()[c];
    projected += grid.projected()[c];
  }
  const double cap = cap_by_mean * horizontal / projected;
  std::vector<double> above(radiance.size(), 0);
  const double least_cosine_to_sun = std::cos(reach);
  for (std::size_t c = 0; c < radiance.size(); ++c)
    if (radiance[c] > cap &&
        dot(grid.direction(static_cast<int>(c), 0.5, 0.5), to_sun) > least_cosine_to_sun)
      above[c] = radiance[c] - cap;
  const double sum = std::accumulate(above.begin(), above.end(), 0.0);
  const double all = std::accumulate(radiance.begin(), radiance.end(), 0.0);
  return sum > least_share * all ? above : std::vector<double>();
}

/// Bits of column and row in turn (Morton 1966): cells of near codes are near each other, and
/// points that are spread evenly over them in this order are spread evenly over the sky.
std::uint32_t morton_code(const SkyGrid& grid, int cell) {
  const auto column = static_cast<std::uint32_t>(cell % grid.side()),
             row = static_cast<std::uint32_t>(cell / grid.side());
  std::uint32_t code = 0;
  for (std::uint32_t bit = 0; bit < 16; ++bit)
    code |= (column >> bit & 1u) << (2 * bit) | (row >> bit & 1u) << (2 * bit + 1);
  return code;
}

/// Cells that have something, in that order.
std::vector<int> near_each_other(const SkyGrid& grid, const std::vector<double>& part) {
  std::vector<int> cells;
  for (int c = 0; c < grid.cell_count(); ++c)
    if (part[static_cast<std::size_t>(c)] > 0) cells.push_back(c);
  std::ranges::sort(cells, {}, [&](int c) { return morton_code(grid, c); });
  return cells;
}

/// What a band has of the sky where that part lies, relative to the broadband sky.
double factor_of_band(const std::vector<double>& part, const std::vector<double>& broadband,
                      const std::vector<double>& of_band) {
  const double sum = std::inner_product(part.begin(), part.end(), broadband.begin(), 0.0);
  return std::inner_product(part.begin(), part.end(), of_band.begin(), 0.0) / sum;
}

}  // namespace

CircumsolarSky::CircumsolarSky(const SkyGrid& grid, const IntervalLight& light) {
  band_factors_.fill(1);
  if (light.sky.empty()) return;
  std::vector<double> part = excess(grid, light.sky, light.direction);
  if (part.empty()) return;
  for (std::size_t b = 0; b < light.bands.size(); ++b)
    band_factors_[b] = factor_of_band(part, light.sky, light.bands[b].sky);
  for (std::size_t b = 0; b < light.bands.size(); ++b)
    for (std::size_t c = 0; c < part.size(); ++c)
      part[c] = std::min(part[c], light.bands[b].sky[c] / band_factors_[b]);

  circumsolar_ = std::move(part);
  cell_width_ = 2.0f / static_cast<float>(grid.side());
  strength_ = grid.solid_angle() * std::accumulate(circumsolar_.begin(), circumsolar_.end(), 0.0);
  for (const int cell : near_each_other(grid, circumsolar_)) add_cell(grid, cell);
  find_cone();
}

void CircumsolarSky::find_cone() {
  axis_ = normalized(axis_);
  double least_cosine = 1;
  for (std::size_t corner = 0; corner < 4; ++corner)
    for (std::size_t c = 0; c < brightness_.size(); ++c)
      least_cosine = std::min(
          least_cosine, dot({static_cast<double>(x_[corner][c]), static_cast<double>(y_[corner][c]),
                             static_cast<double>(z_[corner][c])},
                            axis_));
  if (least_cosine > 0) sine_ = std::sqrt(1 - least_cosine * least_cosine);
}

void CircumsolarSky::add_cell(const SkyGrid& grid, int cell) {
  const double brightness =
      circumsolar_[static_cast<std::size_t>(cell)] * grid.solid_angle() / strength_;
  axis_ += brightness * grid.direction(cell, 0.5, 0.5);
  place_.push_back(morton_code(grid, cell));
  brightness_.push_back(static_cast<float>(brightness));
  const int column = cell % grid.side(), row = cell / grid.side();
  a_.push_back(static_cast<float>(column) * cell_width_ - 1);
  b_.push_back(static_cast<float>(row) * cell_width_ - 1);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const Vec3 w = grid.direction(cell, corner_u[corner], corner_v[corner]);
    x_[corner].push_back(static_cast<float>(w.x));
    y_[corner].push_back(static_cast<float>(w.y));
    z_[corner].push_back(static_cast<float>(w.z));
  }
}

/// A cell that another sky has, too.
void CircumsolarSky::add_cell_of(const CircumsolarSky& other, std::size_t c, float brightness) {
  place_.push_back(other.place_[c]);
  brightness_.push_back(brightness);
  a_.push_back(other.a_[c]);
  b_.push_back(other.b_[c]);
  Vec3 sum{0, 0, 0};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    x_[corner].push_back(other.x_[corner][c]);
    y_[corner].push_back(other.y_[corner][c]);
    z_[corner].push_back(other.z_[corner][c]);
    sum += Vec3{static_cast<double>(other.x_[corner][c]), static_cast<double>(other.y_[corner][c]),
                static_cast<double>(other.z_[corner][c])};
  }
  axis_ += static_cast<double>(brightness) * sum;
}

bool any_circumsolar(const std::vector<CircumsolarSky>& skies) {
  return std::any_of(skies.begin(), skies.end(), [](const CircumsolarSky& s) { return s.any(); });
}

CircumsolarMixture::CircumsolarMixture(std::span<const CircumsolarSky> all, std::size_t first,
                                       std::size_t count)
    : first_(first), count_(count) {
  SUNLOAD_EXPECT(count <= block_width, "no more skies than suns of a block");
  const auto skies = all.subspan(first, count);
  const auto with_light = static_cast<double>(std::ranges::count_if(skies, &CircumsolarSky::any));
  if (with_light == 0) return;
  sky_.strength_ = with_light;
  constexpr std::uint32_t no_more = std::numeric_limits<std::uint32_t>::max();
  std::array<std::size_t, block_width> at{};  // of each sky, the next of its cells
  const auto next_cell = [&](std::size_t k) {
    return at[k] < skies[k].place_.size() ? skies[k].place_[at[k]] : no_more;
  };
  std::array<double, block_width> squares{};  // Σ share² / S of each sky
  for (;;) {
    std::size_t next = 0;
    for (std::size_t k = 1; k < count; ++k)
      if (next_cell(k) < next_cell(next)) next = k;
    const std::uint32_t cell = next_cell(next);
    if (cell == no_more) break;
    const std::size_t place_in_next = at[next];
    std::array<double, block_width> share{};
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k)
      if (next_cell(k) == cell)
        sum += share[k] = static_cast<double>(skies[k].brightness_[at[k]++]);
    sky_.cell_width_ = skies[next].cell_width_;
    sky_.add_cell_of(skies[next], place_in_next, static_cast<float>(sum / with_light));
    for (std::size_t k = 0; k < block_width; ++k) {
      squares[k] += share[k] * share[k] / sum;
      of_skies_.push_back(share[k] > 0 ? static_cast<float>(skies[k].strength() * share[k] / sum)
                                       : 0);
    }
  }
  sky_.find_cone();
  // By samples of its own a sky has the mean square ∫ L²/L dω, by those of S it has ∫ L²/S dω.
  constexpr double least_of_own = 0.25;
  samples_needed_ = with_light * std::max(std::ranges::max(squares), least_of_own);
}

std::vector<CircumsolarMixture> circumsolar_mixtures(std::span<const CircumsolarSky> skies) {
  // One by itself needs 1: what is nearly that is no gain, and wider mixtures look at more cells.
  constexpr double worthwhile = 0.75;
  std::vector<CircumsolarMixture> mixtures;
  for (std::size_t k = 0; k < skies.size(); ++k) {
    if (!mixtures.empty()) {
      CircumsolarMixture& last = mixtures.back();
      CircumsolarMixture with_it(skies, last.first(), last.count() + 1);
      const double more = with_it.samples_needed() - last.samples_needed();
      if (more < worthwhile || last.samples_needed() == 0) {
        last = std::move(with_it);
        continue;
      }
    }
    mixtures.emplace_back(skies, k, 1);
  }
  return mixtures;
}

namespace {

/// A cell's cosines may be as much above what its corners tell, most of all where the grid's map
/// has a kink along the diagonals of its square.
constexpr float least_q = 0.01f;

/// The cosine at one corner of all cells.
SUNLOAD_VECTOR_CODE void cosines(const float* x, const float* y, const float* z,
                                 const float* normal, std::size_t cells, float* cosine) {
  for (std::size_t c = 0; c < cells; ++c)
    cosine[c] = x[c] * normal[0] + y[c] * normal[1] + z[c] * normal[2];
}

/// From cosines at the corners to q, and the cells' shares of ∫ L_circ q dω.
SUNLOAD_VECTOR_CODE void weigh(const float* __restrict brightness, float scale, std::size_t cells,
                               float* __restrict q0, float* __restrict q1, float* __restrict q2,
                               float* __restrict q3, std::int32_t* __restrict share) {
  constexpr float half = 0.5f;  // cut off: rounds what is not below 0
  for (std::size_t c = 0; c < cells; ++c) {
    const float upper = q0[c] > q1[c] ? q0[c] : q1[c], lower = q2[c] > q3[c] ? q2[c] : q3[c];
    const float largest = upper > lower ? upper : lower;
    const float in_front = largest > -least_q ? 1.0f : 0.0f;
    q0[c] = q0[c] > least_q ? q0[c] : least_q;
    q1[c] = q1[c] > least_q ? q1[c] : least_q;
    q2[c] = q2[c] > least_q ? q2[c] : least_q;
    q3[c] = q3[c] > least_q ? q3[c] : least_q;
    const float mean = 0.25f * (q0[c] + q1[c] + q2[c] + q3[c]);
    share[c] = static_cast<std::int32_t>(scale * brightness[c] * mean * in_front + half);
  }
}

}  // namespace

void CircumsolarView::look(const CircumsolarSky& sky, Vec3 normal) {
  sky_ = &sky;
  normal_[0] = static_cast<float>(normal.x);
  normal_[1] = static_cast<float>(normal.y);
  normal_[2] = static_cast<float>(normal.z);
  const std::size_t cells = sky.brightness_.size();
  for (std::size_t corner = 0; corner < 4; ++corner) {
    q_[corner].resize(cells);
    cosines(sky.x_[corner].data(), sky.y_[corner].data(), sky.z_[corner].data(), normal_, cells,
            q_[corner].data());
  }
  // Less than 2^31 in all, since no cosine is above 1 but by rounding.
  constexpr double scale = 0.99 * shares;
  share_.resize(cells);
  weigh(sky.brightness_.data(), static_cast<float>(scale), cells, q_[0].data(), q_[1].data(),
        q_[2].data(), q_[3].data(), share_.data());
  sums_.resize(std::bit_ceil(cells));
  std::uint32_t sum = 0;
  for (std::size_t c = 0; c < cells; ++c) sums_[c] = sum += static_cast<std::uint32_t>(share_[c]);
  std::fill(sums_.begin() + static_cast<std::ptrdiff_t>(cells), sums_.end(),
            std::numeric_limits<std::uint32_t>::max());
  irradiance_ = sky.strength() * sum / scale;
}

namespace {

/// What a sample is drawn by.
struct Drawn {
  alignas(64) float u[packet_size], v[packet_size];  ///< uniform, later the place in the cell
  alignas(64) float q00[packet_size], q10[packet_size], q01[packet_size], q11[packet_size];
  alignas(64) float a[packet_size], b[packet_size];  ///< point of the grid's square
};

/// First cell whose sum exceeds `at`, by bisection of a power of two cells.
SUNLOAD_VECTOR_CODE void find_cells(const std::uint32_t* sums, std::size_t size,
                                    const std::uint32_t* at, std::uint32_t* cell) {
  for (std::size_t s = 0; s < packet_size; ++s) cell[s] = 0;
  for (auto step = static_cast<std::uint32_t>(size / 2); step > 0; step /= 2)
    for (std::size_t s = 0; s < packet_size; ++s)
      cell[s] += sums[cell[s] + step - 1] <= at[s] ? step : 0;
}

/// x in [0, 1] with a density linear from f0 to f1 (inverse of its distribution).
inline float sample_linear(float u, float f0, float f1) {
  return u * (f0 + f1) / (f0 + std::sqrt(f0 * f0 + u * (f1 * f1 - f0 * f0)));
}

/// Places in cells by their bilinear q; then the direction there as SkyGrid::direction has it, in
/// single precision and without branches, in the shape that compilers turn into vector code: sine
/// and cosine by their series, which end below 1e-6 at π/4.
SUNLOAD_VECTOR_CODE void aim(const Drawn& __restrict drawn, float cell_width,
                             const float* __restrict normal,
                             CircumsolarView::Samples& __restrict out) {
  constexpr float quarter_pi = 0.78539816f, least = 1e-20f;
  for (std::size_t s = 0; s < packet_size; ++s) {
    const float q00 = drawn.q00[s], q10 = drawn.q10[s], q01 = drawn.q01[s], q11 = drawn.q11[s];
    const float v = sample_linear(drawn.v[s], q00 + q10, q01 + q11);
    const float left = q00 + v * (q01 - q00), right = q10 + v * (q11 - q10);
    const float u = sample_linear(drawn.u[s], left, right);
    const float q = left + u * (right - left);

    const float a = drawn.a[s] + cell_width * u, b = drawn.b[s] + cell_width * v;
    const float size_a = std::fabs(a), size_b = std::fabs(b);
    const float r = size_a > size_b ? size_a : size_b, less = size_a > size_b ? size_b : size_a;
    const float angle = quarter_pi * less / (r + least), square = angle * angle;
    const float sine = angle * (1 - square / 6 * (1 - square / 20 * (1 - square / 42)));
    const float cosine = 1 - square / 2 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56)));
    const float sine_of_zenith = r * std::sqrt(2 - r * r);
    const float across = sine_of_zenith * cosine, along = sine_of_zenith * sine;
    const float x = std::copysign(size_a > size_b ? across : along, a);
    const float y = std::copysign(size_a > size_b ? along : across, b);
    const float z = 1 - r * r;
    out.directions.x[s] = x;
    out.directions.y[s] = y;
    out.directions.z[s] = z;
    const float cos_theta = x * normal[0] + y * normal[1] + z * normal[2];
    out.weight[s] = cos_theta > 0 ? cos_theta / q : 0.0f;
  }
}

}  // namespace

void CircumsolarView::sample(const ScrambledPoints& points, Samples& out) const {
  alignas(64) std::uint32_t at[packet_size], rest[packet_size];
  const std::uint64_t sum = sums_[share_.size() - 1];
  for (std::size_t s = 0; s < packet_size; ++s) {
    const std::uint64_t chosen = points.u[s] * sum;
    at[s] = static_cast<std::uint32_t>(chosen >> 32);
    rest[s] = static_cast<std::uint32_t>(chosen);
  }
  Drawn drawn;
  find_cells(sums_.data(), sums_.size(), at, out.cell);
  for (std::size_t s = 0; s < packet_size; ++s) {
    // cppcheck-suppress uninitvar  // find_cells fills it
    const std::uint32_t cell = out.cell[s];
    // What is left of u after the choice of a cell is uniform again.
    const auto share = static_cast<std::uint32_t>(share_[cell]);
    drawn.u[s] = (static_cast<float>(at[s] - (sums_[cell] - share)) + uniform(rest[s])) /
                 static_cast<float>(share);
    drawn.v[s] = uniform(points.v[s]);
    drawn.q00[s] = q_[0][cell];
    drawn.q10[s] = q_[1][cell];
    drawn.q01[s] = q_[2][cell];
    drawn.q11[s] = q_[3][cell];
    drawn.a[s] = sky_->a_[cell];
    drawn.b[s] = sky_->b_[cell];
  }
  aim(drawn, sky_->cell_width_, normal_, out);
  out.in_front = 0;
  for (std::size_t s = 0; s < packet_size; ++s)
    if (out.weight[s] > 0) out.in_front |= 1u << s;
}

}  // namespace sunload
