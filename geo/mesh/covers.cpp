// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/covers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geo/base/check.h"
#include "geo/mesh/clip.h"
#include "geo/mesh/covered.h"
#include "geo/mesh/overlap.h"
#include "geo/mesh/plumb_line.h"
#include "geo/mesh/slope.h"
#include "geo/mesh/solid_bodies.h"

namespace sunload {

namespace {

constexpr double contact_ratio = 1e-4;
/// A road no higher than this above land lies on it, and is no bridge.
constexpr double road_bed_m = 0.5;
// Pairs of triangles compared: cities have some ten for each triangle.
constexpr std::size_t most_pairs = 500'000'000;

}  // namespace

double contact_of(const Mesh& mesh) {
  const Box box = bounding_box(mesh.vertices);
  return std::min(contact_m, contact_ratio * norm(box.high - box.low));
}

std::vector<std::uint8_t> opaque_bodies(const Bodies& bodies,
                                        const std::vector<std::uint8_t>& is_opaque) {
  std::vector<std::uint8_t> are_opaque(bodies.bodies.size(), 1);
  for (std::size_t t = 0; t < is_opaque.size(); ++t)
    if (const auto b = bodies.triangle_body[t]; b >= 0 && !is_opaque[t])
      are_opaque[static_cast<std::size_t>(b)] = 0;
  return are_opaque;
}

Covers::Covers(const Mesh& mesh, const Bodies& bodies, const std::vector<std::uint8_t>& is_opaque,
               const std::vector<std::uint8_t>& seals, const std::vector<std::uint8_t>& emits,
               Cavities cavities)
    : mesh_(mesh),
      bodies_(bodies),
      is_opaque_(is_opaque),
      seals_(seals),
      emits_(emits),
      cavities_(cavities),
      open_houses_(mesh, bodies, is_opaque) {
  contact_ = contact_of(mesh);
  same_place_ = same_place_m(mesh);
  find_bodies();
  find_land();
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    boxes.push_back(box_of(mesh, t));
    const double length = norm(mesh.area_vector2(t));
    normal_.push_back(length > 0 ? mesh.area_vector2(t) / length : Vec3{});
  }
  tree_ = BoxTree(std::move(boxes));
  find_rims();
}

/// From where on triangles are of no matter to each other.
double Covers::reach_m() const { return std::max(looked_at_m(), same_place_); }

void Covers::count_pair() const {
  if (++pairs_ <= most_pairs) return;
  throw InputError({}, "more triangles overlap than can be compared",
                   "what lies inside of bodies cannot be told from what does not",
                   "is geometry there many times over? scene.repair: none leaves it as it is");
}

bool Covers::are_of_one_body(std::size_t t, std::size_t u) const {
  const auto b = bodies_.triangle_body[t];
  return b >= 0 && b == bodies_.triangle_body[u];
}

bool Covers::may_replace(std::size_t t, std::size_t u) const {
  if (!mesh_.bears_patches(u) || (faces_both(t) && !faces_both(u))) return false;
  return faces_both(u) || dot(normal_[t], normal_[u]) > 0;
}

bool Covers::is_one_place(std::size_t t, std::size_t u, const Gap& between) const {
  // Windows lie on their walls in whole millimetres only.
  const double within =
      is_window(t) == is_window(u) ? same_place_ : std::max(same_place_, contact_);
  return between.is_within(within);
}

bool Covers::is_taken(std::size_t t, std::size_t u) const {
  if (!(is_opaque_[u] || (is_window(u) && !is_window(t))) || !may_replace(t, u)) return false;
  const auto rank = [&](std::size_t x) {
    return std::array{emits(x), is_window(x), faces_both(x), !is_bare_terrain(x)};
  };
  if (rank(t) == rank(u) ? u > t : rank(u) < rank(t)) return false;
  const auto between = gap(t, u);
  return between && is_one_place(t, u, *between);
}

