// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/ground.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/base/unused_name.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/land.h"
#include "geo/mesh/plan_triangles.h"
#include "geo/mesh/rim_land.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr std::size_t most_told = 10;
constexpr double below_land_m = 0.05;  // walls drawn down end there

MaterialId ground_material(std::vector<FileMaterial>& materials) {
  const auto it = std::find_if(materials.begin(), materials.end(),
                               [](const FileMaterial& m) { return m.name == "ground"; });
  const auto index = static_cast<std::size_t>(it - materials.begin());
  if (it == materials.end()) {
    FileMaterial material;
    material.name = "ground";
    materials.push_back(material);
  }
  return make_id<MaterialId>(index);
}

double lowest(const std::vector<Foot>& feet) {
  double low = infinity;
  for (const Foot& foot : feet)
    if (foot.stance == Stance::ground) low = std::min(low, foot.box.low.z);
  return low;
}
double highest(const std::vector<Foot>& feet) {
  double high = -infinity;
  for (const Foot& foot : feet)
    if (foot.stance == Stance::ground) high = std::max(high, foot.box.high.z);
  return high;
}

/// Height of a plate, where one is wanted or as good as land through the feet.
std::optional<double> level_z(const Mesh& mesh, const std::vector<Foot>& feet,
                              const GroundRules& rules) {
  if (rules.surface == GroundSurface::level && rules.height_m)
    return *rules.height_m - mesh.origin.z;
  const double scene_low = bounding_box(mesh.vertices).low.z;
  if (rules.surface == GroundSurface::level) return scene_low;
  const double low = lowest(feet);
  if (low == infinity) return scene_low;
  if (highest(feet) - low > level_feet_m) return {};
  return low - scene_low <= level_feet_m ? scene_low : low;
}

class GroundMaker {
 public:
  GroundMaker(Mesh& mesh, const std::vector<Foot>& feet, const GroundRules& rules)
      : mesh_(mesh),
        feet_(feet),
        rules_(rules),
        level_z_(level_z(mesh, feet, rules)),
        terrain_(land_triangles(mesh)),
        first_made_(mesh.triangle_count()) {}

  GroundMade run() {
    set_rectangle();
    find_lines();
    if (lines_.rims.empty() && lines_.feet.empty())
      add_plate();
    else
      add_land();
    last_made_ = mesh_.triangle_count();
    if (!terrain_.empty() && !is_plate()) draw_down();
    GroundMade made{report(), {}};
    if (!seals_.empty()) {
      made.seals.assign(mesh_.triangle_count(), 0);
      for (const auto t : seals_) made.seals[t] = 1;
    }
    return made;
  }

 private:
  void set_rectangle() {
    const Box box = bounding_box(mesh_.vertices);
    const double margin = rules_.margin_m;
    lines_.x0 = box.low.x - margin, lines_.x1 = box.high.x + margin;
    lines_.y0 = box.low.y - margin, lines_.y1 = box.high.y + margin;
    if (!(margin >= 0) || !std::isfinite(margin) || !(lines_.x1 > lines_.x0) ||
        !(lines_.y1 > lines_.y0)) {
      throw InputError({}, "scene.ground.margin_m = " + std::to_string(margin),
                       "the ground needs a margin >= 0 and an area", "use 50");
    }
  }

  /// A level ground goes below terrain and feet that are higher than it.
  bool stands(const Foot& foot) const {
    return foot.stance == Stance::ground && !(level_z_ && foot.box.low.z > *level_z_ + land_snap_m);
  }

  void find_lines() {
    if (!is_plate()) find_rims();
    const PlanTriangles terrain(mesh_, terrain_);
    const RimLand between_rims(lines_.rims);
    for (const Foot& foot : feet_) {
      if (!stands(foot)) continue;
      for (const auto* edges : {&foot.edges, &foot.rims})
        for (const Segment& edge : *edges) add_line(edge, foot.body, terrain, between_rims);
    }
  }

