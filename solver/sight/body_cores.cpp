// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/body_cores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/clip.h"
#include "solver/base/spherical_triangle.h"
#include "solver/base/threads.h"
#include "solver/sight/convex_solid.h"

namespace sunload {

namespace {

/// Of bodies with more faces (a whole city as one) the search would take longer than what it saves.
constexpr std::size_t most_faces = 10'000;
/// Points about which cores of a body may grow.
constexpr std::size_t most_seeds = 32;
/// A core has so many sides at most: 2 n - 4 corners.
constexpr std::size_t most_sides = 10;
/// A core reaches further than this about its seed, in extents of the body.
constexpr double least_depth = 0.01;
/// Nothing more is looked for where cores hold so much of the body; and such as hold less than
/// that, of an even share for each seed, are not worth asking.
constexpr double enough_volume = 0.95, least_of_share = 0.25;
/// Sine of the elevation of faces whose middle a seed may lie below.
constexpr double least_level = 0.1;

struct Body {
  std::vector<std::size_t> triangles;
  std::vector<const ConvexFace*> faces;  ///< the largest first
  int outward = 1;                       ///< -1: normals look inward
};

double area_of(const ConvexFace& face) { return norm(area_vector2(face.corners)) / 2; }

Vec3 middle_of(const ConvexFace& face) {
  Vec3 sum{0, 0, 0};
  for (const Vec3& corner : face.corners) sum += corner / static_cast<double>(face.corners.size());
  return sum;
}

std::vector<Body> bodies_of(const ClosedBodies& closed, const std::vector<ConvexFace>& faces) {
  std::vector<Body> bodies;
  std::vector<std::uint32_t> number(closed.body.size());  // of a body, by the triangle for it
  for (std::size_t t = 0; t < closed.body.size(); ++t) {
    if (closed.turned[t] == Closed::no || closed.body[t] != t) continue;
    number[t] = static_cast<std::uint32_t>(bodies.size());
    bodies.push_back({{}, {}, static_cast<int>(closed.turned[t])});
  }
  for (std::size_t t = 0; t < closed.body.size(); ++t)
    if (closed.turned[t] != Closed::no) bodies[number[closed.body[t]]].triangles.push_back(t);
  for (const ConvexFace& face : faces)
    if (const auto t = face.triangles.front(); closed.turned[t] != Closed::no)
      bodies[number[closed.body[t]]].faces.push_back(&face);
  std::erase_if(bodies, [](const Body& body) { return body.faces.size() > most_faces; });
  for (Body& body : bodies)
    std::stable_sort(
        body.faces.begin(), body.faces.end(),
        [](const ConvexFace* a, const ConvexFace* b) { return area_of(*a) > area_of(*b); });
  return bodies;
}

/// The cores of one body.
class Growing {
 public:
  Growing(const Occluders& occluders, const Body& body, double away_m)
      : occluders_(occluders), body_(body), away_(away_m) {
    Box box;
    for (const ConvexFace* face : body_.faces)
      for (const Vec3& corner : face->corners) include(box, corner);
    extent_ = norm(box.high - box.low);
    least_depth_ = std::max(least_depth * extent_, 4 * away_);
  }

  std::vector<BodyCore> run(std::size_t most) {
    const auto seeds = seed_faces(std::min(most, most_seeds));
    if (seeds.empty()) return {};
    const double volume = volume_of_body();
    const double least = least_of_share * volume / static_cast<double>(seeds.size());
    double held = 0;
    for (const ConvexFace* face : seeds) {
      if (held > enough_volume * volume) break;
      const auto seed = point_below(*face);
      if (!seed || is_in_core(*seed) || !is_inside(*seed)) continue;
      auto core = grown_about(*seed);
      if (!core || core->volume() < least) continue;
      held += core->volume();
      cores_.push_back(std::move(*core));
    }
    std::vector<BodyCore> cores;
    for (const ConvexSolid& core : cores_) {
      auto [corners, edges] = core.frame(away_);
      if (corners.size() > 3 && corners.size() <= BodyCore::most_corners)
        cores.push_back({std::move(corners), std::move(edges)});
    }
    return cores;
  }

 private:
  double volume_of_body() const {
    double six_times = 0;
    const Vec3 from = occluders_.corner(body_.triangles.front(), 0);
    for (const auto t : body_.triangles)
      six_times += dot(occluders_.corner(t, 0) - from,
                       cross(occluders_.corner(t, 1) - from, occluders_.corner(t, 2) - from));
    return std::abs(six_times) / 6;
  }

  std::vector<const ConvexFace*> seed_faces(std::size_t most) const {
    std::vector<const ConvexFace*> seeds;
    for (const ConvexFace* face : body_.faces)
      if (seeds.size() < most && std::abs(face->normal.z) > least_level) seeds.push_back(face);
    return seeds;
  }

