// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/covered_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/mesh/clip.h"
#include "geo/mesh/constrained_delaunay.h"
#include "geo/mesh/delaunay.h"

namespace sunload {

namespace {

constexpr double least_share = 1e-6;         // of a triangle: a smaller part is rounding
constexpr double least_height_ratio = 1e-6;  // of a part: as in mesh_prepare
// On one piece: what is done grows by their square.
constexpr std::size_t most_lines = 5000, most_crossings = 20000;
// Of a triangle on which more meet: pieces beyond are told by their middles.
constexpr int most_halvings = 16;

struct VertexInfo {
  std::int32_t vertex = -1;  // of the mesh
};
struct CoverInfo {
  CoverState state = CoverState::open;
};
using CoverDelaunay = ConstrainedDelaunay<VertexInfo, CoverInfo>;
using Polygon = std::vector<Point2>;
using Line2 = std::array<Point2, 2>;

double turn(Point2 a, Point2 b, Point2 p) {
  return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
}

bool is_before(Point2 a, Point2 b) { return a.u != b.u ? a.u < b.u : a.v < b.v; }

/// Into an order of their own: crossings of lines depend on which comes first.
void sort_lines(std::vector<Line2>& lines) {
  const auto key = [](const Line2& l) { return std::array{l[0].u, l[0].v, l[1].u, l[1].v}; };
  std::sort(lines.begin(), lines.end(),
            [&](const Line2& a, const Line2& b) { return key(a) < key(b); });
}

double twice_area(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += turn(polygon[0], polygon[i - 1], polygon[i]);
  return sum;
}

/// A triangle of the mesh, or a piece of one; corners that are none of the mesh have no vertex.
struct Piece {
  std::array<Vec3, 3> corners;
  std::array<std::int32_t, 3> vertices;
};

/// A piece of triangle `t` in its own plane.
class Cutter {
 public:
  Cutter(const Covers& covers, std::size_t t, const Piece& piece)
      : covers_(covers), t_(t), piece_(piece), plane_(piece.corners[0], covers.normal(t)) {
    for (const Vec3 corner : piece.corners) outline_.push_back(plane_.seen(corner));
    if (twice_area(outline_) < 0) {
      std::reverse(outline_.begin(), outline_.end());
      is_reversed_ = true;
    }
    area2_ = twice_area(outline_);
  }

  /// Nothing where too many lines meet on the piece.
  std::optional<CoveredParts> run() {
    find_lines();
    if (lines_.empty()) return CoveredParts{state_in_the_middle(), {}, first_taker_};
    if (lines_.size() > most_lines || !divide(lines_, [this](Point2 p) { return state_at(p); }))
      return {};
    const auto [covered, taken] = areas2();
    if (covered + taken <= least_share * area2_) return CoveredParts{};
    for (const auto& [area2, state] :
         {std::pair{covered, CoverState::covered}, {taken, CoverState::taken}})
      if (area2 >= (1 - least_share) * area2_) return CoveredParts{state, {}, first_taker_};
    divide_at_borders();
    return CoveredParts{CoverState::open, parts(), first_taker_};
  }

  /// Of the whole piece, by its middle.
  CoveredParts roughly() {
    find_lines();
    return {state_in_the_middle(), {}, first_taker_};
  }

