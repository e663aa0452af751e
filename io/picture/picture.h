// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures with lines and text, stored as PNG: the only file that knows cairo.
///
/// Coordinates are pixels, x to the right, y down, (0, 0) the upper left corner
/// of the picture. Needs no display.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/base/colour_map.h"

namespace sunload {

/// Throws InputError for a file name that promises another format, as .jpg does.
void expect_picture_name(const std::string& path);

/// A place in the picture [pixels].
struct PicturePoint {
  double x = 0, y = 0;
};

/// Which part of a text stands at the place given.
enum class Align { left, centre, right };
/// Thickness of letters.
enum class Weight { normal, bold };

/// How a text is written.
struct TextStyle {
  double size = 14;  ///< height of the font in pixels
  Align align = Align::left;
  Weight weight = Weight::normal;
  Colour colour;
};

/// Of texts and lines.
inline constexpr Colour ink{0.13, 0.13, 0.15};

/// A canvas in memory; colours are encoded sRGB.
class Picture {
 public:
  /// White. Throws MachineError where memory is short.
  Picture(int width, int height);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  int width() const;
  int height() const;

  /// Rows of `width` pixels from the upper left corner at (x, y).
  void paint(int x, int y, int width, const std::vector<Colour>& pixels);
  void fill_rectangle(PicturePoint corner, double width, double height, Colour colour);
  void fill_polygon(const std::vector<PicturePoint>& points, Colour colour);
  void draw_lines(const std::vector<PicturePoint>& points, double line_width, Colour colour);
  void fill_circle(PicturePoint centre, double radius, Colour colour);
  void draw_circle(PicturePoint centre, double radius, double line_width, Colour colour);
  /// Text whose base line is at `at`.
  void write(PicturePoint at, const std::string& text, const TextStyle& style);
  double text_width(const std::string& text, const TextStyle& style) const;

  /// The bytes of a PNG. ISO/IEC 15948:2004.
  std::string png() const;
  /// Writes a PNG aside and renames it. Throws MachineError.
  void save(const std::string& path) const;

 private:
  struct Canvas;
  std::unique_ptr<Canvas> canvas_;
};

}  // namespace sunload
