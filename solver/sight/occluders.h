// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The triangles that cast shadows, with their neighbours across edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

class Occluders {
 public:
  /// `transmittance`: of each triangle; empty where all are opaque. Vertices in one place are one
  /// point.
  Occluders(const Mesh& mesh, std::span<const float> transmittance);

  std::size_t triangle_count() const { return corners_.size(); }
  Vec3 corner(std::size_t triangle, std::size_t k) const { return point_[corners_[triangle][k]]; }
  /// Number of a corner's point: the same for triangles that share it.
  std::uint32_t point(std::size_t triangle, std::size_t k) const { return corners_[triangle][k]; }
  Vec3 at(std::uint32_t point) const { return point_[point]; }
  /// No ray passes it.
  bool is_opaque(std::size_t triangle) const {
    return transmittance_.empty() || transmittance_[triangle] <= 0;
  }
  /// Some rays pass it, others do not.
  bool is_screen(std::size_t triangle) const {
    return !is_opaque(triangle) && transmittance_[triangle] < 1;
  }
  /// Triangles that have both ends of the edge from corner k to the next, it among them.
  std::span<const std::int32_t> at_edge(std::size_t triangle, std::size_t k) const;

 private:
  void find_edges();

  std::vector<Vec3> point_;
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<float> transmittance_;
  std::vector<std::array<std::uint32_t, 3>> edge_;  ///< per triangle, three numbers of edges
  std::vector<std::uint32_t> edge_begin_;           ///< per edge, into
  std::vector<std::int32_t> at_edge_;
};

}  // namespace sunload
