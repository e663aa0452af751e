// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/picture.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/byte_text.h"
#include "io/base/deflate.h"
#include "io/base/file_aside.h"
#include "io/base/file_text.h"

namespace sunload {
namespace {

constexpr const char* font_family = "DejaVu Sans";
constexpr double channel_steps = 255;

void expect_good(cairo_status_t status, const std::string& what) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw MachineError(what + ": " + cairo_status_to_string(status));
}

std::uint32_t byte_of(double channel) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(channel, 0.0, 1.0) * channel_steps));
}

/// A pixel of CAIRO_FORMAT_RGB24: 0x00RRGGBB in the byte order of the machine.
std::uint32_t packed(Colour c) {
  return byte_of(c.red) << 16 | byte_of(c.green) << 8 | byte_of(c.blue);
}

void choose_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(
      context, font_family, CAIRO_FONT_SLANT_NORMAL,
      style.weight == Weight::bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size);
}

void follow(cairo_t* context, const std::vector<PicturePoint>& points) {
  cairo_new_path(context);
  for (const auto& p : points) cairo_line_to(context, p.x, p.y);
}

void choose(cairo_t* context, Colour c) { cairo_set_source_rgb(context, c.red, c.green, c.blue); }

}  // namespace

void expect_picture_name(const std::string& path) {
  const std::string format = lower_extension(path);
  if (!format.empty() && format != ".png")
    throw InputError({path}, "is the name of no picture", "pictures are written as PNG",
                     "let it end in .png");
}

struct Picture::Canvas {
  cairo_surface_t* surface;
  cairo_t* context;

  Canvas(int width, int height)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
        context(cairo_create(surface)) {}
  ~Canvas() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
};

Picture::Picture(int width, int height) : canvas_(std::make_unique<Canvas>(width, height)) {
  expect_good(cairo_status(canvas_->context),
              "a picture of " + std::to_string(width) + " × " + std::to_string(height) + " pixels");
  fill_rectangle({0, 0}, width, height, {1, 1, 1});
}

Picture::~Picture() = default;

int Picture::width() const { return cairo_image_surface_get_width(canvas_->surface); }
int Picture::height() const { return cairo_image_surface_get_height(canvas_->surface); }

void Picture::paint(int x, int y, int width, const std::vector<Colour>& pixels) {
  const int rows = static_cast<int>(pixels.size()) / width;
  SUNLOAD_EXPECT(x >= 0 && y >= 0 && x + width <= this->width() && y + rows <= height(),
                 "pixels outside of the picture");
  cairo_surface_flush(canvas_->surface);
  auto* const bytes = cairo_image_surface_get_data(canvas_->surface);
  const int stride = cairo_image_surface_get_stride(canvas_->surface);
  for (int row = 0; row < rows; ++row) {
    auto* target = reinterpret_cast<std::uint32_t*>(bytes + (y + row) * stride) + x;
    for (int column = 0; column < width; ++column)
      target[column] = packed(pixels[static_cast<std::size_t>(row * width + column)]);
  }
  cairo_surface_mark_dirty(canvas_->surface);
}

void Picture::fill_rectangle(PicturePoint corner, double width, double height, Colour colour) {
  choose(canvas_->context, colour);
  cairo_rectangle(canvas_->context, corner.x, corner.y, width, height);
  cairo_fill(canvas_->context);
}

void Picture::fill_polygon(const std::vector<PicturePoint>& points, Colour colour) {
  choose(canvas_->context, colour);
  follow(canvas_->context, points);
  cairo_close_path(canvas_->context);
  cairo_fill(canvas_->context);
}

void Picture::draw_lines(const std::vector<PicturePoint>& points, double line_width,
                         Colour colour) {
  choose(canvas_->context, colour);
  follow(canvas_->context, points);
  cairo_set_line_width(canvas_->context, line_width);
  cairo_stroke(canvas_->context);
}

