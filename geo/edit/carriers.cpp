// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/edit/carriers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/plan_lines.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

/// What a place belongs to, but for what stands apart.
std::optional<std::size_t> body_owner(const FamilyTree& tree, std::size_t place) {
  const auto owner = tree.owner(place);
  return owner && holds_others_apart(tree.kind(*owner)) ? std::nullopt : owner;
}

/// Of each place the topmost that it belongs to.
std::vector<std::size_t> tops_of(const FamilyTree& tree) {
  std::vector<std::size_t> tops(tree.size());
  for (const std::size_t place : tree.owners_first()) {
    const auto owner = body_owner(tree, place);
    tops[place] = owner ? tops[*owner] : place;
  }
  return tops;
}

std::optional<std::size_t> nearest_in_plan(const std::vector<std::size_t>& bodies, Point2 place,
                                           const std::vector<ObjectExtent>& extents) {
  const auto nearness = [&](std::size_t body) {
    const Vec3 size = extents[body].box.high - extents[body].box.low;
    return std::pair(distance_in_plan(extents[body], place), size.x * size.y);
  };
  std::optional<std::size_t> nearest;
  for (const std::size_t body : bodies)
    if (!nearest || nearness(body) < nearness(*nearest)) nearest = body;
  return nearest;
}

/// A part of a building: the lower edges of its walls, and its faces that lean.
struct BuildingPart {
  std::size_t place;
  std::vector<LooseFace> leaning;
  struct LowerEdge {
    Segment ends;
    Vec3 middle, across;  ///< away from the wall, level, of unit length
    double length_m;
  };
  std::vector<LowerEdge> lower;
};

BuildingPart building_part(const PolygonModel& model, std::size_t place) {
  const double steepest = std::cos(radians(upright_slope_deg));
  BuildingPart part{place, {}, {}};
  for (LooseFace& face : faces_of(model, make_id<ObjectId>(place))) {
    const Vec3 area = area_vector2(face);
    const double size = norm(area);
    if (size <= 0) continue;
    if (std::abs(area.z) > steepest * size) {
      part.leaning.push_back(std::move(face));
      continue;
    }
    const auto& ring = face.rings.front();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 a = ring[i], way = ring[(i + 1) % ring.size()] - a;
      const double length = std::hypot(way.x, way.y);
      constexpr double shortest_m = 1e-3;
      if (length < shortest_m || cross(area, way).z <= 0) continue;  // the wall is not above it
      part.lower.push_back({{a, a + way}, a + way * 0.5, Vec3{way.y, -way.x, 0} / length, length});
    }
  }
  // Of walls one above the other the lower edges of the upper ones are none of the part's.
  std::vector<Segment> lines;
  for (const auto& edge : part.lower) lines.push_back(edge.ends);
  const PlanLines all(lines);
  std::erase_if(part.lower, [&](const auto& edge) {
    constexpr double beside_m = 0.05;
    bool is_on_wall = false;
    all.visit_within(edge.middle.x, edge.middle.y, beside_m, [&](const NearestOnLine& below) {
      is_on_wall = is_on_wall || below.z < edge.middle.z - beside_m;
    });
    return is_on_wall;
  });
  return part;
}

/// Whether a face that leans is just below a place, at it, or above it by no more than towers are
/// drawn into what they stand on.
bool supports(const LooseFace& face, Vec3 p) {
  constexpr double touching_m = 0.3, sunk_m = 1;
  if (!holds_in_plan(face.rings, plan_point(p), plan_point)) return false;
  const Vec3 area = area_vector2(face), o = face.rings.front().front();
  const double z = o.z - (area.x * (p.x - o.x) + area.y * (p.y - o.y)) / area.z;
  return z > p.z - touching_m && z < p.z + sunk_m;
}

/// Share of the lower edges of `upper` that stand on `lower`, above its foot.
double share_on(const BuildingPart& upper, const BuildingPart& lower, double foot_m) {
  // A roof ends at what stands on it, or goes on below.
  constexpr double beside_m = 0.1, above_foot_m = 0.5;
  double on = 0, all = 0;
  for (const auto& edge : upper.lower) {
    all += edge.length_m;
    if (edge.middle.z < foot_m + above_foot_m) continue;
    const bool is_on = std::ranges::any_of(lower.leaning, [&](const LooseFace& face) {
      return supports(face, edge.middle + edge.across * beside_m) ||
             supports(face, edge.middle - edge.across * beside_m);
    });
    if (is_on) on += edge.length_m;
  }
  return all > 0 ? on / all : 0;
}

