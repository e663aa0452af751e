// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/dome_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sunload {

namespace {

constexpr double quarter_turn_deg = 90, full_turn_deg = 360;
constexpr double circle_step_deg = 10, ray_step_deg = 30, tick_step_deg = 10;
constexpr double labelled_circle_step_deg = 30;
// Shares of the picture, and of the chart's radius.
constexpr double title_share = 0.06, foot_share = 0.03, texts_per_height = 64;
constexpr double tick_share = 0.015, azimuth_label = 0.045, label_height = 0.03;
constexpr double thin = 0.06, strong = 0.14;  // line widths in texts
constexpr double half_capital = 0.36;         // capitals are some 0.72 of the font's height

constexpr std::array<const char*, 4> winds{"N", "E", "S", "W"};

}  // namespace

DomeChart::DomeChart(const Picture& picture, DomeProjection projection, double right_margin,
                     double room_for_labels)
    : projection_(projection), room_(room_for_labels) {
  const double top = picture.height() * title_share;
  const double width = picture.width() - right_margin,
               height = picture.height() * (1 - foot_share) - top;
  centre_ = {width / 2, top + height / 2};
  radius_ = std::min(width, height) / 2 / (1 + room_ + azimuth_label + label_height);
  text_size_ = picture.height() / texts_per_height;
}

PicturePoint DomeChart::at(Horizontal place) const {
  const double zenith = radians(quarter_turn_deg - place.elevation_deg);
  const double distance =
      radius_ *
      (projection_ == DomeProjection::stereographic ? std::tan(zenith / 2) : zenith / (pi / 2));
  const double azimuth = radians(place.azimuth_deg);
  return {centre_.x + distance * std::sin(azimuth), centre_.y - distance * std::cos(azimuth)};
}

PicturePoint DomeChart::beyond_horizon(double azimuth_deg, double share) const {
  const double azimuth = radians(azimuth_deg), distance = radius_ * (1 + share);
  return {centre_.x + distance * std::sin(azimuth), centre_.y - distance * std::cos(azimuth)};
}

std::optional<Horizontal> DomeChart::place(PicturePoint p) const {
  const double east = p.x - centre_.x, north = centre_.y - p.y;
  const double share = std::hypot(east, north) / radius_;
  if (share > 1) return {};
  const double zenith =
      projection_ == DomeProjection::stereographic ? 2 * std::atan(share) : share * pi / 2;
  return Horizontal{wrapped_deg(degrees(std::atan2(east, north))),
                    quarter_turn_deg - degrees(zenith)};
}

void DomeChart::draw_grid(Picture& picture, Colour colour) const {
  const TextStyle small{text_size_ * 0.85, Align::centre, Weight::normal, colour};
  for (double elevation = circle_step_deg; elevation < quarter_turn_deg;
       elevation += circle_step_deg) {
    picture.draw_circle(centre_, centre_.y - at({0, elevation}).y, thin * text_size_, colour);
    if (std::fmod(elevation, labelled_circle_step_deg) != 0) continue;
    // Between two rays, where the sun's paths of both hemispheres leave room.
    const PicturePoint p = at({ray_step_deg / 2, elevation});
    picture.write({p.x, p.y + half_capital * text_size_}, fmt::format("{:.0f}°", elevation), small);
  }
  for (double azimuth = 0; azimuth < full_turn_deg; azimuth += tick_step_deg) {
    const bool is_ray = std::fmod(azimuth, ray_step_deg) == 0;
    picture.draw_lines({is_ray ? centre_ : beyond_horizon(azimuth, -tick_share),
                        beyond_horizon(azimuth, tick_share)},
                       thin * text_size_, colour);
    if (!is_ray) continue;
    const bool is_wind = std::fmod(azimuth, quarter_turn_deg) == 0;
    const auto wind = static_cast<std::size_t>(azimuth / quarter_turn_deg);
    PicturePoint p = beyond_horizon(azimuth, room_ + azimuth_label);
    p.y += half_capital * text_size_;
    if (is_wind) {
      picture.write(p, winds[wind], {text_size_ * 1.3, Align::centre, Weight::bold, {}});
    } else {
      picture.write(p, fmt::format("{:.0f}°", azimuth), small);
    }
  }
  picture.draw_circle(centre_, radius_, strong * text_size_, {});
}

std::vector<PicturePoint> DomeChart::ring(const Horizon& hills) const {
  constexpr double step_deg = 0.5;
  std::vector<PicturePoint> points;
  for (double azimuth = 0; azimuth <= full_turn_deg; azimuth += step_deg)
    points.push_back(at({azimuth, hills.elevation_deg(azimuth)}));
  return points;
}

void DomeChart::fill_below(Picture& picture, const Horizon& hills, Colour colour) const {
  if (hills.is_open()) return;
  // Along the horizon and back along the hills: what lies between is filled.
  std::vector<PicturePoint> points = ring(Horizon());
  const auto line = ring(hills);
  points.insert(points.end(), line.rbegin(), line.rend());
  picture.fill_polygon(points, colour);
}

void DomeChart::draw_line(Picture& picture, const Horizon& hills, Colour colour) const {
  if (!hills.is_open()) picture.draw_lines(ring(hills), strong * text_size_, colour);
}

}  // namespace sunload
