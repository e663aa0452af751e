// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Colours of patches as one texture, in which each patch has a square block of its own.
///
/// Blocks stand in rows, in the order of the patches: equal meshes have equal places, whatever the
/// texture shows. Corners of a patch lie a texel inside of its block, so that filtering between
/// neighbouring texels never mixes patches. Within a patch whose corners have colours of their own
/// the steps of the scale run evenly between them, where vertices' colours would mix colours.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "io/export/format.h"

namespace sunload {

class LightMap {
 public:
  /// Throws InputError where the texture would be larger than what graphics cards have in common.
  LightMap(const ExportColours& colours, const std::string& result);

  int width() const { return static_cast<int>(columns_ * block_); }
  int height() const { return static_cast<int>(rows_ * block_); }
  int block() const { return static_cast<int>(block_); }  ///< texels along an edge of a block
  /// Corner of a patch in the texture, in shares of its width and height: to the right, down.
  std::array<float, 2> place(std::size_t patch, std::size_t corner) const;
  /// The bytes of a PNG.
  std::string png() const;

 private:
  std::int32_t step_at(std::size_t patch, std::size_t x, std::size_t y) const;

  const ExportColours& colours_;
  std::size_t patches_, block_, columns_, rows_;
};

}  // namespace sunload
