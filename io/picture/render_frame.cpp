// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/base/text.h"

namespace sunload {
namespace {

constexpr int most_ticks = 6;

/// Lengths grow with the picture: one unit is the height of small text.
double unit(const Picture& picture) {
  constexpr double texts_per_height = 64, texts_per_width = 92, least = 9;
  return std::max(least,
                  std::min(picture.height() / texts_per_height, picture.width() / texts_per_width));
}

// In units of the above: the strips that title and legend take, and their parts.
constexpr double title_strip = 4.4, legend_strip = 8, margin = 1.2;
constexpr double title_size = 1.5, title_line = 1.9, subtitle_line = 3.5;
constexpr double bar_width = 1.8, tick_length = 0.5, line_width = 0.09;
constexpr double arrow_radius = 3;

/// Whole square metres; of small areas two digits.
std::string area_words(double area_m2) {
  constexpr double small_m2 = 10;
  return area_m2 < small_m2 ? fmt::format("{:.2g} m²", area_m2) : fmt::format("{:.0f} m²", area_m2);
}

}  // namespace

PictureArea scene_area(const Picture& picture) {
  const int top = static_cast<int>(unit(picture) * title_strip);
  const int right = static_cast<int>(unit(picture) * legend_strip);
  return {0, top, picture.width() - right, picture.height() - top};
}

void draw_title(Picture& picture, const std::string& title, const std::string& subtitle) {
  const double u = unit(picture);
  const double room = picture.width() - 2 * margin * u;
  TextStyle large{title_size * u, Align::left, Weight::bold, ink};
  if (const double width = picture.text_width(title, large); width > room)
    large.size *= room / width;
  picture.write({margin * u, title_line * u}, title, large);
  TextStyle style{u, Align::left, Weight::normal, ink};
  const double width = picture.text_width(subtitle, style);
  if (width > room) style.size *= room / width;
  picture.write({margin * u, subtitle_line * u}, subtitle, style);
}

std::string tick_text(double value, int decimals) {
  constexpr int most_decimals = 5;
  if (decimals <= most_decimals) return fmt::format("{:.{}f}", value, decimals);
  std::string text = fmt::format("{:.3g}", value);
  if (const auto padded = text.find("e-0"); padded != std::string::npos) text.erase(padded + 2, 1);
  return text;
}

namespace {

/// Smaller letters where a text is wider than its room; hinted ones do not shrink evenly.
void shrink_into(double room, const Picture& picture, const std::string& text, TextStyle& style) {
  constexpr double least_step = 0.99, smallest = 1;
  for (double width = picture.text_width(text, style); width > room && style.size > smallest;
       width = picture.text_width(text, style))
    style.size *= std::min(least_step, room / width);
}

/// Values beside the bar, with their words.
std::vector<std::pair<double, std::string>> ticks_of(const Legend& legend) {
  std::vector<std::pair<double, std::string>> named;
  if (legend.scale == ColourScale::logarithmic) {
    for (const double value : logarithmic_ticks(legend.least, legend.largest))
      named.emplace_back(value, number_text(value, 4));
    return named;
  }
  const bool has_two_sides = legend.least < 0;
  auto ticks = round_ticks(legend.largest, has_two_sides ? most_ticks / 2 : most_ticks);
  const auto name = [&](double value, const std::string& text) {
    const bool has_negative = has_two_sides && value > 0;
    named.emplace_back(value, (has_negative ? "+" : "") + text);
    if (has_negative) named.emplace_back(-value, "-" + text);
  };
  // The end of the bar, too, in place of a tick whose words it would touch.
  constexpr double too_near = 0.06, rounding = 1e-6;  // of the bar
  const double rest = 1 - ticks.values.back() / legend.largest;
  if (rest > rounding && rest < too_near && ticks.values.size() > 1) ticks.values.pop_back();
  for (const double value : ticks.values) name(value, tick_text(value, ticks.decimals));
  if (rest > rounding) name(legend.largest, number_text(legend.largest, 4));
  return named;
}

}  // namespace

void draw_legend(Picture& picture, const Legend& legend) {
  const double u = unit(picture);
  // Whole pixels: the rows of the bar would blend with what is below them.
  const double x = std::round(picture.width() - (legend_strip - margin) * u);
  const double top = std::round((title_strip + 3 * margin) * u);
  const double bottom = std::round(picture.height() - 2 * margin * u);
  TextStyle units{u, Align::left, Weight::bold, ink};
  const double room = picture.width() - x - line_width * u;
  shrink_into(room, picture, legend.units, units);
  picture.write({x, top - 2 * margin * u}, legend.units, units);
  const int rows = static_cast<int>(bottom - top);
  for (int row = 0; row < rows; ++row)
    picture.fill_rectangle({x, bottom - row - 1}, bar_width * u, 1,
                           map_colour(legend.palette, (row + 0.5) / rows));
  const double bar_top = bottom - rows;
  const auto draw_tip = [&](double y, double outward, double share) {
    const std::vector<PicturePoint> tip{
        {x, y}, {x + bar_width * u / 2, y + outward * u}, {x + bar_width * u, y}};
    picture.fill_polygon(tip, map_colour(legend.palette, share));
    picture.draw_lines(tip, line_width * u, ink);
  };
  if (legend.above == Legend::Above::marked) draw_tip(bar_top, -1, 1);
  if (legend.below == Legend::Above::marked) draw_tip(bottom, 1, 0);
  picture.draw_lines({{x, bar_top},
                      {x, bottom},
                      {x + bar_width * u, bottom},
                      {x + bar_width * u, bar_top},
                      {x, bar_top}},
                     line_width * u, ink);
  const auto ticks = ticks_of(legend);
  const double end = x + (bar_width + tick_length) * u;
  const double left = end + tick_length * u;
  TextStyle numbers{u, Align::left, Weight::normal, ink};
  for (const auto& [value, text] : ticks)
    shrink_into(picture.width() - left - line_width * u, picture, text, numbers);
  for (const auto& [value, text] : ticks) {
    const double y =
        bottom - rows * colour_share(legend.scale, value, legend.least, legend.largest);
    picture.draw_lines({{x + bar_width * u, y}, {end, y}}, line_width * u, ink);
    constexpr double half_digit = 0.36;  // digits are some 0.72 of the font's height
    picture.write({left, y + half_digit * numbers.size}, text, numbers);
  }
}

void draw_north(Picture& picture, PicturePoint north) {
  const double u = unit(picture), radius = arrow_radius * u;
  const PicturePoint centre{margin * u + radius, picture.height() - margin * u - radius};
  const double length = std::hypot(north.x, north.y);
  constexpr double along_the_view = 0.05;
  if (length < along_the_view) return;
  picture.fill_circle(centre, radius, {1, 1, 1});
  picture.draw_circle(centre, radius, line_width * u, ink);
  const PicturePoint along{north.x / length, north.y / length};
  const auto at = [&](double forward, double aside) {
    return PicturePoint{centre.x + radius * (along.x * forward - along.y * aside),
                        centre.y + radius * (along.y * forward + along.x * aside)};
  };
  // In radii; foreshortened with the view, but never so short that it cannot be read.
  constexpr double shortest = 0.5, tip = 0.42, tail = -0.75, notch = -0.5, half_width = 0.3;
  const double reach = std::max(shortest, length);
  picture.fill_polygon({at(tip * reach, 0), at(tail * reach, half_width), at(notch * reach, 0),
                        at(tail * reach, -half_width)},
                       ink);
  constexpr double letter = 0.72, half_letter = 0.36;
  const auto place = at(letter, 0);
  picture.write({place.x, place.y + half_letter * u}, "N", {u, Align::centre, Weight::bold, ink});
}

void draw_kinds(Picture& picture, const std::vector<KindEntry>& kinds) {
  const double u = unit(picture);
  const double x = std::round(picture.width() - (legend_strip - margin) * u);
  const double room = picture.width() - x - margin * u / 2;
  constexpr double swatch = 1.6, line = 1.25, entry = 4.2;
  double y = (title_strip + margin) * u;
  const auto write = [&](double at, const std::string& text, Weight weight) {
    TextStyle style{u, Align::left, weight, ink};
    shrink_into(room, picture, text, style);
    picture.write({x, at}, text, style);
  };
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (y + 2 * entry * u > picture.height() && k + 1 < kinds.size()) {
      write(y + line * u, fmt::format("and {} more", kinds.size() - k), Weight::normal);
      return;
    }
    picture.fill_rectangle({x, y}, 2 * swatch * u, swatch * u, kinds[k].colour);
    picture.draw_lines({{x, y},
                        {x + 2 * swatch * u, y},
                        {x + 2 * swatch * u, y + swatch * u},
                        {x, y + swatch * u},
                        {x, y}},
                       line_width * u, ink);
    write(y + (swatch + line) * u, kinds[k].name, Weight::bold);
    write(y + (swatch + 2 * line) * u, area_words(kinds[k].area_m2), Weight::normal);
    y += (entry + 1) * u;
  }
}

