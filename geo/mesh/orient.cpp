// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/orient.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geo/base/units.h"
#include "geo/mesh/apart_faces.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/facing_links.h"

namespace sunload {

namespace {

constexpr double inside = 0.5;               // winding numbers are whole but for rounding
constexpr double clear_majority = 1 + 1e-9;  // equal areas must not be decided by rounding

/// Triangles of all bodies, body by body.
struct Members {
  std::vector<std::size_t> begin, triangles;
  std::span<const std::size_t> of(std::size_t body) const {
    return std::span(triangles).subspan(begin[body], begin[body + 1] - begin[body]);
  }
};

Members members_of(const std::vector<std::int32_t>& triangle_body, std::size_t body_count) {
  Members m;
  m.begin.assign(body_count + 1, 0);
  for (const auto body : triangle_body) {
    if (body >= 0) ++m.begin[static_cast<std::size_t>(body) + 1];
  }
  std::partial_sum(m.begin.begin(), m.begin.end(), m.begin.begin());
  m.triangles.resize(m.begin.back());
  auto at = m.begin;
  for (std::size_t t = 0; t < triangle_body.size(); ++t) {
    if (triangle_body[t] >= 0) m.triangles[at[static_cast<std::size_t>(triangle_body[t])]++] = t;
  }
  return m;
}

/// Solid angle of a closed consistent surface seen from `p`, over 4 pi: not 0 inside.
/// Van Oosterom, Strackee (1983), The solid angle of a plane triangle, eq. 8.
double winding_number(const Mesh& mesh, std::span<const std::size_t> triangles,
                      const std::vector<std::uint8_t>& flip, Vec3 p) {
  double half_angle = 0;
  for (const auto t : triangles) {
    const Vec3 a = mesh.corner(t, 0) - p, b = mesh.corner(t, 1) - p, c = mesh.corner(t, 2) - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    const double angle = std::atan2(
        dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    half_angle += flip[t] ? -angle : angle;
  }
  return half_angle / (2 * pi);
}

bool holds(const Box& outer, const Box& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
         inner.high.x <= outer.high.x && inner.high.y <= outer.high.y &&
         inner.high.z <= outer.high.z;
}

/// Decides the windings of one grouping.
class Orienter {
 public:
  Orienter(const Mesh& mesh, Grouping grouping, Winding winding)
      : mesh_(mesh),
        g_(std::move(grouping)),
        winding_(winding),
        members_(members_of(g_.body, g_.is_linked.size())),
        turned_(g_.is_linked.size(), 0),
        bodies_(g_.is_linked.size()) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) measure(b);
  }

  bool is_closed_at(std::size_t triangle) const {
    const auto body = g_.body[triangle];
    return body >= 0 && bodies_[static_cast<std::size_t>(body)].is_closed;
  }

  /// `mesh` is the one that was measured.
  Bodies finish(Mesh& mesh) {
    Bodies result;
    turn_outward(result);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (!g_.flip[t]) continue;
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      ++result.triangles_flipped;
    }
    for (const auto conflict : g_.has_conflict) result.unorientable += conflict;
    result.bodies = std::move(bodies_);
    result.triangle_body = std::move(g_.body);
    return result;
  }

 private:
  /// Extent, area, closedness, winding of the majority, volume with that winding.
  void measure(std::size_t b) {
    Body& body = bodies_[b];
    const auto triangles = members_.of(b);
    body.object = mesh_.triangle_object[triangles[0]];
    const Vec3 start = mesh_.corner(triangles[0], 0);
    double flipped_area = 0, volume6 = 0;
    bool is_consistent_as_read = true;
    for (const auto t : triangles) {
      for (int k = 0; k < 3; ++k) include(body.box, mesh_.corner(t, k));
      const Vec3 area_vector2 = mesh_.area_vector2(t);
      const double area = norm(area_vector2) / 2;
      const double part = dot(mesh_.corner(t, 0) - start, area_vector2);
      body.area += area;
      volume6 += g_.flip[t] ? -part : part;
      if (g_.flip[t]) {
        flipped_area += area;
        is_consistent_as_read = false;
      }
    }
    const bool may_change = winding_ == Winding::turn && !g_.has_conflict[b];
    body.is_closed = g_.is_linked[b] && (may_change || is_consistent_as_read) &&
                     !g_.has_conflict[b] && encloses(std::abs(volume6) / 6, body.area);
    const bool is_minority =
        may_change && flipped_area > (body.area - flipped_area) * clear_majority;
    if (body.is_closed) body.volume = (is_minority ? -volume6 : volume6) / 6;
    for (const auto t : triangles) {
      g_.flip[t] = may_change && (g_.flip[t] != 0) != is_minority;
    }
  }

