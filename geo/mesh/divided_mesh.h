// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh whose triangles are divided where they are covered in part (geo/mesh/covered.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "geo/mesh/covered.h"
#include "geo/mesh/covered_parts.h"

namespace sunload {

/// Corners of parts, one vertex where they are one.
class NewVertices {
 public:
  NewVertices(std::vector<Vec3>& vertices, double grid_m) : vertices_(vertices), grid_m_(grid_m) {}
  std::int32_t of(const std::array<double, 3>& at);

 private:
  std::vector<Vec3>& vertices_;
  double grid_m_;
  std::map<std::array<std::int64_t, 3>, std::int32_t> known_;
};

/// Triangles and their parts, in the old order: each is kept or divided, in turn.
class DividedMesh {
 public:
  /// Both are changed by `finish`; corners of parts within `grid_m` of each other are one.
  DividedMesh(Mesh& mesh, Bodies& bodies, double grid_m);

  void keep(std::size_t t, CoverState state) { add(t, mesh_.triangles[t], state); }
  void divide(std::size_t t, const std::vector<TrianglePart>& parts);
  /// Triangle `by` is where (a part of) `t` was.
  void note_taker(std::size_t t, std::size_t by);
  CoveredCut finish();

 private:
  void add(std::size_t t, const std::array<std::int32_t, 3>& corners, CoverState state);
  void take_from_facades();

  Mesh& mesh_;
  Bodies& bodies_;
  NewVertices vertices_;
  std::vector<std::uint8_t> is_facade_less_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<std::size_t> source_;
  std::vector<std::uint8_t> is_covered_;
  std::size_t cut_ = 0;
  Doubled taken_;
};

}  // namespace sunload
