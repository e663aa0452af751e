// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Mirrors by orientation: those of one orientation send the sun on in one direction.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/surface/material.h"

namespace sunload {

/// Mirrors of one orientation.
struct MirrorGroup {
  Vec3 normal;
  std::vector<std::int32_t> triangles;
  std::vector<MaterialId> materials;  ///< of these, each once
};

/// The groups of a scene. Each side of a triangle is in one group at most.
class MirrorGroups {
 public:
  /// `scene` must outlive it.
  explicit MirrorGroups(const Scene& scene);
  std::size_t size() const { return groups_.size(); }
  const MirrorGroup& operator[](std::size_t group) const { return groups_[group]; }
  const Scene& scene() const { return scene_; }
  /// Groups that reflect anything: clear glass may reflect nothing.
  std::size_t reflecting() const;

  /// Group of a side of a triangle; -1: no mirror.
  std::int32_t of_side(std::int32_t triangle, bool front) const {
    return group_of_side_[2 * static_cast<std::size_t>(triangle) + (front ? 0u : 1u)];
  }
  /// Share that a mirror returns at that cosine of incidence.
  double reflectance(std::int32_t triangle, double cos_theta) const;
  /// The same of a ray that it has stopped.
  double weight_of_hit(std::int32_t triangle, double cos_theta) const;
  /// The largest share that a mirror of the group returns.
  double strongest(std::size_t group, double cos_theta) const;

 private:
  const Scene& scene_;
  std::vector<MirrorGroup> groups_;
  std::vector<std::int32_t> group_of_side_;  ///< [2·triangle + side]
};

}  // namespace sunload
