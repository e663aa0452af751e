// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/mesh_clean.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace sunload {

namespace {

template <class T>
void keep_items(std::vector<T>& items, const std::vector<std::uint8_t>& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (keep[i]) items[kept++] = items[i];
  }
  items.resize(kept);
}

/// True where the ascending order of the corners is a cyclic shift of theirs.
bool is_even(const std::array<std::int32_t, 3>& t) {
  const int descents = (t[0] > t[1]) + (t[1] > t[2]) + (t[2] > t[0]);
  return descents == 1;
}

}  // namespace

void keep_triangles(Mesh& mesh, const std::vector<std::uint8_t>& keep) {
  if (std::find(keep.begin(), keep.end(), 0) == keep.end()) return;
  keep_items(mesh.triangles, keep);
  keep_items(mesh.triangle_object, keep);
  keep_items(mesh.triangle_material, keep);
  keep_items(mesh.triangle_facade, keep);
  keep_items(mesh.triangle_surface, keep);
  keep_items(mesh.triangle_sides, keep);
}

void drop_unused_vertices(Mesh& mesh) {
  std::vector<std::int32_t> new_index(mesh.vertices.size(), -1);
  for (const auto& triangle : mesh.triangles) {
    for (const auto v : triangle) new_index[static_cast<std::size_t>(v)] = 0;
  }
  std::size_t kept = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (new_index[v] < 0) continue;
    new_index[v] = static_cast<std::int32_t>(kept);
    mesh.vertices[kept++] = mesh.vertices[v];
  }
  mesh.vertices.resize(kept);
  for (auto& triangle : mesh.triangles) {
    for (auto& v : triangle) v = new_index[static_cast<std::size_t>(v)];
  }
}

std::vector<std::size_t> first_in_place(const Mesh& mesh) {
  struct Key {
    std::int32_t object;
    std::array<std::int32_t, 3> corners;  // ascending
    std::size_t triangle;
  };
  std::vector<Key> keys(mesh.triangle_count());
  for (std::size_t t = 0; t < keys.size(); ++t) {
    keys[t] = {mesh.triangle_object[t].value, mesh.triangles[t], t};
    std::sort(keys[t].corners.begin(), keys[t].corners.end());
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.object, a.corners, a.triangle) < std::tie(b.object, b.corners, b.triangle);
  });
  std::vector<std::size_t> first(keys.size());
  for (std::size_t i = 0, begin = 0; i < keys.size(); ++i) {
    const Key &a = keys[begin], &b = keys[i];
    if (std::tie(a.object, a.corners) != std::tie(b.object, b.corners)) begin = i;
    first[b.triangle] = keys[begin].triangle;
  }
  return first;
}

bool looks_as(const Mesh& mesh, std::size_t a, std::size_t b) {
  return is_even(mesh.triangles[a]) == is_even(mesh.triangles[b]);
}

Duplicates drop_duplicates(Mesh& mesh, const std::vector<std::size_t>& place) {
  Duplicates result;
  result.faced_both_ways.assign(place.size(), 0);
  std::vector<std::uint8_t> keep(place.size(), 1);
  for (std::size_t t = 0; t < place.size(); ++t) {
    if (place[t] == t) continue;
    keep[t] = 0;
    ++result.dropped;
    if (!looks_as(mesh, t, place[t])) result.faced_both_ways[place[t]] = 1;
  }
  keep_triangles(mesh, keep);
  keep_items(result.faced_both_ways, keep);
  return result;
}

double aspect(const Mesh& mesh, std::size_t triangle) {
  double longest2 = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k);
    longest2 = std::max(longest2, dot(edge, edge));
  }
  const double doubled_area = norm(mesh.area_vector2(triangle));
  // height = 2 area / longest edge
  return doubled_area > 0 ? longest2 / doubled_area : std::numeric_limits<double>::infinity();
}

std::vector<std::uint8_t> with_area(const Mesh& mesh, double least_height_ratio) {
  std::vector<std::uint8_t> result(mesh.triangle_count());
  for (std::size_t t = 0; t < result.size(); ++t) {
    const double longest_over_height = aspect(mesh, t);
    result[t] = longest_over_height * least_height_ratio < 1 &&
                longest_over_height < std::numeric_limits<double>::infinity();
  }
  return result;
}

}  // namespace sunload
