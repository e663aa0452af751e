// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/pilot_sight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/base/keys.h"

namespace sunload {

namespace {

/// A packet of 16 points for every so many least areas: a point for 16 of them.
constexpr double areas_per_packet = 256;
constexpr std::size_t most_packets = 8;

std::size_t packets_for(double area_m2, double min_area_m2) {
  if (min_area_m2 <= 0) return 1;
  const double packets = std::ceil(area_m2 / (areas_per_packet * min_area_m2));
  return static_cast<std::size_t>(std::clamp(packets, 1.0, static_cast<double>(most_packets)));
}

}  // namespace

PilotPoints::PilotPoints(const ElementForest& forest, std::size_t on, std::uint8_t side,
                         double offset_m, double min_area_m2, std::uint64_t seed)
    : element(on), area_m2(forest.area(element)) {
  const Vec3 a = forest.corner(element, 0);
  const Vec3 ab = forest.corner(element, 1) - a, ac = forest.corner(element, 2) - a;
  normal = normalized(cross(ab, ac)) * (side == 0 ? 1.0 : -1.0);
  axes = tangents(normal);
  corners = {a + normal * offset_m, a + ab + normal * offset_m, a + ac + normal * offset_m};
  const std::uint64_t key = mixed(forest.key(element), side);
  const auto words = [&](std::uint32_t realization) {
    return random_words(
        {.seed = seed, .purpose = Purpose::mesh_pilot, .realization = realization, .element = key});
  };
  for (std::uint32_t h = 0; h < halves_of_light; ++h) {
    direction_seeds[h] = words(h);
    emitter_seeds[h] = words(halves_of_light + h);
  }
  const RandomWords seeds = words(2 * halves_of_light);
  beam_seeds = seeds;  // of other coordinates
  packets.resize(packets_for(area_m2, min_area_m2));
  for (std::size_t s = 0; s < count(); ++s) {
    const auto index = static_cast<std::uint32_t>(s);
    const Barycentric at =
        sample_triangle(scrambled_sobol(index, 0, seeds), scrambled_sobol(index, 1, seeds));
    put(packets[s / packet_size], s % packet_size, corners[0] + ab * at.w1 + ac * at.w2);
  }
}

PilotSight::PilotSight(const ElementForest& forest, const RayCaster& caster,
                       const PeriodLight& light, const SkyGrid& grid, PilotPoints from)
    : points_(std::move(from)) {
  for (std::size_t h = 0; h < halves_of_light; ++h) {
    straight_[h].assign(points_.count(), 0);
    seen_[h].assign(points_.packets.size() * rays_per_packet, none);
  }
  for (std::size_t p = 0; p < points_.packets.size(); ++p) {
    double common[packet_size] = {};
    add_suns(caster, light.suns, p, common);
    for (std::size_t h = 0; h < halves_of_light; ++h) {
      double* const sum = &straight_[h][p * packet_size];
      std::copy_n(common, packet_size, sum);
      add_suns(caster, light.samples[h], p, sum);
      see_surroundings(forest, caster, light, grid, p, h);
    }
  }
}

void PilotSight::add_suns(const RayCaster& caster, const std::vector<PeriodSun>& suns,
                          std::size_t packet, double* sum) {
  for (const PeriodSun& sun : suns) {
    const double cos_theta = dot(points_.normal, sun.direction);
    if (cos_theta <= 0) continue;
    const auto shares =
        caster.passed_each(points_.packets[packet], same_for_all(sun.direction), all_rays);
    for (std::size_t r = 0; r < packet_size; ++r) {
      if (shares[r] <= 0) continue;
      sees_sun_ = true;
      largest_cosine_ = std::max(largest_cosine_, cos_theta);
      sum[r] += sun.exposure * cos_theta * static_cast<double>(shares[r]);
    }
  }
}

/// Each packet of rays has four directions of four points.
void PilotSight::see_surroundings(const ElementForest& forest, const RayCaster& caster,
                                  const PeriodLight& light, const SkyGrid& grid, std::size_t packet,
                                  std::size_t half) {
  constexpr std::uint32_t directions_per_packet = packet_size / quarters;
  static_assert(directions_per_half == packets_together * directions_per_packet);
  const RandomWords& seeds = points_.direction_seeds[half];
  double beyond[directions_per_half];
  PacketHits hits[packets_together];
  for (std::uint32_t i = 0; i < packets_together; ++i) {
    Packet origins;
    PacketDirections directions;
    for (std::uint32_t r = 0; r < packet_size; r += quarters) {
      const std::uint32_t d = i * directions_per_packet + r / quarters;
      const Vec3 local = sample_cosine(scrambled_sobol(d, 0, seeds), scrambled_sobol(d, 1, seeds));
      const Vec3 w = points_.axes.tangent * local.x + points_.axes.bitangent * local.y +
                     points_.normal * local.z;
      beyond[d] = w.z > 0 ? light.sky[static_cast<std::size_t>(grid.cell(w))] : light.ground;
      for (std::uint32_t q = 0; q < quarters; ++q) {
        put(origins, r + q, at(points_.packets[packet], q));
        put(directions, r + q, w);
      }
    }
    hits[i] = caster.first_hits(origins, directions, all_rays);
  }
  std::int32_t leaves[rays_per_packet];
  forest.leaves_at(hits, leaves);
  std::array<double, quarters> of_quarter{};
  for (std::uint32_t ray = 0; ray < rays_per_packet; ++ray) {
    const PacketHits& of = hits[ray / packet_size];
    const std::size_t r = ray % packet_size;
    if (of.triangle[r] < 0) {
      of_quarter[ray % quarters] += beyond[ray / quarters] / directions_per_half;
    } else if (leaves[ray] >= 0 &&
               (of.front[r] || forest.is_two_sided(static_cast<std::size_t>(leaves[ray])))) {
      seen_[half][packet * rays_per_packet + ray] = 2 * leaves[ray] + (of.front[r] ? 0 : 1);
    }
  }
  for (std::size_t r = 0; r < packet_size; ++r)
    straight_[half][packet * packet_size + r] += of_quarter[first_in_quarter_of(r)];
}

}  // namespace sunload
