// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/feet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/foot_supports.h"
#include "geo/mesh/plan_lines.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr double steepest_edge = 1.7321;  // tan 60 degrees: steeper edges are corners of walls

struct LowerEdge {
  std::array<std::int32_t, 2> ends;
  std::size_t wall;  // the triangle above; no_wall: one that looks down ends here alone
};

double low_of(const Mesh& mesh, const LowerEdge& e) {
  return std::min(mesh.vertices[static_cast<std::size_t>(e.ends[0])].z,
                  mesh.vertices[static_cast<std::size_t>(e.ends[1])].z);
}

double plan_distance2(Vec3 p, Vec3 a, Vec3 b) {
  const double ex = b.x - a.x, ey = b.y - a.y, length2 = ex * ex + ey * ey;
  const double s =
      length2 > 0 ? std::clamp(((p.x - a.x) * ex + (p.y - a.y) * ey) / length2, 0.0, 1.0) : 0;
  const double dx = p.x - a.x - s * ex, dy = p.y - a.y - s * ey;
  return dx * dx + dy * dy;
}

bool cross_in_plan(Vec3 a, Vec3 b, Vec3 p, Vec3 q) {
  const auto side = [](Vec3 u, Vec3 v, Vec3 w) {
    return (v.x - u.x) * (w.y - u.y) - (v.y - u.y) * (w.x - u.x) > 0;
  };
  return side(a, b, p) != side(a, b, q) && side(p, q, a) != side(p, q, b);
}

/// Whether the lower edges of two feet are nearer to each other in plan than `distance`.
bool are_near(const Foot& one, const Foot& other, double distance) {
  std::vector<Box> boxes;
  for (const auto& [p, q] : other.edges) boxes.push_back(in_plan(box_around({p, q})));
  const BoxTree tree(std::move(boxes));
  bool is_near = false;
  for (const auto& edge : one.edges) {
    const Vec3 a = edge[0], b = edge[1];
    tree.visit_meeting(upright(widened(box_around({a, b}), distance)), [&](std::size_t i) {
      const auto& [p, q] = other.edges[i];
      if (is_near) return;
      is_near = cross_in_plan(a, b, p, q) ||
                std::min({plan_distance2(a, p, q), plan_distance2(b, p, q), plan_distance2(p, a, b),
                          plan_distance2(q, a, b)}) < distance * distance;
    });
  }
  return is_near;
}

class FootFinder {
 public:
  FootFinder(const Mesh& mesh, const Bodies& bodies, SceneKind kind)
      : mesh_(mesh),
        bodies_(bodies),
        kind_(kind),
        floor_high_(bodies.bodies.size(), -infinity),
        feet_(bodies.bodies.size()) {
    has_feet_.resize(mesh.object_names.size());
    for (std::size_t o = 0; o < has_feet_.size(); ++o) {
      const std::string& of = mesh.object_kinds[o];
      has_feet_[o] = kind == SceneKind::city ? is_building(of) || of.empty()
                                             : !is_plant(of) && !is_land(of) && of != hanging_kind;
    }
  }

  std::vector<Foot> run() {
    measure_bodies();
    find_lower_edges();
    for (std::size_t b = 0; b < feet_.size(); ++b) take_foot(b);
    std::erase_if(
        feet_, [&](const Foot& foot) { return foot.edges.empty() || is_low_without_type(foot); });
    take_out_panes();
    find_floors();
    find_supports(mesh_, bodies_, feet_);
    for (Foot& foot : feet_) find_rims(foot);
    find_hovering();
    return std::move(feet_);
  }

 private:
  Vec3 at(std::int32_t v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }

  /// In a city, what a plain file (OBJ) brings and is lower than a storey: a canopy, a panel, a
  /// bench.
  bool is_low_without_type(const Foot& foot) const {
    if (kind_ == SceneKind::plain || !mesh_.object_kinds[foot.object.index()].empty()) return false;
    const Box& box = bodies_.bodies[static_cast<std::size_t>(foot.body)].box;
    return box.high.z - box.low.z < lowest_house_m;
  }

