// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/builtin/houses.h"

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"

namespace sunload::builtin {
namespace {

// Joinery [m]: widths and depths that carpenters' handbooks give for casements.
constexpr double frame_width = 0.08;
constexpr double pane_recess = 0.03;
constexpr double upper_light_share = 0.3;  // of the height of a four-pane window

/// Cuts panes into a frame: rows and columns of glass with bars between them.
void glaze(Face& frame, const std::vector<double>& column_edges,
           const std::vector<double>& row_edges, const HouseFinishes& finishes) {
  for (std::size_t i = 0; i + 1 < column_edges.size(); ++i)
    for (std::size_t j = 0; j + 1 < row_edges.size(); ++j) {
      const double half = frame_width / 2;
      const Ring pane = rectangle({column_edges[i] + half, row_edges[j] + half},
                                  {column_edges[i + 1] - half, row_edges[j + 1] - half});
      frame.step(pane, -pane_recess, finishes.frame, finishes.window).emit();
    }
}

/// Opening with a sill that is wider than it: a hole in the shape of an upside-down T.
Face opening_with_sill(Face& wall, Point2 low, Point2 high, const WindowKind& kind,
                       const HouseFinishes& finishes, Builder& builder) {
  constexpr double ear = 0.08, thickness = 0.07;  // of the sill [m]
  const Frame& f = wall.frame();
  const double in = -kind.reveal, out = kind.sill;
  const double left = low.u - ear, right = high.u + ear, below = low.v - thickness;
  wall.cut({{left, below},
            {right, below},
            {right, low.v},
            {high.u, low.v},
            high,
            {low.u, high.v},
            low,
            {left, low.v}});
  // The reveals: right, above, left.
  const Point2 right_top = high, left_top{low.u, high.v}, right_foot{high.u, low.v};
  const auto reveal = [&](Point2 a, Point2 b) {
    builder.face({{f.at(a), f.at(b), f.at(b, in), f.at(a, in)}}, finishes.wall);
  };
  reveal(right_foot, right_top);
  reveal(right_top, left_top);
  reveal(left_top, low);
  // The sill: below, right, left, front, and its top that runs into the opening.
  const auto side = [&](Point2 a, Point2 b) {
    builder.face({{f.at(a), f.at(b), f.at(b, out), f.at(a, out)}}, finishes.trim);
  };
  side({left, below}, {right, below});
  side({right, below}, {right, low.v});
  side({left, low.v}, {left, below});
  builder.face({{f.at({left, below}, out), f.at({right, below}, out), f.at({right, low.v}, out),
                 f.at({left, low.v}, out)}},
               finishes.trim);
  builder.face(
      {{f.at({left, low.v}, out), f.at({right, low.v}, out), f.at({right, low.v}), f.at(right_foot),
        f.at(right_foot, in), f.at(low, in), f.at(low), f.at({left, low.v})}},
      finishes.trim);
  return Face(builder, f.lifted(in), rectangle(low, high), finishes.frame);
}

}  // namespace

void window(Face& wall, Point2 foot, const WindowKind& kind, const HouseFinishes& finishes) {
  const Point2 low{foot.u - kind.width / 2, foot.v},
      high{foot.u + kind.width / 2, foot.v + kind.height};
  if (kind.hood > 0) {
    constexpr double gap = 0.2, height = 0.18, ear = 0.15;  // of the moulding [m]
    const Ring hood = rectangle({low.u - ear, high.v + gap}, {high.u + ear, high.v + gap + height});
    wall.step(hood, kind.hood, finishes.trim, finishes.trim).emit();
  }
  Face frame = kind.sill > 0
                   ? opening_with_sill(wall, low, high, kind, finishes, wall.builder())
                   : wall.step(rectangle(low, high), -kind.reveal, finishes.wall, finishes.frame);
  const double edge = frame_width / 2;
  const double right = frame.high().u - edge, left = frame.low().u + edge;
  const double top = frame.high().v - edge, bottom = frame.low().v + edge;
  std::vector<double> columns{left, right}, rows{bottom, top};
  if (kind.panes != Panes::one) columns = {left, (left + right) / 2, right};
  if (kind.panes == Panes::four) rows = {bottom, top - upper_light_share * kind.height, top};
  glaze(frame, columns, rows, finishes);
  frame.emit();
}

void door(Face& wall, double middle, double width, double height, const HouseFinishes& finishes) {
  constexpr double threshold = 0.16, step_low = 0.03, step_depth = 0.4, step_ear = 0.2;
  constexpr double reveal = 0.35, light_height = 0.6, stile = 0.15, panel_recess = 0.03;
  const double foot = wall.low().v + threshold;
  const double left = middle - width / 2, right = middle + width / 2;
  wall.step(rectangle({left - step_ear, wall.low().v + step_low},
                      {right + step_ear, foot - step_low}),
            step_depth, finishes.trim, finishes.trim)
      .emit();
  Face leaf = wall.step(rectangle({left, foot}, {right, foot + height}), -reveal, finishes.trim,
                        finishes.door);
  const double leaf_top = foot + height - light_height;
  leaf.step(rectangle({left + stile, leaf_top}, {right - stile, foot + height - stile}),
            -pane_recess, finishes.door, finishes.window)
      .emit();
  for (const double from : {left + stile, middle + stile / 2}) {
    const double to = from + width / 2 - 3 * stile / 2;
    const double waist = (foot + leaf_top) / 2;
    leaf.step(rectangle({from, foot + stile}, {to, waist - stile / 2}), -panel_recess,
              finishes.door, finishes.door)
        .emit();
    leaf.step(rectangle({from, waist + stile / 2}, {to, leaf_top - stile}), -panel_recess,
              finishes.door, finishes.door)
        .emit();
  }
  leaf.emit();
}

void shop_window(Face& wall, Point2 low, Point2 high, const HouseFinishes& finishes) {
  constexpr double reveal = 0.15;
  Face frame = wall.step(rectangle(low, high), -reveal, finishes.wall, finishes.frame);
  frame
      .step(rectangle({low.u + frame_width, low.v + frame_width},
                      {high.u - frame_width, high.v - frame_width}),
            -pane_recess, finishes.frame, finishes.window)
      .emit();
  frame.emit();
}

void balcony(Face& wall, Point2 foot, double width, double depth, const HouseFinishes& finishes) {
  constexpr double slab = 0.2, parapet = 1.0, thickness = 0.1, margin = 0.02, threshold = 0.06;
  Builder& builder = wall.builder();
  const Frame& f = wall.frame();
  const Point2 low{foot.u - width / 2, foot.v - slab}, high{foot.u + width / 2, foot.v};
  wall.cut(rectangle(low, high));
  const Point2 right_low{high.u, low.v}, left_high{low.u, high.v};
  const auto side = [&](Point2 a, Point2 b) {
    builder.face({{f.at(a), f.at(b), f.at(b, depth), f.at(a, depth)}}, finishes.balcony);
  };
  side(low, right_low);
  side(right_low, high);
  side(left_high, low);
  builder.face(
      {{f.at(low, depth), f.at(right_low, depth), f.at(high, depth), f.at(left_high, depth)}},
      finishes.balcony);
  // The top, from its outer left corner: u along the wall, v towards it.
  Face top(builder, {f.at(left_high, depth), f.u, -f.normal()}, rectangle({0, 0}, {width, depth}),
           finishes.balcony);
  const double o = margin, i = margin + thickness;
  top.step({{o, o},
            {width - o, o},
            {width - o, depth - o},
            {width - i, depth - o},
            {width - i, i},
            {i, i},
            {i, depth - o},
            {o, depth - o}},
           parapet, finishes.balcony, finishes.balcony)
      .emit();
  top.emit();
  window(wall, {foot.u, foot.v + threshold}, {.width = 1.3, .height = 2.2, .sill = 0}, finishes);
}

void chimney(Face& slope, Point2 middle, Point2 size, double top, int pots,
             const HouseFinishes& finishes) {
  constexpr double pot_height = 0.35, pot_margin = 0.1, flue_margin = 0.08, flue_depth = 0.3;
  const Ring foot = rectangle({middle.u - size.u / 2, middle.v - size.v / 2},
                              {middle.u + size.u / 2, middle.v + size.v / 2});
  std::vector<Vec3> moved;
  for (const auto p : foot) {
    const Vec3 at = slope.frame().at(p);
    moved.push_back({at.x, at.y, top});
  }
  const Vec3 along = slope.frame().u;
  Face crown = slope.step_to(foot, moved, {moved[0], along, cross({0, 0, 1}, along)},
                             finishes.chimney, finishes.chimney);
  const double pitch = size.u / pots;
  for (int k = 0; k < pots; ++k) {
    const Point2 low{k * pitch + pot_margin, pot_margin};
    const Point2 high{(k + 1) * pitch - pot_margin, crown.high().v - pot_margin};
    Face pot = crown.step(rectangle(low, high), pot_height, finishes.chimney, finishes.chimney);
    pot.step(rectangle({low.u + flue_margin, low.v + flue_margin},
                       {high.u - flue_margin, high.v - flue_margin}),
             -flue_depth, finishes.chimney, finishes.chimney)
        .emit();
    pot.emit();
  }
  crown.emit();
}

void dormer(Face& slope, Point2 foot, const DormerKind& kind, const HouseFinishes& finishes) {
  Builder& builder = slope.builder();
  const Frame& f = slope.frame();
  const double rise = f.v.z;  // sine of the slope
  SUNLOAD_EXPECT(rise > 0, "dormers stand on slopes");
  const double left = foot.u - kind.width / 2, right = foot.u + kind.width / 2;
  const double eave_v = foot.v + kind.wall_height / rise;
  const double ridge_v = eave_v + kind.gable_height / rise;
  slope.cut({{left, foot.v}, {right, foot.v}, {right, eave_v}, {foot.u, ridge_v}, {left, eave_v}});
  const Vec3 up{0, 0, 1};
  Face front(builder, {f.at({left, foot.v}), f.u, up},
             {{0, 0},
              {kind.width, 0},
              {kind.width, kind.wall_height},
              {kind.width / 2, kind.wall_height + kind.gable_height},
              {0, kind.wall_height}},
             finishes.wall);
  const Vec3 a = f.at({left, foot.v}), b = f.at({right, foot.v});
  const Vec3 a_top = a + kind.wall_height * up, b_top = b + kind.wall_height * up;
  const Vec3 back_right = f.at({right, eave_v}), back_left = f.at({left, eave_v});
  const Vec3 ridge = f.at({foot.u, ridge_v});
  const Vec3 gable = front.frame().at({kind.width / 2, kind.wall_height + kind.gable_height});
  builder.face({{b, back_right, b_top}}, finishes.wall);
  builder.face({{back_right, ridge, gable, b_top}}, finishes.roof);
  builder.face({{ridge, back_left, a_top, gable}}, finishes.roof);
  builder.face({{back_left, a, a_top}}, finishes.wall);
  constexpr double parapet_share = 0.6;  // of the room left below and above the window
  const double spare = kind.wall_height - kind.window.height;
  window(front, {kind.width / 2, parapet_share * spare}, kind.window, finishes);
  front.emit();
}

void roof_window(Face& slope, Point2 middle, const HouseFinishes& finishes) {
  constexpr double half_width = 0.45, half_height = 0.7, curb = 0.08;
  Face frame = slope.step(rectangle({middle.u - half_width, middle.v - half_height},
                                    {middle.u + half_width, middle.v + half_height}),
                          curb, finishes.frame, finishes.frame);
  glaze(frame, {frame.low().u + frame_width / 2, frame.high().u - frame_width / 2},
        {frame.low().v + frame_width / 2, frame.high().v - frame_width / 2}, finishes);
  frame.emit();
}

Sweep::Sweep(Builder& builder, std::vector<Edge> profile, double length, Finish gable) {
  Ring high, low;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Point2 a = profile[i].from, b = profile[(i + 1) % profile.size()].from;
    const double size = std::hypot(b.u - a.u, b.v - a.v);
    const Vec3 along{0, (b.u - a.u) / size, (b.v - a.v) / size};
    const bool descends = b.v < a.v;
    const Frame frame = descends ? Frame{{0, b.u, b.v}, {1, 0, 0}, -along}
                                 : Frame{{length, a.u, a.v}, {-1, 0, 0}, along};
    faces_.emplace_back(builder, frame, rectangle({0, 0}, {length, size}), profile[i].finish);
    names_.push_back(profile[i].name);
    high.push_back(a);
    low.push_back({-a.u, a.v});
  }
  std::reverse(low.begin(), low.end());
  faces_.emplace_back(builder, Frame{{0, 0, 0}, {0, -1, 0}, {0, 0, 1}}, low, gable);
  faces_.emplace_back(builder, Frame{{length, 0, 0}, {0, 1, 0}, {0, 0, 1}}, high, gable);
}

Face& Sweep::face(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  SUNLOAD_EXPECT(found != names_.end(), "unknown face " + name);
  return faces_[static_cast<std::size_t>(found - names_.begin())];
}

void Sweep::emit() {
  for (auto& face : faces_) face.emit();
}

}  // namespace sunload::builtin