  /// Bodies in an order in which any body that holds another one comes before it.
  std::vector<std::size_t> closed_from_outside() const {
    std::vector<std::size_t> order;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].is_closed) order.push_back(b);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const Body &p = bodies_[a], &q = bodies_[b];
      if (p.object != q.object) return p.object < q.object;
      if (p.box.low.x != q.box.low.x) return p.box.low.x < q.box.low.x;
      const double p_volume = std::abs(p.volume), q_volume = std::abs(q.volume);
      if (p_volume != q_volume) return p_volume > q_volume;
      return a < b;
    });
    return order;
  }

  /// A sweep along x: `open` holds the bodies whose box reaches the present one.
  void turn_outward(Bodies& result) {
    std::vector<std::size_t> open;
    for (const auto b : closed_from_outside()) {
      std::erase_if(open, [&](std::size_t c) {
        return bodies_[c].object != bodies_[b].object ||
               bodies_[c].box.high.x < bodies_[b].box.low.x;
      });
      decide(b, open, result);
      open.push_back(b);
    }
  }

  void decide(std::size_t b, const std::vector<std::size_t>& open, Bodies& result) {
    std::vector<std::size_t> around;
    bool is_any_turned = false;
    for (const auto c : open) {
      if (std::abs(bodies_[c].volume) <= std::abs(bodies_[b].volume)) continue;
      if (!holds(bodies_[c].box, bodies_[b].box)) continue;
      around.push_back(c);
      is_any_turned = is_any_turned || turned_[c];
    }
    // Most files turn everything outward: then nothing needs to be asked.
    if (bodies_[b].volume > 0 && !is_any_turned) return;
    const auto outer = innermost_around(b, around);
    if (outer < 0 && bodies_[b].volume > 0) return;
    // A cavity follows the body around it.
    if (outer >= 0 && !turned_[static_cast<std::size_t>(outer)]) return;
    if (winding_ == Winding::keep) {
      ++result.inside_out;
      bodies_[b].is_inside_out = true;
      return;
    }
    for (const auto t : members_.of(b)) g_.flip[t] ^= 1;
    bodies_[b].volume = -bodies_[b].volume;
    turned_[b] = 1;
  }

  Vec3 middle(std::size_t t) const {
    return (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3;
  }

  /// Middles of the first triangle and of those farthest out along each axis: a dormer in a roof
  /// has some of them inside of its house, and some outside.
  std::vector<Vec3> outmost(std::size_t b) const {
    const auto triangles = members_.of(b);
    std::vector<Vec3> points(7, middle(triangles[0]));
    for (const auto t : triangles) {
      const Vec3 p = middle(t);
      if (p.x < points[1].x) points[1] = p;
      if (p.x > points[2].x) points[2] = p;
      if (p.y < points[3].y) points[3] = p;
      if (p.y > points[4].y) points[4] = p;
      if (p.z < points[5].z) points[5] = p;
      if (p.z > points[6].z) points[6] = p;
    }
    return points;
  }

  /// The smallest of the bodies around that really holds the body, or -1.
  std::int64_t innermost_around(std::size_t b, const std::vector<std::size_t>& around) const {
    std::int64_t result = -1;
    const std::vector<Vec3> points = outmost(b);
    for (const auto c : around) {
      if (result >= 0 && std::abs(bodies_[c].volume) >=
                             std::abs(bodies_[static_cast<std::size_t>(result)].volume)) {
        continue;
      }
      if (std::ranges::all_of(points, [&](Vec3 p) {
            return std::abs(winding_number(mesh_, members_.of(c), g_.flip, p)) > inside;
          })) {
        result = static_cast<std::int64_t>(c);
      }
    }
    return result;
  }

  const Mesh& mesh_;
  Grouping g_;
  Winding winding_;
  Members members_;
  std::vector<std::uint8_t> turned_;  // outward, against the file
  std::vector<Body> bodies_;
};

