// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/far_places.h"

#include <fmt/format.h>

#include <algorithm>

namespace sunload {

void FarPlaces::look_at(Vec3 at) {
  const auto& [low, high] = bounds_;
  const double beyond = std::max(
      {low.x - at.x, at.x - high.x, low.y - at.y, at.y - high.y, low.z - at.z, at.z - high.z});
  if (beyond > norm(high - low) && far_++ == 0) {
    first_ = count_;
    first_place_ = at + origin_;
  }
  ++count_;
}

std::string FarPlaces::words(const std::string& many, const std::string& one) const {
  return fmt::format(
      "{} of {} {} stand farther from the scene than it is wide, the first of them {} {} at "
      "({:.10g}, {:.10g}, {:.10g})",
      far_, count_, many, one, first_, first_place_.x, first_place_.y, first_place_.z);
}

}  // namespace sunload
