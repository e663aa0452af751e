// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/occluders.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "geo/mesh/weld.h"

namespace sunload {

Occluders::Occluders(const Mesh& mesh, std::span<const float> transmittance)
    : transmittance_(transmittance.begin(), transmittance.end()) {
  Welded welded = weld(mesh.vertices, std::vector<std::uint8_t>(mesh.vertices.size(), 1), 0);
  const auto number = [&](std::int32_t vertex) {
    return static_cast<std::uint32_t>(welded.new_index[static_cast<std::size_t>(vertex)]);
  };
  for (const auto& t : mesh.triangles)
    corners_.push_back({number(t[0]), number(t[1]), number(t[2])});
  point_ = std::move(welded.vertices);
  find_edges();
}

void Occluders::find_edges() {
  struct Edge {
    std::uint32_t a, b, triangle, k;
    bool operator<(const Edge& e) const {
      return std::tie(a, b, triangle, k) < std::tie(e.a, e.b, e.triangle, e.k);
    }
  };
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < corners_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(corners_[t][k], corners_[t][(k + 1) % 3]);
      edges.push_back({a, b, static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(k)});
    }
  std::sort(edges.begin(), edges.end());
  edge_.resize(corners_.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i == 0 || edges[i].a != edges[i - 1].a || edges[i].b != edges[i - 1].b)
      edge_begin_.push_back(static_cast<std::uint32_t>(i));
    edge_[edges[i].triangle][edges[i].k] = static_cast<std::uint32_t>(edge_begin_.size() - 1);
    at_edge_.push_back(static_cast<std::int32_t>(edges[i].triangle));
  }
  edge_begin_.push_back(static_cast<std::uint32_t>(edges.size()));
}

std::span<const std::int32_t> Occluders::at_edge(std::size_t triangle, std::size_t k) const {
  const std::uint32_t edge = edge_[triangle][k];
  return std::span(at_edge_).subspan(edge_begin_[edge], edge_begin_[edge + 1] - edge_begin_[edge]);
}

}  // namespace sunload
