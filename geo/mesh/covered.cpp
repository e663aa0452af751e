// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/covered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "geo/base/check.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/clip.h"
#include "geo/mesh/constrained_delaunay.h"
#include "geo/mesh/delaunay.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr double contact_ratio = 1e-4;
constexpr double least_share = 1e-6;         // of a triangle: a smaller part is rounding
constexpr double least_height_ratio = 1e-6;  // of a part: as in mesh_prepare
constexpr double rounds_per_contact = 100;   // corners of parts that are nearer are one
// Within one triangle, whose parts would be 2 mm wide: such a heap of lines bounds nothing.
constexpr std::size_t most_lines = 5000, most_crossings = 20000;
// Pairs of triangles compared: cities have some ten for each triangle.
constexpr std::size_t most_pairs = 500'000'000;

struct VertexInfo {
  std::int32_t vertex = -1;  // of the mesh
};
/// What is said of a part of a triangle: `taken` is where another triangle is instead.
enum class State : std::uint8_t { open, covered, taken };
struct FaceInfo {
  State state = State::open;
};
using Delaunay = ConstrainedDelaunay<VertexInfo, FaceInfo>;
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

/// Whether a vertical line through (x, y), moved aside by nothing, meets the triangle: +1 where it
/// looks up, -1 down, 0 not. Of triangles at an edge or corner below the line just one side is met
/// (Edelsbrunner, Mücke 1990, Simulation of simplicity).
int crossing(const std::array<Vec3, 3>& corners, double x, double y) {
  const PlanKernel::Point_2 p(x, y);
  int positive = 0, negative = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = corners[k], b = corners[(k + 1) % 3];
    int side = CGAL::orientation(PlanKernel::Point_2(a.x, a.y), PlanKernel::Point_2(b.x, b.y), p);
    if (side == 0)
      side = a.y != b.y ? (a.y > b.y ? 1 : -1) : (a.x != b.x ? (b.x > a.x ? 1 : -1) : 0);
    if (side == 0) return 0;
    ++(side > 0 ? positive : negative);
  }
  return positive == 3 ? 1 : (negative == 3 ? -1 : 0);
}

