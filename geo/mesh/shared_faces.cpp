// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/shared_faces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "geo/base/together.h"
#include "geo/base/units.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/mesh_clean.h"
#include "geo/mesh/orient.h"

namespace sunload {

namespace {

constexpr std::size_t most_passes = 32;  // over all triangles, in search of bodies

/// Triangles of one object with the same corners that look the same way.
class Copies {
 public:
  Copies(const Mesh& mesh, const std::vector<std::size_t>& place)
      : kind_(place.size()), count_(2 * place.size(), 0) {
    for (std::size_t t = 0; t < place.size(); ++t) {
      kind_[t] = 2 * place[t] + (looks_as(mesh, t, place[t]) ? 0 : 1);
      ++count_[kind_[t]];
    }
  }
  /// Whether there is another one.
  bool has(std::size_t t) const { return count_[kind_[t]] > 1; }
  void take_out(std::size_t t) { --count_[kind_[t]]; }

 private:
  std::vector<std::size_t> kind_, count_;
};

/// Per triangle 1 where its object has some of them.
std::vector<std::uint8_t> of_objects_with(const Copies& copies, const Mesh& mesh) {
  std::vector<std::uint8_t> has(mesh.object_names.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (copies.has(t)) has[mesh.triangle_object[t].index()] = 1;
  std::vector<std::uint8_t> result(mesh.triangle_count());
  for (std::size_t t = 0; t < result.size(); ++t) result[t] = has[mesh.triangle_object[t].index()];
  return result;
}

/// Finds the bodies one after the other: what is found is gone for those that come later.
class SharingBodies {
 public:
  SharingBodies(const Mesh& mesh, const std::vector<std::size_t>& place)
      : mesh_(mesh),
        place_(place),
        copies_(mesh, place),
        uses_(edge_uses(mesh, of_objects_with(copies_, mesh))),
        edge_of_(3 * mesh.triangle_count(), 0),
        sheet_(mesh.triangle_count()),
        members_(mesh.triangle_count()),
        number_(mesh.triangle_count(), 0),
        was_asked_(mesh.triangle_count(), 0),
        is_in_body_(mesh.triangle_count(), 0) {
    find_edges();
    find_sheets();
  }

  /// Per triangle the number of its body, from 1 on; 0 for what is left.
  std::vector<std::uint32_t> find() {
    for (std::size_t t = 0; t < number_.size(); ++t) {
      if (!copies_.has(t) || added_ > most_passes * number_.size()) continue;
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h)
        for (const EdgeUse& use : edges_[edge_of_[h]]) ask(use.triangle());
    }
    return number_;
  }
  std::size_t count() const { return count_; }

 private:
  void find_edges() {
    for_each_edge(uses_, [&](std::span<const EdgeUse> uses) {
      for (const EdgeUse& use : uses)
        edge_of_[use.half_edge] = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back(uses);
    });
    excess_.assign(edges_.size(), 0);
  }

  /// What hangs together by edges that two triangles have alone.
  void find_sheets() {
    Together together(mesh_.triangle_count());
    for (const auto& uses : edges_)
      if (uses.size() == 2 && place_[uses[0].triangle()] != place_[uses[1].triangle()] &&
          !are_feet_that_touch(mesh_, uses))
        together.join(uses[0].triangle(), uses[1].triangle());
    for (std::size_t t = 0; t < sheet_.size(); ++t) {
      sheet_[t] = together.of(t);
      members_[sheet_[t]].push_back(t);
    }
  }

  /// Whether a body begins at this triangle, beside a face that is there twice.
  void ask(std::size_t t) {
    if (copies_.has(t) || number_[t] != 0 || was_asked_[t]) return;
    begin_body(t);
    if (does_close() && has_copies() && does_leave_closed() && has_volume()) {
      ++count_;
      for (const auto u : body_) {
        number_[u] = count_;
        copies_.take_out(u);
      }
    }
    for (const auto u : body_) was_asked_[u] = 1;
  }

  void begin_body(std::size_t t) {
    for (const auto e : body_edges_) excess_[e] = 0;
    for (const auto u : body_) is_in_body_[u] = 0;
    body_edges_.clear();
    body_.clear();
    add_sheet_of(t);
  }

  void add_sheet_of(std::size_t triangle) {
    for (const auto t : members_[sheet_[triangle]]) {
      is_in_body_[t] = 1;
      body_.push_back(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t e = edge_of_[3 * t + k];
        excess_[e] += mesh_.triangles[t][k] < mesh_.triangles[t][(k + 1) % 3] ? 1 : -1;
        body_edges_.push_back(e);
      }
    }
    added_ += members_[sheet_[triangle]].size();
  }

  /// Goes on until every edge is walked as often up as down, or is a foot.
  bool does_close() {
    for (std::size_t i = 0; i < body_edges_.size(); ++i) {
      const std::uint32_t e = body_edges_[i];
      if (excess_[e] == 0) continue;
      if (const auto next = next_at(e))
        add_sheet_of(*next);
      else if (!is_foot(e))
        return false;
    }
    return true;
  }

  /// Of those that walk the edge as the body does not yet the one by which its inside is least.
  std::optional<std::size_t> next_at(std::uint32_t e) const {
    const std::span<const EdgeUse> uses = edges_[e];
    const bool is_up = excess_[e] > 0;
    const std::vector<double> angles = angles_about(mesh_, uses);
    std::optional<std::size_t> best;
    double least = 2 * pi - same_angle;  // from there on it lies before the front
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (!is_of_body(uses[i]) || walks_up(mesh_, uses[i]) != is_up) continue;
      for (std::size_t k = 0; k < uses.size(); ++k) {
        if (walks_up(mesh_, uses[k]) == is_up || !may_be_added(uses[k], uses)) continue;
        double inside = is_up ? angles[i] - angles[k] : angles[k] - angles[i];
        if (inside < 0) inside += 2 * pi;
        if (inside <= same_angle || inside >= least) continue;
        least = inside;
        best = uses[k].triangle();
      }
    }
    return best;
  }

