// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/png.h"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sunload::test {

Png read_png(const std::string& path) {
  Png png;
  cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
  EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS) << path;
  if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS) {
    png.width = cairo_image_surface_get_width(surface);
    png.height = cairo_image_surface_get_height(surface);
    const unsigned char* rows = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < png.height; ++y)
      for (int x = 0; x < png.width; ++x) {
        std::uint32_t word = 0;
        std::memcpy(&word, rows + y * stride + x * 4, 4);
        const auto channel = [&](int shift) { return (word >> shift & 0xff) / 255.0; };
        png.pixels.push_back({channel(16), channel(8), channel(0)});
      }
  }
  cairo_surface_destroy(surface);
  return png;
}

double difference(Colour a, Colour b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

std::size_t count_of(const Png& picture, Colour colour) {
  constexpr double rounding = 1.01 / 255;
  return static_cast<std::size_t>(
      std::count_if(picture.pixels.begin(), picture.pixels.end(),
                    [&](Colour pixel) { return difference(pixel, colour) <= rounding; }));
}

}  // namespace sunload::test