 private:
  void find_lines() {
    using Meets = Covers::Meets;
    std::vector<std::size_t> up_to;
    std::vector<Touching> touching;
    covers_.visit_near(t_, piece_.corners, [&](std::size_t u) {
      const auto add = [&](std::vector<Polygon>& list, const std::optional<Overlap>& overlap) {
        if (overlap) touching.push_back({covers_.body(u), begin(*overlap, list)});
        return overlap.has_value();
      };
      if (covers_.is_taken(t_, u)) {
        if (add(taken_, overlap_with(u))) first_taker_ = std::min(first_taker_.value_or(u), u);
      } else if (covers_.are_of_one_body(t_, u)) {
        if (!covers_.is_against(t_, u)) return;
        const auto overlap = overlap_with(u);
        if (overlap && covers_.is_solid_behind(t_, plane_.lifted(middle(overlap->shared))))
          add(against_, overlap);
      } else if (covers_.is_behind(t_, u)) {
        // What shades the one before it is not only hidden, but must go.
        const bool goes = covers_.comes_before(t_, u);
        if (add(goes ? taken_ : against_, overlap_with(u)) && goes)
          first_taker_ = std::min(first_taker_.value_or(u), u);
      } else if (covers_.is_against(t_, u)) {
        add(against_, overlap_with(u));
      } else if (const Meets meets = covers_.ending(t_, u); meets == Meets::through) {
        if (const auto line = cut_by(u, 0)) lines_.push_back(*line);
      } else if (meets == Meets::up_to) {
        up_to.push_back(u);
      }
    });
    covers_.visit_rims_above(t_, piece_.corners, [&](Vec3 a, Vec3 b) {
      const auto line = within_outline(plane_.seen(a), plane_.seen(b));
      if (line && !is_on_outline(*line)) lines_.push_back(*line);
    });
    std::ranges::stable_sort(touching, {}, &Touching::body);
    for (const std::size_t u : up_to)
      if (const auto line = cut_by(u, covers_.looked_at_m()))
        if (!is_told_by(touching, covers_.body(u), middle((*line)[0], (*line)[1])))
          lines_.push_back(*line);
    sort_lines(lines_);
  }

  /// What lies in this one's plane, of a body.
  struct Touching {
    std::int32_t body;
    Polygon polygon;
  };
  /// What stands on this one ends at it, and what touches it of the same body has told where.
  bool is_told_by(const std::vector<Touching>& touching, std::int32_t body, Point2 at) const {
    const auto first = std::ranges::lower_bound(touching, body, {}, &Touching::body);
    const auto last = std::ranges::upper_bound(touching, body, {}, &Touching::body);
    return body >= 0 && std::any_of(first, last, [&](const Touching& of) {
             for (std::size_t k = 0; k < of.polygon.size(); ++k) {
               const Point2 a = of.polygon[k], b = of.polygon[(k + 1) % of.polygon.size()];
               if (turn(a, b, at) < -covers_.looked_at_m() * std::hypot(b.u - a.u, b.v - a.v))
                 return false;
             }
             return true;
           });
  }

  struct Overlap {
    Polygon triangle;  ///< all of the other
    Polygon shared;    ///< what of it lies on the piece
  };
  /// Nothing where they have next to nothing in common.
  std::optional<Overlap> overlap_with(std::size_t u) const {
    Overlap overlap;
    for (const Vec3 p : covers_.corners(u)) overlap.triangle.push_back(plane_.seen(p));
    if (twice_area(overlap.triangle) < 0) std::ranges::reverse(overlap.triangle);
    overlap.shared = overlap.triangle;
    for (std::size_t k = 0; k < 3; ++k)
      overlap.shared = clipped(
          overlap.shared, [&](Point2 p) { return turn(outline_[k], outline_[(k + 1) % 3], p); });
    if (twice_area(overlap.shared) <= least_share * area2_) return {};
    return overlap;
  }
  /// Adds to `list` what begins on the piece, and the lines where it does; the triangle.
  Polygon begin(const Overlap& overlap, std::vector<Polygon>& list) {
    const Polygon& shared = overlap.shared;
    // What is all of the piece begins nowhere on it.
    if (twice_area(shared) < (1 - least_share) * area2_)
      for (std::size_t i = 0; i < shared.size(); ++i)
        lines_.push_back({shared[i], shared[(i + 1) % shared.size()]});
    list.push_back(overlap.triangle);
    return overlap.triangle;
  }

