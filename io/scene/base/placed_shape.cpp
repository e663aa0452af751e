// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/base/placed_shape.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace sunload {

namespace {

/// Corners of polygons that instances may make, as such and per byte of the file (an instance takes
/// more than 100 bytes, so that large files may use shapes of some 800 corners throughout). 8
/// million corners of small polygons take 0.4 GB, and as much again while tables grow.
constexpr std::size_t corners_at_least = 1'000'000;
constexpr std::size_t corners_per_byte = 8;

/// Appends the rings and polygons of `shape`, whose vertices begin at `first_vertex` of `target`.
void append_polygons(const PolygonModel& shape, std::int32_t first_vertex, bool is_mirrored,
                     PolygonModel::Facts facts, PolygonModel& target) {
  const auto first_corner = static_cast<std::int64_t>(target.ring_vertex.size());
  const auto first_ring = static_cast<std::int64_t>(target.ring_begin.size()) - 1;
  for (const auto vertex : shape.ring_vertex) target.ring_vertex.push_back(first_vertex + vertex);
  for (std::size_t r = 1; r < shape.ring_begin.size(); ++r) {
    target.ring_begin.push_back(first_corner + shape.ring_begin[r]);
    if (!is_mirrored) continue;
    std::reverse(target.ring_vertex.begin() + first_corner + shape.ring_begin[r - 1],
                 target.ring_vertex.begin() + first_corner + shape.ring_begin[r]);
  }
  for (std::size_t p = 0; p < shape.polygon_count(); ++p) {
    target.polygon_ring.push_back(first_ring + shape.polygon_ring[p + 1]);
    target.facts.push_back(shape.facts[p]);
    auto& polygon = target.facts.back();
    polygon.object = facts.object;
    if (polygon.surface == Surface::other) polygon.surface = facts.surface;
  }
}

}  // namespace

std::optional<Affine> affine_of(const std::array<double, 16>& m) {
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) return std::nullopt;
  return Affine{{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}},
                {m[3], m[7], m[11]}};
}

ShapePlacer::ShapePlacer(const SceneFromFile& scene_from_file, std::size_t file_bytes)
    : scene_from_file_(scene_from_file),
      corners_left_(corners_at_least + corners_per_byte * file_bytes) {}

Placed ShapePlacer::append(const PolygonModel& shape, const Affine& affine, Vec3 reference,
                           PolygonModel::Facts facts, PolygonModel& target) {
  constexpr std::size_t most_vertices = std::numeric_limits<std::int32_t>::max();
  if (shape.ring_vertex.size() > corners_left_ ||
      shape.vertices.size() + target.vertices.size() > most_vertices)
    return Placed::too_many_corners;
  corners_left_ -= shape.ring_vertex.size();
  const auto first_vertex = static_cast<std::int32_t>(target.vertices.size());
  for (const auto& vertex : shape.vertices) {
    target.vertices.push_back(reference + scene_from_file_(affine(vertex)));
    if (!is_usable(target.vertices.back())) return Placed::beyond_coordinates;
  }
  const bool is_mirrored = affine.determinant() < 0;  // mirrors turn the winding of polygons
  append_polygons(shape, first_vertex, is_mirrored, facts, target);
  return Placed::yes;
}

}  // namespace sunload
