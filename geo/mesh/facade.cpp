// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/facade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/edge_table.h"

namespace sunload {

namespace {

constexpr std::array<const char*, 8> compass_points{"north", "northeast", "east", "southeast",
                                                    "south", "southwest", "west", "northwest"};
// Values that decide an order or a name are rounded first, so that a last bit does not.
constexpr double area_digits = 1e6, angle_digits = 1e6, position_digits = 1e3;
// Of one face at one edge, of one region among those beside it: buildings have a handful. Where
// ten thousands share an edge or a place, all pairs would not fit into memory.
constexpr std::size_t most_neighbours = 200;

std::int64_t rounded(double value, double digits) { return std::llround(value * digits); }

/// Area, mean direction, centre and extent of a set of faces.
struct Extent {
  double area = 0;
  Vec3 area_vector, moment;  // m², m² m
  Box box;
  Vec3 direction() const {
    const double length = norm(area_vector);
    return length > 0 ? area_vector / length : Vec3{};
  }
  Vec3 centre() const { return moment / area; }
  void add(const Extent& other) {
    area += other.area;
    area_vector += other.area_vector;
    moment += other.moment;
    include(box, other.box.low);
    include(box, other.box.high);
  }
};

Extent extent_of(const Mesh& mesh, std::size_t t) {
  const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
  const Vec3 area_vector = mesh.area_vector2(t) / 2;
  const double area = norm(area_vector);
  return {area, area_vector, (a + b + c) * (area / 3), bounding_box({a, b, c})};
}

/// True where `other` faces as `first` does and lies near its plane.
bool is_in_line(const Extent& first, const Extent& other) {
  static const double least_cosine = std::cos(radians(facade_angle_deg));
  const Vec3 n = first.direction();
  return dot(n, other.direction()) >= least_cosine &&
         std::abs(dot(n, other.centre() - first.centre())) <= facade_offset_m;
}

bool is_near(const Box& a, const Box& b) {
  const auto gap = [](double low_a, double high_a, double low_b, double high_b) {
    return std::max(low_b - high_a, low_a - high_b);
  };
  return gap(a.low.x, a.high.x, b.low.x, b.high.x) <= facade_gap_m &&
         gap(a.low.y, a.high.y, b.low.y, b.high.y) <= facade_gap_m &&
         gap(a.low.z, a.high.z, b.low.z, b.high.z) <= facade_gap_m;
}

/// Indices 0 … n-1 by decreasing area; equal areas keep their order.
std::vector<std::size_t> by_area(const std::vector<Extent>& extents) {
  std::vector<std::size_t> order(extents.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return rounded(extents[a].area, area_digits) > rounded(extents[b].area, area_digits);
  });
  return order;
}

/// Lists of neighbours in one array.
struct Neighbours {
  std::vector<std::size_t> begin, items;
  Neighbours(std::size_t count, std::vector<std::pair<std::size_t, std::size_t>> pairs)
      : begin(count + 1, 0) {
    for (const auto& pair : pairs) ++begin[pair.first + 1], ++begin[pair.second + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    items.resize(2 * pairs.size());
    auto at = begin;
    for (const auto& [a, b] : pairs) items[at[a]++] = b, items[at[b]++] = a;
  }
  std::span<const std::size_t> of(std::size_t i) const {
    return std::span(items).subspan(begin[i], begin[i + 1] - begin[i]);
  }
};

struct Groups {
  std::vector<std::int32_t> group_of;  // -1: none
  std::vector<Extent> extents;
};

/// Grows groups from the largest items over neighbours in line with the first.
Groups grow_groups(const std::vector<Extent>& items, const Neighbours& neighbours,
                   double least_first_area) {
  Groups groups{std::vector<std::int32_t>(items.size(), -1), {}};
  std::vector<std::size_t> stack;
  for (const auto first : by_area(items)) {
    if (groups.group_of[first] >= 0 || items[first].area < least_first_area) continue;
    const auto group = static_cast<std::int32_t>(groups.extents.size());
    Extent extent;
    groups.group_of[first] = group;
    stack.push_back(first);
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      extent.add(items[i]);
      for (const auto j : neighbours.of(i)) {
        if (groups.group_of[j] >= 0 || !is_in_line(items[first], items[j])) continue;
        groups.group_of[j] = group;
        stack.push_back(j);
      }
    }
    groups.extents.push_back(extent);
  }
  return groups;
}

/// Faces that may be in a facade, numbered in the order of the mesh.
std::vector<std::size_t> candidates(const Mesh& mesh) {
  static const double largest_z = std::cos(radians(facade_slope_deg));
  std::vector<std::size_t> result;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Surface surface = mesh.triangle_surface[t];
    if (surface != Surface::wall && surface != Surface::window) continue;
    const Vec3 n2 = mesh.area_vector2(t);
    if (std::abs(n2.z) <= largest_z * norm(n2)) result.push_back(t);
  }
  return result;
}