/// What can cover: solid bodies, opaque surfaces, land.
class Covers {
 public:
  Covers(const Mesh& mesh, const Bodies& bodies, const std::vector<std::uint8_t>& is_opaque,
         const std::vector<std::uint8_t>& seals, const std::vector<std::uint8_t>& emits)
      : mesh_(mesh), bodies_(bodies), is_opaque_(is_opaque), seals_(seals), emits_(emits) {
    const Box box = bounding_box(mesh.vertices);
    contact_ = std::min(contact_m, contact_ratio * norm(box.high - box.low));
    same_place_ = same_place_m(mesh);
    find_solids();
    find_land();
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      boxes.push_back(box_of(t));
      const double length = norm(mesh.area_vector2(t));
      normal_.push_back(length > 0 ? mesh.area_vector2(t) / length : Vec3{});
    }
    tree_ = BoxTree(std::move(boxes));
  }

  double contact() const { return contact_; }
  Vec3 normal(std::size_t t) const { return normal_[t]; }
  std::array<Vec3, 3> corners(std::size_t t) const {
    return {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
  }

  template <class Visit>
  void visit_near(std::size_t t, const Visit& visit) const {
    tree_.visit_meeting(widened(box_of(t), std::max(contact_, same_place_)), [&](std::size_t u) {
      if (u == t) return;
      if (!are_of_one_body(t, u) && ++pairs_ > most_pairs) throw too_many_pairs();
      visit(u);
    });
  }
  bool are_of_one_body(std::size_t t, std::size_t u) const {
    const auto b = bodies_.triangle_body[t];
    return b >= 0 && b == bodies_.triangle_body[u];
  }

  /// Whether `u` is in the place of `t` where they overlap, and faces where `t` does. Of two that
  /// are alike the first is there; before others what emits, then what faces both ways.
  bool is_taken(std::size_t t, std::size_t u) const {
    if (!is_opaque_[u] || !mesh_.bears_patches(u)) return false;
    const auto rank = [&](std::size_t x) { return std::pair(emits(x), faces_both(x)); };
    if (rank(t) == rank(u) ? u > t : rank(u) < rank(t)) return false;
    if (faces_both(t) && !faces_both(u)) return false;
    if (!faces_both(u) && dot(normal_[t], normal_[u]) <= 0) return false;
    return is_near_plane(t, u, same_place_) && is_near_plane(u, t, same_place_);
  }

  /// Front against front, as near as the contact where they overlap.
  bool is_against(std::size_t t, std::size_t u) const {
    return is_opaque_[u] && mesh_.triangle_sides[t] == Sides::one &&
           dot(normal_[t], normal_[u]) < 0 &&
           (is_near_plane(t, u, contact_) || is_near_plane(u, t, contact_));
  }
  /// Whether the inside of a solid or the land ends where `u` cuts `t`.
  bool may_end_at(std::size_t t, std::size_t u) const {
    const bool may_end =
        is_in_solid(u) || (is_land_[u] && !is_land_[t]) || (is_land_[t] && seals(u));
    return may_end && is_cut(t, u) && is_cut(u, t);
  }

  /// Whether the front of `t` at this point of it is inside of a body or below land.
  bool is_buried(std::size_t t, Vec3 at) const {
    const Vec3 p = at + 2 * contact_ * normal_[t];
    const auto own = bodies_.triangle_body[t];
    // A cavity's fronts look into it: that is no part of the body around.
    int inside = own >= 0 && bodies_.bodies[static_cast<std::size_t>(own)].is_closed &&
                         bodies_.bodies[static_cast<std::size_t>(own)].volume < 0
                     ? -1
                     : 0;
    bool is_below_land = false;
    tree_.visit_meeting({p, {p.x, p.y, 1e300}}, [&](std::size_t u) {
      if (is_in_solid(u) && bodies_.triangle_body[u] != own) {
        const int side = crossing(corners(u), p.x, p.y);
        if (side != 0 && plane_height(u, p.x, p.y) > p.z) inside += side;
      }
      if (is_land_[u] && !is_land_[t] && !is_below_land) {
        const auto z =
            height_at(mesh_.corner(u, 0), mesh_.corner(u, 1), mesh_.corner(u, 2), p.x, p.y);
        is_below_land = z && *z > p.z + contact_;
      }
    });
    return inside > 0 || is_below_land || (is_land_[t] && is_sealed(p));
  }

 private:
  static InputError too_many_pairs() {
    return {{},
            "more triangles overlap than can be compared",
            "what lies inside of bodies cannot be told from what does not",
            "is geometry there many times over? scene.repair: none leaves it as it is"};
  }
  bool emits(std::size_t t) const { return !emits_.empty() && emits_[t] != 0; }
  bool faces_both(std::size_t t) const { return mesh_.triangle_sides[t] == Sides::two; }
  bool seals(std::size_t t) const { return !seals_.empty() && seals_[t] != 0; }
  /// Land at `p` under a floor, or in the pocket that it closes.
  bool is_sealed(Vec3 p) const {
    bool is_sealed = false;
    if (seals_.empty()) return is_sealed;
    tree_.visit_column(p.x, p.y, [&](std::size_t u) {
      if (seals(u) && slope_of(mesh_, u) == Slope::downward)
        is_sealed |= height_at(mesh_.corner(u, 0), mesh_.corner(u, 1), mesh_.corner(u, 2), p.x, p.y)
                         .has_value();
    });
    return is_sealed;
  }
  Box box_of(std::size_t t) const {
    return box_around({mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)});
  }
  bool is_in_solid(std::size_t t) const {
    const auto b = bodies_.triangle_body[t];
    return b >= 0 && is_solid_[static_cast<std::size_t>(b)] != 0;
  }

  void find_solids() {
    for (const Body& body : bodies_.bodies)
      is_solid_.push_back(body.is_closed && !body.is_inside_out);
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const auto b = bodies_.triangle_body[t];
      if (b >= 0 && !is_opaque_[t]) is_solid_[static_cast<std::size_t>(b)] = 0;
    }
  }

  void find_land() {
    is_land_.assign(mesh_.triangle_count(), 0);
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (mesh_.triangle_surface[t] != Surface::ground || is_in_closed(t)) continue;
      const auto& kind = mesh_.object_kinds[mesh_.triangle_object[t].index()];
      const bool may_be_bridge =
          kind == "Road" || kind == "Railway" || kind == "TransportSquare" || kind == "Waterway";
      is_land_[t] = !may_be_bridge && is_opaque_[t] && mesh_.area_vector2(t).z > 0;
    }
  }
  bool is_in_closed(std::size_t t) const {
    const auto b = bodies_.triangle_body[t];
    return b >= 0 && bodies_.bodies[static_cast<std::size_t>(b)].is_closed;
  }

  double distance(std::size_t plane, Vec3 p) const {
    return dot(p - mesh_.corner(plane, 0), normal_[plane]);
  }
  bool is_near_plane(std::size_t plane, std::size_t of, double within) const {
    for (int k = 0; k < 3; ++k)
      if (std::abs(distance(plane, mesh_.corner(of, k))) > within) return false;
    return true;
  }
  bool is_cut(std::size_t plane, std::size_t of) const {
    bool above = false, below = false;
    for (int k = 0; k < 3; ++k) {
      const double d = distance(plane, mesh_.corner(of, k));
      above |= d > contact_;
      below |= d < -contact_;
    }
    return above && below;
  }
  double plane_height(std::size_t t, double x, double y) const {
    const Vec3 a = mesh_.corner(t, 0), n = normal_[t];
    return n.z == 0 ? a.z : a.z - (n.x * (x - a.x) + n.y * (y - a.y)) / n.z;
  }

  const Mesh& mesh_;
  const Bodies& bodies_;
  const std::vector<std::uint8_t>& is_opaque_;
  const std::vector<std::uint8_t>& seals_;
  const std::vector<std::uint8_t>& emits_;
  double contact_ = 0, same_place_ = 0;
  std::vector<std::uint8_t> is_solid_, is_land_;  // per body, per triangle
  std::vector<Vec3> normal_;
  BoxTree tree_;
  mutable std::size_t pairs_ = 0;
};