bool Covers::is_behind(std::size_t t, std::size_t u) const {
  if (!is_opaque_[u] || faces_both(t) || are_of_one_body(t, u) || !may_replace(t, u)) return false;
  const auto between = gap(t, u);
  if (!between || !between->is_within(looked_at_m()) || is_one_place(t, u, *between)) return false;
  return between->mean > 0 || (between->mean == 0 && t > u);
}

bool Covers::comes_before(std::size_t t, std::size_t u) const {
  const auto between = gap(t, u);
  return between && between->least <= same_place_;
}

bool Covers::is_against(std::size_t t, std::size_t u) const {
  if (!is_opaque_[u] || faces_both(t) || dot(normal_[t], normal_[u]) >= 0) return false;
  const auto between = gap(t, u);
  if (!between || !between->is_within(contact_)) return false;
  if (between->mean >= -same_place_) return true;
  return !are_of_one_body(t, u) && reaches_before(t, bodies_.triangle_body[u]);
}

/// Whether all of a triangle lies on one side of a plane, further off than matters.
bool Covers::is_beyond_reach(std::size_t plane, std::size_t of) const {
  double least = 1e300, most = -1e300;
  for (const Vec3& corner : corners(of)) {
    least = std::min(least, distance(plane, corner));
    most = std::max(most, distance(plane, corner));
  }
  return least > reach_m() || most < -reach_m();
}

// Where they overlap, not where their planes do: the plane of a pane that is written in whole
// millimetres is centimetres off the far end of its wall.
std::optional<Covers::Gap> Covers::gap(std::size_t t, std::size_t u) const {
  constexpr double least_cosine = 0.5;
  constexpr double least_overlap = 1e-6;  // of the smaller one: less is an edge in common
  // The same for both of them, whichever asks.
  const std::size_t a = std::min(t, u), b = std::max(t, u);
  const double facing = dot(normal_[a], normal_[b]);
  if (std::abs(facing) < least_cosine) return {};
  if (is_beyond_reach(a, b) || is_beyond_reach(b, a)) return {};
  const std::vector<Vec3> shared = overlap(corners(a), normal_[a], corners(b));
  const double smaller = std::min(norm(mesh_.area_vector2(a)), norm(mesh_.area_vector2(b)));
  if (norm(area_vector2(shared)) <= least_overlap * smaller) return {};
  Gap of{1e300, -1e300, 0};
  for (const Vec3& p : shared) {
    const double before_a = distance(a, p);
    const double before = t == a || facing < 0 ? before_a : -before_a;
    of.least = std::min(of.least, before);
    of.most = std::max(of.most, before);
    of.mean += before / static_cast<double>(shared.size());
  }
  return of;
}

/// +1 where `u` lies above `p` and looks up, -1 down, else 0: the sum over a body is its inside.
/// 0.
int Covers::crossing_above(std::size_t u, Vec3 p) const {
  const int side = plumb_crossing(corners(u), p.x, p.y);
  return side != 0 && plane_height(u, p.x, p.y) > p.z ? side : 0;
}

bool Covers::is_solid_behind(std::size_t t, Vec3 at) const {
  if (!is_in_solid(t)) return false;
  const Vec3 p = at - looked_at_m() * normal_[t];
  int inside = 0;
  tree_.visit_meeting({p, {p.x, p.y, std::numeric_limits<double>::infinity()}}, [&](std::size_t u) {
    if (are_of_one_body(t, u)) inside += crossing_above(u, p);
  });
  return inside > 0;
}

/// Whether a body goes on before the front of `t`: one that begins just behind it, as of houses
/// that overlap by a millimetre. Sheets back to back do not.
bool Covers::reaches_before(std::size_t t, std::int32_t body) const {
  if (body < 0) return false;
  const auto b = static_cast<std::size_t>(body);
  for (std::size_t i = body_begin_[b]; i < body_begin_[b + 1]; ++i)
    for (const Vec3 corner : corners(of_body_[i]))
      if (distance(t, corner) > looked_at_m()) return true;
  return false;
}

