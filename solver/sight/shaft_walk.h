// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One group of patches and one sun: what stands in its shaft, and which of its elements that
/// leaves open or closes (solver/sight/sun_shafts.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/sight/outline.h"
#include "solver/sight/sun_shafts.h"

namespace sunload {

class ShaftWalk {
 public:
  ShaftWalk(const SunShafts& shafts, std::vector<SunSight>& sights)
      : shafts_(shafts), sights_(sights) {}
  /// Sets the sights of all patches of a group in column k.
  void run(SunShafts::Element group, const IntervalLight& sun, std::size_t k);

 private:
  using Element = SunShafts::Element;
  /// A triangle, or what of it is above the group's plane.
  struct Blocker {
    Outline outline;
    std::int32_t triangle;
    std::int32_t strip;  ///< of strips_: too close to the plane to be sure; -1: none
    bool sure;           ///< rays that meet it are surely stopped
    double margin;       ///< lateral, for all that moves the rays [m]
    std::array<std::int32_t, Outline::most> beyond;  ///< blocker across each edge, or one of:
  };
  static constexpr std::int32_t none = -1, not_asked = -2;

  bool face(Element group, const IntervalLight& sun);
  bool collect(Element group);
  void add_blocker(std::int32_t triangle);
  Outline outline_of(Element element) const;
  void walk(Element element, std::size_t depth);
  bool covers(const Outline& target, std::span<const std::uint32_t> blockers);
  void join_across(std::uint32_t blocker, std::size_t edge);
  std::int32_t beyond(std::uint32_t blocker, std::size_t edge);
  std::int32_t find_beyond(const Blocker& blocker, std::size_t edge) const;
  std::uint32_t sheet(std::uint32_t blocker) const;
  OutlinePoint project(Vec3 p) const;
  double depth_of(Vec3 p) const { return dot(p - base_, sun_); }
  /// How far from edge-on the sun sees a triangle, signed; 0 for one without area.
  double facing(std::size_t triangle) const;
  void tell(Element element, SunSight sight);

  const SunShafts& shafts_;
  std::vector<SunSight>& sights_;
  std::size_t column_ = 0;
  Vec3 sun_, across_x_, across_y_, normal_, base_;
  double spread_ = 0;   ///< tangent of the angle of the sun's disk
  double nearest_ = 0;  ///< depth of the group's farthest corner from the sun
  Outline group_;
  std::vector<std::int32_t> triangles_;
  std::vector<Blocker> blockers_;
  std::vector<Outline> strips_;
  std::vector<std::vector<std::uint32_t>> in_shaft_;  ///< per depth of the walk
  // Of the element at hand, per blocker:
  mutable std::vector<std::uint32_t> sheet_;
  std::vector<std::uint32_t> asked_for_;
  std::vector<std::uint8_t> ends_;  ///< the sheet ends within the shaft
  std::uint32_t question_ = 0;
};

}  // namespace sunload