  void add_line(Segment edge, std::int32_t body, const PlanTriangles& terrain,
                const RimLand& between_rims) {
    if (!is_plate() && terrain.covers((edge[0] + edge[1]) / 2)) return;
    // In a hole that the terrain has for the house, what lies below its rims is buried.
    for (Vec3& end : edge)
      if (const auto land = between_rims.height_at(end.x, end.y)) end.z = std::max(end.z, *land);
    if (level_z_)
      for (Vec3& end : edge) end.z = *level_z_;
    lines_.feet.push_back(edge);
    lines_.foot_body.push_back(body);
  }

  bool is_plate() const { return rules_.surface == GroundSurface::level; }

  /// Edges of the terrain that one of its triangles has alone, whatever its object.
  void find_rims() {
    std::map<std::array<std::int32_t, 2>, int> uses;
    const auto each_edge = [&](const auto& visit) {
      for (const auto t : terrain_)
        for (std::size_t k = 0; k < 3; ++k) {
          const auto a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
          visit(std::array{std::min(a, b), std::max(a, b)});
        }
    };
    each_edge([&](const auto& edge) { ++uses[edge]; });
    for (const auto& [edge, count] : uses)
      if (count == 1)
        lines_.rims.push_back({mesh_.vertices[static_cast<std::size_t>(edge[0])],
                               mesh_.vertices[static_cast<std::size_t>(edge[1])]});
    if (!lines_.rims.empty()) level_z_.reset();
  }

  void begin_object() {
    object_ = make_id<ObjectId>(mesh_.object_names.size());
    std::set<std::string> taken(mesh_.object_names.begin(), mesh_.object_names.end());
    mesh_.object_names.push_back(unused_name("ground", taken));
    mesh_.object_kinds.emplace_back();
    material_ = ground_material(mesh_.file_materials);
    vertex_base_ = static_cast<std::int32_t>(mesh_.vertices.size());
  }