/// The same with some bodies more, of other triangles.
void append(const Bodies& more, Bodies& bodies) {
  const auto first = static_cast<std::int32_t>(bodies.bodies.size());
  for (std::size_t t = 0; t < more.triangle_body.size(); ++t)
    if (more.triangle_body[t] >= 0) bodies.triangle_body[t] = first + more.triangle_body[t];
  bodies.bodies.insert(bodies.bodies.end(), more.bodies.begin(), more.bodies.end());
}

/// Of the triangles of a mesh with a flag, as the file has them.
Bodies bodies_of(Mesh& mesh, const std::vector<std::uint8_t>& flags) {
  return Orienter(mesh, group(mesh, link_edges(mesh, flags), flags), Winding::keep).finish(mesh);
}

/// Turns loose bodies to look where the closed ones look that they go on from, such as eaves from
/// the roof. Returns the triangles turned.
std::size_t turn_loose(Mesh& mesh, const Bodies& all, const std::vector<std::uint8_t>& loose) {
  constexpr double least_cosine = 0.9;  // of what goes on
  std::vector<double> agree_m(all.bodies.size(), 0);
  const std::vector<std::uint8_t> included(mesh.triangle_count(), 1);
  for_each_edge(edge_uses(mesh, included), [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) {
      const std::size_t t = use.triangle();
      if (!loose[t]) continue;
      double cosine = 0;
      for (const EdgeUse& other : uses)
        if (const double c = dot(mesh.normal(t), mesh.normal(other.triangle()));
            all.is_closed(other.triangle()) && std::abs(c) > std::abs(cosine))
          cosine = c;
      if (std::abs(cosine) < least_cosine) continue;
      const double length = norm(mesh.vertices[static_cast<std::size_t>(use.high)] -
                                 mesh.vertices[static_cast<std::size_t>(use.low)]);
      agree_m[static_cast<std::size_t>(all.triangle_body[t])] += cosine > 0 ? length : -length;
    }
  });
  std::size_t turned = 0;
  for (std::size_t t = 0; t < loose.size(); ++t) {
    if (!loose[t] || !(agree_m[static_cast<std::size_t>(all.triangle_body[t])] < 0)) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    ++turned;
  }
  return turned;
}

}  // namespace

Bodies orient(Mesh& mesh, const std::vector<std::uint8_t>& faced_both_ways, Winding winding) {
  std::vector<std::uint8_t> included(mesh.triangle_count(), 1);
  Links links = link_edges(mesh, included);
  ApartFaces apart{std::vector<std::uint8_t>(included.size(), 0),
                   std::vector<std::uint8_t>(included.size(), 0)};
  if (winding == Winding::turn && links.nonmanifold_edges > 0) apart = apart_faces(mesh);
  const bool has_inner = std::ranges::count(apart.inner, 1) > 0;
  const bool has_loose = std::ranges::count(apart.loose, 1) > 0;
  if (has_inner || has_loose) {
    for (std::size_t t = 0; t < included.size(); ++t) {
      included[t] = apart.inner[t] == 0 && apart.loose[t] == 0;
      if (faced_both_ways[t]) apart.loose[t] = 0;  // of no body
    }
    links = link_edges(mesh, included);
  }
  Orienter orienter(mesh, group(mesh, links, included), winding);
  bool is_any_left_out = false;
  for (std::size_t t = 0; t < included.size(); ++t) {
    if (!included[t] || !faced_both_ways[t] || orienter.is_closed_at(t)) continue;
    included[t] = 0;
    is_any_left_out = true;
  }
  Bodies result;
  if (is_any_left_out) {
    links = link_edges(mesh, included);
    result = Orienter(mesh, group(mesh, links, included), winding).finish(mesh);
  } else {
    result = orienter.finish(mesh);
  }
  result.open_edges = links.open_edges;
  result.nonmanifold_edges = links.nonmanifold_edges;
  if (has_inner) {
    Bodies inner = bodies_of(mesh, apart.inner);
    for (Body& body : inner.bodies) body.is_inner = true;
    append(inner, result);
  }
  if (has_loose) {
    append(bodies_of(mesh, apart.loose), result);
    result.triangles_flipped += turn_loose(mesh, result, apart.loose);
  }
  return result;
}

}  // namespace sunload