Groups find_regions(const Mesh& mesh, const std::vector<std::size_t>& faces) {
  std::vector<std::uint8_t> included(mesh.triangle_count(), 0);
  std::vector<std::size_t> number(mesh.triangle_count(), 0);
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    included[faces[i]] = 1;
    number[faces[i]] = i;
    extents.push_back(extent_of(mesh, faces[i]));
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for_each_edge(edge_uses(mesh, included), [&](std::span<const EdgeUse> uses) {
    for (std::size_t i = 1; i < uses.size(); ++i) {
      for (std::size_t j = i - std::min(i, most_neighbours); j < i; ++j) {
        pairs.emplace_back(number[uses[j].triangle()], number[uses[i].triangle()]);
      }
    }
  });
  return grow_groups(extents, Neighbours(faces.size(), std::move(pairs)), 0);
}

/// Pairs of regions of one object whose boxes are near: a sweep along x.
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(
    const std::vector<Extent>& regions, const std::vector<ObjectId>& object_of) {
  std::vector<std::size_t> order(regions.size()), open;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(object_of[a].value, regions[a].box.low.x, a) <
           std::tuple(object_of[b].value, regions[b].box.low.x, b);
  });
  static const double least_cosine = std::cos(radians(2 * facade_angle_deg)) - 1e-9;  // rounding
  std::vector<Vec3> directions;
  for (const auto& region : regions) directions.push_back(region.direction());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto b : order) {
    std::erase_if(open, [&](std::size_t a) {
      return object_of[a] != object_of[b] ||
             regions[a].box.high.x + facade_gap_m < regions[b].box.low.x;
    });
    std::size_t count = 0;
    for (auto a = open.rbegin(); a != open.rend() && count < most_neighbours; ++a) {
      // Whether they are in line is asked again for the facade's first region; two that are in
      // line with one and the same are no more than twice the angle apart.
      if (!is_near(regions[*a].box, regions[b].box)) continue;
      if (dot(directions[*a], directions[b]) < least_cosine) continue;
      pairs.emplace_back(*a, b);
      ++count;
    }
    open.push_back(b);
  }
  return pairs;
}

int compass_point(double azimuth_deg) {
  const int count = static_cast<int>(compass_points.size());
  const double sector_deg = 360.0 / count;
  const double deg = static_cast<double>(rounded(azimuth_deg, angle_digits)) / angle_digits;
  return static_cast<int>(wrapped_deg(deg + sector_deg / 2) / sector_deg) % count;
}

int compass_of(const FoundFacade& facade, double north_deg) {
  return compass_point(facade.azimuth_deg + north_deg);
}