struct Part {
  std::array<std::array<double, 3>, 3> corners;  // of new ones; the old ones are told by `old`
  std::array<std::int32_t, 3> old;               // vertex of the mesh, or -1
  State state;
};

/// One triangle in its own plane.
class Cutter {
 public:
  Cutter(const Mesh& mesh, const Covers& covers, std::size_t t)
      : mesh_(mesh), covers_(covers), t_(t), plane_(mesh.corner(t, 0), covers.normal(t)) {
    for (int k = 0; k < 3; ++k) outline_.push_back(plane_.seen(mesh.corner(t, k)));
    if (twice_area(outline_) < 0) {
      std::reverse(outline_.begin(), outline_.end());
      is_reversed_ = true;
    }
    area2_ = twice_area(outline_);
  }

  /// No parts: the triangle is `state` as a whole.
  struct Result {
    State state = State::open;
    std::vector<Part> parts;
    std::optional<std::size_t> taken_by;  ///< the first of them
  };
  Result run() {
    find_lines();
    if (lines_.empty()) return {state_at(middle(outline_[0], outline_[1], outline_[2])), {}, {}};
    const auto [covered, taken] = divide(lines_);
    if (covered + taken <= least_share * area2_) return {};
    for (const auto& [area2, state] : {std::pair{covered, State::covered}, {taken, State::taken}})
      if (area2 >= (1 - least_share) * area2_) return {state, {}, first_taker_};
    // Once more along the lines only where that begins.
    const auto borders = borders_of_states();
    divide(borders);
    return {State::open, parts(), first_taker_};
  }

