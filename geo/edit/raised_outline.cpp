// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/edit/raised_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace sunload {

namespace {

constexpr double aligned_m = 0.05;  // edges of one line in plan, in spite of rounding of files
constexpr double beside_m = 0.02;  // from an edge to where its sides are looked at: strips are thin
constexpr double shortest_m = 0.01;       // of edges in plan, and of pieces of them
constexpr double near_wall_m = 0.5;       // a wall so near stands for the rim
constexpr double widest_eaves_m = 2;      // without a floor that tells where the body ends
constexpr double parallel_enough = 0.95;  // cosine

/// An edge of a face.
struct RimEdge {
  Vec3 a, b;
  std::size_t face;
};

/// Where an edge is, along another one in plan.
struct Alongside {
  double from, to;              ///< m from that one's first end
  double z_from, z_to;          ///< of its ends
  double moves_from, moves_to;  ///< share of the lift
  std::size_t face, edge;

  double at(double t, double first, double last) const {
    return first + (last - first) * (t - from) / (to - from);
  }
  double height(double t) const { return at(t, z_from, z_to); }
  double moves(double t) const { return at(t, moves_from, moves_to); }
  bool spans(double t) const { return (from < t) != (to < t); }
};

/// A piece of a growing wall where it goes through the level.
struct CutPiece {
  Point2 a, b;
};

class OutlineSearch {
 public:
  explicit OutlineSearch(const LiftedBody& body) : body_(body) {
    for (std::size_t f = 0; f < body.faces.size(); ++f)
      for (const auto& ring : body.faces[f].rings)
        for (std::size_t i = 0; i < ring.size(); ++i)
          edges_.push_back({ring[i], ring[(i + 1) % ring.size()], f});
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      if (body.leans[f] == 0)
        add_cut_pieces(body.faces[f]);
      else if (is_wholly(f, Moves::yes))
        lifted_.push_back(f);
      else if (is_wholly(f, Moves::no))
        (body.is_roof[f] != 0 ? low_roofs_ : floors_).push_back(f);
    }
  }

  RaisedOutline run() {
    RaisedOutline outline;
    outline.has_floor = !floors_.empty();
    if (is_closed()) return outline;
    for (std::size_t e = 0; e < edges_.size(); ++e) look_at(e, outline);
    return outline;
  }

 private:
  enum class Moves { yes, no };
  bool is_lifted(Vec3 v) const { return v.z >= body_.level_m; }
  bool is_wholly(std::size_t face, Moves moves) const {
    for (const auto& ring : body_.faces[face].rings)
      for (const Vec3 v : ring)
        if (is_lifted(v) != (moves == Moves::yes)) return false;
    return true;
  }

