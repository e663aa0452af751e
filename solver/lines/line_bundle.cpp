// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/line_bundle.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/base/counting_sort.h"
#include "solver/mesh/linked_element.h"

namespace sunload {

namespace {

/// The directions' octahedron, unfolded to a square of 16 × 16 cells, about 160 of which make a
/// hemisphere (Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit
/// Vectors). Their numbers fill a byte.
constexpr std::int32_t cells_per_side = 16;

/// Bits x3 x2 x1 x0 to x3 0 x2 0 x1 0 x0.
constexpr std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 2) & 0x33;
  return (x | x << 1) & 0x55;
}

/// Along the Morton curve, so that neighbouring cells are mostly near each other.
std::uint8_t direction_cell(Vec3 w) {
  const double scale = 1 / (std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
  const double x = w.x * scale, y = w.y * scale;
  const double folded_x = std::copysign(1 - std::abs(y), x);
  const double folded_y = std::copysign(1 - std::abs(x), y);
  const auto coordinate = [](double c) {
    const auto cell = static_cast<std::int32_t>((c + 1) * (0.5 * cells_per_side));
    return static_cast<std::uint32_t>(std::min(cell, cells_per_side - 1));
  };
  return static_cast<std::uint8_t>(spread_bits(coordinate(w.z < 0 ? folded_x : x)) |
                                   spread_bits(coordinate(w.z < 0 ? folded_y : y)) << 1);
}

}  // namespace

void LineBundle::clear() {
  lines_.clear();
  largest_link_.clear();
}

void LineBundle::add(const PatchLines& lines, std::size_t count, double largest_link) {
  largest_link_.insert(largest_link_.end(), count, largest_link);
  PatchLines::Line packet[packet_size];
  for (std::size_t first = 0; first < count; first += packet_size) {
    lines.packet(first, packet);
    lines_.insert(lines_.end(), packet, packet + std::min(packet_size, count - first));
  }
}

void LineBundle::sort_by_direction() {
  cell_.resize(lines_.size());
  for (std::size_t i = 0; i < lines_.size(); ++i) cell_[i] = direction_cell(lines_[i].w);
  in_order_.resize(lines_.size());
  std::iota(in_order_.begin(), in_order_.end(), 0u);
  sort_by_byte(in_order_, order_, [this](std::uint32_t line) { return cell_[line]; });
}

void LineBundle::cast(const RayCaster& caster, const Hierarchy& hierarchy) {
  sort_by_direction();
  met_.resize(lines_.size());
  Packet origins{};
  PacketDirections directions{};
  for (std::size_t first = 0; first < order_.size(); first += packet_size) {
    const std::size_t count = std::min(packet_size, order_.size() - first);
    for (std::size_t l = 0; l < count; ++l) {
      put(origins, l, lines_[order_[first + l]].origin);
      put(directions, l, lines_[order_[first + l]].w);
    }
    const PacketHits hits =
        caster.first_hits(origins, directions, (1u << count) - 1u, RayCaster::Coherence::parallel);
    put_met(hits, std::span(order_).subspan(first, count), hierarchy);
  }
}

void LineBundle::put_met(const PacketHits& hits, std::span<const std::uint32_t> lines,
                         const Hierarchy& hierarchy) {
  LinkedPoints points;
  std::uint32_t element[packet_size];
  hierarchy.patches_at(hits, points.patch);
  for (std::size_t l = 0; l < packet_size; ++l) {
    const std::size_t i = lines[std::min(l, lines.size() - 1)];
    const auto distance_m = static_cast<double>(hits.distance[l]);
    const Vec3 at = lines_[i].origin + lines_[i].w * distance_m;
    points.x[l] = at.x;
    points.y[l] = at.y;
    points.z[l] = at.z;
    points.path_m[l] = distance_m;
    points.largest_link[l] = largest_link_[i];
  }
  linked_elements(hierarchy, points, element);
  for (std::size_t l = 0; l < lines.size(); ++l)
    met_[lines[l]] = {hits[l], points.patch[l], element[l]};
}

}  // namespace sunload