  bool is_house(std::int32_t body) const {
    const auto b = static_cast<std::size_t>(body);
    return bodies_.bodies[b].is_closed || has_roof_[b] != 0;
  }

  /// Sheets that hang on a house, all along its foot and above it, as panes are which a file has
  /// beside its walls: land would climb to their sills.
  void take_out_panes() {
    constexpr double beside_m = 0.5, least_sill_m = 0.3;
    std::vector<Segment> of_houses;
    for (const Foot& foot : feet_)
      if (is_house(foot.body))
        of_houses.insert(of_houses.end(), foot.edges.begin(), foot.edges.end());
    const PlanLines houses(of_houses);
    const auto hangs = [&](Vec3 p) {
      bool has_house_below = false;
      houses.visit_within(p.x, p.y, beside_m, [&](const NearestOnLine& found) {
        has_house_below |= found.z < p.z - least_sill_m;
      });
      return has_house_below;
    };
    std::erase_if(feet_, [&](const Foot& foot) {
      return !is_house(foot.body) && std::ranges::all_of(foot.edges, [&](const auto& edge) {
        return hangs(edge[0]) && hangs((edge[0] + edge[1]) / 2) && hangs(edge[1]);
      });
    });
  }

  void measure_bodies() {
    std::vector<std::array<double, 2>> plan(feet_.size());
    has_roof_.resize(feet_.size(), 0);
    low_of_object_.resize(mesh_.object_names.size(), infinity);
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const auto b = bodies_.triangle_body[t];
      if (b < 0) continue;
      const auto slope = slope_of(mesh_, t);
      if (!slope || *slope == Slope::upright) continue;
      const bool looks_up = *slope == Slope::upward;
      plan[static_cast<std::size_t>(b)][looks_up] += std::abs(mesh_.area_vector2(t).z) / 2;
      if (looks_up) has_roof_[static_cast<std::size_t>(b)] = 1;
    }
    for (std::size_t b = 0; b < feet_.size(); ++b) {
      const Body& body = bodies_.bodies[b];
      feet_[b].body = static_cast<std::int32_t>(b);
      feet_[b].object = body.object;
      feet_[b].plan_m2 = std::max(plan[b][0], plan[b][1]);
      double& low = low_of_object_[body.object.index()];
      low = std::min(low, body.box.low.z);
    }
  }

  void find_lower_edges() {
    std::vector<std::uint8_t> included(mesh_.triangle_count());
    for (std::size_t t = 0; t < included.size(); ++t)
      included[t] = has_feet_[mesh_.triangle_object[t].index()] && bodies_.triangle_body[t] >= 0 &&
                    !bodies_.is_inner(t);
    lower_.resize(feet_.size());
    for_each_edge(edge_uses(mesh_, included), [&](std::span<const EdgeUse> uses) {
      const Vec3 a = at(uses[0].low), b = at(uses[0].high);
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      if (!(std::abs(b.z - a.z) <= steepest_edge * length) || length == 0) return;
      std::size_t wall = mesh_.triangle_count(), corner = 0;
      for (const EdgeUse& use : uses) {
        const std::size_t t = use.triangle();
        const auto slope = slope_of(mesh_, t);
        if (!slope || *slope == Slope::downward) continue;
        if (*slope == Slope::upward || !is_above(use, a, b)) return;
        if (t >= wall) continue;
        wall = t;
        corner = use.corner();
      }
      if (wall == mesh_.triangle_count()) {
        if (uses.size() > 1) return;
        const auto body = bodies_.triangle_body[uses[0].triangle()];
        lower_[static_cast<std::size_t>(body)].push_back({{uses[0].low, uses[0].high}, no_wall});
        return;
      }
      lower_[static_cast<std::size_t>(bodies_.triangle_body[wall])].push_back(
          {{mesh_.triangles[wall][corner], mesh_.triangles[wall][(corner + 1) % 3]}, wall});
    });
  }

  /// Whether the upright triangle goes up from the edge.
  bool is_above(const EdgeUse& use, Vec3 a, Vec3 b) const {
    const Vec3 p = apex_of(mesh_, use);
    const double ex = b.x - a.x, ey = b.y - a.y;
    const double s = ((p.x - a.x) * ex + (p.y - a.y) * ey) / (ex * ex + ey * ey);
    return p.z > a.z + s * (b.z - a.z);
  }

  /// Edges at the foot, and what is reached from there, also where walls are missing.
  void take_foot(std::size_t b) {
    const Body& body = bodies_.bodies[b];
    auto& lower = lower_[b];
    const auto has_wall = [](const LowerEdge& e) { return e.wall != no_wall; };
    if (std::none_of(lower.begin(), lower.end(), has_wall) || body.is_inside_out ||
        (body.is_closed && body.volume < 0)) {
      lower.clear();
      return;
    }
    double low = low_of_object_[body.object.index()];
    if (is_house(static_cast<std::int32_t>(b))) {
      low = infinity;
      for (const auto& e : lower)
        if (has_wall(e)) low = std::min(low, low_of(mesh_, e));
    }
    keep_reached(lower, low + foot_tolerance(body.box.high.z - body.box.low.z));
    for (const auto& e : lower)
      for (const auto v : e.ends) floor_high_[b] = std::max(floor_high_[b], at(v).z);
    std::erase_if(lower, [&](const LowerEdge& e) { return !has_wall(e); });
    for (const auto& e : lower) {
      feet_[b].edges.push_back({at(e.ends[0]), at(e.ends[1])});
      feet_[b].walls.push_back(e.wall);
      for (const auto v : e.ends) {
        Box& box = feet_[b].box;
        const Vec3 p = at(v);
        include(box, p);
      }
    }
  }

  /// Those below walls that are no higher than the foot, and all that hang together with them.
  void keep_reached(std::vector<LowerEdge>& lower, double foot) const {
    std::vector<std::pair<std::int32_t, std::size_t>> edges_at;
    for (std::size_t e = 0; e < lower.size(); ++e)
      for (const auto v : lower[e].ends) edges_at.emplace_back(v, e);
    std::sort(edges_at.begin(), edges_at.end());
    std::vector<std::uint8_t> is_taken(lower.size(), 0);
    std::vector<std::size_t> open;
    for (std::size_t e = 0; e < lower.size(); ++e) {
      if (lower[e].wall == no_wall || low_of(mesh_, lower[e]) > foot) continue;
      is_taken[e] = 1;
      open.push_back(e);
    }
    while (!open.empty()) {
      const std::size_t e = open.back();
      open.pop_back();
      for (const auto v : lower[e].ends) {
        auto it = std::lower_bound(edges_at.begin(), edges_at.end(), std::pair(v, std::size_t{0}));
        for (; it != edges_at.end() && it->first == v; ++it) {
          if (is_taken[it->second]) continue;
          is_taken[it->second] = 1;
          open.push_back(it->second);
        }
      }
    }
    std::size_t kept = 0;
    for (std::size_t e = 0; e < lower.size(); ++e)
      if (is_taken[e]) lower[kept++] = lower[e];
    lower.resize(kept);
  }

  void find_floors() {
    std::vector<Foot*> foot_of(bodies_.bodies.size(), nullptr);
    for (Foot& foot : feet_) foot_of[static_cast<std::size_t>(foot.body)] = &foot;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const auto b = bodies_.triangle_body[t];
      if (b < 0 || slope_of(mesh_, t) != Slope::downward) continue;
      Foot* const foot = foot_of[static_cast<std::size_t>(b)];
      const Box box = box_of(mesh_, t);
      if (foot && box.high.z <= floor_high_[static_cast<std::size_t>(b)] + level_m)
        foot->floors.push_back(t);
    }
  }

  /// Edges that one floor has alone, but for those with a wall above: party walls are missing in
  /// many models, and where a neighbour has been taken away.
  void find_rims(Foot& foot) const {
    using Edge = std::array<std::int32_t, 2>;
    const auto edge = [](std::int32_t a, std::int32_t b) {
      return Edge{std::min(a, b), std::max(a, b)};
    };
    std::map<Edge, int> uses;
    for (const auto t : foot.floors)
      for (std::size_t k = 0; k < 3; ++k)
        ++uses[edge(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3])];
    for (const LowerEdge& e : lower_[static_cast<std::size_t>(foot.body)])
      uses.erase(edge(e.ends[0], e.ends[1]));
    for (const auto& [ends, count] : uses)
      if (count == 1) foot.rims.push_back({at(ends[0]), at(ends[1])});
  }

  /// Whether what is lower than a storey lies above most of what another foot encloses, as a roof
  /// on walls without a ceiling.
  bool is_roof_of(std::size_t upper, std::size_t lower) const {
    const Box& body = bodies_.bodies[static_cast<std::size_t>(feet_[upper].body)].box;
    const Box &a = feet_[upper].box, &b = feet_[lower].box;
    if (body.high.z - body.low.z >= lowest_house_m || a.low.z <= b.high.z) return false;
    constexpr double most = 0.5;
    return shared_plan_m2(a, b) > most * shared_plan_m2(b, b);
  }

  /// Of feet that no land can join those with most area against them, one after the other.
  void find_hovering() {
    std::vector<Box> boxes;
    for (const Foot& foot : feet_) boxes.push_back(foot.box);
    const BoxTree tree(std::move(boxes));
    std::vector<std::vector<std::size_t>> against(feet_.size());
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      if (feet_[f].stance != Stance::ground) continue;
      tree.visit_meeting(upright(widened(feet_[f].box, foot_reach_m)), [&](std::size_t g) {
        if (g == f || feet_[g].stance != Stance::ground) return;
        const double rise = feet_[f].box.low.z - feet_[g].box.high.z;  // f is the higher one
        if (rise <= highest_step_m) return;
        if (!are_near(feet_[f], feet_[g], rise - highest_step_m)) return;
        against[f].push_back(g);
        against[g].push_back(f);
      });
    }
    std::vector<std::size_t> contested;
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      if (std::ranges::any_of(against[f], [&](std::size_t g) { return is_roof_of(f, g); }))
        feet_[f].stance = Stance::hovering;
      if (!against[f].empty()) contested.push_back(f);
    }
    while (true) {
      std::size_t worst = feet_.size();
      double most = 0;
      for (const auto f : contested) {
        if (feet_[f].stance != Stance::ground) continue;
        double area = 0;
        for (const auto g : against[f])
          if (feet_[g].stance == Stance::ground) area += feet_[g].plan_m2;
        const double ratio = area / std::max(feet_[f].plan_m2, level_m);
        const bool is_higher = worst < feet_.size() && feet_[f].box.low.z > feet_[worst].box.low.z;
        if (ratio > most || (ratio == most && ratio > 0 && is_higher)) {
          most = ratio;
          worst = f;
        }
      }
      if (worst == feet_.size()) return;
      feet_[worst].stance = Stance::hovering;
    }
  }

  static constexpr double level_m = 1e-3;  // and the least area that counts [m2]

  const Mesh& mesh_;
  const Bodies& bodies_;
  const SceneKind kind_;
  std::vector<std::uint8_t> has_feet_, has_roof_;  // per object, per body
  std::vector<double> low_of_object_;
  std::vector<std::vector<LowerEdge>> lower_;  // per body
  std::vector<double> floor_high_;             // per body: of edges at the foot, and rims of floors
  std::vector<Foot> feet_;
};

}  // namespace

bool is_building(const std::string& kind) {
  return kind == "Building" || kind == "BuildingPart" || kind == "OtherConstruction" ||
         (kind.starts_with('+') && kind.find("Building") != std::string::npos);
}

std::vector<Foot> find_feet(const Mesh& mesh, const Bodies& bodies, SceneKind kind) {
  return FootFinder(mesh, bodies, kind).run();
}

}  // namespace sunload