  /// Walls above the terrain or hardly below it get a part that ends below it.
  void draw_down() {
    std::vector<Box> boxes;
    for (const auto t : terrain_) boxes.push_back(in_plan(box_of(mesh_, t)));
    const BoxTree tree(std::move(boxes));
    drawn_m_.assign(feet_.size(), 0);
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      const Foot& foot = feet_[f];
      if (foot.stance != Stance::ground) continue;
      std::vector<Heights> land_of_edges;
      for (const Segment& edge : foot.edges) land_of_edges.push_back(land_along(edge, tree));
      if (hovers_over(foot, land_of_edges)) continue;
      bool is_closed = true;
      for (std::size_t e = 0; e < foot.edges.size(); ++e) {
        const Heights land = land_of_edges[e];
        if (land.low == infinity) continue;
        const auto& [a, b] = foot.edges[e];
        if (std::max(a.z, b.z) - land.low > longest_drawn_m || foot.walls[e] == no_wall) {
          is_closed = false;
          continue;
        }
        if (std::min(a.z, b.z) < land.low - below_land_m) continue;
        drawn_m_[f] = std::max({drawn_m_[f], land.largest_gap});
        add_wall(foot.edges[e], land.low - below_land_m, foot.walls[e]);
      }
      if (is_closed) seals_.insert(seals_.end(), foot.floors.begin(), foot.floors.end());
    }
  }

  /// Nothing says what it is.
  bool is_untold(ObjectId object) const { return mesh_.object_kinds[object.index()].empty(); }

  struct Heights {
    double low = infinity, largest_gap = -infinity;
  };
  /// Of shapes that nothing says are houses those that are nowhere near the land: canopies, signs.
  bool hovers_over(const Foot& foot, const std::vector<Heights>& land_of_edges) const {
    if (!is_untold(foot.object)) return false;
    for (std::size_t e = 0; e < foot.edges.size(); ++e) {
      const auto& [a, b] = foot.edges[e];
      const double low = land_of_edges[e].low;
      if (low == infinity || std::min(a.z, b.z) <= low + highest_step_m) return false;
    }
    return true;
  }

  /// Of the terrain along a line in plan: at its ends, and where it crosses edges.
  Heights land_along(const Segment& line, const BoxTree& tree) const {
    const Vec3 a = line[0], b = line[1];
    Heights found;
    const auto at = [&](double s, double z) {
      found.low = std::min(found.low, z);
      found.largest_gap = std::max(found.largest_gap, a.z + s * (b.z - a.z) - z);
    };
    tree.visit_meeting(upright(box_around({a, b})), [&](std::size_t i) {
      const std::array corners{mesh_.corner(terrain_[i], 0), mesh_.corner(terrain_[i], 1),
                               mesh_.corner(terrain_[i], 2)};
      for (const double s : {0.0, 1.0}) {
        const Vec3 p = s == 0 ? a : b;
        if (const auto z = height_at(corners[0], corners[1], corners[2], p.x, p.y)) at(s, *z);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = corners[k], q = corners[(k + 1) % 3];
        const auto side = [](Vec3 u, Vec3 v, Vec3 w) {
          return (v.x - u.x) * (w.y - u.y) - (v.y - u.y) * (w.x - u.x);
        };
        const double of_p = side(a, b, p), of_q = side(a, b, q), of_a = side(p, q, a),
                     of_b = side(p, q, b);
        if ((of_p > 0) == (of_q > 0) || (of_a > 0) == (of_b > 0)) continue;
        at(of_a / (of_a - of_b), p.z + of_p / (of_p - of_q) * (q.z - p.z));
      }
    });
    return found;
  }

  void add_wall(const Segment& edge, double low_z, std::size_t wall) {
    object_ = mesh_.triangle_object[wall];
    material_ = mesh_.triangle_material[wall];
    vertex_base_ = static_cast<std::int32_t>(mesh_.vertices.size());
    const auto& [a, b] = edge;
    for (const Vec3 p : {Vec3{a.x, a.y, low_z}, Vec3{b.x, b.y, low_z}, b, a})
      mesh_.vertices.push_back(p);
    for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      add(t, false);
      seals_.push_back(mesh_.triangle_count() - 1);
      mesh_.triangle_surface.back() = Surface::wall;
      mesh_.triangle_facade.back() = mesh_.triangle_facade[wall];
      mesh_.triangle_sides.back() = mesh_.triangle_sides[wall];
      if (const auto facade = mesh_.triangle_facade[wall]; facade.exists())
        mesh_.facades[facade.index()].area_m2 += mesh_.area_m2(mesh_.triangle_count() - 1);
    }
  }

  void add(std::array<std::int32_t, 3> t, bool is_covered) {
    for (auto& v : t) v += vertex_base_;
    mesh_.triangles.push_back(t);
    mesh_.triangle_object.push_back(object_);
    mesh_.triangle_material.push_back(material_);
    mesh_.triangle_facade.push_back(FacadeId::none());
    mesh_.triangle_surface.push_back(Surface::ground);
    mesh_.triangle_sides.push_back(Sides::one);
    if (is_covered && mesh_.triangle_covered.empty())
      mesh_.triangle_covered.assign(mesh_.triangle_count() - 1, 0);
    if (is_covered || !mesh_.triangle_covered.empty()) mesh_.triangle_covered.push_back(is_covered);
  }

  void add_plate() {
    begin_object();
    const double z = level_z_.value_or(bounding_box(mesh_.vertices).low.z);
    for (const Vec3 corner : {Vec3{lines_.x0, lines_.y0, z}, Vec3{lines_.x1, lines_.y0, z},
                              Vec3{lines_.x1, lines_.y1, z}, Vec3{lines_.x0, lines_.y1, z}})
      mesh_.vertices.push_back(corner);
    add({0, 1, 2}, false);
    add({0, 2, 3}, false);
  }

  void add_land() {
    const Land land = triangulate_land(lines_);
    steepest_beyond_ = land.steepest_beyond;
    const PlanTriangles terrain(mesh_, terrain_);
    std::vector<std::size_t> floors;
    std::vector<Box> boxes;
    for (const Foot& foot : feet_) {
      if (stands(foot)) floors.insert(floors.end(), foot.floors.begin(), foot.floors.end());
      boxes.push_back(foot.box);
    }
    const PlanTriangles under(mesh_, floors);
    // Squares and yards that the model has as objects of other kinds.
    std::vector<std::size_t> upward;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
      if (mesh_.triangle_surface[t] != Surface::ground && slope_of(mesh_, t) == Slope::upward)
        upward.push_back(t);
    const PlanTriangles others(mesh_, std::move(upward));
    const BoxTree of_feet(std::move(boxes));
    begin_object();
    std::vector<std::pair<std::array<std::int32_t, 3>, bool>> wanted;
    for (const auto& t : land.triangles) {
      const auto at = [&](std::size_t k) { return land.points[static_cast<std::size_t>(t[k])]; };
      const Vec3 middle = (at(0) + at(1) + at(2)) / 3;
      const bool is_terrain = terrain.covers(middle);
      if (is_terrain && !is_plate()) continue;
      wanted.emplace_back(t, is_terrain || under.covers(middle) ||
                                 is_wholly_on(others, {at(0), at(1), at(2)}) ||
                                 is_enclosed(middle, of_feet));
    }
    std::vector<std::int32_t> new_index(land.points.size(), -1);
    for (auto& [t, is_covered] : wanted) {
      for (auto& v : t) {
        auto& index = new_index[static_cast<std::size_t>(v)];
        if (index < 0) {
          index = static_cast<std::int32_t>(mesh_.vertices.size()) - vertex_base_;
          mesh_.vertices.push_back(land.points[static_cast<std::size_t>(v)]);
        }
        v = index;
      }
      add(t, is_covered);
    }
  }

  /// By its corners, the middles of its edges and its own. Their rims are no lines of the land:
  /// what lies on them in part is cut where it is covered (geo/mesh/covered.h).
  static bool is_wholly_on(const PlanTriangles& others, const std::array<Vec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const std::array places{(a + b + c) / 3, (a + b) / 2, (b + c) / 2, (c + a) / 2, a, b, c};
    return std::all_of(places.begin(), places.end(),
                       [&](Vec3 p) { return others.is_on(p, land_snap_m); });
  }

  /// Inside the ring of a foot that has no floor: an odd number of its edges on either side.
  bool is_enclosed(Vec3 p, const BoxTree& of_feet) const {
    bool is_inside = false;
    of_feet.visit_column(p.x, p.y, [&](std::size_t f) {
      if (!stands(feet_[f]) || !feet_[f].floors.empty()) return;
      bool west = false, east = false;
      for (const auto& [a, b] : feet_[f].edges) {
        if ((a.y > p.y) == (b.y > p.y)) continue;
        bool& side = p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)) ? east : west;
        side = !side;
      }
      is_inside |= west && east;
    });
    return is_inside;
  }

  GroundReport report() const {
    GroundReport r;
    r.surface = rules_.surface;
    r.is_level = level_z_.has_value();
    r.steepest_beyond = steepest_beyond_;
    r.low_m = infinity, r.high_m = -infinity;
    std::vector<std::size_t> all = terrain_;
    const auto plan = [&](std::size_t t) { return std::abs(mesh_.area_vector2(t).z) / 2; };
    for (const auto t : terrain_) r.terrain_m2 += plan(t);
    for (std::size_t t = first_made_; t < last_made_; ++t) {
      all.push_back(t);
      r.made_m2 += plan(t);
      for (int k = 0; k < 3; ++k) {
        r.low_m = std::min(r.low_m, mesh_.corner(t, k).z + mesh_.origin.z);
        r.high_m = std::max(r.high_m, mesh_.corner(t, k).z + mesh_.origin.z);
      }
    }
    const PlanTriangles ground(mesh_, std::move(all));
    std::vector<FootGap> gaps;
    for (std::size_t f = 0; f < feet_.size(); ++f) {
      const Foot& foot = feet_[f];
      if (foot.stance == Stance::body) ++r.on_others;
      if (foot.stance == Stance::body) continue;
      FootGap gap{mesh_.object_names[foot.object.index()], largest_gap(foot, ground)};
      if (!drawn_m_.empty() && drawn_m_[f] > land_snap_m) {
        ++r.drawn;
        r.longest_drawn_m = std::max(r.longest_drawn_m, drawn_m_[f]);
        if (drawn_m_[f] > floating_m && is_untold(foot.object))
          r.drawn_far.push_back({gap.object, drawn_m_[f]});
        if (gap.gap_m <= longest_drawn_m) gap.gap_m = std::min(gap.gap_m, 0.0);
      }
      if (foot.stance == Stance::ground) gaps.push_back(gap);
      if (foot.stance == Stance::hovering && std::abs(gap.gap_m) > floating_m)
        r.hovering.push_back(gap);
    }
    r.standing = gaps.size();
    const auto by_size = [](const FootGap& a, const FootGap& b) {
      return std::abs(a.gap_m) != std::abs(b.gap_m) ? std::abs(a.gap_m) > std::abs(b.gap_m)
                                                    : a.object < b.object;
    };
    std::sort(r.hovering.begin(), r.hovering.end(), by_size);
    std::sort(r.drawn_far.begin(), r.drawn_far.end(), by_size);
    std::vector<double> sorted;
    sorted.reserve(gaps.size());
    for (const auto& gap : gaps) sorted.push_back(gap.gap_m);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < GroundReport::shares.size() && !sorted.empty(); ++i)
      r.gap_m[i] = sorted[static_cast<std::size_t>(
          std::lround(GroundReport::shares[i] * static_cast<double>(sorted.size() - 1)))];
    for (const auto& gap : gaps) r.floating += gap.gap_m > floating_m;
    std::sort(gaps.begin(), gaps.end(), by_size);
    if (gaps.size() > most_told) gaps.resize(most_told);
    r.worst = std::move(gaps);
    return r;
  }

  /// Of the ends and middles of its edges the one farthest from the ground.
  static double largest_gap(const Foot& foot, const PlanTriangles& ground) {
    double largest = 0;
    for (const auto& [a, b] : foot.edges)
      for (const Vec3 p : {a, (a + b) / 2, b}) {
        double gap = infinity;
        // Land and feet are the same within the snap: a wall on the rim of the ground is on it.
        for (const Vec3 off : {Vec3{}, Vec3{land_snap_m, 0, 0}, Vec3{-land_snap_m, 0, 0},
                               Vec3{0, land_snap_m, 0}, Vec3{0, -land_snap_m, 0}})
          ground.visit_heights(p.x + off.x, p.y + off.y, [&](std::size_t, double z) {
            if (std::abs(p.z - z) < std::abs(gap)) gap = p.z - z;
          });
        if (std::isfinite(gap) && std::abs(gap) > std::abs(largest)) largest = gap;
      }
    return largest;
  }

  Mesh& mesh_;
  const std::vector<Foot>& feet_;
  const GroundRules& rules_;
  std::optional<double> level_z_;
  std::vector<std::size_t> terrain_;
  std::size_t first_made_, last_made_ = 0;
  std::vector<double> drawn_m_;     // per foot
  std::vector<std::size_t> seals_;  // triangles
  LandLines lines_;
  double steepest_beyond_ = 0;
  ObjectId object_;
  MaterialId material_ = MaterialId::none();
  std::int32_t vertex_base_ = 0;
};

