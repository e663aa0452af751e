// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines of neighbouring patches that are cast together, each packet in one narrow range of
/// directions: rays that go the same way meet the same boxes of the scene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/lines/patch_lines.h"
#include "solver/lines/surface_walk.h"

namespace sunload {

class LineBundle {
 public:
  void clear();
  /// Appends lines 0 … count - 1 of a patch; `largest_link`: of their links (`linked_element`).
  void add(const PatchLines& lines, std::size_t count, double largest_link);
  /// Casts all lines. Each meets what it would meet alone; only where two surfaces are equally
  /// near, at an edge, does the one that is met depend on the packet.
  void cast(const RayCaster& caster, const Hierarchy& hierarchy, const SkyGrid& grid);

  const PatchLines::Line& line(std::size_t i) const { return lines_[i]; }
  const FirstMeeting& met(std::size_t i) const { return met_[i]; }

 private:
  void sort_by_direction();
  /// Stores what packets have met, for the lines of these numbers.
  void put_met(std::span<const PacketHits> hits, std::span<const std::uint32_t> lines,
               const Hierarchy& hierarchy, const SkyGrid& grid);

  std::vector<PatchLines::Line> lines_;
  std::vector<double> largest_link_;  ///< of each line
  std::vector<FirstMeeting> met_;
  std::vector<std::int32_t> cell_;               ///< of each line's direction
  std::vector<std::uint32_t> in_order_, order_;  ///< numbers of the lines: as added, by direction
};

}  // namespace sunload