/// Puts facades in their final order and names them.
void order_and_name(std::vector<FoundFacade>& found, double north_deg,
                    const std::vector<std::string>& object_names) {
  const auto rank = [&](const FoundFacade& f) {
    return std::tuple(f.object.value, compass_of(f, north_deg), -rounded(f.area_m2, area_digits),
                      rounded(f.centre.x, position_digits), rounded(f.centre.y, position_digits),
                      rounded(f.centre.z, position_digits), f.group);
  };
  std::sort(found.begin(), found.end(),
            [&](const FoundFacade& a, const FoundFacade& b) { return rank(a) < rank(b); });
  for (std::size_t i = 0, n = 0; i < found.size(); ++i) {
    FoundFacade& f = found[i];
    const int compass = compass_of(f, north_deg);
    n = i > 0 && f.object == found[i - 1].object && compass == compass_of(found[i - 1], north_deg)
            ? n + 1
            : 1;
    f.name = object_names[f.object.index()] + "/" +
             compass_points[static_cast<std::size_t>(compass)] + "_" + std::to_string(n);
  }
}

std::vector<FoundFacade> found_in(const Groups& groups, const std::vector<ObjectId>& object_of) {
  std::vector<FoundFacade> found(groups.extents.size());
  for (std::size_t r = 0; r < object_of.size(); ++r) {
    const auto group = groups.group_of[r];
    if (group >= 0) found[static_cast<std::size_t>(group)].object = object_of[r];
  }
  for (std::size_t g = 0; g < found.size(); ++g) {
    const Extent& extent = groups.extents[g];
    found[g].azimuth_deg = horizontal(extent.area_vector).azimuth_deg;
    found[g].area_m2 = extent.area;
    found[g].centre = extent.centre();
    found[g].group = g;
  }
  return found;
}

}  // namespace

std::vector<FoundFacade> find_facades(Mesh& mesh, double north_deg) {
  const auto faces = candidates(mesh);
  const Groups regions = find_regions(mesh, faces);
  std::vector<ObjectId> object_of(regions.extents.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    object_of[static_cast<std::size_t>(regions.group_of[i])] = mesh.triangle_object[faces[i]];
  }
  const Groups groups = grow_groups(
      regions.extents, Neighbours(regions.extents.size(), near_pairs(regions.extents, object_of)),
      least_facade_area_m2);
  auto found = found_in(groups, object_of);
  order_and_name(found, north_deg, mesh.object_names);
  mesh.facades.clear();
  for (const FoundFacade& f : found)
    mesh.facades.push_back({f.name, f.object, f.area_m2, f.azimuth_deg});

  std::vector<FacadeId> facade_of(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) facade_of[found[i].group] = make_id<FacadeId>(i);
  mesh.triangle_facade.assign(mesh.triangle_count(), FacadeId::none());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto group = groups.group_of[static_cast<std::size_t>(regions.group_of[i])];
    if (group >= 0) mesh.triangle_facade[faces[i]] = facade_of[static_cast<std::size_t>(group)];
  }
  return found;
}

void turn_facades(Mesh& mesh, std::vector<FoundFacade>& found, double north_deg) {
  std::map<std::string, std::size_t> group_of;
  for (const FoundFacade& f : found) group_of[f.name] = f.group;
  order_and_name(found, north_deg, mesh.object_names);
  std::vector<std::size_t> old_of(found.size(), mesh.facades.size());  // by group; past all: gone
  for (std::size_t i = 0; i < mesh.facades.size(); ++i)
    old_of[group_of.at(mesh.facades[i].name)] = i;
  std::vector<Facade> turned;
  std::vector<FacadeId> new_id(mesh.facades.size());
  for (const FoundFacade& f : found) {
    const std::size_t old = old_of[f.group];
    if (old == mesh.facades.size()) continue;
    new_id[old] = make_id<FacadeId>(turned.size());
    turned.push_back(std::move(mesh.facades[old]));
    turned.back().name = f.name;
  }
  mesh.facades = std::move(turned);
  for (FacadeId& id : mesh.triangle_facade)
    if (id.exists()) id = new_id[id.index()];
}

}  // namespace sunload