void draw_sun_path(Picture& picture, const SunTrack& path, PicturePoint north) {
  constexpr double disc_radius = 7, letter_place = 0.86, dot = 0.22, path_width = 0.14;
  constexpr double zenith_deg = 90;
  constexpr std::size_t most_dots = 80;
  constexpr Colour paper{1, 1, 1}, line{0.85, 0.45, 0.05}, grid{0.75, 0.75, 0.75};
  const double u = unit(picture), radius = disc_radius * u;
  const PicturePoint centre{margin * u + radius, picture.height() - margin * u - radius};
  // Where one looks along north, or straight down with north up, north is up.
  const double turn = std::hypot(north.x, north.y) > 0 ? std::atan2(north.x, -north.y) : 0;
  const auto at = [&](Horizontal place, double share) {
    const double angle = radians(place.azimuth_deg) + turn;
    const double r = radius * share * (zenith_deg - place.elevation_deg) / zenith_deg;
    return PicturePoint{centre.x + r * std::sin(angle), centre.y - r * std::cos(angle)};
  };
  constexpr double rim = 0.72;  // of the disc: the letters stand outside of it
  picture.fill_circle(centre, radius, paper);
  picture.draw_circle(centre, radius, line_width * u, ink);
  for (const double elevation : {0.0, 30.0, 60.0})
    picture.draw_circle(centre, radius * rim * (zenith_deg - elevation) / zenith_deg,
                        line_width * u, grid);
  std::vector<PicturePoint> lit;
  const auto flush = [&] {
    if (lit.size() > 1) picture.draw_lines(lit, path_width * u, line);
    lit.clear();
  };
  for (std::size_t k = 0; k < path.places.size(); ++k) {
    if (path.places[k].elevation_deg < 0 || path.breaks[k]) flush();
    if (path.places[k].elevation_deg < 0) continue;
    lit.push_back(at(path.places[k], rim));
    if (path.places.size() <= most_dots) picture.fill_circle(lit.back(), dot * u, line);
  }
  flush();
  constexpr double half_letter = 0.36, quarter_deg = 90;
  for (int k = 0; k < 4; ++k) {
    const auto place = at({k * quarter_deg, 0}, letter_place);
    picture.write({place.x, place.y + half_letter * u}, std::string(1, "NESW"[k]),
                  {u, Align::centre, k == 0 ? Weight::bold : Weight::normal, ink});
  }
}

}  // namespace sunload
