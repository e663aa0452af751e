// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Points, directions and rotations in double precision.
#pragma once

#include <array>
#include <cmath>

namespace sunload {

/// A point [m] or a direction in a right-handed frame. The scene frame has
/// z up; without `north_deg` x points east and y north.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(double s, Vec3 a) { return a * s; }
constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Euclidean length.
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
/// Coordinate along axis 0, 1 or 2.
constexpr double component(Vec3 a, int axis) { return axis == 0 ? a.x : (axis == 1 ? a.y : a.z); }
/// Unit vector along `a`, which must not be the null vector.
inline Vec3 normalized(Vec3 a) { return a / norm(a); }

/// Direction of light after an ideal mirror with unit normal `n`: `w` points
/// away from the surface, and so does the result.
constexpr Vec3 mirrored(Vec3 w, Vec3 n) { return 2 * dot(w, n) * n - w; }

/// A rotation; `rows` are the axes of the target frame in the source frame.
struct Rotation {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  constexpr Vec3 operator()(Vec3 v) const {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  }
  constexpr Rotation inverse() const {
    return {{Vec3{rows[0].x, rows[1].x, rows[2].x}, Vec3{rows[0].y, rows[1].y, rows[2].y},
             Vec3{rows[0].z, rows[1].z, rows[2].z}}};
  }
};

/// Two unit vectors that complete the unit vector `n` to a right-handed frame
/// (tangent, bitangent, n), continuous but at n.z = 0-.
/// Duff et al. (2017), Building an Orthonormal Basis, Revisited, listing 3.
struct Tangents {
  Vec3 tangent, bitangent;
};
inline Tangents tangents(Vec3 n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

}  // namespace sunload
