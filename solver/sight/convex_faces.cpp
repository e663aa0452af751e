// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/convex_faces.h"

#include <algorithm>
#include <cmath>

#include "geo/base/together.h"

namespace sunload {

namespace {

using Loop = std::vector<std::uint32_t>;  ///< numbers of points, counter-clockwise

struct Plane {
  Vec3 point, normal;
  double above(Vec3 p) const { return dot(p - point, normal); }
};

/// The other triangle at an edge that just two opaque ones share; -1: there is none.
std::int32_t across(const Occluders& occluders, std::size_t triangle, std::size_t k) {
  const auto there = occluders.at_edge(triangle, k);
  if (there.size() != 2) return -1;
  const auto other = there[0] == static_cast<std::int32_t>(triangle) ? there[1] : there[0];
  return occluders.is_opaque(static_cast<std::size_t>(other)) ? other : -1;
}

class Joining {
 public:
  Joining(const Occluders& occluders, double flat_m, std::size_t most_corners)
      : o_(occluders),
        flat_(flat_m),
        most_corners_(most_corners),
        groups_(occluders.triangle_count()) {
    const std::size_t count = o_.triangle_count();
    loops_.resize(count);
    planes_.resize(count);
    for (std::size_t t = 0; t < count; ++t) {
      const Vec3 area2 =
          cross(o_.corner(t, 1) - o_.corner(t, 0), o_.corner(t, 2) - o_.corner(t, 0));
      if (!o_.is_opaque(t) || norm(area2) <= 0) continue;
      loops_[t] = {o_.point(t, 0), o_.point(t, 1), o_.point(t, 2)};
      planes_[t] = {o_.corner(t, 0), normalized(area2)};
    }
  }

  std::vector<ConvexFace> run() {
    const auto edges = longest_first();
    for (bool joined = true; joined;) {
      joined = false;
      for (const Edge& edge : edges) joined = join(edge) || joined;
    }
    std::vector<ConvexFace> faces;
    std::vector<std::size_t> face_of(loops_.size());
    for (std::size_t t = 0; t < loops_.size(); ++t) {
      if (groups_.of(t) != t || loops_[t].empty()) continue;
      face_of[t] = faces.size();
      faces.push_back({corners_of(loops_[t]), planes_[t].normal, {}});
    }
    for (std::size_t t = 0; t < loops_.size(); ++t)
      if (const std::size_t root = groups_.of(t); !loops_[root].empty())
        faces[face_of[root]].triangles.push_back(static_cast<std::uint32_t>(t));
    return faces;
  }

 private:
  struct Edge {
    std::size_t a, b;        ///< triangles
    std::uint32_t from, to;  ///< as a has it
    double length;
  };
  std::vector<Edge> longest_first() const {
    std::vector<Edge> edges;
    for (std::size_t t = 0; t < loops_.size(); ++t)
      for (std::size_t k = 0; !loops_[t].empty() && k < 3; ++k) {
        const auto other = across(o_, t, k);
        if (other <= static_cast<std::int32_t>(t)) continue;
        if (loops_[static_cast<std::size_t>(other)].empty()) continue;
        const double length = norm(o_.corner(t, (k + 1) % 3) - o_.corner(t, k));
        edges.push_back(
            {t, static_cast<std::size_t>(other), o_.point(t, k), o_.point(t, (k + 1) % 3), length});
      }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Edge& x, const Edge& y) { return x.length > y.length; });
    return edges;
  }

  bool join(const Edge& edge) {
    const std::size_t a = groups_.of(edge.a), b = groups_.of(edge.b);
    if (a == b || dot(planes_[a].normal, planes_[b].normal) <= 0) return false;
    for (const auto p : loops_[b])
      if (std::abs(planes_[a].above(o_.at(p))) > flat_) return false;
    Loop both = spliced(loops_[a], loops_[b], edge);
    if (both.size() < 3 || !is_convex(both, planes_[a].normal)) return false;
    if (both.size() > most_corners_ && corners_of(both).size() > most_corners_) return false;
    loops_[a] = std::move(both);
    loops_[b].clear();
    groups_.join(a, b);
    return true;
  }

  /// a from the edge's end round to its beginning, then what b adds. Empty where the edge is in one
  /// of them no more, or has the same direction in both.
  static Loop spliced(const Loop& a, const Loop& b, const Edge& edge) {
    const auto begin_of = [](const Loop& loop, std::uint32_t from, std::uint32_t to) {
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (loop[i] == from && loop[(i + 1) % loop.size()] == to) return i;
      return loop.size();
    };
    const std::size_t in_a = begin_of(a, edge.from, edge.to),
                      in_b = begin_of(b, edge.to, edge.from);
    if (in_a == a.size() || in_b == b.size()) return {};
    Loop both;
    for (std::size_t i = 1; i <= a.size(); ++i) both.push_back(a[(in_a + i) % a.size()]);
    for (std::size_t i = 2; i < b.size(); ++i) both.push_back(b[(in_b + i) % b.size()]);
    take_out_spikes(both);
    Loop sorted = both;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() ? both : Loop{};
  }
  /// Where they share a second edge next to the first, the loop goes there and back.
  static void take_out_spikes(Loop& loop) {
    for (std::size_t i = 0; loop.size() > 3 && i < loop.size();) {
      const std::size_t n = loop.size();
      if (loop[(i + n - 1) % n] != loop[(i + 1) % n]) {
        ++i;
        continue;
      }
      const std::size_t next = (i + 1) % n;
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
      i = 0;
    }
  }
  /// But for corners that lie inward of their neighbours by what flatness allows.
  bool is_convex(const Loop& loop, Vec3 normal) const {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 p = o_.at(loop[i]), q = o_.at(loop[(i + 1) % n]), r = o_.at(loop[(i + 2) % n]);
      const double turn = dot(cross(q - p, r - q), normal);
      if (turn < -flat_ * norm(r - p)) return false;
      if (turn < 0 && dot(q - p, r - q) < 0) return false;  // a spike, not a corner
    }
    return true;
  }

  /// Without points on a line between their neighbours.
  std::vector<Vec3> corners_of(const Loop& loop) const {
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 p = corners.empty() ? o_.at(loop.back()) : corners.back(), q = o_.at(loop[i]),
                 r = o_.at(loop[(i + 1) % loop.size()]);
      const bool is_between =
          norm(cross(q - p, r - p)) <= flat_ * norm(r - p) && dot(q - p, r - q) > 0;
      if (!is_between) corners.push_back(q);
    }
    return corners;
  }

  const Occluders& o_;
  double flat_;
  std::size_t most_corners_;
  std::vector<Loop> loops_;    ///< of groups; empty: joined to another, or no occluder
  std::vector<Plane> planes_;  ///< of groups
  Together groups_;
};

}  // namespace

std::vector<ConvexFace> convex_faces(const Occluders& occluders, double flat_m,
                                     std::size_t most_corners) {
  return Joining(occluders, flat_m, most_corners).run();
}

}  // namespace sunload