 private:
  void find_lines() {
    covers_.visit_near(t_, [&](std::size_t u) {
      if (covers_.is_taken(t_, u)) {
        if (add_overlap(u, taken_)) first_taker_ = std::min(first_taker_.value_or(u), u);
      } else if (covers_.are_of_one_body(t_, u)) {
        return;
      } else if (covers_.is_against(t_, u)) {
        add_overlap(u, against_);
      } else if (covers_.may_end_at(t_, u)) {
        if (const auto line = cut_by(u)) lines_.push_back(*line);
      }
    });
    if (lines_.size() > most_lines) lines_.clear();
    sort_lines(lines_);
  }

  /// Where `u`, which goes to `list`, begins on this one; false where they have next to nothing in
  /// common.
  bool add_overlap(std::size_t u, std::vector<Polygon>& list) {
    Polygon other;
    for (const Vec3 p : covers_.corners(u)) other.push_back(plane_.seen(p));
    if (twice_area(other) < 0) std::reverse(other.begin(), other.end());
    Polygon overlap = other;
    for (std::size_t k = 0; k < 3; ++k)
      overlap =
          clipped(overlap, [&](Point2 p) { return turn(outline_[k], outline_[(k + 1) % 3], p); });
    if (twice_area(overlap) <= least_share * area2_) return false;
    for (std::size_t i = 0; i < overlap.size(); ++i)
      lines_.push_back({overlap[i], overlap[(i + 1) % overlap.size()]});
    list.push_back(std::move(other));
    return true;
  }

  /// Where the triangle `u` goes through this one.
  std::optional<Line2> cut_by(std::size_t u) const {
    const auto corners = covers_.corners(u);
    std::vector<Point2> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = corners[k], b = corners[(k + 1) % 3];
      const double of_a = plane_.offset(a), of_b = plane_.offset(b);
      if ((of_a < 0) == (of_b < 0)) continue;
      ends.push_back(plane_.seen(a + (of_a / (of_a - of_b)) * (b - a)));
    }
    if (ends.size() != 2) return {};
    double from = 0, to = 1;
    const Point2 a = ends[0], b = ends[1];
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

  State state_at(Point2 p) const {
    if (is_in_any(taken_, p)) return State::taken;
    const bool is_covered = is_in_any(against_, p) || covers_.is_buried(t_, plane_.lifted(p));
    return is_covered ? State::covered : State::open;
  }

