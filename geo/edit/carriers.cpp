// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/edit/carriers.h"

#include <map>
#include <utility>

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

}  // namespace

std::vector<std::optional<std::size_t>> carriers_of(const FamilyTree& tree,
                                                    const std::vector<ObjectExtent>& extents,
                                                    const ChosenObjects& chosen) {
  const auto tops = tops_of(tree);
  std::map<std::size_t, std::vector<std::size_t>> parts;  // by their topmost
  for (std::size_t o = 0; o < chosen.size(); ++o)
    if (chosen[o] != 0 && is_part_of_body(tree.kind(o))) parts[tops[o]].push_back(o);
  std::vector<std::optional<std::size_t>> carriers(chosen.size());
  for (const std::size_t place : tree.owners_first()) {
    if (place >= chosen.size() || chosen[place] == 0 || is_part_of_body(tree.kind(place))) continue;
    auto owner = body_owner(tree, place);
    if (!owner) continue;
    while (owner && (*owner >= chosen.size() || chosen[*owner] == 0))
      owner = body_owner(tree, *owner);
    if (owner)
      carriers[place] = carriers[*owner] ? carriers[*owner] : owner;
    else if (const auto found = parts.find(tops[place]); found != parts.end())
      carriers[place] =
          nearest_in_plan(found->second, plan_point(extents[place].middle()), extents);
  }
  return carriers;
}

}  // namespace sunload
