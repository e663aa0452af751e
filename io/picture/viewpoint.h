// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Places of a scene by name, to look from and to look at.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/base/vec.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// Patches by name, in the frame of the result.
struct ScenePlace {
  std::vector<std::size_t> patches;
  std::vector<Vec3> points;  ///< corners of the patches
  Vec3 low, high;            ///< of the points
  /// Mean normal of facades that look the same way, within 45 degrees of it.
  std::optional<Vec3> normal;
  Vec3 normal_sum;  ///< normals times areas
  double area = 0;

  Vec3 middle() const { return (low + high) / 2; }
  /// Middle of the ground plan, at its lowest point.
  Vec3 foot() const;
};

/// The patches of facades and objects. Throws InputError for names that the result does not have,
/// and where there are no patches.
ScenePlace scene_place(const ResultReader& result, const NamedParts& parts);

/// What --eye or --look says.
struct Viewpoint {
  Vec3 at;                       ///< in the frame of the result
  std::optional<Vec3> towards;   ///< where a facade looks
  std::optional<ScenePlace> of;  ///< that was named without an offset
};
/// Whether the text says where one stands or what one looks at.
enum class ViewpointOf { eye, look };
/// `x,y,z` in the coordinates of the study; NAME; or NAME+dx,dy,dz, metres from the middle of the
/// foot of an object or facade (a pattern: of all that match). A name alone is looked at in its
/// middle; the eye is half a metre before the middle of a facade, or at eye's height above the
/// middle of the highest point of an object. Throws InputError.
Viewpoint viewpoint(const ResultReader& result, const std::string& text, ViewpointOf of);

}  // namespace sunload
