// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which patches are looked at together when their share of the sun is told: those of one plane
/// within a convex polygon, of a whole face (solver/sight/sun_faces.h) where they are few, else of
/// a part of one of its triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/mesh/hierarchy.h"
#include "solver/sight/sun_faces.h"

namespace sunload {

class PlaneGroups {
 public:
  static constexpr std::size_t most_corners = 8;

  /// Every patch is in one group.
  PlaneGroups(const Scene& scene, const Hierarchy& hierarchy, const SunFaces& faces);

  struct Group {
    std::size_t first, count;                  ///< of its patches in a list
    std::uint32_t first_corner, corner_count;  ///< of the polygon
    bool sends_on;                             ///< as a mirror, pane or gloss
    Vec3 normal;
    double plane_offset;  ///< normal · any point of the plane
  };
  /// Neighbours after each other.
  const std::vector<Group>& all() const { return groups_; }
  std::span<const std::uint32_t> patches_of(const Group& group) const {
    return std::span(patch_).subspan(group.first, group.count);
  }
  /// Of the polygon that holds its patches, in either order.
  std::span<const Vec3> corners_of(const Group& group) const {
    return std::span(corner_).subspan(group.first_corner, group.corner_count);
  }

 private:
  std::vector<Group> groups_;
  std::vector<std::uint32_t> patch_;  ///< group by group
  std::vector<Vec3> corner_;
};

}  // namespace sunload