void Picture::fill_circle(PicturePoint centre, double radius, Colour colour) {
  choose(canvas_->context, colour);
  cairo_new_path(canvas_->context);
  cairo_arc(canvas_->context, centre.x, centre.y, radius, 0, 2 * pi);
  cairo_fill(canvas_->context);
}

void Picture::draw_circle(PicturePoint centre, double radius, double line_width, Colour colour) {
  choose(canvas_->context, colour);
  cairo_new_path(canvas_->context);
  cairo_arc(canvas_->context, centre.x, centre.y, radius, 0, 2 * pi);
  cairo_set_line_width(canvas_->context, line_width);
  cairo_stroke(canvas_->context);
}

double Picture::text_width(const std::string& text, const TextStyle& style) const {
  choose_font(canvas_->context, style);
  cairo_text_extents_t extents;
  cairo_text_extents(canvas_->context, text.c_str(), &extents);
  return extents.x_advance;
}

void Picture::write(PicturePoint at, const std::string& text, const TextStyle& style) {
  const double width = text_width(text, style);
  const double shift = style.align == Align::left    ? 0
                       : style.align == Align::right ? width
                                                     : width / 2;
  choose(canvas_->context, style.colour);
  cairo_move_to(canvas_->context, at.x - shift, at.y);
  cairo_show_text(canvas_->context, text.c_str());
}

namespace {

/// A row of bytes as differences from the row above (filter "Up" of PNG): areas of one colour and
/// vertical edges become zeros.
void append_filtered(Bytes& to, const Bytes& row, const Bytes& above) {
  constexpr unsigned char filter_up = 2;
  to.push_back(filter_up);
  for (std::size_t i = 0; i < row.size(); ++i)
    to.push_back(static_cast<unsigned char>(row[i] - above[i]));
}

void append_chunk(std::string& to, const std::string& type, std::string_view data) {
  append_bytes<std::endian::big>(to, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = to.size();
  to += type;
  to += data;
  append_bytes<std::endian::big>(to, crc32(to.data() + begin, to.size() - begin));
}

}  // namespace

// cairo's own takes several times as long.
std::string Picture::png() const {
  expect_good(cairo_status(canvas_->context), "a picture");
  cairo_surface_flush(canvas_->surface);
  const auto* const bytes = cairo_image_surface_get_data(canvas_->surface);
  const int stride = cairo_image_surface_get_stride(canvas_->surface);
  constexpr std::size_t channels = 3;
  Bytes row(channels * static_cast<std::size_t>(width())), above(row.size(), 0), filtered;
  filtered.reserve((row.size() + 1) * static_cast<std::size_t>(height()));
  for (int y = 0; y < height(); ++y) {
    const auto* from = reinterpret_cast<const std::uint32_t*>(bytes + y * stride);
    for (std::size_t x = 0; x < static_cast<std::size_t>(width()); ++x) {
      row[channels * x] = static_cast<unsigned char>(from[x] >> 16);
      row[channels * x + 1] = static_cast<unsigned char>(from[x] >> 8);
      row[channels * x + 2] = static_cast<unsigned char>(from[x]);
    }
    append_filtered(filtered, row, above);
    std::swap(row, above);
  }
  constexpr int level = 5;  // slower ones make pictures smaller by hundredths
  const Bytes deflated = zlib_deflated(filtered, level);
  std::string header;
  append_bytes<std::endian::big>(header, static_cast<std::uint32_t>(width()));
  append_bytes<std::endian::big>(header, static_cast<std::uint32_t>(height()));
  // 8 bits each of red, green and blue; the only methods there are; not interlaced.
  header += std::string{"\x08\x02\0\0\0", 5};
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", {reinterpret_cast<const char*>(deflated.data()), deflated.size()});
  append_chunk(png, "IEND", {});
  return png;
}

void Picture::save(const std::string& path) const { write_file(path, png()); }

}  // namespace sunload
