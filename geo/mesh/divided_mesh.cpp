// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/divided_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunload {

std::int32_t NewVertices::of(const std::array<double, 3>& at) {
  std::array<std::int64_t, 3> key{};
  for (std::size_t k = 0; k < 3; ++k) key[k] = std::llround(at[k] / grid_m_);
  const auto [entry, is_new] = known_.try_emplace(key, static_cast<std::int32_t>(vertices_.size()));
  if (is_new) vertices_.push_back({at[0], at[1], at[2]});
  return entry->second;
}

DividedMesh::DividedMesh(Mesh& mesh, Bodies& bodies, double grid_m)
    : mesh_(mesh),
      bodies_(bodies),
      vertices_(mesh.vertices, grid_m),
      is_facade_less_(mesh.facades.size(), 0) {}

void DividedMesh::divide(std::size_t t, const std::vector<TrianglePart>& parts) {
  for (const TrianglePart& part : parts) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = part.old[k] >= 0 ? part.old[k] : vertices_.of(part.corners[k]);
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      add(t, corners, part.state);
  }
  ++cut_;
}

void DividedMesh::note_taker(std::size_t t, std::size_t by) {
  if (taken_.area_m2 == 0) taken_.first = {by, t};
}

CoveredCut DividedMesh::finish() {
  const auto taken = [&](auto& list) {
    auto old = std::move(list);
    list.clear();
    list.reserve(source_.size());
    for (const auto t : source_) list.push_back(old[t]);
  };
  const auto covered =
      static_cast<std::size_t>(std::count(is_covered_.begin(), is_covered_.end(), 1));
  mesh_.triangles = std::move(triangles_);
  taken(mesh_.triangle_object);
  taken(mesh_.triangle_material);
  taken(mesh_.triangle_facade);
  taken(mesh_.triangle_surface);
  taken(mesh_.triangle_sides);
  taken(bodies_.triangle_body);
  mesh_.triangle_covered = covered > 0 ? std::move(is_covered_) : std::vector<std::uint8_t>{};
  take_from_facades();
  return {std::move(source_), cut_, covered, taken_};
}

void DividedMesh::add(std::size_t t, const std::array<std::int32_t, 3>& corners, CoverState state) {
  const FacadeId facade = mesh_.triangle_facade[t];
  if (state != CoverState::open && facade.exists()) is_facade_less_[facade.index()] = 1;
  if (state == CoverState::taken) {
    const auto at = [&](std::size_t k) {
      return mesh_.vertices[static_cast<std::size_t>(corners[k])];
    };
    taken_.area_m2 += norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
    return;
  }
  triangles_.push_back(corners);
  source_.push_back(t);
  is_covered_.push_back(state == CoverState::covered);
}

void DividedMesh::take_from_facades() {
  std::vector<double> left(mesh_.facades.size(), 0);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
    if (mesh_.triangle_facade[t].exists() && !mesh_.is_covered(t))
      left[mesh_.triangle_facade[t].index()] += mesh_.area_m2(t);
  std::vector<FacadeId> new_id(mesh_.facades.size(), FacadeId::none());
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh_.facades.size(); ++f) {
    if (left[f] == 0) continue;
    if (is_facade_less_[f]) mesh_.facades[f].area_m2 = left[f];
    new_id[f] = make_id<FacadeId>(kept);
    if (kept != f) mesh_.facades[kept] = std::move(mesh_.facades[f]);
    ++kept;
  }
  mesh_.facades.resize(kept);
  for (FacadeId& id : mesh_.triangle_facade)
    if (id.exists()) id = new_id[id.index()];
}

}  // namespace sunload
