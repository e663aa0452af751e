// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/open_houses.h"

#include <algorithm>
#include <array>

#include "geo/mesh/open_below.h"
#include "geo/mesh/plumb_line.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr double far_away = 1e300;

using Corners = std::array<Vec3, 3>;

/// With the axis x, or y, upright.
Vec3 along_x(Vec3 p) { return {p.y, p.z, p.x}; }
Vec3 along_y(Vec3 p) { return {p.z, p.x, p.y}; }

/// On which side of `p`, along the axis that `turned` puts upright, the line through it meets the
/// triangle: +1, -1, or 0 not at all.
template <class Turned>
int side_of(const Corners& corners, Vec3 p, const Turned& turned) {
  const Corners c{turned(corners[0]), turned(corners[1]), turned(corners[2])};
  const Vec3 q = turned(p);
  if (plumb_crossing(c, q.x, q.y) == 0) return 0;
  const Vec3 n = cross(c[1] - c[0], c[2] - c[0]);
  const double at = c[0].z - (n.x * (q.x - c[0].x) + n.y * (q.y - c[0].y)) / n.z;
  return at > q.z ? 1 : -1;
}

}  // namespace

OpenHouses::OpenHouses(const Mesh& mesh, const Bodies& bodies,
                       const std::vector<std::uint8_t>& is_opaque)
    : mesh_(mesh),
      is_wall_(mesh.triangle_count(), 0),
      is_of_tight_(mesh.triangle_count(), 0),
      of_object_(mesh.object_names.size()) {
  is_tight_.assign(mesh.object_names.size(), 0);
  if (std::ranges::none_of(mesh.object_kinds, is_land)) return;
  const OpenBelow open_below(mesh, bodies);
  std::vector<std::uint8_t> has_roof(bodies.bodies.size(), 0);
  struct Has {
    bool walls = false, roof = false;
  };
  const auto may_belong = [&](std::size_t t) {
    const auto& kind = mesh.object_kinds[mesh.triangle_object[t].index()];
    return is_opaque[t] && !bodies.is_inner(t) && mesh.triangle_surface[t] != Surface::ground &&
           !is_land(kind) && !is_plant(kind) && !bodies.is_closed(t);
  };
  std::vector<Has> has(mesh.object_names.size());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!may_belong(t)) continue;
    const auto slope = slope_of(mesh, t);
    Has& of_object = has[mesh.triangle_object[t].index()];
    of_object.walls |= slope == Slope::upright;
    of_object.roof |= slope == Slope::upward;
    const auto body = bodies.triangle_body[t];
    if (open_below.has(body)) is_tight_[mesh.triangle_object[t].index()] = 1;
    if (body >= 0 && slope == Slope::upward) has_roof[static_cast<std::size_t>(body)] = 1;
  }
  const auto is_within = [&](std::size_t t) {
    const auto body = bodies.triangle_body[t];
    return is_tight_[mesh.triangle_object[t].index()] != 0 &&
           !(body >= 0 && has_roof[static_cast<std::size_t>(body)]);
  };
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Has of_object = has[mesh.triangle_object[t].index()];
    if (!of_object.walls || !of_object.roof || !may_belong(t) || is_within(t)) continue;
    is_wall_[t] = slope_of(mesh, t) == Slope::upright;
    is_of_tight_[t] = is_tight_[mesh.triangle_object[t].index()];
    triangle_.push_back(t);
    boxes.push_back(box_of(mesh, t));
    Box& of = of_object_[mesh.triangle_object[t].index()];
    include(of, boxes.back().low);
    include(of, boxes.back().high);
  }
  tree_ = BoxTree(std::move(boxes));
}

std::optional<double> OpenHouses::foot_of_tight_holder(Vec3 p) const {
  const auto found = holder(p);
  if (!found || !is_tight_[found->index()]) return {};
  return of_object_[found->index()].low.z;
}

std::optional<ObjectId> OpenHouses::holder(Vec3 p) const {
  std::vector<ObjectId> roofs;
  tree_.visit_meeting({p, {p.x, p.y, far_away}}, [&](std::size_t i) {
    const std::size_t t = triangle_[i];
    const ObjectId object = mesh_.triangle_object[t];
    if (std::ranges::find(roofs, object) != roofs.end()) return;
    if (const auto z = height_at(mesh_, t, p.x, p.y); z && *z > p.z) roofs.push_back(object);
  });
  const auto holder = std::ranges::find_if(roofs, [&](ObjectId o) { return enclose(o, p); });
  if (holder == roofs.end()) return {};
  return *holder;
}

bool OpenHouses::enclose(ObjectId object, Vec3 p) const {
  bool is_odd[4] = {};  // east, west, north, south
  const auto count = [&](const Box& line, std::size_t ahead, const auto& turned) {
    tree_.visit_meeting(line, [&](std::size_t i) {
      const std::size_t t = triangle_[i];
      if (mesh_.triangle_object[t] != object) return;
      const int side = side_of(mesh_.corners(t), p, turned);
      if (side != 0) {
        bool& odd = is_odd[side > 0 ? ahead : ahead + 1];
        odd = !odd;
      }
    });
  };
  const auto& [low, high] = of_object_[object.index()];
  count({{low.x, p.y, p.z}, {high.x, p.y, p.z}}, 0, along_x);
  count({{p.x, low.y, p.z}, {p.x, high.y, p.z}}, 2, along_y);
  return is_odd[0] && is_odd[1] && is_odd[2] && is_odd[3];
}

}  // namespace sunload