  /// Where the triangle `u` goes through this one, or through the plane so far before it.
  std::optional<Line2> cut_by(std::size_t u, double before_m) const {
    const auto corners = covers_.corners(u);
    std::vector<Point2> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = corners[k], b = corners[(k + 1) % 3];
      const double of_a = plane_.offset(a) - before_m, of_b = plane_.offset(b) - before_m;
      if ((of_a < 0) == (of_b < 0)) continue;
      ends.push_back(plane_.seen(a + (of_a / (of_a - of_b)) * (b - a)));
    }
    if (ends.size() != 2) return {};
    return within_outline(ends[0], ends[1]);
  }

  /// As the rims of land beside this piece of it are.
  bool is_on_outline(const Line2& line) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 a = outline_[k], b = outline_[(k + 1) % 3];
      const double most = rounding() * std::hypot(b.u - a.u, b.v - a.v);
      if (std::abs(turn(a, b, line[0])) <= most && std::abs(turn(a, b, line[1])) <= most)
        return true;
    }
    return false;
  }

  /// What of a line lies on the piece.
  std::optional<Line2> within_outline(Point2 a, Point2 b) const {
    double from = 0, to = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double of_a = turn(outline_[k], outline_[(k + 1) % 3], a),
                   of_b = turn(outline_[k], outline_[(k + 1) % 3], b);
      if (of_a < 0 && of_b < 0) return {};
      if ((of_a < 0) == (of_b < 0)) continue;
      const double s = of_a / (of_a - of_b);
      if (of_a < 0)
        from = std::max(from, s);
      else
        to = std::min(to, s);
    }
    if (!(from < to)) return {};
    const auto at = [&](double s) { return Point2{a.u + s * (b.u - a.u), a.v + s * (b.v - a.v)}; };
    return Line2{at(from), at(to)};
  }

  static Point2 middle(const Polygon& polygon) {
    Point2 sum{};
    for (const Point2 p : polygon) sum = {sum.u + p.u, sum.v + p.v};
    const auto count = static_cast<double>(polygon.size());
    return {sum.u / count, sum.v / count};
  }
  static Point2 middle(Point2 a, Point2 b) { return {(a.u + b.u) / 2, (a.v + b.v) / 2}; }
  static Point2 middle(Point2 a, Point2 b, Point2 c) {
    return {(a.u + b.u + c.u) / 3, (a.v + b.v + c.v) / 3};
  }

  // Not in their overlaps with this one: of corners that are one but for rounding the edge between
  // them may point anywhere.
  static bool is_in_any(const std::vector<Polygon>& triangles, Point2 p) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const Polygon& of) {
      return turn(of[0], of[1], p) >= 0 && turn(of[1], of[2], p) >= 0 && turn(of[2], of[0], p) >= 0;
    });
  }

  CoverState state_in_the_middle() const {
    return state_at(middle(outline_[0], outline_[1], outline_[2]));
  }
  CoverState state_at(Point2 p) const {
    if (is_in_any(taken_, p)) return CoverState::taken;
    const bool is_covered = is_in_any(against_, p) || covers_.is_buried(t_, plane_.lifted(p));
    return is_covered ? CoverState::covered : CoverState::open;
  }

  /// Once more along the lines only where another state begins. States are carried over: the middle
  /// of a part may lie on the line between two things that cover it.
  void divide_at_borders() {
    const std::vector<Line2> borders = borders_of_states();
    CoverDelaunay by_all_lines;
    by_all_lines.swap(delaunay_);
    divide(borders, [&](Point2 p) {
      const auto face = by_all_lines.locate({p.u, p.v});
      return face == nullptr || by_all_lines.is_infinite(face) ? CoverState::open
                                                               : face->info().state;
    });
  }

  /// Along the lines, and takes each part's state; false where the lines cross too often.
  template <class StateAt>
  bool divide(const std::vector<Line2>& lines, const StateAt& state_of) {
    delaunay_.clear();
    nodes_.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      nodes_.push_back({outline_[k], delaunay_.insert({outline_[k].u, outline_[k].v})});
      nodes_[k].handle->info().vertex = piece_.vertices[is_reversed_ ? 2 - k : k];
    }
    std::vector<std::array<std::size_t, 2>> ends;
    for (std::size_t k = 0; k < 3; ++k) ends.push_back({k, (k + 1) % 3});
    for (const Line2& line : lines) {
      const std::size_t a = node_at(line[0]), b = node_at(line[1]);
      if (a != b) ends.push_back({a, b});
    }
    for (const auto& [a, b] : ends) {
      constrain(a, b);
      if (delaunay_.number_of_vertices() > most_crossings) return false;
    }
    for (const auto face : delaunay_.finite_face_handles()) {
      const Polygon p = corners_of(face);
      const Point2 inside = middle(p[0], p[1], p[2]);
      face->info().state = is_in_outline(inside) ? state_of(inside) : CoverState::open;
    }
    return true;
  }

  /// Doubled.
  struct Areas2 {
    double covered = 0, taken = 0;
  };
  Areas2 areas2() const {
    Areas2 sum;
    for (const auto face : delaunay_.finite_face_handles()) {
      const CoverState state = face->info().state;
      if (state == CoverState::covered) sum.covered += twice_area(corners_of(face));
      if (state == CoverState::taken) sum.taken += twice_area(corners_of(face));
    }
    return sum;
  }

  // Ends as near to each other, and to lines, as rounding are one, and on them: where a line ends
  // just beyond another, CGAL bends it to whatever is near.
  double rounding() const { return covers_.contact() / roundings_per_contact; }

  std::size_t node_at(Point2 p) {
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      if (std::hypot(p.u - nodes_[n].at.u, p.v - nodes_[n].at.v) <= rounding()) return n;
    nodes_.push_back({p, delaunay_.insert({p.u, p.v})});
    return nodes_.size() - 1;
  }

  /// The line from a to b, by all nodes on it.
  void constrain(std::size_t a, std::size_t b) {
    const Point2 from = nodes_[a].at, to = nodes_[b].at;
    const double length = std::hypot(to.u - from.u, to.v - from.v);
    std::vector<std::pair<double, std::size_t>> on{{0, a}, {length, b}};
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const Point2 p = nodes_[n].at;
      const double along =
          ((p.u - from.u) * (to.u - from.u) + (p.v - from.v) * (to.v - from.v)) / length;
      if (n == a || n == b || along <= 0 || along >= length) continue;
      if (std::abs(turn(from, to, p)) <= rounding() * length) on.emplace_back(along, n);
    }
    std::sort(on.begin(), on.end());
    for (std::size_t i = 1; i < on.size(); ++i)
      delaunay_.insert_constraint(nodes_[on[i - 1].second].handle, nodes_[on[i].second].handle);
  }

  Polygon corners_of(CoverDelaunay::Face_handle face) const {
    Polygon p;
    for (int k = 0; k < 3; ++k)
      p.push_back({face->vertex(k)->point().x(), face->vertex(k)->point().y()});
    return p;
  }

  bool is_in_outline(Point2 p) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (turn(outline_[k], outline_[(k + 1) % 3], p) < 0) return false;
    return true;
  }

  std::vector<Line2> borders_of_states() const {
    std::vector<Line2> borders;
    for (const auto& [face, k] : delaunay_.finite_edges()) {
      const auto other = face->neighbor(k);
      if (delaunay_.is_infinite(face) || delaunay_.is_infinite(other)) continue;
      if (face->info().state == other->info().state) continue;
      const auto& a = face->vertex(CoverDelaunay::cw(k))->point();
      const auto& b = face->vertex(CoverDelaunay::ccw(k))->point();
      Line2 border{Point2{a.x(), a.y()}, Point2{b.x(), b.y()}};
      if (is_before(border[1], border[0])) std::swap(border[0], border[1]);
      borders.push_back(border);
    }
    // CGAL tells an edge from the one of its two faces that has the lower address.
    sort_lines(borders);
    return borders;
  }

  std::vector<TrianglePart> parts() const {
    std::vector<TrianglePart> result;
    for (const auto face : delaunay_.finite_face_handles()) {
      const Polygon p = corners_of(face);
      if (!is_in_outline(middle(p[0], p[1], p[2]))) continue;
      TrianglePart part{{}, {-1, -1, -1}, face->info().state};
      double longest2 = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t to = is_reversed_ ? 2 - k : k;
        const Vec3 at = plane_.lifted(p[k]);
        part.corners[to] = {at.x, at.y, at.z};
        part.old[to] = face->vertex(static_cast<int>(k))->info().vertex;
        const Point2 q = p[(k + 1) % 3];
        longest2 =
            std::max(longest2, (q.u - p[k].u) * (q.u - p[k].u) + (q.v - p[k].v) * (q.v - p[k].v));
      }
      if (twice_area(p) > least_height_ratio * longest2) result.push_back(part);
    }
    // The triangulation owns no order that a reader could rely on: give it one.
    std::sort(result.begin(), result.end(),
              [](const TrianglePart& a, const TrianglePart& b) { return a.corners < b.corners; });
    return result;
  }

  const Covers& covers_;
  std::size_t t_;
  Piece piece_;
  Plane plane_;
  Polygon outline_;  // counter-clockwise on paper
  bool is_reversed_ = false;
  double area2_ = 0;
  std::vector<Line2> lines_;
  std::vector<Polygon> against_, taken_;  // triangles
  std::optional<std::size_t> first_taker_;
  struct Node {
    Point2 at;
    CoverDelaunay::Vertex_handle handle;
  };
  CoverDelaunay delaunay_;  // of the last division
  std::vector<Node> nodes_;
};