/// Of what has no foot.
Standing::Hangs hangs_by_type(const std::string& kind) {
  if (is_building(kind)) return Standing::Hangs::no;
  return kind.starts_with("Bridge") || kind.find("Installation") != kind.npos
             ? Standing::Hangs::surely
             : Standing::Hangs::perhaps;
}

}  // namespace

Standing standing_on(const Mesh& mesh, const Bodies& bodies, const std::vector<Foot>& feet,
                     const std::optional<GroundRules>& rules) {
  Standing standing;
  const std::size_t body_count = bodies.bodies.size();
  standing.on_body.assign(body_count, 0);
  for (const Body& body : bodies.bodies)
    standing.hangs.push_back(hangs_by_type(mesh.object_kinds[body.object.index()]));
  for (const Foot& foot : feet) {
    const auto b = static_cast<std::size_t>(foot.body);
    standing.on_body[b] = foot.stance == Stance::body;
    standing.hangs[b] =
        foot.stance == Stance::hovering ? Standing::Hangs::surely : Standing::Hangs::no;
  }
  if (!rules) return standing;
  standing.level_z = level_z(mesh, feet, *rules);
  if (standing.level_z) return standing;
  standing.on_ground.assign(body_count, 0);
  for (const Foot& foot : feet)
    if (foot.stance == Stance::ground) standing.on_ground[static_cast<std::size_t>(foot.body)] = 1;
  return standing;
}

GroundMade add_ground(Mesh& mesh, const std::vector<Foot>& feet, const GroundRules& rules) {
  return GroundMaker(mesh, feet, rules).run();
}

}  // namespace sunload
