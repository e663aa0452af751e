// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {
namespace {

// Normals of one plane differ by rounding; a crease angle of 0 still joins them.
constexpr double plane_cosine = 1e-9;

std::vector<Vec3> vectors(const std::vector<double>& flat) {
  std::vector<Vec3> points(flat.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return points;
}

/// For every vertex the first one in the same place.
std::vector<std::size_t> same_places(const std::vector<Vec3>& vertices) {
  std::vector<std::size_t> order(vertices.size()), place(vertices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::tuple(vertices[i].x, vertices[i].y, vertices[i].z);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(key(a), a) < std::tuple(key(b), b);
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    place[order[k]] =
        k > 0 && vertices[order[k]] == vertices[order[k - 1]] ? place[order[k - 1]] : order[k];
  return place;
}

}  // namespace

ResultPatches::ResultPatches(const ResultReader& result)
    : vertices(vectors(result.doubles("vertex_position"))),
      normal(vectors(result.doubles("patch_normal"))),
      area(result.doubles("patch_area")),
      object(result.integers("patch_object")),
      object_names(result.strings("object_name")),
      origin(result.origin()) {
  if (area.empty()) throw InputError({result.path()}, "no patches", "there is nothing to export");
  const auto flat = result.integers("patch_vertices");
  corners.resize(area.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
}

std::vector<std::array<double, 3>> corner_values(const ResultPatches& patches,
                                                 const std::vector<double>& values,
                                                 double crease_angle_deg) {
  const auto place = same_places(patches.vertices);
  std::vector<std::vector<std::size_t>> around(patches.vertices.size());
  for (std::size_t p = 0; p < patches.corners.size(); ++p)
    for (const auto vertex : patches.corners[p])
      around[place[static_cast<std::size_t>(vertex)]].push_back(p);
  const double least_cosine = std::cos(radians(crease_angle_deg)) - plane_cosine;
  std::vector<std::array<double, 3>> means(patches.corners.size());
  for (std::size_t p = 0; p < means.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0, area = 0;
      for (const auto q : around[place[static_cast<std::size_t>(patches.corners[p][k])]]) {
        if (std::isnan(values[q]) || dot(patches.normal[p], patches.normal[q]) < least_cosine)
          continue;
        sum += values[q] * patches.area[q];
        area += patches.area[q];
      }
      means[p][k] = area > 0 ? sum / area : std::nan("");
    }
  return means;
}

}  // namespace sunload