/// Nothing where too many lines meet on it, or CGAL cannot divide it.
std::optional<CoveredParts> cut(const Covers& covers, std::size_t t, const Piece& piece) {
  try {
    return Cutter(covers, t, piece).run();
  } catch (const CGAL::Failure_exception&) {
    return {};
  }
}

/// At the longest edge.
std::array<Piece, 2> halves(const Piece& piece) {
  std::size_t apex = 0;
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k)
    if (const double length = norm(piece.corners[(k + 1) % 3] - piece.corners[(k + 2) % 3]);
        length > longest) {
      longest = length;
      apex = k;
    }
  const std::size_t b = (apex + 1) % 3, c = (apex + 2) % 3;
  std::array<Piece, 2> result{piece, piece};
  for (const auto& [half, corner] : {std::pair{0u, c}, {1u, b}}) {
    result[half].corners[corner] = (piece.corners[b] + piece.corners[c]) * 0.5;
    result[half].vertices[corner] = -1;
  }
  return result;
}

/// `parts` of a triangle, and the piece whole or in its parts.
void append(const Piece& piece, CoveredParts of_piece, CoveredParts& sum) {
  if (of_piece.taken_by)
    sum.taken_by = std::min(sum.taken_by.value_or(*of_piece.taken_by), *of_piece.taken_by);
  if (of_piece.parts.empty()) {
    TrianglePart whole{{}, piece.vertices, of_piece.state};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = piece.corners[k];
      whole.corners[k] = {p.x, p.y, p.z};
    }
    of_piece.parts.push_back(whole);
  }
  sum.parts.insert(sum.parts.end(), of_piece.parts.begin(), of_piece.parts.end());
}

CoveredParts parts_of(const Covers& covers, std::size_t t, const Piece& piece, int halvings) {
  if (auto result = cut(covers, t, piece)) return *std::move(result);
  if (halvings == most_halvings) return Cutter(covers, t, piece).roughly();
  CoveredParts sum;
  for (const Piece& half : halves(piece))
    append(half, parts_of(covers, t, half, halvings + 1), sum);
  const CoverState first = sum.parts.front().state;
  if (std::all_of(sum.parts.begin(), sum.parts.end(),
                  [&](const TrianglePart& part) { return part.state == first; }))
    return {first, {}, sum.taken_by};
  return sum;
}

}  // namespace

CoveredParts covered_parts(const Mesh& mesh, const Covers& covers, std::size_t t) {
  return parts_of(covers, t, {covers.corners(t), mesh.triangles[t]}, 0);
}

}  // namespace sunload
