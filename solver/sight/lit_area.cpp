// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/lit_area.h"

#include <algorithm>

#include "solver/sight/view_cut.h"

namespace sunload {

namespace {

/// Beyond, pieces are cut by shades that most of them do not meet.
constexpr std::size_t most_pieces = 64;
/// Shades that are looked at together; beyond, and where pieces become too many, halves are.
constexpr std::size_t most_together = 32;
/// Beyond so many shades of one polygon rays cost less.
constexpr std::size_t most_shades = 256;
/// Halves are looked at where shades are, all together, less than this share of the polygon's area:
/// masts and wires on a wide ground, which few rays meet. Of crowns of leaves and pergolas rays
/// tell as well, and cost less (a June of 12 000 leaves: 8 … 34 %).
constexpr double sparse_share = 0.25;
/// Of the polygon's area: less is rounding.
constexpr double least_share = 1e-12;

/// The area of what of a polygon lies in a shade; below 0: it has too many corners.
double area_within(ViewPolygon polygon, const ViewPolygon& shade) {
  return keep_within(polygon, shade) ? polygon.area() : -1;
}

/// Both sides of a line across the middle of the longer extent; false: one has too many corners.
bool halve(const ViewPolygon& polygon, ViewPolygon& first, ViewPolygon& second) {
  const ViewBox box = box_of(polygon);
  const double x = (box.x0 + box.x1) / 2, y = (box.y0 + box.y1) / 2;
  const bool is_wide = box.x1 - box.x0 > box.y1 - box.y0;
  const ViewLine line =
      is_wide ? line_through({x, box.y0}, {x, box.y1}) : line_through({box.x0, y}, {box.x1, y});
  ViewDistances beyond;
  return measure(polygon, line, beyond) == ViewSide::both && cut(polygon, beyond, first, second);
}

/// Shades that may reach into a polygon.
void keep_near(const ViewPolygon& polygon, std::span<const ViewPolygon* const> shades,
               std::vector<const ViewPolygon*>& near) {
  const ViewBox box = box_of(polygon);
  near.clear();
  for (const ViewPolygon* shade : shades)
    if (!box.is_apart_from(box_of(*shade), 0, 0)) near.push_back(shade);
}

/// Whether they are few and thin.
bool are_sparse(std::span<const ViewPolygon* const> shades, double area) {
  double shaded = 0;
  for (const ViewPolygon* shade : shades) shaded += shade->area();
  return shaded < sparse_share * area;
}

}  // namespace

std::optional<double> LitArea::share(const ViewPolygon& polygon,
                                     std::span<const ViewPolygon* const> shades) {
  if (shades.empty()) return 1;
  if (shades.size() > most_shades) return {};
  const double area = polygon.area();
  negligible_ = least_share * area;
  parts_left_ = most_parts;
  auto lit = lit_together(polygon, shades);
  if (!lit && are_sparse(shades, area)) lit = lit_of_halves(polygon, shades, 0);
  if (!lit) return {};
  const double share = *lit / area;
  return share < least_share ? 0 : share > 1 - least_share ? 1 : share;
}

bool LitArea::parts(const ViewPolygon& polygon, Shades shades, std::vector<ViewPolygon>& lit) {
  lit.clear();
  negligible_ = least_share * polygon.area();
  parts_left_ = most_parts;
  return add_parts(polygon, shades, 0, lit);
}

bool LitArea::may_halve(const ViewPolygon& polygon, std::size_t halvings, ViewPolygon& first,
                        ViewPolygon& second) {
  if (halvings == most_halvings || parts_left_ < 2) return false;
  parts_left_ -= 2;
  return halve(polygon, first, second);
}

bool LitArea::add_parts(const ViewPolygon& polygon, Shades shades, std::size_t halvings,
                        std::vector<ViewPolygon>& lit) {
  if (shades.size() <= most_together) {
    left_.assign(1, polygon);
    const bool is_done = std::all_of(
        shades.begin(), shades.end(),
        [this](const ViewPolygon* shade) { return left_.empty() || take_away(*shade); });
    if (is_done) {
      lit.insert(lit.end(), left_.begin(), left_.end());
      return true;
    }
  }
  ViewPolygon first, second;
  if (!may_halve(polygon, halvings, first, second)) return false;
  for (const ViewPolygon& half : {first, second}) {
    keep_near(half, shades, of_half_[halvings]);
    if (!add_parts(half, of_half_[halvings], halvings + 1, lit)) return false;
  }
  return true;
}

std::optional<double> LitArea::lit_of_halves(const ViewPolygon& polygon, Shades shades,
                                             std::size_t halvings) {
  ViewPolygon first, second;
  if (!may_halve(polygon, halvings, first, second)) return {};
  double sum = 0;
  for (const ViewPolygon& half : {first, second}) {
    auto& own = of_half_[halvings];
    keep_near(half, shades, own);
    auto lit = lit_together(half, own);
    if (!lit) lit = lit_of_halves(half, own, halvings + 1);
    if (!lit) return {};
    sum += *lit;
  }
  return sum;
}

std::optional<double> LitArea::lit_together(const ViewPolygon& polygon, Shades shades) {
  if (shades.empty()) return polygon.area();
  if (shades.size() > most_together) return {};
  left_.assign(1, polygon);
  for (const ViewPolygon* shade : shades.first(shades.size() - 1))
    if (!take_away(*shade)) return {};
  double lit = 0;
  for (const ViewPolygon& piece : left_) {
    const double shaded = area_within(piece, *shades.back());
    if (shaded < 0) return {};
    lit += piece.area() - shaded;
  }
  return lit;
}

bool LitArea::take_away(const ViewPolygon& shade) {
  next_.clear();
  for (const ViewPolygon& piece : left_)
    if (!split(piece, shade)) return false;
  left_.swap(next_);
  return left_.size() <= most_pieces;
}

/// Puts what of a piece lies outside of the shade into next_; false: it has too many corners.
bool LitArea::split(const ViewPolygon& piece, const ViewPolygon& shade) {
  const std::size_t before = next_.size();
  ViewPolygon rest = piece, within, outside;
  ViewDistances beyond;
  for (std::size_t k = 0; k < shade.size(); ++k) {
    const ViewSide side = measure(rest, edge(shade, k), beyond);
    if (side == ViewSide::within) continue;
    if (side == ViewSide::beyond) {
      // All of the piece is outside: what has been cut off of it belongs to it.
      next_.resize(before);
      next_.push_back(piece);
      return true;
    }
    if (!cut(rest, beyond, within, outside)) return false;
    if (outside.area() > negligible_) next_.push_back(outside);
    rest = within;
  }
  return true;  // what is left is shaded
}

}  // namespace sunload
