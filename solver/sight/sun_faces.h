// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// All that may stand before the sun, as convex faces in flat arrays: parts of walls and roofs;
/// triangles that let light pass are faces by themselves. After the faces come cores of closed
/// bodies (solver/sight/body_cores.h): what is wholly behind one is dark, of all else faces tell.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/sight/body_cores.h"
#include "solver/surface/material.h"

namespace sunload {

class SunFaces {
 public:
  static constexpr std::size_t most_corners = 15;  ///< of a face
  static constexpr std::size_t most_corners_of_all = std::max(most_corners, BodyCore::most_corners);

  /// Triangles of one plane are joined where what they make is convex and flat within `flat_m`.
  SunFaces(const Scene& scene, double flat_m);

  std::size_t count() const { return face_count_; }
  std::size_t count_with_cores() const { return normal_.size(); }
  bool is_core(std::size_t number) const { return number >= face_count_; }
  /// What follows, but for the normal, is told of cores as well.
  std::size_t corner_count() const { return corner_.size(); }
  /// Where the face's corners begin among those of all.
  std::size_t first_corner(std::size_t face) const { return begin_[face]; }
  /// Counter-clockwise about its normal; of a core in any order.
  std::span<const Vec3> corners(std::size_t face) const {
    return std::span(corner_).subspan(begin_[face], begin_[face + 1] - begin_[face]);
  }
  Vec3 normal(std::size_t face) const { return normal_[face]; }
  /// Of an opaque triangle of the scene; `none` of others.
  std::uint32_t of_triangle(std::size_t triangle) const { return of_triangle_[triangle]; }
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  std::span<const std::array<std::uint8_t, 2>> edges_of_core(std::size_t core) const {
    return edges_of_core_[core - face_count_];
  }
  /// All of the face lies within `radius` about `centre`.
  struct Sphere {
    Vec3 centre;
    double radius;
  };
  const Sphere& sphere(std::size_t face) const { return sphere_[face]; }
  /// Its largest z, and that of all.
  double top(std::size_t face) const { return top_[face]; }
  double top() const { return top_of_all_; }
  /// Some light passes it.
  bool is_screen(std::size_t face) const { return is_screen_[face] != 0; }
  /// False where other faces of its body stop all that this face stops on the way to the sun: a way
  /// out of a closed body, or through it, leaves the body by a face that looks along the way.
  /// `spread`: tangent of the angle to `to_sun` (unit) within which that holds.
  bool is_needed(std::size_t face, Vec3 to_sun, double spread) const {
    const int outward = static_cast<int>(body_[face]);
    return outward == 0 || outward * dot(normal_[face], to_sun) >= -spread;
  }

 private:
  void add(const std::vector<Vec3>& corners, Vec3 normal, bool is_screen, Closed body);

  std::size_t face_count_ = 0;
  std::vector<Vec3> corner_, normal_;
  std::vector<std::uint32_t> begin_{0};
  std::vector<Sphere> sphere_;
  std::vector<double> top_;
  double top_of_all_ = -1e300;
  std::vector<std::uint8_t> is_screen_;
  std::vector<Closed> body_;
  std::vector<std::uint32_t> of_triangle_;
  std::vector<std::vector<std::array<std::uint8_t, 2>>> edges_of_core_;
};

}  // namespace sunload
