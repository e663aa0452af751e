// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/surface_kind.h"

#include <algorithm>
#include <limits>

#include "geo/mesh/open_below.h"
#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/roof_sheets.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

struct Heights {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(const Box& box) {
    low = std::min(low, box.low.z);
    high = std::max(high, box.high.z);
  }
  double foot() const { return low + foot_tolerance(high - low); }
  double touching() const { return std::min(touching_m, touching_ratio * (high - low)); }
};

/// Upward triangles of all bodies and sheets, to be asked what is below a point.
class Supports {
 public:
  Supports(const Mesh& mesh, const Bodies& bodies)
      : bodies_(bodies), upward_(mesh, upward_triangles(mesh, bodies)) {}

  /// The highest of other bodies at (x, y) that is lower than `top`; -infinity where there is none.
  double below(std::int32_t body, double x, double y, double top) const {
    double highest = -std::numeric_limits<double>::infinity();
    upward_.visit_heights(x, y, [&](std::size_t t, double z) {
      if (bodies_.triangle_body[t] != body && z < top) highest = std::max(highest, z);
    });
    return highest;
  }

 private:
  static std::vector<std::size_t> upward_triangles(const Mesh& mesh, const Bodies& bodies) {
    std::vector<std::size_t> upward;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (slope_of(mesh, t) == Slope::upward && !bodies.is_inner(t)) upward.push_back(t);
    return upward;
  }

  const Bodies& bodies_;
  PlanTriangles upward_;
};

class Decision {
 public:
  Decision(Mesh& mesh, const Bodies& bodies, SceneKind kind, const Standing& standing)
      : mesh_(mesh),
        bodies_(bodies),
        kind_(kind),
        standing_(standing),
        open_below_(mesh, bodies),
        of_object_(mesh.object_names.size()) {
    for (const auto& body : bodies.bodies) of_object_[body.object.index()].add(body.box);
    if (kind == SceneKind::plain) is_roof_ = roof_sheets(mesh, bodies);
  }

  void run() {
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      Surface& kind = mesh_.triangle_surface[t];
      // A file calls the underside of what juts out over the street so, too.
      if (kind == Surface::floor && (is_on_body(t) || may_hang(t)) &&
          slope_of(mesh_, t) == Slope::downward)
        kind = Surface::other;
      if (kind != Surface::other) continue;
      if (const auto s = slope_of(mesh_, t)) kind = surface(t, *s);
    }
    if (!low_faces_.empty()) find_floors();
  }

 private:
  const Body* body_of(std::size_t t) const {
    const auto b = bodies_.triangle_body[t];
    return b < 0 ? nullptr : &bodies_.bodies[static_cast<std::size_t>(b)];
  }

  bool is_on_body(std::size_t t) const {
    const auto b = bodies_.triangle_body[t];
    return b >= 0 && !standing_.on_body.empty() &&
           standing_.on_body[static_cast<std::size_t>(b)] != 0;
  }

  bool may_hang(std::size_t t) const {
    const auto b = bodies_.triangle_body[t];
    return kind_ == SceneKind::city && b >= 0 &&
           standing_.hangs[static_cast<std::size_t>(b)] != Standing::Hangs::no;
  }

  Surface surface(std::size_t t, Slope s) {
    const Body* body = body_of(t);
    const bool is_closed = body && body->is_closed;
    const auto& word = mesh_.object_kinds[mesh_.triangle_object[t].index()];
    if (!is_closed && is_land(word))  // however steep: quays, pits, kerbs
      return s == Slope::downward ? Surface::other : Surface::ground;
    if (is_plant(word)) return Surface::other;
    if (kind_ == SceneKind::plain && !is_closed && s != Slope::upright)
      return s == Slope::upward && is_roof_of_open_house(bodies_.triangle_body[t]) ? Surface::roof
                                                                                   : Surface::other;
    if (s == Slope::upright) return Surface::wall;
    if (body && body->is_inside_out) return Surface::other;
    if (s == Slope::upward) return Surface::roof;
    if (!is_at_foot(t, body)) return Surface::other;
    if (kind_ == SceneKind::city && !is_on_body(t) && !may_hang(t)) return Surface::floor;
    low_faces_.push_back(t);
    return Surface::other;
  }

  bool is_roof_of_open_house(std::int32_t body) const {
    return body >= 0 && (open_below_.has(body) || is_roof_[static_cast<std::size_t>(body)] != 0);
  }

  Heights heights_of(const Body& body) const {
    Heights heights;
    heights.add(body.box);
    return heights;
  }

  bool is_at_foot(std::size_t t, const Body* body) const {
    const Heights heights =
        kind_ == SceneKind::city ? of_object_[mesh_.triangle_object[t].index()] : heights_of(*body);
    for (int k = 0; k < 3; ++k) {
      if (mesh_.corner(t, k).z > heights.foot()) return false;
    }
    return true;
  }

  /// Of the low faces of a plain scene's bodies, and of a city's bodies on others or in the air,
  /// those that touch what is below.
  void find_floors() {
    const Supports supports(mesh_, bodies_);
    for (const std::size_t t : low_faces_) {
      const auto b = bodies_.triangle_body[t];
      const bool is_on_feet =
          !standing_.on_ground.empty() && standing_.on_ground[static_cast<std::size_t>(b)] != 0;
      if (is_on_feet || is_floor(below_of(t, b, supports), b))
        mesh_.triangle_surface[t] = Surface::floor;
    }
  }

  enum class Below { touching, apart, nothing };
  /// Of a city: what nothing lies below may be its land.
  bool is_floor(Below below, std::int32_t b) const {
    return below == Below::touching ||
           (below == Below::nothing && kind_ == SceneKind::city &&
            standing_.hangs[static_cast<std::size_t>(b)] == Standing::Hangs::perhaps);
  }

  /// At its middle and just inside of its corners: what is in part over the edge of a table is cut
  /// there later (geo/mesh/covered). Of a city, where files leave gaps between bodies that stand on
  /// each other, also a little above.
  Below below_of(std::size_t t, std::int32_t b, const Supports& supports) const {
    constexpr double inside = 0.99, gap_of_city_m = 0.5;
    const Heights heights = heights_of(bodies_.bodies[static_cast<std::size_t>(b)]);
    const Vec3 middle = (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3;
    bool is_touched = true, is_any = false;
    for (int k = 0; k < 4; ++k) {
      const Vec3 p = k < 3 ? middle + inside * (mesh_.corner(t, k) - middle) : middle;
      double support_z = supports.below(b, p.x, p.y, heights.high);
      if (standing_.level_z) support_z = std::max(support_z, *standing_.level_z);
      const double gap_m = kind_ == SceneKind::city ? gap_of_city_m : heights.touching();
      is_any = is_any || support_z > -std::numeric_limits<double>::infinity();
      is_touched = is_touched && support_z >= p.z - gap_m;
      if (is_any && !is_touched) return Below::apart;
    }
    return is_touched ? Below::touching : Below::nothing;
  }

  Mesh& mesh_;
  const Bodies& bodies_;
  SceneKind kind_;
  const Standing& standing_;
  OpenBelow open_below_;
  std::vector<std::uint8_t> is_roof_;  ///< per body of a plain scene: a sheet that walls hold
  std::vector<Heights> of_object_;
  std::vector<std::size_t> low_faces_;
};

}  // namespace

void decide_surfaces(Mesh& mesh, const Bodies& bodies, SceneKind kind, const Standing& standing) {
  Decision(mesh, bodies, kind, standing).run();
}

}  // namespace sunload
