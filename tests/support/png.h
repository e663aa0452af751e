// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures that were written, read back by cairo.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/base/colour_map.h"

namespace sunload::test {

struct Png {
  int width = 0, height = 0;
  std::vector<Colour> pixels;  ///< row by row from the upper left corner
  Colour at(double x, double y) const {
    return pixels.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
  }
};

/// A failure of the test, and an empty picture, where the file is none.
Png read_png(const std::string& path);

/// Largest difference of a channel.
double difference(Colour a, Colour b);
/// How many pixels are within a step of bytes of a colour.
std::size_t count_of(const Png& picture, Colour colour);

}  // namespace sunload::test