  bool is_of_body(const EdgeUse& use) const { return is_in_body_[use.triangle()] != 0; }
  bool is_left(const EdgeUse& use) const { return number_[use.triangle()] == 0; }

  /// A body has a face once.
  bool may_be_added(const EdgeUse& use, std::span<const EdgeUse> uses) const {
    return is_left(use) && std::ranges::none_of(uses, [&](const EdgeUse& other) {
             return is_of_body(other) && place_[other.triangle()] == place_[use.triangle()];
           });
  }

  bool is_foot(std::uint32_t e) const {
    return std::abs(excess_[e]) == 1 && std::ranges::all_of(edges_[e], [&](const EdgeUse& use) {
             return !is_left(use) || is_foot_of_wall(mesh_, use);
           });
  }

  bool has_copies() const {
    return std::ranges::any_of(body_, [&](std::size_t t) { return copies_.has(t); });
  }

  bool does_leave_closed() const {
    return std::ranges::all_of(body_edges_, [&](std::uint32_t e) {
      int excess = 0;
      for (const EdgeUse& use : edges_[e])
        if (is_left(use)) excess += walks_up(mesh_, use) ? 1 : -1;
      return excess == 0 || is_foot(e);
    });
  }

  /// As if it were closed at its lowest point.
  bool has_volume() const {
    Vec3 foot = mesh_.corner(body_[0], 0);
    for (const auto t : body_)
      for (int k = 0; k < 3; ++k) foot.z = std::min(foot.z, mesh_.corner(t, k).z);
    double volume6 = 0, area = 0;
    for (const auto t : body_) {
      volume6 += dot(mesh_.corner(t, 0) - foot, mesh_.area_vector2(t));
      area += mesh_.area_m2(t);
    }
    return encloses(std::abs(volume6) / 6, area);
  }

  const Mesh& mesh_;
  const std::vector<std::size_t>& place_;
  Copies copies_;  ///< that are left
  std::vector<EdgeUse> uses_;
  std::vector<std::span<const EdgeUse>> edges_;
  std::vector<std::uint32_t> edge_of_;             ///< per half-edge
  std::vector<std::size_t> sheet_;                 ///< per triangle one that stands for it
  std::vector<std::vector<std::size_t>> members_;  ///< of what stands for a sheet
  std::vector<std::uint32_t> number_;
  std::uint32_t count_ = 0;
  std::vector<std::uint8_t> was_asked_;  ///< or belonged to a body that was
  std::size_t added_ = 0;                ///< triangles, of all bodies asked
  // The body in question:
  std::vector<std::size_t> body_;
  std::vector<std::uint8_t> is_in_body_;
  std::vector<std::uint32_t> body_edges_;
  std::vector<int> excess_;  ///< per edge how much more often the body walks it up than down
};

/// Perhaps only such that look the other way.
bool has_copies(const std::vector<std::size_t>& place) {
  for (std::size_t t = 0; t < place.size(); ++t)
    if (place[t] != t) return true;
  return false;
}

}  // namespace

std::size_t part_bodies_that_share_faces(Mesh& mesh, const std::vector<std::size_t>& place) {
  if (!has_copies(place)) return 0;
  SharingBodies bodies(mesh, place);
  const std::vector<std::uint32_t> number = bodies.find();
  std::map<std::pair<std::uint32_t, std::int32_t>, std::int32_t> corner_of_body;
  for (std::size_t t = 0; t < number.size(); ++t) {
    if (number[t] == 0) continue;
    for (auto& v : mesh.triangles[t]) {
      const auto [corner, is_new] = corner_of_body.try_emplace(
          {number[t], v}, static_cast<std::int32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(Vec3{mesh.vertices[static_cast<std::size_t>(v)]});
      v = corner->second;
    }
  }
  return bodies.count();
}

}  // namespace sunload
