// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/dark_backs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "geo/mesh/covers.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/surface_kind.h"

namespace sunload {

namespace {

/// Bodies that are open where they stand on land, and nowhere else.
class StandingOnLand {
 public:
  StandingOnLand(const Mesh& mesh, const Bodies& bodies)
      : mesh_(mesh), bodies_(bodies), land_(mesh, land_triangles(mesh)) {
    all_.resize(bodies.bodies.size());
    find_open_edges();
    measure_volumes();
  }
  /// Closed by the land, with fronts outward.
  bool has(std::size_t body) const {
    const OpenBody& open = all_[body];
    return open.edge && !open.is_open_above && open.volume > 0;
  }

 private:
  struct OpenBody {
    std::optional<Vec3> edge;  ///< a point of one that is open
    bool is_open_above = false;
    double volume = 0;  ///< as if closed at that point's height, times 6
  };

  void find_open_edges() {
    std::vector<std::uint8_t> may_be(mesh_.triangle_count(), 0);
    for (std::size_t t = 0; t < may_be.size(); ++t) {
      may_be[t] = bodies_.triangle_body[t] >= 0 && !bodies_.is_closed(t) &&
                  mesh_.triangle_surface[t] != Surface::ground;
    }
    for_each_edge(edge_uses(mesh_, may_be), [this](std::span<const EdgeUse> uses) {
      std::map<std::int32_t, int> balance;  // of bodies
      for (const EdgeUse& use : uses)
        balance[bodies_.triangle_body[use.triangle()]] += walks_up(mesh_, use) ? 1 : -1;
      for (const auto& [body, walks] : balance)
        if (walks != 0) note_open(all_[static_cast<std::size_t>(body)], uses.front());
    });
  }
  void note_open(OpenBody& body, const EdgeUse& use) {
    const Vec3 a = mesh_.vertices[static_cast<std::size_t>(use.low)],
               b = mesh_.vertices[static_cast<std::size_t>(use.high)];
    body.edge = a;
    for (const Vec3& p : {a, (a + b) * 0.5, b})
      if (!is_at_land(p)) body.is_open_above = true;
  }
  bool is_at_land(Vec3 p) const {
    bool is_at = false;
    land_.visit_heights(p.x, p.y, [&](std::size_t, double z) { is_at |= z >= p.z - touching_m; });
    return is_at;
  }

  void measure_volumes() {
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const auto b = bodies_.triangle_body[t];
      if (b < 0 || !all_[static_cast<std::size_t>(b)].edge) continue;
      OpenBody& body = all_[static_cast<std::size_t>(b)];
      const Vec3 from = *body.edge;
      body.volume += dot(mesh_.corner(t, 0) - from,
                         cross(mesh_.corner(t, 1) - from, mesh_.corner(t, 2) - from));
    }
  }

  const Mesh& mesh_;
  const Bodies& bodies_;
  PlanTriangles land_;
  std::vector<OpenBody> all_;
};

}  // namespace

std::vector<std::uint8_t> dark_backs(const Mesh& mesh, const Bodies& bodies,
                                     const std::vector<std::uint8_t>& is_opaque) {
  std::vector<std::uint8_t> backs(mesh.triangle_count(), 0);
  if (std::ranges::count(mesh.triangle_sides, Sides::two) == 0) return backs;
  const StandingOnLand on_land(mesh, bodies);
  std::vector<std::uint8_t> are_dark = opaque_bodies(bodies, is_opaque);
  for (std::size_t b = 0; b < are_dark.size(); ++b) {
    const Body& body = bodies.bodies[b];
    if (body.is_closed ? body.is_inside_out : !on_land.has(b)) are_dark[b] = 0;
  }
  for (std::size_t t = 0; t < backs.size(); ++t)
    if (const auto b = bodies.triangle_body[t]; b >= 0 && mesh.triangle_sides[t] == Sides::two)
      backs[t] = are_dark[static_cast<std::size_t>(b)];
  return backs;
}

}  // namespace sunload
