#include "io/picture.h"

#include <cairo.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "geo/check.h"
#include "geo/units.h"
#include "io/file_aside.h"

namespace sunload {
namespace {

constexpr const char* font_family = "DejaVu Sans";
constexpr double channel_steps = 255;

void expect_good(cairo_status_t status, const std::string& what) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  if (status == CAIRO_STATUS_WRITE_ERROR) throw_cannot_write(what, errno);
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

std::string Picture::png() const {
  std::string bytes;
  const auto append = [](void* to, const unsigned char* from, unsigned count) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(from), count);
    return CAIRO_STATUS_SUCCESS;
  };
  expect_good(cairo_surface_write_to_png_stream(canvas_->surface, append, &bytes), "a picture");
  return bytes;
}

void Picture::save(const std::string& path) const {
  expect_good(cairo_status(canvas_->context), path);
  FileAside file(path);
  errno = 0;
  expect_good(cairo_surface_write_to_png(canvas_->surface, file.aside().c_str()), path);
  file.publish();
}

}  // namespace sunload