  /// Half of the way from a face's middle straight to the next face on its inner side.
  std::optional<Vec3> point_below(const ConvexFace& face) const {
    const Vec3 from = middle_of(face);
    const double upward = face.normal.z * body_.outward > 0 ? -1 : 1;
    double nearest = std::numeric_limits<double>::infinity();
    for (const ConvexFace* other : body_.faces) {
      if (other == &face || std::abs(other->normal.z) < 1e-9) continue;
      const double rise = dot(other->corners[0] - from, other->normal) / other->normal.z * upward;
      if (rise > away_ && rise < nearest && is_over(*other, from)) nearest = rise;
    }
    if (!std::isfinite(nearest)) return {};
    return from + Vec3{0, 0, upward * nearest / 2};
  }
  /// In plan.
  static bool is_over(const ConvexFace& face, Vec3 p) {
    const double turn = face.normal.z > 0 ? 1 : -1;
    const std::size_t n = face.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 a = face.corners[k], b = face.corners[(k + 1) % n];
      if (turn * ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) < 0) return false;
    }
    return true;
  }

  bool is_in_core(Vec3 p) const {
    return std::any_of(cores_.begin(), cores_.end(),
                       [&](const ConvexSolid& core) { return core.has_within(p, 0); });
  }

  /// Whether the body's surface winds about it.
  bool is_inside(Vec3 p) const {
    double angle = 0;
    for (const auto t : body_.triangles) {
      const Vec3 a = occluders_.corner(t, 0) - p, b = occluders_.corner(t, 1) - p,
                 c = occluders_.corner(t, 2) - p;
      angle += std::copysign(SphericalTriangle(a, b, c).solid_angle(), dot(a, cross(b, c)));
    }
    return std::abs(angle) > 2 * pi;  // 4 pi, or none
  }

  /// About all of the body, along its largest wall.
  ConvexSolid box_about() const {
    Vec3 across{1, 0, 0};
    for (const ConvexFace* face : body_.faces)
      if (const Vec3 level{face->normal.x, face->normal.y, 0}; norm(level) > 0.7) {
        across = normalized(level);
        break;
      }
    const std::array<Vec3, 3> axes{across, cross({0, 0, 1}, across), {0, 0, 1}};
    Vec3 low{1e300, 1e300, 1e300}, high = low * -1;
    for (const ConvexFace* face : body_.faces)
      for (const Vec3& corner : face->corners) {
        const Vec3 at{dot(corner, axes[0]), dot(corner, axes[1]), dot(corner, axes[2])};
        low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
      }
    const Vec3 middle = (low + high) * 0.5;
    return ConvexSolid(axes[0] * middle.x + axes[1] * middle.y + axes[2] * middle.z, axes,
                       (high - low) * 0.5);
  }

  /// Nothing where faces leave no room about the seed.
  std::optional<ConvexSolid> grown_about(Vec3 seed) const {
    ConvexSolid core = box_about();
    for (const ConvexFace* face : body_.faces) {
      const auto part = core.part_within(face->corners, away_);
      if (part.size() < 3) continue;
      auto rest = largest_without(core, seed, *face, part);
      if (!rest) return {};
      core = std::move(*rest);
    }
    for (std::size_t i = 0, n = core.sides().size(); i < n; ++i) {
      // Each cut puts a side, nearer by so much, in place of the first.
      const HalfSpace side = core.sides().front().beyond;
      core.cut({side.normal, side.offset - 2 * away_});
    }
    if (core.sides().empty() || !core.has_within(seed, 0)) return {};
    return core;
  }

  /// What of a core is left beyond a plane that has a face's part in it outside: the face's own, or
  /// one along a side.
  std::optional<ConvexSolid> largest_without(const ConvexSolid& core, Vec3 seed,
                                             const ConvexFace& face,
                                             const std::vector<Vec3>& part) const {
    std::optional<ConvexSolid> largest;
    double volume = 0;
    const auto try_plane = [&](Vec3 normal) {
      HalfSpace away{normal, std::numeric_limits<double>::infinity()};
      for (const Vec3& corner : part) away.offset = std::min(away.offset, dot(normal, corner));
      if (away.above(seed) > -least_depth_) return;
      ConvexSolid rest = core;
      rest.cut(away);
      if (rest.sides().size() > most_sides) return;
      if (const double of_rest = rest.volume(); of_rest > volume) {
        volume = of_rest;
        largest = std::move(rest);
      }
    };
    try_plane(face.normal * static_cast<double>(body_.outward));
    for (const auto& side : core.sides()) try_plane(side.beyond.normal);
    return largest;
  }

  const Occluders& occluders_;
  const Body& body_;
  double away_;
  double extent_ = 0, least_depth_ = 0;
  std::vector<ConvexSolid> cores_;
};

}  // namespace

std::vector<BodyCore> body_cores(const Occluders& occluders, const ClosedBodies& bodies,
                                 const std::vector<ConvexFace>& faces, double away_m,
                                 std::size_t faces_per_core) {
  const std::vector<Body> all = bodies_of(bodies, faces);
  std::vector<std::vector<BodyCore>> of_body(all.size());
  parallel_for(all.size(), [&](std::size_t b) {
    of_body[b] = Growing(occluders, all[b], away_m).run(all[b].faces.size() / faces_per_core);
  });
  std::vector<BodyCore> cores;
  for (auto& some : of_body) std::move(some.begin(), some.end(), std::back_inserter(cores));
  return cores;
}

}  // namespace sunload