Covers::Meets Covers::ending(std::size_t t, std::size_t u) const {
  const bool may_end = is_in_solid(u) || may_bury(t, u) || (is_land_[t] && seals(u)) ||
                       (is_relief(t) && open_houses_.is_wall(u)) || open_houses_.is_of_tight(u);
  if (!may_end || !is_cut(u, t)) return Meets::not_at_all;
  if (is_cut(t, u)) return Meets::through;
  const auto is_before = [&](Vec3 corner) { return distance(t, corner) > looked_at_m(); };
  const auto before = std::ranges::count_if(corners(u), is_before);
  return before > 0 && before < 3 ? Meets::up_to : Meets::not_at_all;
}

bool Covers::is_buried(std::size_t t, Vec3 at) const {
  const Vec3 p = at + looked_at_m() * normal_[t];
  const auto own = bodies_.triangle_body[t];
  // A cavity's fronts look into it: that is no part of the body around, where light may be.
  int inside = cavities_ == Cavities::lit && is_in_cavity(t) ? -1 : 0;
  bool is_below_land = false;
  tree_.visit_meeting({p, {p.x, p.y, 1e300}}, [&](std::size_t u) {
    const bool is_filled = cavities_ == Cavities::dark && is_in_cavity(u);
    if (is_in_solid(u) && bodies_.triangle_body[u] != own && !is_filled)
      inside += crossing_above(u, p);
    if (!is_below_land && may_bury(t, u)) {
      const auto z = height_at(mesh_, u, p.x, p.y);
      // Land that lies on land in millimetres is found as what is behind it; land that lies so near
      // to what looks up is found as what hides it (is_behind), from there on as what is above.
      const double above =
          is_land_[t] ? p.z - contact_ : std::min(p.z + contact_, std::max(p.z, at.z + contact_));
      is_below_land = z && *z > above && !(is_road_[u] && *z > p.z + road_bed_m);
    }
  });
  return inside > 0 || is_below_land || (is_land_[t] && is_sealed(p)) ||
         (is_relief(t) && open_houses_.hold(p)) || is_in_house_on_land(p);
}

/// Within a house that is open below alone, and closed there by land: at its lowest point, or above
/// that.
bool Covers::is_in_house_on_land(Vec3 p) const {
  const auto foot = open_houses_.foot_of_tight_holder(p);
  if (!foot) return false;
  bool is_on_land = false;
  tree_.visit_column(p.x, p.y, [&](std::size_t u) {
    if (!is_land_[u]) return;
    const auto z = height_at(mesh_, u, p.x, p.y);
    is_on_land |= z && *z > *foot - contact_;
  });
  return is_on_land;
}

/// Whether what lies below `u` is below land: of land another sheet, as where one terrain has finer
/// tiles, or streets, gardens and water lie on it.
bool Covers::may_bury(std::size_t t, std::size_t u) const {
  if (!is_land_[t]) return is_land_[u] != 0;
  return is_relief(t) && (is_relief(u) || is_road_[u]) && !are_of_one_body(t, u);
}

/// Land just below `p` under a floor, in the pocket that it closes, or inside of what stands on it:
/// above a floor that lies deeper something else of its object must be. Over a cellar land is open.
bool Covers::is_sealed(Vec3 p) const {
  if (seals_.empty()) return false;
  const double land = p.z - 3 * contact_;
  std::vector<ObjectId> floors_below, above;
  bool is_under_floor = false;
  tree_.visit_column(p.x, p.y, [&](std::size_t u) {
    if (is_land_[u]) return;
    const auto z = height_at(mesh_, u, p.x, p.y);
    if (!z) return;
    const bool is_floor = seals(u) && slope_of(mesh_, u) == Slope::downward;
    if (is_floor && *z >= land) is_under_floor = true;
    if (is_floor || *z > land)
      (*z > land ? above : floors_below).push_back(mesh_.triangle_object[u]);
  });
  return is_under_floor || std::ranges::any_of(floors_below, [&](ObjectId object) {
           return std::ranges::find(above, object) != above.end();
         });
}