  /// Doubled.
  struct Areas2 {
    double covered = 0, taken = 0;
  };
  Areas2 divide(const std::vector<Line2>& lines) {
    delaunay_.clear();
    nodes_.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      nodes_.push_back({outline_[k], delaunay_.insert({outline_[k].u, outline_[k].v})});
      nodes_[k].handle->info().vertex = mesh_.triangles[t_][is_reversed_ ? 2 - k : k];
    }
    std::vector<std::array<std::size_t, 2>> ends;
    for (std::size_t k = 0; k < 3; ++k) ends.push_back({k, (k + 1) % 3});
    for (const Line2& line : lines) {
      const std::size_t a = node_at(line[0]), b = node_at(line[1]);
      if (a != b) ends.push_back({a, b});
    }
    for (const auto& [a, b] : ends) {
      constrain(a, b);
      if (delaunay_.number_of_vertices() > most_crossings) break;
    }
    Areas2 sum;
    for (const auto face : delaunay_.finite_face_handles()) {
      const Polygon p = corners_of(face);
      const Point2 inside = middle(p[0], p[1], p[2]);
      const State state = is_in_outline(inside) ? state_at(inside) : State::open;
      face->info().state = state;
      if (state == State::covered) sum.covered += twice_area(p);
      if (state == State::taken) sum.taken += twice_area(p);
    }
    return sum;
  }

  // Ends as near to each other, and to lines, as rounding are one, and on them: where a line ends
  // just beyond another, CGAL bends it to whatever is near.
  double rounding() const { return covers_.contact() / rounds_per_contact; }

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

  Polygon corners_of(Delaunay::Face_handle face) const {
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
      const auto& a = face->vertex(Delaunay::cw(k))->point();
      const auto& b = face->vertex(Delaunay::ccw(k))->point();
      Line2 border{Point2{a.x(), a.y()}, Point2{b.x(), b.y()}};
      if (is_before(border[1], border[0])) std::swap(border[0], border[1]);
      borders.push_back(border);
    }
    // CGAL tells an edge from the one of its two faces that has the lower address.
    sort_lines(borders);
    return borders;
  }

  std::vector<Part> parts() const {
    std::vector<Part> result;
    for (const auto face : delaunay_.finite_face_handles()) {
      const Polygon p = corners_of(face);
      if (!is_in_outline(middle(p[0], p[1], p[2]))) continue;
      Part part{{}, {-1, -1, -1}, face->info().state};
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
              [](const Part& a, const Part& b) { return a.corners < b.corners; });
    return result;
  }

  const Mesh& mesh_;
  const Covers& covers_;
  std::size_t t_;
  Plane plane_;
  Polygon outline_;  // counter-clockwise on paper
  bool is_reversed_ = false;
  double area2_ = 0;
  std::vector<Line2> lines_;
  std::vector<Polygon> against_, taken_;  // triangles
  std::optional<std::size_t> first_taker_;
  struct Node {
    Point2 at;
    Delaunay::Vertex_handle handle;
  };
  Delaunay delaunay_;  // of the last division
  std::vector<Node> nodes_;
};

/// Corners of parts, one vertex where they are one.
class NewVertices {
 public:
  NewVertices(std::vector<Vec3>& vertices, double grid_m) : vertices_(vertices), grid_m_(grid_m) {}
  std::int32_t of(const std::array<double, 3>& at) {
    std::array<std::int64_t, 3> key{};
    for (std::size_t k = 0; k < 3; ++k) key[k] = std::llround(at[k] / grid_m_);
    const auto [entry, is_new] =
        known_.try_emplace(key, static_cast<std::int32_t>(vertices_.size()));
    if (is_new) vertices_.push_back({at[0], at[1], at[2]});
    return entry->second;
  }

 private:
  std::vector<Vec3>& vertices_;
  double grid_m_;
  std::map<std::array<std::int64_t, 3>, std::int32_t> known_;
};

/// Triangles and their parts, in the old order.
class Divided {
 public:
  Divided(Mesh& mesh, Bodies& bodies, double grid_m)
      : mesh_(mesh),
        bodies_(bodies),
        vertices_(mesh.vertices, grid_m),
        is_facade_less_(mesh.facades.size(), 0) {}

  void keep(std::size_t t, State state) { add(t, mesh_.triangles[t], state); }
  void divide(std::size_t t, const std::vector<Part>& parts) {
    for (const Part& part : parts) {
      std::array<std::int32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = part.old[k] >= 0 ? part.old[k] : vertices_.of(part.corners[k]);
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
        add(t, corners, part.state);
    }
    ++cut_;
  }
  void note_taker(std::size_t t, std::size_t by) {
    if (taken_.area_m2 == 0) taken_.first = {by, t};
  }

  CoveredCut finish() {
    const auto taken = [&](auto& list) {
      auto old = std::move(list);
      list.clear();
      list.reserve(source_.size());
      for (const auto t : source_) list.push_back(old[t]);
    };
    const auto covered =
        static_cast<std::size_t>(std::count(is_covered_.begin(), is_covered_.end(), 1));
    mesh_.triangles = std::move(triangles_);
    taken(mesh_.triangle_object);
    taken(mesh_.triangle_material);
    taken(mesh_.triangle_facade);
    taken(mesh_.triangle_surface);
    taken(mesh_.triangle_sides);
    taken(bodies_.triangle_body);
    mesh_.triangle_covered = covered > 0 ? std::move(is_covered_) : std::vector<std::uint8_t>{};
    take_from_facades();
    return {std::move(source_), cut_, covered, taken_};
  }

