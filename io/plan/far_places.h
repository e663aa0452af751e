// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Places of a study that lie far from its scene: mostly in another frame.
#pragma once

#include <cstddef>
#include <string>

#include "geo/mesh/mesh.h"

namespace sunload {

class FarPlaces {
 public:
  /// `bounds`: of the scene, relative to its origin.
  FarPlaces(Vec3 origin, const Box& bounds) : origin_(origin), bounds_(bounds) {}

  /// The next place, relative to the origin.
  void look_at(Vec3 place);
  bool any() const { return far_ > 0; }
  /// How many of `many` stand far, and where the first, `one`, does.
  std::string words(const std::string& many, const std::string& one) const;
  static constexpr const char* hint =
      "positions are metres in the scene's frame, z up, not relative to its local origin";

 private:
  Vec3 origin_;
  Box bounds_;
  std::size_t count_ = 0, far_ = 0, first_ = 0;
  Vec3 first_place_;
};

}  // namespace sunload
