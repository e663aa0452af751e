// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines of neighbouring patches that are cast together, each packet in one narrow range of
/// directions: rays that go the same way meet the same boxes of the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/lines/patch_lines.h"

namespace sunload {

class LineBundle {
 public:
  void clear() { lines_.clear(); }
  /// Appends lines 0 … count - 1 of a patch.
  void add(const PatchLines& lines, std::size_t count);
  /// Casts them all. The hits are those of each line alone.
  void cast(const RayCaster& caster);

  const PatchLines::Line& line(std::size_t i) const { return lines_[i]; }
  Hit hit(std::size_t i) const { return hits_[i]; }

 private:
  void sort_by_direction();

  std::vector<PatchLines::Line> lines_;
  std::vector<Hit> hits_;
  std::vector<std::uint8_t> cell_;               ///< of each line's direction
  std::vector<std::uint32_t> in_order_, order_;  ///< numbers of the lines: as added, by direction
};

}  // namespace sunload
