// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/mesh.h"

#include <algorithm>

#include "geo/mesh/box_tree.h"

namespace sunload {

bool FileMaterial::set_diffuse(const std::array<double, 3>& rgb) {
  const double mean = (rgb[0] + rgb[1] + rgb[2]) / 3;
  if (!(mean >= 0 && mean <= 1)) return false;
  diffuse = mean;
  const bool is_grey = rgb[0] == rgb[1] && rgb[1] == rgb[2];
  const bool are_shares =
      std::all_of(rgb.begin(), rgb.end(), [](double c) { return c >= 0 && c <= 1; });
  diffuse_rgb = are_shares && !is_grey ? std::optional(rgb) : std::nullopt;
  return true;
}

void PolygonModel::add_polygon(const std::vector<std::vector<std::int32_t>>& rings,
                               Facts polygon_facts) {
  for (const auto& ring : rings) {
    ring_vertex.insert(ring_vertex.end(), ring.begin(), ring.end());
    ring_begin.push_back(static_cast<std::int64_t>(ring_vertex.size()));
  }
  polygon_ring.push_back(static_cast<std::int64_t>(ring_begin.size()) - 1);
  facts.push_back(polygon_facts);
}

void PolygonModel::add_triangle(std::int32_t a, std::int32_t b, std::int32_t c,
                                Facts polygon_facts) {
  for (const auto vertex : {a, b, c}) ring_vertex.push_back(vertex);
  ring_begin.push_back(static_cast<std::int64_t>(ring_vertex.size()));
  polygon_ring.push_back(static_cast<std::int64_t>(ring_begin.size()) - 1);
  facts.push_back(polygon_facts);
}

Box bounding_box(const std::vector<Vec3>& points) {
  Box box;
  for (const auto& p : points) {
    include(box, p);
  }
  return box;
}

}  // namespace sunload
