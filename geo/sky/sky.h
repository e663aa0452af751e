// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Radiance of the sky by direction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/base/fast_math.h"
#include "geo/base/units.h"
#include "geo/base/vec.h"
#include "geo/sky/irradiance.h"

namespace sunload {

/// uniform: the same radiance everywhere; cie_general: one of 15 types (`SkyInput::cie_type`);
/// references at `Sky`.
enum class SkyModel { uniform, cie_overcast, cie_clear, cie_general, perez, preetham };

/// What a sky is made from. Only the numbers of its model count beside `dhi` and the sun.
struct SkyInput {
  SkyModel model = SkyModel::perez;
  double dhi = 0;  ///< horizontal diffuse irradiance to be met [W m-2]
  double dni = 0;  ///< for the clearness of perez
  double extraterrestrial_normal = 1361;
  double sun_zenith_deg = 90;   ///< at most 90; without sun above the horizon, 90
  Vec3 sun_direction{0, 1, 0};  ///< unit, the frame of the queries
  int cie_type = 12;            ///< 1…15, of cie_general
  double turbidity = 3;         ///< of preetham, [1, 20]; fitted for 2…10
};

/// Relative radiance of all models in one formula: gradation × indicatrix,
///
///     (u + v·exp(b / max(cosθ, cos_floor)) + s·cosθ) · (f + c·exp(d·γ) + e·cos²γ)
///
/// θ from the zenith, γ from the sun. Both factors are ≥ 0 for every sky.
struct SkyShape {
  double u = 1, v = 0, b = 0, s = 0, cos_floor = 1e-6;
  double f = 1, c = 0, d = 0, e = 0;

  double gradation(double cos_zenith) const {
    const double bounded = cos_zenith > cos_floor ? cos_zenith : cos_floor;
    return positive(u + v * fast_exp(b / bounded) + s * cos_zenith);
  }
  /// By the square of the chord between direction and sun, exact near the sun.
  double indicatrix(double chord_squared) const {
    const double angle = 2 * fast_asin(0.5 * std::sqrt(chord_squared));
    const double cosine = 1 - 0.5 * chord_squared;
    return positive(f + c * fast_exp(d * angle) + e * (cosine * cosine));
  }

 private:
  static double positive(double x) { return x > 0 ? x : 0; }  // against rounding
};

/// Coefficients a … e of the Perez sky as published, before `SkyShape` bounds them.
struct PerezCoefficients {
  double a = 0, b = 0, c = 0, d = 0, e = 0;
};
/// Perez, Seals & Michalsky (1993), Solar Energy 50, table 1. Brightness below 0.2 counts
/// as 0.2 for 1.065 < clearness < 2.8 (as in Radiance), and is bounded to [0.01, 0.6].
PerezCoefficients perez_coefficients(const SkyCondition& sky, double sun_zenith_deg);

/// Zenith luminance [kcd m-2], Preetham, Shirley & Smits (1999), appendix A.2; never
/// negative (the formula is, for low turbidity and a low sun).
double preetham_zenith_luminance_kcd(double turbidity, double sun_zenith_deg);

/// Horizontal illuminance [klx] of the whole sky with Preetham's zenith luminance and
/// distribution; the sun at most 90 degrees from the zenith.
double preetham_illuminance_klx(double turbidity, double sun_zenith_deg);

/// The same of any model's distribution (SkyInput::sun_zenith_deg, cie_type, turbidity; of perez
/// the irradiances, too) with that luminance at the zenith [kcd m-2].
double illuminance_klx(const SkyInput& sky, double zenith_luminance_kcd);

/// ∫ gradation·indicatrix·cosθ dω over the hemisphere with the sun at this cosine of the
/// zenith angle, within 2e-7 (measured in the tests), in about 40 µs.
double horizontal_integral(const SkyShape& shape, double sun_cos_zenith);

/// Radiance but for a factor, and the sun that it goes by: unit, on or above the horizon.
struct RelativeSky {
  SkyShape shape;
  Vec3 sun{0, 1, 0};
};
/// The same input as of `Sky`, in a fiftieth of its time; std::logic_error as there. Of a sky
/// without diffuse light: uniform.
RelativeSky relative_sky(const SkyInput& input);

/// A sky whose horizontal irradiance ∫ L cosθ dω equals `dhi` within 1e-6.
///
/// Finite and not negative in every direction above the horizon, zero below.
/// A sun below the horizon acts from the horizon's point below which it stands.
/// CIE: ISO 15469:2004; overcast: Moon & Spencer (1942); clear: Kittler (1967).
class Sky {
 public:
  /// std::logic_error where a number is not finite, negative or out of its range.
  explicit Sky(const SkyInput& input);
  /// Radiance [W m-2 sr-1] from the unit direction `w` (away from the ground).
  double radiance(Vec3 w) const {
    if (w.z < 0) return 0;
    const Vec3 chord = w - sun_;
    return scale_ * shape_.gradation(w.z) * shape_.indicatrix(dot(chord, chord));
  }

  const SkyShape& shape() const { return shape_; }
  Vec3 sun_direction() const { return sun_; }  ///< on or above the horizon
  RelativeSky relative() const { return {shape_, sun_}; }

 private:
  SkyShape shape_;
  Vec3 sun_;
  double scale_ = 0;
};

/// Equal-area cells of the upper hemisphere, about 90°/size wide everywhere
/// (Shirley & Chiu 1997: square → disc → hemisphere, equal areas kept).
class SkyGrid {
 public:
  /// `size` is even.
  explicit SkyGrid(int size = 64);
  int cell_count() const { return size_ * size_; }
  /// Cells per side: cell c lies in row c / side and column c % side of the square [-1, 1]².
  int side() const { return size_; }
  double solid_angle() const { return 2 * pi / cell_count(); }
  /// Cell of a unit direction with w.z ≥ 0 (slightly less counts as 0).
  int cell(Vec3 w) const;
  /// The same of `count` directions side by side; for those with w.z < 0 it means nothing.
  void cells(const double* x, const double* y, const double* z, std::size_t count,
             std::int32_t* cell) const;
  /// Direction of a point of a cell; u, v in [0, 1). `cell` gives the same cell back:
  /// points within 1e-9 of a cell's border are drawn in by as much.
  Vec3 direction(int cell, double u, double v) const;
  /// Horizontal projection of the cells, ∫ cosθ dω [sr].
  const std::vector<double>& projected() const { return projected_; }
  /// Mean radiance of each cell (4 points, 64 near the sun), scaled so that
  /// Σ radiance·projected equals `dhi` [W m-2] to rounding. At size 64 the worst cell of
  /// the worst sky (CIE 15) is off by 0.3 %, and the scale by 0.4 % (sun at the horizon).
  std::vector<double> mean_radiance(const RelativeSky& sky, double dhi) const;
  std::vector<double> mean_radiance(const Sky& sky, double dhi) const {
    return mean_radiance(sky.relative(), dhi);
  }

 private:
  // Samples lie in 4 planes of one point per cell; the zenith angle of a sample depends
  // on its ring alone, so there are only 2·size different ones.
  void place_samples(int row, int column);
  std::size_t ring(int index) const;
  std::vector<double> level_gradation(const SkyShape& shape) const;
  double near_sun_mean(const SkyShape& shape, Vec3 sun, int cell) const;

  int size_;
  double half_;  ///< size / 2: the square is [-1, 1]²
  std::vector<double> projected_;
  std::vector<double> x_, y_, z_;
  std::vector<std::int32_t> level_;  ///< into level_cosine_, per sample
  std::vector<double> level_cosine_;
};

}  // namespace sunload
