// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/matrix/polygon_exchange.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/units.h"

namespace sunload {

namespace {

/// u ln r of the elementary integral, 0 where both vanish.
double times_log(double u, double r) { return r > 0 ? u * std::log(r) : 0; }

/// A straight edge.
struct SourceEdge {
  Vec3 begin, along;  ///< along: unit
  double length = 0;

  Vec3 at(double s) const { return begin + along * s; }
  /// ∫ ln |x - y| ds over its points y.
  double log_distance(Vec3 x) const {
    const Vec3 from_begin = x - begin;
    const double a = dot(from_begin, along), h = norm(cross(from_begin, along));
    const auto primitive = [h](double u) {
      return times_log(u, std::hypot(u, h)) - u + (h > 0 ? h * std::atan(u / h) : 0);
    };
    return primitive(length - a) - primitive(-a);
  }
};

std::vector<SourceEdge> edges_of(std::span<const Vec3> polygon, Vec3 origin, double unit_m) {
  std::vector<SourceEdge> edges;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = (polygon[k] - origin) / unit_m;
    const Vec3 b = (polygon[(k + 1) % polygon.size()] - origin) / unit_m;
    const double length = norm(b - a);
    if (length > 0) edges.push_back({a, (b - a) / length, length});
  }
  return edges;
}

struct GaussPoint {
  double at, weight;
};
/// Five points on [0, 1] (Abramowitz & Stegun 1964, table 25.4).
constexpr std::array<GaussPoint, 5> gauss{{{0.046910077030668, 0.118463442528095},
                                           {0.230765344947158, 0.239314335249683},
                                           {0.5, 0.284444444444444},
                                           {0.769234655052842, 0.239314335249683},
                                           {0.953089922969332, 0.118463442528095}}};

/// ∫ over [low, high] of `outer` of the inner integral over `inner`.
class EdgePair {
 public:
  EdgePair(const SourceEdge& outer, const SourceEdge& inner, double tolerance)
      : outer_(outer), inner_(inner), tolerance_(tolerance) {}
  double integral() const { return refined(0, outer_.length, on(0, outer_.length), deepest); }

 private:
  static constexpr int deepest = 40;
  /// Of the inner integral: a difference of numbers of about 1, however short its edge is.
  static constexpr double rounding = 1e-15;

  double on(double low, double high) const {
    double sum = 0;
    for (const auto& [at, weight] : gauss)
      sum += weight * inner_.log_distance(outer_.at(low + at * (high - low)));
    return sum * (high - low);
  }
  double refined(double low, double high, double whole, int depth) const {
    const double middle = (low + high) / 2, first = on(low, middle), second = on(middle, high);
    const double halves = first + second;
    const double least = std::max(tolerance_, rounding * (high - low));
    if (depth == 0 || std::abs(halves - whole) <= least) return halves;
    return refined(low, middle, first, depth - 1) + refined(middle, high, second, depth - 1);
  }

  const SourceEdge& outer_;
  const SourceEdge& inner_;
  double tolerance_;
};

Vec3 centre_of(std::span<const Vec3> polygon) {
  Vec3 sum;
  for (const Vec3& corner : polygon) sum += corner;
  return sum / static_cast<double>(polygon.size());
}

Vec3 area_vector(std::span<const Vec3> polygon) {
  Vec3 sum;
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]) / 2;
  return sum;
}

/// Of the size of the exchange: that of two small surfaces at the centres, at most the smaller one.
double rough_exchange(std::span<const Vec3> from, std::span<const Vec3> to) {
  const Vec3 way = centre_of(to) - centre_of(from), a = area_vector(from), b = area_vector(to);
  const double squared = dot(way, way);
  const double far = std::abs(dot(a, way) * dot(b, way)) / (pi * squared * squared);
  return std::min({far, norm(a), norm(b)});
}

}  // namespace

std::vector<Vec3> in_front(std::span<const Vec3> polygon, Vec3 at, Vec3 n, double tolerance_m) {
  std::vector<Vec3> kept;
  bool any = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double da = dot(a - at, n), db = dot(b - at, n);
    any |= da > tolerance_m;
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  if (!any || kept.size() < 3) kept.clear();
  return kept;
}

double exchange_area(std::span<const Vec3> from, std::span<const Vec3> to) {
  constexpr double relative = 1e-7, rounding = 1e-13;
  const Vec3 origin = centre_of(from);
  double unit_m = 0;  // logarithms of about 0 lose the fewest digits
  for (const auto& polygon : {from, to})
    for (const Vec3& corner : polygon) unit_m = std::max(unit_m, norm(corner - origin));
  const auto outer = edges_of(from, origin, unit_m), inner = edges_of(to, origin, unit_m);
  const double goal = relative * 2 * pi * rough_exchange(from, to) / (unit_m * unit_m);
  double sum = 0;
  for (const SourceEdge& a : outer)
    for (const SourceEdge& b : inner) {
      const double cosine = dot(a.along, b.along);
      if (cosine == 0) continue;
      const double pairs = static_cast<double>(outer.size() * inner.size());
      const double tolerance = std::max(goal / pairs, rounding * a.length * b.length);
      sum += cosine * EdgePair(a, b, tolerance).integral();
    }
  return std::max(0.0, sum / (2 * pi)) * unit_m * unit_m;
}

}  // namespace sunload