 private:
  void add(std::size_t t, const std::array<std::int32_t, 3>& corners, State state) {
    const FacadeId facade = mesh_.triangle_facade[t];
    if (state != State::open && facade.exists()) is_facade_less_[facade.index()] = 1;
    if (state == State::taken) {
      const auto at = [&](std::size_t k) {
        return mesh_.vertices[static_cast<std::size_t>(corners[k])];
      };
      taken_.area_m2 += norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
      return;
    }
    triangles_.push_back(corners);
    source_.push_back(t);
    is_covered_.push_back(state == State::covered);
  }

  void take_from_facades() {
    std::vector<double> left(mesh_.facades.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
      if (mesh_.triangle_facade[t].exists() && !mesh_.is_covered(t))
        left[mesh_.triangle_facade[t].index()] += norm(mesh_.area_vector2(t)) / 2;
    std::vector<FacadeId> new_id(mesh_.facades.size(), FacadeId::none());
    std::size_t kept = 0;
    for (std::size_t f = 0; f < mesh_.facades.size(); ++f) {
      if (left[f] == 0) continue;
      if (is_facade_less_[f]) mesh_.facades[f].area_m2 = left[f];
      new_id[f] = make_id<FacadeId>(kept);
      if (kept != f) mesh_.facades[kept] = std::move(mesh_.facades[f]);
      ++kept;
    }
    mesh_.facades.resize(kept);
    for (FacadeId& id : mesh_.triangle_facade)
      if (id.exists()) id = new_id[id.index()];
  }

  Mesh& mesh_;
  Bodies& bodies_;
  NewVertices vertices_;
  std::vector<std::uint8_t> is_facade_less_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<std::size_t> source_;
  std::vector<std::uint8_t> is_covered_;
  std::size_t cut_ = 0;
  Doubled taken_;
};

/// Of a triangle that CGAL cannot divide nothing is covered.
Cutter::Result covered_parts(const Mesh& mesh, const Covers& covers, std::size_t t) {
  try {
    return Cutter(mesh, covers, t).run();
  } catch (const CGAL::Failure_exception&) {
    return {};
  }
}

}  // namespace

CoveredCut cut_covered(Mesh& mesh, Bodies& bodies, const std::vector<std::uint8_t>& is_opaque,
                       const std::vector<std::uint8_t>& seals,
                       const std::vector<std::uint8_t>& emits) {
  const Covers covers(mesh, bodies, is_opaque, seals, emits);
  std::vector<std::pair<std::size_t, Cutter::Result>> found;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.bears_patches(t) || !slope_of(mesh, t)) continue;
    auto result = covered_parts(mesh, covers, t);
    if (result.state != State::open || !result.parts.empty())
      found.emplace_back(t, std::move(result));
  }
  CoveredCut nothing;
  nothing.source.resize(mesh.triangle_count());
  std::iota(nothing.source.begin(), nothing.source.end(), std::size_t{0});
  if (found.empty()) return nothing;
  Divided divided(mesh, bodies, covers.contact() / rounds_per_contact);
  auto next = found.begin();
  for (std::size_t t = 0; t < nothing.source.size(); ++t) {
    if (next == found.end() || next->first != t) {
      divided.keep(t, mesh.is_covered(t) ? State::covered : State::open);
      continue;
    }
    if (next->second.taken_by) divided.note_taker(t, *next->second.taken_by);
    if (next->second.parts.empty())
      divided.keep(t, next->second.state);
    else
      divided.divide(t, next->second.parts);
    ++next;
  }
  return divided.finish();
}

}  // namespace sunload