  /// Whether every edge has two faces that run along it in opposite ways.
  bool is_closed() const {
    using Ends = std::array<double, 6>;
    std::map<Ends, int> runs;
    for (const RimEdge& e : edges_) {
      const bool forward = std::tie(e.a.x, e.a.y, e.a.z) < std::tie(e.b.x, e.b.y, e.b.z);
      const Vec3 p = forward ? e.a : e.b, q = forward ? e.b : e.a;
      runs[{p.x, p.y, p.z, q.x, q.y, q.z}] += forward ? 1 : -1;
    }
    return std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.second == 0; });
  }

  void add_cut_pieces(const LooseFace& face) {
    std::vector<Point2> places;
    for (const auto& ring : face.rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 a = ring[i], b = ring[(i + 1) % ring.size()];
        if (is_lifted(a) == is_lifted(b)) continue;
        const double t = (body_.level_m - a.z) / (b.z - a.z);
        places.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
      }
    std::sort(places.begin(), places.end(),
              [](Point2 p, Point2 q) { return std::pair(p.u, p.v) < std::pair(q.u, q.v); });
    for (std::size_t i = 0; i + 1 < places.size(); i += 2)
      cuts_.push_back({places[i], places[i + 1]});
  }

  bool covers(const std::vector<std::size_t>& faces, Point2 at) const {
    return std::any_of(faces.begin(), faces.end(), [&](std::size_t f) {
      return holds_in_plan(body_.faces[f].rings, at, plan_point);
    });
  }
  bool is_inside(Point2 at) const {
    return covers(lifted_, at) && (floors_.empty() || covers(floors_, at));
  }
  bool is_outside(Point2 at) const {
    return !covers(lifted_, at) && (!covers(floors_, at) || covers(low_roofs_, at));
  }

  // --- edges above each other -------------------------------------------------------------

  /// A line in plan: along an edge, and its left.
  struct PlanLine {
    Point2 begin, along;
    double length;
    Point2 at(double t, double left = 0) const {
      return {begin.u + t * along.u - left * along.v, begin.v + t * along.v + left * along.u};
    }
    double along_of(Vec3 p) const { return (p.x - begin.u) * along.u + (p.y - begin.v) * along.v; }
    double left_of(Vec3 p) const { return (p.y - begin.v) * along.u - (p.x - begin.u) * along.v; }
  };
  static std::optional<PlanLine> line_of(const RimEdge& e) {
    const double length = std::hypot(e.b.x - e.a.x, e.b.y - e.a.y);
    if (length < shortest_m) return {};
    return PlanLine{{e.a.x, e.a.y}, {(e.b.x - e.a.x) / length, (e.b.y - e.a.y) / length}, length};
  }

  std::vector<Alongside> alongside(const PlanLine& line) const {
    std::vector<Alongside> found;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const RimEdge& e = edges_[i];
      if (std::abs(line.left_of(e.a)) > aligned_m || std::abs(line.left_of(e.b)) > aligned_m)
        continue;
      const double from = line.along_of(e.a), to = line.along_of(e.b);
      if (std::abs(to - from) < shortest_m || std::max(from, to) < 0 ||
          std::min(from, to) > line.length)
        continue;
      found.push_back({from, to, e.a.z, e.b.z, is_lifted(e.a) ? 1.0 : 0.0,
                       is_lifted(e.b) ? 1.0 : 0.0, e.face, i});
    }
    return found;
  }

  /// Where something begins, ends or crosses along an edge.
  std::vector<double> joints_of(const PlanLine& line, const Alongside& own,
                                const std::vector<Alongside>& all) const {
    std::vector<double> joints{0, line.length};
    const auto add = [&](double t) {
      if (t > shortest_m && t < line.length - shortest_m) joints.push_back(t);
    };
    for (const RimEdge& e : edges_)
      if (std::abs(line.left_of(e.a)) <= aligned_m) add(line.along_of(e.a));
    for (const Alongside& other : all) {
      const double now = own.height(0) - other.height(0);
      const double then = own.height(line.length) - other.height(line.length);
      if ((now < 0) != (then < 0)) add(line.length * now / (now - then));
    }
    std::sort(joints.begin(), joints.end());
    return joints;
  }

  /// Whether a wall reaches from what stays to what moves.
  bool has_wall(const std::vector<Alongside>& all, double t) const {
    for (std::size_t i = 0; i < all.size();) {
      const std::size_t face = all[i].face;
      std::vector<const Alongside*> spanning;
      for (; i < all.size() && all[i].face == face; ++i)
        if (body_.leans[face] == 0 && all[i].spans(t)) spanning.push_back(&all[i]);
      std::sort(spanning.begin(), spanning.end(), [&](const Alongside* a, const Alongside* b) {
        return a->height(t) < b->height(t);
      });
      for (std::size_t k = 0; k + 1 < spanning.size(); k += 2)
        if (spanning[k]->moves(t) == 0 && spanning[k + 1]->moves(t) > 0) return true;
    }
    return false;
  }

  /// Whether a wall along the edge crosses the level so near on either side that it stands for it.
  bool has_wall_beside(const PlanLine& line, double t) const {
    return std::any_of(cuts_.begin(), cuts_.end(), [&](const CutPiece& cut) {
      const Vec3 a{cut.a.u, cut.a.v, 0}, b{cut.b.u, cut.b.v, 0};
      const double from = line.along_of(a) - t, to = line.along_of(b) - t;
      if ((from < 0) == (to < 0) || std::abs(to - from) < parallel_enough * norm(b - a))
        return false;
      const double left =
          line.left_of(a) + (line.left_of(b) - line.left_of(a)) * from / (from - to);
      return std::abs(left) > aligned_m && std::abs(left) <= near_wall_m;
    });
  }

  /// Whether a wall crosses the level in reach of eaves.
  bool has_wall_in_reach(Point2 at) const {
    return std::any_of(cuts_.begin(), cuts_.end(), [&](const CutPiece& cut) {
      const Vec3 a{cut.a.u - at.u, cut.a.v - at.v, 0},
          along{cut.b.u - cut.a.u, cut.b.v - cut.a.v, 0};
      const double square = dot(along, along);
      const double s = square > 0 ? std::clamp(-dot(a, along) / square, 0.0, 1.0) : 0;
      return norm(a + along * s) <= widest_eaves_m;
    });
  }

  static bool is_lowest_that_moves(const Alongside& own, const std::vector<Alongside>& all,
                                   double t) {
    return std::none_of(all.begin(), all.end(), [&](const Alongside& other) {
      if (other.edge == own.edge || !other.spans(t) || other.moves(t) <= 0) return false;
      const double above = own.height(t) - other.height(t);
      return above > touching_z_m || (above >= -touching_z_m && other.edge < own.edge);
    });
  }
  static constexpr double touching_z_m = 1e-6;  // heights of one corner of two faces

  // --- one edge ---------------------------------------------------------------------------

  void look_at(std::size_t e, RaisedOutline& outline) {
    const RimEdge& edge = edges_[e];
    const auto line = line_of(edge);
    if (!line || (!is_lifted(edge.a) && !is_lifted(edge.b))) return;
    const auto all = alongside(*line);
    const auto own = std::find_if(all.begin(), all.end(),
                                  [&](const Alongside& other) { return other.edge == e; });
    const auto joints = joints_of(*line, *own, all);
    // Pieces next to each other become one wall.
    std::optional<double> begin;
    double left_side = 0;
    const auto close = [&](double end) {
      if (begin) add_wall(edge, *line, *begin, end, left_side, outline);
      begin.reset();
    };
    for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
      const double t = (joints[j] + joints[j + 1]) / 2, length = joints[j + 1] - joints[j];
      if (length < shortest_m && begin) continue;
      const double inner = length < shortest_m ? 0 : inner_side(*line, *own, all, t);
      if (inner != 0) outline.length_m += length;
      const bool is_bare = inner != 0 && !has_wall(all, t) && !has_wall_beside(*line, t) &&
                           (!floors_.empty() || !has_wall_in_reach(line->at(t)));
      if (!is_bare || (begin && inner != left_side)) close(joints[j]);
      if (!is_bare) continue;
      outline.bare_m += length;
      left_side = inner;
      if (!begin) begin = joints[j];
    }
    close(line->length);
  }

  /// 1: the body is to the left of the edge; -1: to its right; 0: it is not of the outline there.
  double inner_side(const PlanLine& line, const Alongside& own, const std::vector<Alongside>& all,
                    double t) const {
    if (!is_lowest_that_moves(own, all, t)) return 0;
    for (const double side : {1.0, -1.0})
      if (is_inside(line.at(t, side * beside_m)) && is_outside(line.at(t, -side * beside_m)))
        return side;
    return 0;
  }

  /// Between the edge's places before and after.
  void add_wall(const RimEdge& edge, const PlanLine& line, double begin, double end, double inner,
                RaisedOutline& outline) const {
    if (floors_.empty() || body_.by_m < 0) return;
    const auto place = [&](double t, double lift) {
      const double share = t / line.length;
      const Vec3 p = t <= 0             ? edge.a
                     : t >= line.length ? edge.b
                                        : edge.a + (edge.b - edge.a) * share;
      const double moves = (is_lifted(edge.a) ? 1 - share : 0) + (is_lifted(edge.b) ? share : 0);
      return Vec3{p.x, p.y, p.z + lift * moves};
    };
    std::vector<Vec3> ring{place(begin, 0), place(end, 0), place(end, body_.by_m),
                           place(begin, body_.by_m)};
    // Where an end stays, its two places are one.
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    if (ring.front() == ring.back()) ring.pop_back();
    // From its first to its second end and then up, the front is to the right of the edge.
    if (inner < 0) std::reverse(ring.begin(), ring.end());
    outline.walls.push_back(std::move(ring));
  }

  const LiftedBody& body_;
  std::vector<RimEdge> edges_;
  std::vector<CutPiece> cuts_;
  std::vector<std::size_t> lifted_, floors_, low_roofs_;  ///< faces that lean
};

}  // namespace

RaisedOutline raised_outline(const LiftedBody& body) { return OutlineSearch(body).run(); }

}  // namespace sunload