/// Land of a kind that says so: what a file or a scene of rooms calls ground may be their floor.
bool Covers::is_relief(std::size_t t) const {
  return is_land_[t] && is_land(mesh_.object_kinds[mesh_.triangle_object[t].index()]);
}

/// Land that says nothing of what lies on it.
bool Covers::is_bare_terrain(std::size_t t) const {
  return is_land_[t] && mesh_.object_kinds[mesh_.triangle_object[t].index()] == "TINRelief";
}

bool Covers::is_in_solid(std::size_t t) const {
  const auto b = bodies_.triangle_body[t];
  return b >= 0 && is_solid_[static_cast<std::size_t>(b)] != 0;
}

void Covers::find_bodies() {
  body_begin_.assign(bodies_.bodies.size() + 1, 0);
  for (const auto b : bodies_.triangle_body)
    if (b >= 0) ++body_begin_[static_cast<std::size_t>(b) + 1];
  std::partial_sum(body_begin_.begin(), body_begin_.end(), body_begin_.begin());
  of_body_.resize(body_begin_.back());
  std::vector<std::size_t> next(body_begin_.begin(), body_begin_.end() - 1);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
    if (const auto b = bodies_.triangle_body[t]; b >= 0)
      of_body_[next[static_cast<std::size_t>(b)]++] = t;
  is_solid_ = solid_bodies(mesh_, bodies_, is_opaque_, contact_);
}

void Covers::find_land() {
  is_land_.assign(mesh_.triangle_count(), 0);
  is_road_.assign(mesh_.triangle_count(), 0);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    if (mesh_.triangle_surface[t] != Surface::ground || bodies_.is_closed(t)) continue;
    const auto& kind = mesh_.object_kinds[mesh_.triangle_object[t].index()];
    const bool may_be_bridge =
        kind == "Road" || kind == "Railway" || kind == "TransportSquare" || kind == "Waterway";
    if (is_opaque_[t] && mesh_.area_vector2(t).z > 0) (may_be_bridge ? is_road_ : is_land_)[t] = 1;
  }
}

void Covers::find_rims() {
  using Edge = std::array<std::int32_t, 2>;
  std::vector<std::pair<Edge, std::size_t>> edges;
  bool are_many = false;
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    if (!is_relief(t) && !is_road_[t]) continue;
    are_many |= !edges.empty() && !are_of_one_body(edges.front().second, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
      edges.push_back({{std::min(a, b), std::max(a, b)}, t});
    }
  }
  if (!are_many) return;
  std::ranges::sort(edges);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto& [edge, t] = edges[i];
    if ((i > 0 && edges[i - 1].first == edge) ||
        (i + 1 < edges.size() && edges[i + 1].first == edge))
      continue;
    rims_.push_back({{mesh_.vertices[static_cast<std::size_t>(edge[0])],
                      mesh_.vertices[static_cast<std::size_t>(edge[1])]},
                     t});
    boxes.push_back(box_around({rims_.back().ends[0], rims_.back().ends[1]}));
  }
  rim_tree_ = BoxTree(std::move(boxes));
}

bool Covers::is_in_cavity(std::size_t t) const {
  const auto b = bodies_.triangle_body[t];
  return bodies_.is_closed(t) && bodies_.bodies[static_cast<std::size_t>(b)].volume < 0;
}

bool Covers::is_cut(std::size_t plane, std::size_t of) const {
  bool above = false, below = false;
  for (int k = 0; k < 3; ++k) {
    const double d = distance(plane, mesh_.corner(of, k));
    above |= d > contact_;
    below |= d < -contact_;
  }
  return above && below;
}

double Covers::plane_height(std::size_t t, double x, double y) const {
  const Vec3 a = mesh_.corner(t, 0), n = normal_[t];
  return n.z == 0 ? a.z : a.z - (n.x * (x - a.x) + n.y * (y - a.y)) / n.z;
}

}  // namespace sunload
