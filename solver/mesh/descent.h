// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The way down a tree of elements to the leaf that holds a point, of many points side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geo/base/check.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// How an element is split, small enough for many of them to stay near the processor: of inner
/// ones 4 · first child (its sibling follows) + the corner opposite of the split edge; of leaves
/// -1 - a number of theirs.
using Split = std::int32_t;

/// Elements of a forest, so that their splits fit.
inline constexpr std::size_t most_elements = std::size_t{1} << 29;

/// Packets whose points are looked for together: steps wait for each other's loads, and what the
/// processor does meanwhile are the other packets.
inline constexpr std::size_t packets_together = 2;

/// Points of elements on their way down: each by the element's split and the weights of its
/// corners, in units that halves divide without rounding.
template <std::size_t lanes>
struct PointColumns {
  static constexpr double unit = 1 << 30;
  alignas(64) std::int32_t split[lanes], w0[lanes], w1[lanes], w2[lanes];

  /// The point of weights u and v of corners 1 and 2, in the element that is split like this.
  void put(std::size_t place, Split root, double u, double v) {
    // What rounding puts beyond an edge lies on it.
    const auto whole = [](double w) { return static_cast<std::int32_t>(std::max(0.0, w) * unit); };
    split[place] = root;
    w1[place] = whole(u);
    w2[place] = whole(v);
    w0[place] = std::max(0, static_cast<std::int32_t>(unit) - w1[place] - w2[place]);
  }
  void put_nothing(std::size_t place) {
    constexpr Split in_a_leaf = -1;
    put(place, in_a_leaf, 0, 0);
  }
};
using PointsTogether = PointColumns<packets_together * packet_size>;

/// To the halves that hold them, until all are in leaves. `splits`: of every element.
void descend(const Split* splits, PointsTogether& points);
void descend(const Split* splits, PointColumns<1>& point);

/// Numbers of the leaves that hold what the rays of up to `packets_together` have met, one packet
/// after the other. `root_of(packet, ray)`: the element to begin with; -1, as where a ray has met
/// nothing: none, and none is the leaf.
template <class RootOf>
void find_leaves(std::span<const Split> splits, std::span<const PacketHits> hits,
                 const RootOf& root_of, std::int32_t* leaf) {
  SUNLOAD_EXPECT(hits.size() <= packets_together, "packets fit side by side");
  PointsTogether points;
  const std::size_t count = hits.size() * packet_size;
  for (std::size_t place = 0; place < packets_together * packet_size; ++place) {
    if (place >= count) {
      points.put_nothing(place);
      continue;
    }
    const PacketHits& of = hits[place / packet_size];
    const std::size_t l = place % packet_size;
    const std::int32_t root = root_of(of, l);
    leaf[place] = root;
    if (root >= 0)
      points.put(place, splits[static_cast<std::size_t>(root)], static_cast<double>(of.u[l]),
                 static_cast<double>(of.v[l]));
    else
      points.put_nothing(place);  // u and v are anything
  }
  descend(splits.data(), points);
  for (std::size_t place = 0; place < count; ++place)
    if (leaf[place] >= 0) leaf[place] = -1 - points.split[place];
}

}  // namespace sunload