/// Whether in plan one is about as large as what it stands on.
bool covers(const Box& upper, const Box& lower) {
  constexpr double nearly_all = 0.9;
  return shared_plan_m2(upper, lower) > nearly_all * shared_plan_m2(lower, lower);
}

/// Of the lower parts that carry one, all together more than half of its edges, the one with most.
std::optional<std::size_t> carrier_of(const std::vector<BuildingPart>& parts, std::size_t upper,
                                      const std::vector<ObjectExtent>& extents,
                                      std::optional<double> from_m) {
  constexpr double half = 0.5;
  double most = 0, all = 0;
  std::optional<std::size_t> carrier;
  for (std::size_t l = 0; l < upper; ++l) {
    const Box& box = extents[parts[l].place].box;
    if (from_m && box.high.z < box.low.z + *from_m) continue;
    const double share = share_on(parts[upper], parts[l], box.low.z);
    all += share;
    if (share <= most) continue;
    most = share;
    carrier = parts[l].place;
  }
  return all > half ? carrier : std::nullopt;
}

/// Of bodies of one building those that stand on another one, the lowest first.
void find_stacked(const PolygonModel& model, std::vector<std::size_t> places,
                  const std::vector<ObjectExtent>& extents, std::optional<double> from_m,
                  Carriers& carriers) {
  if (places.size() < 2) return;
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return extents[a].box.low.z < extents[b].box.low.z;
  });
  std::vector<BuildingPart> parts;
  parts.reserve(places.size());
  for (const std::size_t place : places) parts.push_back(building_part(model, place));
  for (std::size_t u = 1; u < parts.size(); ++u)
    if (const auto lower = carrier_of(parts, u, extents, from_m)) {
      const bool is_covered = covers(extents[parts[u].place].box, extents[*lower].box);
      if (is_covered) carriers.is_covered[*lower] = 1;
      const auto carrier = carriers.of[*lower] ? carriers.of[*lower] : *lower;
      carriers.of[parts[u].place] = is_covered ? carriers.of[*lower] : carrier;
    }
}

}  // namespace

Carriers carriers_of(const FamilyTree& tree, const PolygonModel& model, const ChosenObjects& chosen,
                     std::optional<double> from_m) {
  const auto extents = extents_of(model);
  const auto tops = tops_of(tree);
  std::map<std::size_t, std::vector<std::size_t>> parts;  // by their topmost
  for (std::size_t o = 0; o < chosen.size(); ++o)
    if (chosen[o] != 0 && is_part_of_body(tree.kind(o))) parts[tops[o]].push_back(o);
  Carriers carriers{std::vector<std::optional<std::size_t>>(chosen.size()),
                    ChosenObjects(chosen.size(), 0)};
  for (const auto& [top, of_building] : parts) {
    auto bodies = of_building;
    if (top < chosen.size() && chosen[top] != 0 && !is_part_of_body(tree.kind(top)))
      bodies.push_back(top);  // it has surfaces of its own
    find_stacked(model, bodies, extents, from_m, carriers);
  }
  for (const std::size_t place : tree.owners_first()) {
    if (place >= chosen.size() || chosen[place] == 0 || is_part_of_body(tree.kind(place))) continue;
    auto owner = body_owner(tree, place);
    if (!owner) continue;
    while (owner && (*owner >= chosen.size() || chosen[*owner] == 0))
      owner = body_owner(tree, *owner);
    if (!owner)
      if (const auto found = parts.find(tops[place]); found != parts.end())
        owner = nearest_in_plan(found->second, plan_point(extents[place].middle()), extents);
    if (owner) carriers.of[place] = carriers.of[*owner] ? carriers.of[*owner] : owner;
  }
  // What sits on a body that stays does so, too; a part beside what covers it is raised by itself.
  for (std::size_t o = 0; o < chosen.size(); ++o) {
    if (!carriers.of[o] || carriers.is_covered[*carriers.of[o]] == 0) continue;
    if (!is_part_of_body(tree.kind(o))) carriers.is_covered[o] = 1;
    carriers.of[o].reset();
  }
  return carriers;
}

}  // namespace sunload
