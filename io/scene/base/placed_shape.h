// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Shapes that a city model stores once and shows at many places.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "geo/mesh/affine.h"
#include "geo/mesh/mesh.h"
#include "io/scene/base/from_file.h"

namespace sunload {

/// Of a 4×4 matrix, row by row; nothing where its last row is not 0 0 0 1.
std::optional<Affine> affine_of(const std::array<double, 16>& matrix);

/// What may keep a shape from its place.
enum class Placed { yes, too_many_corners, beyond_coordinates };

/// Places shapes. Instances let a small file ask for any amount of memory: how many corners they
/// may make in all is limited by the size of the file.
class ShapePlacer {
 public:
  ShapePlacer(const SceneFromFile& scene_from_file, std::size_t file_bytes);

  /// Appends the polygons of `shape`, which is in its own frame: scene position =
  /// `reference` (of the scene) + scene from file (`affine` · vertex). They belong to
  /// `facts.object` and are of `facts.surface` where the shape tells no kind. Where it is not
  /// placed the target is of no use any more.
  Placed append(const PolygonModel& shape, const Affine& affine, Vec3 reference,
                PolygonModel::Facts facts, PolygonModel& target);

 private:
  SceneFromFile scene_from_file_;
  std::size_t corners_left_;
};

}  // namespace sunload
