// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/line_bundle.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/base/vector_code.h"
#include "solver/base/counting_sort.h"
#include "solver/mesh/linked_element.h"

namespace sunload {

namespace {

/// The directions' octahedron, unfolded to a square of cells, about 300 of which make a hemisphere
/// (Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit Vectors).
constexpr std::int32_t cells_per_side = 22;
constexpr std::uint32_t direction_cells = cells_per_side * cells_per_side;
static_assert(direction_cells <= most_digits);

/// Cells of the directions of 16 lines, in the shape that compilers turn into vector code.
SUNLOAD_VECTOR_CODE void direction_cells_of(const double (&__restrict w)[3][packet_size],
                                            std::int32_t (&__restrict cell)[packet_size]) {
  for (std::size_t l = 0; l < packet_size; ++l) {
    const double scale = 1 / (std::abs(w[0][l]) + std::abs(w[1][l]) + std::abs(w[2][l]));
    const double x = w[0][l] * scale, y = w[1][l] * scale;
    const double folded_x = std::copysign(1 - std::abs(y), x);
    const double folded_y = std::copysign(1 - std::abs(x), y);
    const bool below = w[2][l] < 0;
    const auto column =
        static_cast<std::int32_t>(((below ? folded_x : x) + 1) * (0.5 * cells_per_side));
    const auto row =
        static_cast<std::int32_t>(((below ? folded_y : y) + 1) * (0.5 * cells_per_side));
    constexpr std::int32_t last = cells_per_side - 1;
    cell[l] = (row < last ? row : last) * cells_per_side + (column < last ? column : last);
  }
}

/// Lines whose meetings are found together.
using MetLines = LineColumns<LinkedPoints::most>;

/// Where lines are after `path_m`.
SUNLOAD_VECTOR_CODE void place(const MetLines& __restrict lines, LinkedPoints& __restrict points) {
  for (std::size_t l = 0; l < LinkedPoints::most; ++l) {
    points.x[l] = lines.origin[0][l] + lines.w[0][l] * points.path_m[l];
    points.y[l] = lines.origin[1][l] + lines.w[1][l] * points.path_m[l];
    points.z[l] = lines.origin[2][l] + lines.w[2][l] * points.path_m[l];
  }
}

}  // namespace

void LineBundle::clear() {
  lines_.clear();
  largest_link_.clear();
  cell_.clear();
}

void LineBundle::add(const PatchLines& lines, std::size_t count, double largest_link) {
  largest_link_.insert(largest_link_.end(), count, largest_link);
  PacketLines packet;
  std::int32_t cell[packet_size];
  for (std::size_t first = 0; first < count; first += packet_size) {
    lines.packet(first, packet);
    direction_cells_of(packet.w, cell);
    const std::size_t some = std::min(packet_size, count - first);
    for (std::size_t l = 0; l < some; ++l) lines_.push_back(packet[l]);
    cell_.insert(cell_.end(), cell, cell + some);
  }
}

void LineBundle::sort_by_direction() {
  in_order_.resize(lines_.size());
  std::iota(in_order_.begin(), in_order_.end(), 0u);
  sort_by_digit(in_order_, order_, direction_cells,
                [this](std::uint32_t line) { return static_cast<std::uint32_t>(cell_[line]); });
}

void LineBundle::cast(const RayCaster& caster, const Hierarchy& hierarchy, const SkyGrid& grid) {
  sort_by_direction();
  met_.resize(lines_.size());
  PacketHits hits[packets_together];
  Packet origins{};
  PacketDirections directions{};
  std::span<const std::uint32_t> left = order_;
  while (!left.empty()) {
    const auto together = left.first(std::min(left.size(), LinkedPoints::most));
    std::size_t packets = 0;
    for (std::size_t first = 0; first < together.size(); first += packet_size) {
      const std::size_t count = std::min(packet_size, together.size() - first);
      for (std::size_t l = 0; l < count; ++l) {
        const PatchLines::Line& line = lines_[together[first + l]];
        put(origins, l, line.origin);
        put(directions, l, line.w);
      }
      hits[packets++] = caster.first_hits(origins, directions, (1u << count) - 1u,
                                          RayCaster::Coherence::parallel);
    }
    put_met(std::span(hits).first(packets), together, hierarchy, grid);
    left = left.subspan(together.size());
  }
}

void LineBundle::put_met(std::span<const PacketHits> hits, std::span<const std::uint32_t> lines,
                         const Hierarchy& hierarchy, const SkyGrid& grid) {
  LinkedPoints points;
  MetLines met;
  hierarchy.patches_at(hits, points.patch);
  for (std::size_t l = 0; l < LinkedPoints::most; ++l) {
    const std::size_t of = std::min(l, lines.size() - 1), i = lines[of];
    met.put(l, lines_[i]);
    points.patch[l] = points.patch[of];
    points.path_m[l] = static_cast<double>(hits[of / packet_size].distance[of % packet_size]);
    points.largest_link[l] = largest_link_[i];
  }
  place(met, points);
  std::uint32_t element[LinkedPoints::most];
  std::int32_t cell[LinkedPoints::most];
  linked_elements(hierarchy, points, element);
  grid.cells(met.w[0], met.w[1], met.w[2], LinkedPoints::most, cell);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::uint32_t target =
        points.patch[l] < 0 ? static_cast<std::uint32_t>(cell[l]) : element[l];
    met_[lines[l]] = {hits[l / packet_size][l % packet_size], points.patch[l], target};
  }
}

}  // namespace sunload
